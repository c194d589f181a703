"""Contacts at the positions of a report and at others: separations, pushes, weights."""

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._convert import feature_to_c
from ._library import lib
from ._positions import described, point, readable
from .errors import Error
from .mesh import Mesh
from .rows import CONTACT, CONTACT_GEOMETRY, FOLLOWED_CONTACT, WEIGHTS


class SurfaceWeights(NamedTuple):
    """The vertices that carry a point of a surface, and how much of it each carries. The weights sum to 1."""

    vertices: "NDArray[np.uint32]"
    weights: "NDArray[np.float64]"


def separations(contacts: "NDArray[Any]") -> "NDArray[np.float64]":
    """Returns the distance of each contact with a sign: negative where its vertex lies behind the other surface."""
    rows = _contacts(contacts)
    found = np.empty(len(rows))
    lib.contact_separations(rows.ctypes.data, len(rows), found.ctypes.data, None)
    return found


def pushes(contacts: "NDArray[Any]") -> "NDArray[np.float64]":
    """Returns for each contact the unit direction along which b is moved to make the separation grow: (n, 3)."""
    rows = _contacts(contacts)
    found = np.empty((len(rows), 3))
    lib.contact_separations(rows.ctypes.data, len(rows), None, found.ctypes.data)
    return found


def evaluate(mesh_a: Mesh, positions_a: ArrayLike, mesh_b: Mesh, positions_b: ArrayLike,
             contacts: "NDArray[Any]") -> "NDArray[Any]":
    """Computes where contacts of a report between two objects are at other positions, of type `CONTACT_GEOMETRY`.

    The positions are (n, 3), those of all vertices of each mesh. The signs are those of the report, continued.
    """
    at_a = readable(positions_a, mesh_a.vertex_count, "positions_a")
    at_b = readable(positions_b, mesh_b.vertex_count, "positions_b")
    rows = _contacts(contacts)
    found = np.zeros(len(rows), CONTACT_GEOMETRY)
    lib.evaluate_contacts(mesh_a._pointer, ctypes.byref(described(at_a)), mesh_b._pointer,
                          ctypes.byref(described(at_b)), rows.ctypes.data, len(rows), found.ctypes.data)
    return found


def follow(mesh_a: Mesh, positions_a: ArrayLike, mesh_b: Mesh, positions_b: ArrayLike, contacts: "NDArray[Any]",
           vertices_of_b: bool = False) -> "NDArray[Any]":
    """Computes where contacts have gone at other positions, of type `FOLLOWED_CONTACT`, also to other features.

    A contact of two vertices follows that of a, or with `vertices_of_b` that of b. Where `is_known` is false, the
    geometry is that of `evaluate`.
    """
    at_a = readable(positions_a, mesh_a.vertex_count, "positions_a")
    at_b = readable(positions_b, mesh_b.vertex_count, "positions_b")
    rows = _contacts(contacts)
    found = np.zeros(len(rows), FOLLOWED_CONTACT)
    lib.follow_contacts(mesh_a._pointer, ctypes.byref(described(at_a)), mesh_b._pointer,
                        ctypes.byref(described(at_b)), rows.ctypes.data, len(rows), vertices_of_b, found.ctypes.data)
    return found


def evaluate_features(mesh_a: Mesh, positions_a: ArrayLike, feature_a: Any, mesh_b: Mesh, positions_b: ArrayLike,
                      feature_b: Any) -> Any:
    """Computes where any two features are at positions of the caller's: a record of type `CONTACT_GEOMETRY`."""
    at_a = readable(positions_a, mesh_a.vertex_count, "positions_a")
    at_b = readable(positions_b, mesh_b.vertex_count, "positions_b")
    found = np.zeros(1, CONTACT_GEOMETRY)
    lib.evaluate(mesh_a._pointer, ctypes.byref(described(at_a)), feature_to_c(feature_a), mesh_b._pointer,
                 ctypes.byref(described(at_b)), feature_to_c(feature_b), found.ctypes.data)
    return found[0]


def weights(mesh: Mesh, positions: ArrayLike, feature: Any, at: ArrayLike) -> SurfaceWeights:
    """Returns the weights of the vertices of a feature that give the point `at`."""
    array = readable(positions, mesh.vertex_count, "positions")
    found = np.zeros(1, WEIGHTS)
    lib.surface_weights(mesh._pointer, ctypes.byref(described(array)), feature_to_c(feature), point(at, "at"),
                        found.ctypes.data)
    count = int(found[0]["count"])
    return SurfaceWeights(found[0]["vertex"][:count].copy(), found[0]["weight"][:count].copy())


def in_normal_cone(mesh: Mesh, positions: ArrayLike, feature: Any, direction: ArrayLike) -> bool:
    """Returns whether a direction is within 10.2 degrees of the normal cone of a feature."""
    array = readable(positions, mesh.vertex_count, "positions")
    found = ctypes.c_bool()
    lib.in_normal_cone(mesh._pointer, ctypes.byref(described(array)), feature_to_c(feature),
                       point(direction, "direction"), ctypes.byref(found))
    return found.value


def _contacts(contacts: Any) -> "NDArray[Any]":
    rows = np.atleast_1d(np.asarray(contacts))
    if rows.dtype != CONTACT or rows.ndim != 1:
        raise Error("the contacts are no array of type graze.CONTACT")
    return np.ascontiguousarray(rows)
