"""The distance and the contacts of two surfaces, without a scene."""

import ctypes
from dataclasses import dataclass
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._convert import query_to_c
from ._library import lib
from ._memory import made, view
from ._positions import described, readable
from .enums import Inside
from .mesh import Mesh, as_mesh
from .rows import CONTACT, WAY_OUT, WITNESS
from .settings import QuerySettings


@dataclass(frozen=True)
class QueryResult:
    """The answer about two surfaces. If `is_in_range` is False, only distance and witness say anything.

    `distance` has the lower and the upper bound. `witness` and `way_out` are records of the types `graze.WITNESS` and
    `graze.WAY_OUT`. `contacts` is an array of its own.
    """

    in_contact: bool
    is_in_range: bool
    contacts_cut: bool
    inside: Inside
    distance: Tuple[float, float]
    witness: Any
    way_out: Any
    contacts: "NDArray[Any]"


class RepeatedQuery:
    """A question about the same two meshes at other positions again and again. One thread at a time may use it.

    Settings are a `QuerySettings`, or its members by name.
    """

    def __init__(self, mesh_a: Any, mesh_b: Any, settings: Optional[QuerySettings] = None, **members: Any) -> None:
        self._a, self._b = as_mesh(mesh_a), as_mesh(mesh_b)
        given = query_to_c(QuerySettings(**members) if settings is None else settings)
        self._handle = made(lib.query_release, lib.query_new, self._a._pointer, self._b._pointer, ctypes.byref(given))

    def ask(self, positions_a: Optional[ArrayLike] = None, positions_b: Optional[ArrayLike] = None) -> QueryResult:
        """Answers about positions of both meshes. None stands for the rest positions."""
        at_a, at_b = _positions(self._a, positions_a, "positions_a"), _positions(self._b, positions_b, "positions_b")
        found = _structs.QueryResult()
        lib.query_ask(self._handle.pointer, ctypes.byref(described(at_a)), ctypes.byref(described(at_b)),
                      ctypes.byref(found))
        contacts = np.array(view(found.contacts, (found.contact_count,), CONTACT, self._handle))
        return QueryResult(
            found.in_contact, found.is_in_range, found.contacts_cut, Inside(found.inside),
            (found.distance.lower, found.distance.upper), _record(found.witness, WITNESS),
            _record(found.way_out, WAY_OUT), contacts)


def query(mesh_a: Any, positions_a: Optional[ArrayLike], mesh_b: Any, positions_b: Optional[ArrayLike],
          settings: Optional[QuerySettings] = None, **members: Any) -> QueryResult:
    """Answers once about two surfaces. None stands for the rest positions of a mesh."""
    return RepeatedQuery(mesh_a, mesh_b, settings, **members).ask(positions_a, positions_b)


def _positions(mesh: Mesh, positions: Optional[ArrayLike], name: str) -> "NDArray[Any]":
    return mesh.rest if positions is None else readable(positions, mesh.vertex_count, name)


def _record(struct: Any, dtype: "np.dtype[Any]") -> Any:
    return np.frombuffer(bytes(struct), dtype)[0]
