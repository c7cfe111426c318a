"""When the engine ends what it does: at a deadline, or once a caller wants no more."""

import math
import threading
import time
from collections.abc import Callable
from types import TracebackType

import numpy as np

from model.engine.pausing import never
from model.problem import IntArray

LOOKS = 0.005
"""Seconds between two looks at whether the caller wants no more."""

CANCELLED, LAST_INSTANT = 0, 1
"""In an alarm's setting, which the engine reads at any time: not 0 once nobody wants more; and the
last instant in ns. Behind them stands the clock that tells it, `Alarm.clock`."""


def has_rung(setting: IntArray) -> bool:
    """Tell whether an alarm has rung, by its setting."""
    return bool(setting[CANCELLED]) or time.perf_counter() * 1e9 >= setting[LAST_INSTANT]


class Alarm:
    """Ends what the engine does without the interpreter.

    The engine looks at the clock itself. It can't ask the caller: a thread does where there is
    anything to ask, and notes that in the setting.
    """

    clock: int = time.CLOCK_MONOTONIC
    """That of `time.perf_counter`. A measurement by another says so here."""

    def __init__(self, deadline: float = math.inf,
                 should_stop: Callable[[], bool] = never) -> None:
        """Ring at `deadline`, on `time.perf_counter`, or once `should_stop` says so."""
        self.setting = np.array([0, min(deadline * 1e9, 2**63 - 1), self.clock], np.int64)
        self._deadline = deadline
        self._should_stop = should_stop
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="alarm", daemon=True)

    @property
    def has_rung(self) -> bool:
        """Tell whether it has rung."""
        return has_rung(self.setting)

    def sooner(self, deadline: float) -> "Alarm":
        """Return another that rings when this one does, and at a deadline of its own."""
        return Alarm(min(deadline, self._deadline), self._should_stop)

    def __enter__(self) -> "Alarm":
        if self._should_stop is not never:
            self.setting[CANCELLED] = self._should_stop()
            self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()

    def _watch(self) -> None:
        while not (self.has_rung or self._over.wait(LOOKS)):
            self.setting[CANCELLED] = self._should_stop()
