"""The lines of drives on roads, as encoded polylines."""

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

import numpy as np
import polyline

from app.maps.roads.engine import USUAL, Driving, NoWayError, RoadsError
from app.maps.roads.roads import Roads

DECIMALS = 6
"""Of coordinates in lines, which each have latitude, or y, first."""

MOST_KNOWN = 10_000
"""Drives whose lines are kept: a job that improves its plan asks for most of them again."""

Line = str | None
Place = tuple[float, float]


def encoded(places: Sequence[Place]) -> str:
    """Return the line through places `(x, y)`."""
    return polyline.encode([(y, x) for x, y in places], DECIMALS)


class RoadLines:
    """Asks for the drives of trips, and keeps what was answered.

    Parameters
    ----------
    roads
        Those that the service has.
    profiles
        Those whose legs are drives on them.
    """

    def __init__(self, roads: Roads, profiles: Collection[str]) -> None:
        self.profiles = profiles
        self._roads = roads
        self._known: dict[tuple[object, ...], list[Line]] = {}

    def along(self, profile: str, places: Sequence[Place], until: float,
              driving: Driving = USUAL) -> list[Line]:
        """Return the line of each drive from place to place, ways to and from the road included.

        Where no road leads from one to the next, which a request may have allowed, it is straight;
        null if roads don't answer until then, on `time.perf_counter`.
        """
        curb = () if driving.curb is None else tuple(driving.curb.tolist())
        key = (profile, tuple(places), driving.avoid, curb)
        if key not in self._known:
            try:
                lines = self._asked(profile, places, until, driving)
            except RoadsError:
                return [None] * (len(places) - 1)
            if len(self._known) >= MOST_KNOWN:
                self._known.clear()
            self._known[key] = lines
        return self._known[key]

    def _asked(self, profile: str, places: Sequence[Place], until: float,
               driving: Driving) -> list[Line]:
        try:
            legs = self._roads.route(profile, np.array(places), until, driving).legs
        except NoWayError:
            if len(places) == 2:
                return [encoded(places)]
            return [line for start, leg in enumerate(pairwise(places))
                    for line in self._asked(profile, leg, until,
                                            driving.among(slice(start, start + 2)))]
        return list(_from_door_to_door(legs, places))


def _from_door_to_door(legs: Sequence[str], places: Sequence[Place]) -> Iterator[Line]:
    for leg, (start, end) in zip(legs, pairwise(places), strict=True):
        driven = [(lon, lat) for lat, lon in polyline.decode(leg, DECIMALS)]
        yield encoded([*([] if driven[:1] == [start] else [start]), *driven,
                       *([] if driven[-1:] == [end] else [end])])
