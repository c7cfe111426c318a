"""Places that are far from all others: hardly meant."""

from collections.abc import Sequence
from statistics import median

from app.maps.addresses.distances import metres_between

FAR_M, FAR_TIMES = 50_000.0, 10.0
"""A place is far off that is so many metres from the middle of all, and so many times as far as
most of them."""

FEWEST = 4
"""Places of which one may be far from the others."""


def far_places(points: Sequence[tuple[float, float]]) -> set[int]:
    """Return which of some places, by longitude and latitude, are far from most others."""
    if len(points) < FEWEST:
        return set()
    middle = median(lon for lon, _ in points), median(lat for _, lat in points)
    away = [metres_between(*middle, *point) for point in points]
    limit = max(FAR_M, FAR_TIMES * median(away))
    return {place for place, metres in enumerate(away) if metres > limit}
