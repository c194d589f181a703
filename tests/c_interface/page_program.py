#!/usr/bin/env python3
"""Builds the program of docs/c_interface.md with a C compiler, runs it, and compares what it prints.

usage: page_program.py page folder compiler flag...
"""

import pathlib
import re
import subprocess
import sys


def main():
    page, folder, compiler, *flags = sys.argv[1:]
    text = pathlib.Path(page).read_text()
    program = re.search(r"```c\n(.*?)```", text, flags=re.DOTALL).group(1)
    expected = re.search(r"It prints `(.*?)`", text).group(1)
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    source = pathlib.Path(folder, "main.c")
    source.write_text(program)
    subprocess.run([compiler, "-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o", f"{folder}/main", *flags],
                   check=True)
    said = subprocess.run([f"{folder}/main"], check=True, capture_output=True, text=True).stdout.strip()
    print(said)
    return 0 if said == expected else 1


if __name__ == "__main__":
    sys.exit(main())
