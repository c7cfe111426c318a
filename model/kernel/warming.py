"""Tells how far a planner has been warmed, while it is."""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NamedTuple

from model.kernel.compiled import Count, counting

PERIOD = 0.5
"""Seconds after which the share of what is compiled is told again."""


UP_TO_LAST = 0.65
"""Share of the time until all functions are compiled but the last, which holds the whole search."""

MOST = 0.99
"""Share that is told at most before the end."""


class Warmth(NamedTuple):
    """How far a planner has been warmed."""

    doing: str
    share: float  # of the whole, estimated
    decodes: bool = False  # plans that nothing improves can be made


Tell = Callable[[Warmth], None]


class Estimate:
    """Estimates the share of the time that is over, between functions by the pace so far.

    Parameters
    ----------
    now
        When it begins, in seconds.
    """

    def __init__(self, now: float) -> None:
        self._began = self._counted_at = now
        self._counted = self._told = 0.0

    def share(self, compiled: float, now: float) -> float:
        """Return the estimate with a share of all functions compiled; it never falls. In place."""
        counted = compiled * UP_TO_LAST
        if counted > self._counted:
            self._counted, self._counted_at = counted, now
        pace = self._counted / max(self._counted_at - self._began, PERIOD)
        expected = self._counted + pace * (now - self._counted_at)
        self._told = max(self._told, min(expected, MOST))
        return self._told


class Warming:
    """Tells of each stage as it begins, and how the one under way gets on."""

    def __init__(self, count: Count, tell: Tell) -> None:
        self._count = count
        self._tell = tell
        self._doing, self._decodes = "waiting for another process to compile", False
        self._estimate = Estimate(time.monotonic())
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._repeat, name="warmth", daemon=True)

    def enter(self, doing: str, decodes: bool = False) -> None:
        """Begin a stage. In place."""
        self._doing, self._decodes = doing, decodes
        self.tell()

    def tell(self) -> None:
        """Tell how far this has come."""
        share = self._estimate.share(self._count.share(), time.monotonic())
        self._tell(Warmth(self._doing, share, self._decodes))

    def start(self) -> None:
        """Begin to tell now and then. In place."""
        self._thread.start()

    def stop(self) -> None:
        """Tell no more. In place."""
        self._over.set()
        self._thread.join()

    def _repeat(self) -> None:
        while not self._over.wait(PERIOD):
            self.tell()


@contextmanager
def telling(tell: Tell) -> Iterator[Warming]:
    """Yield what tells of the stages that the block goes through."""
    with counting() as count:
        warming = Warming(count, tell)
        warming.start()
        try:
            yield warming
        finally:
            warming.stop()
