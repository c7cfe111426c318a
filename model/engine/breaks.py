"""Breaks of drivers, as the engine reads and packs them."""

from collections.abc import Sequence


from model.engine.library import dtype_of
from model.engine.records import one
from model.problem import UNLIMITED, DrivingRules, VehicleType

NONE = -2**58
"""An instant earlier than any that occurs."""

Fields = dict[str, int | Sequence[int]]
"""What a row for the engine says, by its fields."""


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
