#!/usr/bin/env python3
"""The recipes of docs/packaging.md: they can be read, name options that graze has, and have the version of graze. The one
for CPM is configured around this checkout. Also whether all places that have the version have the same.

usage: recipes_test.py FOLDER C++
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import options_test

ROOT = options_test.ROOT
PAGE = ROOT / "docs/packaging.md"
WORK, COMPILER = pathlib.Path(sys.argv[1]), sys.argv[2]

# Stands for vcpkg: each function prints its name and what it gets.
VCPKG = """
foreach(name from_github check_features cmake_configure cmake_install cmake_config_fixup fixup_pkgconfig install_copyright)
  cmake_language(EVAL CODE "function(vcpkg_${name})\\n message(\\"vcpkg_${name} \\${ARGN}\\")\\nendfunction()")
endforeach()
set(VERSION 0)
set(CURRENT_PACKAGES_DIR ${CMAKE_CURRENT_LIST_DIR}/packages)
"""
# Stands for CPM: it takes this checkout in place of a download.
CPM = """
function(CPMAddPackage)
  cmake_parse_arguments(given "" "NAME;VERSION;GITHUB_REPOSITORY" "OPTIONS" ${ARGN})
  foreach(option ${given_OPTIONS})
    separate_arguments(option)
    list(GET option 0 name)
    list(GET option 1 value)
    set(${name} ${value} CACHE STRING "" FORCE)
  endforeach()
  add_subdirectory(${GRAZE} ${given_NAME})
endfunction()
"""


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def version_of(path, pattern):
    found = re.search(pattern, (ROOT / path).read_text(encoding="utf-8"), flags=re.DOTALL)
    return f"{path}: {'.'.join(found.groups()) if found else 'no version'}"


def check_versions():
    """Every place where the version is written."""
    macros = r"#define GRAZE_VERSION_MAJOR (\d+).*#define GRAZE_VERSION_MINOR (\d+).*#define GRAZE_VERSION_PATCH (\d+)"
    number = r"(\d+)\.(\d+)\.(\d+)"
    said = [version_of("core/include/graze/version.hpp", macros),
            version_of("scheduler/c/include/graze/graze.h", macros),
            version_of("tools/python/graze/_version.py", rf'__version__ = "{number}"'),
            version_of("tools/viewer/package.json", rf'"version": "{number}"'),
            version_of("tools/graze/man/graze.1", rf'\.TH GRAZE 1 "" "graze {number}"'),
            version_of("README.md", rf"\*\*Version\*\*: {number}"),
            version_of("docs/compatibility.md", rf"The version is {number} now"),
            version_of("docs/packaging.md", rf'"version": "{number}"'),
            version_of("docs/packaging.md", rf'version = "{number}"'),
            version_of("docs/packaging.md", rf"VERSION {number}")]
    return [] if len({line.partition(": ")[2] for line in said}) == 1 else ["the versions differ", *said]


def check_vcpkg():
    port = json.loads(blocks("json")[0])
    faults = [f"vcpkg.json has no {key}" for key in {"name", "version", "license", "dependencies"} - port.keys()]
    folder = WORK / "port"
    folder.mkdir()
    (folder / "run.cmake").write_text(VCPKG + "include(${CMAKE_CURRENT_LIST_DIR}/portfile.cmake)\n")
    (folder / "portfile.cmake").write_text(blocks("cmake")[0])
    done = subprocess.run(["cmake", "-P", folder / "run.cmake"], capture_output=True, text=True, check=False)
    if done.returncode:
        return [*faults, f"portfile.cmake does not run: {done.stderr}"]
    pairs = re.search(r"vcpkg_check_features .*;FEATURES;(.*)", done.stderr)[1].split(";")[::2]
    if set(pairs) != set(port["features"]):
        faults.append(f"portfile.cmake has the features {pairs}, and vcpkg.json {sorted(port['features'])}")
    return faults


def check_conan():
    recipe = blocks("python")[0]
    compile(recipe, "conanfile.py", "exec")
    targets = set(re.findall(r'components\["(\w+)"\]', recipe))
    return [] if targets == {"core", "scheduler", "graze", "io"} else [f"conanfile.py has the components {targets}"]


def check_cpm():
    folder = WORK / "project"
    (folder / "cmake").mkdir(parents=True)
    (folder / "cmake/CPM.cmake").write_text(CPM)
    (folder / "main.cpp").write_text("int main() {}\n")
    (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(game CXX)\n" + blocks("cmake")[1])
    done = subprocess.run(["cmake", "-G", "Ninja", "-S", folder, "-B", folder / "build", f"-DGRAZE={ROOT}",
                           f"-DCMAKE_CXX_COMPILER={COMPILER}"], capture_output=True, text=True, check=False)
    if done.returncode:
        return [f"the project with CPM is not configured: {done.stdout}{done.stderr}"]
    rules = (folder / "build/build.ninja").read_text(encoding="utf-8")
    return [] if "libgraze_io" not in rules and "libgraze_core.a" in rules else ["the project builds other parts of graze"]


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    known = {name for path in options_test.cmake_files() for name, _ in options_test.options(path.read_text(encoding="utf-8"))}
    recipes = "\n".join([*blocks("cmake"), *blocks("python")])
    faults = [f"a recipe sets {name}, which is no option" for name in set(re.findall(r"GRAZE_\w+", recipes)) - known]
    faults += check_versions() + check_vcpkg() + check_conan() + check_cpm()
    print("\n".join(faults) or "the recipes are right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
