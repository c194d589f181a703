#!/usr/bin/env python3
"""Makes the Debian packages of what a build holds, checks them, installs them into an empty root, and uses them there.

usage: packages_test.py --source ROOT --build BUILD --work FOLDER --program FOLDER --cxx C++ --cc C [--write]

Nothing of graze is compiled: the preset `package` is configured in FOLDER, and the libraries and the program of BUILD
are copied into it. The root gets the state of this machine's dpkg, so dpkg sees what the packages depend on. --write
writes installed.txt anew. The exit code is 77 where a tool is missing.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
import sbom_check

HERE = pathlib.Path(__file__).resolve().parent
LIST = HERE / "installed.txt"
PACKAGES = {"graze_runtime": "libgraze-c0", "graze_development": "libgraze-dev", "graze_tools": "graze-tools",
            "graze_python": "python3-graze"}
BUILT = ["core/libgraze_core.a", "scheduler/libgraze_scheduler.a", "io/libgraze_io.a", "scheduler/c/libgraze_c.so*",
         "tools/graze/graze"]
TOOLS = ["dpkg", "dpkg-deb", "dpkg-shlibdeps", "man", "gzip", "readelf", "pkg-config", "ninja"]


def run(*command, **more):
    """Runs a command and returns what it prints. Ends the test if it fails."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}\nended with {done.returncode}")
    return done.stdout


def expect(is_so, message):
    if not is_so:
        sys.exit(message)


def files_below(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_symlink() or path.is_file()}


class Packages:
    def __init__(self, options):
        self.options = options
        self.work = options.work.resolve()
        self.build = self.work / "build"
        self.root = self.work / "root"
        self.triplet = run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()
        self.library_folder = self.root / "usr/lib" / self.triplet
        shutil.rmtree(self.work, ignore_errors=True)

    def configure(self):
        """The layout of the packages, around the files that were built already."""
        run("cmake", "--preset", "package", "-S", self.options.source, "-B", self.build,
            f"-DCMAKE_CXX_COMPILER={self.options.cxx}")
        for pattern in BUILT:
            found = list(self.options.build.glob(pattern))
            expect(found, f"{self.options.build} has no {pattern}")
            for file in found:
                target = self.build / file.relative_to(self.options.build)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(file, target, follow_symlinks=False)
        # The build under test left room for the path that `cmake --install` sets. A build of the preset has none.
        script = self.work / "without_path.cmake"
        script.write_text(f"cmake_minimum_required(VERSION 3.25)\nfile(GLOB libraries {self.build}/scheduler/c/*.so.*.*)\n"
                          "foreach(library ${libraries})\n  file(RPATH_REMOVE FILE ${library})\nendforeach()\n")
        run("cmake", "-P", script)

    def installed(self):
        """Lines of installed.txt: a component and a file that it installs. LIB is the folder of libraries."""
        lines = []
        for component in [*PACKAGES, "graze_sbom"]:
            prefix = self.work / "install" / component
            run("cmake", "--install", self.build, "--component", component, "--prefix", prefix)
            names = sorted(files_below(prefix))
            lines += [f"{component} {name.replace(f'lib/{self.triplet}/', 'LIB/')}" for name in names]
        whole = self.work / "install/all"
        run("cmake", "--install", self.build, "--prefix", whole)
        parts = {name for component in [*PACKAGES, "graze_sbom"] for name in files_below(self.work / "install" / component)}
        others = sorted(files_below(whole) - parts)
        expect(not others, f"of no component are {others}")
        return lines

    def check_installed(self):
        lines = self.installed()
        if self.options.write:
            LIST.write_text("\n".join(lines) + "\n", encoding="utf-8")
        expected = LIST.read_text(encoding="utf-8").splitlines()
        faults = [f"installed, and not in installed.txt: {line}" for line in sorted(set(lines) - set(expected))]
        faults += [f"in installed.txt, and not installed: {line}" for line in sorted(set(expected) - set(lines))]
        expect(not faults, "\n".join(faults))

    def pack(self):
        run("cpack", "-G", "DEB", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", cwd=self.build)
        self.files = {file.name.partition("_")[0]: file for file in self.build.glob("*.deb")}
        expect(set(self.files) == set(PACKAGES.values()), f"the packages are {sorted(self.files)}")

    def check_contents(self):
        """A package has the files of its component, and Debian's own beside them."""
        listed = [line.split(" ", 1) for line in LIST.read_text(encoding="utf-8").splitlines()]
        for component, package in PACKAGES.items():
            expected = {"usr/" + name.replace("LIB/", f"lib/{self.triplet}/") for part, name in listed if part == component}
            expected = {name + ".gz" if "/man/" in name else name for name in expected}
            expected |= {f"usr/share/doc/{package}/{name}" for name in
                         ("changelog.Debian.gz", "changelog.gz", "copyright", "graze.spdx.json")}
            expected.add(f"usr/share/lintian/overrides/{package}")
            folder = self.work / "unpacked" / package
            folder.parent.mkdir(exist_ok=True)
            run("dpkg-deb", "-x", self.files[package], folder)
            expect(files_below(folder) == expected, f"{package}: other files are {files_below(folder) ^ expected}")
            for file in [*folder.glob("usr/bin/*"), *folder.rglob("*.so.*.*")]:
                expect("RUNPATH" not in run("readelf", "-d", file), f"{file.name} looks for libraries in a path of its own")

    def check_with_lintian(self):
        if not shutil.which("lintian"):
            print("lintian is not installed, so it has not looked; tools/install_packages.sh packages installs it")
            return
        said = run("lintian", "--allow-root", "--fail-on", "error,warning", *self.files.values())
        expect(not re.search(r"^[EW]: ", said, flags=re.MULTILINE), said)
        # What is overridden is named and explained, once for all packages and once for the library.
        overridden = {line.split()[0] for file in (self.options.source / "tools/packages").glob("lintian-overrides*")
                      for line in file.read_text().splitlines() if not line.startswith("#")}
        expect(overridden == {"initial-upload-closes-no-bugs", "maintscript-calls-ldconfig"}, f"overridden: {overridden}")

    def dpkg(self, *words):
        """dpkg in the root, whose scripts run outside of it. ldconfig looks at the root alone."""
        tools = self.work / "tools"
        tools.mkdir(exist_ok=True)
        script = tools / "ldconfig"
        script.write_text('#!/bin/sh\nexec /sbin/ldconfig -r "$DPKG_ROOT" "$@"\n')
        script.chmod(0o755)
        path = f"{tools}:{os.environ['PATH']}:/usr/sbin:/sbin"
        # Images of containers leave such files out.
        whole = ["--path-include=/usr/share/man/*", "--path-include=/usr/share/doc/*"]
        return run("dpkg", f"--root={self.root}", "--force-script-chrootless", "--force-unsafe-io", *whole, *words, env={**os.environ, "PATH": path})

    def install(self):
        state = self.root / "var/lib/dpkg"
        (state / "info").mkdir(parents=True)
        (state / "updates").mkdir()
        (self.root / "etc").mkdir()
        (self.root / "etc/ld.so.conf").write_text(f"/usr/lib/{self.triplet}\n")
        shutil.copy("/var/lib/dpkg/status", state)
        self.dpkg("--install", *self.files.values())
        for package in PACKAGES.values():
            said = run("dpkg-query", f"--root={self.root}", "-W", "-f", "${Status}", package)
            expect(said == "install ok installed", f"{package}: {said}")

    def remove(self):
        self.dpkg("--purge", *PACKAGES.values())
        left = {name for name in files_below(self.root) if not name.startswith(("var/", "etc/"))}
        expect(not left, f"left after the packages were removed: {left}")

    def use_program(self):
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.work)}
        graze = self.root / "usr/bin/graze"
        said = run(graze, "--version", env=environment)
        expect(re.fullmatch(r"graze \d+\.\d+\.\d+\n", said), f"graze --version prints {said}")
        mesh = self.work / "triangle.obj"
        mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        expect("1 frame, 1 object" in run(graze, "run", mesh, env=environment), "the program runs no scene")
        page = run("man", "-M", self.root / "usr/share/man", "--warnings", "-E", "UTF-8", "graze",
                   env={**environment, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"})
        expect("Options of graze run" in page and "warning" not in page, page)
        completion = self.root / "usr/share/bash-completion/completions/graze"
        said = run("bash", "--norc", "-c", f"source {completion}; complete -p graze")
        expect(said == "complete -F _graze graze\n", said)

    def use_libraries(self):
        """A program by the CMake package, and programs in C++ and C by pkg-config."""
        build = self.work / "consumer"
        run("cmake", "-G", "Ninja", "-S", self.options.program, "-B", build, "-DCMAKE_BUILD_TYPE=Debug",
            f"-DCMAKE_CXX_COMPILER={self.options.cxx}", f"-DCMAKE_PREFIX_PATH={self.root}/usr")
        run("cmake", "--build", build)
        run(build / "consumer")
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.library_folder / "pkgconfig"),
                       "LD_LIBRARY_PATH": str(self.library_folder)}
        program = self.work / "version.cpp"
        program.write_text("#include <graze/version.hpp>\n"
                           "int main() { return graze::library_version() == graze::header_version ? 0 : 1; }\n")
        flags = run("pkg-config", "--cflags", "--libs", "graze", env=environment).split()
        expect(f"-I{self.root}" in " ".join(flags).replace("/usr/lib/" + self.triplet + "/pkgconfig/../../..", ""), flags)
        run(self.options.cxx, "-std=c++20", program, "-o", self.work / "version", *flags)
        run(self.work / "version")
        flags = run("pkg-config", "--cflags", "--libs", "graze-c", env=environment).split()
        run(sys.executable, HERE.parent / "c_interface/page_program.py", self.options.source / "docs/c_interface.md",
            self.work / "page", self.options.cc, *flags, env=environment)

    def use_python(self):
        """The first program of the page, with Debian's interpreter and the installed module alone."""
        text = (self.options.source / "docs/python.md").read_text(encoding="utf-8")
        program, expected = re.search(r"```python\n(.*?)```\s+```text\n(.*?)```", text, flags=re.DOTALL).groups()
        modules = self.root / "usr/lib/python3/dist-packages"
        program += f"assert graze.__file__.startswith({str(modules)!r}), graze.__file__\n"
        program += "import importlib.metadata\nassert importlib.metadata.version('graze') == graze.__version__\n"
        said = run("/usr/bin/python3", "-B", "-s", "-c", program, cwd=self.work,
                   env={"PYTHONPATH": str(modules), "LD_LIBRARY_PATH": str(self.library_folder)})
        expect(said == expected, f"the page's program prints {said}")

    def check_sbom(self):
        folder = self.root / "usr"
        faults = sbom_check.faults(folder / "share/doc/graze-tools/graze.spdx.json", self.options.source, {
            "graze-c": folder / "lib" / self.triplet / "libgraze_c.so.0", "graze-program": folder / "bin/graze"})
        expect(not faults, "\n".join(faults))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("source", "build", "work", "program"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--cxx", required=True)
    parser.add_argument("--cc", required=True)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    missing = [tool for tool in TOOLS if not shutil.which(tool)]
    if missing or os.geteuid() != 0:
        print(f"skipped: {', '.join(missing)} missing" if missing else "skipped: dpkg installs as root alone")
        return 77
    packages = Packages(options)
    for step in (packages.configure, packages.check_installed, packages.pack, packages.check_contents,
                 packages.check_with_lintian, packages.install, packages.use_program, packages.use_libraries,
                 packages.use_python, packages.check_sbom, packages.remove):
        began = time.monotonic()
        step()
        print(f"{step.__name__}: {time.monotonic() - began:.1f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
