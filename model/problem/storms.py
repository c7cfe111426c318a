"""Times of the day in which nothing may fly."""

from itertools import pairwise

from model.problem.quantities import UNLIMITED, TimeLimit, require

MAX_STORMS = 16
"""How often a day is too windy, at most."""

MAX_CLOSINGS = 16
"""Times in which zones with hours are closed, at most."""

MAX_TIMED_ZONES = 62
"""Zones with hours, or several with the same, that places can lie in."""

Closings = tuple[tuple[TimeLimit, TimeLimit, int], ...]
"""From and until when no flight to or from some zones may be in the air, ascending by the first;
the zones as bits."""

Storms = tuple[tuple[TimeLimit, TimeLimit], ...]
"""From and until when nothing may be in the air, ascending; the last may never end."""


def require_storms(name: str, storms: Storms) -> None:
    """Raise `ValueError` unless storms are few, and one is over before the next begins."""
    require(len(storms) <= MAX_STORMS, name, len(storms))
    instants = [instant for storm in storms for instant in storm]
    for earlier, later in pairwise((-1, *instants)):
        require(earlier < later <= UNLIMITED, name, storms)


def require_closings(name: str, closings: Closings) -> None:
    """Raise `ValueError` unless closings are few, in order, each of some zones and some time."""
    require(len(closings) <= MAX_CLOSINGS, name, len(closings))
    require(list(closings) == sorted(closings), name, closings)
    for begin, end, zones in closings:
        require(0 <= begin < end <= UNLIMITED and 0 < zones < 1 << MAX_TIMED_ZONES, name, closings)


def barred(storms: Storms, closings: Closings, zones: int) -> Storms:
    """Return from and until when a flight to or from some zones may not be in the air, ascending.
    """
    if not (closings and zones):
        return storms
    return tuple(sorted([*storms, *((begin, end) for begin, end, closed in closings
                                    if closed & zones)]))
