"""A flag raised while compiled code runs, and what ends at it."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.kernel.alarm import Alarm, silent
from model.kernel.instance import pack
from model.problem import FULL_SPEED, Problem, SpeedProfile
from model.search.beginning.construct import begin_anew, insert_missing
from model.search.beginning.translate import make_searcher
from model.search.improve import Improved, SearchConfig, improve
from model.search.route.engine import ANY, BY_FAR, anneal
from model.search.route.state import Searcher
from model.search.world import make_world
from model.solution import Solution
from tests.conftest import soon
from tests.model.search.found import read_plan
from training.instances import generate

MOST_SECONDS = 1.0
"""On the processor, until a search of some turns has ended that is told to."""

NEVER = 10**9
"""Turns that no search makes in that time."""


def problem_of(variant: str, num_customers: int = 60) -> Problem:
    """Return a problem of a variant."""
    return generate(np.random.default_rng(5), num_customers, variant)


def begun(problem: Problem) -> tuple[Searcher, np.ndarray]:
    """Return a search that has begun, and the flag that it looks at."""
    flag = silent()
    world = make_world(problem, pack([problem]), stop=flag)
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(world, searcher, True)
    return searcher, flag


def test_rings_at_its_deadline_and_not_before() -> None:
    with Alarm(math.inf) as alarm:
        assert not alarm.has_rung
    with Alarm(time.perf_counter()) as alarm:
        assert alarm.has_rung


def test_rings_once_the_caller_wants_no_more() -> None:
    asked = threading.Event()
    wants_no_more = threading.Event()

    def should_stop() -> bool:
        asked.set()
        return wants_no_more.is_set()

    with Alarm(math.inf, should_stop) as alarm:
        soon(asked.is_set)
        assert not alarm.has_rung
        wants_no_more.set()
        soon(lambda: alarm.has_rung)


@pytest.mark.parametrize("variant", ["cvrp", "soft", "drone", "mixed", "multitrip"])
def test_turns_end_while_compiled_code_runs(variant: str) -> None:
    problem = problem_of(variant)
    world = make_world(problem, pack([problem]))
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(world, searcher, True)
    began = time.thread_time()
    with Alarm(math.inf, lambda: bool(searcher.count.turn > 0)) as alarm:
        anneal(world._replace(stop=alarm.flag), searcher, NEVER, ANY)
    assert time.thread_time() - began < MOST_SECONDS
    assert 0 < searcher.count.turn < NEVER
    assert check(problem, read_plan(world, searcher)).violations == ()


@pytest.mark.parametrize("variant", ["cvrp", "drone", "mixed"])
def test_nothing_changes_after_the_alarm(variant: str) -> None:
    problem = problem_of(variant)
    searcher, flag = begun(problem)
    world = make_world(problem, pack([problem]), stop=flag)
    anneal(world, searcher, 50, ANY)
    turns, costs = int(searcher.count.turn), searcher.value.copy()
    flag[0] = 1
    anneal(world, searcher, 50, ANY)
    assert searcher.count.turn == turns
    assert (searcher.value.cost, searcher.value.best) == (costs.cost, costs.best)


def test_an_insertion_of_all_leaves_out_whom_there_is_no_time_for() -> None:
    problem = problem_of("vrptw")
    flag = silent()
    world = make_world(problem, pack([problem]), stop=flag)
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(0))
    flag[0] = 1
    insert_missing(world, searcher, BY_FAR)
    nobody = read_plan(world, searcher)
    assert nobody.routes == ()
    assert len(nobody.unassigned) == problem.num_customers
    flag[0] = 0
    insert_missing(world, searcher, BY_FAR)
    assert read_plan(world, searcher).unassigned == ()


@pytest.mark.parametrize("has_rung", [False, True])
def test_no_other_plan_is_begun_once_there_is_no_time(has_rung: bool) -> None:
    problem = problem_of("vrptw")
    world = make_world(problem, pack([problem]))
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(0))
    flag = silent()
    flag[0] = has_rung
    begin_anew(world, searcher, True, world._replace(stop=flag))
    assert read_plan(world, searcher).unassigned == ()
    assert (searcher.count.turn == 1) == has_rung


def test_a_plan_for_few_is_begun_however_late_where_nobody_has_to_be_served() -> None:
    problem = problem_of("cvrp")
    problem = replace(problem, unassigned_cost=1e-3)
    world = make_world(problem, pack([problem]))
    searcher = make_searcher(problem, world, Solution((), ()), np.random.SeedSequence(0))
    searcher.value.best = math.inf  # as if there were a dear plan for all
    flag = silent()
    flag[0] = 1
    begin_anew(world, searcher, True, world._replace(stop=flag))
    assert searcher.count.turn > 1


def one_long_trip(num_customers: int, steps: int) -> Problem:
    """Return a problem whose every insertion times one long trip again, by a speed profile."""
    problem = problem_of("soft", num_customers)
    times = tuple(range(1000, 1000 * (steps + 1), 1000))
    factors = (FULL_SPEED, *(FULL_SPEED - 1 - 37 * (number % 1000) for number in range(steps)))
    kind = replace(problem.vehicle_types[0], count=1, capacity=(10**9,) * problem.num_dimensions,
                   speed_profile=SpeedProfile(times, factors), latest=10**11,
                   max_working_duration=None, max_trip_distance=None)
    return replace(problem, vehicle_types=(kind,))


@pytest.fixture(scope="module")
def endless() -> Problem:
    """Return a problem whose beginning takes long."""
    return one_long_trip(400, 200)


@pytest.fixture(scope="module")
def needed(endless: Problem) -> float:
    """Return the processor time in seconds that this beginning takes."""
    small = one_long_trip(20, 10)
    improve(small, pack([small], legs=False), Solution((), ()), SearchConfig(turns=1))
    found, seconds = searched(endless, Solution((), ()), SearchConfig(turns=1))
    assert found.whole
    return seconds


def searched(problem: Problem, start: Solution, config: SearchConfig, limit: float | None = None,
             should_stop: Callable[[], bool] = lambda: False) -> tuple[Improved, float]:
    """Search until some seconds are over; return what is found, and the processor time it took."""
    instance = pack([problem], legs=False)
    began = time.process_time()
    deadline = None if limit is None else time.perf_counter() + limit
    found = improve(problem, instance, start, config, deadline, should_stop)
    return found, time.process_time() - began


def test_a_beginning_ends_at_the_deadline(endless: Problem, needed: float) -> None:
    found, seconds = searched(endless, Solution((), ()), SearchConfig(), needed / 5)
    assert seconds < needed / 2
    assert not found.whole
    assert check(endless, found.solution).violations == ()


def test_a_beginning_ends_once_the_caller_wants_no_more(endless: Problem, needed: float) -> None:
    # Nobody served is what comes back where the search is stopped before it began.
    nobody = Solution((), tuple(range(endless.num_depots, endless.num_nodes)))
    found, seconds = searched(endless, nobody, SearchConfig(), 600.0, lambda: True)
    assert seconds < needed / 2
    assert not found.whole
    assert check(endless, found.solution).violations == ()
