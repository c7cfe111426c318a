"""Turns that are given up before everyone is inserted."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.route.engine import ANY, anneal
from model.search.route.layout import ProblemData
from model.search.problem_data import make_data
from model.solution import Solution
from training.instances import generate

pytestmark = pytest.mark.slow

TURNS, SEEDS = 1500, 6


def found(problem: Problem, data: ProblemData, seed: int) -> float:
    """Return what the best plan of a short search costs."""
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(seed))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / problem.num_customers
    searcher.value.cooling = 0.03 ** (1 / TURNS)
    anneal(data, searcher, TURNS, ANY)
    assert searcher.count.best_missing == 0
    return float(searcher.value.best)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("variant", ["cvrp", "vrptw", "hetero", "table1"])
def test_giving_a_turn_up_loses_nothing(variant: str) -> None:
    """It is given up once it costs too much, which it would in the end."""
    problem = generate(np.random.default_rng(8), 60, variant)
    data = make_data(problem, pack([problem], legs=False))
    assert data.strategy.give_up_early
    through = data._replace(strategy=data.strategy._replace(give_up_early=False))
    costs = np.array([[found(problem, each, seed) for seed in range(SEEDS)]
                      for each in (data, through)])
    mean, error = costs.mean(axis=1), costs.std(axis=1) / np.sqrt(SEEDS - 1)
    assert mean[0] <= mean[1] + 4 * np.hypot(*error)


def test_waiting_may_get_cheaper_by_a_customer_more() -> None:
    problem = generate(np.random.default_rng(8), 10, "vrptw")
    waited_for = replace(problem.customers[0], early_cost_per_hour=10.0)
    problem = replace(problem, customers=(waited_for, *problem.customers[1:]))
    assert not make_data(problem, pack([problem], legs=False)).strategy.give_up_early
