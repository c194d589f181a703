"""A manager of collisions with the calls of `trimesh.collision.CollisionManager`.

It answers about surfaces, as that one does: a mesh that lies inside another one, and touches nothing, does not collide.
"""

import math
from typing import Any, Dict, Hashable, Iterable, List, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._collision_data import ContactData, DistanceData, contact_data_of, distance_data_of
from .enums import ContactDetail, Motion
from .errors import Error
from .mesh import Mesh, as_mesh
from .report import Report
from .rows import ObjectId, object_id
from .scene import Scene

EXTERNAL = "__external"
_MANAGED, _OUTSIDE = 1, 2  # layers
# Surfaces that are nearer than this collide. Those that touch have distance 0.
_TOUCHING = 2.0**-500


class _Object(NamedTuple):
    mesh: Mesh
    transform: "NDArray[np.float64]"
    solid: bool


class _Asked:
    """A scene of all managed objects for one kind of question, and the names behind its ids."""

    def __init__(self, distances: bool, external: bool) -> None:
        self._external = external
        self.scene = (Scene(range=math.inf, detail=ContactDetail.NONE) if distances else
                      Scene(contact_distance=_TOUCHING, detail=ContactDetail.NEAREST))
        self.ids: Dict[Hashable, ObjectId] = {}
        self.objects: Dict[ObjectId, Tuple[Hashable, Mesh, bool]] = {}

    def add(self, name: Hashable, added: _Object, layer: int = _MANAGED) -> ObjectId:
        # With others from outside, managed objects are not tested against each other.
        seen = (_MANAGED | _OUTSIDE) & ~layer if self._external else _MANAGED
        object = self.scene.add(added.mesh, motion=Motion.RIGID, solid=added.solid, layer=layer, collides_with=seen)
        self.scene.set_pose(object, added.transform, teleport=True)
        self.objects[object] = (name, added.mesh, layer == _MANAGED)
        if layer == _MANAGED:
            self.ids[name] = object
        return object

    def remove(self, object: ObjectId) -> None:
        self.scene.remove(object)
        name, _, managed = self.objects.pop(object)
        if managed:
            del self.ids[name]

    def step(self) -> Report:
        report = self.scene.step()
        if report.diagnostics:
            raise Error("; ".join(problem.message for problem in report.diagnostics))
        return report


class CollisionManager:
    """Finds collisions and distances between named meshes, each at a transform.

    A mesh is a `Mesh`, or anything with `vertices` and `faces`, such as a `trimesh.Trimesh`. A transform is a (4, 4)
    matrix of a rotation and a translation: anything else raises `Error`. One thread at a time may use a manager.
    """

    def __init__(self) -> None:
        self._objs: Dict[Hashable, _Object] = {}
        self._asked: Dict[Tuple[bool, bool], _Asked] = {}

    def add_object(self, name: Hashable, mesh: Any, transform: Optional[ArrayLike] = None) -> None:
        """Adds an object, or replaces the one of that name."""
        added = _object(mesh, transform)
        if name in self._objs:
            self.remove_object(name)
        self._objs[name] = added
        for asked in self._asked.values():
            asked.add(name, added)

    def remove_object(self, name: Hashable) -> None:
        """Removes an object. Raises `Error` if no object has that name."""
        self._check(name)
        del self._objs[name]
        for asked in self._asked.values():
            asked.remove(asked.ids[name])

    def set_transform(self, name: Hashable, transform: ArrayLike) -> None:
        """Places an object anew."""
        self._check(name)
        matrix = _transform(transform)
        self._objs[name] = self._objs[name]._replace(transform=matrix)
        for asked in self._asked.values():
            asked.scene.set_pose(asked.ids[name], matrix, teleport=True)

    def in_collision_single(self, mesh: Any, transform: Optional[ArrayLike] = None, return_names: bool = False,
                            return_data: bool = False) -> Any:
        """Says whether a mesh collides with any object of the manager.

        Returns that, then if they are asked for the set of the objects' names, and a list of `ContactData`, in which
        the mesh is called "__external".
        """
        asked, report = self._step(False, [(EXTERNAL, _object(mesh, transform))])
        hit = self._colliding(report, asked)
        names = {names[0] for names in hit.values()}
        return _answer(bool(hit), return_names, names, return_data, contact_data_of(report, hit, asked.objects))

    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Says whether any two objects of the manager collide.

        Returns that, then if they are asked for the set of pairs of names, each in order, and a list of
        `ContactData`.
        """
        asked, report = self._step(False, None)
        hit = self._colliding(report, asked)
        names = {_sorted(pair) for pair in hit.values()}
        return _answer(bool(hit), return_names, names, return_data, contact_data_of(report, hit, asked.objects))

    def in_collision_other(self, other_manager: "CollisionManager", return_names: bool = False,
                           return_data: bool = False) -> Any:
        """Says whether an object of this manager collides with one of another manager.

        Returns that, then if they are asked for the set of pairs of names, the first of this manager, and a list of
        `ContactData`.
        """
        asked, report = self._step(False, other_manager._objs.items())
        hit = self._colliding(report, asked)
        return _answer(bool(hit), return_names, set(hit.values()), return_data,
                       contact_data_of(report, hit, asked.objects))

    def min_distance_single(self, mesh: Any, transform: Optional[ArrayLike] = None, return_name: bool = False,
                            return_data: bool = False) -> Any:
        """Returns the least distance of a mesh to any object of the manager. It is 0 where they collide.

        Then, if they are asked for, the name of the nearest object and `DistanceData`. Without objects the distance is
        infinite, and both are None.
        """
        asked, report = self._step(True, [(EXTERNAL, _object(mesh, transform))])
        distance, names, data = self._nearest(report, asked)
        return _answer(distance, return_name, names[0] if names else None, return_data, data)

    def min_distance_internal(self, name: Optional[Hashable] = None, return_names: bool = False,
                              return_data: bool = False) -> Any:
        """Returns the least distance of any two objects of the manager, or of the object `name` to any other.

        Then, if they are asked for, the pair of names in order and `DistanceData`.
        """
        if name is not None:
            self._check(name)
        asked, report = self._step(True, None)
        distance, names, data = self._nearest(report, asked, name)
        return _answer(distance, return_names, _sorted(names) if names else None, return_data, data)

    def min_distance_other(self, other_manager: "CollisionManager", return_names: bool = False,
                           return_data: bool = False) -> Any:
        """Returns the least distance of an object of this manager to one of another manager.

        Then, if they are asked for, the pair of names, the first of this manager, and `DistanceData`.
        """
        asked, report = self._step(True, other_manager._objs.items())
        distance, names, data = self._nearest(report, asked)
        return _answer(distance, return_names, names, return_data, data)

    def _check(self, name: Hashable) -> None:
        if name not in self._objs:
            raise Error(f"{name} not in collision manager!")

    def _step(self, distances: bool, outside: "Optional[Iterable[Tuple[Hashable, _Object]]]") -> Tuple[_Asked, Report]:
        """Asks about all managed objects, against those from outside if there are such. Forgets these after it."""
        key = (distances, outside is not None)
        asked = self._asked.get(key)
        if asked is None:
            asked = self._asked[key] = _Asked(*key)
            for name, managed in self._objs.items():
                asked.add(name, managed)
        visitors = {asked.add(name, visitor, _OUTSIDE): name for name, visitor in outside or ()}
        try:
            report = asked.step()
            answered = _Asked.__new__(_Asked)
            answered.objects = dict(asked.objects)
        finally:
            for visitor in visitors:
                asked.remove(visitor)
        return answered, report

    def _colliding(self, report: Report, asked: _Asked) -> "Dict[int, Tuple[Hashable, Hashable]]":
        """Returns the rows of pairs that collide, with the names of both. A managed object comes first."""
        rows = np.flatnonzero(_is_now(report.pairs, asked) & (report.pairs["distance"]["lower"] < _TOUCHING))
        return {int(row): self._names(report.pairs[row], asked) for row in rows}

    def _nearest(self, report: Report, asked: _Asked, name: Optional[Hashable] = None) -> Tuple[float, Any, Any]:
        pairs = report.pairs
        wanted = _is_now(pairs, asked)
        if name is not None:
            wanted &= np.array([name in self._names(pair, asked) for pair in pairs], bool)
        rows = np.flatnonzero(wanted)
        if len(rows) == 0:
            return math.inf, None, None
        row = pairs[rows[np.argmin(pairs["distance"]["upper"][rows])]]
        return float(row["distance"]["upper"]), self._names(row, asked), distance_data_of(row, asked.objects)

    def _names(self, pair: Any, asked: _Asked) -> Tuple[Hashable, Hashable]:
        a, b = asked.objects[object_id(pair["a"])], asked.objects[object_id(pair["b"])]
        return (a[0], b[0]) if a[2] else (b[0], a[0])


def _is_now(pairs: "NDArray[Any]", asked: _Asked) -> "NDArray[np.bool_]":
    """Says which rows are of objects that are there. A pair of a visitor that has gone is listed once more as ended."""
    return np.array([object_id(pair["a"]) in asked.objects and object_id(pair["b"]) in asked.objects
                     for pair in pairs], bool)


def _answer(first: Any, wants_names: bool, names: Any, wants_data: bool, data: Any) -> Any:
    more = ([names] if wants_names else []) + ([data] if wants_data else [])
    return (first, *more) if more else first


def _sorted(names: Tuple[Hashable, Hashable]) -> Tuple[Any, ...]:
    return tuple(sorted(names))


def _object(mesh: Any, transform: Optional[ArrayLike]) -> _Object:
    shape = as_mesh(mesh)
    return _Object(shape, _transform(np.eye(4) if transform is None else transform), shape.is_closed)


def _transform(transform: ArrayLike) -> "NDArray[np.float64]":
    """Returns a matrix that a scene takes as a pose, or raises `Error`."""
    matrix = np.array(transform, np.float64)
    if matrix.shape != (4, 4):
        raise Error("transform must be (4,4)!")
    turned = matrix[:3, :3]
    if not np.isfinite(matrix).all() or np.abs(turned.T @ turned - np.eye(3)).max() > 1e-3 or (
            np.linalg.det(turned) < 0) or np.abs(matrix[3] - [0, 0, 0, 1]).max() > 1e-6:
        raise Error("transform is no rotation and translation")
    return matrix


__all__: List[str] = ["CollisionManager", "ContactData", "DistanceData"]
