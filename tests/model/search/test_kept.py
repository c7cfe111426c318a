"""Insertion places that are kept for as long as their route stays the same."""

from collections.abc import Iterator
from copy import deepcopy

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import FloatArray, IntArray, Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.route.engine import ANY, BY_FAR, INFEASIBLE, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import can_be_linked, make_data
from model.solution import Solution
from training.instances import generate

pytestmark = pytest.mark.slow

TURNS, ROUNDS = 40, 25


def least_costs(data: ProblemData, searcher: Searcher, slot: int, nodes: IntArray) -> FloatArray:
    """Return what each of some customers more on a route costs at least, kept or not.

    All are tried on that route alone, and none is inserted, since it costs less to leave them out.
    """
    unwanted = data._replace(unassigned_cost=-INFEASIBLE)
    stamp, rng = searcher.now.route[slot].stamp, searcher.rng.copy()
    while True:
        trial = deepcopy(searcher)._replace(rng=rng)
        trial.count.active, trial.count.missing = 1, len(nodes)
        trial.active[0], trial.missing[: len(nodes)] = slot, nodes
        trial.kept_stamp[:], trial.alone[:] = stamp - 1, INFEASIBLE
        anneal(unwanted, trial, 1, BY_FAR)
        # Now and then, the first is inserted at any cost.
        if trial.count.missing == len(nodes):
            assert (trial.kept_stamp[nodes, slot] == stamp).all()
            return trial.kept_cost[nodes, slot]


def begun(problem: Problem, data: ProblemData) -> Searcher:
    """Return a search that has planned once by insertion."""
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(5))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / 2000
    return searcher


def kept_places(data: ProblemData, searcher: Searcher) -> Iterator[tuple[int, IntArray]]:
    """Search in rounds; yield each route and for whom a place on it is kept after each round."""
    for _ in range(ROUNDS):
        anneal(data, searcher, TURNS, ANY)
        for slot in searcher.active[: searcher.count.active]:
            stamp = searcher.now.route[slot].stamp
            assert stamp != 0  # that of a route which changes
            nodes = np.flatnonzero(searcher.kept_stamp[:, slot] == stamp)
            yield int(slot), nodes[searcher.now.where[nodes]["slot"] != slot]


@pytest.mark.parametrize(("variant", "seed"), [
    ("soft", 3), ("soft", 4), ("multitrip", 4), ("drone", 3), ("mixed", 4)])
def test_places_kept_are_the_cheapest_where_more_than_distance_counts(variant: str,
                                                                      seed: int) -> None:
    problem = generate(np.random.default_rng(seed), 50, variant)
    data = make_data(problem, pack([problem]))
    assert not can_be_linked(data)
    searcher = begun(problem, data)
    found = none = 0
    for slot, nodes in kept_places(data, searcher):
        cost = searcher.kept_cost[nodes, slot]
        least = least_costs(data, searcher, slot, nodes)
        is_found = searcher.kept_move[nodes, slot]["kind"] >= 0
        assert cost[is_found] == pytest.approx(least[is_found])
        assert (cost <= least + 1e-9 * abs(least))[~is_found].all()
        found += is_found.sum()
        none += (~is_found).sum()
    assert min(found, none) > ROUNDS
