"""Recording what a scene is given and what it answers."""

import ctypes
import os
from typing import Any, NamedTuple, Optional, Union

from . import _structs
from ._convert import path_to_c, recorder_to_c
from ._library import lib
from ._memory import made
from .scene import Scene
from .settings import RecorderSettings

Path = Union[str, "os.PathLike[str]"]


class RecorderStatistics(NamedTuple):
    """Counts what a recorder has done: frames kept, frames that are missing, and bytes."""

    frames: int
    dropped: int
    bytes: int


class Recorder:
    """Records a scene into a file, or without a file keeps the last frames in memory.

    Settings are a `RecorderSettings`, or its members by name. A recorder is a context manager, which closes it. It
    begins between two steps, and only one may be attached to a scene. No step may run while it is made or closed.
    """

    def __init__(self, scene: Scene, file: Optional[Path] = None, settings: Optional[RecorderSettings] = None,
                 **members: Any) -> None:
        given = recorder_to_c(RecorderSettings(**members) if settings is None else settings)
        if file is None:
            self._handle = made(lib.recorder_release, lib.recorder_new_ring, scene._pointer, ctypes.byref(given))
        else:
            self._handle = made(lib.recorder_release, lib.recorder_new, scene._pointer, path_to_c(file),
                                ctypes.byref(given))

    def close(self) -> None:
        """Detaches from the scene, and finishes the file. Raises `Error` if that could not be written."""
        if self._handle.pointer is not None:
            lib.recorder_close(self._handle.pointer)

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()

    def write(self, file: Path) -> RecorderStatistics:
        """Writes the frames that are kept in memory into a file. Raises `Error` if there are none to keep."""
        found = _structs.RecorderStatistics()
        lib.recorder_write(self._handle.open_pointer("recorder"), path_to_c(file), ctypes.byref(found))
        return RecorderStatistics(found.frames, found.dropped, found.bytes)

    @property
    def statistics(self) -> RecorderStatistics:
        """The counts of what was recorded so far."""
        found = _structs.RecorderStatistics()
        lib.recorder_get_statistics(self._handle.open_pointer("recorder"), ctypes.byref(found))
        return RecorderStatistics(found.frames, found.dropped, found.bytes)
