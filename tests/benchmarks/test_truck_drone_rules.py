"""Tests of `benchmarks.truck_drone_rules`."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from benchmarks.truck_drone_rules import CROSSINGS, LOOPS, MIXED_LOADS, RULES, broken_rules
from model.judge.rules import Violation
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Customer, DroneType, Problem, VehicleType
from model.solution import Solution


@pytest.fixture
def problem(tiny_problem: Callable[..., Problem]) -> Problem:
    """Three customers with 6 to deliver and 1 to pick up, 2 and 7, 1 and 1; drones carry 10."""
    customers = [Customer(name, (delivery * 1000, pickup * 1000))
                 for name, delivery, pickup in (("a", 6, 1), ("b", 2, 7), ("c", 1, 1))]
    drones = DroneType(2, (10_000, 10_000), travel=1, max_customers_per_sortie=3)
    return tiny_problem(*customers, truck=VehicleType("truck", 1, (20_000, 20_000), 0,
                                                      drones=drones))


def _judge(problem: Problem, trip: TripDecision, *forbids: str) -> list[Violation]:
    plan = Solution((schedule(problem, RouteDecision(0, 0, (trip,))),))
    return broken_rules(problem, plan, forbids)


def test_loops_and_crossings_are_told_apart(problem: Problem) -> None:
    loop, crossing = SortieDecision((2,), 1, 1), SortieDecision((3,), 1, 2, drone=1)
    trip = TripDecision((0, 1, 0), (loop, crossing))
    assert _judge(problem, trip) == []
    assert [(violation.code, violation.path) for violation in _judge(problem, trip, LOOPS)] == [
        ("LOOPS", "routes[0].trips[0].sorties[0]")]
    assert [(violation.code, violation.path) for violation in _judge(problem, trip, CROSSINGS)
            ] == [("CROSSINGS", "routes[0].trips[0].sorties[1]")]


@pytest.mark.parametrize(("nodes", "most"), [((1, 2), 8), ((2, 1), 13), ((1, 3), 7)])
def test_mixed_loads_count_both_ways_together(
    problem: Problem, nodes: tuple[int, ...], most: int
) -> None:
    trip = TripDecision((0, 0), (SortieDecision(nodes, 0, 1),))
    broken = _judge(problem, trip, MIXED_LOADS)
    assert [violation.code for violation in broken] == ["MIXED_LOADS"] * (most > 10)
    assert all(f"carries {most}," in violation.message for violation in broken)


def test_mixed_loads_of_a_loop_may_be_flown_the_other_way_round(problem: Problem) -> None:
    trip = TripDecision((0, 3, 0), (SortieDecision((2, 1), 1, 1),))
    assert _judge(problem, trip, MIXED_LOADS) == []


def test_mixed_loads_of_a_loop_that_are_too_much_either_way_round(problem: Problem) -> None:
    customers = tuple(replace(customer, demand=demand) for customer, demand in zip(
        problem.customers, ((4000, 0), (0, 9000), (4000, 0)), strict=True))
    trip = TripDecision((0, 0), (SortieDecision((1, 2, 3), 0, 0),))
    broken, = _judge(replace(problem, customers=customers), trip, MIXED_LOADS)
    assert "carries 13," in broken.message


def test_trucks_without_drones_break_nothing(
    tiny_problem: Callable[..., Problem], truck: VehicleType
) -> None:
    lone = tiny_problem(Customer("a", (1000,)), truck=truck)
    assert _judge(lone, TripDecision((0, 1, 0)), *RULES) == []


def test_unknown_rules_are_refused(problem: Problem) -> None:
    with pytest.raises(ValueError, match="'circles'"):
        _judge(problem, TripDecision((0, 1, 0)), "circles")
