"""Scenes: distances and contacts against brute force in numpy, filters, rules, steps, errors."""

import threading
import time
import unittest

import numpy as np

import graze
import shapes
from graze import ContactDetail, DiagnosticKind, Motion, PairPhase

SPHERE = shapes.sphere(2)
BOX_POINTS, BOX_QUADS = shapes.box((0.7, 0.4, 0.5))
BOX_TRIANGLES = shapes.triangulated(BOX_QUADS)


def scene_of(*meshes, motion=Motion.RIGID, **settings):
    scene = graze.Scene(**settings)
    return scene, [scene.add(mesh, name=f"object {i}", motion=motion) for i, mesh in enumerate(meshes)]


class DistanceTest(unittest.TestCase):
    def test_distances_of_boxes_and_spheres_are_those_of_brute_force(self):
        random = np.random.default_rng(7)
        ball, brick = graze.Mesh(*SPHERE), graze.Mesh(BOX_POINTS, BOX_TRIANGLES)
        scene, (a, b, c) = scene_of(ball, brick, brick, range=np.inf)
        with scene:
            for frame in range(20):
                poses = [shapes.rotation(random.normal(size=3), random.uniform(0, 3)) for _ in range(3)]
                for pose, at in zip(poses, ((0, 0, 0), (3, 0, 0), (0, 3, 0))):
                    pose[:3, 3] = at + random.uniform(-0.3, 0.3, 3)
                scene.set_poses([a, b, c], poses)
                report = scene.step(frame)
                self.assertEqual((report.tag, len(report.pairs), report.diagnostics), (frame, 3, []))
                shown = {a: SPHERE, b: (BOX_POINTS, BOX_TRIANGLES), c: (BOX_POINTS, BOX_TRIANGLES)}
                at = {object: shapes.moved(shown[object][0], pose) for object, pose in zip((a, b, c), poses)}
                for row in report.pairs:
                    one, two = tuple(row["a"]), tuple(row["b"])
                    expected = shapes.surface_distance(at[one], shown[one][1], at[two], shown[two][1])
                    self.assertAlmostEqual(row["distance"]["lower"], expected, delta=1e-12)
                    self.assertLessEqual(row["distance"]["lower"], row["distance"]["upper"])
                    gap = row["witness"]["point_b"] - row["witness"]["point_a"]
                    self.assertAlmostEqual(np.linalg.norm(gap), expected, delta=1e-12)

    def test_contacts_of_nearest_are_those_of_each_vertex(self):
        floor = graze.Mesh([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], [[0, 1, 2, 3]])
        scene, (_, ball) = scene_of(floor, graze.Mesh(*SPHERE), contact_distance=0.25, detail=ContactDetail.NEAREST)
        with scene:
            pose = shapes.rotation((1, 2, 3), 0.3)
            pose[2, 3] = 1.1
            scene.set_pose(ball, pose)
            report = scene.step()
        height = shapes.moved(SPHERE[0], pose)[:, 2]
        contacts = report.contacts_of(0)
        vertices = contacts[contacts["kind"] == graze.ContactKind.VF]
        self.assertGreater(len(vertices), 3)
        np.testing.assert_array_equal(np.sort(vertices["feature_b"]["index"]), np.flatnonzero(height < 0.25))
        np.testing.assert_allclose(vertices["distance"], height[vertices["feature_b"]["index"]], atol=1e-14)
        np.testing.assert_allclose(vertices["normal"], [[0, 0, 1]] * len(vertices), atol=1e-12)
        np.testing.assert_allclose(vertices["point_a"][:, 2], 0, atol=1e-15)
        self.assertTrue((vertices["side_a"] == graze.Side.FRONT).all())

    def test_phases_pass_from_near_to_ended(self):
        box = graze.Mesh(*shapes.box())
        scene, (_, moving) = scene_of(box, box, contact_distance=0.1, range=1)
        phases = []
        with scene:
            for x in (2.5, 2.05, 2.05, 2.5, 4):
                pose = np.eye(4)
                pose[0, 3] = x
                scene.set_pose(moving, pose)
                phases.append([PairPhase(phase).name for phase in scene.step().pairs["phase"]])
        self.assertEqual(phases, [["NEAR"], ["BEGAN"], ["TOUCHING"], ["ENDED"], []])


class PoseTest(unittest.TestCase):
    def distance(self, pose):
        scene, (_, moving) = scene_of(graze.Mesh(*shapes.box()), graze.Mesh(*shapes.box()), range=100)
        with scene:
            scene.set_pose(moving, shapes.rotation((0, 0, 1), 0)[:3])
            scene.set_pose(moving, pose)
            return scene.step().pairs["distance"]["upper"]

    def test_poses_of_all_shapes(self):
        pose = np.eye(4)
        pose[:3, 3] = 5, 0, 0
        self.assertEqual(self.distance(pose), [3])
        self.assertEqual(self.distance(pose[:3]), [3])
        self.assertEqual(self.distance(pose.tolist()), [3])
        self.assertEqual(self.distance(np.asfortranarray(pose.astype(np.float32))), [3])
        self.assertEqual(self.distance(np.eye(3)), [0])
        with self.assertRaises(graze.Error):
            self.distance(np.eye(2))

    def test_bad_poses_and_wrong_motions_are_diagnostics(self):
        scene, (a,) = scene_of(graze.Mesh(*shapes.box()))
        with scene:
            scene.set_pose(a, np.diag([2.0, 1, 1, 1]))
            scene.set_positions(a, BOX_POINTS)
            scene.set_pose(graze.ObjectId(55, 3), np.eye(4))
            kinds = {problem.kind for problem in scene.step().diagnostics}
            self.assertEqual(kinds, {DiagnosticKind.BAD_POSE, DiagnosticKind.WRONG_MOTION, DiagnosticKind.STALE_ID})
            scene.set_poses([a], [np.eye(4)])
            self.assertEqual(scene.step().diagnostics, [])
            with self.assertRaises(graze.Error):
                scene.set_poses([a], np.eye(4))

    def test_a_teleport_sweeps_nothing(self):
        wall = graze.Mesh([[0, -5, -5], [0, 5, -5], [0, 5, 5], [0, -5, 5]], [[0, 1, 2, 3]])
        counts = []
        for teleport in (False, True):
            with graze.Scene() as scene:
                scene.add(wall, motion=Motion.FIXED)
                shot = scene.add(graze.Mesh(*shapes.box((0.1, 0.1, 0.1))), motion=Motion.RIGID, swept=True)
                for x in (-3, 3):
                    pose = np.eye(4)
                    pose[0, 3] = x
                    scene.set_pose(shot, pose, teleport=teleport)
                    report = scene.step()
            counts.append(len(report.impacts))
            if not teleport:
                first = report.impacts_of(0)[0]
                self.assertLessEqual(first["lower"], 2.9 / 6)
                self.assertGreaterEqual(first["upper"], 2.9 / 6 - 1e-6)
        self.assertEqual((counts[0] > 0, counts[1]), (True, 0))


class FilterTest(unittest.TestCase):
    def setUp(self):
        box = graze.Mesh(*shapes.box())
        self.scene, (self.a, self.b) = scene_of(box, box, contact_distance=0.01)
        self.addCleanup(self.scene.close)

    def in_contact(self):
        return [pair["phase"] in (PairPhase.BEGAN, PairPhase.TOUCHING) for pair in self.scene.step().pairs]

    def test_ignore_and_watch(self):
        self.assertEqual(self.in_contact(), [True])
        self.scene.ignore(self.a, self.b)
        self.assertEqual(self.in_contact(), [False])
        self.scene.watch(self.b, self.a)
        self.assertEqual(self.in_contact(), [True])
        self.scene.ignore_groups(self.a, 0, self.b, 0)
        self.assertEqual(self.in_contact(), [False])
        self.scene.watch_groups(self.a, 0, self.b, 0)
        self.assertEqual(self.in_contact(), [True])

    def test_rules(self):
        pose = np.eye(4)
        pose[0, 3] = 2.5
        self.scene.set_pose(self.b, pose)
        self.assertEqual(self.in_contact(), [])
        self.scene.set_rule(0, 0, graze.PairRule(contact_distance=0.6))
        self.assertEqual(self.in_contact(), [True])
        self.scene.set_rule(0, 0, None)
        self.assertEqual(self.in_contact(), [False])

    def test_objects_come_and_go(self):
        self.assertEqual((len(self.scene), self.a in self.scene), (2, True))
        self.assertEqual(self.scene.mesh(self.a).face_count, 6)
        self.scene.remove(self.a)
        self.assertEqual((len(self.scene), self.a in self.scene, self.scene.mesh(self.a)), (1, False, None))
        self.assertEqual(self.scene.name(self.b), "object 1")

    def test_replaced_mesh(self):
        smaller = graze.Mesh(*shapes.box((0.5, 0.5, 0.5)))
        self.in_contact()
        with self.assertRaises(graze.Error):
            self.scene.replace_mesh(self.b, smaller, range(3))
        self.scene.replace_mesh(self.b, smaller, range(8))
        self.scene.set_rule(0, 0, graze.PairRule(range=10))
        np.testing.assert_allclose(self.scene.step().pairs["distance"]["upper"], 0.5)
        self.assertIs(self.scene.mesh(self.b), smaller)


class StepTest(unittest.TestCase):
    def test_steps_on_another_thread(self):
        box = graze.Mesh(*shapes.box())
        scene, _ = scene_of(box, box, range=1)
        with scene:
            self.assertEqual(scene.latest_report().frame, 0)
            scene.step_async(2**64 - 1)
            report = scene.wait()
            self.assertEqual((report.frame, report.tag, scene.is_stepping), (1, 2**64 - 1, False))
            self.assertEqual(scene.latest_report().frame, 1)
            scene.reserve(objects=10, contacts=100)

    def test_other_threads_of_python_run_during_a_step(self):
        points, faces = shapes.sphere(5)
        ball = graze.Mesh(points, faces)
        scene, (_, b) = scene_of(ball, ball, contact_distance=0.05, threads=1)
        stamps, during = [], 0
        stop = threading.Event()

        def count():
            while not stop.is_set():
                stamps.append(time.perf_counter())
                time.sleep(1e-4)

        with scene:
            other = threading.Thread(target=count)
            other.start()
            for turn in range(50):  # a busy machine may leave the other thread no time in the first ones
                scene.set_pose(b, shapes.rotation((1, 2, 3), 0.01 * turn))
                began = time.perf_counter()
                report = scene.step()
                ended = time.perf_counter()
                during = max(during, sum(began < stamp < ended for stamp in list(stamps)))
                if during > 3:
                    break
            stop.set()
            other.join()
        self.assertGreater(len(report.contacts), 1000)
        self.assertGreater(during, 3)  # without the lock given up, at most one stamp lies inside the call

    def test_wrong_settings_and_numbers_are_refused(self):
        box = graze.Mesh(*shapes.box())
        for settings in ({"contact_distance": -1.0}, {"max_contacts": 0}, {"threads": -1}, {"max_contacts": -1},
                         {"region_distances": 1.5}, {"accuracy": graze.Accuracy.within(-1.0)}):
            with self.subTest(settings), self.assertRaises(graze.Error):
                graze.Scene(**settings)
        with self.assertRaises(ValueError):
            graze.Scene(detail=17)
        with self.assertRaises(TypeError):
            graze.Scene(no_such_setting=1)
        with self.assertRaises(TypeError):
            graze.Scene(graze.SceneSettings(), range=1.0)
        with graze.Scene() as scene:
            for settings in ({"kind": 256}, {"layer": -1}, {"margin": -1.0}, {"face_groups": [0, 1]},
                             {"face_groups": [256] * 6}, {"name": "a\0b"}, {"user_data": 2**64}):
                with self.subTest(settings), self.assertRaises(graze.Error):
                    scene.add(box, **settings)
            with self.assertRaises(graze.Error):
                scene.add(graze.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), solid=True)
            with self.assertRaises(graze.Error):
                scene.step(-1)
            self.assertEqual(len(scene), 0)

    def test_a_closed_scene_says_so(self):
        scene, (a, _) = scene_of(graze.Mesh(*shapes.box()), graze.Mesh(*shapes.box()))
        report = scene.step()
        scene.close()
        scene.close()
        self.assertEqual(report.frame, 1)
        for call in (scene.step, scene.wait, lambda: scene.set_pose(a, np.eye(4)), lambda: len(scene)):
            with self.assertRaisesRegex(graze.Error, "closed"):
                call()


if __name__ == "__main__":
    unittest.main()
