"""Finds the shared library, and calls it.

A function raises what its status says. `ctypes` gives up the interpreter's lock during each call, so other threads run
during a step.
"""

import ctypes
import os
import pathlib
from typing import Any, List, NoReturn

from ._functions import FUNCTIONS, STATUS
from .errors import Error

NAME = "libgraze_c.so.0"
OK, OUT_OF_MEMORY = 0, 3


class Library:
    """The functions of the library, by their names without `graze_`."""

    def __init__(self, path: str) -> None:
        self.path = path
        self._loaded = ctypes.CDLL(path)
        for name, (result, arguments) in FUNCTIONS.items():
            function = getattr(self._loaded, "graze_" + name)
            function.restype = result
            function.argtypes = arguments
            if result is STATUS:
                function.errcheck = self._check
            setattr(self, name, function)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"graze.h has no graze_{name}")

    def _check(self, status: int, function: Any, arguments: Any) -> None:
        if status != OK:
            self._raise(status)

    def _raise(self, status: int) -> NoReturn:
        message = self._loaded.graze_last_error().decode("utf-8", "replace")
        raise MemoryError(message) if status == OUT_OF_MEMORY else Error(message)


def candidates() -> List[str]:
    """Returns where the library may be, in the order in which these are tried."""
    chosen = os.environ.get("GRAZE_LIBRARY")
    if chosen:
        return [chosen]
    beside = pathlib.Path(__file__).resolve().parent / NAME
    return [str(beside), NAME]


def load() -> Library:
    """Loads the library. Raises `ImportError` with what was tried where there is none."""
    failures = []
    for path in candidates():
        try:
            return Library(path)
        except OSError as error:
            failures.append(str(error))
        except AttributeError as error:
            failures.append(f"{path} is another version of graze: {error}")
    raise ImportError("graze found no shared library; set GRAZE_LIBRARY to its path (" + "; ".join(failures) + ")")


lib = load()


def library_version() -> str:
    """Returns the version of the library, such as "0.2.0"."""
    numbers = (ctypes.c_int32 * 3)()
    lib.library_version(numbers)
    return ".".join(str(number) for number in numbers)


def max_threads() -> int:
    """Returns the largest number of threads that a scene uses."""
    return int(lib.max_threads())


def instruction_set() -> str:
    """Returns the name of the instruction set in use, such as "avx2"."""
    return str(lib.instruction_set().decode())


def use_instruction_set(name: str) -> None:
    """Chooses the instruction set of the process. Raises `Error` if the processor does not have it."""
    lib.use_instruction_set(name.encode())
