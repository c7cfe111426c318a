"""What a search keeps up to date from turn to turn is what it would find by looking at all."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Problem
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.route.engine import ANY, BY_FAR, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.search.sharing import slots_of
from model.solution import Solution
from tests.model.search.found import at_best, served_by
from training.instances import generate

pytestmark = pytest.mark.slow

ROUNDS, TURNS = 12, 25
SOME = 420
"""Customers, so that insertions are tried beside neighbours only."""

FEW = 60
"""Customers who are sorted in the simplest way."""


def begun(variant: str, size: int) -> tuple[Problem, ProblemData, Searcher]:
    """Return a problem, and a search that has planned it by insertion."""
    problem = generate(np.random.default_rng(17), size, variant)
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    begin_anew(data, searcher, True)
    searcher.value.temperature = searcher.value.cost / problem.num_customers
    return problem, data, searcher


@pytest.mark.parametrize(("variant", "size", "stay"), [
    ("cvrp", SOME, 20), ("vrptw", 60, 0), ("multitrip", 60, 7), ("drone", 60, 7)])
def test_routes_in_use_and_the_best_are_known(variant: str, size: int, stay: int) -> None:
    _, data, searcher = begun(variant, size)
    searcher.count.stay = stay
    slots = np.arange(len(searcher.active))
    for _ in range(ROUNDS):
        anneal(data, searcher, TURNS, ANY)
        used = np.unique(slots_of(searcher)[data.num_depots:])
        count = int(searcher.count.active)
        assert sorted(searcher.active[:count]) == used[used >= 0].tolist()
        assert sorted(searcher.active) == list(slots)
        best = float(at_best(data, searcher).value.cost)
        assert best == pytest.approx(float(searcher.value.best))
        now = searcher.cost[searcher.active[:count]].sum()
        now += float(searcher.count.missing) * data.unassigned_cost
        assert now == pytest.approx(float(searcher.value.cost))


@pytest.mark.parametrize("most_stops", [None, 4])
def test_there_is_room_for_the_stops_that_a_vehicle_may_have(most_stops: int | None) -> None:
    problem = generate(np.random.default_rng(17), SOME, "cvrp")
    (kind,) = problem.vehicle_types
    nothing = (0,) * problem.num_dimensions
    given = replace(problem, vehicle_types=(replace(kind, count=SOME, max_stops=most_stops),))
    taken = replace(given, customers=tuple(
        [replace(each, demand=nothing, pickup=each.demand) for each in given.customers]))
    lightest = np.sort([each.demand[0] for each in given.customers]).cumsum()
    most = int((lightest <= kind.capacity[0]).sum()) if most_stops is None else most_stops
    for one in (given, taken):
        data = make_data(one, pack([one]))
        searcher = make_searcher(one, data, Solution((), ()), np.random.SeedSequence(3))
        assert most + 2 <= searcher.room.stops <= most + 10
        begin_anew(data, searcher, True)
        anneal(data, searcher, TURNS, ANY)
        assert max(map(len, served_by(searcher))) <= most


def test_there_is_room_for_what_drones_and_trucks_try() -> None:
    problem = generate(np.random.default_rng(17), 60, "drone")
    kinds = [replace(kind, max_stops=2, max_sorties=1) for kind in problem.vehicle_types]
    few = replace(problem, vehicle_types=tuple(kinds))
    for one in (problem, few):
        searcher = make_searcher(one, make_data(one, pack([one])), Solution((), ()),
                                 np.random.SeedSequence(3))
        largest = max(kind.capacity[0] * kind.max_trips for kind in kinds)
        lightest = np.sort([each.demand[0] for each in one.customers]).cumsum()
        most = int((lightest <= largest).sum())
        assert most > 3
        assert searcher.room.stops >= most + 2
        assert searcher.room.sorties >= most


def test_a_search_that_stays_near_by_gets_everywhere() -> None:
    problem, data, searcher = begun("cvrp", SOME)
    searcher.count.stay = 5
    seen = set()
    for _ in range(40):
        anneal(data, searcher, 5, ANY)
        seen.add(int(searcher.count.focus))
    assert len(seen) > 20
    assert all(problem.num_depots <= node < problem.num_nodes for node in seen)


def test_many_customers_are_sorted_as_few_are() -> None:
    problem = generate(np.random.default_rng(17), SOME, "cvrp")
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    data.type["count"] = 0
    assert isinstance(data.leg, np.ndarray)
    distance = data.leg[0, 0, :, 1]
    for count in (FEW, SOME):
        nodes = np.random.default_rng(2).permutation(SOME)[:count] + 1
        searcher.missing[:count] = nodes
        searcher.count.missing = count
        anneal(data, searcher, 1, BY_FAR)
        # Nobody drives, so that those to be inserted stay as they were sorted.
        left_out = searcher.missing[: searcher.count.missing]
        assert (np.diff(distance[left_out]) <= 0).all()
        assert set(left_out.tolist()) == set(nodes.tolist())
