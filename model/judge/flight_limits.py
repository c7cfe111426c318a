"""What limits vehicles that fly by themselves, each a little looser."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from model.judge.clock import MS_PER_MINUTE
from model.judge.metrics import TripMetrics
from model.problem import MAX_QUANTITY, MM_PER_KM, UNLIMITED, VehicleType

_Changed = tuple[str, Literal["minute", "km"], float | None, VehicleType]
"""A field, the unit of one more, how many are left, and the type with one more."""


def flight_limits(kind: VehicleType, trip: TripMetrics | None) -> Iterator[_Changed]:
    """Yield how long, and how far, vehicles that fly by themselves may."""
    handling = kind.launch_duration + kind.recovery_duration
    if kind.endurance < UNLIMITED:
        slack = None if trip is None else (
            kind.endurance - trip.duration + handling) / MS_PER_MINUTE
        longer = min(kind.endurance + MS_PER_MINUTE, UNLIMITED)
        yield "endurance", "minute", slack, replace(kind, endurance=longer)
    if kind.max_range is not None:
        yield "max_range", "km", None, replace(kind, max_range=one_km_more(kind.max_range))


def one_km_more(distance: int) -> int:
    """Return a distance of a kilometre more, if a problem may state it."""
    return min(distance + MM_PER_KM, MAX_QUANTITY)
