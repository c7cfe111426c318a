"""Trips with one drone that are annealed by small moves."""

import math
import time
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import MS_PER_HOUR, Problem, ServedBy, Travel
from model.search.improve import SearchConfig, improve
from model.search.problem_data import make_data
from model.search.strategy import ALL_MOVES
from model.solution import Solution
from training.instances import generate
from tests.model.search.stated_rules import stating

SERVED_BY: tuple[ServedBy, ...] = ("either", "either", "either", "either", "truck", "drone")

WITHOUT = replace(ALL_MOVES, small_moves=False)


def drawn(number: int, customers: int, trucks: int, **stated: object) -> Problem:
    """Return a problem of trucks with a drone each, twice as fast, paid by time and distance."""
    problem = stating(["one drone a truck", "no windows"],
                      generate(np.random.default_rng(number), customers, "cvrp"))
    duration, distance = problem.travel[0].arrays()
    demand = sum(customer.demand[0] for customer in problem.customers)
    kind = problem.vehicle_types[0]
    assert kind.drones is not None
    drones = replace(kind.drones, travel=1, **{"cost_per_km": 0.2, **stated})
    truck = replace(kind, count=trucks, capacity=(int(1.1 * demand / trucks) + 1,),
                    max_working_duration=None, cost_per_hour=50.0, drones=drones)
    return replace(
        problem, vehicle_types=(truck,),
        travel=(problem.travel[0], Travel((duration + 1) // 2, distance)),
        customers=tuple(replace(customer, served_by=SERVED_BY[index % len(SERVED_BY)])
                        for index, customer in enumerate(problem.customers)))


def paid_by_time(number: int) -> Problem:
    """Return a problem of one truck, whose working time alone costs."""
    problem = drawn(number, 50, 1, cost_per_km=0.0)
    return replace(problem, vehicle_types=(
        replace(problem.vehicle_types[0], cost_per_km=0.0),), customers=tuple(
            replace(customer, served_by="either") for customer in problem.customers))


def planned(problem: Problem, turns: int, seed: int = 0, without: bool = False) -> Solution:
    """Return the plan of a short search."""
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    config = SearchConfig(seed, 1, turns, moves=WITHOUT if without else ALL_MOVES)
    return improve(problem, pack([problem]), nothing, config).solution


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize(("trucks", "stated"), [
    (1, {}), (1, {"endurance": MS_PER_HOUR}), (1, {"cost_per_km": 0.0, "cost_per_hour": 1.0}),
    (1, {"endurance": MS_PER_HOUR // 4, "launch_duration": 60_000, "recovery_duration": 60_000}),
    (1, {"endurance": MS_PER_HOUR // 4, "endurance_includes_waiting": False}),
    (1, {"max_range": 20 * 10**6}), (3, {}), (3, {"endurance": MS_PER_HOUR // 4}),
])
def test_plans_keep_all_rules_and_cost_what_the_search_says(
        trucks: int, stated: dict[str, object]) -> None:
    for number in range(4):
        problem = drawn(number, 25, trucks, **stated)
        assert make_data(problem, pack([problem], legs=False)).strategy.small_moves
        nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
        improved = improve(problem, pack([problem]), nothing, SearchConfig(number, 1, 150))
        evaluation = check(problem, improved.solution)
        assert evaluation.is_feasible
        assert evaluation.cost.total == pytest.approx(improved.cost, rel=1e-9)


@pytest.mark.thorough
def test_trucks_and_drones_are_done_sooner_by_them() -> None:
    """By far, in as many turns."""
    costs = np.array([[check(problem, planned(problem, 120, seed, without)).cost.total
                       for without in (False, True)]
                      for problem in map(paid_by_time, range(3)) for seed in range(4)])
    assert (costs[:, 0] / costs[:, 1]).mean() < 0.985


def test_a_seed_gives_one_plan() -> None:
    problem = drawn(0, 30, 1)
    assert planned(problem, 100, 3) == planned(problem, 100, 3)


def test_a_clock_that_does_not_strike_changes_nothing() -> None:
    problem = drawn(3, 60, 2)
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    plans = {improve(problem, pack([problem]), nothing, SearchConfig(0, 1, 100), deadline).solution
             for deadline in (math.inf, time.perf_counter() + 60, time.perf_counter() + 90)}
    assert len(plans) == 1
