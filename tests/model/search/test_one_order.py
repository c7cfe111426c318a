"""One order in one window after another, in a plan without it, against the judge."""

import math
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Customer, Problem
from model.problem.altered import with_customers
from model.search.improve import SearchConfig, improve
from model.search.one_order import OrderSearch
from model.solution import Solution
from tests.seeds import seeds
from training.instances import generate

FLYING = "drone", "mixed", "particular", "various"
TURNS, LONG = 40, 10**7
VARIANTS = ("vrptw", "soft", "hetero", "multitrip", "drone", "mixed", "appointed", "various",
            "particular", "related", "resting")


def plan_without(problem: Problem, node: int) -> Solution:
    """Return a plan that leaves a customer out."""
    everybody = np.ones((len(problem.vehicle_types), problem.num_customers), np.bool_)
    serves = everybody if problem.may_serve is None else problem.may_serve.copy()
    serves[:, node - problem.num_depots] = False
    barred = replace(problem, may_serve=serves)
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    return improve(barred, pack([barred], False), nothing, SearchConfig(1, turns=300)).solution


def slots_of(customer: Customer) -> list[Customer]:
    """Return a customer in his window by anybody, and in either half of it by one means."""
    latest = min(customer.latest, customer.earliest + LONG)
    middle = (customer.earliest + latest) // 2
    return [replace(customer, earliest=opens, latest=closes, gaps=(), served_by=by,
                    late_cost_per_hour=None, early_cost_per_hour=0.0) for opens, closes, by in (
        (customer.earliest, latest, "either"), (customer.earliest, middle, "truck"),
        (middle, latest, "drone"), (middle, latest, "truck"))]


@pytest.mark.thorough_after(4)
@pytest.mark.parametrize("variant", VARIANTS)
def test_order_is_put_where_the_judge_finds_it_legal_at_that_cost(variant: str) -> None:
    served = 0
    for seed in seeds(6):
        rng = np.random.default_rng(seed)
        problem = generate(rng, 20, variant)
        problem = replace(problem, vehicle_types=tuple([
            replace(kind, count=kind.count + 2) for kind in problem.vehicle_types]))
        node = int(rng.integers(problem.num_depots, problem.num_nodes))
        slots = slots_of(problem.customer_at(node))
        # Of a window that opens at once, the search need not know that others don't.
        problem = with_customers(problem, {node: replace(slots[-1], served_by="either")})
        plan = plan_without(problem, node)
        assert node in plan.unassigned
        search = OrderSearch(problem, plan, node)
        without = check(problem, plan).cost.total - problem.cost_of_leaving_out(
            problem.customer_at(node))
        told = dict[int, tuple[float, float, Solution]]()
        for index in (0, 1, 2, 3, 2, 1, 0):
            more = search.ask(slots[index]), search.improve(TURNS)
            assert more[1] <= more[0]
            found = *more, search.plan()
            assert told.setdefault(index, found) == found
            if more[1] < math.inf:
                judged = check(with_customers(problem, {node: slots[index]}), found[2])
                assert not judged.violations
                # Where drones fly, routes are timed better once they are told.
                assert variant in FLYING or judged.cost.total - without == pytest.approx(
                    more[1], rel=1e-6, abs=1e-5)
                assert {*found[2].unassigned} <= {*plan.unassigned} - {node}
                served += 1
    assert served > 6
