"""What stands for plans that the judge refuses."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.judge.accepting import Completed, Judge, sound_routes
from model.judge.memory import Memory
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Customer, Problem, VehicleType
from model.solution import Solution

pytestmark = pytest.mark.plans_are_refused


@pytest.fixture
def two_trucks(tiny_problem: Callable[..., Problem], truck: VehicleType) -> Problem:
    """Three customers, and two trucks that hold two each."""
    customers = [Customer(name, (1000,)) for name in "abc"]
    return replace(tiny_problem(*customers, truck=replace(truck, count=2, capacity=(2000,)),
                                places=[0.0, 1.0, 2.0, 3.0]), unassigned_cost=1e6)


def driven(problem: Problem, *routes: tuple[int, ...]) -> Solution:
    """Return a plan whose trucks serve some customers each, as soon as may be."""
    served = [node for route in routes for node in route]
    return Solution(tuple([
        schedule(problem, RouteDecision(0, number, (TripDecision((0, *nodes, 0)),)))
        for number, nodes in enumerate(routes)]), problem.left_out(served))


def nothing_more(begun: Solution, _: Problem) -> Completed:
    return Completed(begun, True)


def test_routes_that_break_no_rule_stay(two_trucks: Problem) -> None:
    sound = sound_routes(Memory(two_trucks), driven(two_trucks, (1,), (2, 3)))
    assert sound == driven(two_trucks, (1,), (2, 3))
    broken = replace(two_trucks, vehicle_types=(
        replace(two_trucks.vehicle_types[0], capacity=(1000,)),))
    assert sound_routes(Memory(broken), driven(two_trucks, (1,), (2, 3))) == driven(broken, (1,))


def test_one_of_two_routes_that_serve_the_same_is_left(two_trucks: Problem) -> None:
    left = sound_routes(Memory(two_trucks), driven(two_trucks, (1, 2), (2, 3)))
    assert left == driven(two_trucks, (1, 2))
    twice = driven(two_trucks, (3,), (1, 1))
    assert sound_routes(Memory(two_trucks), twice) == driven(two_trucks, (3,))


def test_what_is_refused_is_counted_and_told(two_trucks: Problem,
                                             caplog: pytest.LogCaptureFixture) -> None:
    counted: list[int] = []
    judge = Judge(Memory(two_trucks), nothing_more, lambda: counted.append(1))
    fine = driven(two_trucks, (1, 2))
    assert judge.accepted(fine).solution == fine
    assert (judge.refused, counted) == (0, [])
    accepted = judge.accepted(driven(two_trucks, (1, 2, 3)))
    assert accepted.solution == driven(two_trucks)
    assert (judge.refused, counted) == (1, [1])
    assert "plan refused: routes[0].trips[0]: " in caplog.text


def test_customers_of_broken_routes_are_served_again_where_that_may_be(
        two_trucks: Problem) -> None:
    again = driven(two_trucks, (1, 2), (3,))
    judge = Judge(Memory(two_trucks), lambda begun, problem: Completed(again, True), lambda: None)
    assert judge.accepted(driven(two_trucks, (1, 2, 3))).solution == again
    assert judge.whole
    wrong = driven(two_trucks, (3,), (1, 2, 3))
    judge = Judge(Memory(two_trucks), lambda begun, problem: Completed(wrong, False), lambda: None)
    assert judge.accepted(driven(two_trucks, (1, 2, 3))).evaluation.violations == ()
    assert not judge.whole
