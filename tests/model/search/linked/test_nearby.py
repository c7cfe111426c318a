"""Among linked stops, customers of many are tried beside all neighbours."""

import numpy as np

from model.engine.instance import pack
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.linked.engine import insert_linked, tie, write_back
from model.search.linked.layout import Linked
from model.search.problem_data import are_timed, make_data
from model.search.route.engine import BY_FAR, INFEASIBLE, missing_cost
from model.search.route.layout import NOWHERE
from model.search.route.state import Searcher
from model.solution import Solution
from tests.model.search.found import beside_neighbours
from training.instances import generate

MANY = 2000
"""Customers from which on not all places are looked at, however early in a search."""

TRIED = 60


def take_out(searcher: Searcher, node: int) -> None:
    """Leave a customer out whom a truck serves among others. In place."""
    now = searcher.now
    slot, p, _ = now.where[node].tolist()
    length = int(now.route[slot].length)
    now.stop[slot, p:length - 1] = now.stop[slot, p + 1:length].copy()
    now.route[slot].length -= 1
    now.where[node]["slot"] = NOWHERE
    searcher.missing[0], searcher.count.missing = node, 1


def test_no_cheaper_place_beside_a_neighbour_is_passed_over() -> None:
    problem = generate(np.random.default_rng(17), MANY, "cvrp")
    data = make_data(problem, pack([problem]))
    data = data._replace(strategy=data.strategy._replace(blink=0.0))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    linked = Linked(data, searcher, are_timed(data))
    begin_anew(data, searcher, False, linked=linked)
    assert searcher.count.missing == 0
    searcher.alone[:] = INFEASIBLE
    found = 0
    for node in np.random.default_rng(4).choice(MANY, TRIED, replace=False) + 1:
        slot = searcher.now.where[node]["slot"]
        if searcher.now.route[slot].length <= 3:
            continue
        take_out(searcher, int(node))
        tie(data, searcher, linked)
        write_back(data, searcher, linked)
        cost = searcher.value.cost - missing_cost(data, searcher)
        least = beside_neighbours(data, searcher, int(node))
        insert_linked(data, searcher, linked, BY_FAR)
        assert searcher.count.missing == 0
        assert searcher.value.cost - cost <= least + 1e-6
        found += least < np.inf
    assert found > TRIED / 2
