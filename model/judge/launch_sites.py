"""Stops at launch sites, where trucks stop for their drones alone."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import compress

from model.judge.rules import TimedTrip, Violation, seconds
from model.judge.timing import RouteDecision, TripDecision
from model.problem import Problem
from model.solution import Route, Trip


def with_launch_sites(problem: Problem, route: Route) -> Route:
    """Return a route whose stops tell which of them are launch sites, as their nodes do."""
    if not problem.launch_sites:
        return route
    return replace(route, trips=tuple([
        replace(trip, stops=tuple([
            replace(stop, is_launch_site=0 < index < len(trip.stops) - 1
                    and problem.is_launch_site(stop.node))
            for index, stop in enumerate(trip.stops)]))
        for trip in route.trips]))


def site_violations(problem: Problem, kind: int, trips: list[TimedTrip]) -> Iterator[Violation]:
    """What stops at launch sites break: who may stop there, when, and after whom."""
    if not problem.launch_sites:
        return
    vehicle_type, served = problem.vehicle_types[kind], set[str]()
    for timed in trips:
        for index, stop in enumerate(timed.trip.stops):
            if stop.is_launch_site:
                site, path = problem.depots[stop.node], f"{timed.path}.stops[{index}]"
                if not problem.allows_stop(kind, stop.node):
                    message = f"{vehicle_type.id} may not stop at {site.id} for its drones"
                    yield Violation("LAUNCH_SITE", message, path)
                if stop.arrival > site.latest:
                    message = (f"{site.id} is reached at {seconds(stop.arrival)}, after "
                               f"{seconds(site.latest)}")
                    yield Violation("TIME_WINDOW", message, path)
                if site.after is not None and site.after not in served:
                    message = f"{vehicle_type.id} hasn't served {site.after} before"
                    yield Violation("LAUNCH_SITE", message, path)
            served |= _served_by_then(problem, timed.trip, index)


def _served_by_then(problem: Problem, trip: Trip, stop: int) -> set[str]:
    """Return whom a truck and the drones recovered have served as it leaves a stop."""
    nodes = [visit.node for sortie in trip.sorties if sortie.recovery_stop == stop
             for visit in sortie.visits]
    here = trip.stops[stop]
    if here.node >= problem.num_depots:
        nodes.append(here.node)
    return {problem.customer_at(node).id for node in nodes}


def without_idle_stops(problem: Problem, route: RouteDecision) -> RouteDecision:
    """Return a route without stops at launch sites that no drone uses, and trips to nobody."""
    if not problem.launch_sites:
        return route
    trips = [_without_idle_stops(problem, trip) for trip in route.trips]
    return replace(route, trips=tuple([trip for trip in trips
                                       if trip.customers(problem.num_depots)]))


def _without_idle_stops(problem: Problem, trip: TripDecision) -> TripDecision:
    used = {stop for sortie in trip.sorties for stop in (sortie.launch_stop, sortie.recovery_stop)}
    last = len(trip.nodes) - 1
    stays = [index in (0, last) or index in used or not problem.is_launch_site(node)
             for index, node in enumerate(trip.nodes)]
    if all(stays):
        return trip
    place = [sum(stays[:index]) for index in range(len(stays))]
    operations = trip.operations
    return replace(
        trip, nodes=tuple(compress(trip.nodes, stays)),
        sorties=tuple([replace(sortie, launch_stop=place[sortie.launch_stop],
                               recovery_stop=place[sortie.recovery_stop])
                       for sortie in trip.sorties]),
        operations=None if operations is None else tuple(compress(operations, stays)))
