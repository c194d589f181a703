"""Scenes: objects, how they move, and steps."""

import ctypes
import math
from typing import Any, Dict, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._bindings import Bindings
from ._convert import (capacity_to_c, empty, group_bytes, id_to_c, object_from_c, object_to_c, rule_to_c, scene_from_c,
                       scene_to_c)
from ._library import lib
from ._memory import NO_INDEX, made, unsigned
from ._positions import are_good, bindable, described, pose_rows, readable
from .enums import BindPolicy
from .errors import Error
from .mesh import Mesh, as_mesh
from .report import Report, report_of
from .rows import ID, ObjectId, object_id
from .settings import ObjectSettings, PairRule, SceneCapacity, SceneSettings


class Scene:
    """Holds objects and answers for all pairs between them. docs/embedding.md has the rules.

    Settings are a `SceneSettings`, or its members by name: `Scene(contact_distance=0.01)`. A scene is a context
    manager, which closes it. All calls but steps and `wait` may come from any thread. One thread at a time may step.
    Other threads of Python run during a step.

    What the next step cannot take becomes a `Diagnostic` of its report. Arrays of the wrong shape or length raise
    `Error` at once.
    """

    def __init__(self, settings: Optional[SceneSettings] = None, **members: Any) -> None:
        given = scene_to_c(_settings(SceneSettings, settings, members))
        self._handle = made(lib.scene_release, lib.scene_new, ctypes.byref(given), None)
        self._meshes: Dict[ObjectId, Mesh] = {}
        handle = self._handle  # not self: a cycle would keep bound arrays until the collector comes
        self._bindings = Bindings(lambda: handle.pointer is not None and bool(lib.scene_is_stepping(handle.pointer)))

    @property
    def _pointer(self) -> int:
        return self._handle.open_pointer("scene")

    def close(self) -> None:
        """Waits for a step that runs, and frees the scene. No other thread may use it meanwhile."""
        self._handle.close()
        self._bindings.clear()

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if hasattr(self, "_bindings"):
            self.close()

    @property
    def settings(self) -> SceneSettings:
        """The settings that the scene was made with."""
        read = empty(_structs.SceneSettings)
        lib.scene_get_settings(self._pointer, ctypes.byref(read))
        return scene_from_c(read)

    def add(self, mesh: Any, settings: Optional[ObjectSettings] = None, **members: Any) -> ObjectId:
        """Adds an object at the rest shape of its mesh, and returns its id.

        Settings are an `ObjectSettings`, or its members by name: `scene.add(mesh, name="cloth")`.
        """
        shape = as_mesh(mesh)
        given = object_to_c(_settings(ObjectSettings, settings, members))
        room = _structs.Id()
        with self._bindings.lock:
            lib.scene_add(self._pointer, shape._pointer, ctypes.byref(given), ctypes.byref(room))
            added = ObjectId(room.index, room.generation)
            self._meshes[added] = shape
        return added

    def replace_mesh(self, object: Any, mesh: Any, new_of_old: ArrayLike,
                     face_groups: Optional[Sequence[int]] = None) -> None:
        """Gives an object another mesh under the same id, and ends its binding.

        `new_of_old` has the new vertex of each old one, or `Mesh.NO_VERTEX`.
        """
        key, shape = object_id(object), as_mesh(mesh)
        numbers = np.asarray(new_of_old)
        if numbers.ndim != 1 or numbers.dtype.kind not in "iu" or (
                numbers.size and (numbers.min() < 0 or numbers.max() > NO_INDEX)):
            raise Error("new_of_old is no list of vertices")
        numbers = np.ascontiguousarray(numbers, np.uint32)
        groups = group_bytes(face_groups or (), "face_groups")
        room = (ctypes.c_uint8 * len(groups)).from_buffer_copy(groups) if groups else None
        with self._bindings.lock:
            lib.scene_replace_mesh(self._pointer, id_to_c(key), shape._pointer, numbers.ctypes.data, len(numbers),
                                   room, len(groups))
            if key in self._meshes:
                self._meshes[key] = shape
            self._bindings.end(key)

    def remove(self, object: Any) -> None:
        """Removes an object and ends its binding."""
        key = object_id(object)
        with self._bindings.lock:
            lib.scene_remove(self._pointer, id_to_c(key))
            self._meshes.pop(key, None)
            self._bindings.end(key)

    def __len__(self) -> int:
        return int(lib.scene_object_count(self._pointer))

    def __contains__(self, object: Any) -> bool:
        return bool(lib.scene_contains(self._pointer, id_to_c(object)))

    def mesh(self, object: Any) -> Optional[Mesh]:
        """Returns the mesh of an object by all calls so far, or None if the id names none."""
        return self._meshes.get(object_id(object))

    def object_settings(self, object: Any) -> ObjectSettings:
        """Returns the settings of an object, or default ones if the id names none."""
        read = empty(_structs.ObjectSettings)
        lib.scene_get_object_settings(self._pointer, id_to_c(object), ctypes.byref(read))
        return object_from_c(read)

    def name(self, object: Any) -> str:
        """Returns the name of an object. It is empty if the id names none."""
        room = ctypes.c_char_p()
        lib.scene_name(self._pointer, id_to_c(object), ctypes.byref(room))
        return (room.value or b"").decode("utf-8", "replace")

    def set_pose(self, object: Any, pose: ArrayLike, *, teleport: bool = False) -> None:
        """Places a rigid or fixed object by a 4 x 4 matrix for column vectors, a 3 x 4 one, or a 3 x 3 rotation.

        With `teleport` it jumps: nothing between is swept.
        """
        rows, whole = pose_rows(pose)
        self._place(np.array([tuple(object_id(object))], ID), rows[None], whole, teleport)

    def set_poses(self, objects: Sequence[Any], poses: ArrayLike, *, teleport: bool = False) -> None:
        """Places many rigid or fixed objects by an (n, 4, 4) array. One step takes up all of them."""
        matrices = np.ascontiguousarray(poses, np.float64)
        ids = np.array([tuple(object_id(object)) for object in objects], ID)
        if matrices.shape != (len(ids), 4, 4):
            raise Error(f"poses has the shape {matrices.shape}, which is not ({len(ids)}, 4, 4)")
        self._place(ids, matrices, True, teleport)

    def set_positions(self, object: Any, positions: ArrayLike, *, max_displacement: float = math.inf,
                      teleport: bool = False) -> None:
        """Copies the (n, 3) positions of a deformable object, and ends its binding.

        `max_displacement` promises how far any vertex is at most from where the last step saw it.
        """
        key = object_id(object)
        with self._bindings.lock:
            array = readable(positions, self._vertex_count(key), "positions")
            given = ctypes.byref(described(array))
            if teleport:
                lib.scene_teleport_positions(self._pointer, ctypes.byref(id_to_c(key)), 1, given)
            else:
                lib.scene_set_positions(self._pointer, ctypes.byref(id_to_c(key)), 1, given, max_displacement)
            # Bad positions are not taken, and then steps go on reading what is bound.
            if self._bindings.of(key) is not None and are_good(array):
                self._bindings.end(key)

    def bind_positions(self, object: Any, positions: "NDArray[Any]",
                       policy: BindPolicy = BindPolicy.EVERY_STEP) -> None:
        """Lets steps read the positions of a deformable object where they lie in an array, without a copy.

        The array is (n, 3) of float32 or float64 with any strides above 0, such as a part of a larger one. The scene
        keeps it as long as it is bound. Write to it between steps only, and do not resize it.
        """
        key = object_id(object)
        with self._bindings.lock:
            array = bindable(positions, self._vertex_count(key), "positions")
            lib.scene_bind_positions(self._pointer, ctypes.byref(id_to_c(key)), 1, ctypes.byref(described(array)),
                                     BindPolicy(policy))
            self._bindings.end(key, array)

    def bound_positions(self, object: Any) -> "Optional[NDArray[Any]]":
        """Returns the array that an object is bound to, or None."""
        return self._bindings.of(object_id(object))

    def unbind_positions(self, object: Any) -> None:
        """Ends a binding. If a step is running, the array is kept until it ends."""
        key = object_id(object)
        with self._bindings.lock:
            lib.scene_unbind_positions(self._pointer, id_to_c(key))
            self._bindings.end(key)

    def positions_changed(self, object: Any, max_displacement: float = math.inf, *, teleport: bool = False) -> None:
        """Tells the scene that bound memory was written, and how far any vertex moved at most."""
        given = ctypes.byref(id_to_c(object))
        if teleport:
            lib.scene_positions_jumped(self._pointer, given, 1)
        else:
            lib.scene_positions_changed(self._pointer, given, 1, ctypes.byref(ctypes.c_double(max_displacement)))

    def ignore(self, a: Any, b: Any) -> None:
        """Takes one pair out, until `watch` puts it back."""
        lib.scene_ignore(self._pointer, id_to_c(a), id_to_c(b))

    def watch(self, a: Any, b: Any) -> None:
        """Puts a pair back that `ignore` took out."""
        lib.scene_watch(self._pointer, id_to_c(a), id_to_c(b))

    def ignore_groups(self, a: Any, group_a: int, b: Any, group_b: int) -> None:
        """Takes faces of a group of `a` and faces of a group of `b` out: they are not tested against each other."""
        self._groups(lib.scene_ignore_groups, a, group_a, b, group_b)

    def watch_groups(self, a: Any, group_a: int, b: Any, group_b: int) -> None:
        """Puts faces back that `ignore_groups` took out by the same groups."""
        self._groups(lib.scene_watch_groups, a, group_a, b, group_b)

    def set_rule(self, kind_a: int, kind_b: int, rule: Optional[PairRule]) -> None:
        """Gives thresholds to every pair of two kinds. None takes the last rule back."""
        given = None if rule is None else ctypes.byref(rule_to_c(rule))
        lib.scene_set_rule(self._pointer, unsigned(kind_a, 32, "kind_a"), unsigned(kind_b, 32, "kind_b"), given)

    def reserve(self, capacity: Optional[SceneCapacity] = None, **members: Any) -> None:
        """Makes room ahead of time. Takes a `SceneCapacity`, or its members by name."""
        given = capacity_to_c(_settings(SceneCapacity, capacity, members))
        lib.scene_reserve(self._pointer, ctypes.byref(given))

    def step(self, tag: int = 0) -> Report:
        """Runs one step and returns its report, which has `tag`. Raises `Error` if another step is running."""
        return self._bindings.during(lambda: report_of(lib.scene_step, self._pointer, unsigned(tag, 64, "tag")))

    def step_async(self, tag: int = 0) -> None:
        """Begins a step on another thread. Bound memory must not change until `wait` has returned."""
        def begin() -> None:
            lib.scene_step_async(self._pointer, unsigned(tag, 64, "tag"))

        self._bindings.during(begin)

    @property
    def is_stepping(self) -> bool:
        """Whether a step is running."""
        return self._bindings.is_stepping()

    def wait(self) -> Report:
        """Waits until no step is running, and returns the latest report."""
        return self._bindings.during(lambda: report_of(lib.scene_wait, self._pointer))

    def latest_report(self) -> Report:
        """Returns the last report without waiting. Before the first step it is empty, of frame 0."""
        return report_of(lib.scene_latest_report, self._pointer)

    def _place(self, ids: "NDArray[Any]", poses: "NDArray[Any]", whole: bool, teleport: bool) -> None:
        """Places objects by their upper three rows. The library says what is wrong with a last row."""
        if whole and not (np.abs(poses[:, 3:] - [0, 0, 0, 1]) <= 1e-6).all():
            lib.scene_set_pose_matrices(self._pointer, ids.ctypes.data, len(ids), poses.ctypes.data)
        else:
            rows = np.ascontiguousarray(poses[:, :3])
            lib.scene_set_poses(self._pointer, ids.ctypes.data, len(ids), rows.ctypes.data, teleport)

    def _vertex_count(self, object: ObjectId) -> int:
        mesh = self._meshes.get(object)
        if mesh is None:
            raise Error(f"{object} names no object of the scene")
        return mesh.vertex_count

    def _groups(self, call: Any, a: Any, group_a: int, b: Any, group_b: int) -> None:
        call(self._pointer, id_to_c(a), unsigned(group_a, 8, "group_a"), id_to_c(b), unsigned(group_b, 8, "group_b"))


def _settings(kind: Any, given: Any, members: Dict[str, Any]) -> Any:
    """Returns settings, which are given as a whole or by their members."""
    if given is None:
        return kind(**members)
    if members:
        raise TypeError(f"take a {kind.__name__} or its members, and not both")
    return given
