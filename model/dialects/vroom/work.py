"""What planning takes beside the search, and what may end it before there is a plan.

The constants are what was measured on one core, on memory that was in use before; the first touch
of new memory may take as long again, which counts once it is spent.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

Pause = Callable[[], None]
"""Called between parts of work; raises whatever ends it."""

SPREAD, LAID_OUT, LISTED = 3e-8, 5e-8, 5e-5
"""Seconds for each leg of a way to travel, to work it out and to hand it to a search; and for each
job of a plan, to judge it."""


class VroomWork(Protocol):
    """The work on a request before its search, in parts between which it may end."""

    @property
    def should_stop(self) -> Callable[[], bool]:
        """Tell whether nobody waits for more."""

    def pause(self) -> None:
        """Go on, or raise what ends the work."""

    def expect(self, seconds: float) -> None:
        """Go on, if there is time enough for what comes next; else raise as `pause` does."""

    def allows(self, seconds: float) -> bool:
        """Tell whether there is time enough for what may come next."""


@dataclass(frozen=True)
class LegLimit:
    """How many legs all matrices of a problem have at most together."""

    legs: int
    setting: str  # what says so, for who is told of it


class Unhurried:
    """Work that takes as long as it will; it is a `VroomWork`."""

    def should_stop(self) -> bool:
        """Tell that somebody waits."""
        return False

    def pause(self) -> None:
        """Go on."""

    def expect(self, seconds: float) -> None:
        """Go on."""

    def allows(self, seconds: float) -> bool:
        """Tell that there is time enough."""
        return True


UNHURRIED = Unhurried()


def model_seconds(nodes: int, ways: int) -> float:
    """Estimate how long the problem that a request becomes takes to build."""
    return SPREAD * ways * nodes**2


def attempt_seconds(nodes: int, ways: int) -> float:
    """Estimate what planning such a problem once takes beside the search."""
    return LAID_OUT * ways * nodes**2 + LISTED * nodes
