#!/usr/bin/env python3
"""Checks that the C interface has what the C++ interface has.

usage: coverage.py source_folder

coverage.txt names for each public function of these classes and headers the functions of C that do the same, or says why
there is none. A function of C++ without a line is a fault. So is a line about a function that is not there, and a
function of C in no line.
"""

import pathlib
import re
import sys

TABLE = pathlib.Path(__file__).with_name("coverage.txt")
CLASSES = {
    "core/include/graze/mesh.hpp": ["Mesh"],
    "core/include/graze/query.hpp": ["RepeatedQuery"],
    "scheduler/include/graze/patch.hpp": ["Patch", "PatchRoom"],
    "scheduler/include/graze/report.hpp": ["FrameReport"],
    "scheduler/include/graze/scene.hpp": ["Scene"],
    "scheduler/include/graze/scene_query.hpp": ["MeshProbe", "SceneQuery"],
    "scheduler/include/graze/recorder.hpp": ["Recorder"],
    "scheduler/include/graze/recording.hpp": ["Recording", "Replay"],
}
FREE_FUNCTIONS = ["core/include/graze/contact_geometry.hpp", "core/include/graze/contact_walk.hpp",
                  "core/include/graze/instruction_set.hpp",
                  "core/include/graze/mesh.hpp", "core/include/graze/query.hpp", "core/include/graze/version.hpp",
                  "core/include/graze/weld.hpp", "scheduler/include/graze/recording.hpp",
                  "scheduler/include/graze/settings.hpp"]
NO_FUNCTIONS = {"requires", "int", "noexcept", "static_assert", "defined", "alignas"}


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def outermost(text):
    """Leaves out what stands in braces, from the innermost ones on."""
    before = None
    while before != text:
        before, text = text, re.sub(r"\{[^{}]*\}", ";", text)
    return text


def declared(statements):
    """Yields the name of each function that the statements declare."""
    for statement in statements.split(";"):
        if re.search(r"= delete|operator|friend|static constexpr", statement):
            continue
        names = [name for name in re.findall(r"(\w+)\s*\(", statement) if name not in NO_FUNCTIONS]
        if names:
            yield names[0]


def public_part(text, name):
    body = re.search(rf"class GRAZE_API {name} \{{(.*?)\n\}};", text, flags=re.DOTALL).group(1)
    return outermost(re.split(r"\n private:", body)[0].replace("public:", ""))


def interface(root):
    """Returns the names of all public functions."""
    names = set()
    for header, classes in CLASSES.items():
        text = without_comments((root / header).read_text())
        for name in classes:
            members = set(declared(public_part(text, name))) - {name}
            names |= {f"{name}::{member}" for member in members}
    for header in FREE_FUNCTIONS:
        for line in re.findall(r"^(?:\[\[nodiscard\]\] )?GRAZE_API (?!.*\bclass\b)[^;]*;", (root / header).read_text(),
                               flags=re.MULTILINE):
            names |= set(declared(line))
    return names


def main():
    root = pathlib.Path(sys.argv[1])
    rows = {}
    for line in TABLE.read_text().splitlines():
        name, _, rest = line.partition(": ")
        rows[name] = rest
    names = interface(root)
    c_header = without_comments((root / "scheduler/c/include/graze/graze.h").read_text())
    c_names = set(re.findall(r"\b(graze_\w+)\(", c_header))
    named = {word for rest in rows.values() for word in re.findall(r"graze_\w+", rest)}
    faults = [f"{name} of C++ has no line in coverage.txt" for name in sorted(names - set(rows))]
    faults += [f"coverage.txt tells of {name}, which is not in the headers" for name in sorted(set(rows) - names - {"C"})]
    faults += [f"coverage.txt names {name}, which is not in graze.h" for name in sorted(named - c_names)]
    faults += [f"{name} of C stands in no line of coverage.txt" for name in sorted(c_names - named)]
    print("\n".join(faults) or f"{len(names)} functions of C++ have a function of C, or a reason")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
