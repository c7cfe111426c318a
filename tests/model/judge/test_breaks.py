"""Breaks as the judge times and demands them, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.breaks import BreakDecision
from model.judge.check import check
from model.judge.clock import with_all_setups
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    UNLIMITED, Break, Customer, Depot, DrivingRules, Problem, SpeedProfile, Travel, VehicleType,
)
from model.solution import BreakPlace, Solution, TakenBreak

MINUTE = 60_000


def problem_of(*breaks: Break, **stated: object) -> Problem:
    """Return two customers in a row, ten minutes from place to place, served for five minutes."""
    place = np.arange(3)
    legs = np.abs(place[:, None] - place) * 10 * MINUTE
    customers = tuple(Customer(name, (1,), service_duration=5 * MINUTE) for name in "AB")
    truck = replace(VehicleType("truck", 1, (2,), 0, cost_per_hour=60.0, breaks=breaks), **stated)
    return Problem((Depot("hub"),), customers, (truck,), (Travel(legs, legs),), np.zeros((3, 2)),
                   100.0)


def plan_of(problem: Problem, *breaks: tuple[int, int, BreakPlace], start: int = 0) -> Solution:
    """Return the plan that serves both in order, with these breaks."""
    trip = TripDecision((0, 1, 2, 0), start=start * MINUTE, breaks=tuple(
        BreakDecision(number, stop, place) for number, stop, place in breaks))
    return Solution((schedule(problem, RouteDecision(0, 0, (trip,))),))


def broken(problem: Problem, plan: Solution) -> set[str]:
    """Return the codes of the rules that a plan breaks."""
    return {violation.code for violation in check(problem, plan).violations}


REST = Break("rest", 6 * MINUTE, 12 * MINUTE, 20 * MINUTE)


@pytest.mark.parametrize(("place", "leg", "taken", "arrival"), [
    ("arrival", 0, (10, 12, 18), 18),
    ("departure", 1, (15, 15, 21), 31),
    ("way", 1, (15, 15, 21), 31),
    ("way", 0, (10, 12, 18), 18)])
def test_a_break_begins_as_soon_as_its_window_opens(
        place: BreakPlace, leg: int, taken: tuple[int, int, int], arrival: int) -> None:
    problem = problem_of(replace(REST, anywhere=True))
    plan = plan_of(problem, (0, leg, place))
    trip = plan.routes[0].trips[0]
    assert trip.breaks == (TakenBreak(0, leg, place, *(time * MINUTE for time in taken)),)
    assert trip.stops[leg + 1].arrival == arrival * MINUTE
    assert broken(problem, plan) == set()


def test_a_break_on_the_way_stops_the_drive_for_so_long() -> None:
    problem = problem_of(replace(REST, earliest=17 * MINUTE, anywhere=True))
    trip = plan_of(problem, (0, 1, "way")).routes[0].trips[0]
    assert trip.breaks[0].start == 17 * MINUTE
    assert trip.stops[2].arrival == 31 * MINUTE


def test_a_break_on_the_way_counts_what_was_driven_slowly_before() -> None:
    slow = SpeedProfile((20 * MINUTE,), (500_000, 1_000_000))
    problem = problem_of(Break("rest", 6 * MINUTE, 10 * MINUTE, anywhere=True), speed_profile=slow)
    trip = plan_of(problem, (0, 0, "way")).routes[0].trips[0]
    # Half of the leg is driven before; of the other, four minutes are slow.
    assert trip.stops[1].arrival == 23 * MINUTE


def test_breaks_have_to_be_taken_where_and_when_they_may() -> None:
    problem = problem_of(REST)
    assert broken(problem, plan_of(problem)) == {"BREAK"}
    assert broken(problem, plan_of(problem, (0, 2, "departure"))) == {"BREAK"}
    assert broken(problem, plan_of(problem, (0, 1, "way"))) == {"BREAK"}
    assert broken(problem, plan_of(problem, (0, 1, "departure"))) == set()


@pytest.mark.parametrize(("each", "start"), [
    (replace(REST, latest=UNLIMITED), 0), (replace(REST, latest=50 * MINUTE), 0), (REST, 18)])
def test_a_break_before_or_behind_the_route_is_not_due(each: Break, start: int) -> None:
    problem = problem_of(each)
    assert broken(problem, plan_of(problem, start=start)) == set()


def test_windows_may_count_from_the_beginning_of_the_route() -> None:
    problem = problem_of(replace(REST, after_departure=True))
    plan = plan_of(problem, (0, 0, "arrival"), start=100)
    assert plan.routes[0].trips[0].breaks[0].start == 112 * MINUTE
    assert broken(problem, plan) == set()


def test_who_has_rested_on_the_way_is_at_no_stop_any_more() -> None:
    first = replace(REST, id="first", duration=0, earliest=17 * MINUTE, anywhere=True)
    problem = problem_of(first, REST)
    assert broken(problem, plan_of(problem, (0, 1, "way"), (1, 1, "departure"))) == {"BREAK"}
    assert broken(problem, plan_of(problem, (0, 1, "departure"), (1, 1, "departure"))) == set()
    assert broken(problem, plan_of(problem, (0, 1, "way"), (1, 1, "arrival"))) == {"BREAK"}
    later = problem_of(first, replace(REST, latest=30 * MINUTE))
    assert broken(later, plan_of(later, (0, 1, "way"), (1, 1, "arrival"))) == set()


def test_breaks_come_in_order_and_once() -> None:
    problem = problem_of(REST, replace(REST, id="other"))
    assert broken(problem, plan_of(problem, (1, 0, "arrival"), (0, 0, "arrival"))) == {"BREAK"}
    assert broken(problem, plan_of(problem, (0, 0, "arrival"), (0, 1, "departure"))) == {"BREAK"}


def test_unpaid_breaks_are_no_work() -> None:
    paid, unpaid = (check(problem, plan_of(problem, (0, 0, "arrival")))
                    for problem in (problem_of(REST), problem_of(replace(REST, paid=False))))
    assert paid.cost.time - unpaid.cost.time == pytest.approx(6)
    assert paid.routes[0].working_duration - unpaid.routes[0].working_duration == 6 * MINUTE


def test_stated_times_of_breaks_are_checked_as_well() -> None:
    problem = problem_of(REST)
    plan = plan_of(problem, (0, 0, "arrival"))
    route, = plan.routes
    trip, = route.trips
    longer = replace(trip.breaks[0], end=trip.breaks[0].end + 1)
    wrong = replace(route, trips=(replace(trip, breaks=(longer,)),))
    assert broken(problem, Solution((wrong,))) == {"TIME_MISMATCH"}
    unknown = replace(route, trips=(replace(trip, breaks=(replace(longer, number=3),)),))
    assert "BREAK" in broken(problem, Solution((unknown,)))


def test_breaks_that_lack_are_placed_where_the_route_ends_first() -> None:
    problem = problem_of(REST, Break("late", MINUTE, 40 * MINUTE, 50 * MINUTE),
                         latest=62 * MINUTE)
    decision = RouteDecision(0, 0, (TripDecision((0, 1, 2, 0), start=0),))
    placed = time_route(problem, decision, "route", EVERYTHING_OPEN).route
    assert broken(problem, Solution((placed,))) == set()
    assert [taken.number for taken in placed.trips[0].breaks] == [0, 1]


def test_a_break_that_lacks_is_placed_on_the_way_where_it_may_and_others_come_too_late() -> None:
    problem = problem_of(Break("early", 5 * MINUTE, 5 * MINUTE, 5 * MINUTE, anywhere=True))
    first, second = problem.customers
    problem = replace(problem, customers=(replace(first, latest=15 * MINUTE), second))
    decision = RouteDecision(0, 0, (TripDecision((0, 1, 2, 0), start=0),))
    placed = time_route(problem, decision, "route", EVERYTHING_OPEN).route
    assert broken(problem, Solution((placed,))) == set()
    assert [taken.place for taken in placed.trips[0].breaks] == ["way"]


def test_a_driver_rests_while_waiting_where_it_is_too_late_behind() -> None:
    rules = DrivingRules(max_driving=15 * MINUTE, rest=10 * MINUTE)
    problem = problem_of(driving=rules)
    first, second = problem.customers
    problem = replace(problem, customers=(replace(first, earliest=30 * MINUTE),
                                          replace(second, latest=45 * MINUTE)))
    decision = RouteDecision(0, 0, (TripDecision((0, 1, 2, 0), start=0),))
    placed = time_route(problem, decision, "route", EVERYTHING_OPEN).route
    assert broken(problem, Solution((placed,))) == set()
    rest, *_ = placed.trips[0].breaks
    assert (rest.stop, rest.start - placed.trips[0].stops[0].departure) == (0, 10 * MINUTE)


def test_breaks_stay_where_setups_are_told_anew() -> None:
    problem = problem_of(REST)
    problem = replace(problem, customers=tuple(
        replace(customer, setup_duration=MINUTE) for customer in problem.customers))
    plan = plan_of(problem, (0, 1, "departure"))
    assert with_all_setups(problem, plan) == plan
