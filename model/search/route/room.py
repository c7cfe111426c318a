"""How much the arrays of a search have room for: the one place where that is counted.

A route holds what it may when all rules are kept, and what one insertion adds before it is known
whether they are. Whatever breaks rules on its way may need more, as stops at launch sites for
customers who are still missing: whoever adds to a route asks (`engine/search/route/edit.h`), and a
move for which there is no room is refused.
"""

from typing import NamedTuple

import numpy as np

from model.engine.amount_rows import DIMENSIONS_PER_TIER
from model.engine.records import Record
from model.problem import IntArray, Problem
from model.search.route.layout import MOST_VISITS, ProblemData
from model.solution import Solution

SPARE_ROUTES = 8

STOPS_OPENED = 4
"""Stops that one insertion adds at most, and one more; of shipments with several pickups more."""


class Room(NamedTuple):
    """How many rows there are."""

    routes: int  # none but those given, or as many as vehicles may be wanted
    stops: int  # of a route: customers, where each of them is launched and recovered, ends of trips
    trips: int  # of a route, and one more that is refused
    sorties: int  # of a route: one to each customer, and one more that is refused


def room_for(problem: Problem, data: ProblemData, solution: Solution) -> Room:
    """Return how much a search that begins from a plan needs."""
    types = data.type[:data.num_types]
    served, fewest = _served_by_one(problem, types)
    # What is given may keep fewer rules than what the search makes of it.
    served = max((served, *(sum(len(trip.stops) + len(trip.sorties) for trip in route.trips)
                            for route in solution.routes)))
    wanted = 2 * max(len(solution.routes), 2 * fewest) + SPARE_ROUTES
    if not solution.routes:
        wanted = problem.num_customers
    trips = min(int(types["max_trips"].max()), max(1, served)) + 1
    flown = served if data.visits.any() else 0
    halts = 2 * flown if len(data.halts) else 0
    opened = max([STOPS_OPENED, *[len(each.nodes) + 1 for each in problem.shipments]])
    return Room(
        routes=max(1, min(int(types["count"].sum()), problem.num_customers, wanted),
                   len(solution.routes)),
        stops=served + halts + 2 * trips + opened, trips=trips, sorties=flown + 1)


def _served_by_one(problem: Problem, types: np.ndarray) -> tuple[int, int]:
    """Return how many customers one vehicle serves at most, and how many vehicles are needed."""
    number = problem.num_customers
    delivered, picked = (np.array(amounts, np.int64).reshape(number, problem.num_dimensions)
                         for amounts in ([customer.demand for customer in problem.customers],
                                         [customer.taken_in for customer in problem.customers]))
    asked = np.maximum(delivered.sum(axis=0), picked.sum(axis=0))
    most, fewest = 0, number
    for kind in types:
        capacity = kind.capacity[:len(asked)] * min(int(kind.max_trips), number)
        if kind.drones:
            # Part of a trip is written anew before more than what it delivers is looked at.
            looked_at = slice(DIMENSIONS_PER_TIER)
            most = max(most, _most_of(delivered[:, looked_at], capacity[looked_at]))
        else:
            most = max(most, min(_most_carried(delivered, picked, capacity), _most_served(kind)))
        needed = int(np.ceil(asked / np.maximum(capacity, 1)).max()) if number else 0
        fewest = min(fewest, max(needed, -(-number // max(1, _most_served(kind)))))
    return most, fewest


def _most_carried(delivered: IntArray, picked: IntArray, capacity: IntArray) -> int:
    """Return how many customers a vehicle carries for at most; amounts are (customer, dimension).
    """
    has, had = delivered.any(axis=1), picked.any(axis=1)
    carried = _most_of(delivered[has], capacity) + _most_of(picked[had], capacity)
    return min(len(delivered), carried + int((~(has | had)).sum()))


def _most_of(amounts: IntArray, capacity: IntArray) -> int:
    """Return how many of these (customer, dimension) a capacity holds at most."""
    return int((np.sort(amounts, axis=0).cumsum(axis=0) <= capacity).all(axis=1).sum())


def _most_served(kind: Record) -> int:
    """Return how many customers a vehicle of a type serves at most, by stops and sorties."""
    flown = int(kind.max_sorties) * MOST_VISITS if kind.drones else 0
    return int(kind.max_trips) * (int(kind.max_stops) + flown)
