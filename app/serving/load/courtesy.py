"""Work in the background makes way for plans that somebody waits for."""

import os
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress

NICENESS = 10
"""How much less of a busy core a thread gets, by Linux's measure: a tenth of what others get."""

LONGEST, LOOK = 1.0, 0.02
"""Most seconds that work in the background is put off at a time, and between two looks."""


class Courtesy:
    """Puts work off that would hold Python's lock while plans are made.

    Parameters
    ----------
    are_waited_for
        Tells whether somebody waits for a plan of this process.
    """

    def __init__(self, are_waited_for: Callable[[], bool] = lambda: False) -> None:
        self._are_waited_for = are_waited_for

    def give_way(self, should_stop: Callable[[], bool] = lambda: False) -> None:
        """Wait while plans are waited for, if not for long."""
        until = time.monotonic() + LONGEST
        while (self._are_waited_for() and not should_stop() and time.monotonic() < until):
            time.sleep(LOOK)


NOBODY_WAITS = Courtesy()


def stand_back() -> None:
    """Have this thread, and those that it begins, get what others leave of the cores. In place.

    Other systems than Linux know no such thing of threads.
    """
    if sys.platform == "linux":
        with suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
