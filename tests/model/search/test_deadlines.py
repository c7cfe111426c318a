"""What a search leaves out once it must end, and what it never does."""

from typing import Any

import numpy as np
import pytest

from model.engine.alarm import LAST_INSTANT, Alarm
from model.engine.instance import pack
from model.judge.check import check
from model.problem import (
    FULL_SPEED, Break, Customer, Depot, DrivingRules, DroneType, Problem, SpeedProfile, Travel,
    VehicleType,
)
from model.search import improve as searching
from model.search.beginning.translate import best_plan, make_searcher
from model.search.improve import Improved, SearchConfig, improve
from model.search.problem_data import make_data
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Route, Solution, Stop, Trip
from tests.model.tiny import MINUTE

SERVED = Solution((Route(0, 0, (Trip(tuple(Stop(node, 0, 0, 0) for node in (0, 1, 0))),)),), ())


def slow_at_first() -> Problem:
    """Return a problem whose driver isn't on the way for too long if it begins after 20 minutes."""
    legs = np.array([[0, 10], [10, 0]]) * MINUTE
    van = VehicleType("van", 1, (1,), 0, max_travel_duration=25 * MINUTE, cost_per_hour=1.0,
                      speed_profile=SpeedProfile((20 * MINUTE,), (FULL_SPEED // 2, FULL_SPEED)))
    return Problem((Depot("hub"),), (Customer("c", (1,)),), (van,), (Travel(legs, legs),),
                   np.zeros((2, 2)), unassigned_cost=10.0)


def fresh_at_noon() -> Problem:
    """Return a problem whose driver, who has a break, is to load late: parcels are to stay fresh.

    He has to rest by rules as well, so that breaks and departure aren't chosen at once.
    """
    legs = np.array([[0, 10], [10, 0]]) * MINUTE
    customer = Customer("c", (1,), earliest=300 * MINUTE, max_time_aboard=20 * MINUTE)
    van = VehicleType("van", 1, (1,), 0, cost_per_hour=1.0,
                      driving=DrivingRules(600 * MINUTE, 45 * MINUTE),
                      breaks=(Break("b", 5 * MINUTE, 0, 60 * MINUTE, after_departure=True),))
    return Problem((Depot("hub"),), (customer,), (van,), (Travel(legs, legs),),
                   np.zeros((2, 2)), unassigned_cost=10.0)


def begun(rings: bool, problem: Problem) -> tuple[ProblemData, Searcher]:
    """Return a search that begins with its customer served, before or behind its end."""
    alarm = Alarm()
    if rings:
        alarm.setting[LAST_INSTANT] = 0
    data = make_data(problem, pack([problem]), deadline=alarm.setting)
    return data, make_searcher(problem, data, SERVED, np.random.SeedSequence(0))


@pytest.mark.parametrize("problem", [slow_at_first(), fresh_at_noon()], ids=["slow", "fresh"])
def test_later_beginnings_are_not_tried_once_the_search_must_end(problem: Problem) -> None:
    _, in_time = begun(False, problem)
    _, late = begun(True, problem)
    assert (in_time.count.missing, late.count.missing) == (0, 1)


@pytest.mark.parametrize("problem", [slow_at_first(), fresh_at_noon()], ids=["slow", "fresh"])
def test_best_plan_is_read_however_late_it_is(problem: Problem) -> None:
    data, searcher = begun(False, problem)
    data.deadline[LAST_INSTANT] = 0
    plan = best_plan(data, searcher, [0, 1])
    assert check(problem, plan).violations == ()
    assert plan.unassigned == ()


@pytest.mark.parametrize(("late", "given_cost", "reads"), [
    (True, 0.0, 0), (True, 1e9, 1), (False, 0.0, 1)])
def test_plan_that_is_late_is_read_only_if_it_is_better_than_the_one_given(
        monkeypatch: pytest.MonkeyPatch, late: bool, given_cost: float, reads: int) -> None:
    problem, read = slow_at_first(), list[Searcher]()

    def noted(data: ProblemData, searcher: Searcher, node: list[int]) -> Solution:
        read.append(searcher)
        return best_plan(data, searcher, node)

    def searched(team: Any, data: ProblemData, *_: Any) -> None:
        if late:
            data.deadline[LAST_INSTANT] = 0

    monkeypatch.setattr(searching, "best_plan", noted)
    monkeypatch.setattr(searching, "_search", searched)
    found: Improved = improve(problem, pack([problem]), SERVED, SearchConfig(turns=1),
                              given_cost=given_cost)
    assert len(read) == reads
    assert (found.solution is SERVED) == (reads == 0)


def test_late_plan_tells_of_everybody_where_the_one_given_serves_nobody(
        monkeypatch: pytest.MonkeyPatch) -> None:
    def searched(team: Any, data: ProblemData, *_: Any) -> None:
        data.deadline[LAST_INSTANT] = 0

    monkeypatch.setattr(searching, "_search", searched)
    drones = DroneType(1, (1,), 0)
    legs = np.ones((41, 41), np.int64) - np.eye(41, dtype=np.int64)
    van = VehicleType("van", 1, (1,), 0, max_trip_distance=1, drones=drones)
    problem = Problem((Depot("hub"),), tuple(Customer(str(number), (1,)) for number in range(40)),
                      (van,), (Travel(legs, legs),), np.zeros((41, 2)), unassigned_cost=10.0)
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 41))),
                    SearchConfig(turns=1), given_cost=0.0)
    assert check(problem, found.solution).violations == ()
