"""Small problems of groups, planned as well as by trying all."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.quality.group_problems import best_plan, draw_group, draw_streets, what_comes
from model.judge.check import check
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from model.solution import Solution
from model.together.exact import best_by_trucks

pytestmark = pytest.mark.slow

WEIGHTS = Path(__file__).parents[3] / "model" / "weights"
SEED = 11
NUM_TRIED, NUM_PLANNED = 100, 25


@pytest.fixture(scope="module")
def planner() -> Planner:
    return load_planner(WEIGHTS, ["attention"])


def drawn(number: int) -> Problem:
    return draw_group(np.random.default_rng((SEED, number)))


def test_few_customers_are_planned_as_well_as_by_trying_all() -> None:
    groups = 0
    for number in range(NUM_TRIED):
        problem = drawn(number)
        plan, best = best_by_trucks(problem, lambda: False), best_plan(problem)
        assert plan is not None
        found = what_comes(problem, plan)
        assert found.served == best.served
        assert found.cost == pytest.approx(best.cost)
        groups += best.served > 1
    assert groups > NUM_TRIED / 4


def test_plans_of_few_customers_are_the_best(planner: Planner) -> None:
    for number in range(NUM_PLANNED):
        problem = drawn(number)
        result = planner.plan(problem, PlanOptions("attention", time_limit=60.0,
                                                   search_iterations=200))
        found, best = what_comes(problem, result.solution), best_plan(problem)
        assert (number, found.served) == (number, best.served)
        assert found.cost == pytest.approx(best.cost)


def test_streets_of_many_customers_are_served_better_than_one_by_one(planner: Planner) -> None:
    problem = draw_streets(np.random.default_rng(SEED), 40, 2)
    alone = planner.plan(problem, PlanOptions("attention", time_limit=0.0)).solution
    options = PlanOptions("attention", time_limit=600.0, search_iterations=4000)
    result = planner.plan(problem, options)
    assert not check(problem, result.solution).violations
    assert len(result.solution.unassigned) < len(alone.unassigned) / 2
    assert result.deterministic
    assert planner.plan(problem, options).solution == result.solution


def test_a_plan_given_is_never_made_worse(planner: Planner) -> None:
    problem = draw_streets(np.random.default_rng(SEED + 1), 20, 2)
    best = planner.plan(problem, PlanOptions("attention", time_limit=60.0,
                                             search_iterations=2000)).solution
    again = planner.plan(problem, PlanOptions("attention", time_limit=60.0, search_iterations=100),
                         start=best)
    assert again.final_cost <= check(problem, best).cost.total
    nobody = Solution((), tuple(range(1, problem.num_nodes)))
    assert planner.plan(problem, PlanOptions("attention", time_limit=0.0),
                        start=nobody).solution == nobody
