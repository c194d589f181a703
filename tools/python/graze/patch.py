"""Patches: what lies around a tool in one step, for answers between steps."""

import ctypes
from typing import Any, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._convert import id_to_c
from ._library import lib
from ._memory import Handle, made, view
from ._positions import described, doubles, pose_rows, readable, viewed
from .errors import Error
from .rows import CONTACT, ID, PATCH_PAIR, ObjectId, object_id


class PatchAnswer(NamedTuple):
    """The contacts between a tool and its patch, and what they are worth.

    `pairs` are of type `graze.PATCH_PAIR` and `contacts` of type `graze.CONTACT`. All contacts are listed up to
    `threshold`, which is less than what was asked if `complete` is false. `validity` says how much further tool and
    tissue together may travel.
    """

    pairs: "NDArray[Any]"
    contacts: "NDArray[Any]"
    complete: bool
    threshold: float
    validity: float

    def contacts_of(self, pair: Any) -> "NDArray[Any]":
        """Returns the contacts of one row of `pairs`, given by itself or by its index."""
        row = pair if isinstance(pair, np.void) else self.pairs[pair]
        first = int(row["first_contact"])
        return self.contacts[first:first + int(row["contact_count"])]


class Patch:
    """What lies around an object that was added with `patch_radius`: `Report.patch` gives it, for one step.

    Any number of threads may ask it. It keeps its report.
    """

    def __init__(self, handle: Handle, tool: Any) -> None:
        self._handle = handle
        self._tool = object_id(tool)
        self._found = _structs.Patch()
        lib.report_patch(handle.pointer, id_to_c(tool), ctypes.byref(self._found))

    @property
    def tool(self) -> ObjectId:
        """The object whose patch it is."""
        return self._tool

    @property
    def radius(self) -> float:
        """The distance from the tool within which all faces are there."""
        return float(self._found.radius)

    @property
    def is_cut(self) -> bool:
        """Whether `patch_faces` made the radius smaller."""
        return bool(self._found.is_cut)

    @property
    def face_count(self) -> int:
        """The number of faces that are there, of all objects together."""
        return int(self._found.face_count)

    @property
    def objects(self) -> Tuple[ObjectId, ...]:
        """The objects that have faces there, in the order in which they were added."""
        rows = view(self._found.objects, (self._found.object_count,), ID, self._handle)
        return tuple(object_id(row) for row in rows.tolist())

    def faces(self, object: Any) -> "NDArray[np.uint32]":
        """Returns the numbers of the faces of an object that are there, ascending."""
        first, count = ctypes.c_void_p(), ctypes.c_size_t()
        lib.patch_faces(self._handle.pointer, id_to_c(self._tool), id_to_c(object), ctypes.byref(first),
                        ctypes.byref(count))
        return view(first.value, (count.value,), np.dtype(np.uint32), self._handle)

    def positions(self, object: Any) -> "Optional[NDArray[Any]]":
        """Returns the positions of an object's vertices, or None. Those of `faces` mean something."""
        found = _structs.Positions()
        lib.patch_positions(self._handle.pointer, id_to_c(self._tool), id_to_c(object), ctypes.byref(found))
        return viewed(found, self._handle)

    def contacts(self, *, threshold: float, pose: Optional[ArrayLike] = None,
                 positions: Optional[ArrayLike] = None) -> PatchAnswer:
        """Returns the contacts between the tool at a pose or at positions, and the patch.

        They are those of `ContactDetail.NEAREST` at this threshold. Raises `Error` for a pose that is no rotation, or
        positions that do not fit.
        """
        room = made(lib.patch_room_release, lib.patch_room_new)
        answer = _structs.PatchAnswer()
        call, motion = self._motion(pose, positions, lib.patch_contacts_at_pose, lib.patch_contacts_at_positions)
        call(self._handle.pointer, id_to_c(self._tool), motion, threshold, room.pointer, ctypes.byref(answer))
        count = ctypes.c_size_t()
        first = lib.patch_room_pairs(room.pointer, ctypes.byref(count))
        pairs = view(first, (count.value,), PATCH_PAIR, room)
        first = lib.patch_room_contacts(room.pointer, ctypes.byref(count))
        contacts = view(first, (count.value,), CONTACT, room)
        return PatchAnswer(pairs, contacts, answer.complete, answer.threshold, answer.validity)

    def validity(self, *, pose: Optional[ArrayLike] = None, positions: Optional[ArrayLike] = None,
                 threshold: Optional[float] = None) -> float:
        """Returns how much further tool and tissue together may travel until a face could be missing.

        Without a threshold it is the largest that the scene has for a pair of the tool.
        """
        found = ctypes.c_double()
        call, motion = self._motion(pose, positions, lib.patch_validity_at_pose, lib.patch_validity_at_positions)
        limit = None if threshold is None else ctypes.byref(ctypes.c_double(threshold))
        call(self._handle.pointer, id_to_c(self._tool), motion, limit, ctypes.byref(found))
        return found.value

    def _motion(self, pose: Optional[ArrayLike], positions: Optional[ArrayLike], at_pose: Any,
                at_positions: Any) -> "Tuple[Any, Any]":
        """Returns the function to call, and the place of the tool as it takes it."""
        if (pose is None) == (positions is None):
            raise Error("give either a pose or positions")
        if pose is not None:
            rows, _ = pose_rows(pose)
            return at_pose, doubles(rows[:3])
        array = readable(positions, None, "positions")
        place = described(array)
        place.array = array  # what is described has to live
        return at_positions, ctypes.byref(place)
