"""Reasons for customers who are served best on the way through others."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from model.counsel.explain import Reason, explain
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.solution import Solution
from tests.model.remedies import told

SECOND = 1000
RING = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}


def problem_of(roads: Mapping[tuple[int, int], int], number: int = 3,
               **limits: int) -> Problem:
    """Return streets of some seconds each; where there are none, a leg takes more than a day."""
    legs = np.full((number + 1, number + 1), 100_000 * SECOND, np.int64)
    np.fill_diagonal(legs, 0)
    for leg, seconds in roads.items():
        legs[leg] = seconds * SECOND
    customers = tuple(Customer(f"c{node}", (1,)) for node in range(1, number + 1))
    vehicles = VehicleType("van", 1, (10,), 0, cost_per_km=1.0, **limits)
    return Problem((Depot("depot"),), customers, (vehicles,), (Travel(legs, legs * 10),),
                   np.zeros((number + 1, 2)), 1e6)


def reason_for(problem: Problem, node: int, solution: Solution | None = None) -> Reason:
    nobody = Solution((), tuple(range(1, problem.num_nodes)))
    (reason,) = explain(problem, solution or nobody, node)
    return reason


def test_a_ring_that_takes_too_long_says_by_how_much() -> None:
    reason = reason_for(problem_of(RING, latest=14 * SECOND), 2)
    assert told(reason) == (0, "SHIFT", "By way of c1 and c3, the shortest, van would be back "
                            "0.1 minutes after its shift ends.")


def test_working_duration_and_distance_are_told_by_way_of_others() -> None:
    reason = reason_for(problem_of(RING, max_working_duration=14 * SECOND), 2)
    assert (reason.code, reason.message) == (
        "WORKING_HOURS", "By way of c1 and c3, the shortest, van would work 0.1 minutes more than "
        "it may.")
    reason = reason_for(problem_of(RING, max_trip_distance=150 * SECOND), 2)
    assert (reason.code, reason.message) == (
        "RANGE", "By way of c1 and c3, the shortest, van would drive 0.1 km more than a trip may "
        "be long.")


def test_who_is_left_out_beside_a_used_vehicle_could_be_served_together() -> None:
    problem = problem_of({**RING, (0, 4): 5, (4, 0): 5}, number=4, latest=20 * SECOND)
    route = schedule(problem, RouteDecision(0, 0, (TripDecision((0, 4, 0)),)))
    reason = reason_for(problem, 2, Solution((route,), (1, 2, 3)))
    assert told(reason) == (0, "FLEET_EXHAUSTED", "van could serve it together with c1 and c3, "
                            "but it is in use.")


def test_a_group_that_costs_more_than_it_is_worth_is_told_by_its_cost() -> None:
    problem = problem_of(RING, latest=20 * SECOND)
    dear = replace(problem, unassigned_cost=0.05)
    assert reason_for(dear, 2).code == "COST"
    assert reason_for(problem, 2).code == "SEARCH"


def test_the_straight_way_is_told_where_it_is_shortest() -> None:
    roads = {(0, 1): 5, (1, 0): 5, (1, 2): 5, (2, 1): 5, (0, 2): 8, (2, 0): 8}
    reason = reason_for(problem_of(roads, number=2, latest=15 * SECOND), 2)
    assert reason.remedy == "fits if van's shift ended 0.1 minutes later"
