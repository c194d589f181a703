#!/usr/bin/env python3
"""Makes the pictures and counts of docs/choosing.md: two surfaces in contact, and a ball that rests on a cloth.

    docs/choosing/make_pictures.py PROGRAM [FOLDER]

PROGRAM is the program graze. FOLDER is where the pictures go, by default this script's own. All meshes are generated.
The pictures are drawn by `graze run`; what it reports is counted and printed."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

DETAILS = ("none", "closest", "regions", "vertices", "nearest", "features")
EDGE = 0.1  # of the squares that are cut into two triangles each
GAP = 0.015
CONTACT_DISTANCE = 0.06
BEND = 0.55  # the radius of the upper surface
TILT = math.radians(40)  # of everything, towards the eye


def grid(columns, rows, place):
    """A surface of columns x rows squares about the origin; place says where the point (x, y) of the plane is."""
    points = [place(EDGE * (x - columns / 2), EDGE * (y - rows / 2))
              for y in range(rows + 1) for x in range(columns + 1)]
    row = columns + 1
    faces = []
    for corner in (y * row + x for y in range(rows) for x in range(columns)):
        faces += [(corner, corner + 1, corner + row + 1), (corner, corner + row + 1, corner + row)]
    return points, faces


def tilted(x, y, z):
    return x, y * math.cos(TILT) - z * math.sin(TILT), y * math.sin(TILT) + z * math.cos(TILT)


def flat(x, y):
    return tilted(x, y, 0.0)


def bent(x, y):
    """On a cylinder above the flat surface, whose axis is turned a little."""
    x, z = BEND * math.sin(x / BEND), BEND - BEND * math.cos(x / BEND)
    turn = math.radians(12)
    turned = (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn))
    return tilted(turned[0] + 0.02, turned[1] + 0.03, z + GAP)


def write_obj(path, mesh):
    points, faces = mesh
    lines = ["v %r %r %r" % point for point in points]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def ball(radius, rings, around):
    """A ball on the origin: squares cut into two triangles each, and a fan at each pole."""
    points = [(0.0, 0.0, 0.0)]
    for ring in range(1, rings):
        down = math.pi * ring / rings
        for step in range(around):
            turn = 2 * math.pi * (step + 0.5 * ring) / around
            points.append((radius * math.sin(down) * math.cos(turn), radius * math.sin(down) * math.sin(turn),
                           radius - radius * math.cos(down)))
    points.append((0.0, 0.0, 2 * radius))
    at = lambda ring, step: 1 + (ring - 1) * around + step % around
    faces = [(0, at(1, step + 1), at(1, step)) for step in range(around)]
    for ring in range(1, rings - 1):
        for step in range(around):
            faces += [(at(ring, step), at(ring, step + 1), at(ring + 1, step)),
                      (at(ring, step + 1), at(ring + 1, step + 1), at(ring + 1, step))]
    faces += [(len(points) - 1, at(rings - 1, step), at(rings - 1, step + 1)) for step in range(around)]
    return points, faces


def pair_of(program, scene, *options):
    """The one pair that a scene reports in its first frame."""
    report = scene.with_suffix(".jsonl")
    subprocess.run([program, "run", scene, "--frames", "1", "--report", report, *options], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads(report.read_text().splitlines()[1])["pairs"][0]


def write_scene(path, names, gap=0.0):
    objects = [{"name": name, "mesh": name + ".obj"} for name in names]
    objects[1]["transform"] = {"translate": [0.0, 0.0, gap]}
    path.write_text(json.dumps({"graze": 1, "contact_distance": CONTACT_DISTANCE, "range": 0.5, "objects": objects}))


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    program = sys.argv[1]
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else pathlib.Path(__file__).parent
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        write_obj(work / "flat.obj", grid(12, 8, flat))
        write_obj(work / "bent.obj", grid(9, 4, bent))
        write_scene(work / "surfaces.json", ["flat", "bent"])
        for detail in DETAILS:
            picture = [] if detail == "none" else ["--picture", out / (detail + ".png")]
            pair = pair_of(program, work / "surfaces.json", "--detail", detail, *picture)
            kinds = [contact["kind"] for contact in pair["contacts"]]
            counts = ", ".join("%d %s" % (kinds.count(kind), kind) for kind in sorted(set(kinds)))
            distance = pair["distance"][1]
            print("%s: %s, distance %.4f, contacts: %s" % (detail, pair["phase"], distance, counts or "none"))

        print("\ncontacts by contact distance in edges:", ", ".join(DETAILS[1:]))
        for edges in (0.1, 0.2, 0.3, 0.6, 1, 2, 4):
            counts = [len(pair_of(program, work / "surfaces.json", "--detail", detail,
                                  "--contact-distance", str(edges * EDGE))["contacts"]) for detail in DETAILS[1:]]
            print("%g:" % edges, ", ".join(str(count) for count in counts))

        # In metres: a cloth of 0.6 m and a ball of radius 0.15 m, with edges of 12 mm, 2 mm apart.
        points, faces = grid(50, 50, lambda x, y: (x * 0.012 / EDGE, y * 0.012 / EDGE, 0.0))
        write_obj(work / "cloth.obj", (points, faces))
        write_obj(work / "ball.obj", ball(0.15, 40, 80))
        write_scene(work / "example.json", ["cloth", "ball"], 0.002)
        print("\nball on cloth: contacts of features, vertices and nearest by contact distance in mm")
        for millimetres in (4, 8, 16, 26.5):
            counts = [len(pair_of(program, work / "example.json", "--detail", detail,
                                  "--contact-distance", str(millimetres / 1000))["contacts"])
                      for detail in ("features", "vertices", "nearest")]
            print("%g:" % millimetres, ", ".join(str(count) for count in counts))


if __name__ == "__main__":
    main()
