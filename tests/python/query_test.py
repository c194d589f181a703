"""Two surfaces without a scene, and questions about a report, against brute force in numpy."""

import unittest

import numpy as np

import graze
import shapes
from graze import Inside

BALL_POINTS, BALL_FACES = shapes.sphere(2)
BALL = graze.Mesh(BALL_POINTS, BALL_FACES)
BOX_POINTS, BOX_QUADS = shapes.box()
BOX = graze.Mesh(BOX_POINTS, BOX_QUADS)


class TwoSurfacesTest(unittest.TestCase):
    def test_distances_are_those_of_brute_force(self):
        random = np.random.default_rng(3)
        asked = graze.RepeatedQuery(BALL, BOX)
        for _ in range(20):
            pose = shapes.rotation(random.normal(size=3), random.uniform(0, 3))
            pose[:3, 3] = [3, 0, 0] + random.uniform(-0.2, 0.2, 3)
            at = shapes.moved(BOX_POINTS, pose)
            found = asked.ask(None, at)
            expected = shapes.surface_distance(BALL_POINTS, BALL_FACES, at, shapes.triangulated(BOX_QUADS))
            self.assertAlmostEqual(found.distance[0], expected, delta=1e-12)
            self.assertFalse(found.in_contact)

    def test_answers_do_not_change_with_the_next_question(self):
        asked = graze.RepeatedQuery(BALL, BALL, contact_distance=0.1)
        first = asked.ask(None, BALL_POINTS + [1.9, 0, 0])
        kept = np.array(first.contacts)
        asked.ask(None, BALL_POINTS + [0.5, 0.1, 0])
        np.testing.assert_array_equal(first.contacts, kept)
        self.assertGreater(len(kept), 0)

    def test_solids_and_ways_out(self):
        inside = graze.query(BOX, None, BALL, 0.1 * BALL_POINTS, a_is_solid=True)
        self.assertEqual((inside.inside, inside.in_contact), (Inside.B_IN_A, True))
        moved = BOX_POINTS + [1.5, 0.1, 0.2]
        crossing = graze.query(BOX, None, BOX, moved, a_is_solid=True, b_is_solid=True,
                               ways_out=True)
        self.assertEqual(crossing.inside, Inside.CROSSING)
        way = crossing.way_out["direction"]
        self.assertAlmostEqual(np.linalg.norm(way), 1)
        self.assertGreater(way[0], 0.7)
        self.assertAlmostEqual(crossing.way_out["extent"], (BOX_POINTS @ way).max() - (moved @ way).min())

    def test_wrong_input_is_refused(self):
        for call in (lambda: graze.query(BALL, BALL_POINTS[1:], BOX, None),
                     lambda: graze.query(BALL, np.full_like(BALL_POINTS, np.inf), BOX, None),
                     lambda: graze.query(BALL, None, BOX, None, contact_distance=-1.0)):
            with self.assertRaises(graze.Error):
                call()


class SceneQueryTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with graze.Scene() as scene:
            cls.ball = scene.add(BALL, name="ball", queries=True, layer=1)
            cls.box = scene.add(BOX, name="box", motion=graze.Motion.RIGID, queries=True, layer=2)
            scene.add(BALL, name="not asked about")
            pose = shapes.rotation((1, 1, 0), 0.4)
            pose[:3, 3] = 4, 0, 0
            scene.set_pose(cls.box, pose)
            cls.report = scene.step()
        cls.surfaces = {cls.ball: (BALL_POINTS, BALL_FACES),
                        cls.box: (shapes.moved(BOX_POINTS, pose), shapes.triangulated(BOX_QUADS))}

    def setUp(self):
        self.query = graze.SceneQuery(self.report)

    def test_rays_hit_where_brute_force_does(self):
        random = np.random.default_rng(5)
        hits = 0
        for _ in range(200):
            origin = random.uniform(-6, 6, 3)
            direction = random.uniform(-1, 1, 3) + random.choice([[0, 0, 0], [4, 0, 0]]) - origin
            expected = {object: shapes.first_on_ray(origin, direction, points[faces])
                        for object, (points, faces) in self.surfaces.items()}
            found = self.query.cast_ray(origin, direction)
            nearest = min(expected, key=expected.get)
            if np.isinf(expected[nearest]):
                self.assertEqual(len(found), 0)
                continue
            hits += 1
            self.assertEqual(tuple(found[0]["object"]), nearest)
            self.assertAlmostEqual(found[0]["t"], expected[nearest], delta=1e-10)
            np.testing.assert_allclose(found[0]["point"], origin + found[0]["t"] * direction, atol=1e-9)
        self.assertGreater(hits, 30)

    def test_several_hits_limits_and_filters(self):
        through = self.query.cast_ray([-9, 0.1, 0.05], [1, 0, 0], room=10)
        self.assertEqual([tuple(hit["object"]) for hit in through], [self.ball] * 2 + [self.box] * 2)
        self.assertTrue((np.diff(through["t"]) > 0).all())
        self.assertEqual(len(self.query.cast_ray([-9, 0.1, 0.05], [1, 0, 0], limit=7.5)), 0)
        only = self.query.cast_ray([-9, 0.1, 0.05], [1, 0, 0], filter=graze.QueryFilter(collides_with=2))
        self.assertEqual(tuple(only[0]["object"]), self.box)
        other = self.query.cast_ray([-9, 0.1, 0.05], [1, 0, 0], filter=graze.QueryFilter(ignored=self.ball))
        self.assertEqual(tuple(other[0]["object"]), self.box)

    def test_closest_points_are_those_of_brute_force(self):
        random = np.random.default_rng(6)
        for at in random.uniform(-3, 6, (50, 3)):
            found = self.query.closest_points(at, room=5)
            self.assertEqual(len(found), 2)
            for row in found:
                points, faces = self.surfaces[tuple(row["object"])]
                self.assertAlmostEqual(row["distance"], shapes.to_triangles(at[None], points[faces]).min(), delta=1e-12)
            self.assertLessEqual(found[0]["distance"], found[1]["distance"])
        self.assertEqual(len(self.query.closest_points([0, 0, 9], limit=1)), 0)

    def test_a_sphere_stops_a_radius_away(self):
        found = self.query.cast_sphere([0, 0, 9], [0, 0, 0], 0.5)
        points, faces = self.surfaces[self.ball]
        self.assertAlmostEqual(shapes.to_triangles(found[0]["centre"][None], points[faces]).min(), 0.5, delta=1e-9)

    def test_probes(self):
        probe = graze.MeshProbe(graze.Mesh(*shapes.box((0.2, 0.2, 0.2))))
        pose = np.eye(4)
        pose[:3, 3] = 0, 0, 2
        probe.set_pose(pose)
        self.assertTrue(self.query.is_free(probe))
        self.assertTrue(self.query.is_free(probe, 0.75))
        self.assertFalse(self.query.is_free(probe, 0.85))
        self.assertEqual(self.query.blocking(probe, 0.85), [self.ball])
        probe.set_positions(shapes.box((6, 0.1, 0.1))[0])
        self.assertEqual(self.query.blocking(probe), [self.ball, self.box])
        pose[3, 0] = 1
        for bad in (pose, np.diag([2.0, 1, 1, 1]), np.eye(2)):
            with self.assertRaises(graze.Error):
                probe.set_pose(bad)

    def test_boxes(self):
        self.assertEqual(self.query.objects_in_box([-9] * 3, [9] * 3), [self.ball, self.box])
        self.assertEqual(self.query.objects_in_box([-9, -9, -9], [0.5, 9, 9]), [self.ball])
        self.assertEqual(self.query.objects_in_box([-0.1] * 3, [0.1] * 3), [])
        with self.assertRaises(graze.Error):
            self.query.objects_in_box([1, 0, 0], [0, 1, 1])

    def test_many_objects_are_all_listed(self):
        with graze.Scene() as scene:
            objects = [scene.add(BOX, queries=True) for _ in range(150)]
            query = graze.SceneQuery(scene.step())
        self.assertEqual(query.objects_in_box([-9] * 3, [9] * 3), objects)

    def test_another_report(self):
        empty = graze.SceneQuery()
        self.assertEqual((empty.report, len(empty.cast_ray([0, 0, 9], [0, 0, -1]))), (None, 0))
        empty.report = self.report
        self.assertEqual(len(empty.cast_ray([0, 0, 9], [0, 0, -1])), 1)
        empty.report = None
        self.assertEqual(len(empty.cast_ray([0, 0, 9], [0, 0, -1])), 0)


if __name__ == "__main__":
    unittest.main()
