"""A search by legs that are computed where they are looked up finds what one by tables does."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.kernel.instance import pack
from model.problem import Points, Problem, StraightLegs, Travel
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from training.instances import generate


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
