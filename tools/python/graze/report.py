"""Reports: what one step answered."""

import ctypes
from dataclasses import dataclass
from typing import Any, Dict, List, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _structs
from ._convert import id_to_c
from ._library import lib
from ._memory import Handle, made, view
from ._positions import viewed
from .enums import DiagnosticKind
from .mesh import Mesh
from .patch import Patch
from .rows import CONTACT, IMPACT, PAIR, REGION_DISTANCE, STATISTICS, ObjectId, object_id

_ROWS: Dict[str, "np.dtype[Any]"] = {
    "pairs": PAIR, "contacts": CONTACT, "region_distances": REGION_DISTANCE, "impacts": IMPACT}


class Diagnostic(NamedTuple):
    """Says what was wrong with the input about one object."""

    object: ObjectId
    kind: DiagnosticKind
    message: str


class _InLibrary:
    """The contents of a report in memory of the library."""

    def __init__(self, handle: Handle) -> None:
        self.handle = handle
        self._arrays: Dict[str, Any] = {}

    @property
    def frame(self) -> int:
        return int(lib.report_frame(self.handle.pointer))

    @property
    def tag(self) -> int:
        return int(lib.report_tag(self.handle.pointer))

    @property
    def complete(self) -> bool:
        return bool(lib.report_complete(self.handle.pointer))

    @property
    def diagnostics(self) -> List[Diagnostic]:
        return [self._diagnostic(index) for index in range(lib.report_diagnostic_count(self.handle.pointer))]

    @property
    def statistics(self) -> Any:
        counted = np.zeros(1, STATISTICS)
        lib.report_statistics(self.handle.pointer, counted.ctypes.data, counted.nbytes)
        return counted[0]

    def rows(self, name: str) -> "NDArray[Any]":
        found = self._arrays.get(name)
        if found is None:
            count = ctypes.c_size_t()
            first = getattr(lib, "report_" + name)(self.handle.pointer, ctypes.byref(count))
            found = self._arrays[name] = view(first, (count.value,), _ROWS[name], self.handle)
        return found

    def mesh(self, object: Any) -> Optional[Mesh]:
        return Mesh._or_none(made(lib.mesh_release, lib.report_mesh, self.handle.pointer, id_to_c(object)))

    def positions(self, object: Any) -> "Optional[NDArray[Any]]":
        found = _structs.Positions()
        lib.report_positions(self.handle.pointer, id_to_c(object), ctypes.byref(found))
        return viewed(found, self.handle)

    def _diagnostic(self, index: int) -> Diagnostic:
        found = _structs.Diagnostic()
        lib.report_diagnostic(self.handle.pointer, index, ctypes.byref(found))
        return Diagnostic(ObjectId(found.object.index, found.object.generation), DiagnosticKind(found.kind),
                          found.message.decode("utf-8", "replace"))


@dataclass
class _Copied:
    """The contents of a report in memory of Python, as pickle stores them."""

    frame: int
    tag: int
    complete: bool
    arrays: Dict[str, Any]
    diagnostics: List[Diagnostic]
    statistics: Any
    meshes: Dict[ObjectId, Mesh]
    places: Dict[ObjectId, Any]

    def rows(self, name: str) -> "NDArray[Any]":
        rows: "NDArray[Any]" = self.arrays[name]
        rows.flags.writeable = False
        return rows

    def mesh(self, object: Any) -> Optional[Mesh]:
        return self.meshes.get(object_id(object))

    def positions(self, object: Any) -> "Optional[NDArray[Any]]":
        return self.places.get(object_id(object))


class Report:
    """The answer of one step. It never changes, so any thread may read it.

    Its arrays are structured, read-only, and look into the library's memory without a copy. An array keeps that memory
    as long as it lives, also after the report and the scene are gone. So let go of arrays soon, or take `copy`.
    """

    def __init__(self, source: Union[Handle, _Copied], kept: Optional[Tuple[ObjectId, ...]] = None) -> None:
        self._source = _InLibrary(source) if isinstance(source, Handle) else source
        self._kept = kept  # the objects whose geometry a copy has, and None for a report of a scene

    @property
    def _pointer(self) -> Optional[int]:
        """The handle of the report, or None if it was unpickled."""
        return self._source.handle.pointer if isinstance(self._source, _InLibrary) else None

    def __repr__(self) -> str:
        return f"<graze.Report of frame {self.frame} with {len(self.pairs)} pairs and {len(self.contacts)} contacts>"

    @property
    def frame(self) -> int:
        """The number of the step. The first is 1."""
        return self._source.frame

    @property
    def tag(self) -> int:
        """The number that was given to the step."""
        return self._source.tag

    @property
    def complete(self) -> bool:
        """Whether no budget cut a pair short, and no limit left contacts out."""
        return self._source.complete

    @property
    def pairs(self) -> "NDArray[Any]":
        """A row for each listed pair, of type `graze.PAIR`."""
        return self._source.rows("pairs")

    @property
    def contacts(self) -> "NDArray[Any]":
        """The contacts of all pairs in the order of the pairs, of type `graze.CONTACT`."""
        return self._source.rows("contacts")

    @property
    def region_distances(self) -> "NDArray[Any]":
        """The region distances of all pairs, of type `graze.REGION_DISTANCE`."""
        return self._source.rows("region_distances")

    @property
    def impacts(self) -> "NDArray[Any]":
        """The features that meet between two steps, of type `graze.IMPACT`."""
        return self._source.rows("impacts")

    def contacts_of(self, pair: Any) -> "NDArray[Any]":
        """Returns the contacts of one row of `pairs`, given by itself or by its index."""
        return self._part("contacts", pair, "first_contact", "contact_count")

    def region_distances_of(self, pair: Any) -> "NDArray[Any]":
        """Returns the region distances of one row of `pairs`, given by itself or by its index."""
        return self._part("region_distances", pair, "first_region_distance", "region_distance_count")

    def impacts_of(self, pair: Any) -> "NDArray[Any]":
        """Returns the impacts of one row of `pairs`, given by itself or by its index."""
        return self._part("impacts", pair, "first_impact", "impact_count")

    @property
    def diagnostics(self) -> List[Diagnostic]:
        """The mistakes in the input of the step. It is empty if all was good."""
        return list(self._source.diagnostics)

    @property
    def statistics(self) -> Any:
        """Counters, bytes and times in milliseconds: a record of type `graze.STATISTICS`."""
        return self._source.statistics

    def mesh(self, object: Any) -> Optional[Mesh]:
        """Returns the mesh of an object as the step saw it, or None if it was not in the scene."""
        return self._source.mesh(object)

    def positions(self, object: Any) -> "Optional[NDArray[Any]]":
        """Returns the positions of an object in the step, read-only, or None unless the object has `queries`."""
        return self._source.positions(object)

    def patch(self, tool: Any) -> "Optional[Patch]":
        """Returns what lay around an object with `patch_radius`, or None. A report that was unpickled has none."""
        if not isinstance(self._source, _InLibrary):
            return None
        patch = Patch(self._source.handle, tool)
        return patch if patch._found.exists else None

    def copy(self) -> "Report":
        """Copies the report, so that it takes no room of its scene. The copy can be kept for long, and pickled."""
        if isinstance(self._source, _Copied) or self._kept is not None:
            return self
        return Report(made(lib.report_release, lib.report_copy, self._pointer), self._objects_with_geometry())

    def __reduce__(self) -> "Tuple[Any, ...]":
        return Report, (self._copied(),)

    def _copied(self) -> _Copied:
        if isinstance(self._source, _Copied):
            return self._source
        kept = self._objects_with_geometry() if self._kept is None else self._kept
        meshes = {object: mesh for object in kept for mesh in [self.mesh(object)] if mesh is not None}
        positions = {object: np.array(at) for object in kept for at in [self.positions(object)] if at is not None}
        return _Copied(self.frame, self.tag, self.complete, {name: np.array(self._source.rows(name)) for name in _ROWS},
                       self.diagnostics, self.statistics, meshes, positions)

    def _objects_with_geometry(self) -> "Tuple[ObjectId, ...]":
        """Returns the objects whose mesh and positions the report keeps. Coordinates are at most 2^120."""
        from .scene_query import SceneQuery

        most = 2.0**120
        return tuple(SceneQuery(self).objects_in_box([-most] * 3, [most] * 3))

    def _part(self, name: str, pair: Any, first: str, count: str) -> "NDArray[Any]":
        row = pair if isinstance(pair, np.void) else self.pairs[pair]
        begin = int(row[first])
        return self._source.rows(name)[begin:begin + int(row[count])]


def report_of(function: Any, *arguments: Any) -> Report:
    """Calls a function whose last parameter takes the handle of a report."""
    return Report(made(lib.report_release, function, *arguments))
