"""Plans of what is left, to and from plans of the whole problem."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import count

from model.judge.chargers import with_charging
from model.judge.ends import with_ends
from model.judge.hubs import hub_violations
from model.judge.past import EVERYTHING_OPEN, Past
from model.judge.retiming import time_route
from model.judge.timing import (
    RouteDecision, TripDecision, latest_release, read_decision, schedule_trip,
)
from model.problem import Problem
from model.replanning.amend import customers_of, repaired_route, without
from model.replanning.kept import Kept
from model.replanning.relations import in_relation
from model.replanning.remainder import Remainder
from model.replanning.spans import awaiting, out_of_turn
from model.solution import Route, Solution, Trip, Vehicle


def hand_over(problem: Problem, plan: Solution, kept: Mapping[Vehicle, Kept],
              left: Remainder) -> Solution:
    """Return what is left of a plan of the whole, as a plan of what is left.

    Customers for whom a rule is broken are left out.
    """
    here = {node: node for node in problem.launch_sites} | left.numbers
    decisions = [
        _rest_of_trip(left, kind, way_on.planned, here) for kind, worker in left.workers.items()
        if worker.is_under_way and (way_on := kept[worker.vehicle].way_on) is not None]
    used: Counter[int] = Counter()
    for route in plan.routes:
        vehicle = route.driven_by
        kind = left.later(vehicle)
        if kind is None or used[kind] >= left.problem.vehicle_types[kind].count:
            continue
        drones = left.drones_of(kind)
        trips = [_moved(trip, here, drones)
                 for trip in _trips_left(problem, route, kept.get(vehicle), drones)]
        trips = [trip for trip in trips if customers_of(problem, trip)]
        own = left.problem.vehicle_types[kind]
        if trips:
            decisions.append(RouteDecision(kind, used[kind],
                                           with_ends(own, trips[:own.max_trips])))
            used[kind] += 1
    return _scheduled(left, decisions)


def _trips_left(problem: Problem, route: Route, kept: Kept | None,
                drones: Sequence[int]) -> list[TripDecision]:
    """Return the decisions of the trips that have not begun, flown by drones that are left."""
    kind = problem.vehicle_types[route.vehicle_type]
    trips = route.trips[0 if kept is None else len(kept.route.trips):]
    decisions = []
    for trip in trips:
        flown = tuple(sortie for sortie in trip.sorties if sortie.drone in drones)
        decisions.append(read_decision(replace(trip, sorties=flown), kind, problem.lags_across))
    return decisions


def _moved(decision: TripDecision, here: Mapping[int, int], drones: Sequence[int]) -> TripDecision:
    """Return a trip with other nodes and numbers of drones, without customers who have none."""
    flown = [node for sortie in decision.sorties for node in sortie.nodes]
    everyone = {*decision.nodes[1:-1], *flown}
    decision = without(decision, everyone - here.keys())
    inner = tuple(here[node] for node in decision.nodes[1:-1])
    sorties = tuple(replace(sortie, nodes=tuple(here[node] for node in sortie.nodes),
                            drone=drones.index(sortie.drone)) for sortie in decision.sorties)
    return TripDecision((decision.nodes[0], *inner, decision.nodes[-1]), sorties,
                        decision.operations, decision.start, decision.breaks,
                        tuple([each._replace(node=here[each.node]) for each in decision.awaited
                               if each.node in here]))


def _rest_of_trip(left: Remainder, kind: int, planned: TripDecision,
                  here: Mapping[int, int]) -> RouteDecision:
    """Return how a vehicle goes on with the trip that it is on."""
    own = left.problem.vehicle_types[kind]
    rest = _moved(planned, here, left.drones_of(kind))
    nodes = (own.begins_at, *rest.nodes[1:-1], own.ends_at)
    return RouteDecision(kind, 0, (TripDecision(nodes, rest.sorties, rest.operations,
                                                awaited=rest.awaited),))


def _scheduled(left: Remainder, decisions: Iterable[RouteDecision]) -> Solution:
    """Return a plan of what is left without the customers for whom rules are broken."""
    made: list[Route] = []
    for decision in in_relation(left.problem, [*decisions]):
        route = _in_turn(left, decision, made)
        made += [] if route is None else [route]
    return with_charging(left.problem, complete(left.problem, tuple(
        _within_stock(left.problem, made))))


def _within_stock(problem: Problem, routes: list[Route]) -> list[Route]:
    """Return routes without the last trips, for which depots have too little."""
    if not problem.limits_hubs:
        return routes
    found: list[Route] = []
    for route in routes:
        trips = route.trips
        while trips and not _has_stock(problem, [*found, replace(route, trips=trips)]):
            trips = trips[:-1]
        if trips:
            found.append(replace(route, trips=trips))
    return found


def _has_stock(problem: Problem, routes: Sequence[Route]) -> bool:
    """Tell whether depots have what routes take."""
    return next(hub_violations(problem, Solution(tuple(routes))), None) is None


def _in_turn(left: Remainder, decision: RouteDecision, made: Sequence[Route]) -> Route | None:
    """Return a route likewise that waits for whom others serve; without whom these forestall."""
    problem = left.problem
    route = _mended(left, awaiting(problem, decision, made))
    while route is not None and (late := out_of_turn(problem, route, made)):
        decision = replace(decision, trips=tuple([
            without(trip, late) for trip in decision.trips]))
        route = _mended(left, awaiting(problem, decision, made))
    return route


def _mended(left: Remainder, decision: RouteDecision) -> Route | None:
    """Return a route without the customers for whom it breaks rules; None if nobody is left."""
    if not decision.trips:
        return None
    kind, timings = left.problem.vehicle_types[decision.vehicle_type], [_timed, _timed_at_once]
    if kind.breaks or kind.driving is not None:
        timings.append(_timed_with_breaks)
    return repaired_route(left.problem, decision, (),
                          [partial(time, left.problem) for time in timings])


def _timed(problem: Problem, decision: RouteDecision) -> Route:
    """Return a route whose trips begin when they state, if they can by then."""
    kind = problem.vehicle_types[decision.vehicle_type]
    trips: list[Trip] = []
    ready = kind.earliest
    for trip in decision.trips:
        start = max(ready, latest_release(problem, trip), trip.start or 0)
        trips.append(schedule_trip(problem, kind, replace(trip, start=start), ready, trips))
        ready = trips[-1].stops[-1].departure + kind.reload_duration
    return Route(decision.vehicle_type, decision.vehicle, tuple(trips))


def _timed_at_once(problem: Problem, decision: RouteDecision) -> Route:
    """Return a route whose trips begin as soon as possible."""
    trips = tuple(replace(trip, start=None) for trip in decision.trips)
    return _timed(problem, replace(decision, trips=trips))


def _timed_with_breaks(problem: Problem, decision: RouteDecision) -> Route:
    """Return a route with other breaks, as they are due."""
    trips = tuple([replace(trip, start=None, breaks=()) for trip in decision.trips])
    return time_route(problem, replace(decision, trips=trips), "", EVERYTHING_OPEN).route


def complete(problem: Problem, routes: tuple[Route, ...]) -> Solution:
    """Return a plan whose other customers are left out."""
    return Solution(routes, problem.left_out(Solution(routes).served))


def settled(problem: Problem, kept: Mapping[Vehicle, Kept]) -> Solution:
    """Return the plan in which vehicles do what they do in any case, and go home."""
    return complete(problem, tuple(route.route for route in kept.values()))


def take_back(problem: Problem, past: Past, before: Solution, kept: Mapping[Vehicle, Kept],
              left: Remainder, plan: Solution) -> Solution:
    """Return a plan of the whole from a plan of what is left.

    Vehicles that have begun to work come first, in the order of `kept`. Others keep their numbers
    in `before`, the plan given, where they serve the same customers.
    """
    trips = {vehicle: route.route.trips for vehicle, route in kept.items()}
    others = []
    # The rest of a trip before later ones.
    for route in sorted(plan.routes, key=lambda route: not _is_under_way(left, route)):
        worker = left.workers.get(route.vehicle_type)
        if worker is not None and worker.is_under_way:
            *done, last = trips[worker.vehicle]
            rest = _begun_at_once(left.problem, route)
            trips[worker.vehicle] = (*done, _joined(last, rest, left.nodes, worker.drones))
            continue
        drones = left.drones_of(route.vehicle_type)
        mine = tuple(_whole(trip, left.nodes, drones) for trip in route.trips)
        if worker is None:
            others.append(Route(left.kinds[route.vehicle_type], 0, mine))
        else:
            if worker.vehicle in kept and kept[worker.vehicle].charges:
                charges = (*kept[worker.vehicle].charges, *mine[0].charges)
                mine = (replace(mine[0], charges=charges), *mine[1:])
            trips[worker.vehicle] = (*trips.get(worker.vehicle, ()), *mine)
    known = [Route(*vehicle, done) for vehicle, done in trips.items()]
    taken = {*trips, *(worker.vehicle for worker in left.workers.values()), *past.unavailable}
    return complete(problem, (*known, *_numbered(before, taken, others)))


def _is_under_way(left: Remainder, route: Route) -> bool:
    worker = left.workers.get(route.vehicle_type)
    return worker is not None and worker.is_under_way


def _begun_at_once(problem: Problem, route: Route) -> Trip:
    """Return the rest of a trip without waiting where it begins, which no trip under way does."""
    kind, trip = problem.vehicle_types[route.vehicle_type], route.trips[0]
    if trip.stops[0].arrival == kind.earliest:
        return trip
    decision = read_decision(trip, kind, problem.lags_across)
    return schedule_trip(problem, kind, replace(decision, start=None), kind.earliest)


def _whole(trip: Trip, nodes: Sequence[int], drones: Sequence[int], offset: int = 0) -> Trip:
    """Return a trip with other nodes and drones, its sorties at stops `offset` later."""
    stops = tuple([stop.at(nodes[stop.node]) for stop in trip.stops])
    sorties = tuple(
        replace(sortie, drone=drones[sortie.drone], launch_stop=sortie.launch_stop + offset,
                recovery_stop=sortie.recovery_stop + offset,
                visits=tuple(replace(visit, node=nodes[visit.node]) for visit in sortie.visits))
        for sortie in trip.sorties)
    return Trip(stops, sorties, trip.breaks, trip.charges)


def _joined(begun: Trip, rest: Trip, nodes: Sequence[int], drones: Sequence[int]) -> Trip:
    """Return a trip that goes on at its last stop but the depot as another from there."""
    position = len(begun.stops) - 2
    rest = _whole(rest, nodes, drones, position)
    here = replace(begun.stops[position], departure=rest.stops[0].departure)
    return Trip((*begun.stops[:position], here, *rest.stops[1:]),
                (*begun.sorties, *rest.sorties))


def _numbered(before: Solution, taken: set[Vehicle], routes: Sequence[Route]) -> list[Route]:
    """Return routes with vehicles that are free, those that served most of the same customers."""
    servant = {node: route.driven_by for route in before.routes for node in route.served}
    shared = sorted(
        (-overlap, vehicle.number, index) for index, route in enumerate(routes)
        for vehicle, overlap in Counter(
            servant[node] for node in route.served if node in servant).items()
        if vehicle.type == route.vehicle_type)
    chosen: dict[int, Vehicle] = {}
    used = set(taken)
    for _, number, index in shared:
        vehicle = Vehicle(routes[index].vehicle_type, number)
        if index not in chosen and vehicle not in used:
            chosen[index] = vehicle
            used.add(vehicle)
    numbered = []
    for index, route in enumerate(routes):
        vehicle = chosen.get(index) or next(
            vehicle for number in count()
            if (vehicle := Vehicle(route.vehicle_type, number)) not in used)
        used.add(vehicle)
        numbered.append(replace(route, vehicle=vehicle.number))
    return numbered
