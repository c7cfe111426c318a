"""Customers who can be served together alone: the plans that are found."""

import math
from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from model.judge.check import check
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision
from model.planner import Planner, PlanOptions, PlanResult, load_planner
from model.problem import (
    MAX_QUANTITY, UNLIMITED, Customer, Depot, DroneType, Part, Problem, Shipment, Travel,
    VehicleType,
)
from model.solution import Solution
from model.together.filling import Filling
from model.together.joint import Joint, find_joint
from model.together.pulling import Pulling, nobody_served
from model.together.relaxed import relaxed
from training.instances import VARIANTS, generate

WEIGHTS = Path(__file__).parents[3] / "model" / "weights"
SECOND = 1000
NO_ROAD = 100_000 * SECOND


@pytest.fixture(scope="module")
def planner() -> Planner:
    return load_planner(WEIGHTS, ["attention"])


def streets(size: int, roads: Mapping[tuple[int, int], int]) -> Travel:
    """Return legs of some seconds each where there is a road, and of a day where there is none."""
    legs = np.full((size, size), NO_ROAD, np.int64)
    np.fill_diagonal(legs, 0)
    for leg, seconds in roads.items():
        legs[leg] = seconds * SECOND
    return Travel(legs, legs * 10)


def problem_of(number: int, roads: Mapping[tuple[int, int], int],
               vehicles: VehicleType) -> Problem:
    """Return a problem of so many customers, nodes from 1 on."""
    return Problem((Depot("depot"),), tuple(Customer(f"c{node}", (1,)) for node in
                                            range(1, number + 1)), (vehicles,),
                   (streets(number + 1, roads),), np.zeros((number + 1, 2)), 1e6)


def van(closing: int, count: int = 1) -> VehicleType:
    return VehicleType("van", count, (10,), 0, cost_per_km=1.0, latest=closing * SECOND)


def planned(planner: Planner, problem: Problem) -> PlanResult:
    result = planner.plan(problem, PlanOptions("attention", time_limit=60.0,
                                               search_iterations=100))
    assert not check(problem, result.solution).violations
    return result


def visited(result: PlanResult) -> list[tuple[int, ...]]:
    """Return whom each trip serves, in order."""
    return sorted(tuple(stop.node for stop in trip.stops[1:-1])
                  for route in result.solution.routes for trip in route.trips)


def test_a_pair_and_a_customer_alone_are_all_served(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 0): 5, (0, 3): 5, (3, 0): 5}
    result = planned(planner, problem_of(3, roads, van(40, count=2)))
    assert result.solution.unassigned == ()
    assert {node for trip in visited(result) for node in trip} == {1, 2, 3}


def test_a_ring_is_driven_before_the_shift_ends(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    assert visited(planned(planner, problem_of(3, roads, van(20)))) == [(1, 2, 3)]


@pytest.mark.parametrize(("more", "expected"), [((), [(1, 2, 3)]), ((2,), [(2, 1, 3)])])
def test_a_shipment_is_brought_by_way_of_another(planner: Planner, more: tuple[int, ...],
                                                 expected: list[tuple[int, ...]]) -> None:
    ring = (0, *expected[0], 0)
    problem = problem_of(3, dict.fromkeys(pairwise(ring), 5), van(20))
    shipment = Shipment("s", 1, 3, (1,), more=tuple(Part(node, (1,)) for node in more))
    problem = replace(problem, shipments=(shipment,), customers=tuple(
        replace(each, demand=(int(node not in shipment.nodes),), served_by="truck",
                unassigned_cost=0.0 if node in shipment.nodes[1:] else None)
        for node, each in enumerate(problem.customers, 1)))
    assert visited(planned(planner, problem)) == expected


def test_a_ring_that_takes_longer_than_the_shift_is_left_out(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    assert planned(planner, problem_of(3, roads, van(19))).solution.unassigned == (1, 2, 3)


def test_one_way_streets_are_driven_as_far_as_the_closing_time_lets(planner: Planner) -> None:
    roads = {(0, 1): 10, (1, 0): 10, (1, 2): 5, (2, 3): 5, (3, 4): 5, (4, 5): 5, (5, 6): 5,
             (6, 0): 5}
    assert visited(planned(planner, problem_of(6, roads, van(40)))) == [(1, 2, 3, 4, 5, 6)]
    assert visited(planned(planner, problem_of(6, roads, van(39)))) == [(1,)]


@pytest.mark.parametrize("limits", [
    {"max_working_duration": 20 * SECOND}, {"max_trip_distance": 200 * SECOND},
])
def test_other_limits_than_the_shift_are_kept_through_others(planner: Planner,
                                                             limits: dict[str, int]) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    vehicles = VehicleType("van", 1, (10,), 0, cost_per_km=1.0, **limits)
    assert visited(planned(planner, problem_of(3, roads, vehicles))) == [(1, 2, 3)]


def test_a_window_is_reached_through_another_customer(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 0): 5, (1, 0): 5}
    problem = problem_of(2, roads, van(UNLIMITED // SECOND))
    first, second = problem.customers
    closed = Customer(second.id, second.demand, latest=10 * SECOND)
    problem = Problem(problem.depots, (first, closed), problem.vehicle_types, problem.travel,
                      problem.coordinates, problem.unassigned_cost)
    assert visited(planned(planner, problem)) == [(1, 2)]


def test_a_truck_with_a_drone_serves_a_ring(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    drones = DroneType(1, (1,), 0, endurance=SECOND)
    vehicles = VehicleType("van", 1, (10,), 0, cost_per_km=1.0, latest=20 * SECOND, drones=drones)
    assert visited(planned(planner, problem_of(3, roads, vehicles))) == [(1, 2, 3)]


def test_who_is_not_to_be_served_at_that_price_is_left_out(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    vehicles = VehicleType("van", 1, (10,), 0, fixed_cost=1e7, latest=20 * SECOND)
    assert planned(planner, problem_of(3, roads, vehicles)).solution.unassigned == (1, 2, 3)


def test_a_search_without_turns_returns_the_decoded_plan(planner: Planner) -> None:
    roads = {(0, 1): 5, (1, 2): 5, (2, 3): 5, (3, 0): 5}
    result = planner.plan(problem_of(3, roads, van(20)), PlanOptions("attention", time_limit=0.0))
    assert result.solution.unassigned == (1, 2, 3)


def test_usual_problems_have_no_groups() -> None:
    rng = np.random.default_rng(3)
    for variant in VARIANTS:
        assert find_joint(generate(rng, 20, variant)) is None, variant


def test_limits_are_soft_where_vehicles_work_for_years_and_legs_are_missing() -> None:
    problem = problem_of(3, {(0, 1): 5, (1, 2): 5, (2, 0): 5}, replace(
        van(1), latest=MAX_QUANTITY - 1, earliest=8 * 3600 * SECOND))
    legs, distance = problem.travel[0].arrays()
    legs[0, 3] = legs[3, 0] = MAX_QUANTITY
    problem = replace(problem, travel=(Travel(legs, distance),))
    soft = relaxed(problem, Joint(problem, True))
    assert soft is not None
    # An hour late costs more than many legs.
    assert soft.vehicle_types[0].overtime is not None
    assert soft.vehicle_types[0].overtime.cost_per_hour > 1


def test_trips_that_go_while_strings_are_put_in_are_passed_over() -> None:
    roads = {(0, 1): 5, (1, 0): 5, (0, 2): 5, (2, 0): 5, (0, 3): 5, (3, 0): 5}
    problem = problem_of(3, roads, replace(van(1000), max_trips=3))
    customers = (*[replace(each, unassigned_cost=0.001) for each in problem.customers[:2]],
                 replace(problem.customers[2], demand=(11,)))
    problem = replace(problem, customers=customers)
    plan = Solution((time_route(problem, RouteDecision(0, 0, (
        TripDecision((0, 1, 0)), TripDecision((0, 2, 0)))), "", EVERYTHING_OPEN).route,), (3,))
    filling = Filling(problem, plan, Joint(problem, True), lambda: False,
                      np.random.default_rng(0))
    filling.fill(4)
    assert check(problem, filling.plan).violations == ()
    assert check(problem, filling.plan).cost.total <= check(problem, plan).cost.total


def test_nobody_is_pulled_in_where_looking_takes_longer_than_a_look_at_the_clock(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("model.together.pulling.MOST_LEGS", 15)
    monkeypatch.setattr("model.together.pulling.relaxed", None)  # which would look
    problem = problem_of(3, {(0, 1): 5, (1, 2): 5, (2, 0): 5}, van(20))
    plan = nobody_served(problem)
    pulling = Pulling(problem, Joint(problem, True), lambda: False, math.inf,
                      np.random.default_rng(0))
    assert pulling.pull(plan, True) == plan
