"""Meshes of triangles and quads."""

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import lib
from ._memory import NO_INDEX, Handle, made, unsigned, view
from ._positions import described, readable
from .errors import Error

Faces = Union[ArrayLike, Sequence[Sequence[int]]]
_VERTEX_NEIGHBOURS, _VERTEX_FACES, _EDGE_FACES = range(3)


@dataclass(frozen=True)
class MeshOddities:
    """Lists of what is odd about a mesh: numbers of faces, vertices and edges. The order is that of the C interface."""

    degenerate_faces: "NDArray[np.uint32]"
    duplicate_faces: "NDArray[np.uint32]"
    isolated_vertices: "NDArray[np.uint32]"
    duplicate_vertices: "NDArray[np.uint32]"
    non_manifold_edges: "NDArray[np.uint32]"
    border_edges: "NDArray[np.uint32]"
    flipped_edges: "NDArray[np.uint32]"


class Mesh:
    """The faces of a surface and where its vertices are at rest. It never changes, so any thread may use it.

    `vertices` is an (n, 3) array of coordinates. `faces` is an (m, 3) or (m, 4) array of vertices, or a sequence of
    faces with three or four corners each. A fourth corner `Mesh.NO_VERTEX` makes a triangle of a row. Raises `Error`
    for anything else, and for a corner that is no vertex.
    """

    NO_VERTEX = NO_INDEX

    def __init__(self, vertices: ArrayLike, faces: Faces) -> None:
        rest = readable(vertices, None, "vertices")
        corners, counts = _flat(faces)
        self._take(made(lib.mesh_release, lib.mesh_from_polygons, ctypes.byref(described(rest)), corners.ctypes.data,
                        len(corners), counts.ctypes.data, len(counts)))

    @classmethod
    def _of(cls, handle: Handle) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._take(handle)
        return mesh

    @classmethod
    def _or_none(cls, handle: Handle) -> "Optional[Mesh]":
        return None if handle.pointer is None else cls._of(handle)

    def _take(self, handle: Handle) -> None:
        self._handle = handle
        self._faces: Optional[NDArray[np.uint32]] = None
        self._edges: Optional[NDArray[np.uint32]] = None

    @property
    def _pointer(self) -> Optional[int]:
        return self._handle.pointer

    def __reduce__(self) -> "Tuple[Any, ...]":
        return Mesh, (np.array(self.rest), np.array(self.faces))

    def __repr__(self) -> str:
        return f"<graze.Mesh of {self.vertex_count} vertices and {self.face_count} faces>"

    @property
    def vertex_count(self) -> int:
        """The number of vertices."""
        return int(lib.mesh_vertex_count(self._pointer))

    @property
    def face_count(self) -> int:
        """The number of faces."""
        return int(lib.mesh_face_count(self._pointer))

    @property
    def edge_count(self) -> int:
        """The number of edges."""
        return int(lib.mesh_edge_count(self._pointer))

    @property
    def byte_count(self) -> int:
        """The number of bytes that the mesh takes."""
        return int(lib.mesh_byte_count(self._pointer))

    @property
    def rest(self) -> "NDArray[np.float64]":
        """The rest positions: a read-only (n, 3) array over the mesh's own memory."""
        return view(lib.mesh_rest(self._pointer), (self.vertex_count, 3), np.dtype(np.float64), self._handle)

    vertices = rest

    @property
    def faces(self) -> "NDArray[np.uint32]":
        """The corners of each face: (m, 3) if all are triangles, else (m, 4) with `NO_VERTEX` in triangles."""
        if self._faces is None:
            self._faces = self._of_corners(lambda room: lib.mesh_faces(self._pointer, room, None))
        return self._faces

    @property
    def face_edges(self) -> "NDArray[np.uint32]":
        """For each corner of `faces` the edge to the next corner, or `NO_VERTEX` where there is none."""
        return self._of_corners(lambda room: lib.mesh_face_edges(self._pointer, room))

    @property
    def edges(self) -> "NDArray[np.uint32]":
        """The two vertices of each edge, the lower one first: a (k, 2) array."""
        if self._edges is None:
            edges = np.empty((self.edge_count, 2), np.uint32)
            lib.mesh_edges(self._pointer, edges.ctypes.data)
            edges.flags.writeable = False
            self._edges = edges
        return self._edges

    def vertex_neighbours(self, vertex: int) -> "NDArray[np.uint32]":
        """Returns the vertices that an edge joins to a vertex. Raises `Error` for a number that names none."""
        return self._list(_VERTEX_NEIGHBOURS, vertex)

    def vertex_faces(self, vertex: int) -> "NDArray[np.uint32]":
        """Returns the faces at a vertex. Raises `Error` for a number that names none."""
        return self._list(_VERTEX_FACES, vertex)

    def edge_faces(self, edge: int) -> "NDArray[np.uint32]":
        """Returns the faces beside an edge. Raises `Error` for a number that names none."""
        return self._list(_EDGE_FACES, edge)

    def is_used(self, vertex: int) -> bool:
        """Returns whether a face uses a vertex."""
        return bool(lib.mesh_is_used(self._pointer, unsigned(vertex, 32, "the vertex")))

    @property
    def uses_all_vertices(self) -> bool:
        """Whether every vertex belongs to a face."""
        return bool(lib.mesh_uses_all_vertices(self._pointer))

    def oddities(self) -> MeshOddities:
        """Returns what is odd about the mesh."""
        return MeshOddities(*(self._oddity(number) for number in range(7)))

    @property
    def is_closed(self) -> bool:
        """Whether the surface may be a solid: each edge has two faces, which pass it in opposite directions."""
        found = self.oddities()
        return not (len(found.border_edges) or len(found.non_manifold_edges) or len(found.flipped_edges))

    def weld(self, distance: float) -> "Tuple[Mesh, NDArray[np.uint32], NDArray[np.uint32]]":
        """Makes one vertex of those that are at most `distance` apart.

        Returns the new mesh, the new vertex of each old one, and the new face of each old one, or `NO_VERTEX`.
        """
        vertices = np.empty(self.vertex_count, np.uint32)
        faces = np.empty(self.face_count, np.uint32)
        handle = made(lib.mesh_release, lib.mesh_weld, self._pointer, distance, vertices.ctypes.data, faces.ctypes.data)
        return Mesh._of(handle), vertices, faces

    def _list(self, which: int, index: int) -> "NDArray[np.uint32]":
        first, count = ctypes.c_void_p(), ctypes.c_size_t()
        lib.mesh_list(self._pointer, which, unsigned(index, 32, "the index"), ctypes.byref(first), ctypes.byref(count))
        return view(first.value, (count.value,), np.dtype(np.uint32), self._handle)

    def _oddity(self, which: int) -> "NDArray[np.uint32]":
        count = ctypes.c_size_t()
        lib.mesh_oddities(self._pointer, which, None, 0, ctypes.byref(count))
        found = np.empty(count.value, np.uint32)
        lib.mesh_oddities(self._pointer, which, found.ctypes.data, len(found), ctypes.byref(count))
        return found

    def _of_corners(self, fill: "Callable[[int], Any]") -> "NDArray[np.uint32]":
        """Returns one number for each corner, in a row for each face."""
        flat = np.empty(int(lib.mesh_corner_count(self._pointer)), np.uint32)
        fill(flat.ctypes.data)
        faces = self.face_count
        if faces and len(flat) in (3 * faces, 4 * faces):
            rows = flat.reshape(faces, -1)
        else:
            counts = np.empty(faces, np.uint32)
            lib.mesh_faces(self._pointer, None, counts.ctypes.data)
            rows = np.full((faces, 4 if faces else 3), NO_INDEX, np.uint32)
            rows[np.arange(rows.shape[1]) < counts[:, None]] = flat
        rows.flags.writeable = False
        return rows


def as_mesh(mesh: Any) -> Mesh:
    """Returns a mesh, or makes one of anything with `vertices` and `faces`."""
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh.vertices, mesh.faces)


def _flat(faces: Faces) -> "Tuple[NDArray[np.uint32], NDArray[np.uint32]]":
    """Returns the corners of all faces one after the other, and the number of corners of each face."""
    if isinstance(faces, np.ndarray):
        rows = faces
    else:
        lists = [list(face) for face in faces]  # type: ignore[union-attr, arg-type]
        lengths = {len(face) for face in lists}
        if lengths <= {3, 4} and len(lengths) == 2:
            lists = [face if len(face) == 4 else [*face, NO_INDEX] for face in lists]
            lengths = {4}
        if not lists:
            lists = np.empty((0, 3), np.uint32)  # type: ignore[assignment]
        elif len(lengths) != 1:
            raise Error("a face has neither three nor four corners")
        rows = np.array(lists)
    if rows.ndim != 2 or rows.shape[1] not in (3, 4):
        raise Error(f"faces has the shape {rows.shape}, which is neither (m, 3) nor (m, 4)")
    if rows.dtype.kind not in "iu":
        raise Error(f"faces has numbers of type {rows.dtype}, which name no vertices")
    if rows.size and (rows.min() < 0 or rows.max() > NO_INDEX):
        raise Error("a corner of a face is below 0 or above 2^32 - 1")
    rows = np.ascontiguousarray(rows, np.uint32)
    counts = np.full(len(rows), rows.shape[1], np.uint32)
    if rows.shape[1] == 4:
        counts[rows[:, 3] == NO_INDEX] = 3
        return rows.ravel()[np.arange(rows.size) % 4 < np.repeat(counts, 4)], counts
    return rows.ravel(), counts
