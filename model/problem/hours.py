"""When depots are open, which bounds the day of vehicles that begin or end there."""

from collections.abc import Sequence
from dataclasses import replace

from model.problem.customer import Depot
from model.problem.fleet import VehicleType
from model.problem.quantities import UNLIMITED


def within_hours(depots: Sequence[Depot], kind: VehicleType) -> VehicleType:
    """Return vehicles whose day lies within the hours of where they begin and end.

    Overtime is left as it is where it may be paid before the depot closes.

    Raises
    ------
    ValueError
        If no time is left.
    """
    opens, closes = depots[kind.begins_at].earliest, depots[kind.ends_at].latest
    last, overtime = last_by_shift(kind), kind.overtime
    if overtime is not None and closes < last and kind.max_working_duration is None:
        left = closes - kind.latest
        overtime = replace(overtime, max_duration=left) if left > 0 else None
    return replace(kind, earliest=max(kind.earliest, opens), latest=min(kind.latest, closes),
                   last_by_shift=last, overtime=overtime)


def last_by_shift(kind: VehicleType) -> int:
    """Return the last end of a vehicle's work by its shift, overtime included."""
    over = 0 if kind.overtime is None else kind.overtime.max_duration
    return min(kind.latest + over, UNLIMITED)


def keeps_hours(depots: Sequence[Depot], kind: VehicleType) -> bool:
    """Tell whether hours of depots limit a type's trips more than its shift does."""
    between = kind.reload_places if kind.max_trips > 1 else ()
    last = last_by_shift(kind)
    return any(depots[node].earliest > kind.earliest or depots[node].latest < last
               for node in {kind.begins_at, kind.ends_at, *between})
