"""Reading recordings, and doing again what they tell."""

import ctypes
from dataclasses import dataclass
from typing import Any, Iterator, List, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _structs
from ._convert import empty, object_from_c, path_to_c, scene_from_c
from ._library import lib
from ._memory import NO_INDEX, Handle, made, unsigned
from .errors import Error
from .mesh import Mesh
from .recorder import Path
from .report import Report, report_of
from .rows import ObjectId
from .settings import ObjectSettings, SceneSettings


class RecordedFrame(NamedTuple):
    """Describes a recorded frame, as far as that needs no replay. `step_ms` is in milliseconds."""

    frame: int
    tag: int
    pairs: int
    pairs_in_contact: int
    contacts: int
    diagnostics: int
    dropped_before: int
    has_keyframe: bool
    complete: bool
    step_ms: float


class ReplayDifference(NamedTuple):
    """Says in words how a replay's answer differs from the recorded one."""

    frame: int
    pair: str
    recorded: str
    replayed: str


@dataclass(frozen=True)
class ReplayObject:
    """An object of a replay. `serial` stays the same from frame to frame and from one replay to the next."""

    id: ObjectId
    serial: int
    mesh: Mesh
    settings: ObjectSettings
    index: int
    step: int


class Recording:
    """A recording in a file. Raises `Error` if it cannot be read, is no recording, or is damaged.

    One thread at a time may use a recording and its replays.
    """

    def __init__(self, file: Path) -> None:
        self._handle = made(lib.recording_release, lib.recording_open, path_to_c(file))

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file. Replays go on."""
        self._handle.close()

    @property
    def _pointer(self) -> int:
        return self._handle.open_pointer("recording")

    @property
    def settings(self) -> SceneSettings:
        """The settings of the recorded scene."""
        read = empty(_structs.SceneSettings)
        lib.recording_settings(self._pointer, ctypes.byref(read))
        return scene_from_c(read)

    @property
    def made_by(self) -> str:
        """The version of graze that made the recording."""
        return str(lib.recording_made_by(self._pointer).decode("utf-8", "replace"))

    @property
    def is_finished(self) -> bool:
        """Whether the program that recorded finished the file."""
        return bool(lib.recording_is_finished(self._pointer))

    @property
    def is_cut(self) -> bool:
        """Whether it is a part of a longer run."""
        return bool(lib.recording_is_cut(self._pointer))

    def __len__(self) -> int:
        return int(lib.recording_frame_count(self._pointer))

    def frame(self, index: int) -> RecordedFrame:
        """Returns what is known of a frame. Raises `Error` for an index that names none."""
        found = _structs.RecordedFrame()
        lib.recording_frame(self._pointer, unsigned(index, 64, "the index"), ctypes.byref(found))
        return RecordedFrame(*(getattr(found, name) for name in RecordedFrame._fields))

    @property
    def frames(self) -> List[RecordedFrame]:
        """The descriptions of all frames."""
        return [self.frame(index) for index in range(len(self))]

    @property
    def dropped_at_end(self) -> int:
        """The number of frames that were dropped after the last one."""
        return int(lib.recording_dropped_at_end(self._pointer))

    @property
    def mesh_count(self) -> int:
        """The number of meshes."""
        return int(lib.recording_mesh_count(self._pointer))

    @property
    def byte_count(self) -> int:
        """The size of the file in bytes."""
        return int(lib.recording_byte_count(self._pointer))

    def check(self) -> None:
        """Reads all of the file, and raises `Error` where it is damaged."""
        lib.recording_check(self._pointer)

    def cut(self, file: Path, first_frame: int = 0, last_frame: int = 2**64 - 1,
            objects: Sequence[int] = ()) -> None:
        """Writes a part into a file of its own. `objects` has the serials of those to keep, none means all."""
        serials = [unsigned(serial, 64, "a serial") for serial in objects]
        lib.recording_cut(self._pointer, unsigned(first_frame, 64, "first_frame"),
                          unsigned(last_frame, 64, "last_frame"), (ctypes.c_uint64 * len(serials))(*serials),
                          len(serials), path_to_c(file))

    def replay(self, first_frame: int = 0, threads: Optional[int] = None) -> "Replay":
        """Returns a replay that begins at a frame. None stands for as many threads as were recorded."""
        count = NO_INDEX if threads is None else unsigned(threads, 32, "threads")
        handle = made(lib.replay_release, lib.replay_new, self._pointer, unsigned(first_frame, 64, "first_frame"),
                      count)
        return Replay(handle)


class Replay:
    """Does again what a recording tells: an iterator over frames.

    Each item is the report of a frame. Until the next one, the members are about that frame:

        for report in recording.replay():
            for object in replay.objects: ...
    """

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        self._steps = 0

    def __iter__(self) -> "Iterator[Report]":
        return self

    def __next__(self) -> Report:
        has_stepped = ctypes.c_bool()
        lib.replay_step(self._handle.pointer, ctypes.byref(has_stepped))
        if not has_stepped.value:
            raise StopIteration
        self._steps += 1
        return self.report

    @property
    def frame_index(self) -> int:
        """The index of the frame in the recording."""
        self._check()
        return int(lib.replay_frame_index(self._handle.pointer))

    @property
    def report(self) -> Report:
        """The report of the frame. Its numbers of frames count from where the replay began."""
        self._check()
        return report_of(lib.replay_report, self._handle.pointer)

    @property
    def difference(self) -> Optional[ReplayDifference]:
        """The difference of the answer from the recorded one, or None."""
        found = _structs.ReplayDifference()
        if not lib.replay_get_difference(self._handle.pointer, ctypes.byref(found)):
            return None
        texts = [text.decode("utf-8", "replace") for text in (found.pair, found.recorded, found.replayed)]
        return ReplayDifference(found.frame, *texts)

    @property
    def rows_not_compared(self) -> int:
        """The number of rows that were not compared with the recorded ones."""
        return int(lib.replay_rows_not_compared(self._handle.pointer))

    @property
    def rows_compared_in_part(self) -> int:
        """The number of rows that were compared in part."""
        return int(lib.replay_rows_compared_in_part(self._handle.pointer))

    @property
    def objects(self) -> List[ReplayObject]:
        """The objects in the frame, in the order of addition."""
        self._check()
        return [self._object(index) for index in range(int(lib.replay_object_count(self._handle.pointer)))]

    def positions(self, object: ReplayObject) -> "NDArray[np.float64]":
        """Returns the positions of an object of `objects` in the frame: an (n, 3) array of its own."""
        self._check_object(object)
        found = np.empty((object.mesh.vertex_count, 3))
        lib.replay_positions(self._handle.pointer, object.index, found.ctypes.data, len(found))
        return found

    def pose(self, object: ReplayObject) -> "NDArray[np.float64]":
        """Returns the 4 x 4 pose of a rigid or fixed object in the frame."""
        self._check_object(object)
        found = np.eye(4)
        lib.replay_pose(self._handle.pointer, object.index, found.ctypes.data)
        return found

    def _object(self, index: int) -> ReplayObject:
        id, serial, mesh = _structs.Id(), ctypes.c_uint64(), ctypes.c_void_p()
        settings = empty(_structs.ObjectSettings)
        lib.replay_object(self._handle.pointer, index, ctypes.byref(id), ctypes.byref(serial), ctypes.byref(mesh),
                          ctypes.byref(settings))
        return ReplayObject(ObjectId(id.index, id.generation), serial.value,
                            Mesh._of(Handle(mesh.value, lib.mesh_release)), object_from_c(settings), index,
                            self._steps)

    def _check_object(self, object: ReplayObject) -> None:
        if object.step != self._steps:
            raise Error("the object is one of an earlier frame; take it from `objects` again")

    def _check(self) -> None:
        if self._steps == 0:
            raise Error("the replay has no frame yet; take the next one first")
