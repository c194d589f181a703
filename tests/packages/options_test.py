#!/usr/bin/env python3
"""Compares the table of CMake's options in docs/packaging.md with the options that the build has, names and defaults.

An option is what `option()` or a cached `set()` makes, in a CMakeLists.txt or a .cmake file, with a name that begins with
GRAZE_. Results of find_program() and the like are none.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/packaging.md"
FOLDERS = ["core", "docs", "io", "scheduler", "tests", "tools"]
# What is written in place of a default that is a variable or long.
DEFAULTS = {"${PROJECT_IS_TOP_LEVEL}": "on for graze alone", "": "none", "${CMAKE_SOURCE_DIR}/../shared/data": "../shared/data",
            "ON": "on", "OFF": "off"}


def cmake_files():
    yield ROOT / "CMakeLists.txt"
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if (path.name == "CMakeLists.txt" or path.suffix == ".cmake") and "consumers" not in path.parts:
                yield path


def options(text):
    """Yields the name and the default of each option of a file of CMake."""
    text = re.sub(r"^\s*#.*$", "", text, flags=re.MULTILINE)
    for name, default in re.findall(r"\boption\(\s*(GRAZE_\w+)\s+\"[^\"]*\"\s+([^\s)]+)\s*\)", text):
        yield name, default
    for name, default in re.findall(r"\bset\(\s*(GRAZE_\w+)\s+(\"[^\"]*\"|[^\s)]+)\s+CACHE\b", text):
        yield name, default.strip('"')


def main():
    known, faults = {}, []
    for path in cmake_files():
        for name, default in options(path.read_text(encoding="utf-8")):
            default = DEFAULTS.get(default, default)
            if known.setdefault(name, default) != default:
                faults.append(f"{path.relative_to(ROOT)}: {name} has two defaults")
    page = PAGE.read_text(encoding="utf-8")
    table = dict(re.findall(r"^\| `(GRAZE_\w+)` \| (.*?) \|", page, flags=re.MULTILINE))
    table = {name: default.replace("`", "") for name, default in table.items()}
    faults += [f"docs/packaging.md has no {name}" for name in known.keys() - table.keys()]
    faults += [f"docs/packaging.md has {name}, which is no option" for name in table.keys() - known.keys()]
    faults += [f"{name}: docs/packaging.md says {table[name]}, and the default is {known[name]}"
               for name in known.keys() & table.keys() if table[name] != known[name]]
    used = set(re.findall(r"\bGRAZE_[A-Z_]+", page)) - known.keys() - {"GRAZE_LIBRARY"}
    faults += [f"docs/packaging.md has the word {name}" for name in used if "VERSION" not in name]
    presets = (ROOT / "CMakePresets.json").read_text(encoding="utf-8")
    faults += [f"CMakePresets.json sets {name}, which is no option" for name in
               set(re.findall(r"\"(GRAZE_\w+)\"", presets)) - known.keys()]
    print("\n".join(faults) or f"{len(known)} options are the same")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
