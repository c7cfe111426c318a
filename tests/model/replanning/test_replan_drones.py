"""Replanning while drones are in the air."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.judge.timing import Operation, RouteDecision, SortieDecision, TripDecision, schedule
from model.planner import Planner
from model.problem import Customer, DroneType, Problem, VehicleType
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.solution import Route, Solution
from tests.model.street import (
    MINUTE, ONE, OPTIONS, A, B, C, D, minutes, planned, replan, route_of, served, solution_of,
    with_customer,
)


def _flying(street: Problem, drones: DroneType) -> tuple[Problem, Solution]:
    """Return a plan: from a (2 to 7 min) the drone flies to c at 3 min, back at b.

    It is at c at 5 min, serves until 10 and is at b at 11; there it is recovered until 12. The
    truck is at b from 9 to 14 min and goes on to d.
    """
    problem = replace(street, vehicle_types=(replace(street.vehicle_types[0], drones=drones),))
    trip = TripDecision((0, A, B, D, 0), (SortieDecision((C,), 1, 2),))
    return problem, solution_of(problem, RouteDecision(0, 0, (trip,)))


def test_truck_meets_a_drone_in_the_air_where_planned(planner: Planner, street: Problem,
                                                      drones: DroneType) -> None:
    problem, plan = _flying(street, drones)
    # At 4 min it stands at a; b lies on the way to the drone.
    solution = replan(planner, problem, Terms(plan, 4 * MINUTE))
    trip = solution.routes[0].trips[0]
    assert minutes(trip)[:2] == [(0, 0, 0), (A, 2, 7)]
    assert trip.stops[2].node == B
    assert trip.sorties[0] == plan.routes[0].trips[0].sorties[0]
    assert served(*solution.routes) == {A, B, C, D}


def test_rest_of_a_trip_has_the_batteries_that_are_left(planner: Planner, street: Problem,
                                                        drones: DroneType) -> None:
    swapping = replace(drones, swap_duration=3 * MINUTE, batteries=2)
    problem, _ = _flying(street, swapping)
    problem = with_customer(problem, D, served_by="drone")
    trip = TripDecision((0, A, B, 0), (SortieDecision((C,), 1, 2), SortieDecision((D,), 2, 3)))
    plan = solution_of(problem, RouteDecision(0, 0, (trip,)))
    for batteries, flown in ((2, {A, B, C, D}), (1, {A, B, C})):
        stock = replace(problem.vehicle_types[0], count=1,
                        drones=replace(swapping, batteries=batteries))
        solution = replan(planner, replace(problem, vehicle_types=(stock,)),
                          Terms(plan, 4 * MINUTE))
        assert served(*solution.routes) == flown
        later = [sortie.launch_time for sortie in solution.routes[0].trips[0].sorties[1:]]
        # The first is aboard at b at 12 min.
        assert later == [16 * MINUTE][:len(flown) - 3]


def test_launch_that_has_not_begun_may_change(planner: Planner, street: Problem,
                                              drones: DroneType) -> None:
    problem, plan = _flying(street, drones)
    closed = with_customer(problem, C, served_by="truck")
    solution = replan(planner, closed, Terms(plan, MINUTE))
    trip = solution.routes[0].trips[0]
    assert C in [stop.node for stop in trip.stops]
    assert minutes(trip)[1][:2] == (A, 2)
    assert served(*solution.routes) == {A, B, C, D}


def test_broken_truck_s_drone_comes_home_with_what_it_has_served(planner: Planner, street: Problem,
                                                                 drones: DroneType) -> None:
    problem, plan = _flying(street, drones)
    broken = frozenset({ONE})
    solution = replan(planner, problem, Terms(plan, 6 * MINUTE, unavailable=broken))
    assert served(route_of(solution, ONE)) == {A, C}
    assert route_of(solution, ONE).trips[0].sorties[0].recovery_stop == 2
    solution = replan(planner, problem, Terms(plan, 4 * MINUTE, unavailable=broken))
    assert served(route_of(solution, ONE)) == {A}


def test_drone_that_is_lost_is_launched_no_more(planner: Planner, street: Problem,
                                               drones: DroneType) -> None:
    problem, _ = _flying(street, replace(drones, count=2))
    for node in (C, D):
        problem = with_customer(problem, node, served_by="drone")
    flights = (SortieDecision((C,), 1, 2, 0), SortieDecision((D,), 2, 3, 1))
    trip = TripDecision((0, A, B, 0), flights)
    plan = solution_of(problem, RouteDecision(0, 0, (trip,)))

    def flown(now: int | None, *lost: int) -> list[tuple[int, int]]:
        terms = Terms(plan, now, grounded={ONE: frozenset(lost)})
        replanning = Replanning(problem, terms)
        solution = replanning.plan(planner, OPTIONS).solution
        assert replanning.check(solution).violations == ()
        return sorted((sortie.visits[0].node, sortie.drone) for route in solution.routes
                      if route.vehicle == ONE.number for trip in route.trips
                      for sortie in trip.sorties)

    # At 4 min drone 1 is on its way to c, and ends its flight.
    assert flown(4 * MINUTE, 0) == [(C, 0), (D, 1)]
    assert flown(4 * MINUTE, 1) == [(C, 0), (D, 0)]
    assert flown(4 * MINUTE, 0, 1) == [(C, 0)]
    # Before anything has happened, too.
    assert {drone for _, drone in flown(None, 0)} == {1}
    assert flown(None, 0, 1) == []
    # A plan that launches it is refused.
    refused = Replanning(problem, Terms(plan, 4 * MINUTE, grounded={ONE: frozenset({1})}))
    assert ("UNAVAILABLE", "routes[0].trips[0].sorties[1]") in [
        (item.code, item.path) for item in refused.check(plan).violations]


def test_truck_of_drones_of_several_types_goes_on_with_those_that_are_left(
        planner: Planner, street: Problem, drones: DroneType) -> None:
    problem, _ = _flying(street, drones)
    kind = replace(problem.vehicle_types[0], count=1, more_drones=(drones,))
    problem = with_customer(replace(problem, vehicle_types=(kind,)), D, served_by="drone")
    trip = TripDecision((0, A, B, 0), (SortieDecision((D,), 2, 3, 0),))
    plan = solution_of(problem, RouteDecision(0, 0, (trip,)))
    solution = replan(planner, problem, Terms(plan, 4 * MINUTE, grounded={ONE: frozenset({0})}))
    assert [sortie.drone for sortie in solution.routes[0].trips[0].sorties
            if sortie.visits[0].node == D] == [1]


def test_idle_drone_may_be_launched_where_the_truck_stands_from_now_on(
        planner: Planner, tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType, drones: DroneType) -> None:
    a, b, *_ = customers
    problem = tiny_problem(replace(a, service_duration=60 * MINUTE), b,
                           truck=replace(truck, count=1, cost_per_km=1.0, drones=drones))
    plan = planned(problem, ((A, B),))
    replanning = Replanning(problem, Terms(plan, 30 * MINUTE))
    flown = Solution((Route(0, 0, (replace(
        schedule(problem, RouteDecision(0, 0, (TripDecision(
            (0, A, 0), (SortieDecision((B,), 1, 1),), ((), (
                Operation(0, True), Operation(0, False)), ())),))).trips[0]),)),))
    # As soon as the truck is there, the drone would have been launched at 2 min.
    assert "FROZEN" not in [item.code for item in replanning.check(flown).violations]
    assert "TIME_MISMATCH" in [item.code for item in replanning.check(flown).violations]
    result = replanning.plan(planner, OPTIONS).solution
    (sortie,) = result.routes[0].trips[0].sorties
    assert sortie.launch_time == 31 * MINUTE


def test_drone_is_launched_in_a_zone_where_the_truck_stands_once_that_is_open(
        planner: Planner, tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
        truck: VehicleType, drones: DroneType) -> None:
    a, b, *_ = customers
    closed = replace(drones, closings=((0, 45 * MINUTE, 1),))
    problem = tiny_problem(replace(a, service_duration=60 * MINUTE, zones=1), b,
                           truck=replace(truck, count=1, cost_per_km=1.0, drones=closed))
    solution = replan(planner, problem, Terms(planned(problem, ((A, B),)), 30 * MINUTE))
    (sortie,) = solution.routes[0].trips[0].sorties
    assert (sortie.launch_stop, sortie.launch_time) == (1, 45 * MINUTE)


def test_past_that_can_t_have_been_is_refused(street: Problem, drones: DroneType) -> None:
    problem, plan = _flying(street, drones)
    flights = problem.travel[1]
    closed = flights.duration[:].copy()
    closed[A, C] = 2**50
    far = flights.distance[:].copy()
    far[A, C] = 2**50
    problem = replace(problem, travel=(problem.travel[0],
                                       replace(flights, duration=closed, distance=far)))
    with pytest.raises(SettledPartError, match="no flight") as caught:
        Replanning(problem, Terms(plan, 4 * MINUTE))
    assert caught.value.violations[0].path == "routes[0].trips[0].sorties[0]"
