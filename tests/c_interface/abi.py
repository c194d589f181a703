#!/usr/bin/env python3
"""Compares the binary interface of the library graze_c with abi.txt.

usage: abi.py graze.h library compiler [--write]

The file has every function, and every struct with its size and the place of each member, on a target of 64 bits. A
difference means that a program has to be compiled anew: the number in the library's name has to change with it. A new
function or a new member at the end of a struct with struct_size is no such difference. --write writes the file anew.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).with_name("abi.txt")


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)


def functions(header):
    return sorted(set(re.findall(r"\b(graze_\w+)\(", header)))


def structs(header):
    """Yields the name of each struct and the names of its members."""
    for body, name in re.findall(r"typedef struct \{(.*?)\} (graze_\w+);", header, flags=re.DOTALL):
        members = []
        for line in filter(None, (part.strip() for part in body.split(";"))):
            pointer = re.search(r"\(\*(\w+)\)", line)
            members.append(pointer.group(1) if pointer else re.search(r"(\w+)(?:\[\w+\])?$", line).group(1))
        yield name, members


def layouts(header, path, compiler):
    """Asks the compiler for the sizes and places."""
    lines = []
    for name, members in structs(header):
        lines.append(f'printf("struct {name} %zu\\n", sizeof({name}));')
        lines += [f'printf("  {member} %zu\\n", offsetof({name}, {member}));' for member in members]
    program = f'#include "{path}"\n#include <cstdio>\nint main() {{\n' + "\n".join(lines) + "\n}\n"
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "layouts.cpp")
        source.write_text(program)
        subprocess.run([compiler, "-std=c++20", "-Wno-invalid-offsetof", source, "-o", f"{folder}/layouts"], check=True)
        return subprocess.run([f"{folder}/layouts"], check=True, capture_output=True, text=True).stdout.splitlines()


def exported(library):
    listing = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    return sorted(line.split()[-1] for line in listing.splitlines())


def main():
    path, library, compiler = (str(pathlib.Path(each).resolve()) if "/" in each else each for each in sys.argv[1:4])
    header = without_comments(pathlib.Path(path).read_text())
    names = functions(header)
    faults = [f"{name} is exported, and is not in graze.h" for name in sorted(set(exported(library)) - set(names))]
    faults += [f"{name} is in graze.h, and is not exported" for name in sorted(set(names) - set(exported(library)))]
    table = [f"function {name}" for name in names] + layouts(header, path, compiler)
    if "--write" in sys.argv:
        TABLE.write_text("\n".join(table) + "\n")
    expected = TABLE.read_text().splitlines()
    if table != expected:
        faults += [f"abi.txt has \"{line}\" no more" for line in expected if line not in table]
        faults += [f"abi.txt has not \"{line}\"" for line in table if line not in expected]
        faults += ["abi.txt has another order"] if sorted(table) == sorted(expected) else []
    print("\n".join(faults) or f"{len(names)} functions and {len(table) - len(names)} lines of layouts are the same")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
