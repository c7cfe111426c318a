"""Whether time windows can make any difference to what is planned."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from model.dialects.vroom.kinds import VehicleKind
from model.dialects.vroom.places import Sites
from model.dialects.vroom.request import Request, Window
from model.dialects.vroom.timing import service_of, setup_of
from model.dialects.vroom.windows import MISSED, TIME_SCALE, slots_of, start_in
from model.problem import IntArray


def windows_bind(request: Request, places: Sites, kinds: Sequence[VehicleKind]) -> bool:
    """Tell whether some route may have to wait, or to be over sooner, for a time window's sake.

    It has not where one instant is so long before windows close that the longest of all routes,
    begun then, meets everybody in an open one.
    """
    if not request.is_timed:
        return False
    open_for = [max(job.time_windows, key=_length) for job in request.jobs if job.time_windows]
    if len(open_for) < sum(job.time_windows is not None for job in request.jobs):
        return True
    opens = max((begin for begin, _ in open_for), default=0)
    closes = min((end for _, end in open_for), default=None)
    longest = _Longest(request, places)
    return any(_binds(longest, kind, opens, closes) for kind in kinds)


def _binds(longest: "_Longest", kind: VehicleKind, opens: int, closes: int | None) -> bool:
    if any(each.max_load is not None for each in kind.stated.breaks):
        return True
    shift, rested = kind.stated.time_window, _rested(kind)
    if rested is None:
        return True
    opens = max(opens, rested)
    begin = opens if shift is None else max(opens, shift[0])
    ends = [end for end in (closes, None if shift is None else shift[1]) if end is not None]
    return bool(ends) and (begin * TIME_SCALE + longest.route(kind) > min(ends) * TIME_SCALE)


def _rested(kind: VehicleKind) -> int | None:
    """Return when a kind's breaks can be over before anything else is done; None: not at all."""
    time, closes = (0, None) if kind.stated.time_window is None else kind.stated.time_window
    for each in kind.stated.breaks:
        start = start_in(time * TIME_SCALE, slots_of(each.time_windows))
        if start == MISSED:
            return None
        time = start // TIME_SCALE + each.service
    return time if closes is None or time <= closes else None


class _Longest:
    """How long routes take at most; what many kinds of vehicles have in common is summed once."""

    def __init__(self, request: Request, places: Sites) -> None:
        self._jobs = request.jobs
        self._places = places
        self._travel = cache(self._travel_by)
        self._spent = cache(self._spent_by)

    def route(self, kind: VehicleKind) -> int:
        """Return hundredths of a second that no route of a kind exceeds."""
        stated, rate = kind.stated, kind.rates.time
        travel = self._travel(stated.profile)
        most = len(travel) - 1 if stated.max_tasks is None else stated.max_tasks
        longest = rate * int(travel[min(most, len(travel) - 1)])
        if stated.max_travel_time is not None:
            longest = min(longest, stated.max_travel_time * TIME_SCALE)
        return longest + TIME_SCALE * (1 + self._spent(kind.type))

    def _travel_by(self, profile: str) -> IntArray:
        """Return (jobs served,) seconds of travel that routes with so many take at most."""
        to_sites = self._places.legs[profile].durations.max(axis=0)
        each = np.sort(to_sites[self._places.jobs])[::-1]
        return int(to_sites.max()) + np.concatenate([[0], np.cumsum(each)])

    def _spent_by(self, name: str) -> int:
        """Return the seconds that setup and service of all jobs take by vehicles of a type."""
        return sum([setup_of(job, name) + service_of(job, name) for job in self._jobs])


def _length(window: Window) -> int:
    return window[1] - window[0]
