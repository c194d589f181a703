#!/usr/bin/env python3
"""Checks that includes run one way, and draws them by folder.

    include_order.py [--root DIR]                 checks; exit code 1 where an include runs against the order
    include_order.py [--root DIR] --draw FILE.svg  draws the folders and their includes (needs Graphviz's `dot`)

Each layer (core, scheduler, io) is a list of folders, from the bottom up. A file includes from its own folder and from
folders further down. Between layers: io includes scheduler's and core's public headers, scheduler also the headers in
core/internal, and core includes none of either. Public headers include public headers alone.
"""
import argparse
import pathlib
import re
import subprocess
import sys

# From the bottom up: a folder may include those before it.
ORDER = {
    "core": ["base", "arithmetic", "kernels", "mesh", "surface", "pair", "closest_features", "measure", "leaves", "walk",
             "vertices", "paper", "search"],
    "scheduler": ["base", "calls", "objects", "broad_phase", "pairs", "report", "jobs", "step"],
    "io": ["text", "mesh", "formats", "assimp", "gltf", "files", "motion", "scene", "report", "picture"],
}
LOWER_LAYERS = {"core": [], "scheduler": ["core"], "io": ["core", "scheduler"]}
# Libraries that a layer may include, by the beginning of the header's name. The standard library's have no slash.
LIBRARIES = {"core": ["Eigen/"], "scheduler": ["Eigen/", "oneapi/tbb", "tbb/"],
             "io": ["Eigen/", "assimp/", "nlohmann/", "spdlog/"]}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.MULTILINE)
PUBLIC = "include"  # the folder of a layer's public headers, below all others


class Place:
    """Where a file stands: its layer, its folder, and whether it is a header of core/internal."""

    def __init__(self, layer, folder, internal=False):
        self.layer, self.folder, self.internal = layer, folder, internal

    def rank(self):
        return -1 if self.folder == PUBLIC else ORDER[self.layer].index(self.folder)


def files_of(root):
    """Every source file of the layers, with its place."""
    for layer, folders in ORDER.items():
        for base, internal in ((root / layer / "src", False), (root / layer / "internal" / layer, True)):
            for path in sorted(base.rglob("*")) if base.is_dir() else []:
                if path.suffix not in (".hpp", ".cpp", ".inc"):
                    continue
                parts = path.relative_to(base).parts
                if len(parts) != 2 or parts[0] not in folders:
                    raise SystemExit(f"{path.relative_to(root)}: stands in no folder of the order")
                yield path, Place(layer, parts[0], internal)
        for path in sorted((root / layer / "include").rglob("*.hpp")):
            yield path, Place(layer, PUBLIC)


def place_of_include(root, name, layer):
    """The place of an included header of the project; None for a library's."""
    for other in ORDER:
        if (root / other / "include" / name).is_file():
            return Place(other, PUBLIC)
    first, _, rest = name.partition("/")
    if first in ORDER and (root / first / "internal" / name).is_file():
        return Place(first, rest.partition("/")[0], True)
    if (root / layer / "src" / name).is_file():
        return Place(layer, first)
    return None


def objection(source, name, target, is_quoted):
    """Why a file at `source` may not include `name`; None where it may."""
    if target is None:
        if is_quoted:
            return "no such header; write the folder, as in \"mesh/weld.hpp\""
        if "/" in name and not any(name.startswith(start) for start in LIBRARIES[source.layer]):
            return f"{source.layer} depends on no such library"
        return None
    if target.layer != source.layer and target.layer not in LOWER_LAYERS[source.layer]:
        return f"{source.layer} may not include {target.layer}"
    if source.folder == PUBLIC and target.folder != PUBLIC:
        return "a public header includes a header that is not installed"
    if target.layer != source.layer:
        if target.internal and source.layer != "scheduler":
            return f"{source.layer} includes public headers of core alone"
        return None
    if source.internal and not target.internal and target.folder != PUBLIC:
        return "a header of core/internal includes one that the scheduler does not see"
    if target.rank() > source.rank():
        return f"{source.folder} stands below {target.folder}"
    return None


def read(root):
    """All objections, and the includes between folders as a set of ((layer, folder), (layer, folder))."""
    objections, edges = [], set()
    for path, source in files_of(root):
        text = path.read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            name = match.group(2)
            target = place_of_include(root, name, source.layer)
            reason = objection(source, name, target, match.group(1) == '"')
            if reason:
                line = text.count("\n", 0, match.start()) + 1
                objections.append(f"{path.relative_to(root)}:{line}: {name}: {reason}")
            if target and (target.layer, target.folder) != (source.layer, source.folder):
                edges.add(((source.layer, source.folder), (target.layer, target.folder)))
    return objections, edges


def reduced(edges):
    """The edges without those that a longer way says as well."""
    below = {}
    for upper, lower in edges:
        below.setdefault(upper, set()).add(lower)

    def reaches(start, goal, first):
        seen, todo = set(), [node for node in below.get(start, ()) if node != first]
        while todo:
            node = todo.pop()
            if node == goal:
                return True
            if node not in seen:
                seen.add(node)
                todo.extend(below.get(node, ()))
        return False

    return sorted(edge for edge in edges if not reaches(edge[0], edge[1], edge[1]))


def drawing(edges):
    """The includes in Graphviz's language: a box for each layer, arrows from who includes to what is included."""
    colours = {"core": "#dbe9f6", "scheduler": "#e2f0d9", "io": "#fbe5d6"}
    lines = ["digraph includes {", "  rankdir=TB; nodesep=0.25; ranksep=0.35; bgcolor=white;",
             '  node [shape=box, style="filled,rounded", fontname="Helvetica", fontsize=12, margin="0.12,0.05"];',
             '  edge [color="#707070", arrowsize=0.6];']
    for layer, folders in ORDER.items():
        lines += [f"  subgraph cluster_{layer} {{", f'    label="{layer}"; fontname="Helvetica"; color="#b0b0b0";']
        for folder in folders + [PUBLIC]:
            label = "public headers" if folder == PUBLIC else folder
            lines.append(f'    "{layer}/{folder}" [label="{label}", fillcolor="{colours[layer]}"];')
        lines.append("  }")
    for upper, lower in reduced(edges):
        lines.append(f'  "{"/".join(upper)}" -> "{"/".join(lower)}";')
    return "\n".join(lines + ["}", ""])


def note_of(edges):
    """The edges as a comment of the picture, by which it is known whether the picture is of the present sources."""
    return "<!-- includes: " + " ".join(f"{'/'.join(a)}>{'/'.join(b)}" for a, b in sorted(edges)) + " -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--draw", type=pathlib.Path, metavar="FILE.svg")
    arguments = parser.parse_args()
    objections, edges = read(arguments.root)
    if arguments.draw:
        svg = subprocess.run(["dot", "-Tsvg"], input=drawing(edges), capture_output=True, text=True, check=True).stdout
        arguments.draw.write_text(svg.rstrip("\n") + "\n" + note_of(edges) + "\n", encoding="utf-8")
    picture = arguments.root / "docs" / "includes.svg"
    if picture.is_file() and note_of(edges) not in picture.read_text(encoding="utf-8"):
        objections.append("docs/includes.svg is of other sources: tests/lint/include_order.py --draw docs/includes.svg")
    for line in objections:
        print(line)
    print(f"{len(edges)} includes between folders, {len(objections)} objections")
    return 1 if objections else 0


if __name__ == "__main__":
    sys.exit(main())
