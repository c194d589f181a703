"""Separations, pushes, contacts at other positions and weights, against numpy."""

import unittest

import numpy as np

import graze
import shapes
from graze import ContactKind, FeatureKind

FLOOR_POINTS = np.array([[-5.0, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]])
FLOOR = graze.Mesh(FLOOR_POINTS, [[0, 1, 2], [0, 2, 3]])
BALL_POINTS, BALL_FACES = shapes.sphere(2)
BALL = graze.Mesh(BALL_POINTS, BALL_FACES)


def answer(height):
    return graze.query(FLOOR, None, BALL, BALL_POINTS + [0.3, 0.1, height], contact_distance=0.2,
                       detail=graze.ContactDetail.NEAREST)


class ResponseTest(unittest.TestCase):
    def test_separations_and_pushes_are_those_of_a_plane(self):
        contacts = answer(0.95).contacts
        vertices = contacts[(contacts["kind"] == ContactKind.VF)]
        heights = (BALL_POINTS[:, 2] + 0.95)[vertices["feature_b"]["index"]]
        self.assertTrue((heights < 0).any() and (heights > 0).any())
        np.testing.assert_allclose(graze.separations(vertices), heights, atol=1e-14)
        np.testing.assert_allclose(graze.pushes(vertices), [[0, 0, 1]] * len(vertices), atol=1e-12)
        one = graze.separations(vertices[0])
        self.assertEqual((one.shape, one[0]), ((1,), graze.separations(vertices)[0]))

    def test_evaluate_follows_contacts_to_other_positions(self):
        contacts = answer(1.05).contacts
        vertices = contacts[contacts["kind"] == ContactKind.VF]
        down = (BALL_POINTS + [0.3, 0.1, 0.9]).astype(np.float32)
        found = graze.evaluate(FLOOR, FLOOR_POINTS, BALL, down, vertices)
        heights = down[vertices["feature_b"]["index"], 2]
        np.testing.assert_allclose(found["separation"], heights, atol=1e-14)
        self.assertLess(found["separation"].min(), 0)
        np.testing.assert_allclose(found["push"], [[0, 0, 1]] * len(found), atol=1e-12)
        np.testing.assert_allclose(found["point_b"], down[vertices["feature_b"]["index"]])
        self.assertEqual(found.dtype["side_a"], np.uint8)
        self.assertTrue(found["is_interior"].any())

    def test_follow_goes_over_to_other_faces(self):
        contacts = answer(1.05).contacts
        vertices = contacts[contacts["kind"] == ContactKind.VF]
        away = BALL_POINTS + [-2.0, 3.0, 1.05]
        found = graze.follow(FLOOR, FLOOR_POINTS, BALL, away, vertices)
        self.assertTrue(found["is_known"].all())
        over_second = away[vertices["feature_b"]["index"], 1] > away[vertices["feature_b"]["index"], 0]
        self.assertTrue(over_second.all() and (found["feature_a"]["index"] == 1).all())
        np.testing.assert_allclose(found["geometry"]["separation"], away[vertices["feature_b"]["index"], 2], atol=1e-14)

    def test_two_features(self):
        found = graze.evaluate_features(FLOOR, FLOOR_POINTS, (FeatureKind.FACE, 0), BALL, BALL_POINTS + [1, -1, 3],
                                        graze.Feature(FeatureKind.VERTEX, 5))
        np.testing.assert_allclose(found["point_b"], BALL_POINTS[5] + [1, -1, 3])
        self.assertAlmostEqual(found["distance"], BALL_POINTS[5, 2] + 3)

    def test_weights_give_the_point(self):
        at = np.array([1.0, -2.0, 0.0])
        vertices, weights = graze.weights(FLOOR, FLOOR_POINTS, (FeatureKind.FACE, 0), at)
        np.testing.assert_allclose(weights @ FLOOR_POINTS[vertices], at, atol=1e-12)
        self.assertAlmostEqual(weights.sum(), 1)
        vertices, weights = graze.weights(FLOOR, FLOOR_POINTS, (FeatureKind.VERTEX, 2), at)
        self.assertEqual((list(vertices), list(weights)), ([2], [1]))

    def test_normal_cones(self):
        points, quads = shapes.box()
        box = graze.Mesh(points, quads)
        corner = (FeatureKind.VERTEX, 7)  # (1, 1, 1)
        self.assertTrue(graze.in_normal_cone(box, points, corner, [1, 1, 1]))
        self.assertFalse(graze.in_normal_cone(box, points, corner, [-1, 0, 0]))

    def test_wrong_arguments(self):
        contacts = answer(1.05).contacts
        for call in (lambda: graze.separations(np.zeros(3)),
                     lambda: graze.evaluate(FLOOR, FLOOR_POINTS[:3], BALL, BALL_POINTS, contacts),
                     lambda: graze.evaluate(BALL, BALL_POINTS, FLOOR, FLOOR_POINTS, contacts),
                     lambda: graze.weights(FLOOR, FLOOR_POINTS, (FeatureKind.FACE, 2), [0, 0, 0]),
                     lambda: graze.weights(FLOOR, FLOOR_POINTS, (FeatureKind.FACE, 0), [0, 0])):
            with self.assertRaises(graze.Error):
                call()


if __name__ == "__main__":
    unittest.main()
