"""A search by legs that are computed where they are looked up finds what one by tables does, and
one by tables of 64 bits what one by tables of 32 does."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.engine.variants import are_stated, ways_of
from model.problem import Points, Problem, StraightLegs, Travel
from model.problem.quantities import LONGEST_NARROW
from model.search.neighbourhood import neighbourhood
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.model.search.mixed_rules import all_rules, all_rules_open, all_rules_setups
from training.instances import generate

pytestmark = pytest.mark.slow


def twins(variant: str, size: int, points: Points) -> tuple[Problem, Problem]:
    """Return a problem whose legs are computed, and the same with tables of them."""
    problem = generate(np.random.default_rng(11), size, variant)
    speeds = 40.0 + 20.0 * np.arange(len(problem.travel))
    computed = replace(problem, travel=tuple(
        [Travel.along(StraightLegs(points, speed)) for speed in speeds.tolist()]))
    return computed, replace(computed, travel=tuple(
        [Travel(*travel.arrays()) for travel in computed.travel]))


def plan_of(problem: Problem) -> Solution:
    found = improve(problem, pack([problem], legs=False), Solution((), ()), SearchConfig(turns=300))
    assert check(problem, found.solution).violations == ()
    return found.solution


@pytest.mark.thorough_after(5)
@pytest.mark.parametrize("variant", [
    "cvrp", "vrptw", "multitrip", "drone", "pickups", "various", "particular"])
@pytest.mark.parametrize("on_globe", [False, True])
def test_plans_are_the_same_as_by_tables(variant: str, on_globe: bool) -> None:
    rng = np.random.default_rng(5)
    count = generate(np.random.default_rng(11), 40, variant).num_nodes
    points = (Points.geographic(np.array([8.5, 47.4]) + rng.normal(0, 0.05, (count, 2)))
              if on_globe else Points(rng.uniform(0, 9_000, (count, 2))))
    computed, stated = twins(variant, 40, points)
    assert plan_of(computed) == plan_of(stated)


def by_64_bits(problem: Problem, monkeypatch: pytest.MonkeyPatch) -> Solution:
    """Return a plan as if some leg of the problem didn't fit 32 bits."""
    with monkeypatch.context() as patched:
        patched.setattr(neighbourhood, "are_stated", lambda *_: False)
        return plan_of(problem)


@pytest.mark.parametrize("variant", ["vrptw", "multitrip", "drone", "particular"])
def test_plans_are_the_same_by_tables_of_64_bits(variant: str,
                                                 monkeypatch: pytest.MonkeyPatch) -> None:
    problem = generate(np.random.default_rng(11), 40, variant)
    assert are_stated(problem, ways_of(problem))
    assert plan_of(problem) == by_64_bits(problem, monkeypatch)


def test_a_leg_that_does_not_fit_is_planned_with() -> None:
    problem = generate(np.random.default_rng(11), 40, "vrptw")
    legs = np.zeros((problem.num_nodes, problem.num_nodes), np.int64)
    legs[0, -1] = LONGEST_NARROW + 1
    # Nobody drives there.
    wide = replace(problem, travel=(*problem.travel, Travel(legs, legs)))
    assert not are_stated(wide, ways_of(wide))
    assert plan_of(problem) == plan_of(wide)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("rules", [all_rules, all_rules_open, all_rules_setups])
def test_flights_that_there_are_not_are_not_flown_by_either(
        rules: Callable[[np.random.Generator], Problem],
        monkeypatch: pytest.MonkeyPatch) -> None:
    rng, closed = np.random.default_rng(3), 0
    for _ in range(20):
        problem = rules(rng)
        closed += not all(travel.reaches_all() for travel in problem.travel)
        assert plan_of(problem) == by_64_bits(problem, monkeypatch)
    assert closed > 3
