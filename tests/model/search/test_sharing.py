"""Threads that share routes by regions plan legally, and the same every time."""

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.engine.library import call
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.sharing import shared_out
from model.search.sharing import DIVIDED_FROM, regions, slots_of
from model.search.problem_data import make_data
from model.solution import Solution
from tests.model.fliers import from_hubs
from training.instances import generate
from tests.seeds import seeds


@pytest.mark.parametrize(("variant", "threads"), [
    ("vrptw", 2), ("hetero", 3), ("drone", 2), ("multitrip", 4)])
def test_regions_are_searched_side_by_side(variant: str, threads: int) -> None:
    problem = generate(np.random.default_rng(3), DIVIDED_FROM + 10, variant)
    config = SearchConfig(seed=5, threads=threads, turns=40 * threads)
    found, again = (improve(problem, pack([problem]), Solution((), ()), config) for _ in range(2))
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    assert evaluation.cost.total <= found.cost * (1 + 1e-9)
    assert found.cost < found.first_cost
    assert found.solution == again.solution


def test_regions_share_what_hubs_have() -> None:
    problem = from_hubs(np.random.default_rng(1), DIVIDED_FROM + 10, batteries=90)
    config = SearchConfig(seed=5, threads=2, turns=80)
    found = improve(problem, pack([problem]), Solution((), ()), config)
    assert check(problem, found.solution).violations == ()
    data = make_data(problem, pack([problem]))
    whole = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, whole, False)
    owner = np.arange(len(whole.active)) % 3
    taken = np.zeros((len(owner), len(data.hub)), np.int64)
    call("tandem_write_taken", data, whole, taken)
    parts = [part.hub["batteries"] for part in shared_out(data, whole, owner, 3)]
    assert np.sum(parts, axis=0).tolist() == [90]
    for number, part in enumerate(parts):
        assert part[0] >= taken[owner == number, 0].sum()
    assert taken[:, 0].sum() > 0


@pytest.mark.parametrize("threads", [2, 5])
def test_regions_have_about_as_many_customers(threads: int) -> None:
    problem = generate(np.random.default_rng(0), 300, "cvrp")
    data = make_data(problem, pack([problem]))
    whole = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, whole, False)
    slot = slots_of(whole)[1:]
    slot = slot[slot >= 0]
    longest = np.bincount(slot).max()
    for seed in seeds(20):
        owner = regions(problem.coordinates, whole, threads, np.random.default_rng(seed))
        shares = np.bincount(owner[slot], minlength=threads)
        assert abs(shares - len(slot) / threads).max() <= longest
