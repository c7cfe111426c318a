"""Routes of shipments are changed within rules, and cost what the judge says."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Problem, Travel
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import best_plan, make_searcher
from model.search.problem_data import make_data
from model.search.route.engine import ANY, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Solution
from tests.model.search.found import copied
from tests.model.search.test_fewer_vehicles import planted

FULL = 3, 2, 1, 1
"""What a truck holds, by dimension."""


def various(seed: int) -> Problem:
    """Return a problem with loads of several dimensions, legs of two ways and prices that differ.

    Every other one lets a vehicle cost nothing, and some customers may be left out.
    """
    problem, rng = planted(seed, 4, True), np.random.default_rng(seed)
    legs = np.array(problem.travel[0].distance)
    durations = legs + rng.integers(0, 3000, legs.shape)
    np.fill_diagonal(durations, 0)
    shipments = tuple(
        replace(shipment, amount=tuple(rng.integers(0, 2, len(FULL)).tolist()))
        for shipment in problem.shipments)
    customers = tuple(
        replace(customer, demand=(0,) * len(FULL), latest=customer.latest + 60_000,
                unassigned_cost=0.0 if node % 2 else float(rng.integers(5, 60)))
        if seed % 2 else replace(customer, demand=(0,) * len(FULL),
                                 latest=customer.latest + 60_000)
        for node, customer in enumerate(problem.customers))
    truck = replace(problem.vehicle_types[0], capacity=FULL, cost_per_stop=0.25,
                    fixed_cost=0.0 if seed % 2 else 20.0)
    return replace(problem, customers=customers, shipments=shipments, vehicle_types=(truck,),
                   amount_decimals=(3,) * len(FULL),
                   travel=(Travel(durations, legs + rng.integers(0, 2000, legs.shape)),))


def begun(problem: Problem) -> tuple[ProblemData, Searcher]:
    """Return a search for a problem, with a plan by insertion."""
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, searcher, False)
    return data, searcher


@pytest.mark.thorough_after(4)
@pytest.mark.parametrize("scan_all", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_plans_keep_rules_and_cost_what_they_are_said_to(seed: int, scan_all: bool) -> None:
    problem = various(seed)
    data, searcher = begun(problem)
    data = data._replace(strategy=data.strategy._replace(scan_all=scan_all))
    first = float(searcher.value.best)
    for temperature in (5.0, 1.0, 0.01):
        searcher.value.temperature, searcher.value.longest = temperature, 10.0
        searcher.value.cooling = 1.0
        anneal(data, searcher, 150, ANY)
        assert len(searcher.active[:searcher.count.active]) == searcher.used[0]
        for routes in (searcher, copied(data, searcher)):
            plan = check(problem, best_plan(data, routes, range(data.num_nodes)))
            assert plan.violations == ()
            assert plan.cost.total == pytest.approx(float(routes.value.best))
    assert float(searcher.value.best) < first
