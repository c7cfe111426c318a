"""Tests of what vehicles that fly share at depots, on a street of customers."""

from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Depot, Energy, Problem
from model.solution import Solution

POWER = (1000, 1000)
CHARGED = Energy(10**9, 1.0, (0, 1000), *(POWER,) * 4, charge=500)


@pytest.fixture
def flown(tiny_problem, customers, truck):
    """Return what makes a problem of one type of drones, whose hub has so much."""
    def make(batteries: int | None = None, chargers: int | None = None,
             **stated: object) -> Problem:
        kind = replace(truck, flies=True, count=3, max_trips=3, **stated)
        problem = tiny_problem(*customers, truck=kind)
        hub = replace(problem.depots[0], batteries=batteries, chargers=chargers)
        return replace(problem, depots=(hub, *problem.depots[1:]))

    return make


def broken(problem: Problem, *routes: tuple[int, ...]) -> list[tuple[str, str]]:
    """Return the rules that vehicles break which serve one customer a trip, and where."""
    plan = Solution(tuple(
        schedule(problem, RouteDecision(0, number, tuple(TripDecision((0, node, 0))
                                                         for node in nodes)))
        for number, nodes in enumerate(routes)))
    return [(each.code, each.path) for each in check(problem, plan).violations
            if each.code in ("BATTERIES", "CHARGERS")]


def test_each_trip_takes_a_battery_of_those_at_its_hub(flown) -> None:
    assert broken(flown(batteries=3), (1, 2), (3,)) == []
    assert broken(flown(batteries=2), (1, 2), (3,)) == [("BATTERIES", "routes[1].trips[0]")]
    assert broken(flown(batteries=1), (1, 2), (3,)) == [("BATTERIES", "routes[0].trips[1]")]


def test_who_is_charged_takes_no_battery_of_the_hub(flown) -> None:
    assert broken(flown(batteries=0, energy=CHARGED), (1, 2), (3,)) == []


def test_who_swaps_batteries_needs_no_place_to_charge(flown) -> None:
    assert broken(flown(chargers=0), (1, 2), (3,)) == []


def test_trucks_take_nothing(tiny_problem, customers, truck) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, count=3, max_trips=3))
    problem = replace(problem, depots=(replace(problem.depots[0], batteries=0, chargers=0),))
    assert broken(problem, (1, 2), (3,)) == []


def test_hubs_of_several_types_are_shared(flown) -> None:
    problem = flown(batteries=2)
    kind = problem.vehicle_types[0]
    problem = replace(problem, vehicle_types=(kind, replace(kind, id="other")))
    plan = Solution(tuple(schedule(problem, RouteDecision(index, 0, (
        TripDecision((0, node, 0)),))) for index, node in ((0, 1), (1, 2), (1, 3))))
    assert "BATTERIES" in {each.code for each in check(problem, plan).violations}


@pytest.mark.parametrize("name", ["batteries", "chargers"])
def test_a_hub_has_no_less_than_nothing(name: str) -> None:
    with pytest.raises(ValueError, match=name):
        Depot("hub", **{name: -1})


def test_limits_are_known_to_a_problem(flown) -> None:
    assert not flown().limits_hubs
    assert flown(chargers=0).limits_hubs
