"""Rests that are put on a route which states none."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.judge.placing import with_due_rests
from model.judge.timing import RouteDecision, TripDecision
from model.problem import Customer, DrivingRules, Problem, VehicleType

MINUTE = 60_000
THERE_AND_BACK = RouteDecision(0, 0, (TripDecision((0, 4, 0)),))


@pytest.mark.parametrize(("rules", "rests"), [
    (DrivingRules(max_driving=10 * MINUTE, rest=MINUTE), 1),
    (DrivingRules(max_driving=5 * MINUTE, rest=MINUTE), 3),
    # Serving d takes longer than anybody may work, whoever rests before.
    (DrivingRules(max_driving=60 * MINUTE, rest=MINUTE, max_work=3 * MINUTE), 3)])
def test_drivers_rest_as_often_as_helps(tiny_problem: Callable[..., Problem], truck: VehicleType,
                                        customers: tuple[Customer, ...], rules: DrivingRules,
                                        rests: int) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, driving=rules))
    rested = with_due_rests(problem, THERE_AND_BACK)
    assert len(rested.trips[0].breaks) == rests
