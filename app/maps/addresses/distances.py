"""How far places are from each other."""

import math

EARTH_M = 6_371_000.0


def metres_between(lon: float, lat: float, other_lon: float, other_lat: float) -> float:
    """Return the great circle between two places."""
    here, there = math.radians(lat), math.radians(other_lat)
    half = (math.sin((there - here) / 2) ** 2 + math.cos(here) * math.cos(there)
            * math.sin(math.radians(other_lon - lon) / 2) ** 2)
    return 2 * EARTH_M * math.asin(math.sqrt(min(1.0, half)))
