#!/usr/bin/env python3
"""Reads every model of Debian's assimp-testmodels with graze: `graze inspect`, then one step of `graze run`.

    tests/assimp_models.py PROGRAM [FOLDER] [--all] [--seconds N]

Prints a table by format: how many files were read, refused, wrong, ended by a signal or stopped after N seconds.
Lists every file that was refused, with the reason, and every file that is wrong. With --all it lists those that were
read, too. A file is wrong when its bounds differ from those of the OBJ file that `assimp export` makes of it (package
assimp-utils), where that program is installed. Files with joints are not compared, and Collada files, whose axes
assimp turns. Exit code 1: a file is wrong, ended the process or did not end.
"""

import collections
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

NOT_MODELS = {
    "", ".txt", ".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".dds", ".bin", ".mtl", ".glsl", ".vert", ".frag",
    ".material", ".md", ".license", ".html", ".log", ".skeleton", ".cfg", ".jpf", ".html", ".tif", ".pcx", ".wal",
}
NOT_COMPARED = {".dae", ".zae"}
# assimp turns these from z up to y up, and graze turns them back.
TURNED = {".3ds", ".ase", ".ask", ".dxf", ".iqm", ".md2", ".md5mesh", ".mdc"}


def run(command, seconds):
    """Exit code (None: it did not end), output and errors."""
    try:
        done = subprocess.run(command, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None, "", ""
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def graze_bounds(text):
    """The smallest and largest coordinates of all objects."""
    boxes = re.findall(r"bounds +from (\S+) (\S+) (\S+) to (\S+) (\S+) (\S+)", text)
    numbers = [[float(number) for number in box] for box in boxes]
    return [min(box[i] for box in numbers) for i in range(3)] + [max(box[i] for box in numbers) for i in range(3, 6)]


def assimp_bounds(path, seconds):
    """The same of what `assimp export` makes of the file; nothing where it makes nothing, or the file moves."""
    info = run(["assimp", "info", str(path), "--raw"], seconds)[1]
    bones = re.search(r"Bones: +(\d+)", info)
    if bones and int(bones.group(1)) > 0:
        return None
    with tempfile.TemporaryDirectory() as folder:
        target = pathlib.Path(folder) / "model.obj"
        run(["assimp", "export", str(path), str(target)], seconds)
        if not target.exists():
            return None
        text = target.read_text(errors="replace")
    # Vertices that a face uses: assimp keeps those of points and lines too.
    vertices = [line.split()[1:4] for line in text.splitlines() if line.startswith("v ")]
    used = {int(word.split("/")[0]) - 1 for line in text.splitlines() if line.startswith("f ")
            for word in line.split()[1:] if len(line.split()) > 3}
    points = [[float(number) for number in vertices[index]] for index in used]
    if not points:
        return None
    return [min(point[i] for point in points) for i in range(3)] + [max(point[i] for point in points) for i in range(3)]


def are_apart(a, b):
    size = max(abs(number) for number in a + b) or 1.0
    return any(abs(x - y) > 1e-4 * size for x, y in zip(a, b))


def judge(program, path, seconds):
    """One of read, refused, wrong, ended, hangs; and what there is to say."""
    code, out, err = run([program, "inspect", str(path)], seconds)
    if code is None:
        return "hangs", f"inspect did not end within {seconds} s"
    if code == 2:
        return "refused", err.strip().split("\n")[-1].replace(str(path) + ": ", "").replace("graze: ", "")
    if code != 0:
        return "ended", f"inspect ended with {code}"
    step = run([program, "run", str(path), "--frames", "1", "--contact-distance", "0.01"], seconds)
    if step[0] is None:
        return "hangs", f"run did not end within {seconds} s"
    if step[0] != 0:
        return "ended" if step[0] not in (1, 2) else "wrong", f"run ended with {step[0]}: {step[2].strip()[-200:]}"
    if path.suffix.lower() not in NOT_COMPARED and shutil.which("assimp"):
        expected = assimp_bounds(path, seconds)
        found = graze_bounds(out)
        if expected and path.suffix.lower() in TURNED:
            x, y, z, high_x, high_y, high_z = expected
            expected = [x, -high_z, y, high_x, -z, high_y]
        if expected and are_apart(found, expected):
            return "wrong", f"bounds {found}, assimp says {expected}"
    return "read", out.split("\n")[0].split(": ")[-1]


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    seconds = 20
    if "--seconds" in sys.argv:
        seconds = int(sys.argv[sys.argv.index("--seconds") + 1])
        arguments.remove(str(seconds))
    program = arguments[0]
    folder = pathlib.Path(arguments[1] if len(arguments) > 1 else "/usr/share/assimp/models")
    verdicts = ["read", "refused", "wrong", "ended", "hangs"]
    table = collections.defaultdict(collections.Counter)
    for path in sorted(folder.rglob("*")):
        extension = path.suffix.lower()
        if not path.is_file() or extension in NOT_MODELS:
            continue
        verdict, text = judge(program, path, seconds)
        table[extension][verdict] += 1
        if verdict != "read" or "--all" in sys.argv:
            print(f"{verdict:8} {path.relative_to(folder)}: {text}", flush=True)
    print("\n| format | " + " | ".join(verdicts) + " |\n| --- |" + " ---: |" * len(verdicts))
    total = collections.Counter()
    for extension in sorted(table):
        total.update(table[extension])
        print(f"| {extension} | " + " | ".join(str(table[extension][verdict]) for verdict in verdicts) + " |")
    print("| all | " + " | ".join(str(total[verdict]) for verdict in verdicts) + " |")
    return 1 if total["wrong"] + total["ended"] + total["hangs"] else 0


if __name__ == "__main__":
    sys.exit(main())
