"""Long work in short parts, between which it may be told to end."""

import math
import time
from collections.abc import Callable, Iterator

from model.engine.library import EndedError

__all__ = ["EndedError", "Pause", "go_on", "matrix_blocks", "never", "pausing", "row_blocks"]

Pause = Callable[[], None]
"""Called between parts of work that take some milliseconds each; raises whatever ends the work."""


def go_on() -> None:
    """Never end."""


def never() -> bool:
    """Tell that work isn't to end: nobody asks for that."""
    return False


def pausing(should_stop: Callable[[], bool], deadline: float = math.inf,
            patience: float = 0.0) -> Pause:
    """Return what ends work by an `EndedError`, from `patience` seconds on.

    It does so at `deadline`, on `time.perf_counter`, and once `should_stop` says so.
    """
    first = time.perf_counter() + patience

    def pause() -> None:
        now = time.perf_counter()
        if now >= first and (now >= deadline or should_stop()):
            raise EndedError

    return pause


ENTRIES_AT_ONCE = 2**17
"""Entries of a matrix worked out between two pauses: the whole of every intermediate result would
take gigabytes where there are thousands of nodes, and a part like this stays in the cache."""


def matrix_blocks(size: int, pause: Pause = go_on) -> Iterator[slice]:
    """Yield all rows of a square matrix, some at a time, with a pause before each block."""
    return row_blocks(size, 1 + ENTRIES_AT_ONCE // (1 + size), pause)


def row_blocks(count: int, size: int, pause: Pause) -> Iterator[slice]:
    """Yield all rows, `size` at a time, with a pause before each block."""
    for first in range(0, count, size):
        pause()
        yield slice(first, min(first + size, count))
