"""Patches between steps: they say what a scene says of the same place."""

import unittest

import graze
import numpy as np

import shapes

BALL_POINTS, BALL_FACES = shapes.sphere(2)
BALL = graze.Mesh(0.5 * BALL_POINTS, BALL_FACES)
BOX = graze.Mesh(*shapes.box())


class PatchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = graze.Scene(detail=graze.ContactDetail.NEAREST, contact_distance=0.25)
        cls.box = cls.scene.add(BOX, solid=True)
        cls.tool = cls.scene.add(BALL, motion=graze.Motion.RIGID, patch_radius=2.0)
        cls.scene.set_pose(cls.tool, at(1.5))
        cls.report = cls.scene.step()

    def truth(self, pose):
        """Returns the contacts of a scene whose tool is at a pose."""
        with graze.Scene(detail=graze.ContactDetail.NEAREST, contact_distance=0.25) as scene:
            scene.add(BOX, solid=True)
            scene.set_pose(scene.add(BALL, motion=graze.Motion.RIGID), pose)
            return np.array(scene.step().contacts)

    def test_contacts_are_those_of_a_scene(self):
        patch = self.report.patch(self.tool)
        for height in (1.25, 1.0, 0.75):
            pose = at(height)
            expected = self.truth(pose)
            expected["since"] = 0
            moved = np.asarray(BALL.rest) + [0, 0, height]
            for answer in (patch.contacts(threshold=0.25, pose=pose), patch.contacts(threshold=0.25, positions=moved)):
                self.assertTrue(answer.complete)
                self.assertEqual(answer.threshold, 0.25)
                np.testing.assert_array_equal(answer.contacts, expected)
                self.assertEqual(sum(len(answer.contacts_of(pair)) for pair in range(len(answer.pairs))),
                                 len(expected))
            self.assertEqual(answer.validity, patch.validity(positions=moved, threshold=0.25))
        self.assertGreater(len(expected), 0)

    def test_what_a_patch_has(self):
        patch = self.report.patch(self.tool)
        self.assertEqual((patch.tool, patch.radius, patch.is_cut), (self.tool, 2.0, False))
        self.assertEqual(patch.objects, (self.box,))
        np.testing.assert_array_equal(patch.faces(self.box), np.arange(patch.face_count))
        np.testing.assert_array_equal(patch.positions(self.box), BOX.rest)
        self.assertIsNone(patch.positions(self.tool))
        self.assertIsNone(self.report.patch(self.box))
        self.assertEqual(self.report.copy().patch(self.tool).face_count, patch.face_count)

    def test_validity_ends_where_the_tool_is_far(self):
        patch = self.report.patch(self.tool)
        self.assertAlmostEqual(patch.validity(pose=at(1.25)), 2.0 - 0.25 - 0.25, places=12)
        self.assertEqual(patch.validity(pose=at(9)), 0.0)
        answer = patch.contacts(threshold=0.25, pose=at(9))
        self.assertFalse(answer.complete)
        self.assertLess(answer.threshold, 0)
        self.assertEqual(len(answer.contacts), 0)

    def test_mistakes(self):
        patch = self.report.patch(self.tool)
        with self.assertRaises(graze.Error):
            patch.contacts(threshold=0.25)
        with self.assertRaises(graze.Error):
            patch.contacts(threshold=-1, pose=at(1))
        with self.assertRaises(graze.Error):
            patch.validity(positions=[[0, 0, 0]])


def at(height):
    pose = np.eye(4)
    pose[2, 3] = height
    return pose


if __name__ == "__main__":
    unittest.main()
