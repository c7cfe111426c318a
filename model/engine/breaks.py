"""Breaks of drivers, as the engine reads and packs them."""

from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from model.engine.library import call, dtype_of
from model.engine.records import Records, one
from model.problem import MAX_BREAKS, REST, UNLIMITED, DrivingRules, IntArray, VehicleType

NONE = -2**58
"""An instant earlier than any that occurs."""

Fields = dict[str, int | Sequence[int]]
"""What a row for the engine says, by its fields."""

PLACES: tuple[Literal["departure", "way", "arrival"], ...] = "departure", "way", "arrival"


class BreakTimes(NamedTuple):
    """A break, or a rest, between two stops; times in ms."""

    number: int  # index into VehicleType.breaks, or `REST`
    place: int  # index into PLACES
    arrival: int  # when the truck stands
    start: int
    end: int


def limits_loads(kind: VehicleType) -> bool:
    """Tell whether breaks limit what is aboard."""
    return any(each.max_load is not None for each in kind.breaks)


def _most_aboard(kind: VehicleType) -> list[int]:
    """Return what may be aboard at most during each break, beside what is at the beginning."""
    room = len(one(dtype_of("tandem_vehicle_type")).capacity)
    taken, loads = kind.initial_load or (0,) * len(kind.capacity), list[int]()
    for each in kind.breaks:
        most = [UNLIMITED * 2] * room
        if each.max_load is not None:
            most[:len(taken)] = [a - b for a, b in zip(each.max_load, taken, strict=True)]
        loads += most
    return loads


def driver_fields(kind: VehicleType) -> Fields:
    """Return what `tandem_vehicle_type` says of its driver."""
    breaks, rules = kind.breaks, kind.driving or DrivingRules(UNLIMITED, 0)
    return {
        "breaks": len(breaks),
        "breaks_since": NONE if kind.works_since is None else kind.works_since,
        "break_earliest": [each.earliest for each in breaks],
        "break_latest": [each.latest for each in breaks],
        "break_duration": [each.duration for each in breaks],
        "break_after_departure": [each.after_departure for each in breaks],
        "break_anywhere": [each.anywhere for each in breaks],
        "break_unpaid": [not each.paid for each in breaks],
        "break_max_load": _most_aboard(kind), "must_rest": kind.driving is not None,
        "rest_durations": (rules.rest, *(rules.split or (0, 0))),
        "max_driving": rules.max_driving, "max_work": rules.max_work,
        "driven_before": rules.driven_before, "worked_before": rules.worked_before,
        "half_rested_before": rules.half_rested_before,
        "rests_in_flights": rules.while_drones_fly,
        "work_interrupts": rules.other_work_interrupts}


def longest_travel(kind: VehicleType) -> int:
    """Return how long a vehicle may be on legs: the tighter of what it and its rules state."""
    limits = [UNLIMITED] if kind.max_travel_duration is None else [kind.max_travel_duration]
    if kind.driving is not None and kind.driving.max_driving_per_day < UNLIMITED:
        limits.append(kind.driving.max_driving_per_day - kind.driving.driven_before)
    return min(limits)


def _numbers(rests: int) -> list[int]:
    return [rests >> (4 + 6 * index) & 15 for index in range(rests & 15)]


def resting_in_gap(kind: Any, rests: int) -> int:
    """Return how long the breaks on a leg are that the gap between its stops holds."""
    if not kind.must_rest or kind.breaks:
        return 0
    return sum([int(kind.rest_durations[number - MAX_BREAKS]) for number in _numbers(rests)])


class BrokenRoute:
    """The breaks on a route, from leg to leg, of whose driver is counted what rules say."""

    def __init__(self, types: Records, profile: tuple[IntArray, IntArray], k: int,
                 begin: int) -> None:
        self._types, self._profile, self._k, self._begin = types, profile, k, begin
        self._driver = one(dtype_of("tandem_driver"))
        self._driver.driven = types[k].driven_before
        since = types[k].breaks_since
        self._driver.since = (begin if since == NONE else since) - types[k].worked_before
        self._driver.half_rested = types[k].half_rested_before

    def drive(self, rests: int, leave: int, duration: int, stood: int) -> Iterator[BreakTimes]:
        """Yield the breaks on a leg.

        Parameters
        ----------
        rests
            The breaks, as the engine packs them.
        leave
            When the leg begins.
        duration
            Of the leg, without setup.
        stood
            How long the driver was at other work before it.
        """
        count = rests & 15
        kind = self._types[self._k]
        if count == 0 and not kind.must_rest:
            return
        leg = one(dtype_of("tandem_broken_leg"))
        leg.rests, leg.begin, leg.leave, leg.duration = rests, self._begin, leave, duration
        leg.stood = stood
        times = np.zeros((count, 3), np.int64)
        if kind.must_rest:
            call("tandem_rest_times", self._types, *self._profile, self._k, leg, self._driver,
                 times)
        else:
            call("tandem_break_times", self._types, *self._profile, self._k, leg, times)
        for index, (number, found) in enumerate(zip(_numbers(rests), times.tolist(), strict=True)):
            yield BreakTimes(number if number < MAX_BREAKS else REST, rests >> (8 + 6 * index) & 3,
                             *found)
