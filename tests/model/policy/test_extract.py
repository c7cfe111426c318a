"""Tests of the plan that actions make."""

from dataclasses import replace

import numpy as np

from model.engine.instance import pack
from model.simulation.actions import (
    DRIVE, LAUNCH, OPEN, RETURN, apply, encode_action, finish, reset,
)
from model.policy.extract import extract
from model.simulation.state import by_term

MINUTE = 60_000


def codes(*actions: tuple[int, int]) -> list[int]:
    return [encode_action(kind, target) for kind, target in actions]


def test_no_action_leaves_everyone_unassigned(tiny_problem, customers, truck) -> None:
    problem = tiny_problem(*customers, truck=truck)
    solution = extract(problem, pack([problem]), [])
    assert solution.routes == ()
    assert solution.unassigned == (1, 2, 3, 4)


def test_actions_become_routes_trips_and_sorties(tiny_problem, customers, truck, drones) -> None:
    truck = replace(truck, max_trips=2, drones=drones)
    problem = tiny_problem(*customers, truck=truck)
    solution = extract(problem, pack([problem]), codes(
        (OPEN, 0), (DRIVE, 1), (LAUNCH, 2), (RETURN, 0), (DRIVE, 3), (RETURN, 0),
        (OPEN, 0), (DRIVE, 4), (RETURN, 0)))
    assert solution.unassigned == ()
    assert [route.driven_by for route in solution.routes] == [(0, 0), (0, 1)]
    nodes = [[[stop.node for stop in trip.stops] for trip in route.trips]
             for route in solution.routes]
    assert nodes == [[[0, 1, 0], [0, 3, 0]], [[0, 4, 0]]]
    (sortie,) = solution.routes[0].trips[0].sorties
    assert (sortie.drone, sortie.launch_stop, sortie.recovery_stop) == (0, 1, 2)
    # At 2 the truck is there, a minute to launch, one to fly, five of service, two to fly home.
    assert [visit.node for visit in sortie.visits] == [2]
    assert sortie.launch_time == 3 * MINUTE
    assert sortie.visits[0].arrival == 4 * MINUTE
    assert sortie.visits[0].departure == 9 * MINUTE
    assert (sortie.recovery_start, sortie.recovery_time) == (11 * MINUTE, 12 * MINUTE)
    assert solution.routes[0].trips[0].stops[-1].departure == 12 * MINUTE


def test_a_drone_that_can_not_meet_the_truck_in_time_returns_to_the_launching_stop(
        tiny_problem, customers, truck, drones) -> None:
    truck = replace(truck, drones=replace(drones, endurance=8 * MINUTE))
    problem = tiny_problem(*customers, truck=truck)
    solution = extract(problem, pack([problem]), codes(
        (OPEN, 0), (DRIVE, 1), (LAUNCH, 2), (DRIVE, 4), (RETURN, 0)))
    trip = solution.routes[0].trips[0]
    assert (trip.sorties[0].launch_stop, trip.sorties[0].recovery_stop) == (1, 1)
    assert [stop.departure // MINUTE for stop in trip.stops] == [0, 11, 22, 30]


def test_a_vehicle_that_is_opened_but_never_leaves_has_no_route_and_no_cost(
        tiny_problem, customers, truck) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, fixed_cost=50.0))
    instance = pack([problem])
    solution = extract(problem, instance, codes((OPEN, 0)))
    assert solution.routes == ()
    state = reset(instance, np.zeros(1, np.int64))
    apply(instance, state, 0, encode_action(OPEN, 0))
    finish(instance, state, 0)
    assert state.cost[0].unassigned == by_term(state.cost)[0].sum() == 4000
