"""Positions in numpy arrays: strides, bindings and how long what they read is kept."""

import gc
import threading
import unittest
import weakref

import numpy as np

import graze
import shapes
from graze import BindPolicy, DiagnosticKind

FLOOR = graze.Mesh([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], [[0, 1, 2, 3]])
BALL_POINTS, BALL_FACES = shapes.sphere(1)
BALL = graze.Mesh(BALL_POINTS, BALL_FACES)


def strided(dtype, kind):
    """Returns an array of the ball's shape that lies in memory in some way, and its values."""
    count = len(BALL_POINTS)
    if kind == "packed":
        return np.zeros((count, 3), dtype)
    if kind == "wide":
        return np.full((count, 8), np.nan, dtype)[:, 4:7]
    if kind == "columns":
        return np.zeros((count, 3), dtype, order="F")
    if kind == "records":
        return np.zeros(count, [("mass", dtype), ("x", dtype, 3), ("v", dtype, 3)])["x"]
    return np.zeros((2 * count, 3, 2), dtype)[::2, :, 1]


class StrideTest(unittest.TestCase):
    def test_bound_arrays_of_all_strides_are_read_where_they_lie(self):
        for dtype in (np.float32, np.float64):
            for kind in ("packed", "wide", "columns", "records", "every second"):
                with self.subTest(dtype=dtype, kind=kind), graze.Scene(range=100) as scene:
                    scene.add(FLOOR, motion=graze.Motion.FIXED)
                    ball = scene.add(BALL)
                    array = strided(dtype, kind)
                    scene.bind_positions(ball, array)
                    for height in (2.0, 3.5):
                        array[:] = BALL_POINTS + [0, 0, height]
                        report = scene.step()
                        self.assertEqual(report.diagnostics, [])
                        self.assertEqual(report.pairs["distance"]["lower"], [np.float64(array[:, 2].min())])

    def test_given_arrays_of_all_kinds_are_copied(self):
        with graze.Scene(range=100) as scene:
            scene.add(FLOOR, motion=graze.Motion.FIXED)
            ball = scene.add(BALL)
            up = BALL_POINTS + [0, 0, 3]
            for given in (up, up.tolist(), up.astype(">f8"), up[::-1].copy()[::-1], np.rint(4 * up).astype(int),
                          np.broadcast_to([[0.0, 0, 2]], up.shape), up.astype(np.float16)):
                scene.set_positions(ball, given)
                lowest = np.asarray(given, float)[:, 2].min()
                self.assertEqual(scene.step().pairs["distance"]["lower"], [lowest])

    def test_what_cannot_be_read_in_place_is_refused(self):
        with graze.Scene() as scene:
            ball = scene.add(BALL)
            packed = np.frombuffer(bytes(8 * BALL_POINTS.size + 1), np.uint8)
            unaligned = packed[1:].view(np.float64).reshape(-1, 3)
            for given in (BALL_POINTS.tolist(), BALL_POINTS[:-1], BALL_POINTS[:, :2], BALL_POINTS.astype(int),
                          BALL_POINTS.astype(">f8"), BALL_POINTS[::-1], BALL_POINTS.astype(np.float16), unaligned,
                          np.broadcast_to(np.zeros((1, 3)), BALL_POINTS.shape)):
                with self.assertRaises(graze.Error):
                    scene.bind_positions(ball, given)
            for given in (BALL_POINTS[:-1], BALL_POINTS[:, :2], BALL_POINTS.astype(complex), None):
                with self.assertRaises(graze.Error):
                    scene.set_positions(ball, given)
            with self.assertRaises(graze.Error):
                scene.bind_positions(graze.ObjectId(7, 7), BALL_POINTS)


class LifetimeTest(unittest.TestCase):
    def bound(self, scene, ball, policy=BindPolicy.EVERY_STEP):
        array = BALL_POINTS + [0, 0, 2.0]
        scene.bind_positions(ball, array, policy)
        return weakref.ref(array)

    def setUp(self):
        self.scene = graze.Scene(range=100)
        self.addCleanup(self.scene.close)
        self.scene.add(FLOOR, motion=graze.Motion.FIXED)
        self.ball = self.scene.add(BALL)

    def test_a_bound_array_is_kept_until_the_binding_ends(self):
        def replace():
            self.scene.replace_mesh(self.ball, BALL, range(BALL.vertex_count))

        ends = [lambda: self.scene.unbind_positions(self.ball),
                lambda: self.scene.set_positions(self.ball, BALL_POINTS),
                lambda: self.scene.set_positions(self.ball, BALL_POINTS, teleport=True),
                lambda: self.bound(self.scene, self.ball), replace, lambda: self.scene.remove(self.ball)]
        for end in ends:
            kept = self.bound(self.scene, self.ball)
            gc.collect()
            self.assertIsNotNone(kept())
            self.scene.step()
            self.assertIs(self.scene.bound_positions(self.ball), kept())
            end()
            self.assertIsNone(kept())
            self.assertEqual(self.scene.step().diagnostics, [])

    def test_bad_positions_end_no_binding(self):
        kept = self.bound(self.scene, self.ball)
        self.scene.set_positions(self.ball, BALL_POINTS * np.nan)
        self.assertIsNotNone(kept())
        kept()[:] += 1  # the step reads it all the same
        report = self.scene.step()
        self.assertEqual([problem.kind for problem in report.diagnostics], [DiagnosticKind.NOT_FINITE])
        self.assertEqual(report.pairs["distance"]["lower"], [2])

    def test_closing_the_scene_lets_go(self):
        kept = self.bound(self.scene, self.ball)
        self.scene.close()
        self.assertIsNone(kept())

    def test_a_forgotten_scene_lets_go_without_the_collector(self):
        gc.disable()
        self.addCleanup(gc.enable)
        scene = graze.Scene()
        kept = self.bound(scene, scene.add(BALL))
        del scene
        self.assertIsNone(kept())

    def test_an_array_that_a_running_step_reads_is_kept_until_that_ends(self):
        points, faces = shapes.sphere(6)
        mesh = graze.Mesh(points, faces)
        with graze.Scene(contact_distance=0.05, threads=1) as scene:
            still, moving = scene.add(mesh), scene.add(mesh)
            scene.set_positions(still, shapes.moved(points, shapes.rotation((1, 2, 3), 0.01)))
            for _ in range(20):
                array = points + [0.001, 0, 0]
                kept = weakref.ref(array)
                scene.bind_positions(moving, array)
                scene.step_async()
                del array
                scene.unbind_positions(moving)
                if scene.is_stepping:
                    self.assertIsNotNone(kept())
                    scene.wait()
                    break
                scene.wait()
            else:
                self.fail("no step was still running")
            self.assertIsNone(kept())

    def test_threads_bind_while_another_steps(self):
        stop = threading.Event()
        failures = []

        def step():
            while not stop.is_set():
                failures.extend(self.scene.step().diagnostics)

        stepping = threading.Thread(target=step)
        stepping.start()
        for turn in range(300):
            self.bound(self.scene, self.ball)
            if turn % 3 == 0:
                self.scene.unbind_positions(self.ball)
        stop.set()
        stepping.join()
        self.assertEqual(failures, [])


class PromiseTest(unittest.TestCase):
    def test_memory_is_read_when_told(self):
        with graze.Scene(range=100) as scene:
            scene.add(FLOOR, motion=graze.Motion.FIXED)
            ball = scene.add(BALL)
            array = BALL_POINTS + [0, 0, 2.0]
            scene.bind_positions(ball, array, BindPolicy.WHEN_TOLD)
            self.assertEqual(scene.step().pairs["distance"]["lower"], [1])
            array[:, 2] += 1
            scene.positions_changed(ball, 1.0)
            self.assertEqual(scene.step().pairs["distance"]["lower"], [2])
            array[:, 2] += 1
            scene.positions_changed(ball, teleport=True)
            self.assertEqual(scene.step().pairs["distance"]["lower"], [3])
            array[:, 2] += 5
            scene.positions_changed(ball, 0.5)
            kinds = [problem.kind for problem in scene.step().diagnostics]
            self.assertEqual(kinds, [DiagnosticKind.BROKEN_PROMISE])


if __name__ == "__main__":
    unittest.main()
