"""Handles of the library, and arrays that look into its memory and keep it."""

from ctypes import byref, c_void_p
from typing import Any, Callable, Dict, Optional, Tuple

import numpy as np

from .errors import Error

NO_LIMIT = 2**64 - 1
NO_INDEX = 2**32 - 1


class Handle:
    """Owns one handle of the library. It is released with the last reference to this object."""

    __slots__ = ("pointer", "_release")

    def __init__(self, pointer: Optional[int], release: Callable[[Optional[int]], None]) -> None:
        self.pointer = pointer
        self._release = release

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        pointer, self.pointer = self.pointer, None
        if pointer is not None:
            self._release(pointer)

    def open_pointer(self, what: str) -> int:
        if self.pointer is None:
            raise Error(f"the {what} is closed")
        return self.pointer


def made(release: Callable[[Optional[int]], None], make: Callable[..., None], *arguments: Any) -> Handle:
    """Calls a function whose last parameter takes a new handle, and owns what it gives."""
    room = c_void_p()
    make(*arguments, byref(room))
    return Handle(room.value, release)


class _Memory:
    """Describes memory to numpy, and keeps the handle that it belongs to."""

    __slots__ = ("__array_interface__", "owner")
    __array_interface__: Dict[str, Any]
    owner: Any


def view(address: Optional[int], shape: Tuple[int, ...], dtype: "np.dtype[Any]", owner: Any,
         strides: Optional[Tuple[int, ...]] = None) -> "np.ndarray[Any, Any]":
    """Returns a read-only array over memory of the library. The array keeps `owner` alive, and copies nothing."""
    if not address or 0 in shape:
        empty = np.empty(shape, dtype)
        empty.flags.writeable = False
        return empty
    memory = _Memory()
    plain = dtype.names is None
    memory.__array_interface__ = {
        "version": 3, "data": (address, True), "shape": shape, "strides": strides,
        "typestr": dtype.str if plain else f"|V{dtype.itemsize}"}
    memory.owner = owner
    array = np.asarray(memory)
    return array if plain else array.view(dtype)


def unsigned(value: Any, bits: int, name: str) -> int:
    """Returns a whole number, checked: ctypes would cut one that is negative or too large."""
    try:
        number = value.__index__()
    except AttributeError:
        raise Error(f"{name} is {value!r}, which is no whole number") from None
    if not 0 <= number < 2**bits:
        raise Error(f"{name} is {number}, which is not from 0 to {2**bits - 1}")
    return int(number)
