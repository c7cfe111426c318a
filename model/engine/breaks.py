"""Breaks of drivers, as the engine reads and packs them."""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from model.engine.library import call, dtype_of
from model.engine.records import Records, one
from model.problem import MAX_BREAKS, IntArray, VehicleType

NONE = -2**58
"""An instant earlier than any that occurs."""

PLACES: tuple[Literal["departure", "way", "arrival"], ...] = "departure", "way", "arrival"


class BreakTimes(NamedTuple):
    """A break between two stops; times in ms."""

    number: int
    place: int  # index into PLACES
    arrival: int  # when the truck stands
    start: int


def break_row(kind: VehicleType) -> tuple[int | tuple[int, ...], ...]:
    """Return how many breaks a driver has, since when, and what `tandem_vehicle_type` says of them.
    """
    breaks = kind.breaks
    columns: tuple[Sequence[int], ...] = (
        [each.earliest for each in breaks], [each.latest for each in breaks],
        [each.duration for each in breaks], [each.after_departure for each in breaks],
        [each.anywhere for each in breaks], [not each.paid for each in breaks])
    rest = (0,) * (MAX_BREAKS - len(breaks))
    since = NONE if kind.works_since is None else kind.works_since
    return len(breaks), since, *((*map(int, column), *rest) for column in columns)


def break_times(types: Records, profile: tuple[IntArray, IntArray], k: int, rests: int, begin: int,
                leave: int, duration: int) -> Iterator[BreakTimes]:
    """Yield the breaks on a leg.

    Parameters
    ----------
    types
        Rows of vehicle types.
    profile
        Changes of speeds by type, and their factors.
    k
        Type of the vehicle.
    rests
        The breaks, as the engine packs them.
    begin
        When the route begins.
    leave
        When the leg begins.
    duration
        Of the leg, without setup.
    """
    count = rests & 15
    if count == 0:
        return
    leg = one(dtype_of("tandem_broken_leg"))
    leg.rests, leg.begin, leg.leave, leg.duration = rests, begin, leave, duration
    times = np.zeros((count, 2), np.int64)
    call("tandem_break_times", types, *profile, k, leg, times)
    for index, (arrival, start) in enumerate(times.tolist()):
        packed = rests >> (4 + 5 * index)
        yield BreakTimes(packed & 7, packed >> 3 & 3, arrival, start)
