#!/usr/bin/env python3
"""Checks that include_order.py finds wrong includes.

It makes a small tree in a temporary folder, of which the checker must say nothing. Then it adds one mistake of each
sort, and fails unless the checker finds each of these and nothing else.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True  # no folder of compiled scripts in the sources

import include_order

# Files without a mistake.
GOOD = {
    "core/include/graze/mesh.hpp": "#include <vector>\n",
    "core/include/graze/contact.hpp": "#include <graze/mesh.hpp>\n#include <Eigen/Core>\n",
    "core/internal/core/surface/surface.hpp": "#include <graze/mesh.hpp>\n",
    "core/src/base/limits.hpp": "#include <graze/mesh.hpp>\n",
    "core/src/surface/surface.cpp": '#include "core/surface/surface.hpp"\n#include "base/limits.hpp"\n',
    "core/src/search/search.hpp": '#include "core/surface/surface.hpp"\n',
    "scheduler/include/graze/scene.hpp": "#include <graze/mesh.hpp>\n",
    "scheduler/src/step/step.cpp": '#include "core/surface/surface.hpp"\n#include <oneapi/tbb/task_arena.h>\n',
    "io/include/graze/io/log.hpp": "#include <graze/scene.hpp>\n",
    "io/src/page/mesh_table.cpp": '#include "core/surface/surface.hpp"\n',
    "io/src/text/log.cpp": "#include <spdlog/spdlog.h>\n#include <graze/io/log.hpp>\n",
}

# (file, text, what the checker has to say of it).
MISTAKES = [
    ("core/src/base/upward.hpp", '#include "search/search.hpp"\n', "base stands below search"),
    ("core/src/search/workers/upward.hpp", '#include "search/search.hpp"\n', "search/workers stands below search"),
    ("core/src/mesh/library.cpp", "#include <boost/any.hpp>\n", "core depends on no such library"),
    ("core/include/graze/leaky.hpp", '#include "core/surface/surface.hpp"\n',
     "a public header includes a header that is not installed"),
    ("core/src/mesh/layer.cpp", "#include <graze/scene.hpp>\n", "core may not include scheduler"),
    ("core/src/mesh/absent.cpp", '#include "nowhere.hpp"\n', "no such header"),
    ("core/internal/core/base/hidden.hpp", '#include "base/limits.hpp"\n',
     "a header of core/internal includes one that the scheduler does not see"),
    ("io/src/scene/inside.cpp", '#include "core/surface/surface.hpp"\n', "io includes public headers of core alone"),
]


def write(root, name, text):
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#pragma once\n" + text, encoding="utf-8")


def unexpected_of(root, mistakes):
    """What the checker should have said and did not, and the reverse."""
    objections, _ = include_order.read(root)
    problems = []
    for file, _, reason in mistakes:
        found = [line for line in objections if line.startswith(f"{file}:2: ") and reason in line]
        if len(found) != 1:
            problems.append(f"not found: {file}: {reason}")
        objections = [line for line in objections if line not in found]
    return problems + [f"found, though it is right: {line}" for line in objections]


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in GOOD.items():
            write(root, name, text)
        problems = unexpected_of(root, [])
        for name, text, _ in MISTAKES:
            write(root, name, text)
        problems += unexpected_of(root, MISTAKES)
        for name, _, _ in MISTAKES:
            (root / name).unlink()

        write(root, "core/src/elsewhere/file.hpp", "")
        try:
            include_order.read(root)
            problems.append("not found: a folder that is not in the order")
        except SystemExit as stop:
            if "stands in no folder" not in str(stop):
                problems.append(f"another reason than that the folder is unknown: {stop}")
    for line in problems:
        print(line)
    print(f"{len(MISTAKES) + 1} mistakes made, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
