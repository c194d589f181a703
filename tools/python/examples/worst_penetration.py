"""Finds the deepest penetration in a recording, frame by frame.

    python worst_penetration.py scene.graze
    python worst_penetration.py scene.graze --csv worst.csv

It prints each frame that is deeper than all before it, and the worst of all. With matplotlib it draws the depth over
the frames into a PNG beside the recording. Without, it writes the numbers as CSV.
"""

import argparse
import pathlib

import numpy as np

import graze

# %% The command line.
parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("recording", type=pathlib.Path)
parser.add_argument("--csv", type=pathlib.Path, help="write the numbers into this file in any case")
given = parser.parse_args()

# %% The replay answers each frame anew. A negative separation is the depth of a vertex behind a surface.
recording = graze.Recording(given.recording)
replay = recording.replay()
frames, depths, places = [], [], []
for report in replay:
    separations = graze.separations(report.contacts)
    deepest = int(np.argmin(separations)) if len(separations) else -1
    frames.append(recording.frame(replay.frame_index).frame)
    depths.append(min(0.0, separations[deepest]) if deepest >= 0 else 0.0)
    names = {tuple(object.id): object.settings.name for object in replay.objects}
    pair = next((pair for pair in report.pairs
                 if pair["first_contact"] <= deepest < pair["first_contact"] + pair["contact_count"]), None)
    places.append("" if pair is None else f"{names[tuple(pair['a'])]} and {names[tuple(pair['b'])]}, "
                  f"at {report.contacts[deepest]['point_a'].round(4)}")
    if depths[-1] < min(depths[:-1], default=0.0):
        print(f"frame {frames[-1]}: {depths[-1]:.6g} ({places[-1]})")

# %% The result: a picture, or numbers.
worst = int(np.argmin(depths))
table = given.csv
try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.plot(frames, depths)
    pyplot.xlabel("frame")
    pyplot.ylabel("deepest separation")
    pyplot.savefig(given.recording.with_suffix(".png"))
except ImportError:
    table = table or given.recording.with_suffix(".csv")
if table:
    np.savetxt(table, np.column_stack([frames, depths]), fmt=["%d", "%.9g"], delimiter=",",
               header="frame,deepest separation", comments="")
print(f"the worst is {depths[worst]:.6g} in frame {frames[worst]}" + (f" ({places[worst]})" if places[worst] else ""))
