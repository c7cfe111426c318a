"""Pinned customers keep their places in the order of their trucks, if that is asked for."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.judge.past import Past
from model.planner import Planner, PlanOptions
from model.problem import Customer, Problem
from model.replanning.order import by_order, in_order, orders_of
from model.replanning.replan import Terms
from model.solution import Route, Solution, Stop, Trip, Vehicle
from tests.model.street import (
    MINUTE, ONE, A, B, C, D, planned, replan, route_of, served, with_customer,
)

HOURLY = 10.0


def tour(solution: Solution) -> list[int]:
    """Return whom the first truck serves, in its order."""
    return [stop.node for trip in route_of(solution, ONE).trips for stop in trip.stops[1:-1]]


def test_pinned_customers_keep_their_order_only_if_asked_to(planner: Planner,
                                                            street: Problem) -> None:
    # A, B, C and D lie one behind the other.
    plan = planned(street, ((B, D, A, C),))
    pinned = frozenset({A, B, C, D})
    free = replan(planner, street, Terms(plan, pinned=pinned))
    held = replan(planner, street, Terms(plan, pinned=pinned, keeps_order=True))
    assert tour(held) == [B, D, A, C]
    assert check(street, free).cost.total < check(street, held).cost.total


def test_whom_a_pinned_customer_comes_before_is_served_behind_it(planner: Planner,
                                                                 street: Problem) -> None:
    plan = planned(street, ((B, D, A, C),))
    solution = replan(planner, street, Terms(plan, pinned=frozenset({D}), keeps_order=True))
    (place,) = [place for place, node in enumerate(tour(solution)) if node == D]
    assert {A, C}.isdisjoint(tour(solution)[:place])
    assert B not in tour(solution)[place:]
    assert served(*solution.routes) == {A, B, C, D}


def test_others_may_come_between(planner: Planner, street: Problem) -> None:
    plan = planned(street, ((B, D),))
    solution = replan(planner, street, Terms(plan, pinned=frozenset({B, D}), keeps_order=True))
    assert [node for node in tour(solution) if node in (B, D)] == [B, D]
    assert served(*solution.routes) == {A, B, C, D}


def test_checker_tells_who_left_its_place(street: Problem) -> None:
    plan = planned(street, ((B, A, C),))
    past = Past(pinned={A: ONE}, orders=orders_of(plan))

    def told(*tours: tuple[int, ...]) -> list[str]:
        changed = planned(street, *((tour,) for tour in tours))
        return [item.message for item in check(street, changed, past).violations
                if item.code == "ORDER"]

    assert told((B, A, C)) == told((B, D, A, C)) == told((A, C), (B,)) == []
    assert told((A, B, C)) == ["a is served before b"]
    assert told((B, C, A)) == ["a is served after c"]


@pytest.mark.parametrize(("changes", "expected"), [
    ({}, {}),
    ({"earliest": 3 * MINUTE, "gaps": ((12 * MINUTE, 20 * MINUTE),)},
     {"earliest": 3 * MINUTE, "latest": 12 * MINUTE}),
    ({"late_cost_per_hour": HOURLY}, {}),
    ({"late_cost_per_hour": HOURLY, "latest": 5 * MINUTE}, {}),
    ({"latest": 12 * MINUTE}, {"latest": 12 * MINUTE}),
])
def test_windows_say_the_order_and_hold_the_plan_given(
        street: Problem, changes: dict[str, object], expected: dict[str, int]) -> None:
    # From 9 to 14 min at B, which C is two minutes behind.
    plan = planned(with_customer(street, B, **changes), ((A, B, C),))
    ordered = in_order(with_customer(street, B, **changes), plan, {C})
    bounded: Customer = ordered.customer_at(B)
    assert {"earliest": bounded.earliest, "latest": bounded.latest} == {
        "earliest": 0, "latest": 15 * MINUTE} | expected
    assert (bounded.gaps, bounded.late_cost_per_hour) == ((), None)
    assert ordered.customer_at(C).earliest == 15 * MINUTE
    assert ordered.customer_at(C).latest == street.customer_at(C).latest
    assert not [item for item in check(ordered, plan).violations if item.code == "TIME_WINDOW"]


def test_who_is_late_at_the_end_may_stay_late(street: Problem) -> None:
    late = with_customer(street, B, latest=5 * MINUTE, late_cost_per_hour=HOURLY)
    plan = planned(late, ((A, B),))
    last = in_order(late, plan, {A}).customer_at(B)
    assert (last.earliest, last.latest, last.late_cost_per_hour) == (
        5 * MINUTE, 5 * MINUTE, HOURLY)


@pytest.mark.parametrize("minutes_at_a", [0, 5])
def test_customers_at_one_place_keep_their_order(planner: Planner, street: Problem,
                                                 minutes_at_a: int) -> None:
    # B lives where A does, needs no time, and is due while A would be served: B first is free.
    here = [0, A, A, C, D]
    problem = replace(street, travel=tuple(kind.among(np.array(here)) for kind in street.travel),
                      coordinates=street.coordinates[here])
    problem = with_customer(problem, A, service_duration=minutes_at_a * MINUTE)
    problem = with_customer(problem, B, service_duration=0)
    plan = planned(problem, ((A, B, C),))
    late = with_customer(problem, B, latest=3 * MINUTE, late_cost_per_hour=100.0)
    for seed in range(5):
        solution = replan(planner, late, Terms(plan, pinned=frozenset({A, B, C}), keeps_order=True),
                          PlanOptions("any", time_limit=60.0, search_iterations=200, seed=seed))
        assert [node for node in tour(solution) if node != D] == [A, B, C]


def test_checker_sees_an_order_at_an_instant(street: Problem) -> None:
    here = [0, A, A, C, D]
    problem = replace(street, travel=tuple(kind.among(np.array(here)) for kind in street.travel),
                      coordinates=street.coordinates[here])
    for node in (A, B):
        problem = with_customer(problem, node, service_duration=0)
    past = Past(pinned={A: ONE}, orders=orders_of(planned(problem, ((A, B, C),))))
    swapped = planned(problem, ((B, A, C),))
    assert [item.code for item in check(problem, swapped, past).violations] == ["ORDER"]
    assert check(problem, by_order(swapped, past.orders), past).violations == ()


def test_whoever_is_left_later_keeps_the_place_at_one_instant() -> None:
    at_once = Stop(2, 10, 10, 10, 0)
    longer, done = Stop(1, 10, 10, 15, 0), Stop(1, 10, 10, 10, 0)
    ends = Stop(0, 0, 0, 0, 0), Stop(0, 20, 20, 20, 0)

    def ordered(other: Stop) -> list[int]:
        trip = Trip((ends[0], at_once, other, ends[1]), ())
        plan = by_order(Solution((Route(0, 0, (trip,)),), ()), {Vehicle(0, 0): (1, 2)})
        return [stop.node for stop in plan.routes[0].trips[0].stops[1:-1]]

    assert ordered(done) == [1, 2]
    assert ordered(longer) == [2, 1]
