"""How several vehicles share the work where the last end costs."""

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import MM_PER_KM, Customer, Depot, Fairness, Problem, Travel, VehicleType
from model.search import strategy
from model.search.improve import SearchConfig, improve
from model.solution import Solution

pytestmark = pytest.mark.thorough

MINUTE = 60_000


def crew(seed: int, number: int = 60) -> Problem:
    """Return customers whom four vans and two drones share, of whom the last end alone costs."""
    rng = np.random.default_rng(seed)
    place = rng.uniform(-10, 10, (number + 1, 2))
    place[0] = 0.0
    km = np.hypot(*(place[:, None] - place).transpose(2, 0, 1))
    customers = tuple(Customer(str(node), (1,)) for node in range(number))
    fleet = (VehicleType("van", 4, (number,), 0),
             VehicleType("drone", 2, (2,), 1, flies=True, max_trips=number))
    travel = tuple(Travel((km * minutes * MINUTE).astype(np.int64),
                          (km * MM_PER_KM).astype(np.int64)) for minutes in (2, 1))
    return Problem((Depot("hub"),), customers, fleet, travel, place, 1e6,
                   fairness=Fairness(makespan_cost_per_hour=60.0))


def last_end(problem: Problem, turns: int) -> float:
    """Return how many minutes a plan takes after a number of turns."""
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, problem.num_nodes))),
                    SearchConfig(1, turns=turns)).solution
    evaluation = check(problem, found)
    assert evaluation.is_feasible
    assert not found.unassigned
    assert evaluation.cost.total == pytest.approx(evaluation.makespan / MINUTE)
    return evaluation.makespan / MINUTE


def test_insertions_count_by_how_much_later_a_vehicle_ends(
        monkeypatch: pytest.MonkeyPatch) -> None:
    """So that few turns share the work out, and where neighbours alone are looked beside, too."""
    problems = [crew(seed) for seed in range(6)]
    in_long = np.mean([last_end(problem, 3000) for problem in problems])
    assert np.mean([last_end(problem, 1000) for problem in problems]) < 1.02 * in_long
    monkeypatch.setattr(strategy, "SCAN_ALL_BELOW", 0)
    assert np.mean([last_end(problem, 1000) for problem in problems]) < 1.02 * in_long
