"""Insertion places that are kept for as long as their route stays the same."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.route.engine import ANY, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import can_be_linked, make_data
from model.solution import Solution
from tests.model.search.found import copied, served_by
from training.instances import generate

pytestmark = pytest.mark.slow

TURNS, ROUNDS = 150, 40


def begun(problem: Problem, data: ProblemData) -> Searcher:
    """Return a search that has planned once by insertion."""
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(5))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / 2000
    return searcher


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("variant", "seed"), [
    ("soft", 3), ("soft", 4), ("multitrip", 4), ("drone", 5), ("mixed", 4)])
def test_places_kept_are_the_cheapest_where_more_than_distance_counts(variant: str,
                                                                      seed: int) -> None:
    problem = generate(np.random.default_rng(seed), 50, variant)
    # Trips more are tried by chance.
    problem = replace(problem, vehicle_types=tuple([
        replace(kind, max_trips=1) for kind in problem.vehicle_types]))
    data = make_data(problem, pack([problem]))
    # What is drawn while places are looked for is of no consequence then.
    data = data._replace(strategy=data.strategy._replace(
        blink=0.0, two_opt_star=False, resplit=False, small_moves=False))
    assert data.strategy.keep_places
    assert not can_be_linked(data)
    searcher, changed = begun(problem, data), 0
    for _ in range(ROUNDS):
        # Most turns are undone, so that places are kept of most customers on most routes.
        searcher.value.temperature = 0.0
        anneal(data, searcher, TURNS, ANY)
        anew, before = copied(data, searcher), served_by(searcher)
        anew.rng[:], anew.count.turn = searcher.rng, searcher.count.turn
        for each in (searcher, anew):
            each.value.temperature = searcher.value.cost
            anneal(data, each, 1, ANY)
        assert sorted(served_by(searcher)) == sorted(served_by(anew))
        assert searcher.value.cost == pytest.approx(float(anew.value.cost))
        changed += served_by(searcher) != before
    assert changed > ROUNDS / 2
