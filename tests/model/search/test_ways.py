"""Ways that cost more at first where the last end does."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import MM_PER_KM, Customer, Depot, Fairness, Problem, Travel, VehicleType
from model.search import improve as search
from model.search.improve import SearchConfig, improve
from model.search.ways import come_ways_first, with_dear_ways
from model.solution import Solution

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


def test_last_end_comes_sooner_where_ways_cost_more_at_first(
        monkeypatch: pytest.MonkeyPatch) -> None:
    """And ways cost nothing in what is told."""
    problems = [crew(seed) for seed in range(6)]
    first = np.mean([last_end(problem, 3000) for problem in problems])
    monkeypatch.setattr(search, "come_ways_first", lambda _: False)
    # Seven tenths as many turns came before.
    assert first < 0.97 * np.mean([last_end(problem, 5100) for problem in problems])


def test_dearer_ways_stay_as_they_are() -> None:
    problem = crew(0)
    van, drone = problem.vehicle_types
    dear = replace(problem, vehicle_types=(replace(van, cost_per_km=100.0), drone))
    kept, raised = with_dear_ways(dear).vehicle_types
    assert kept.cost_per_km == 100.0
    # A tenth of a minute's unit for each of six vehicles, and a minute a kilometre.
    assert raised.cost_per_km == pytest.approx(0.1 / 6, rel=1e-4)


def test_ways_come_first_where_several_vehicles_may_end_last() -> None:
    problem = crew(0)
    alone = replace(problem, vehicle_types=(replace(problem.vehicle_types[0], count=1),))
    assert come_ways_first(problem)
    assert not come_ways_first(alone)
    assert not come_ways_first(replace(problem, fairness=Fairness()))
