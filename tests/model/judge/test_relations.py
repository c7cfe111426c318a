from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.relations import who_waits
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import MAX_QUANTITY, UNLIMITED, Relation
from model.solution import Solution
from tests.model.judge.test_check import A_THEN_B, C_BY_DRONE, codes, plan

A, B, C, D = range(1, 5)
EACH_ALONE = TripDecision((0, A, 0)), TripDecision((0, B, 0))


@pytest.mark.parametrize(("kind", "scope", "nodes", "trips", "broken"), [
    ("together", "trip", (A, B), (A_THEN_B,), []),
    ("together", "trip", (A, B), EACH_ALONE, ["RELATION"]),
    ("together", "trip", (A, C), (C_BY_DRONE,), []),
    ("together", "vehicle", (A, B), EACH_ALONE, []),
    ("together", "vehicle", (A, D), EACH_ALONE, []),
    ("apart", "trip", (A, B), (A_THEN_B,), ["RELATION"]),
    ("apart", "trip", (A, B, C), (C_BY_DRONE,), ["RELATION"]),
    ("apart", "trip", (A, B), EACH_ALONE, []),
    ("apart", "vehicle", (A, B), EACH_ALONE, ["RELATION"]),
    ("apart", "vehicle", (A, C, D), EACH_ALONE, []),
])
def test_relations_bind_those_who_are_served(
    kind, scope, nodes, trips, broken, tiny_problem, customers, truck, drones
):
    problem = replace(
        tiny_problem(*customers, truck=replace(truck, max_trips=2, drones=drones)),
        relations=(Relation(kind, nodes, scope),))
    assert codes(problem, plan(problem, *trips)) == broken


@pytest.mark.parametrize(("kind", "broken"), [("together", ["RELATION"]), ("apart", [])])
def test_two_vehicles_part_who_goes_together(kind, broken, tiny_problem, customers, truck):
    problem = replace(tiny_problem(*customers, truck=replace(truck, count=2)),
                      relations=(Relation(kind, (A, B)),))
    routes = tuple(schedule(problem, RouteDecision(0, number, (trip,)))
                   for number, trip in enumerate(EACH_ALONE))
    violations = check(problem, Solution(routes, (C, D))).violations
    assert [each.code for each in violations] == broken
    assert [each.path for each in violations] == ["routes[1]"] * len(broken)


@pytest.mark.parametrize(("nodes", "lags", "trips", "broken", "waits"), [
    ((A, B), (), (A_THEN_B,), [], 0),
    ((B, A), (), (A_THEN_B,), ["RELATION"], 0),
    ((C, D), (), (A_THEN_B,), [], 0),
    ((A, B), (3600_000,), (A_THEN_B,), [], 3600_000),
    ((A, B), (3600_000, 3600_000), EACH_ALONE, [], 3600_000),
    ((A, B), (0, 1), (A_THEN_B,), ["RELATION"], 0),
    ((A, D, B), (0, 1), (A_THEN_B,), [], 0),
    ((A, D, B), (3600_000, 3600_000), (A_THEN_B,), [], 3600_000),
])
def test_trucks_wait_for_who_is_served_before(
    nodes, lags, trips, broken, waits, tiny_problem, customers, truck
):
    free = [replace(customer, latest=10**9) for customer in customers]
    problem = replace(tiny_problem(*free, truck=replace(truck, max_trips=2)),
                      relations=(Relation("before", nodes, "vehicle", *lags),))
    made = plan(problem, *trips)
    assert codes(problem, made) == broken
    start = {stop.node: stop.service_start for trip in made.routes[0].trips for stop in trip.stops}
    assert start[B] - start[A] >= waits
    assert not waits or start[B] - start[A] == waits


def test_nobody_waits_for_longer_than_a_problem_states(tiny_problem, customers, truck):
    late = replace(customers[0], earliest=MAX_QUANTITY, latest=UNLIMITED, served_by="truck")
    free = [replace(each, latest=UNLIMITED, served_by="truck") for each in customers[1:]]
    van = replace(truck, latest=UNLIMITED, last_by_shift=UNLIMITED, max_working_duration=None)
    problem = replace(tiny_problem(late, *free, truck=van), relations=(
        Relation("before", (A, B), min_lag=1, across=True),))
    served = schedule(problem, RouteDecision(0, 0, (TripDecision((0, A, 0)),)))
    assert who_waits(problem, Solution((served,), (B, C, D)), B) == (customers[0].id, None)
