"""Questions about a report: rays, moving spheres, closest points, free places and boxes."""

import ctypes
import math
from typing import Any, List, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._convert import filter_to_c
from ._library import lib
from ._memory import made
from ._positions import described, doubles, point, pose_rows, readable
from .errors import Error
from .mesh import as_mesh
from .report import Report
from .rows import CLOSEST_POINT, ID, RAY_HIT, SPHERE_HIT, ObjectId, object_id
from .settings import QueryFilter


class MeshProbe:
    """A mesh that `SceneQuery` tries at one place after the other. With `solid` what is inside of it counts too."""

    def __init__(self, mesh: Any, solid: bool = False) -> None:
        self._mesh = as_mesh(mesh)
        self._handle = made(lib.probe_release, lib.probe_new, self._mesh._pointer, solid)

    def set_pose(self, pose: ArrayLike) -> None:
        """Poses the rest shape by a matrix as `Scene.set_pose` takes it. Raises `Error` if that is no rotation."""
        rows, _ = pose_rows(pose)
        if rows.shape == (4, 4) and np.abs(rows[3] - [0, 0, 0, 1]).max() > 1e-6:
            raise Error("the last row of the pose is not (0, 0, 0, 1)")
        lib.probe_set_pose(self._handle.pointer, doubles(rows[:3]))

    def set_positions(self, positions: ArrayLike) -> None:
        """Gives each vertex a position."""
        array = readable(positions, self._mesh.vertex_count, "positions")
        lib.probe_set_positions(self._handle.pointer, ctypes.byref(described(array)))


class SceneQuery:
    """Asks about the objects with `queries` in one report, at the positions of its step.

    One thread at a time may use a query. It keeps its report. Answers are structured arrays with up to `room` rows,
    the first one first. An empty array says that there is nothing.
    """

    def __init__(self, report: Optional[Report] = None) -> None:
        self._handle = made(lib.scene_query_release, lib.scene_query_new, _pointer(report))
        self._report = report

    @property
    def report(self) -> Optional[Report]:
        """The report that is asked about. Give it another one to go on with."""
        return self._report

    @report.setter
    def report(self, report: Optional[Report]) -> None:
        lib.scene_query_set_report(self._handle.pointer, _pointer(report))
        self._report = report

    def cast_ray(self, origin: ArrayLike, direction: ArrayLike, limit: float = math.inf,
                 filter: Optional[QueryFilter] = None, room: int = 1) -> "NDArray[Any]":
        """Returns the first hits of a ray, of type `graze.RAY_HIT`. `limit` is in lengths of the direction."""
        return _rows(lib.scene_query_cast_ray, self._handle.pointer, RAY_HIT, room, point(origin, "origin"),
                     point(direction, "direction"), limit, filter_to_c(filter))

    def cast_sphere(self, start: ArrayLike, end: ArrayLike, radius: float, filter: Optional[QueryFilter] = None,
                    room: int = 1) -> "NDArray[Any]":
        """Returns the first objects that a moving sphere touches, of type `graze.SPHERE_HIT`."""
        return _rows(lib.scene_query_cast_sphere, self._handle.pointer, SPHERE_HIT, room, point(start, "start"),
                     point(end, "end"), radius, filter_to_c(filter))

    def closest_points(self, at: ArrayLike, limit: float = math.inf, filter: Optional[QueryFilter] = None,
                       room: int = 1) -> "NDArray[Any]":
        """Returns the closest points of the nearest objects, of type `graze.CLOSEST_POINT`."""
        return _rows(lib.scene_query_closest_points, self._handle.pointer, CLOSEST_POINT, room, point(at, "at"), limit,
                     filter_to_c(filter))

    def is_free(self, probe: MeshProbe, clearance: float = 0.0, filter: Optional[QueryFilter] = None) -> bool:
        """Returns whether a mesh would be in contact with nothing, if `clearance` were the threshold."""
        found = ctypes.c_bool()
        lib.scene_query_is_free(self._handle.pointer, probe._handle.pointer, clearance, filter_to_c(filter),
                                ctypes.byref(found))
        return found.value

    def blocking(self, probe: MeshProbe, clearance: float = 0.0,
                 filter: Optional[QueryFilter] = None) -> List[ObjectId]:
        """Returns all objects that would be in contact with a mesh, in the order of addition."""
        return _all_ids(lib.scene_query_blocking, self._handle.pointer, probe._handle.pointer, clearance,
                        filter_to_c(filter))

    def objects_in_box(self, low: ArrayLike, high: ArrayLike, filter: Optional[QueryFilter] = None) -> List[ObjectId]:
        """Returns all objects of which some face has a point in a box, in the order of addition."""
        return _all_ids(lib.scene_query_objects_in_box, self._handle.pointer, point(low, "low"), point(high, "high"),
                        filter_to_c(filter))


def _pointer(report: Optional[Report]) -> Optional[int]:
    if report is None:
        return None
    if report._pointer is None:
        raise Error("the report was unpickled; ask about the report of a scene")
    return report._pointer


def _rows(call: Any, pointer: Any, dtype: "np.dtype[Any]", room: int, *arguments: Any) -> "NDArray[Any]":
    found = np.zeros(room, dtype)
    count = ctypes.c_size_t()
    call(pointer, *arguments, found.ctypes.data, room, ctypes.byref(count))
    return found[:count.value]


def _all_ids(call: Any, pointer: Any, *arguments: Any) -> List[ObjectId]:
    """Asks with more room until all objects have some."""
    room = 64
    while True:
        found = np.zeros(room, ID)
        count = ctypes.c_size_t()
        call(pointer, *arguments, found.ctypes.data, room, ctypes.byref(count))
        if count.value <= room:
            return [object_id(row) for row in found[:count.value].tolist()]
        room = count.value
