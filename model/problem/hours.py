"""When depots are open, which bounds the day of vehicles that begin or end there."""

from collections.abc import Sequence
from dataclasses import replace

from model.problem.customer import Depot
from model.problem.fleet import VehicleType
from model.problem.quantities import UNLIMITED


def within_hours(depots: Sequence[Depot], kind: VehicleType) -> VehicleType:
    """Return vehicles whose day lies within the hours of where they begin and end.

    With overtime, working durations must be unlimited unless the depot closes behind it all.

    Raises
    ------
    ValueError
        If no time is left.
    """
    opens, closes = depots[kind.begins_at].earliest, depots[kind.ends_at].latest
    over, overtime = 0 if kind.overtime is None else kind.overtime.max_duration, kind.overtime
    if overtime is not None and closes < min(kind.latest + over, UNLIMITED):
        left = closes - kind.latest
        overtime = replace(overtime, max_duration=left) if left > 0 else None
    return replace(kind, earliest=max(kind.earliest, opens), latest=min(kind.latest, closes),
                   last_by_shift=min(kind.latest + over, UNLIMITED), overtime=overtime)
