"""Instants of a route that are later if it begins later, or wait for something.

Whatever lies behind, each is a sum after the route's begin, or another instant, whichever is later:
so for all begins at once it is two numbers. One is no later than another from some begin on, up to
some begin. Times in ms.
"""

from typing import NamedTuple

from model.problem import UNLIMITED

NEVER = -4 * UNLIMITED
"""Before all that happens."""


class Begins(NamedTuple):
    """When a route may begin: from one instant up to another."""

    first: int
    last: int

    def within(self, other: "Begins") -> "Begins":
        """Return those that are among others, too."""
        return Begins(max(self.first, other.first), min(self.last, other.last))

    def __bool__(self) -> bool:
        return self.first <= self.last


ANY, NONE = Begins(NEVER, -NEVER), Begins(0, -1)


class Instant(NamedTuple):
    """So long after the route's begin, but not before `least`."""

    after: int
    least: int = NEVER

    def at(self, begin: int) -> int:
        """Return it for a route that begins then."""
        return max(begin + self.after, self.least)

    def plus(self, duration: int) -> "Instant":
        """Return an instant so much later."""
        return Instant(self.after + duration, self.least + duration)

    def or_later(self, other: "Instant") -> "Instant":
        """Return the later of both."""
        return Instant(max(self.after, other.after), max(self.least, other.least))

    def until(self, other: "Instant") -> Begins:
        """Return for which begins it is no later than another."""
        first, last = NEVER, -NEVER
        if self.after > other.after:
            last = other.least - self.after
        if self.least > other.least:
            first = self.least - other.after
        return Begins(first, last)

    @property
    def turn(self) -> int:
        """The last begin for which it doesn't hang on that."""
        return self.least - self.after


def fixed(time: int) -> Instant:
    """Return an instant that is the same whenever a route begins."""
    return Instant(NEVER, time)


BEGIN = Instant(0)
