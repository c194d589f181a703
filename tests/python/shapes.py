"""Meshes for tests, and distances of them by brute force in plain numpy."""

import itertools

import numpy as np

BOX_QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def box(half=(1.0, 1.0, 1.0)):
    """Returns the corners of a box about the origin and its quads, which are wound outwards."""
    return np.array(list(itertools.product((-1.0, 1.0), repeat=3))) * half, BOX_QUADS


def triangulated(quads):
    return np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])


def sphere(rounds):
    """Returns an octahedron that was refined to a sphere of radius 1."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(x, y, z) if (x + y + z) % 2 == 0 else (x, z, y) for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    points = [np.array(point, float) for point in points]
    for _ in range(rounds):
        middles = {}

        def middle(a, b, middles=middles):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[a] + points[b]) / np.linalg.norm(points[a] + points[b]))
            return middles[key]

        faces = [face for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for face in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    return np.array(points), np.array(faces)


def rotation(axis, angle):
    """Returns a 4 x 4 matrix that turns about an axis (Rodrigues)."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return pose


def moved(points, pose):
    return points @ pose[:3, :3].T + pose[:3, 3]


def dot(a, b):
    return np.einsum("...i,...i", a, b)


def to_segments(points, begin, end):
    """Returns the distance of each point to each segment: (points, segments)."""
    along = end - begin
    t = np.clip(dot(points[:, None] - begin, along) / dot(along, along), 0, 1)
    return np.linalg.norm(points[:, None] - begin - t[..., None] * along, axis=-1)


def to_triangles(points, corners):
    """Returns the distance of each point to each triangle: (points, triangles)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    nearest = np.minimum(np.minimum(to_segments(points, a, b), to_segments(points, b, c)), to_segments(points, c, a))
    normal = np.cross(b - a, c - a)
    from_a = points[:, None] - a
    height = dot(from_a, normal) / np.linalg.norm(normal, axis=-1)
    foot = from_a - (dot(from_a, normal) / dot(normal, normal))[..., None] * normal
    u = dot(np.cross(foot, c - a), normal) / dot(normal, normal)
    v = dot(np.cross(b - a, foot), normal) / dot(normal, normal)
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    return np.where(inside, np.abs(height), nearest)


def between_segments(p, q, r, s):
    """Returns the distance of the insides of each two segments, or infinity where they are closest at an end."""
    p, q = p[:, None], q[:, None]
    u, v, w = q - p, s - r, p - r
    a, b, c, d, e = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    determinant = a * c - b * b
    with np.errstate(divide="ignore", invalid="ignore"):
        t, k = (b * e - c * d) / determinant, (a * e - b * d) / determinant
        gap = np.linalg.norm(w + t[..., None] * u - k[..., None] * v, axis=-1)
        inside = (determinant > 1e-12 * a * c) & (t > 0) & (t < 1) & (k > 0) & (k < 1)
    return np.where(inside, gap, np.inf)


def edges_of(faces):
    return np.array(sorted({tuple(sorted((face[i], face[i - 1]))) for face in faces for i in range(len(face))}))


def surface_distance(points_a, faces_a, points_b, faces_b):
    """Returns the distance of two surfaces of triangles that do not pass through each other."""
    edges_a, edges_b = edges_of(faces_a), edges_of(faces_b)
    used_a, used_b = points_a[np.unique(faces_a)], points_b[np.unique(faces_b)]
    return min(to_triangles(used_a, points_b[faces_b]).min(), to_triangles(used_b, points_a[faces_a]).min(),
               between_segments(points_a[edges_a[:, 0]], points_a[edges_a[:, 1]], points_b[edges_b[:, 0]],
                                points_b[edges_b[:, 1]]).min())


def first_on_ray(origin, direction, corners):
    """Returns how far along a ray the first triangle is hit, or infinity (Moeller and Trumbore)."""
    a = corners[:, 0]
    one, two = corners[:, 1] - a, corners[:, 2] - a
    h = np.cross(direction, two)
    with np.errstate(divide="ignore", invalid="ignore"):
        f = 1 / dot(one, h)
        u = f * dot(origin - a, h)
        q = np.cross(origin - a, one)
        v = f * (q @ direction)
        t = f * dot(two, q)
        return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, np.inf).min()
