"""Fleets that just suffice: who fits nowhere is served, others making room."""

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.search import worker
from model.search.improve import SearchConfig, improve
from model.solution import Solution

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

CAPACITY, VEHICLES, LOADS = 100_000, 8, 8
HOURS = 0.6
"""Of the longest route that the loads were drawn on: others serve them in less."""

TURNS, PROBLEMS = 3000, 12


def tight(seed: int) -> Problem:
    """Return a problem of vehicles that may just serve all, by their loads and by their hours."""
    rng = np.random.default_rng(seed)
    places, loads, longest = [np.full(2, 50.0)], [], 0.0
    for _ in range(VEHICLES):
        clock, here = 0.0, places[0]
        for load in rng.multinomial(CAPACITY, rng.dirichlet(np.full(LOADS, 8.0))).tolist():
            there = np.clip(here + rng.normal(0, 20, 2), 0, 100)
            clock += float(np.hypot(*(there - here)))
            here = there
            places.append(there)
            loads.append(load)
        longest = max(longest, clock + float(np.hypot(*(here - places[0]))))
    coordinates = np.array(places)
    legs = np.rint(1000 * np.linalg.norm(coordinates[:, None] - coordinates, axis=2))
    travel = Travel(legs.astype(np.int64), legs.astype(np.int64))
    customers = tuple(Customer(str(node), (load,), served_by="truck")
                      for node, load in enumerate(loads, 1))
    truck = VehicleType("truck", VEHICLES, (CAPACITY * 101 // 100,), 0, cost_per_km=1.0,
                        max_working_duration=round(1000 * longest * HOURS))
    return Problem((Depot("depot"),), customers, (truck,), (travel,), coordinates, 1e6)


def num_served(problem: Problem, seed: int) -> int:
    """Return how many a plan serves."""
    found = improve(problem, pack([problem], legs=False),
                    Solution((), tuple(range(1, problem.num_nodes))),
                    SearchConfig(seed, turns=TURNS)).solution
    assert check(problem, found).violations == ()
    return len(problem.customers) - len(found.unassigned)


def test_who_fits_nowhere_is_served_if_others_may_be_left_out_for_him(
        monkeypatch: pytest.MonkeyPatch) -> None:
    problems = [tight(seed) for seed in range(PROBLEMS)]
    served = [num_served(problem, seed) for seed, problem in enumerate(problems)]
    monkeypatch.setattr(worker, "MOST_DROPPED", 0)
    without = [num_served(problem, seed) for seed, problem in enumerate(problems)]
    assert sum(served) >= sum(without) + 3
