"""Work in the background makes way for plans that somebody waits for."""

import os
import sys
import threading
from contextlib import suppress

NICENESS = 10
"""How much less of a busy core a thread gets, by Linux's measure: a tenth of what others get."""


def stand_back() -> None:
    """Have this thread, and those that it begins, get what others leave of the cores. In place.

    Other systems than Linux know no such thing of threads.
    """
    if sys.platform == "linux":
        with suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
