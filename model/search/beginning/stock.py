"""Batteries, and places to charge, that routes of vehicles that fly take of their depots."""

from collections.abc import Sequence
from typing import NamedTuple

from model.problem import UNLIMITED, Problem
from model.solution import Route


class Stock(NamedTuple):
    """What there is at a depot, or taken of it."""

    batteries: int
    chargers: int


def taken_at(problem: Problem, routes: Sequence[Route], node: int) -> Stock:
    """Return what routes take of a depot."""
    kinds = problem.vehicle_types
    return Stock(
        sum(trip.stops[0].node == node for route in routes
            if kinds[route.vehicle_type].takes_batteries for trip in route.trips),
        sum(kinds[route.vehicle_type].depot == node
            and len(route.trips) > kinds[route.vehicle_type].trips_uncharged for route in routes))


def left_at(problem: Problem, routes: Sequence[Route], node: int) -> Stock:
    """Return what routes leave of a depot."""
    depot = problem.depots[node]
    if depot.batteries is None and depot.chargers is None:
        return Stock(UNLIMITED, UNLIMITED)
    taken = taken_at(problem, routes, node)
    return Stock(UNLIMITED if depot.batteries is None else depot.batteries - taken.batteries,
                 UNLIMITED if depot.chargers is None else depot.chargers - taken.chargers)
