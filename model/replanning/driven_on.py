"""How vehicles would go on by the plan given, where nothing is planned anew.

What is planned anew begins where a vehicle has all drones aboard, and serves what can be told as a
problem of its own. The plan given may know better: no new plan should be worse than that.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from model.judge.check import judge_route
from model.judge.ends import with_ends
from model.judge.past import Past
from model.judge.retiming import time_route
from model.judge.timing import (
    RouteDecision, TripDecision, latest_release, read_decision, schedule_trip,
)
from model.problem import Problem, VehicleType
from model.replanning.amend import Broken, broken_by, customers_of, repaired, without
from model.replanning.handover import complete
from model.replanning.kept import Kept, by_launch, kept_routes, resumed
from model.replanning.spans import awaiting, out_of_turn
from model.replanning.workers import VehicleWorker
from model.solution import Route, Solution, Trip, Vehicle


def carried_through(problem: Problem, planned: Route, own: Kept, past: Past) -> Kept:
    """Return what a vehicle does in any case, its last trip driven to the end as planned.

    That is without the customers for whom rules are broken; as before if nobody is left.
    """
    begun = _with_trip_under_way(problem, planned, own, past)
    decision, route = _mended(problem, begun, own, past)
    if set(customers_of(problem, decision.trips[-1])) <= own.served:
        return own
    return Kept(own.vehicle, decision, route)


def kept_by(problem: Problem, plan: Solution,
             past: Past) -> tuple[dict[Vehicle, Kept], dict[Vehicle, Kept]]:
    """Return what vehicles do in any case; and of these who drive their trips as planned.

    They do so where no way leads home from their next stop.
    """
    kept = kept_routes(problem, plan, past)
    through = {vehicle: carried_through(problem, route, kept[vehicle], past)
               for route in plan.routes
               if (vehicle := route.driven_by) in kept
               and past.under_way(vehicle) is not None
               and any(violation.code == "UNREACHABLE" for violation
                       in judge_route(problem, kept[vehicle].route, "", past).violations)}
    return kept | through, through


def going_through(problem: Problem, plan: Solution, past: Past, kept: Mapping[Vehicle, Kept],
             workers: Collection[VehicleWorker]) -> dict[Vehicle, Kept]:
    """Return vehicles that drive their trips as planned, as no worker can go on with them."""
    going_on = {worker.vehicle for worker in workers if worker.is_under_way}
    found = {}
    for route in plan.routes:
        vehicle = route.driven_by
        trip, own = past.under_way(vehicle), kept.get(vehicle)
        if trip is None or own is None or vehicle in going_on or not trip.aboard - own.served:
            continue
        through = carried_through(problem, route, own, past)
        if through.served > own.served:
            found[vehicle] = through
    return found


def as_it_stands(problem: Problem, plan: Solution, kept: Mapping[Vehicle, Kept]) -> Solution:
    """Return the plan given with its times, whatever it breaks now.

    Vehicles that have begun to work come first, in the order of `kept`. What names somebody who is
    no more is left out as a whole.
    """
    planned = {route.driven_by: route for route in plan.routes
               if route.trips}
    order = [*kept, *(vehicle for vehicle in planned if vehicle not in kept)]
    return complete(problem, tuple([
        planned[vehicle] for vehicle in order
        if all(node >= 0 for trip in planned[vehicle].trips for node in trip.nodes)]))


def driven_on(problem: Problem, plan: Solution, kept: Mapping[Vehicle, Kept],
              past: Past) -> Solution:
    """Return the plan given as it goes on by itself, without customers for whom rules are broken.

    Vehicles that have begun to work come first, in the order of `kept`.
    """
    planned = {route.driven_by: route for route in plan.routes}
    routes, driven = list[Route](), set[Vehicle]()
    for vehicle in (*kept, *(vehicle for vehicle in planned if vehicle not in kept)):
        own = kept.get(vehicle)
        if vehicle in past.unavailable:
            routes += [] if own is None else [own.route]
            driven.add(vehicle)
            continue
        decision = _whole(problem, planned[vehicle], own, past)
        others = [*routes, *(other.route for ahead, other in kept.items()
                             if ahead != vehicle and ahead not in driven)]
        route = _in_turn(problem, decision, own, past, others)
        routes += [] if route is None else [route]
        driven.add(vehicle)
    return complete(problem, tuple(routes))


def _in_turn(problem: Problem, decision: RouteDecision, own: Kept | None, past: Past,
             others: Sequence[Route]) -> Route | None:
    """Return a route without those for whom rules are broken, orders with others' among them."""
    fixed = set[int]() if own is None else own.served
    while decision.trips:
        decision, route = _mended(problem, awaiting(problem, decision, others), own, past)
        late = out_of_turn(problem, route, others) - fixed if decision.trips else ()
        if not late:
            return route if decision.trips else None
        trips = [without(trip, late) for trip in decision.trips]
        known = 0 if own is None else len(own.decision.trips)
        decision = replace(decision, trips=tuple([
            trip for number, trip in enumerate(trips)
            if number < known or customers_of(problem, trip)]))
    return None


def _whole(problem: Problem, planned: Route, own: Kept | None, past: Past) -> RouteDecision:
    """Return a vehicle's decisions, what has happened first."""
    kind = problem.vehicle_types[planned.vehicle_type]
    grounded = past.grounded_on(planned.driven_by)
    begun: tuple[TripDecision, ...] = ()
    if own is not None:
        begun = _with_trip_under_way(problem, planned, own, past).trips
    later = [_without_lost(read_decision(replace(trip, sorties=tuple(
        sortie for sortie in trip.sorties if _can_fly(kind, sortie.drone, grounded))), kind,
        problem.lags_across))
        for trip in planned.trips[len(begun):]]
    trips = [*begun, *(trip for trip in later if customers_of(problem, trip))][:kind.max_trips]
    return RouteDecision(planned.vehicle_type, planned.vehicle,
                         with_ends(kind, trips) if len(trips) > len(begun) else tuple(trips))


def _with_trip_under_way(problem: Problem, planned: Route, own: Kept, past: Past) -> RouteDecision:
    """Return the trips that a vehicle has begun, the last one as it was planned."""
    known = past.trips[own.vehicle]
    if known[-1].rest != "anything":
        return own.decision
    kind, trip = problem.vehicle_types[own.vehicle.type], planned.trips[len(known) - 1]
    grounded = past.grounded_on(own.vehicle)
    begun, others = by_launch(trip, known[-1])
    flown = (*begun, *(sortie for sortie in others if _can_fly(kind, sortie.drone, grounded)))
    last = _without_lost(read_decision(Trip(trip.stops, flown), kind, problem.lags_across))
    return replace(own.decision, trips=(*own.decision.trips[:-1], last))


def _can_fly(kind: VehicleType, drone: int, grounded: Collection[int]) -> bool:
    return drone < kind.num_drones and drone not in grounded


def _without_lost(decision: TripDecision) -> TripDecision:
    """Return a trip without those who are no more customers."""
    return without(decision, {-1})


def _mended(problem: Problem, decision: RouteDecision, own: Kept | None,
            past: Past) -> tuple[RouteDecision, Route]:
    """Return a route without the customers for whom it breaks rules that weren't broken before."""
    stated = _as_stated(problem, decision, past)
    if not judge_route(problem, stated, "", past).violations:
        return decision, stated
    fixed: Collection[int] = ()
    excused = frozenset[Broken]()
    if own is not None:
        fixed = own.served
        excused = broken_by(problem, own.decision, lambda _: own.route, past)
    timings = [lambda tried: _as_stated(problem, tried, past),
               lambda tried: time_route(problem, tried, "", past).route]
    mended = repaired(problem, decision, fixed, timings, past, excused)
    if mended is None:
        return replace(decision, trips=()), stated
    return mended, time_route(problem, mended, "", past).route


def _as_stated(problem: Problem, decision: RouteDecision, past: Past) -> Route:
    """Return a route whose trips begin when they state, if they can by then."""
    kind = problem.vehicle_types[decision.vehicle_type]
    known = past.trips.get(decision.driven_by, ())
    trips = resumed(problem, decision, known, past.now)
    for trip in decision.trips[len(known):]:
        ready = max(kind.earliest, past.now)
        if trips:
            ready = max(ready, trips[-1].stops[-1].departure + kind.reload_duration)
        back = max([past.returned.get(node, 0) for node in customers_of(problem, trip)], default=0)
        start = max(ready, back, latest_release(problem, trip), trip.start or 0)
        trips.append(schedule_trip(problem, kind, replace(trip, start=start), ready, trips))
    return Route(decision.vehicle_type, decision.vehicle, tuple(trips))
