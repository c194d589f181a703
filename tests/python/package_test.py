"""The package: its version, its library, its types, the program of its page, and that steps leak nothing."""

import ast
import gc
import os
import pathlib
import re
import resource
import subprocess
import sys
import tracemalloc
import unittest

import numpy as np

import graze
import shapes
from graze import _library

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = pathlib.Path(graze.__file__).parent


class PackageTest(unittest.TestCase):
    def test_version_is_that_of_the_library_and_the_headers(self):
        header = (ROOT / "core/include/graze/version.hpp").read_text(encoding="utf-8")
        numbers = [re.search(rf"#define GRAZE_VERSION_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH")]
        self.assertEqual(graze.__version__, ".".join(numbers))
        self.assertEqual(graze.__version__, graze.library_version())

    def test_an_installed_package_uses_its_own_libraries(self):
        if os.environ.get("GRAZE_LIBRARY"):
            self.skipTest("the library is that of GRAZE_LIBRARY")
        with open("/proc/self/maps", encoding="utf-8") as maps:
            loaded = {line.split()[-1] for line in maps if re.search(r"lib(graze_c|tbb)\.so", line)}
        self.assertEqual({pathlib.Path(path).parent for path in loaded}, {PACKAGE})
        self.assertTrue((PACKAGE / _library.NAME).is_file())

    def test_a_missing_library_is_an_import_error(self):
        done = subprocess.run([sys.executable, "-c", "import graze"], capture_output=True, text=True, check=False,
                              env={**os.environ, "GRAZE_LIBRARY": "/no/such/library.so"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("ImportError: graze found no shared library; set GRAZE_LIBRARY", done.stderr)

    def test_everything_public_has_types_and_a_docstring(self):
        self.assertTrue((PACKAGE / "py.typed").is_file())
        for file in PACKAGE.glob("*.py"):
            tree = ast.parse(file.read_text(encoding="utf-8"))
            self.assertTrue(ast.get_docstring(tree), file.name)
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef):
                    given = [argument for argument in node.args.args + node.args.kwonlyargs
                             if argument.arg not in ("self", "cls")]
                    self.assertTrue(node.returns and all(argument.annotation for argument in given),
                                    f"{file.name}: {node.name}")
        for name in set(graze.__all__) - {"__version__"}:
            thing = getattr(graze, name)
            if isinstance(thing, np.dtype):
                continue
            self.assertTrue(thing.__doc__, name)
            for member, value in vars(thing).items() if isinstance(thing, type) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_instruction_sets(self):
        self.assertGreater(graze.max_threads(), 0)
        graze.use_instruction_set(graze.instruction_set())
        with self.assertRaisesRegex(graze.Error, "no instruction set"):
            graze.use_instruction_set("abacus")

    def test_the_programs_of_the_page_run(self):
        page = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        programs = re.findall(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", page, flags=re.DOTALL)
        self.assertGreaterEqual(len(programs), 2)
        self.assertTrue(any(printed for _, printed in programs))
        for program, printed in programs:
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
            self.assertEqual((done.stderr, done.stdout), ("", printed))


class LeakTest(unittest.TestCase):
    STEPS = 10_000

    def test_ten_thousand_steps_keep_nothing(self):
        mesh = graze.Mesh(*shapes.box())
        with graze.Scene(contact_distance=0.1, range=1, threads=1) as scene:
            scene.add(mesh, motion=graze.Motion.FIXED, queries=True)
            moving, bound = scene.add(mesh, motion=graze.Motion.RIGID), scene.add(mesh)
            pose = np.eye(4)

            def step(number):
                pose[0, 3] = 1.9 + 0.2 * (number % 2)
                scene.set_pose(moving, pose)
                scene.bind_positions(bound, mesh.rest + [0, 0, 2.05])
                report = scene.step(number)
                graze.separations(report.contacts_of(0))
                if number % 100 == 0:
                    report.copy().mesh(graze.SceneQuery(report).cast_ray([0, 0, 9], [0, 0, -1])["object"][0])
                    with self.assertRaises(graze.Error):
                        scene.step(-1)

            # The library's own memory has grown to what it needs after the first steps.
            for number in range(1000):
                step(number)
            gc.collect()
            tracemalloc.start()
            self.addCleanup(tracemalloc.stop)
            before, resident = tracemalloc.get_traced_memory()[0], self.resident()
            for number in range(self.STEPS):
                step(number)
            gc.collect()
            grown = tracemalloc.get_traced_memory()[0] - before
            self.assertLess(grown, 64 * 1024)  # below seven bytes a step: what a step keeps is far larger
            self.assertLess(self.resident() - resident, 8 * 1024 * 1024)

    def test_handles_are_released(self):
        points, faces = shapes.sphere(4)
        peak = None
        for turn in range(60):
            mesh = graze.Mesh(points, faces)
            mesh.weld(0.0)
            graze.query(mesh, None, mesh, points + [1.99, 0, 0], contact_distance=0.01)
            graze.MeshProbe(mesh)
            with graze.Scene() as scene:
                scene.add(mesh)
                scene.step()
            if turn == 20:
                peak = self.resident()
        self.assertLess(self.resident() - peak, 30 * 1024 * 1024)  # one turn takes above a megabyte

    def resident(self):
        with open("/proc/self/statm", encoding="utf-8") as numbers:
            return int(numbers.read().split()[1]) * resource.getpagesize()


if __name__ == "__main__":
    unittest.main()
