"""Tests of `benchmarks.quality.truck_drone_rules`."""

from collections.abc import Callable

import pytest

from benchmarks.quality.truck_drone_rules import CROSSINGS, LOOPS, RULES, broken_rules
from model.judge.rules import Violation
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Customer, DroneType, Problem, VehicleType
from model.solution import Solution

pytestmark = pytest.mark.slow


@pytest.fixture
def problem(tiny_problem: Callable[..., Problem]) -> Problem:
    """Three customers, a truck and two drones."""
    customers = [Customer(name, (1000,)) for name in "abc"]
    drones = DroneType(2, (10_000,), travel=1)
    return tiny_problem(*customers, truck=VehicleType("truck", 1, (20_000,), 0, drones=drones))


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


def test_trucks_without_drones_break_nothing(
    tiny_problem: Callable[..., Problem], truck: VehicleType
) -> None:
    lone = tiny_problem(Customer("a", (1000,)), truck=truck)
    assert _judge(lone, TripDecision((0, 1, 0)), *RULES) == []


def test_unknown_rules_are_refused(problem: Problem) -> None:
    with pytest.raises(ValueError, match="'circles'"):
        _judge(problem, TripDecision((0, 1, 0)), "circles")
