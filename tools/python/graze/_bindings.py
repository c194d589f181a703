"""Keeps the arrays that steps read."""

import threading
from typing import Any, Callable, Dict, List, Optional, TypeVar

from .rows import ObjectId


Result = TypeVar("Result")


class Bindings:
    """Holds each bound array as long as a step may read it.

    A binding that ends while a step runs is read until that step ends. So its array is set aside, and let go of when
    a later step, or a wait, has returned. The lock makes a call of the library and what is held agree, for calls of
    several threads.
    """

    def __init__(self, is_stepping: Callable[[], bool]) -> None:
        self.is_stepping = is_stepping
        self._bound: Dict[ObjectId, Any] = {}
        self._set_aside: List[Any] = []
        self.lock = threading.RLock()

    def end(self, object: ObjectId, replacement: Optional[Any] = None) -> None:
        """Ends a binding after the library was told. The caller has the lock."""
        old = self._bound.pop(object, None)
        if replacement is not None:
            self._bound[object] = replacement
        if old is not None and self.is_stepping():
            self._set_aside.append(old)

    def of(self, object: ObjectId) -> Optional[Any]:
        """Returns the array that an object is bound to."""
        return self._bound.get(object)

    def during(self, call: Callable[[], Result]) -> Result:
        """Makes a call after which no step runs that ran before it. Lets go of what was set aside before."""
        with self.lock:
            before, self._set_aside = self._set_aside, []
        try:
            result = call()
        except BaseException:
            with self.lock:
                self._set_aside += before
            raise
        return result

    def clear(self) -> None:
        """Lets go of everything, when the scene is gone."""
        with self.lock:
            self._bound.clear()
            self._set_aside.clear()
