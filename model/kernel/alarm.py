"""A flag that compiled code looks at, raised at a deadline or once a caller wants no more."""

import math
import threading
import time
from collections.abc import Callable
from types import TracebackType

import numpy as np

from model.problem import IntArray

LOOKS = 0.01
"""Seconds between two looks at whether the caller wants no more."""


def silent() -> IntArray:
    """Return the flag of an alarm that never rings."""
    return np.zeros(1, np.int64)


class Alarm:
    """Raises its flag from a thread of its own, while compiled code runs without the interpreter.

    Compiled code would have to ask the system for the time, and couldn't ask the caller at all;
    a number in memory costs it nothing that can be measured.
    """

    def __init__(self, deadline: float, should_stop: Callable[[], bool] = lambda: False) -> None:
        """Ring at `deadline`, on `time.perf_counter`, or once `should_stop` says so."""
        self.flag = silent()
        self._deadline = deadline
        self._should_stop = should_stop
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="alarm", daemon=True)

    @property
    def has_rung(self) -> bool:
        """Tell whether it has rung."""
        return bool(self.flag[0])

    def __enter__(self) -> "Alarm":
        if self._is_time():
            self.flag[0] = 1
        else:
            self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()

    def _is_time(self) -> bool:
        return time.perf_counter() >= self._deadline or self._should_stop()

    def _watch(self) -> None:
        left = math.inf
        while not self._over.wait(max(0.0, min(LOOKS, left))):
            if self._is_time():
                self.flag[0] = 1
                return
            left = self._deadline - time.perf_counter()
