"""Meshes: numpy in and out, what is refused, pickling."""

import gc
import pickle
import unittest

import numpy as np

import graze
import shapes

BOX = graze.Mesh(*shapes.box())


class MeshTest(unittest.TestCase):
    def test_gives_back_what_it_was_made_of(self):
        points, faces = shapes.sphere(2)
        mesh = graze.Mesh(points, faces)
        np.testing.assert_array_equal(mesh.rest, points)
        np.testing.assert_array_equal(mesh.vertices, points)
        np.testing.assert_array_equal(mesh.faces, faces)
        np.testing.assert_array_equal(mesh.edges[np.lexsort(mesh.edges.T[::-1])], shapes.edges_of(faces))
        self.assertEqual((mesh.vertex_count, mesh.face_count), (len(points), len(faces)))
        self.assertEqual(mesh.edge_count, len(points) + len(faces) - 2)  # Euler
        self.assertGreater(mesh.byte_count, 0)

    def test_takes_floats_lists_quads_and_both(self):
        points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]]
        mixed = graze.Mesh(points, [[0, 1, 2, 3], [1, 4, 2]])
        np.testing.assert_array_equal(mixed.faces, [[0, 1, 2, 3], [1, 4, 2, graze.Mesh.NO_VERTEX]])
        self.assertEqual(mixed.face_edges[1, 3], graze.Mesh.NO_VERTEX)
        np.testing.assert_array_equal(graze.Mesh(points, mixed.faces).faces, mixed.faces)
        np.testing.assert_array_equal(graze.Mesh(np.array(points, np.float32), [[0, 1, 4]]).rest, points)
        self.assertEqual(BOX.faces.shape, (6, 4))

    def test_takes_positions_of_any_stride(self):
        points, faces = shapes.sphere(1)
        wide = np.full((len(points), 7), np.nan, np.float32)
        wide[:, 2:5] = points
        for given in (wide[:, 2:5], np.asfortranarray(points), points[::-1][::-1], points.astype(">f8")):
            mesh = graze.Mesh(given, faces)
            np.testing.assert_array_equal(mesh.rest, given)

    def test_lists_of_neighbours(self):
        points, faces = shapes.sphere(1)
        mesh = graze.Mesh(points, faces)
        edges = shapes.edges_of(faces)
        for vertex in (0, 5, len(points) - 1):
            joined = set(edges[(edges == vertex).any(1)].ravel()) - {vertex}
            self.assertEqual(set(mesh.vertex_neighbours(vertex)), joined)
            self.assertEqual(set(mesh.vertex_faces(vertex)), set(np.flatnonzero((faces == vertex).any(1))))
        for edge in (0, mesh.edge_count - 1):
            both = np.isin(faces, mesh.edges[edge]).sum(1) == 2
            self.assertEqual(set(mesh.edge_faces(edge)), set(np.flatnonzero(both)))
        with self.assertRaises(graze.Error):
            mesh.edge_faces(mesh.edge_count)

    def test_edges_of_faces_join_their_corners(self):
        corners = BOX.faces
        joined = np.sort(np.stack([corners, np.roll(corners, -1, 1)], 2), 2)
        np.testing.assert_array_equal(BOX.edges[BOX.face_edges], joined)

    def test_oddities_and_welding(self):
        points, quads = shapes.box()
        apart = np.concatenate([points[face] for face in quads])
        torn = graze.Mesh(apart, np.arange(24).reshape(6, 4))
        self.assertFalse(torn.is_closed)
        self.assertEqual(len(torn.oddities().border_edges), 24)
        self.assertEqual(len(torn.oddities().duplicate_vertices), 16)
        welded, new_of_old, new_face = torn.weld(1e-9)
        self.assertTrue(welded.is_closed)
        np.testing.assert_array_equal(welded.rest[new_of_old], apart)
        np.testing.assert_array_equal(new_face, range(6))

    def test_unused_vertices(self):
        mesh = graze.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]], [[0, 1, 2]])
        self.assertEqual([mesh.is_used(vertex) for vertex in range(5)], [True, True, True, False, False])
        self.assertFalse(mesh.uses_all_vertices)
        np.testing.assert_array_equal(mesh.oddities().isolated_vertices, [3])

    def test_arrays_outlive_the_mesh_and_are_read_only(self):
        points, faces = shapes.sphere(2)
        mesh = graze.Mesh(points, faces)
        rest, neighbours = mesh.rest, mesh.vertex_neighbours(3)
        expected = np.array(neighbours)
        del mesh
        gc.collect()
        np.testing.assert_array_equal(rest, points)
        np.testing.assert_array_equal(neighbours, expected)
        for array in (rest, neighbours, BOX.faces, BOX.edges):
            with self.assertRaises(ValueError):
                array[0] = 0

    def test_pickles(self):
        mixed = graze.Mesh(np.random.default_rng(1).random((5, 3)), [[0, 1, 2, 3], [1, 4, 2]])
        for mesh in (BOX, mixed):
            again = pickle.loads(pickle.dumps(mesh))
            np.testing.assert_array_equal(again.rest, mesh.rest)
            np.testing.assert_array_equal(again.faces, mesh.faces)

    def test_refuses_what_is_no_mesh(self):
        points = np.zeros((4, 3))
        for vertices, faces in (
                (points, [[0, 1, 4]]), (points, [[0, 1, -1]]), (points, [[0, 1]]), (points, [[0, 1, 2], [0]]),
                (points, [[0.0, 1.0, 2.0]]), (points[:, :2], [[0, 1, 2]]), (points.ravel(), [[0, 1, 2]]),
                (points.astype(complex), [[0, 1, 2]]), (points, [[0, 1, 2**40]]), (points * np.nan, [[0, 1, 2]])):
            with self.subTest(faces=faces, shape=np.shape(vertices)), self.assertRaises(graze.Error):
                graze.Mesh(vertices, faces)
        self.assertTrue(issubclass(graze.Error, ValueError))


if __name__ == "__main__":
    unittest.main()
