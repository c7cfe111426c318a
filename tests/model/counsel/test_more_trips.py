"""Another trip is offered where it serves the customer, and only there."""

import math
from dataclasses import replace

import numpy as np
import pytest

from model.counsel.explain import Reason, explain
from model.counsel.more_trips import with_another_trip
from model.judge.past import EVERYTHING_OPEN, Past, known_trips
from model.judge.retiming import read_route, time_route
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.solution import Solution, Vehicle
from tests.model.remedies import applied

MINUTE = 60_000
D = 4
ANOTHER = "fits if truck could make another trip"

# A truck is back from a at 9 min, from d at 21.


def serve(problem, *nodes):
    """One vehicle for each node."""
    routes = tuple(schedule(problem, RouteDecision(0, vehicle, (TripDecision((0, node, 0)),)))
                   for vehicle, node in enumerate(nodes))
    return Solution(routes, tuple(node for node in (1, 2, 3, 4) if node not in nodes))


def reason_for_d(problem, solution, past=EVERYTHING_OPEN, until=math.inf):
    (reason,) = with_another_trip(problem, solution, D, explain(problem, solution, D), past, until)
    return reason


def test_another_trip_is_offered_beside_one_more_vehicle(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    reason = reason_for_d(problem, serve(problem, 1, 2))
    assert (reason.remedy, reason.other_remedy) == ("fits with one more vehicle", ANOTHER)


@pytest.mark.parametrize(("on_truck", "on_customer", "is_offered"), [
    # Back from a at 9 min, reloaded at 19, at d at 27, served until 32, back at 40.
    ({"latest": 40 * MINUTE}, {}, True),
    ({"latest": 40 * MINUTE - 1}, {}, False),
    ({}, {"latest": 27 * MINUTE}, True),
    ({}, {"latest": 27 * MINUTE - 1}, False),
    ({"max_working_duration": 40 * MINUTE}, {}, True),
    ({"max_working_duration": 40 * MINUTE - 1}, {}, False),
    ({"cost_per_km": 1.0}, {"unassigned_cost": 8.5}, True),
    ({"cost_per_km": 1.0, "fixed_cost": 0.0}, {"unassigned_cost": 8.0}, False),
])
def test_another_trip_is_offered_where_it_keeps_all_rules_and_pays(
        on_truck, on_customer, is_offered, tiny_problem, customers, truck):
    *others, d = customers
    kind = replace(truck, reload_duration=10 * MINUTE, **on_truck)
    problem = tiny_problem(*others, replace(d, **on_customer), truck=kind)
    reason = reason_for_d(problem, serve(problem, 1, 2))
    assert (ANOTHER in (reason.remedy, reason.other_remedy)) == is_offered


def test_following_it_serves_the_customer(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    solution = serve(problem, 1, 2)
    reason = reason_for_d(problem, solution)
    changed = applied(problem, replace(reason, remedies=reason.remedies[1:]), D)
    decision = read_route(changed, solution.routes[0])
    longer = replace(decision, trips=(*decision.trips, TripDecision((0, D, 0))))
    assert time_route(changed, longer, "routes[0]", EVERYTHING_OPEN).judged.violations == []


def test_only_a_truck_that_may_serve_it_goes_out_again(tiny_problem, customers, truck):
    problem = replace(tiny_problem(*customers, truck=truck),
                      may_serve=np.array([[True, True, True, False]]))
    reason = reason_for_d(problem, serve(problem, 1, 2))
    assert reason.code == "VEHICLE"
    assert reason.other_remedy is None


def test_a_drone_may_fly_from_the_depot_on_it(tiny_problem, customers, truck, drones):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, served_by="drone"),
                           truck=replace(truck, drones=drones))
    reason = reason_for_d(problem, serve(problem, 1, 2))
    assert reason.other_remedy == ANOTHER


def test_what_is_broken_goes_out_no_more(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    solution = serve(problem, 1, 2)
    both = frozenset({Vehicle(0, 0), Vehicle(0, 1)})
    why = (Reason(0, "FLEET_EXHAUSTED", "No vehicle of truck can begin another trip."),)
    known = known_trips(problem, solution, 60 * MINUTE, frozenset())

    def told(past):
        (reason,) = with_another_trip(problem, solution, D, why, past, math.inf)
        return reason.remedy

    assert told(Past(60 * MINUTE, known)) == ANOTHER
    assert told(Past(60 * MINUTE, known, both)) is None


def test_nothing_is_offered_once_the_time_is_over(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    reason = reason_for_d(problem, serve(problem, 1, 2), until=0.0)
    assert reason.other_remedy is None
