"""The data that `CollisionManager` gives of collisions and distances."""

from typing import Any, Dict, Hashable, List, Tuple

import numpy as np
from numpy.typing import NDArray

from .enums import FeatureKind
from .mesh import Mesh
from .report import Report
from .response import pushes, separations
from .rows import ObjectId, feature, object_id

Objects = Dict[ObjectId, Tuple[Hashable, Mesh, bool]]  # name, mesh, whether it is managed


class ContactData:
    """One contact of two objects."""

    def __init__(self, names: Tuple[Hashable, Hashable], faces: Tuple[int, int], normal: "NDArray[np.float64]",
                 point: "NDArray[np.float64]", depth: float) -> None:
        self.names = set(names)
        self._inds = dict(zip(names, faces))
        self._normal, self._point, self._depth = normal, point, depth

    @property
    def normal(self) -> "NDArray[np.float64]":
        """The direction, of length 1, along which one of the two moves away from the other."""
        return self._normal

    @property
    def point(self) -> "NDArray[np.float64]":
        """A point where they touch. For a vertex inside a closed mesh it is the closest point on the surface."""
        return self._point

    @property
    def depth(self) -> float:
        """The depth of a vertex inside a closed mesh. It is 0 where an edge pierces a face."""
        return self._depth

    def index(self, name: Hashable) -> int:
        """Returns the face in contact of the object with a name."""
        return self._inds[name]


class DistanceData:
    """The closest points of two objects."""

    def __init__(self, names: Tuple[Hashable, Hashable], faces: Tuple[int, int],
                 points: "Tuple[NDArray[np.float64], NDArray[np.float64]]", distance: float) -> None:
        self.names = set(names)
        self._inds = dict(zip(names, faces))
        self._points = dict(zip(names, points))
        self._distance = distance

    @property
    def distance(self) -> float:
        """The distance of the two objects."""
        return self._distance

    def index(self, name: Hashable) -> int:
        """Returns the closest face of the object with a name."""
        return self._inds[name]

    def point(self, name: Hashable) -> "NDArray[np.float64]":
        """Returns the closest point on the object with a name."""
        return self._points[name]


def contact_data_of(report: Report, rows: Dict[int, Any], objects: Objects) -> List[ContactData]:
    """Returns the contacts of some rows of a report."""
    found = []
    for row in rows:
        pair = report.pairs[row]
        contacts = report.contacts_of(pair)
        (name_a, mesh_a, _), (name_b, mesh_b, _) = objects[object_id(pair["a"])], objects[object_id(pair["b"])]
        for contact, depth, push in zip(contacts, -separations(contacts), pushes(contacts)):
            faces = (face_of(mesh_a, contact["feature_a"]), face_of(mesh_b, contact["feature_b"]))
            found.append(ContactData((name_a, name_b), faces, push, _point(contact), max(0.0, float(depth))))
    return found


def distance_data_of(pair: Any, objects: Objects) -> DistanceData:
    """Returns the closest points of a row of a report."""
    (name_a, mesh_a, _), (name_b, mesh_b, _) = objects[object_id(pair["a"])], objects[object_id(pair["b"])]
    witness = pair["witness"]
    faces = (face_of(mesh_a, witness["feature_a"]), face_of(mesh_b, witness["feature_b"]))
    points = (witness["point_a"].copy(), witness["point_b"].copy())
    return DistanceData((name_a, name_b), faces, points, float(pair["distance"]["upper"]))


def face_of(mesh: Mesh, of: Any) -> int:
    """Returns a face that has a feature: itself, or the first one at an edge or a vertex."""
    kind, index = feature(of)
    if kind == FeatureKind.FACE:
        return index
    return int((mesh.edge_faces if kind == FeatureKind.EDGE else mesh.vertex_faces)(index)[0])


def _point(contact: Any) -> "NDArray[np.float64]":
    """Returns the point on the surface, which is that of a for a vertex of b that lies inside."""
    on_a = feature(contact["feature_a"]).kind != FeatureKind.VERTEX
    return np.array(contact["point_a" if on_a else "point_b"])
