"""Changes that aren't worth their price are taken back.

A search knows what it costs that another vehicle serves somebody, but not what places in a route
and promised times cost. So whom it moved, and who is new, is put elsewhere one at a time: behind
whom he was before, and beside those nearest.
"""

import time
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace

from model.judge.ends import with_ends
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import read_route, time_route
from model.judge.timing import RouteDecision
from model.problem import Problem
from model.replanning.amend import without
from model.replanning.handover import complete
from model.solution import Route, Solution, Vehicle

NEAR = 5
"""Beside how many customers somebody is tried."""


def take_back_changes(problem: Problem, first: Solution, found: Solution,
                      cost: Callable[[Solution], float], until: float) -> None:
    """Try plans that change less of a first one than another that was found.

    Parameters
    ----------
    problem
        What is left to plan.
    first
        Its plan before.
    found
        Its plan that a search found.
    cost
        Told of each plan; returns what it costs as a whole, infinite if it is illegal.
    until
        When to stop, on `time.perf_counter`.
    """
    best, least = found, cost(found)
    is_better = True
    while is_better:
        is_better = False
        for other in _neighbours(problem, first, best):
            if time.perf_counter() >= until:
                return
            price = cost(other)
            if price < least:
                best, least, is_better = other, price, True
                break


def _tours(plan: Solution) -> dict[Vehicle, list[int]]:
    """Return whom each vehicle serves by itself, in order."""
    return {route.driven_by: [stop.node for trip in route.trips for stop in trip.customer_stops]
            for route in plan.routes}


def _neighbours(problem: Problem, first: Solution, plan: Solution) -> Iterator[Solution]:
    """Yield plans in which somebody is elsewhere, or a route is the other way round."""
    changed = _changed(_tours(first), plan)
    for node in changed:
        yield from _elsewhere(problem, first, plan, node)
    yield from _turned(problem, plan, changed)


def _turned(problem: Problem, plan: Solution, changed: Collection[int]) -> Iterator[Solution]:
    """Yield plans in which one trip that changed is the other way round."""
    for index, route in enumerate(plan.routes):
        decision = read_route(problem, route)
        for number, trip in enumerate(decision.trips):
            if trip.sorties or not set(changed).intersection(trip.nodes):
                continue
            turned = replace(trip, nodes=(trip.nodes[0], *trip.nodes[-2:0:-1], trip.nodes[-1]),
                             operations=None, breaks=())
            trips = (*decision.trips[:number], turned, *decision.trips[number + 1:])
            timed = time_route(problem, replace(decision, trips=trips), "", EVERYTHING_OPEN)
            yield replace(plan, routes=(*plan.routes[:index], timed.route,
                                        *plan.routes[index + 1:]))


def _changed(was: dict[Vehicle, list[int]], plan: Solution) -> list[int]:
    """Return whom trucks serve who are new, moved, or on a route of another order."""
    changed = []
    for vehicle, tour in _tours(plan).items():
        before = was.get(vehicle, [])
        stayed = [node for node in tour if node in before]
        is_in_order = stayed == sorted(stayed, key=before.index)
        changed += [node for node in tour if not (is_in_order and node in before)]
    return changed


def _elsewhere(problem: Problem, first: Solution, plan: Solution,
               node: int) -> Iterator[Solution]:
    """Yield plans in which a customer is at another place."""
    routes = {route.driven_by: route for route in plan.routes}
    own = next(vehicle for vehicle, tour in _tours(plan).items() if node in tour)
    left = _without(problem, read_route(problem, routes[own]), node)
    if left is None:
        return
    others = {vehicle: read_route(problem, route) for vehicle, route in routes.items()
              if vehicle != own} | ({own: left} if left.trips else {})
    for joined in (*_former(problem, first, others, node), *_beside(problem, others, node)):
        vehicle = joined.driven_by
        changed = {vehicle: joined} if vehicle == own or not left.trips else {
            own: left, vehicle: joined}
        timed = {each: time_route(problem, decision, "", EVERYTHING_OPEN).route
                 for each, decision in changed.items()}
        kept = {each: route for each, route in routes.items() if each != own}
        yield complete(problem, (*(kept | timed).values(),))


def _without(problem: Problem, route: RouteDecision, node: int) -> RouteDecision | None:
    """Return a route without a customer; None if flights begin or end there."""
    trips = []
    for trip in route.trips:
        cut = without(trip, {node})
        if len(cut.sorties) < len(trip.sorties):
            return None
        if len(cut.nodes) > 2 or cut.sorties:
            trips.append(cut)
    return replace(route, trips=with_ends(problem.vehicle_types[route.vehicle_type], trips))


def _former(problem: Problem, first: Solution, routes: dict[Vehicle, RouteDecision],
            node: int) -> Iterator[RouteDecision]:
    """Yield the route with a customer that had him before, behind those before him."""
    for route in first.routes:
        vehicle = route.driven_by
        for trip in route.trips:
            nodes = [stop.node for stop in trip.stops]
            if node not in nodes[1:-1]:
                continue
            now = routes.get(vehicle)
            if now is None:
                yield _alone(problem, route, node)
                continue
            before = {*nodes[1:nodes.index(node)]}
            yield max((_inserted(now, number, index, node)
                       for number, each in enumerate(now.trips)
                       for index in range(len(each.nodes) - 1)),
                      key=lambda joined: _fits(joined, before, node))


def _alone(problem: Problem, route: Route, node: int) -> RouteDecision:
    """Return a route that serves one of its customers alone."""
    decision = read_route(problem, route)
    trips = [without(trip, {other for other in trip.customers(problem.num_depots)
                            if other != node}) for trip in decision.trips]
    return replace(decision, trips=with_ends(
        problem.vehicle_types[route.vehicle_type],
        [trip for trip in trips if node in trip.nodes]))


def _beside(problem: Problem, routes: dict[Vehicle, RouteDecision],
            node: int) -> Iterator[RouteDecision]:
    """Yield routes with a customer beside those who are nearest to him."""
    near = sorted(
        (int(problem.travel[problem.vehicle_types[route.vehicle_type].travel].distance[
            stop, node]), vehicle, number, index)
        for vehicle, route in routes.items() for number, trip in enumerate(route.trips)
        for index, stop in enumerate(trip.nodes[1:-1], 1) if stop >= problem.num_depots)
    for _, vehicle, number, index in near[:NEAR]:
        yield _inserted(routes[vehicle], number, index, node)
        yield _inserted(routes[vehicle], number, index - 1, node)


def _inserted(route: RouteDecision, number: int, stop: int, node: int) -> RouteDecision:
    """Return a route with a customer behind a stop of a trip."""
    trips, at = list(route.trips), stop + 1
    trip = trips[number]
    trips[number] = replace(
        trip, nodes=(*trip.nodes[:at], node, *trip.nodes[at:]),
        sorties=tuple([replace(sortie, launch_stop=sortie.launch_stop + (sortie.launch_stop >= at),
                               recovery_stop=sortie.recovery_stop + (sortie.recovery_stop >= at))
                       for sortie in trip.sorties]),
        operations=None if trip.operations is None else (
            *trip.operations[:at], (), *trip.operations[at:]),
        breaks=tuple([each._replace(stop=each.stop + (each.stop >= at)) for each in trip.breaks]))
    return replace(route, trips=tuple(trips))


def _fits(route: RouteDecision, before: set[int], node: int) -> int:
    """Return how many stand on the right side of a customer, those before him before."""
    nodes = [stop for trip in route.trips for stop in trip.nodes[1:-1]]
    place = nodes.index(node)
    return (sum(stop in before for stop in nodes[:place])
            + sum(stop not in before for stop in nodes[place + 1:]))
