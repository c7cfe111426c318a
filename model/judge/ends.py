"""Where the trips of a vehicle begin and end."""

from collections.abc import Sequence
from dataclasses import replace

from model.judge.timing import TripDecision
from model.problem import VehicleType


def with_ends(kind: VehicleType, trips: Sequence[TripDecision]) -> tuple[TripDecision, ...]:
    """Return trips that begin and end where vehicles of a type do.

    Where a trip ends and the next begins stays as it is, if it may be there.
    """
    placed, begin, last = [], kind.begins_at, len(trips) - 1
    for index, trip in enumerate(trips):
        end = trip.nodes[-1]
        if index == last:
            end = kind.ends_at
        elif end not in kind.reload_places:
            end = kind.depot
        placed.append(replace(trip, nodes=(begin, *trip.nodes[1:-1], end)))
        begin = end
    return tuple(placed)
