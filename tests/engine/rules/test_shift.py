"""Tests of what the engine takes for overtime, and for too much, against the judge's."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.engine.records import Record
from model.solution import Solution
from tests.engine.rules.asking import asked
from tests.model.tiny import draw_tiny, with_beginnings, with_duty
from tests.seeds import seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def judged(kind: Record, departure: int, end: int, stops: int) -> tuple[int, ...]:
    return asked("worked_until", 3, kind, departure, end, stops)


def sorties_allowed(kind: Record, count: int) -> bool:
    return asked("sorties_allowed", 1, kind, count) == (True,)


@pytest.mark.parametrize("seed", seeds(60))
def test_a_vehicle_works_overtime_as_the_judge_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = with_duty(rng, draw_tiny(rng, drone_share=0.0))
    if seed % 2:
        problem = with_beginnings(rng, problem)
    kind, start = problem.vehicle_types[0], int(rng.integers(0, 40)) * 60_000
    nodes = tuple(range(problem.num_depots, problem.num_nodes))
    decision = TripDecision((kind.begins_at, *nodes, kind.ends_at), start=start)
    route = schedule(problem, RouteDecision(0, 0, (decision,)))
    first, *_, last = route.trips[0].stops
    evaluation = check(problem, Solution((route,)))
    broken = {violation.code for violation in evaluation.violations}
    begun = any("begins at" in violation.message for violation in evaluation.violations
                if violation.code == "SHIFT")
    over, allowed, few = judged(pack([problem]).type[0, 0], first.departure, last.departure,
                                len(nodes))
    assert over == evaluation.routes[0].overtime
    assert few == ("MAX_STOPS" not in broken)
    if not begun:
        assert allowed == (broken.isdisjoint({"SHIFT", "WORKING_DURATION"}))


def test_without_limits_any_number_of_sorties_is_allowed() -> None:
    problem = draw_tiny(np.random.default_rng(1))
    kinds = tuple(replace(problem.vehicle_types[0], max_sorties=most) for most in (None, 2))
    rows = pack([replace(problem, vehicle_types=kinds)]).type[0]
    assert [sorties_allowed(row, 1000) for row in rows] == [True, False]
    assert [sorties_allowed(row, 2) for row in rows] == [True, True]
