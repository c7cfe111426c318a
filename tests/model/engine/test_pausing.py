"""Work in parts ends where it is told to."""

import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.instance import pack
from model.engine.pausing import EndedError, pausing
from model.planner import Listener, Planner, PlanOptions
from model.problem import Problem, Travel
from model.search.improve import SearchConfig, improve
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.solution import Solution
from training.instances import generate

MOST_SECONDS = 0.1
"""Between two looks, on the processor."""

LARGE = 2000


def test_work_ends_at_its_deadline() -> None:
    pausing(lambda: False, math.inf)()
    with pytest.raises(EndedError):
        pausing(lambda: False, time.perf_counter())()


def test_work_ends_when_told() -> None:
    with pytest.raises(EndedError):
        pausing(lambda: True)()


def test_nobody_is_asked_while_there_is_patience() -> None:
    pausing(lambda: True, -math.inf, patience=3600.0)()


@pytest.fixture(scope="module")
def large() -> Problem:
    """Return many customers in two ways to travel, there and back unlike, some with windows."""
    rng = np.random.default_rng(0)
    problem = generate(rng, 20, "vrptw")
    kinds = tuple(replace(kind, drones=None) for kind in problem.vehicle_types)
    copies = tuple(replace(problem.customers[number % 20], id=str(number))
                   for number in range(LARGE))
    nodes = LARGE + problem.num_depots
    places = rng.uniform(0, 1000, (nodes, 2))
    distance = np.rint(1000 * np.abs(places[:, None] - places).sum(axis=2)).astype(np.int64)
    duration = distance + np.arange(nodes)
    np.fill_diagonal(duration, 0)
    return replace(problem, customers=copies, vehicle_types=kinds, coordinates=places,
                   travel=(Travel(duration, distance),) * 2)


class Looks:
    """Notes the longest processor time between two looks, and ends the work at one of them."""

    def __init__(self, last: float = math.inf) -> None:
        self.number, self.longest = 0, 0.0
        self._last, self._before = last, time.thread_time()

    def __call__(self) -> None:
        """Look once."""
        self.number += 1
        now = time.thread_time()
        self.longest = max(self.longest, now - self._before)
        if self.number >= self._last:
            raise EndedError
        self._before = now


def quickest(work: Callable[[Looks], object]) -> Looks:
    """Return the looks whose longest wait was shortest, of three times: others only lengthen it."""
    tries = []
    for _ in range(3):
        looks = Looks()
        work(looks)
        looks()
        tries.append(looks)
    return min(tries, key=lambda looks: looks.longest)


def test_a_large_problem_is_packed_in_parts(large: Problem) -> None:
    looks = quickest(lambda looks: pack([large], pause=looks))
    assert looks.longest < MOST_SECONDS
    with pytest.raises(EndedError):
        pack([large], pause=Looks(looks.number // 2))


@pytest.mark.thorough
def test_a_large_neighbourhood_is_made_in_parts(large: Problem) -> None:
    instance = pack([large], legs=False)
    looks = quickest(lambda looks: make_neighbourhood(large, instance, looks))
    assert looks.longest < MOST_SECONDS
    neighbourhood = make_neighbourhood(large, instance)
    assert isinstance(neighbourhood.leg, np.ndarray)
    assert isinstance(neighbourhood.back, np.ndarray)
    assert (neighbourhood.back == neighbourhood.leg.transpose(0, 2, 1, 3)).all()
    with pytest.raises(EndedError):
        make_neighbourhood(large, instance, Looks(looks.number // 2))


class Told:
    """Whether to stop: from some question on."""

    def __init__(self, after: int) -> None:
        self.asked, self._after = 0, after

    def __call__(self) -> bool:
        """Answer."""
        self.asked += 1
        return self.asked > self._after


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let callers be asked from the beginning."""
    monkeypatch.setattr("model.planner.GRACE", 0.0)
    monkeypatch.setattr("model.search.improve.GRACE", 0.0)
    monkeypatch.setattr("model.search.improve.BEGINNING", 0.0)


@pytest.mark.thorough_after(2)
@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("after", [0, 2, 60, 120])
def test_planning_ends_before_its_search_when_told(large: Problem, after: int) -> None:
    told = Told(after)
    result = Planner({"none": None}).plan(  # type: ignore[dict-item]
        large, PlanOptions("none", time_limit=0.5), listener=Listener(told))
    assert told.asked <= after + 2
    assert result.solution.routes == ()
    assert len(result.solution.unassigned) == LARGE
    assert not result.deterministic


def test_a_late_plan_is_made_where_the_one_given_serves_nobody(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("model.planner.GRACE", 0.0)
    monkeypatch.setattr("model.search.improve.BEGINNING", 60.0)
    problem = generate(np.random.default_rng(0), 20, "vrptw")
    result = Planner({"none": None}).plan(  # type: ignore[dict-item]
        problem, PlanOptions("none", time_limit=5.0), time.perf_counter() - 10,
        start=Solution((), tuple(range(1, 21))))
    assert result.solution.unassigned == ()


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("told", [lambda: False, lambda: True], ids=["too late", "told"])
def test_a_plan_given_is_kept_where_there_is_no_time(told: Callable[[], bool]) -> None:
    problem = generate(np.random.default_rng(0), 20, "vrptw")
    given = improve(problem, pack([problem]), Solution((), tuple(range(1, 21))),
                    SearchConfig(turns=20)).solution
    late = time.perf_counter() - 10
    result = Planner({"none": None}).plan(  # type: ignore[dict-item]
        problem, PlanOptions("none", time_limit=5.0), late, Listener(told), given)
    assert result.solution == given
    assert (result.start, result.search_iterations, result.deterministic) == ("given", 0, False)
    assert result.final_cost == check(problem, given).cost.total
    found = improve(problem, pack([problem]), given, SearchConfig(), late, told)
    assert (found.solution, found.turns, found.whole) == (given, 0, False)
