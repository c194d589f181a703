"""Recorders and recordings: what is recorded is what is read."""

import contextlib
import io
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import graze
import shapes
from graze import __main__ as program

BALL_POINTS, BALL_FACES = shapes.sphere(2)
FRAMES = 12
ROOT = pathlib.Path(__file__).resolve().parents[2]


def heights(frame):
    return 1.2 - 0.05 * frame


def play(scene, frames=FRAMES):
    """Lets a ball sink into a plate, and returns what the reports said."""
    plate = graze.Mesh([[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], [[0, 1, 2, 3]])
    scene.add(plate, name="plate", motion=graze.Motion.FIXED)
    ball = scene.add(graze.Mesh(BALL_POINTS, BALL_FACES), name="ball", user_data=5)
    said = []
    for frame in range(frames):
        scene.set_positions(ball, BALL_POINTS + [0.01, 0.02, heights(frame)])
        report = scene.step(frame)
        said.append((np.array(report.contacts), np.array(report.pairs["distance"])))
    return said


SETTINGS = graze.SceneSettings(contact_distance=0.1, range=1, detail=graze.ContactDetail.NEAREST)


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.file = cls.folder / "sinking.graze"
        with graze.Scene(SETTINGS) as scene, graze.Recorder(scene, cls.file, when_behind=1) as recorder:
            cls.said = play(scene)
        recorder.close()
        cls.statistics = recorder.statistics

    def test_frames_are_those_of_the_run(self):
        with graze.Recording(self.file) as recording:
            self.assertEqual((len(recording), self.statistics.frames, self.statistics.dropped), (FRAMES, FRAMES, 0))
            self.assertEqual(recording.settings, SETTINGS)
            self.assertEqual((recording.is_finished, recording.is_cut, recording.mesh_count), (True, False, 2))
            self.assertEqual(recording.byte_count, os.path.getsize(self.file))
            self.assertEqual(recording.made_by, graze.library_version())
            recording.check()
            for index, (frame, (contacts, _)) in enumerate(zip(recording.frames, self.said)):
                self.assertEqual((frame.frame, frame.tag, frame.contacts), (index + 1, index, len(contacts)))
                self.assertEqual(frame.pairs_in_contact, int(len(contacts) > 0))
            self.assertTrue(recording.frame(0).has_keyframe)
            with self.assertRaises(graze.Error):
                recording.frame(FRAMES)
        with self.assertRaisesRegex(graze.Error, "closed"):
            len(recording)

    def test_a_replay_says_what_was_said(self):
        replay = graze.Recording(self.file).replay(threads=1)
        with self.assertRaises(graze.Error):
            replay.objects
        seen = 0
        for report, (contacts, distances) in zip(replay, self.said):
            np.testing.assert_array_equal(report.contacts, contacts)
            np.testing.assert_array_equal(report.pairs["distance"], distances)
            self.assertEqual((replay.frame_index, replay.difference), (seen, None))
            plate, ball = replay.objects
            self.assertEqual((plate.settings.name, ball.settings.name, ball.settings.user_data), ("plate", "ball", 5))
            self.assertEqual((plate.serial, ball.serial), (0, 1))
            np.testing.assert_array_equal(replay.positions(ball), BALL_POINTS + [0.01, 0.02, heights(seen)])
            np.testing.assert_array_equal(replay.pose(plate), np.eye(4))
            np.testing.assert_array_equal(ball.mesh.faces, BALL_FACES)
            seen += 1
        self.assertEqual(seen, FRAMES)
        with self.assertRaises(StopIteration):
            next(replay)

    def test_objects_of_an_earlier_frame_are_refused(self):
        replay = graze.Recording(self.file).replay(first_frame=3)
        next(replay)
        self.assertEqual(replay.frame_index, 3)
        ball = replay.objects[1]
        next(replay)
        with self.assertRaisesRegex(graze.Error, "earlier frame"):
            replay.positions(ball)

    def test_parts_are_cut_out(self):
        part = self.folder / "part.graze"
        graze.Recording(self.file).cut(part, 2, 6, objects=[1])
        with graze.Recording(part) as recording:
            self.assertEqual((len(recording), recording.is_cut), (5, True))
            replay = recording.replay()
            next(replay)
            self.assertEqual([object.settings.name for object in replay.objects], ["ball"])

    def test_a_ring_keeps_the_last_frames(self):
        file = self.folder / "last.graze"
        with graze.Scene(SETTINGS) as scene:
            with graze.Recorder(scene, frames=4, keyframe_interval=2) as recorder:
                play(scene)
                written = recorder.write(file)
        with graze.Recording(file) as recording:
            self.assertEqual(len(recording), written.frames)
            self.assertGreaterEqual(len(recording), 4)
            self.assertLess(len(recording), FRAMES)
            self.assertEqual(recording.frames[-1].tag, FRAMES - 1)

    def test_what_cannot_be_is_refused(self):
        wrong = self.folder / "wrong.graze"
        wrong.write_bytes(self.file.read_bytes()[:40] + b"nonsense" * 20)
        with graze.Scene() as scene:
            for call in (lambda: graze.Recording(self.folder / "none.graze"), lambda: graze.Recording(wrong),
                         lambda: graze.Recorder(scene, self.folder / "none" / "x.graze"),
                         lambda: graze.Recorder(scene, keyframe_interval=0),
                         lambda: graze.Recording(self.file).replay(first_frame=FRAMES)):
                with self.assertRaises(graze.Error):
                    call()

    def test_info_prints_the_frames(self):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.assertEqual(program.main(["info", str(self.file)]), 0)
        lines = printed.getvalue().splitlines()
        self.assertIn(f"{FRAMES} frames, 2 meshes", lines[0])
        self.assertEqual([int(line.split()[3]) for line in lines[2:]], [len(contacts) for contacts, _ in self.said])
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(program.main(["info", str(self.folder / "none.graze")]), 1)
        self.assertIn("none.graze", said.getvalue())

    def test_view_runs_the_program(self):
        stand_in = self.folder / "graze"
        stand_in.write_text('#!/bin/sh\necho "$@" > "$(dirname "$0")/called"\nexit 3\n')
        stand_in.chmod(stand_in.stat().st_mode | stat.S_IXUSR)
        with mock.patch.dict(os.environ, {"PATH": f"{self.folder}:{os.environ['PATH']}"}):
            self.assertEqual(program.main(["view", str(self.file), "-o", "x.html"]), 3)
        self.assertEqual((self.folder / "called").read_text().split(), ["view", str(self.file), "-o", "x.html"])
        with mock.patch.dict(os.environ, {"PATH": ""}), contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(program.main(["view", str(self.file)]), 1)
        self.assertIn("not on the path", said.getvalue())

    def test_the_example_finds_the_worst_penetration(self):
        table = self.folder / "worst.csv"
        done = subprocess.run([sys.executable, ROOT / "tools/python/examples/worst_penetration.py", self.file,
                               "--csv", table], capture_output=True, text=True, check=True)
        deepest = [min(0.0, *graze.separations(contacts)) if len(contacts) else 0.0 for contacts, _ in self.said]
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        np.testing.assert_allclose(rows[:, 1], deepest, rtol=1e-6)
        worst = int(np.argmin(deepest))
        self.assertLess(deepest[worst], -0.05)
        self.assertIn(f"frame {worst + 1}", done.stdout.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
