"""Positions of numpy arrays, described to the library."""

import ctypes
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._memory import view
from .errors import Error

FLOATS = (np.dtype(np.float32), np.dtype(np.float64))


def checked_shape(array: "NDArray[Any]", count: Optional[int], name: str) -> None:
    """Raises `Error` unless the array has three columns and a row for each of `count` vertices."""
    if array.ndim != 2 or array.shape[1] != 3:
        raise Error(f"{name} has the shape {array.shape}, which is not (n, 3)")
    if count is not None and len(array) != count:
        raise Error(f"{name} has {len(array)} points, and the mesh has {count} vertices")


def is_readable_in_place(array: "NDArray[Any]") -> bool:
    """Whether the library can read the array as it lies: numbers in the machine's order, and strides above 0."""
    return (array.dtype in FLOATS and array.dtype.isnative and array.flags.aligned
            and all(stride > 0 and stride % array.itemsize == 0 for stride in array.strides))


def readable(values: ArrayLike, count: Optional[int], name: str) -> "NDArray[Any]":
    """Returns positions that the library can read. It copies only what it cannot read in place."""
    array = np.asarray(values)
    checked_shape(array, count, name)
    if is_readable_in_place(array):
        return array
    if array.dtype.kind not in "fiu":
        raise Error(f"{name} has numbers of type {array.dtype}, which are no coordinates")
    return np.ascontiguousarray(array, np.float32 if array.dtype == FLOATS[0] else np.float64)


def bindable(values: Any, count: int, name: str) -> "NDArray[Any]":
    """Returns the caller's own array, or raises `Error` if steps could not read it where it lies."""
    if not isinstance(values, np.ndarray):
        raise Error(f"{name} is no numpy array, so its memory cannot be bound")
    checked_shape(values, count, name)
    if not is_readable_in_place(values):
        raise Error(f"{name} cannot be bound: it has type {values.dtype} and strides {values.strides}; what can be "
                    "is float32 or float64 in the machine's byte order, aligned, with strides above 0")
    return values


def are_good(array: "NDArray[Any]") -> bool:
    """Whether every coordinate is finite and at most 2^120, so that the library takes the positions for certain."""
    return bool(np.all(np.abs(array) <= 2.0**120))


def described(array: "NDArray[Any]") -> _structs.Positions:
    """Describes an array that `readable` or `bindable` returned. The array has to be kept."""
    return _structs.Positions(array.ctypes.data, len(array), array.strides[0], array.strides[1],
                              array.dtype == FLOATS[1])


def viewed(positions: _structs.Positions, owner: Any) -> "Optional[NDArray[Any]]":
    """Returns positions of the library as an array that keeps `owner`, or None where there are none."""
    if not positions.first:
        return None
    dtype = FLOATS[1 if positions.is_double else 0]
    return view(positions.first, (positions.count, 3), dtype, owner,
                (positions.stride_bytes, positions.coordinate_stride_bytes))


def point(values: ArrayLike, name: str) -> Any:
    """Returns three numbers for a parameter of the library."""
    array = np.asarray(values, np.float64)
    if array.shape != (3,):
        raise Error(f"{name} has the shape {array.shape}, which is not (3,)")
    return doubles(array)


def doubles(array: "NDArray[Any]") -> Any:
    """Copies numbers into an array of ctypes, which lives as long as the call that takes it."""
    flat = np.ascontiguousarray(array, np.float64).ravel()
    return (ctypes.c_double * len(flat)).from_buffer_copy(flat.data)


def pose_rows(pose: ArrayLike) -> "Tuple[NDArray[Any], bool]":
    """Returns the numbers of a pose, and whether they are those of a whole 4 x 4 matrix.

    A 3 x 3 matrix is a rotation about the origin. A 3 x 4 matrix has the translation as its last column.
    """
    matrix = np.ascontiguousarray(pose, np.float64)
    if matrix.shape == (4, 4):
        return matrix, True
    if matrix.shape == (3, 4):
        return matrix, False
    if matrix.shape == (3, 3):
        return np.hstack([matrix, np.zeros((3, 1))]), False
    raise Error(f"the pose has the shape {matrix.shape}, which is none of (4, 4), (3, 4) and (3, 3)")
