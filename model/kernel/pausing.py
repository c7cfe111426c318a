"""Long work in short parts, between which it may be told to end."""

from collections.abc import Callable, Iterator

Pause = Callable[[], None]
"""Called between parts of work that take some milliseconds each; raises whatever ends the work."""


def go_on() -> None:
    """Never end."""


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
