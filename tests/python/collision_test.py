"""CollisionManager: the calls and the shapes of answers of trimesh's, and distances against brute force."""

import inspect
import math
import types
import unittest

import numpy as np

import graze
import shapes

BALL_POINTS, BALL_FACES = shapes.sphere(2)
BOX_POINTS, BOX_QUADS = shapes.box()
BOX_TRIANGLES = shapes.triangulated(BOX_QUADS)
# Code that calls trimesh gives objects with these two members.
BOX = types.SimpleNamespace(vertices=BOX_POINTS, faces=BOX_TRIANGLES)
BALL = types.SimpleNamespace(vertices=BALL_POINTS, faces=BALL_FACES)

# The parameters of trimesh.collision.CollisionManager, after self.
SIGNATURES = {
    "__init__": [], "add_object": ["name", "mesh", "transform"], "remove_object": ["name"],
    "set_transform": ["name", "transform"],
    "in_collision_single": ["mesh", "transform", "return_names", "return_data"],
    "in_collision_internal": ["return_names", "return_data"],
    "in_collision_other": ["other_manager", "return_names", "return_data"],
    "min_distance_single": ["mesh", "transform", "return_name", "return_data"],
    "min_distance_internal": ["name", "return_names", "return_data"],
    "min_distance_other": ["other_manager", "return_names", "return_data"]}


def at(x, y=0.0, z=0.0, turn=0.0):
    pose = shapes.rotation((1, 2, 3), turn)
    pose[:3, 3] = x, y, z
    return pose


class CollisionTest(unittest.TestCase):
    def setUp(self):
        self.manager = graze.CollisionManager()
        self.manager.add_object("box", BOX)
        self.manager.add_object("ball", BALL, at(1.5))
        self.manager.add_object("far", BOX, at(9))

    def test_signatures_are_those_of_trimesh(self):
        for name, parameters in SIGNATURES.items():
            found = inspect.signature(getattr(graze.CollisionManager, name)).parameters
            self.assertEqual(list(found)[1:], parameters)
        self.assertIs(inspect.signature(graze.CollisionManager.add_object).parameters["transform"].default, None)

    def test_internal(self):
        self.assertIs(self.manager.in_collision_internal(), True)
        self.assertEqual(self.manager.in_collision_internal(return_names=True), (True, {("ball", "box")}))
        hit, data = self.manager.in_collision_internal(return_data=True)
        self.assertTrue(hit and all(contact.names == {"ball", "box"} for contact in data))
        self.assertEqual(len(self.manager.in_collision_internal(True, True)), 3)
        self.manager.set_transform("ball", at(5))
        self.assertEqual(self.manager.in_collision_internal(True, True), (False, set(), []))
        self.manager.set_transform("far", at(5.5))
        self.assertEqual(self.manager.in_collision_internal(True)[1], {("ball", "far")})

    def test_surfaces_that_touch_collide_and_one_inside_does_not(self):
        self.manager.remove_object("ball")
        self.manager.set_transform("far", at(2))
        self.assertTrue(self.manager.in_collision_internal())
        self.manager.set_transform("far", at(2 + 1e-9))
        self.assertFalse(self.manager.in_collision_internal())
        small = types.SimpleNamespace(vertices=BALL_POINTS / 4, faces=BALL_FACES)
        self.assertEqual(self.manager.in_collision_single(small, return_names=True), (False, set()))
        self.assertAlmostEqual(self.manager.min_distance_single(small), 0.75)

    def test_contact_data(self):
        _, data = self.manager.in_collision_internal(return_data=True)
        inside = (np.abs(BALL_POINTS + [1.5, 0, 0]) < 1).all(1)
        depths = 1 - (BALL_POINTS + [1.5, 0, 0])[inside, 0]
        deep = [contact for contact in data if contact.depth > 0]
        np.testing.assert_allclose(sorted(contact.depth for contact in deep), sorted(depths), atol=1e-12)
        for contact in deep:
            self.assertAlmostEqual(contact.point[0], 1)  # on the box, whose side is nearest
            np.testing.assert_allclose(np.abs(contact.normal), [1, 0, 0], atol=1e-12)
            corners = BOX_POINTS[BOX_TRIANGLES[contact.index("box")]]
            self.assertLess(shapes.to_triangles(contact.point[None], corners[None])[0, 0], 1e-9)
            self.assertLess(contact.index("ball"), len(BALL_FACES))

    def test_single(self):
        self.assertIs(self.manager.in_collision_single(BALL, at(20)), False)
        self.assertEqual(self.manager.in_collision_single(BALL, at(8), return_names=True), (True, {"far"}))
        ball = graze.Mesh(BALL_POINTS, BALL_FACES)
        hit, names, data = self.manager.in_collision_single(ball, at(0.9, 0.4), True, True)
        self.assertEqual((hit, names), (True, {"box", "ball"}))
        self.assertEqual({frozenset(contact.names) for contact in data},
                         {frozenset(("box", "__external")), frozenset(("ball", "__external"))})
        self.assertIs(self.manager.in_collision_single(BALL, at(20)), False)  # nothing is left of the last one
        self.assertEqual(self.manager.in_collision_internal(True), (True, {("ball", "box")}))

    def test_other(self):
        other = graze.CollisionManager()
        other.add_object("box", BOX, at(9, 1.5))
        other.add_object("beside", BOX, at(9, 2.5))  # touches the other one of its own manager
        self.assertEqual(self.manager.in_collision_other(other, True), (True, {("far", "box")}))
        self.assertEqual(other.in_collision_other(self.manager, True), (True, {("box", "far")}))
        self.assertEqual(len(self.manager.in_collision_other(other, True, True)), 3)
        other.set_transform("box", at(9, 7))
        distance, names, data = self.manager.min_distance_other(other, True, True)
        self.assertAlmostEqual(distance, 0.5)
        self.assertEqual((names, data.names), (("far", "beside"), {"far", "beside"}))

    def test_distances_are_those_of_brute_force(self):
        random = np.random.default_rng(2)
        for _ in range(20):
            ball, far = at(*random.uniform(3, 4, 3), random.uniform(0, 3)), at(-4, *random.uniform(-1, 1, 2), 0.5)
            self.manager.set_transform("ball", ball)
            self.manager.set_transform("far", far)
            shown = {"box": (BOX_POINTS, BOX_TRIANGLES), "ball": (shapes.moved(BALL_POINTS, ball), BALL_FACES),
                     "far": (shapes.moved(BOX_POINTS, far), BOX_TRIANGLES)}
            expected = {names: shapes.surface_distance(*shown[names[0]], *shown[names[1]])
                        for names in (("ball", "box"), ("box", "far"), ("ball", "far"))}
            nearest = min(expected, key=expected.get)
            distance, names, data = self.manager.min_distance_internal(return_names=True, return_data=True)
            self.assertAlmostEqual(distance, expected[nearest], delta=1e-12)
            self.assertEqual(names, nearest)
            gap = np.linalg.norm(data.point(names[0]) - data.point(names[1]))
            self.assertAlmostEqual(gap, data.distance, delta=1e-12)
            of_far = self.manager.min_distance_internal("far")
            self.assertAlmostEqual(of_far, min(expected["box", "far"], expected["ball", "far"]), delta=1e-12)

    def test_min_distance_single(self):
        self.assertEqual(self.manager.min_distance_single(BALL, at(9)), 0)
        distance, name = self.manager.min_distance_single(BOX, at(13), return_name=True)
        self.assertEqual((distance, name), (2, "far"))
        _, data = self.manager.min_distance_single(BOX, at(13), return_data=True)
        self.assertEqual((data.distance, data.names), (2, {"far", "__external"}))
        self.assertEqual((data.point("far")[0], data.point("__external")[0]), (10, 12))
        self.assertIn(data.index("far"), range(12))

    def test_objects_are_replaced_and_removed(self):
        self.manager.in_collision_internal()
        self.manager.add_object("box", BOX, at(-9))
        self.assertEqual(self.manager.in_collision_internal(True), (False, set()))
        self.manager.remove_object("far")
        self.assertEqual(self.manager.min_distance_internal(return_names=True)[1], ("ball", "box"))
        self.manager.remove_object("ball")
        self.assertEqual(self.manager.min_distance_internal(None, True, True), (math.inf, None, None))

    def test_open_meshes(self):
        sheet = types.SimpleNamespace(vertices=[[-5, -5, 0.5], [5, -5, 0.5], [0, 5, 0.5]], faces=[[0, 1, 2]])
        hit, names, data = self.manager.in_collision_single(sheet, return_names=True, return_data=True)
        self.assertEqual((hit, names, len(data) > 0), (True, {"box", "ball"}, True))

    def test_errors(self):
        for call in (lambda: self.manager.remove_object("none"), lambda: self.manager.set_transform("none", np.eye(4)),
                     lambda: self.manager.set_transform("box", np.eye(3)),
                     lambda: self.manager.add_object("x", BOX, np.diag([2.0, 1, 1, 1])),
                     lambda: self.manager.min_distance_internal("none")):
            with self.assertRaises(ValueError):
                call()
        self.assertEqual(self.manager.in_collision_internal(True), (True, {("ball", "box")}))


if __name__ == "__main__":
    unittest.main()
