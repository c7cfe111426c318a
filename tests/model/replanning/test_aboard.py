"""What is aboard a vehicle that drives stays with it, and no plan is worse than the one given."""

from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision
from model.planner import Planner, PlanOptions
from model.problem import DroneType, Problem
from model.replanning.replan import Replanning, Terms
from model.solution import Solution
from tests.model.street import (
    MINUTE, ONE, OPTIONS, A, B, C, D, replan, route_of, served, solution_of, with_customer,
    with_trucks,
)

AT_ONCE = replace(OPTIONS, search_iterations=0)


def flown(street: Problem, drones: DroneType, trip: TripDecision,
          **changes: object) -> tuple[Problem, Solution]:
    """Return a problem with drones, and the plan of one trip of the first truck."""
    problem = with_trucks(street, drones=drones, **changes)
    return problem, solution_of(problem, RouteDecision(0, 0, (trip,)))


@pytest.mark.parametrize("options", [OPTIONS, AT_ONCE])
def test_flight_to_be_met_last_and_a_past_window_closed_move_nothing(
        planner: Planner, street: Problem, drones: DroneType, options: PlanOptions) -> None:
    # The drone leaves a at 3 min, and is met at the depot.
    trip = TripDecision((0, A, B, D, 0), (SortieDecision((C,), 1, 4),))
    problem, plan = flown(street, drones, trip)
    closed = with_customer(problem, A, latest=0)
    replanning = Replanning(closed, Terms(plan, 8 * MINUTE))
    result = replanning.plan(planner, options)
    assert [item.code for item in replanning.excused] == ["TIME_WINDOW"]
    assert served(route_of(result.solution, ONE)) == {A, B, C, D}
    assert result.final_cost <= check(problem, plan).cost.total


def test_stop_that_breaks_a_rule_on_the_way_to_a_flight_is_left_out_alone(
        planner: Planner, street: Problem, drones: DroneType) -> None:
    trip = TripDecision((0, A, B, D, 0), (SortieDecision((C,), 1, 4),))
    problem, plan = flown(street, drones, trip)
    closed = with_customer(with_customer(problem, A, latest=0), D, latest=10 * MINUTE)
    replanning = Replanning(closed, Terms(plan, 8 * MINUTE))
    solution = replanning.plan(planner, OPTIONS).solution
    assert replanning.check(solution).violations == ()
    # Truck 2 could not be there in time, and hasn't the parcel.
    assert (served(*solution.routes), solution.unassigned) == ({A, B, C}, (D,))
    assert {reason.code for reason in replanning.reasons(solution, D)} == {"ABOARD"}


def test_parcel_that_its_truck_can_not_deliver_is_left_aboard(planner: Planner,
                                                              street: Problem) -> None:
    # Home at 18 min at the soonest, a minute after its shift; truck 2 could deliver c and d.
    plan = solution_of(street, RouteDecision(0, 0, (TripDecision((0, A, B, C, D, 0)),)))
    problem = with_trucks(street, latest=17 * MINUTE)
    late = replace(problem, vehicle_types=(
        replace(problem.vehicle_types[0], count=1),
        replace(street.vehicle_types[0], id="late", count=1)))
    replanning = Replanning(late, Terms(plan, 10 * MINUTE))
    solution = replanning.plan(planner, OPTIONS).solution
    assert solution.unassigned == (C, D)
    assert {reason.code for reason in replanning.reasons(solution, C)} == {"ABOARD"}
    taken = replace(plan, routes=(*solution.routes, *solution_of(
        late, RouteDecision(1, 0, (TripDecision((0, C, D, 0), start=30 * MINUTE),))).routes),
        unassigned=())
    assert {item.code for item in replanning.check(taken).violations} == {"ABOARD"}


def test_parcel_aboard_is_said_to_be_there_though_it_is_pinned(planner: Planner,
                                                              street: Problem) -> None:
    plan = solution_of(street, RouteDecision(0, 0, (TripDecision((0, A, B, C, 0)),)))
    closed = with_customer(street, C, latest=15 * MINUTE)
    replanning = Replanning(closed, Terms(plan, 10 * MINUTE, pinned=frozenset({C})))
    solution = replanning.plan(planner, OPTIONS).solution
    assert [reason.code for reason in replanning.reasons(solution, C)] == ["ABOARD"]


def test_truck_serves_what_it_brought_home_on_its_next_trip(planner: Planner, street: Problem,
                                                           drones: DroneType) -> None:
    # The drone is lost on its way to c, before it was to serve d from the depot.
    trip = TripDecision((0, A, 0), (SortieDecision((C,), 1, 2), SortieDecision((D,), 2, 2)))
    problem, plan = flown(street, drones, trip, max_trips=2)
    lost = {ONE: frozenset({0})}
    solution = replan(planner, problem, Terms(plan, 4 * MINUTE, grounded=lost))
    first, second = route_of(solution, ONE).trips
    assert (first.sorties[0].visits[0].node, D in {stop.node for stop in second.stops}) == (C, True)


def test_flight_from_where_was_picked_up_stays_if_pickups_come_last(
        planner: Planner, street: Problem, drones: DroneType) -> None:
    # The truck picks up at b, and launches to d there: no delivery comes after.
    trip = TripDecision((0, A, B, 0), (SortieDecision((C,), 1, 2), SortieDecision((D,), 2, 3)))
    collected = with_customer(street, B, pickup=(1000,))
    problem, plan = flown(collected, drones, trip, pickups="last")
    for options in (OPTIONS, AT_ONCE):
        replanning = Replanning(problem, Terms(plan, 4 * MINUTE))
        result = replanning.plan(planner, options)
        assert served(route_of(result.solution, ONE)) == {A, B, C, D}
        assert result.final_cost <= check(problem, plan).cost.total


def test_flight_over_the_stop_where_another_is_met_costs_no_more_than_as_planned(
        planner: Planner, street: Problem, drones: DroneType) -> None:
    # Drone 1 is on its way to c and met at b; drone 2 is to leave a for d, and be met at home.
    flights = (SortieDecision((C,), 1, 2, 0), SortieDecision((D,), 1, 3, 1))
    trip = TripDecision((0, A, B, 0), flights)
    problem = with_customer(street, D, served_by="drone")
    problem, plan = flown(problem, replace(drones, count=2, launch_duration=2 * MINUTE), trip)
    before = check(problem, plan).cost.total
    result = Replanning(problem, Terms(plan, 4 * MINUTE)).plan(planner, AT_ONCE)
    assert result.solution.unassigned == ()
    assert result.final_cost <= before
