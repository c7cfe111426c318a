"""Where drones fly, a customer goes where that costs least: no place seems dearer than it is."""

from dataclasses import replace

import numpy as np
import pytest

from model.counsel.bench import Bench
from model.engine.instance import pack
from model.judge.metrics import unassigned_cost
from model.problem import Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.priced_places import PlacePrices
from model.search.problem_data import make_data
from model.solution import Solution
from training.instances import generate

CUSTOMERS = 25


def flown_problem(seed: int) -> Problem:
    """Return a problem of trucks with one drone or two each, whose hours cost."""
    problem = generate(np.random.default_rng(seed), CUSTOMERS, "drone")
    return replace(problem, vehicle_types=tuple(replace(
        kind, cost_per_hour=kind.cost_per_hour or 20.0,
        drones=kind.drones and replace(kind.drones, count=1 + seed % 2))
        for kind in problem.vehicle_types))


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("seed", [*range(8), 27, 133])
def test_a_customer_goes_where_that_costs_least(seed: int) -> None:
    problem = flown_problem(seed)
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    plan = improve(problem, pack([problem]), nobody, SearchConfig(seed, turns=30)).solution
    data = make_data(problem, pack([problem]))
    data = data._replace(strategy=data.strategy._replace(blink=0.0))
    assert not plan.unassigned
    for node in nobody.unassigned:
        rest = Bench(problem, plan, node).left_out.solution
        places = PlacePrices(problem, rest).all_places(node)
        if not places:
            continue
        least = min(place.cost for _, place in places)
        if least < 0:
            continue  # others wait less for him, which nothing that is quickly found tells
        searcher = make_searcher(problem, data, rest, np.random.SeedSequence(seed))
        most = float(searcher.value.cost) + least - unassigned_cost(problem, [node])
        begin_anew(data, searcher, False)
        assert searcher.value.cost <= most * (1 + 1e-9) + 1e-9
