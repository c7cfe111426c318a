"""Where vehicles are -> by how much they are later than planned.

The way that is left is reckoned by the straight line, beside that of the whole leg: what is left
takes as large a share of its planned duration.
"""

import math
from collections.abc import Iterable, Iterator, Mapping

from app.records.days.fold import CLIENTS, Data, ToldDay
from app.records.days.rows import Begun, LoggedEvent
from app.records.dispatches.standing import Standing, of_steps
from app.records.dispatches.steps import GEOGRAPHIC, stop_ids
from app.schemas.plan import PlanInput, RouteInput, StopInput

LATE = 60.0
"""Seconds by which a vehicle is later by its position before that counts."""

MOST_LEFT = 3.0
"""Share of a leg that is left at most: who is far away from it is on another way."""

Place = tuple[float, float]

Leg = tuple[StopInput, float, StopInput]
"""From where, since when, and where to."""


def late_by_position(begun: Begun, told: ToldDay, plan: PlanInput,
                     seen: int) -> dict[str, float]:
    """Return by how many seconds vehicles are later on their leg, seen since a plan was made."""
    places = dict(_places(begun, told))
    is_geographic = begun.problem.get("coordinate_system") == GEOGRAPHIC
    late = {}
    for route in plan.routes:
        sighted = told.sighted.get(route.vehicle)
        if sighted is not None and sighted.number > seen:
            at, location = (sighted.time - told.plan_start) / 1000, sighted.about["location"]
            by = _late(_leg(route, of_steps(told.standings.get(route.vehicle, {})), at),
                       (location[0], location[1]), at, places, is_geographic)
            if by > LATE:
                late[route.vehicle] = by
    return late


def are_in_time(begun: Begun, told: ToldDay, plan: PlanInput, log: Iterable[LoggedEvent],
                seen: int) -> bool:
    """Tell whether all that was told since a plan is where vehicles are, none later than planned.

    Phones tell it twice a minute: a plan for each would be much ado about nothing.
    """
    kinds = {event.kind for event in log if event.number > seen and event.kind in CLIENTS}
    return kinds == {"vehicle.position"} and not late_by_position(begun, told, plan, seen)


def _late(leg: Leg | None, here: Place, at: float, places: Mapping[str, Place],
          is_geographic: bool) -> float:
    if leg is None:
        return 0.0
    origin, left_at, to = leg
    start, end = places.get(origin.id), places.get(to.id)
    if start is None or end is None or start == end or at < left_at:
        return 0.0
    left = min(_distance(here, end, is_geographic) / _distance(start, end, is_geographic),
               MOST_LEFT)
    return at - left_at - (1 - left) * (to.arrival - origin.departure)


def _leg(route: RouteInput, standing: Standing, at: float) -> Leg | None:
    """Return the leg on which a vehicle is, and when it left: by what it told, else by the plan."""
    found = None
    for index, trip in enumerate(route.trips):
        for place, stop in enumerate(trip.stops[:-1]):
            steps = [step for step in stop_ids(index, trip, place) if step in standing]
            if steps:
                found = stop, standing[steps[0]].time, trip.stops[place + 1]
            elif not standing and stop.departure <= at:
                found = stop, stop.departure, trip.stops[place + 1]
    return found


def _places(begun: Begun, told: ToldDay) -> Iterator[tuple[str, Place]]:
    """Yield where depots and customers are that have coordinates."""
    stated: list[Data] = [*begun.problem["depots"], *told.customers.values()]
    for each in stated:
        place = each.get("location")
        if isinstance(place, list):
            yield each["id"], (place[0], place[1])


def _distance(one: Place, other: Place, is_geographic: bool) -> float:
    """Return how far two places are from each other; the unit doesn't matter."""
    breadth = math.cos(math.radians((one[1] + other[1]) / 2)) if is_geographic else 1.0
    return math.hypot((one[0] - other[0]) * breadth, one[1] - other[1])
