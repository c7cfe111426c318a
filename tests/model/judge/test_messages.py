"""What the judge says names what the request names, never a node's number."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    MAX_QUANTITY, UNREACHABLE, Customer, Problem, Travel, VehicleType,
)
from model.solution import Solution


def messages(problem: Problem, nodes: tuple[int, ...], kind: int = 0) -> list[str]:
    """Return what the judge says of a plan of one trip, customers left out aside."""
    route = schedule(problem, RouteDecision(kind, 0, (TripDecision(nodes),)))
    plan = Solution((route,), problem.left_out(set(nodes)))
    return [violation.message for violation in check(problem, plan).violations]


@pytest.mark.parametrize(("length", "what"), [(MAX_QUANTITY, "way"), (UNREACHABLE, "flight")])
def test_a_leg_that_is_missing_is_told_by_its_places(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...], truck: VehicleType,
        length: int, what: str) -> None:
    problem = tiny_problem(*customers[:2], truck=replace(truck, flies=what == "flight"))
    legs = problem.travel[0].duration[:].copy()
    legs[1, 2] = length
    gone = replace(problem, travel=(Travel(legs, problem.travel[0].distance), *problem.travel[1:]))
    one, other = (customer.id for customer in customers[:2])
    assert f"no {what} from {one} to {other}" in messages(gone, (0, 1, 2, 0))


def test_a_depot_where_a_trip_may_not_end_is_told_by_name(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType) -> None:
    problem = tiny_problem(customers[0], truck=truck, more_types=(replace(truck, depot=1),),
                           places=(0, 2, 1), num_depots=2)
    assert messages(problem, (1, 2, 0), 1) == ["truck ends the trip at depot-1, not depot-0"]
