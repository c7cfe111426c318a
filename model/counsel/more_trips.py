"""Whether a vehicle that is used up, or has no place to charge, could serve one who is left out on
one trip more.

The other trips stay as they are; `judge_route` judges the route that has one more.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace

from model.counsel.explain import Reason
from model.counsel.remedy import remedy_of
from model.counsel.screening import first_drones
from model.judge.ends import with_ends
from model.judge.hubs import lacks_charger
from model.judge.past import Past
from model.judge.places import Place, route_with
from model.judge.retiming import TimedRoute, read_route, time_route
from model.problem import Problem, VehicleType
from model.solution import Route, Solution, Vehicle

MAX_TRIED = 8
"""Vehicles tried of a type, those that are back first."""

MOST_TRIPS = 1000
"""As many as a request can state."""


def with_another_trip(problem: Problem, solution: Solution, node: int, reasons: Sequence[Reason],
                      past: Past, until: float) -> tuple[Reason, ...]:
    """Return reasons why a customer is left out, with the remedy of one more trip where it holds,
    or of one more charger.

    It is tried for types whose vehicles are all in use; none after `until`, on
    `time.perf_counter`.
    """
    return tuple([_with_remedy(problem, solution, node, reason, past)
                  if reason.code == "FLEET_EXHAUSTED" and time.perf_counter() < until
                  else reason for reason in reasons])


def _with_remedy(problem: Problem, solution: Solution, node: int, reason: Reason,
                 past: Past) -> Reason:
    kind = problem.vehicle_types[reason.vehicle_type]
    routes = [(index, route) for index, route in enumerate(solution.routes)
              if route.vehicle_type == reason.vehicle_type
              and route.driven_by not in past.unavailable]
    routes.sort(key=lambda found: found[1].trips[-1].stops[-1].arrival)
    more = replace(problem, vehicle_types=tuple([
        replace(each, max_trips=kind.max_trips + 1) if each is kind else each
        for each in problem.vehicle_types]))
    hub = problem.depots[kind.depot].id
    grounded = [found for found in routes
                if lacks_charger(problem, kind, len(found[1].trips), solution)]
    used_up = [found for found in routes
               if len(found[1].trips) == kind.max_trips < MOST_TRIPS and found not in grounded]
    may_go_on = [found for found in grounded if len(found[1].trips) < kind.max_trips]
    for remedy, changed, tried in (
            (remedy_of("trips", kind.type_id), more, used_up),
            (remedy_of("hub_chargers", hub), problem, may_go_on)):
        if any(_would_do(changed, index, route, node, past)
               for index, route in tried[:MAX_TRIED]):
            return reason.or_by(remedy)
    return reason


def _would_do(problem: Problem, index: int, route: Route, node: int, past: Past) -> bool:
    """Tell whether a trip behind a vehicle's others serves a customer, and is worth its cost."""
    path, decision = f"routes[{index}]", read_route(problem, route)
    before = time_route(problem, decision, path, past)
    broken = _broken(before)
    most = before.judged.cost.total + problem.cost_of_leaving_out(problem.customer_at(node))
    kind = problem.vehicle_types[route.vehicle_type]
    for place in _places(kind, route.driven_by, len(route.trips)):
        longer = route_with(decision, place, node, (kind.begins_at, kind.ends_at))
        tried = time_route(problem, replace(longer, trips=with_ends(kind, longer.trips)), path,
                           past)
        if tried.judged.cost.total < most and _broken(tried) <= broken:
            return True
    return False


def _broken(timed: TimedRoute) -> set[tuple[str, str]]:
    return {(each.code, each.message) for each in timed.judged.violations}


def _places(kind: VehicleType, vehicle: Vehicle, number: int) -> Iterator[Place]:
    """Yield a trip of the customer's own, by truck and by each type of drones."""
    yield Place(vehicle, number, "truck", 1, own_trip=True)
    for drone, _ in first_drones(kind):
        for recovery in (0, 1):
            yield Place(vehicle, number, "drone", 0, recovery, drone, own_trip=True)
