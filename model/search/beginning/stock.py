"""Batteries that routes of vehicles that fly take of their depots."""

from collections.abc import Sequence

from model.problem import UNLIMITED, Problem
from model.solution import Route


def batteries_taken(problem: Problem, routes: Sequence[Route], node: int) -> int:
    """Return how many batteries routes take of a depot."""
    return sum(trip.stops[0].node == node for route in routes
               if problem.vehicle_types[route.vehicle_type].takes_batteries
               for trip in route.trips)


def batteries_left(problem: Problem, routes: Sequence[Route], node: int) -> int:
    """Return how many batteries routes leave of a depot."""
    stock = problem.depots[node].batteries
    return UNLIMITED if stock is None else stock - batteries_taken(problem, routes, node)
