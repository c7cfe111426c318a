"""Plans in other numbers."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.search.improve import SearchConfig, improve
from model.solution import Solution, renumbered
from training.instances import generate


@pytest.fixture(scope="module")
def plan() -> Solution:
    """A plan with drones for customers 1 to 30, of whom some are left out."""
    problem = generate(np.random.default_rng(5), 30, "drone")
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, problem.num_nodes))),
                    SearchConfig(turns=50))
    assert any(trip.sorties for route in found.solution.routes for trip in route.trips)
    return replace(found.solution, unassigned=(1, 3))


def test_plan_in_other_numbers_and_back_is_the_same_plan(plan: Solution) -> None:
    number = np.random.default_rng(1).permutation(31)
    other = renumbered(plan, number.tolist().__getitem__)
    assert other != plan
    assert other.unassigned == tuple(sorted((int(number[1]), int(number[3]))))
    assert renumbered(other, np.argsort(number).tolist().__getitem__) == plan


def test_vehicles_get_other_numbers_if_asked_for(plan: Solution) -> None:
    other = renumbered(plan, int, lambda kind, vehicle: (kind + 2, vehicle + 5))
    for before, now in zip(plan.routes, other.routes, strict=True):
        assert now.driven_by == (before.vehicle_type + 2, before.vehicle + 5)
        assert now.trips == before.trips


def test_a_place_without_a_number_is_refused(plan: Solution) -> None:
    with pytest.raises(KeyError):
        renumbered(plan, {}.__getitem__)
