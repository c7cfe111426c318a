"""Breaks of drivers, as the engine reads and packs them."""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from model.engine.library import call, dtype_of
from model.engine.records import Records, one
from model.problem import MAX_BREAKS, REST, UNLIMITED, DrivingRules, IntArray, VehicleType

NONE = -2**58
"""An instant earlier than any that occurs."""

PLACES: tuple[Literal["departure", "way", "arrival"], ...] = "departure", "way", "arrival"


class BreakTimes(NamedTuple):
    """A break between two stops; times in ms."""

    number: int
    place: int  # index into PLACES
    arrival: int  # when the truck stands
    start: int


class RestTimes(NamedTuple):
    """A rest between two stops; times in ms."""

    number: int
    place: int  # index into PLACES
    start: int
    end: int


def limits_loads(kind: VehicleType) -> bool:
    """Tell whether breaks limit what is aboard."""
    return any(each.max_load is not None for each in kind.breaks)


def _most_aboard(kind: VehicleType, room: int) -> tuple[int, ...]:
    """Return what may be aboard at most during each break, beside what is at the beginning."""
    taken, loads = kind.initial_load or (0,) * len(kind.capacity), list[int]()
    for each in kind.breaks:
        most = [UNLIMITED * 2] * room
        if each.max_load is not None:
            most[:len(taken)] = [a - b for a, b in zip(each.max_load, taken, strict=True)]
        loads += most
    return (*loads, *(0,) * (MAX_BREAKS * room - len(loads)))


def driver_row(kind: VehicleType, room: int) -> tuple[int | tuple[int, ...], ...]:
    """Return what `tandem_vehicle_type` says of its driver, loads in so many dimensions."""
    return *_break_row(kind, room), *_driving_row(kind.driving)


def _break_row(kind: VehicleType, room: int) -> tuple[int | tuple[int, ...], ...]:
    """Return how many breaks a driver has, since when, and what `tandem_vehicle_type` says of them.
    """
    breaks = kind.breaks
    columns: tuple[Sequence[int], ...] = (
        [each.earliest for each in breaks], [each.latest for each in breaks],
        [each.duration for each in breaks], [each.after_departure for each in breaks],
        [each.anywhere for each in breaks], [not each.paid for each in breaks])
    rest = (0,) * (MAX_BREAKS - len(breaks))
    since = NONE if kind.works_since is None else kind.works_since
    return (len(breaks), since, *((*map(int, column), *rest) for column in columns),
            _most_aboard(kind, room))


def _driving_row(rules: DrivingRules | None) -> tuple[int | tuple[int, ...], ...]:
    """Return whether a driver has to rest, and what `tandem_vehicle_type` says of that."""
    if rules is None:
        return 0, (0, 0, 0), UNLIMITED, UNLIMITED, 0, 0, 1
    return (1, (rules.rest, *(rules.split or (0, 0))), rules.max_driving, rules.max_work,
            rules.driven_before, rules.worked_before, int(rules.while_drones_fly))


def longest_travel(kind: VehicleType) -> int:
    """Return how long a vehicle may be on legs: the tighter of what it and its rules state."""
    limits = [UNLIMITED] if kind.max_travel_duration is None else [kind.max_travel_duration]
    if kind.driving is not None and kind.driving.max_driving_per_day < UNLIMITED:
        limits.append(kind.driving.max_driving_per_day - kind.driving.driven_before)
    return min(limits)


class RestingDriver:
    """The driver of a route, from leg to leg, who rests by rules."""

    def __init__(self, types: Records, k: int, begin: int) -> None:
        self._types, self._k = types, k
        self._driver = one(dtype_of("tandem_driver"))
        self._driver.driven = types[k].driven_before
        since = types[k].breaks_since
        self._driver.since = (begin if since == NONE else since) - types[k].worked_before

    def drive(self, rests: int, leave: int, arrival: int) -> list[RestTimes]:
        """Return the rests on a leg that lasts from then until then."""
        leg, count = one(dtype_of("tandem_broken_leg")), rests & 15
        lengths = self._types[self._k].rest_durations
        resting = sum([int(lengths[rests >> (4 + 5 * index) & 7]) for index in range(count)])
        leg.rests, leg.leave, leg.duration = rests, leave, arrival - leave - resting
        times = np.zeros((count, 2), np.int64)
        call("tandem_rest_times", self._types, self._k, leg, self._driver, times)
        return [RestTimes(REST, rests >> (7 + 5 * index) & 3, begin, begin + length)
                for index, (begin, length) in enumerate(times.tolist())]


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
