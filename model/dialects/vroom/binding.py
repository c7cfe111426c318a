"""Whether time windows can make any difference to what is planned."""

from collections.abc import Sequence
from itertools import chain

import numpy as np

from model.dialects.vroom.kinds import Kind
from model.dialects.vroom.places import Places
from model.dialects.vroom.request import Request, Window
from model.dialects.vroom.timing import TIME_SCALE, service_of, setup_of
from model.problem import IntArray


def windows_bind(request: Request, places: Places, kinds: Sequence[Kind]) -> bool:
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
    return any(_binds(request, places, kind, opens, closes) for kind in kinds)


def _binds(request: Request, places: Places, kind: Kind, opens: int, closes: int | None) -> bool:
    shift = kind.stated.time_window
    begin = opens if shift is None else max(opens, shift[0])
    ends = [end for end in (closes, None if shift is None else shift[1]) if end is not None]
    return bool(ends) and (begin * TIME_SCALE + _longest_route(request, places, kind)
                           > min(ends) * TIME_SCALE)


def _longest_route(request: Request, places: Places, kind: Kind) -> int:
    """Return hundredths of a second that no route of a kind exceeds, floats' precision aside."""
    durations = places.legs[kind.stated.profile].durations
    to_sites: IntArray = durations.max(axis=0)
    each = np.sort(to_sites[places.jobs])
    most = kind.stated.max_tasks
    travel = float(each[len(each) - (len(each) if most is None else min(most, len(each))):].sum()
                   + to_sites.max())
    if kind.stated.max_travel_time is not None:
        limit = kind.stated.max_travel_time * TIME_SCALE / kind.rates.time
        travel = min(travel, limit)
    spent = sum(chain.from_iterable(
        (setup_of(job, kind.type), service_of(job, kind.type)) for job in request.jobs))
    return int(travel * kind.rates.time) + TIME_SCALE * (1 + spent)


def _length(window: Window) -> int:
    return window[1] - window[0]
