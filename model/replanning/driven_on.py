"""How vehicles would go on by the plan given, where nothing is planned anew.

What is planned anew begins where a vehicle has all drones aboard, and serves what can be told as a
problem of its own. The plan given may know better: no new plan should be worse than that.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace

from model.judge.check import judge_route
from model.judge.ends import with_ends
from model.judge.past import Past, Vehicle
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision, read_decision
from model.problem import Problem, VehicleType
from model.replanning.amend import broken_by, customers_of, repaired, without
from model.replanning.handover import complete
from model.replanning.kept import Kept, by_launch
from model.solution import Route, Solution, Trip


def carried_through(problem: Problem, planned: Route, own: Kept, past: Past) -> Kept:
    """Return what a vehicle does in any case, its last trip driven to the end as planned.

    That is without the customers for whom rules are broken; as before if nobody is left.
    """
    begun = _with_trip_under_way(problem, planned, own, past)
    decision = _mended(problem, begun, own, past)
    if set(customers_of(decision.trips[-1])) <= own.served:
        return own
    return Kept(own.vehicle, decision, _timed(problem, decision, past))


def driven_on(problem: Problem, plan: Solution, kept: Mapping[Vehicle, Kept],
              past: Past) -> Solution:
    """Return the plan given as it goes on by itself, without customers for whom rules are broken.

    Vehicles that have begun to work come first, in the order of `kept`.
    """
    planned = {Vehicle(route.vehicle_type, route.vehicle): route for route in plan.routes}
    routes = []
    for vehicle in (*kept, *(vehicle for vehicle in planned if vehicle not in kept)):
        own = kept.get(vehicle)
        if vehicle in past.unavailable:
            routes += [] if own is None else [own.route]
            continue
        decision = _whole(problem, planned[vehicle], own, past)
        if decision.trips:
            mended = _mended(problem, decision, own, past)
            routes += [_timed(problem, mended, past)] if mended.trips else []
    return complete(problem, tuple(routes))


def _whole(problem: Problem, planned: Route, own: Kept | None, past: Past) -> RouteDecision:
    """Return a vehicle's decisions, what has happened first."""
    kind = problem.vehicle_types[planned.vehicle_type]
    grounded = past.grounded_on(Vehicle(planned.vehicle_type, planned.vehicle))
    begun: tuple[TripDecision, ...] = ()
    if own is not None:
        begun = _with_trip_under_way(problem, planned, own, past).trips
    later = [_without_lost(read_decision(Trip(trip.stops, tuple(
        sortie for sortie in trip.sorties if _can_fly(kind, sortie.drone, grounded))), kind))
        for trip in planned.trips[len(begun):]]
    trips = [*begun, *(trip for trip in later if customers_of(trip))][:kind.max_trips]
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
    last = _without_lost(read_decision(Trip(trip.stops, flown), kind))
    return replace(own.decision, trips=(*own.decision.trips[:-1], last))


def _can_fly(kind: VehicleType, drone: int, grounded: Collection[int]) -> bool:
    return drone < kind.num_drones and drone not in grounded


def _without_lost(decision: TripDecision) -> TripDecision:
    """Return a trip without those who are no more customers."""
    return without(decision, {-1})


def _mended(problem: Problem, decision: RouteDecision, own: Kept | None,
            past: Past) -> RouteDecision:
    """Return a route without the customers for whom it breaks rules that weren't broken before."""
    if not judge_route(problem, _timed(problem, decision, past), "", past).violations:
        return decision
    fixed: Collection[int] = ()
    excused = frozenset[tuple[str, str, tuple[int, ...]]]()
    if own is not None:
        fixed = own.served
        excused = broken_by(problem, own.decision, lambda _: own.route, past)
    return (repaired(problem, decision, fixed, [lambda tried: _timed(problem, tried, past)], past,
                     excused) or replace(decision, trips=()))


def _timed(problem: Problem, decision: RouteDecision, past: Past) -> Route:
    return time_route(problem, decision, "", past).route
