"""Shows how far warming up has come: a bar on a terminal, elsewhere a line now and then."""

import multiprocessing
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tqdm import tqdm
from tqdm.contrib.logging import logging_redirect_tqdm

from model.kernel.warming import Tell, Warmth

LINE_SECONDS = 10.0
"""Least time between two lines about the same stage."""

BAR = "{desc} |{bar}| {percentage:3.0f} % [{elapsed}]"


def words(warmth: Warmth) -> str:
    """Return how far warming up has come, in words."""
    told = f"{warmth.doing}, about {warmth.share:.0%} done"
    if warmth.decodes:
        told += "; plans with time_limit 0 are made already"
    return told


@contextmanager
def showing(write: Callable[[str], None]) -> Iterator[Tell]:
    """Yield what shows how far warming up has come.

    Parameters
    ----------
    write
        Writes a line, where there is no terminal or other processes share it.
    """
    if sys.stderr.isatty() and multiprocessing.parent_process() is None:
        with logging_redirect_tqdm(), _bar() as bar:
            yield lambda warmth: _advance(bar, warmth)
    else:
        yield Lines(write)


class Lines:
    """Writes a line about each stage, and others while it lasts."""

    def __init__(self, write: Callable[[str], None],
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._write = write
        self._clock = clock
        self._doing: str | None = None
        self._next_at = 0.0

    def __call__(self, warmth: Warmth) -> None:
        """Write a line if it is time. In place."""
        now = self._clock()
        if warmth.doing != self._doing or now >= self._next_at:
            self._write(words(warmth))
            self._doing, self._next_at = warmth.doing, now + LINE_SECONDS


def _bar() -> "tqdm[None]":
    return tqdm(total=1.0, bar_format=BAR, leave=False, file=sys.stderr, dynamic_ncols=True)


def _advance(bar: "tqdm[None]", warmth: Warmth) -> None:
    """Move the bar. In place."""
    bar.set_description_str(warmth.doing, refresh=False)
    bar.n = warmth.share
    bar.refresh()
