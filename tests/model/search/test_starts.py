"""Searches that begin anew several times."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.problem import Problem
from model.search.beginning.construct import begin_anew, insert_missing
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.route.engine import ANY, BY_FAR, anneal
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best
from model.search.starts import BY_ONE_TYPE, BY_TYPES, WITH_ONE_DRONE, Starting, Starts
from model.search.problem_data import make_data
from model.solution import Solution
from training.instances import VARIANTS, generate
from tests.model.search.found import read_plan
from tests.seeds import seeds

pytestmark = pytest.mark.slow

TRUCKS = [name for name in VARIANTS
          if name not in ("drone", "table1", "mixed", "various", "particular")]


def begun(problem: Problem) -> tuple[ProblemData, Searcher]:
    """Return a search that has planned by insertion."""
    data = make_data(problem, pack([problem]))
    whole = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(3))
    begin_anew(data, whole, True)
    return data, whole


@pytest.fixture
def begins(monkeypatch: pytest.MonkeyPatch) -> list[bool]:
    """Record how searches begin."""
    calls: list[bool] = []
    begin = Starts.begin

    def record(starts: Starts, anew: bool, fewer: bool = False) -> None:
        calls.append(anew)
        begin(starts, anew, fewer)

    monkeypatch.setattr(Starts, "begin", record)
    return calls


def test_nobody_is_left_out_where_there_are_trucks_enough() -> None:
    problem = generate(np.random.default_rng(1), 100, "vrptw")
    assert problem.vehicle_types[0].count == 100
    data = make_data(problem, pack([problem]))
    for seed in seeds(60):
        whole = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(seed))
        insert_missing(data, whole, BY_FAR)
        assert whole.count.missing == 0


@pytest.mark.parametrize("variant", TRUCKS)
def test_every_search_begins_with_a_legal_plan_of_its_own(variant: str) -> None:
    problem = generate(np.random.default_rng(6), 30, variant)
    data, whole = begun(problem)
    before = read_plan(data, whole)
    starts = Starts(data, whole, np.random.SeedSequence(1).spawn(3))
    for anew in (False, True, True):
        starts.begin(anew)
        for _, room in starts.spread():
            evaluation = check(problem, read_plan(data, room))
            assert evaluation.violations == ()
            assert evaluation.cost.total <= room.value.best * (1 + 1e-9)
            if not anew:
                assert room.value.best == pytest.approx(whole.value.cost)
    assert read_plan(data, whole) == before


def test_some_begin_by_a_truck_less_where_all_are_alike() -> None:
    data, whole = begun(generate(np.random.default_rng(6), 30, "cvrp"))
    starts = Starts(data, whole, np.random.SeedSequence(1).spawn(2))
    starts.begin(True, fewer=True)
    for now, room in starts.spread():
        assert now.type["count"][0] == whole.best_used.sum() - 1
        assert room.used.sum() < whole.best_used.sum()
    starts.begin(True)
    assert all(now is data for now, _ in starts.spread())


def test_none_begins_by_a_truck_less_where_types_differ() -> None:
    data, whole = begun(generate(np.random.default_rng(6), 30, "hetero"))
    starts = Starts(data, whole, np.random.SeedSequence(1).spawn(2))
    starts.begin(True, fewer=True)
    assert all(now is data for now, _ in starts.spread())


@pytest.mark.parametrize("variant", TRUCKS)
def test_the_whole_goes_on_from_the_best_of_all(variant: str) -> None:
    problem = generate(np.random.default_rng(2), 30, variant)
    data, whole = begun(problem)
    starts = Starts(data, whole, np.random.SeedSequence(1).spawn(2))
    for anew in (False, True):
        starts.begin(anew)
        for _, room in starts.spread():
            room.value.temperature = 1e-3
            anneal(data, room, 300, ANY)
        starts.gather()
        least = min(float(room.value.best) for _, room in starts.spread())
        assert whole.value.best <= least * (1 + 1e-9)
    go_on_from_best(data, whole)
    assert whole.value.cost == pytest.approx(float(whole.value.best))
    anneal(data, whole, 300, ANY)
    evaluation = check(problem, read_plan(data, whole))
    assert evaluation.violations == ()
    assert evaluation.cost.total <= whole.value.best * (1 + 1e-9)


def with_drones(problem: Problem, count: int) -> Problem:
    """Return a problem whose trucks have so many drones each, if they have any."""
    return replace(problem, vehicle_types=tuple([
        replace(kind, drones=kind.drones and replace(kind.drones, count=count))
        for kind in problem.vehicle_types]))


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("variant", "drones", "starting"), [
    ("vrptw", 0, BY_ONE_TYPE), ("hetero", 0, BY_TYPES), ("drone", 1, WITH_ONE_DRONE),
    ("drone", 2, replace(WITH_ONE_DRONE, most=0))])
@pytest.mark.parametrize("threads", [1, 2])
def test_search_begins_anew_as_often_as_there_is_time(
    variant: str, drones: int, starting: Starting, threads: int, begins: list[bool]
) -> None:
    problem = with_drones(generate(np.random.default_rng(9), 10, variant), drones)
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    for count in (1, 2, starting.most + 6):
        begins.clear()
        turns = int((count + 0.5) * starting.turns / starting.share) * 10 * threads
        found = improve(problem, pack([problem]), nobody,
                        SearchConfig(turns=turns, threads=threads))
        assert found.turns == turns
        assert check(problem, found.solution).violations == ()
        expected = min(count, starting.most) if count > 1 else 0
        assert begins == [starting.anew and number > 0 for number in range(expected)]


def test_searches_that_begin_anew_are_repeated_exactly() -> None:
    problem = generate(np.random.default_rng(7), 20, "vrptw")
    config = SearchConfig(seed=4, threads=2, turns=12 * BY_ONE_TYPE.turns * 20)
    found, again = (improve(problem, pack([problem]), Solution((), ()), config) for _ in range(2))
    assert found.solution == again.solution
