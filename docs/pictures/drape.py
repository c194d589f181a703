#!/usr/bin/env python3
"""Writes the scene of the README's picture: a cloth that lies on a ball. It takes about a minute.

    docs/pictures/drape.py FOLDER
    graze run FOLDER/scene.json --picture docs/drape.png

The cloth is a grid of quads that falls onto the ball, by position-based dynamics. Its vertices keep a gap to the ball,
so that the surfaces come within the contact distance and never overlap.
"""

import json
import math
import pathlib
import sys

CELLS = 44
SIZE = 2.1
BALL_RADIUS = 0.6
BALL_CENTRE = (0.0, 0.0, 0.6)
GAP = 0.012
CONTACT_DISTANCE = 0.0114
STEPS = 220
# Rows down, columns to the right, and strength: along the edges, across the quads, and against bending.
LINKS = [(0, 1, 1), (1, 0, 1), (1, 1, 0.35), (1, -1, 0.35), (0, 2, 0.12), (2, 0, 0.12)]
ITERATIONS = 14


def vertex(row, column):
    return row * (CELLS + 1) + column


def drape():
    """Where the cloth's vertices are when it has come to rest on the ball."""
    spacing = SIZE / CELLS
    turn = math.radians(20)
    positions = []
    for row in range(CELLS + 1):
        for column in range(CELLS + 1):
            x, y = column * spacing - SIZE / 2, row * spacing - SIZE / 2
            positions.append([x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn),
                              2 * BALL_RADIUS + 0.03])
    previous = [list(position) for position in positions]
    links = []
    for row in range(CELLS + 1):
        for column in range(CELLS + 1):
            for down, right, strength in LINKS:
                if row + down <= CELLS and 0 <= column + right <= CELLS:
                    links.append((vertex(row, column), vertex(row + down, column + right),
                                  spacing * math.hypot(down, right), strength))
    for _ in range(STEPS):
        for position, before in zip(positions, previous):
            for axis in range(3):
                velocity = (position[axis] - before[axis]) * 0.96
                before[axis] = position[axis]
                position[axis] += velocity - (0.0006 if axis == 2 else 0)
        for _ in range(ITERATIONS):
            for a, b, length, strength in links:
                p, q = positions[a], positions[b]
                dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
                now = math.sqrt(dx * dx + dy * dy + dz * dz)
                pull = 0.5 * strength * (now - length) / now
                p[0] += pull * dx
                p[1] += pull * dy
                p[2] += pull * dz
                q[0] -= pull * dx
                q[1] -= pull * dy
                q[2] -= pull * dz
            for position, before in zip(positions, previous):
                push_out(position, before)
    return positions


def push_out(position, before):
    """Moves a vertex out of the ball, and takes most of its way along the surface from it."""
    away = [position[axis] - BALL_CENTRE[axis] for axis in range(3)]
    distance = math.sqrt(sum(part * part for part in away))
    least = BALL_RADIUS + GAP
    if distance < least:
        for axis in range(3):
            position[axis] = BALL_CENTRE[axis] + away[axis] * least / distance
            before[axis] += 0.5 * (position[axis] - before[axis])
    position[2] = max(position[2], GAP)


def ball():
    """A ball of quads and, at its poles, triangles."""
    rings, sectors = 40, 64
    positions = [[0, 0, BALL_RADIUS]]
    for ring in range(1, rings):
        down = math.pi * ring / rings
        for sector in range(sectors):
            around = 2 * math.pi * sector / sectors
            positions.append([BALL_RADIUS * math.sin(down) * math.cos(around),
                              BALL_RADIUS * math.sin(down) * math.sin(around), BALL_RADIUS * math.cos(down)])
    positions.append([0, 0, -BALL_RADIUS])
    faces = []
    for sector in range(sectors):
        beside = (sector + 1) % sectors
        faces.append([0, 1 + sector, 1 + beside])
        for ring in range(rings - 2):
            up, low = 1 + ring * sectors, 1 + (ring + 1) * sectors
            faces.append([up + sector, low + sector, low + beside, up + beside])
        last = 1 + (rings - 2) * sectors
        faces.append([last + sector, len(positions) - 1, last + beside])
    return positions, faces


def write_obj(path, positions, faces):
    with open(path, "w", encoding="ascii") as file:
        for position in positions:
            file.write("v " + " ".join(f"{coordinate:.6f}" for coordinate in position) + "\n")
        for face in faces:
            file.write("f " + " ".join(str(corner + 1) for corner in face) + "\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    quads = [[vertex(row, column), vertex(row, column + 1), vertex(row + 1, column + 1), vertex(row + 1, column)]
             for row in range(CELLS) for column in range(CELLS)]
    write_obj(folder / "cloth.obj", drape(), quads)
    write_obj(folder / "ball.obj", *ball())
    scene = {"graze": 1, "contact_distance": CONTACT_DISTANCE, "range": 0.1, "detail": "features", "objects": [
        {"name": "ball", "mesh": "ball.obj", "motion": "fixed", "transform": {"translate": list(BALL_CENTRE)}},
        {"name": "cloth", "mesh": "cloth.obj", "motion": "deformable"}]}
    (folder / "scene.json").write_text(json.dumps(scene, indent=2) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
