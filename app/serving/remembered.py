"""What was used last, in the memory of this process."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


def one(_: object) -> int:
    """Count each alike."""
    return 1


class Remembered(Generic[Key, Value]):
    """Values by their keys, those used last, for all threads.

    Parameters
    ----------
    most
        How much is remembered.
    size
        How much a value counts.
    """

    def __init__(self, most: int, size: Callable[[Value], int] = one) -> None:
        self._most = most
        self._size = size
        self._lock = threading.Lock()
        self._kept: OrderedDict[Key, Value] = OrderedDict()

    def get(self, key: Key) -> Value | None:
        """Return a value; None: it isn't remembered. In place."""
        with self._lock:
            if key in self._kept:
                self._kept.move_to_end(key)
            return self._kept.get(key)

    def put(self, key: Key, value: Value) -> Value:
        """Remember a value, and return it. In place."""
        with self._lock:
            self._kept[key] = value
            self._kept.move_to_end(key)
            while sum(map(self._size, self._kept.values())) > self._most:
                self._kept.popitem(last=False)
        return value
