#!/usr/bin/env python3
"""Prints the tests that failed, each with the end of what it printed.

Reads result files of ctest (its option --output-junit). What ctest prints itself is far above the end of a long log.
"""

import pathlib
import sys
import xml.etree.ElementTree

LAST_LINES = 40  # of each test's output


def main():
    for path in map(pathlib.Path, sys.argv[1:]):
        for case in xml.etree.ElementTree.parse(path).iter("testcase"):
            if case.find("failure") is None:
                continue
            lines = case.findtext("system-out", "").splitlines()
            print(f"== failed in {path.stem}: {case.get('name')}, after {float(case.get('time')):.0f} s")
            print("\n".join(lines[-LAST_LINES:]))


main()
