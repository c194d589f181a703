#!/usr/bin/env python3
"""Checks that includes run one way, and draws them by folder.

    include_order.py [--root DIR]                 checks; exit code 1 where an include runs against the order
    include_order.py [--root DIR] --draw FILE.svg  draws the folders and their includes (needs Graphviz's `dot`)

Each layer (core, scheduler, io) is a list of folders, from the bottom up. A file includes from its own folder and from
folders further down. A folder within another has its own place in the list. Between layers: io includes scheduler's and core's public headers, scheduler also the headers in
core/internal, and core includes none of either. Of io the folder `page` alone includes headers of core/internal, for the
regions of a mesh. Public headers include public headers alone.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import textwrap

# From the bottom up: a folder may include those before it. What each is about stands in the drawing.
ORDER = {
    "core": {
        "base": "limits, small containers",
        "arithmetic": "signs: double, then exact",
        "kernels": "loops for each instruction set",
        "mesh": "indices, regions, vertex order",
        "surface": "positions, bounds, motion",
        "pair": "query, answer, front, near list",
        "sweep": "features that meet on the way",
        "closest_features": "closest features of a pair",
        "measure": "points, normals, sides",
        "leaves/layout": "features in float, filters",
        "leaves": "features of two leaves",
        "walk": "DMV, leaf pairs, witness",
        "vertices": "near vertices, by blocks",
        "solid": "what is inside a closed surface",
        "paper": "paper mode, region distances",
        "search/workers": "the pair, slices of a search",
        "search/closest": "closest points of a pair",
        "search/solids": "insides and ways out of a pair",
        "search/contacts": "contacts, in stages",
        "search": "one query",
        "query": "two surfaces without a scene",
        "response": "contacts at other positions",
        "cast": "rays, spheres, points, boxes",
    },
    "scheduler": {
        "base": "task pool, access rights",
        "calls": "calls of all threads, ids",
        "objects": "objects and how they are read",
        "broad_phase": "objects whose boxes are near",
        "pairs": "filters, memory, list of jobs",
        "geometry": "what queries between steps ask",
        "patches": "what lies around a tool, between steps",
        "report": "reports, handles, contact rows",
        "jobs": "refit, searches on all threads",
        "recording": "what steps take up, as chunks",
        "step": "one step, and the scene",
        "replay": "recordings: write, read, replay, cut",
    },
    "io": {
        "text": "numbers, JSON, errors, log",
        "mesh": "raw faces, welding, axes, rigs",
        "formats": "OBJ, PLY, OFF, STL",
        "assimp": "what assimp reads",
        "gltf": "glTF 2",
        "files": "a reader for each ending",
        "motion": "clips, key frames, caches",
        "scene": "scene files, players",
        "report": "reports as JSON",
        "picture": "pictures as PNG",
        "page": "pages for a browser",
        "export": "tables, ParaView, glTF",
    },
}
# The folders that may include headers of core/internal.
INTERNAL_USERS = {"scheduler": set(ORDER["scheduler"]), "io": {"page"}}
LOWER_LAYERS = {"core": [], "scheduler": ["core"], "io": ["core", "scheduler"]}
# Libraries that a layer may include, by the beginning of the header's name. The standard library's have no slash.
LIBRARIES = {"core": ["Eigen/"], "scheduler": ["Eigen/", "oneapi/tbb", "tbb/"],
             "io": ["Eigen/", "assimp/", "nlohmann/", "spdlog/"]}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.MULTILINE)
PUBLIC = "include"  # the folder of a layer's public headers, below all others


class Location:
    """Where a file stands: its layer, its folder, and whether it is a header of core/internal."""

    def __init__(self, layer, folder, internal=False):
        self.layer, self.folder, self.internal = layer, folder, internal

    def rank(self):
        return -1 if self.folder == PUBLIC else list(ORDER[self.layer]).index(self.folder)


def files_of(root):
    """Every source file of the layers, with where it stands."""
    for layer, folders in ORDER.items():
        for base, internal in ((root / layer / "src", False), (root / layer / "internal" / layer, True)):
            for path in sorted(base.rglob("*")) if base.is_dir() else []:
                if path.suffix not in (".hpp", ".cpp", ".inc"):
                    continue
                folder = path.relative_to(base).parent.as_posix()
                if folder not in folders:
                    raise SystemExit(f"{path.relative_to(root)}: stands in no folder of the order")
                yield path, Location(layer, folder, internal)
        for path in sorted((root / layer / "include").rglob("*.hpp")):
            yield path, Location(layer, PUBLIC)


def location_of_include(root, name, layer):
    """Where an included header of the project stands; None for a library's."""
    for other in ORDER:
        if (root / other / "include" / name).is_file():
            return Location(other, PUBLIC)
    first, _, rest = name.partition("/")
    if first in ORDER and (root / first / "internal" / name).is_file():
        return Location(first, rest.rpartition("/")[0], True)
    if (root / layer / "src" / name).is_file():
        return Location(layer, name.rpartition("/")[0])
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
        if target.internal and source.folder not in INTERNAL_USERS[source.layer]:
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
            target = location_of_include(root, name, source.layer)
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
    colours = {"core": ("#eef5fb", "#cfe2f3"), "scheduler": ("#f1f8ec", "#d5e8c8"), "io": ("#fdf3ea", "#f8dcc4")}
    lines = ["digraph includes {", '  rankdir=TB; nodesep=0.12; ranksep=0.25; bgcolor=white; fontname="Helvetica";',
             '  node [shape=box, style="filled,rounded", fontname="Helvetica", color="#606060", margin="0.11,0.05"];',
             '  edge [color="#505050", arrowsize=0.7];']
    for layer, folders in ORDER.items():
        light, dark = colours[layer]
        lines += [f"  subgraph cluster_{layer} {{", f'    label=<<b>{layer}</b>>; fontsize=18; style=filled;'
                  f' color="{light}"; margin=8;']
        for folder, about in [*folders.items(), (PUBLIC, "installed")]:
            name = "public headers" if folder == PUBLIC else folder
            lines_of_about = "<br/>".join(textwrap.wrap(about, 17))
            label = f'<b>{name}</b><br/><font point-size="12">{lines_of_about}</font>'
            colour = "white" if folder == PUBLIC else dark
            lines.append(f'    "{layer}/{folder}" [label=<{label}>, fontsize=14, fillcolor="{colour}"];')
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
