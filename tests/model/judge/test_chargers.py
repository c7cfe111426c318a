"""Places to charge are shared in time, by what a plan states or as they are given out."""

from dataclasses import replace

import pytest

from model.judge.chargers import levels, most_charged, with_charging
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Problem
from model.solution import Charge, Solution
from tests.model.chargers import MINUTE, battery_of, charged_street, order


def flown(problem: Problem, *starts: tuple[int, int]) -> Solution:
    """Return a plan whose vehicles each serve the first customers left, at these minutes."""
    return Solution(tuple(schedule(problem, RouteDecision(0, number, tuple(
        TripDecision((0, 2 * number + index + 1, 0), start=minute * MINUTE)
        for index, minute in enumerate(minutes)))) for number, minutes in enumerate(starts)))


def broken(problem: Problem, plan: Solution) -> list[tuple[str, str]]:
    return [(each.code, each.path) for each in check(problem, plan).violations]


def test_one_is_charged_after_the_other() -> None:
    """Trips last from a minute before their take-off to a minute behind the two in the air."""
    problem = charged_street(*map(order, "abcd"), chargers=1)
    late = flown(problem, (0, 6), (0, 8))
    assert broken(problem, late) == []
    stated = with_charging(problem, late)
    assert [[trip.charges for trip in route.trips] for route in stated.routes] == [
        [(), (Charge(4 * MINUTE, 6 * MINUTE),)], [(), (Charge(6 * MINUTE, 8 * MINUTE),)]]
    assert broken(problem, stated) == []
    assert with_charging(problem, stated) is stated
    assert most_charged(problem, stated, 0) == 1
    kind = problem.vehicle_types[0]
    assert levels(problem, kind, stated.routes[1].trips) == [battery_of(kind).available] * 2


def test_two_at_once_need_two_places() -> None:
    soon = flown(charged_street(*map(order, "abcd"), chargers=1), (0, 6), (0, 6))
    one, two, none = (charged_street(*map(order, "abcd"), chargers=number)
                      for number in (1, 2, 0))
    assert broken(one, soon) == [("CHARGERS", "routes[1].trips[1]")]
    assert broken(two, soon) == []
    assert broken(none, soon) == [("CHARGERS", "routes[0].trips[1]")]


def test_who_takes_off_next_comes_first() -> None:
    """Both are there at once, and the second has less time."""
    problem = charged_street(*map(order, "abcd"), chargers=1)
    plan = with_charging(problem, flown(problem, (0, 9), (0, 7)))
    assert plan.routes[1].trips[1].charges == (Charge(4 * MINUTE, 6 * MINUTE),)
    assert broken(problem, plan) == []


def test_who_has_enough_needs_no_place() -> None:
    problem = charged_street(*map(order, "abcd"), chargers=0, minutes=4)
    assert broken(problem, flown(problem, (0, 5), (0, 5))) == []


def test_charges_for_later_trips_are_made_in_time() -> None:
    """Before the third trip there is no time to charge: that is done before the second."""
    problem = charged_street(*map(order, "abc"), chargers=1, minutes=4)
    route = schedule(problem, RouteDecision(0, 0, tuple(
        TripDecision((0, node, 0), start=minute * MINUTE)
        for node, minute in ((1, 0), (2, 6), (3, 10)))))
    plan = with_charging(problem, Solution((route,)))
    assert [trip.charges for trip in plan.routes[0].trips] == [
        (), (Charge(4 * MINUTE, 6 * MINUTE),), ()]
    assert broken(problem, plan) == []


@pytest.mark.parametrize("charge", [(3, 6), (5, 8), (4, 5), (6, 4)])
def test_what_is_stated_is_found_anew_where_it_does_not_hold(charge: tuple[int, int]) -> None:
    """While it is away, for too short a time, or backwards."""
    problem = charged_street(*map(order, "ab"), chargers=1)
    route, = flown(problem, (0, 7)).routes
    first, second = route.trips
    start, end = charge
    stated = Solution((replace(route, trips=(first, replace(
        second, charges=(Charge(start * MINUTE, end * MINUTE),)))),))
    assert broken(problem, stated) == []
    assert with_charging(problem, stated).routes[0].trips[1].charges == (
        Charge(4 * MINUTE, 6 * MINUTE),)
    none = replace(problem, depots=(replace(problem.depots[0], chargers=0),))
    assert [code for code, _ in broken(none, stated)] == ["CHARGERS"]
    assert with_charging(none, stated) is stated


def test_plans_that_cannot_be_read_need_no_places() -> None:
    problem = charged_street(*map(order, "ab"), chargers=0)
    route, = flown(problem, (0, 7)).routes
    trip = route.trips[0]
    lost = replace(trip, stops=(*trip.stops[:1], replace(trip.stops[1], node=9), trip.stops[2]))
    assert {code for code, _ in broken(problem, Solution((replace(route, trips=(lost,) * 2),)))
            } == {"UNKNOWN_NODE", "MISSING"}
