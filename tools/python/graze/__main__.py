"""The commands `python -m graze info` and `python -m graze view`."""

import argparse
import shutil
import subprocess
import sys
from typing import List, Optional

from .errors import Error
from .recording import Recording


def info(file: str) -> int:
    """Prints what is in a recording: a line for each frame."""
    with Recording(file) as recording:
        print(f"{len(recording)} frames, {recording.mesh_count} meshes, {recording.byte_count} bytes, "
              f"made by graze {recording.made_by}" + ("" if recording.is_finished else ", not finished"))
        print("frame  pairs  in contact  contacts  diagnostics  step_ms")
        for frame in recording.frames:
            print(f"{frame.frame:5}  {frame.pairs:5}  {frame.pairs_in_contact:10}  {frame.contacts:8}  "
                  f"{frame.diagnostics:11}  {frame.step_ms:7.3f}")
    return 0


def view(arguments: List[str]) -> int:
    """Runs `graze view`, the program, with the same arguments."""
    program = shutil.which("graze")
    if program is None:
        print("python -m graze view: the program graze is not on the path; graze built with GRAZE_BUILD_TOOLS has it",
              file=sys.stderr)
        return 1
    return subprocess.run([program, "view", *arguments], check=False).returncode


def main(arguments: Optional[List[str]] = None) -> int:
    given = sys.argv[1:] if arguments is None else arguments
    if given[:1] == ["view"]:
        return view(given[1:])
    parser = argparse.ArgumentParser(prog="python -m graze", description="Reads recordings of graze.")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("info", help="print the frames of a recording").add_argument("recording")
    commands.add_parser("view", help="show a recording with the program graze")
    try:
        return info(parser.parse_args(given).recording)
    except Error as error:
        print(f"python -m graze: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
