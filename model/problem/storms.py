"""Times of the day in which nothing may fly."""

from itertools import pairwise

from model.problem.quantities import UNLIMITED, TimeLimit, require

MAX_STORMS = 16
"""How often a day is too windy, at most."""

Storms = tuple[tuple[TimeLimit, TimeLimit], ...]
"""From and until when nothing may be in the air, ascending; the last may never end."""


def require_storms(name: str, storms: Storms) -> None:
    """Raise `ValueError` unless storms are few, and one is over before the next begins."""
    require(len(storms) <= MAX_STORMS, name, len(storms))
    instants = [instant for storm in storms for instant in storm]
    for earlier, later in pairwise((-1, *instants)):
        require(earlier < later <= UNLIMITED, name, storms)
