"""Requests of which one thing is taken away or changed while the day goes on."""

import copy
import random
from collections.abc import Iterator
from typing import Any

Data = dict[str, Any]
Place = tuple[Data | list[Any], Any]
"""What holds a part of a request, and its key or index there."""

KEPT = frozenset({"options", "coordinate_system", "planar_unit", "planar_rounding"})
"""Parts that say how a day is written and planned, not what it is."""

FAR: tuple[Any, ...] = (0, 1, -1, 0.5, 1e5, 9e8, 1e9, None, "a", [], {}, True)
"""What stands instead of something that is changed."""

ENTRIES, TAKEN_AWAY = 0.6, 0.6
"""Shares of days of which an entry of a list is chosen, and of which something is taken away."""


def with_a_thing_gone(rng: random.Random, request: Data) -> Data:
    """Return a request without one of its parts, or with another in its place.

    Entries of lists go more often than fields of theirs: who has gone home, a closed site, a break
    that isn't kept any more.
    """
    later = copy.deepcopy(request)
    parts = list(_parts(later))
    entries = [part for part in parts if isinstance(part[0], list)]
    holder, key = rng.choice(entries if rng.random() < ENTRIES else parts)
    if rng.random() < TAKEN_AWAY:
        del holder[key]
    elif isinstance(holder[key], dict) and "id" in holder[key] and rng.random() < 0.5:
        holder[key]["id"] += " anew"
    elif isinstance(holder[key], int | float) and rng.random() < 0.7:
        holder[key] *= rng.choice((0, 0.5, 2, 10))
    else:
        holder[key] = copy.deepcopy(rng.choice(FAR))
    return later


def _parts(value: Any) -> Iterator[Place]:
    """Yield where all parts of a request are, but for single numbers of lists."""
    if isinstance(value, dict):
        for key in value:
            if key not in KEPT:
                yield value, key
                yield from _parts(value[key])
    elif isinstance(value, list):
        for index, item in enumerate(value):
            if isinstance(item, dict):
                yield value, index
                yield from _parts(item)
