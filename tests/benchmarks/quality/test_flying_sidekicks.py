"""The best order of what truck and UAVs do, worked out by hand, and energies that were recorded."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.quality.flying_sidekicks import Sidekicks, Timing, timing_of, to_problem
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.solution import Solution

pytestmark = pytest.mark.slow

# All drives take 100 s, all flights 80 s, climb and descent included.
THREE = Sidekicks("three", "101", 2, 410.0, 100.0 * (1 - np.eye(3)), 80.0 * (1 - np.eye(3)),
                  (-1.0, 100.0, 4.0))


def test_the_truck_serves_while_it_waits_for_a_uav() -> None:
    # Launched by 60; the truck serves from 160 to 190; recovered from 280 to 310.
    found = Timing(THREE, (0, 1, 0), [(0, 2, 1, 1)]).solve()
    assert (found.best, found.first) == (410.0, {1})


def test_the_truck_launches_before_it_serves() -> None:
    # Launched by 160, back from 380 on; the truck is at the depot by 290.
    found = Timing(THREE, (0, 1, 0), [(1, 2, 2, 1)]).solve()
    assert (found.best, found.first) == (410.0, frozenset())


def test_a_uav_that_would_hover_for_too_long_is_no_plan() -> None:
    drive = np.array([[0, 3000, 100], [3000, 0, 100], [100, 100, 0]], np.float64)
    found = Timing(replace(THREE, drive=drive), (0, 1, 0), [(0, 2, 1, 1)]).solve()
    assert found.best == np.inf


@pytest.mark.parametrize(("uav", "pounds", "out", "back", "endurance"), [
    ("101", 4.0, 67.074964, 28.102909, 2092.518), ("103", 4.0, 129.833997, 79.317229, 1407.298),
    ("104", 2.0, 154.552760, 189.771522, 3040.161)])
def test_energy_lasts_as_long_as_was_recorded(
        uav: str, pounds: float, out: float, back: float, endurance: float) -> None:
    fly = np.array([[0, 0, out], [0, 0, 0], [0, back, 0]])
    instance = replace(THREE, uav=uav, fly=fly, pounds=(-1.0, 100.0, pounds))
    assert out + 60 + back + instance.left(0, 2, 1) == pytest.approx(endurance, abs=1e-3)


@pytest.mark.parametrize("first", [frozenset(), frozenset({1})])
def test_a_problem_serves_before_or_behind_all_else(first: frozenset[int]) -> None:
    problem = to_problem(THREE, first)
    decision = TripDecision((0, 1, 0), (SortieDecision((2,), 1, 2),))
    route = schedule(problem, RouteDecision(0, 0, (decision,)))
    plan = Solution((route,))
    evaluation = check(problem, plan)
    assert evaluation.violations == ()
    # Behind all else is the better order.
    assert evaluation.cost.total == pytest.approx(440.0 if first else 410.0)
    assert timing_of(THREE, plan).best == 410.0
