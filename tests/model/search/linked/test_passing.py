"""Who has neighbours alone to go beside is found a place on a way that passes by."""

import numpy as np

from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.problem import MM_PER_KM, Customer, Depot, Problem, Travel, VehicleType
from model.search.beginning.translate import make_searcher
from model.search.linked.engine import anneal_linked, tie, write_back
from model.search.linked.layout import Linked
from model.search.neighbourhood.neighbourhood import NEAR_INSERTION
from model.search.problem_data import are_timed, make_data
from model.solution import Solution
from tests.model.search.found import read_plan

ON_A_ROUTE = 30
"""Customers whom a vehicle serves at most."""

NEARER, FARTHER, SPARE = 14, 2, 5
"""Routes to a village that the lone customer lives in, and to a town beyond, with room on each."""

TURNS = 300

EACH_DRAWN = 4
"""Of how many routes one is drawn where nobody is near."""


def village_and_town() -> tuple[Problem, list[list[int]]]:
    """Return a problem, and the trips that serve all but the last customer, who lives alone."""
    rng = np.random.default_rng(5)
    in_village, in_town = NEARER * ON_A_ROUTE, FARTHER * (ON_A_ROUTE - SPARE)
    place = np.zeros((1 + in_village + in_town + 1, 2))
    place[1:-1] = rng.uniform(-5, 5, (in_village + in_town, 2))
    place[1:, 0] += np.repeat([500.0, 1000.0, 500.0], [in_village, in_town, 1])
    legs = np.rint(np.linalg.norm(place[:, None] - place, axis=2) * MM_PER_KM).astype(np.int64)
    customers = tuple(Customer(str(node), (1000,)) for node in range(1, len(place)))
    truck = VehicleType("truck", NEARER + FARTHER + 1, (1000 * ON_A_ROUTE,), 0, fixed_cost=1.0,
                        cost_per_km=1.0)
    problem = Problem((Depot("hub"),), customers, (truck,), (Travel(legs, legs),), place,
                      unassigned_cost=1e6)
    served = np.split(np.arange(1, in_village + 1), NEARER) + np.split(
        np.arange(in_village + 1, in_village + in_town + 1), FARTHER)
    return problem, [trip.tolist() for trip in served]


def test_a_route_to_a_town_serves_a_village_on_the_way() -> None:
    problem, trips = village_and_town()
    alone = problem.num_nodes - 1
    plan = Solution(tuple(
        schedule(problem, RouteDecision(0, number, (TripDecision((0, *trip, 0)),)))
        for number, trip in enumerate(trips)), (alone,))
    data = make_data(problem, pack([problem]))
    assert not data.strategy.scan_all
    assert len(plan.routes) >= EACH_DRAWN
    assert (data.granular[alone, :NEAR_INSERTION] <= NEARER * ON_A_ROUTE).all()
    searcher = make_searcher(problem, data, plan, np.random.SeedSequence(1))
    searcher.value.temperature, searcher.value.cooling = 1e-9, 1.0
    linked = Linked(data, searcher, are_timed(data))
    tie(data, searcher, linked)
    anneal_linked(data, searcher, linked, TURNS)
    write_back(data, searcher, linked)
    found = read_plan(data, searcher)
    assert not found.unassigned
    driven = [{stop.node for stop in trip.stops} for route in found.routes for trip in route.trips]
    assert len(driven) == len(trips)
    town = set(trips[-1] + trips[-2])
    assert sum(bool(nodes & town) for nodes in driven) == FARTHER
    assert all(len(nodes) - 1 <= ON_A_ROUTE for nodes in driven)
