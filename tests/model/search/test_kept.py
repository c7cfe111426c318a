"""Insertion places that are kept for as long as their route stays the same."""

from collections.abc import Iterator

import numpy as np
import pytest

from model.engine.instance import pack
from model.engine.library import call
from model.problem import FloatArray, IntArray, Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.route.engine import ANY, BY_FAR, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import can_be_linked, make_data
from model.search.sharing import slots_of
from model.solution import Solution
from tests.model.search.found import INFEASIBLE, copied, served_by
from training.instances import generate

pytestmark = pytest.mark.slow

TURNS, ROUNDS = 40, 25


NOT_KEPT = -1


def kept_on(searcher: Searcher, slot: int, nodes: IntArray) -> tuple[IntArray, FloatArray]:
    """Return how many placements are kept of each customer on a route, and what they cost."""
    kept = [call("tandem_kept_place", searcher, node, slot) for node in nodes.tolist()]
    cost, kind = np.array(kept).reshape(-1, 2).T
    return kind.astype(np.int64), cost


def least_costs(data: ProblemData, searcher: Searcher, slot: int, nodes: IntArray) -> FloatArray:
    """Return what each of some customers more on a route costs at least, kept or not.

    All are tried on that route alone, and none is inserted, since it costs less to leave them out.
    """
    unwanted = data._replace(unassigned_cost=-INFEASIBLE)
    place, rng = searcher.active.tolist().index(slot), searcher.rng.copy()
    while True:
        trial = copied(data, searcher)
        before = served_by(trial)[place]
        trial.rng[:], trial.value.temperature = rng, searcher.value.temperature
        trial.count.active, trial.count.missing = 1, len(nodes)
        trial.active[0], trial.missing[: len(nodes)] = place, nodes
        trial.alone[:] = INFEASIBLE
        anneal(unwanted, trial, 1, BY_FAR)
        rng = trial.rng.copy()
        # Now and then, the first is inserted at any cost.
        if trial.count.missing == len(nodes):
            kind, cost = kept_on(trial, place, nodes)
            assert (kind != NOT_KEPT).all()
            assert served_by(trial) == [before]
            return cost


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
            nodes = np.flatnonzero(slots_of(searcher) != slot)
            kept, _ = kept_on(searcher, int(slot), nodes)
            yield int(slot), nodes[kept != NOT_KEPT]


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
        kind, cost = kept_on(searcher, slot, nodes)
        least, is_found = least_costs(data, searcher, slot, nodes), kind > 0
        assert cost[is_found] == pytest.approx(least[is_found])
        assert (cost <= least + 1e-9 * abs(least))[~is_found].all()
        found += is_found.sum()
        none += (~is_found).sum()
    assert min(found, none) > ROUNDS
