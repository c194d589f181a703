"""Reports: arrays over the library's memory that own it, copies, pickling."""

import gc
import pickle
import unittest

import numpy as np

import graze
import shapes

BALL_POINTS, BALL_FACES = shapes.sphere(2)


def reported(**settings):
    """Returns the report of two balls that pass through each other, and their ids. The scene is gone."""
    ball = graze.Mesh(BALL_POINTS, BALL_FACES)
    with graze.Scene(contact_distance=0.1, range=1, region_distances=1000, **settings) as scene:
        a = scene.add(ball, name="a", user_data=11, queries=True, swept=True)
        b = scene.add(ball, name="b", user_data=22, queries=True)
        far = scene.add(ball, queries=True, motion=graze.Motion.RIGID)
        pose = np.eye(4)
        pose[1, 3] = 100
        scene.set_pose(far, pose)
        scene.set_positions(b, (BALL_POINTS + [1.9, 0, 0]).astype(np.float32))
        scene.step()
        scene.set_positions(a, BALL_POINTS + [0.2, 0.1, 0])
        scene.set_positions(b, (BALL_POINTS + [1.5, 0, 0]).astype(np.float32))
        scene.ignore(graze.ObjectId(99, 9), b)
        return scene.step(5), (a, b, far)


ARRAYS = ("pairs", "contacts", "region_distances", "impacts")


class ReportTest(unittest.TestCase):
    def test_rows_say_what_they_are_about(self):
        report, (a, b, _) = reported()
        self.assertEqual((report.frame, report.tag, report.complete, len(report.pairs)), (2, 5, True, 1))
        pair = report.pairs[0]
        self.assertEqual((tuple(pair["a"]), tuple(pair["b"])), (a, b))
        self.assertEqual((pair["user_data_a"], pair["user_data_b"]), (11, 22))
        self.assertEqual((len(report.contacts_of(0)), len(report.impacts_of(0)), len(report.region_distances_of(0))),
                         tuple(int(pair[name]) for name in ("contact_count", "impact_count", "region_distance_count")))
        self.assertGreater(len(report.impacts), 0)
        self.assertTrue((report.contacts["since"] <= 2).all())
        self.assertEqual([problem.kind for problem in report.diagnostics], [graze.DiagnosticKind.STALE_ID])
        self.assertIn("99", report.diagnostics[0].message)

    def test_points_of_contacts_lie_on_their_features(self):
        report, (a, b, _) = reported()
        at_a, at_b = report.positions(a), report.positions(b)
        for contact in report.contacts[:200]:
            for feature, point, at in (("feature_a", "point_a", at_a), ("feature_b", "point_b", at_b)):
                kind, index = contact[feature].item()
                corners = np.asarray([[index]] if kind == 0 else
                                     report.mesh(a).edges[[index]] if kind == 1 else BALL_FACES[[index]])
                corners = np.asarray(at, float)[corners[0]]
                corners = np.concatenate([corners, corners, corners])[:3] if len(corners) < 3 else corners
                distance = (np.linalg.norm(corners[0] - contact[point]) if kind == 0 else
                            shapes.to_segments(contact[point][None], corners[:1], corners[1:2])[0, 0] if kind == 1 else
                            shapes.to_triangles(contact[point][None], corners[None])[0, 0])
                self.assertLess(distance, 1e-12)
            gap = np.linalg.norm(contact["point_b"] - contact["point_a"])
            self.assertAlmostEqual(gap, contact["distance"], delta=1e-12)

    def test_statistics_agree_with_the_rows(self):
        report, _ = reported()
        counted = report.statistics
        self.assertEqual((counted["objects"], counted["pairs_total"], counted["pairs_near"]), (3, 3, 1))
        self.assertEqual(counted["contacts"], len(report.contacts))
        self.assertEqual(counted["region_distances"], len(report.region_distances))
        self.assertEqual(counted["impacts"], len(report.impacts))
        self.assertGreater(counted["step_ms"], 0)
        self.assertLessEqual(counted["read_ms"], counted["step_ms"])

    def test_arrays_are_read_only_views_that_are_not_copied(self):
        report, (a, _, _) = reported()
        for name in ARRAYS:
            array = getattr(report, name)
            self.assertFalse(array.flags.owndata, name)
            with self.assertRaises(ValueError):
                array[0] = 0
            again = getattr(report, name)
            self.assertEqual(array.ctypes.data, again.ctypes.data)
        self.assertFalse(report.positions(a).flags.writeable)

    def test_arrays_keep_the_report_alive(self):
        report, (a, b, _) = reported()
        expected = [np.array(getattr(report, name)) for name in ARRAYS]
        views = [getattr(report, name)[:] for name in ARRAYS]
        distances, at = report.contacts["distance"][::2], report.positions(b)
        twice = np.array(distances)
        del report
        gc.collect()
        # Another scene would fill memory that was let go of.
        others = [reported()[0] for _ in range(5)]
        for view, array in zip(views, expected):
            np.testing.assert_array_equal(view, array)
        np.testing.assert_array_equal(distances, twice)
        np.testing.assert_array_equal(at, (BALL_POINTS + [1.5, 0, 0]).astype(np.float32))
        self.assertEqual(len(others), 5)

    def test_a_report_is_filled_again_only_after_its_arrays_are_gone(self):
        ball = graze.Mesh(BALL_POINTS, BALL_FACES)
        with graze.Scene(contact_distance=0.1) as scene:
            _, b = scene.add(ball), scene.add(ball)
            kept, expected = [], []
            for step in range(10):
                scene.set_positions(b, BALL_POINTS + [1.9 - 0.05 * step, 0, 0])
                kept.append(scene.step().contacts)
                expected.append(np.array(kept[-1]))
            for view, array in zip(kept, expected):
                np.testing.assert_array_equal(view, array)
            self.assertGreater(len(kept[9]), len(kept[1]))

    def test_mesh_and_positions_are_those_of_the_step(self):
        report, (a, b, far) = reported()
        np.testing.assert_array_equal(report.positions(a), BALL_POINTS + [0.2, 0.1, 0])
        self.assertEqual(report.positions(b).dtype, np.float32)
        np.testing.assert_array_equal(report.mesh(b).faces, BALL_FACES)
        self.assertEqual(report.positions(far)[:, 1].max(), 101)
        self.assertIsNone(report.mesh(graze.ObjectId(4, 4)))
        self.assertIsNone(report.positions(graze.ObjectId(4, 4)))


class CopyTest(unittest.TestCase):
    def check_same(self, one, two, objects):
        self.assertEqual((one.frame, one.tag, one.complete), (two.frame, two.tag, two.complete))
        for name in ARRAYS:
            np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
            self.assertFalse(getattr(two, name).flags.writeable)
        self.assertEqual(one.diagnostics, two.diagnostics)
        self.assertEqual(one.statistics, two.statistics)
        for object in objects:
            np.testing.assert_array_equal(one.positions(object), two.positions(object))
            np.testing.assert_array_equal(one.mesh(object).faces, two.mesh(object).faces)
        np.testing.assert_array_equal(one.contacts_of(0), two.contacts_of(0))

    def test_copies_and_pickles_say_the_same(self):
        report, objects = reported()
        copy = report.copy()
        self.check_same(report, copy, objects)
        self.check_same(report, pickle.loads(pickle.dumps(copy)), objects)
        self.check_same(report, pickle.loads(pickle.dumps(report)), objects)
        self.assertNotEqual(report.contacts.ctypes.data, copy.contacts.ctypes.data)
        self.assertEqual(copy.copy().frame, 2)

    def test_copies_without_geometry_pickle_too(self):
        box = graze.Mesh(*shapes.box())
        with graze.Scene(range=1) as scene:
            a = scene.add(box)
            scene.add(box)
            copy = scene.step().copy()
        again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(copy))))
        self.assertEqual((len(again.pairs), again.mesh(a)), (1, None))

    def test_no_question_about_an_unpickled_report(self):
        report, _ = reported()
        for other in (report.copy(), pickle.loads(pickle.dumps(report))):
            with self.assertRaises(graze.Error):
                graze.SceneQuery(other)

    def test_settings_pickle(self):
        for value in (graze.SceneSettings(accuracy=graze.Accuracy.paper([1, 2])), graze.ObjectSettings(name="x"),
                      graze.PairRule(range=1), graze.QuerySettings(), graze.QueryFilter(), graze.RecorderSettings(),
                      graze.SceneCapacity(3), graze.ObjectId(1, 2), graze.Feature(graze.FeatureKind.EDGE, 3)):
            self.assertEqual(pickle.loads(pickle.dumps(value)), value)


if __name__ == "__main__":
    unittest.main()
