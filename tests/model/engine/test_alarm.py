"""Alarms that ring while the engine runs, and what ends at them."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from model.engine.library import call
from model.judge.check import check
from model.engine.alarm import CANCELLED, Alarm
from model.engine.instance import pack
from model.engine.pausing import EndedError
from model.problem import FULL_SPEED, IntArray, Problem, SpeedProfile
from model.search.beginning.construct import begin_anew, insert_missing
from model.search.beginning.translate import make_searcher
from model.search.first_plan import first_plan
from model.search.improve import Improved, SearchConfig, improve
from model.search.route.engine import ANY, BY_FAR, anneal
from model.search.route.state import Searcher
from model.search.problem_data import make_data
from model.solution import Solution
from tests.conftest import soon
from tests.model.search.found import read_plan
from training.instances import generate

MOST_SECONDS = 1.0
"""On the processor, until a search of some turns has ended that is told to."""

MOST_LATE = 0.02
"""Seconds after which whatever the engine does has ended that is told to."""

TRIES = 50
"""Of which one has to end so soon, since other processes take their time as well."""

VARIANTS = ("cvrp", "soft", "drone", "mixed", "multitrip")

NEVER = 10**9
"""Turns that no search makes in that time."""


def problem_of(variant: str, num_customers: int = 60) -> Problem:
    """Return a problem of a variant."""
    return generate(np.random.default_rng(5), num_customers, variant)


def begun(problem: Problem) -> tuple[Searcher, np.ndarray]:
    """Return a search that has begun, and the setting of the alarm that ends it."""
    setting = Alarm().setting
    data = make_data(problem, pack([problem]), deadline=setting)
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, searcher, True)
    return searcher, setting


def ends_soon(late: Callable[[], float]) -> bool:
    """Tell whether what returns how late it ended ends soon, if the machine lets it."""
    return any(0.0 <= late() < MOST_LATE for _ in range(TRIES))


def late_after_cancelling(setting: IntArray, wait: float, work: Callable[[], object]) -> float:
    """Return how many seconds after another thread cancels it work ends.

    Below zero where it had ended by itself, since that thread got no turn.
    """
    setting[CANCELLED] = 0
    cancelled: list[float] = []

    def cancel() -> None:
        cancelled.append(time.perf_counter())
        setting[CANCELLED] = 1

    timer = threading.Timer(wait, cancel)
    timer.start()
    work()
    ended = time.perf_counter()
    timer.join()
    return ended - cancelled[0]


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


def test_another_alarm_rings_sooner_and_never_later() -> None:
    with Alarm(math.inf).sooner(time.perf_counter()) as alarm:
        assert alarm.has_rung
    with Alarm(time.perf_counter()).sooner(math.inf) as alarm:
        assert alarm.has_rung
    with Alarm(math.inf, lambda: True).sooner(math.inf) as alarm:
        assert alarm.has_rung


def test_no_thread_asks_where_nobody_answers() -> None:
    # Of services that other tests left, threads may end meanwhile.
    before = set(threading.enumerate())
    with Alarm(time.perf_counter() + 60.0):
        assert set(threading.enumerate()) <= before
    with Alarm(math.inf, lambda: False):
        assert len(set(threading.enumerate()) - before) == 1
    assert set(threading.enumerate()) <= before


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_engine_ends_turns_by_its_own_clock(variant: str) -> None:
    problem = problem_of(variant)
    searcher, _ = begun(problem)

    def late() -> float:
        deadline = time.perf_counter() + 0.02
        data = make_data(problem, pack([problem]), deadline=Alarm(deadline).setting)
        anneal(data, searcher, NEVER, ANY)
        seconds = time.perf_counter() - deadline
        assert seconds >= 0.0
        return seconds

    assert ends_soon(late)


@pytest.mark.parametrize("variant", VARIANTS)
def test_turns_end_soon_after_another_thread_cancels(variant: str) -> None:
    problem = problem_of(variant)
    searcher, setting = begun(problem)
    data = make_data(problem, pack([problem]), deadline=setting)
    assert ends_soon(partial(late_after_cancelling, setting, 0.02,
                             lambda: anneal(data, searcher, NEVER, ANY)))


def test_an_insertion_into_a_long_trip_ends_soon_after_another_thread_cancels(
        endless: Problem) -> None:
    setting = Alarm().setting
    data = make_data(endless, pack([endless], legs=False), deadline=setting)
    searcher = make_searcher(endless, data, Solution((), ()), np.random.SeedSequence(0))

    def insert() -> None:
        call("tandem_disband", data, searcher)
        insert_missing(data, searcher, BY_FAR)

    # Quick machines have inserted all after a tenth of a second.
    assert ends_soon(partial(late_after_cancelling, setting, 0.04, insert))
    assert searcher.count.missing > 0


def test_a_first_plan_is_given_up_if_nobody_wants_it_and_made_however_late() -> None:
    problem = problem_of("cvrp", 2500)
    instance = pack([problem], legs=False)
    late = make_data(problem, instance, deadline=Alarm(0.0).setting)
    assert len(first_plan(problem, late).routes) > 0
    late.deadline[CANCELLED] = 1
    with pytest.raises(EndedError):
        first_plan(problem, late)


@pytest.mark.parametrize("variant", VARIANTS)
def test_turns_end_while_the_engine_runs(variant: str) -> None:
    problem = problem_of(variant)
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    begin_anew(data, searcher, True)
    began = time.thread_time()
    with Alarm(math.inf, lambda: bool(searcher.count.turn > 0)) as alarm:
        anneal(data._replace(deadline=alarm.setting), searcher, NEVER, ANY)
    assert time.thread_time() - began < MOST_SECONDS
    assert 0 < searcher.count.turn < NEVER
    assert check(problem, read_plan(data, searcher)).violations == ()


@pytest.mark.parametrize("variant", ["cvrp", "drone", "mixed"])
def test_nothing_changes_after_the_alarm(variant: str) -> None:
    problem = problem_of(variant)
    searcher, setting = begun(problem)
    data = make_data(problem, pack([problem]), deadline=setting)
    anneal(data, searcher, 50, ANY)
    turns, costs = int(searcher.count.turn), searcher.value.copy()
    setting[CANCELLED] = 1
    anneal(data, searcher, 50, ANY)
    assert searcher.count.turn == turns
    assert (searcher.value.cost, searcher.value.best) == (costs.cost, costs.best)


def test_an_insertion_of_all_leaves_out_whom_there_is_no_time_for() -> None:
    problem = problem_of("vrptw")
    setting = Alarm().setting
    data = make_data(problem, pack([problem]), deadline=setting)
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    setting[CANCELLED] = 1
    insert_missing(data, searcher, BY_FAR)
    nobody = read_plan(data, searcher)
    assert nobody.routes == ()
    assert len(nobody.unassigned) == problem.num_customers
    setting[CANCELLED] = 0
    insert_missing(data, searcher, BY_FAR)
    assert read_plan(data, searcher).unassigned == ()


@pytest.mark.parametrize("rings", [False, True])
def test_no_other_plan_is_begun_once_there_is_no_time(rings: bool) -> None:
    problem = problem_of("vrptw")
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    alarm = Alarm(0.0 if rings else math.inf)
    begin_anew(data, searcher, True, data._replace(deadline=alarm.setting))
    assert read_plan(data, searcher).unassigned == ()
    assert (searcher.count.turn == 1) == rings


def test_a_plan_for_few_is_begun_however_late_where_nobody_has_to_be_served() -> None:
    problem = problem_of("cvrp")
    problem = replace(problem, unassigned_cost=1e-3)
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, Solution((), ()), np.random.SeedSequence(0))
    searcher.value.best = math.inf  # as if there were a dear plan for all
    begin_anew(data, searcher, True, data._replace(deadline=Alarm(0.0).setting))
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


def nobody(problem: Problem) -> Solution:
    """Return what comes back where a search is stopped before it began."""
    return Solution((), tuple(range(problem.num_depots, problem.num_nodes)))


def test_a_beginning_ends_at_the_deadline(endless: Problem, needed: float) -> None:
    found, seconds = searched(endless, nobody(endless), SearchConfig(), needed / 5)
    assert seconds < needed / 2
    assert not found.whole
    assert check(endless, found.solution).violations == ()


def test_a_beginning_ends_once_the_caller_wants_no_more(endless: Problem, needed: float) -> None:
    found, seconds = searched(endless, nobody(endless), SearchConfig(), 600.0, lambda: True)
    assert seconds < needed / 2
    assert not found.whole
    assert check(endless, found.solution).violations == ()
