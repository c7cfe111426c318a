"""What has happened stays, and what is left is planned anew."""

import time
from collections.abc import Callable
from dataclasses import replace

import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision
from model.planner import Listener, PlanCheckError, Planner
from model.problem import MAX_QUANTITY, Customer, Overtime, Problem, Relation, VehicleType
from model.replanning.replan import Replanning, Terms
from model.replanning.workers import MAX_OWN_TYPES, TooManyTypesError
from model.search.improve import Progress
from model.solution import Route, Solution, Stop, Trip
from tests.model.street import (
    MINUTE, NO_POLICY, ONE, OPTIONS, TWO, A, B, C, D, minutes, planned, replan, route_of, served,
    solution_of, with_customer, with_trucks,
)


@pytest.mark.parametrize("now", [None, 0, 1, 7, 8, 9, 10, 30, 100])
def test_plan_stays_as_it_is_if_nothing_changes(planner: Planner, street: Problem,
                                                now: int | None) -> None:
    plan = planned(street, ((A, B, C),), ((D,),))
    options = replace(OPTIONS, search_iterations=0)
    terms = Terms(plan, None if now is None else now * MINUTE)
    again = replan(planner, street, terms, options)
    costs = [check(street, solution).cost.total for solution in (plan, again)]
    assert costs[1] == pytest.approx(costs[0])
    assert [[minutes(trip) for trip in route.trips] for route in again.routes] == [
        [minutes(trip) for trip in route.trips] for route in plan.routes]


def test_truck_under_way_takes_no_new_parcels(planner: Planner, street: Problem) -> None:
    # At 10 min truck 1 serves b, from 9 to 14 min; d is new and lies beyond c.
    terms = Terms(planned(street, ((A, B, C),)), 10 * MINUTE)
    solution = replan(planner, street, terms)
    assert minutes(route_of(solution, ONE).trips[0]) == [
        (0, 0, 0), (A, 2, 7), (B, 9, 14), (C, 16, 21), (0, 27, 27)]
    (trip,) = route_of(solution, TWO).trips
    assert minutes(trip)[0][1] >= 10
    assert [stop.node for stop in trip.stops] == [0, D, 0]


def test_truck_that_has_not_left_takes_new_parcels(planner: Planner, street: Problem) -> None:
    plan = planned(street, ((A, B, C),))
    late = replace(plan.routes[0].trips[0], stops=tuple(
        Stop(stop.node, stop.arrival + 11 * MINUTE, stop.service_start + 11 * MINUTE,
             stop.departure + 11 * MINUTE) for stop in plan.routes[0].trips[0].stops))
    plan = Solution((Route(0, 0, (late,)),), (D,))
    solution = replan(planner, street, Terms(plan, 10 * MINUTE))
    (route,) = solution.routes
    assert served(route) == {A, B, C, D}
    assert route.trips[0].stops[0].departure >= 10 * MINUTE


def test_cancelled_order_aboard_is_not_delivered(planner: Planner, street: Problem) -> None:
    plan = planned(street, ((A, B, C, D),))
    gone = Solution(tuple(
        replace(route, trips=tuple(replace(trip, stops=tuple(
            replace(stop, node=-1 if stop.node == C else stop.node - (stop.node > C))
            for stop in trip.stops)) for trip in route.trips)) for route in plan.routes))
    fewer = replace(street, customers=street.customers[:2] + street.customers[3:],
                    travel=tuple(replace(kind, duration=kind.duration[:4, :4] * 1,
                                         distance=kind.distance[:4, :4] * 1)
                                 for kind in street.travel),
                    coordinates=street.coordinates[:4])
    solution = replan(planner, fewer, Terms(gone, 10 * MINUTE))
    # What was d is now node 3, at 3 km.
    assert minutes(solution.routes[0].trips[0]) == [
        (0, 0, 0), (A, 2, 7), (B, 9, 14), (3, 16, 21), (0, 27, 27)]


def test_broken_truck_does_nothing_more(planner: Planner, street: Problem) -> None:
    terms = Terms(planned(street, ((A, B, C),)), 10 * MINUTE, unavailable=frozenset({ONE}))
    solution = replan(planner, street, terms)
    assert minutes(route_of(solution, ONE).trips[0]) == [
        (0, 0, 0), (A, 2, 7), (B, 9, 14), (0, 18, 18)]
    assert served(route_of(solution, TWO)) == {C, D}
    assert route_of(solution, TWO).trips[0].stops[0].departure >= 10 * MINUTE


def test_broken_truck_on_its_way_leaves_that_customer_to_others(planner: Planner,
                                                               street: Problem) -> None:
    # It left a at 7 min and would be at b at 9 min.
    terms = Terms(planned(street, ((A, B, C),)), 8 * MINUTE, unavailable=frozenset({ONE}),
                  parcels_back=30 * MINUTE)
    solution = replan(planner, street, terms)
    assert minutes(route_of(solution, ONE).trips[0]) == [(0, 0, 0), (A, 2, 7), (0, 9, 9)]
    (trip,) = route_of(solution, TWO).trips
    assert served(route_of(solution, TWO)) == {B, C, D}
    assert trip.stops[0].arrival >= 30 * MINUTE


def test_truck_that_breaks_down_before_its_first_customer_vanishes(planner: Planner,
                                                                   street: Problem) -> None:
    terms = Terms(planned(street, ((A, B),)), MINUTE, unavailable=frozenset({ONE}))
    solution = replan(planner, street, terms)
    assert [route.vehicle for route in solution.routes] == [1]
    assert served(*solution.routes) == {A, B, C, D}


@pytest.mark.parametrize("trips", [((A, B),), ((D,), (A, B))])
def test_parcels_of_a_trip_that_vanishes_come_back_too(planner: Planner, street: Problem,
                                                       trips: tuple[tuple[int, ...], ...]) -> None:
    plan = planned(street, trips)
    left = plan.routes[0].trips[-1].stops[0].departure
    terms = Terms(plan, left + MINUTE, unavailable=frozenset({ONE}), parcels_back=60 * MINUTE)
    replanning = Replanning(street, terms)
    at_once = TripDecision((0, A, B, 0), start=left + MINUTE)
    assert "RETURN" in [item.code for item in replanning.check(
        solution_of(street, RouteDecision(0, 1, (at_once,)))).violations]
    solution = replan(planner, street, terms)
    assert served(*solution.routes) == {A, B, C, D}
    for trip in route_of(solution, TWO).trips:
        on_it = {stop.node for stop in trip.stops}
        assert not on_it & {A, B} or trip.stops[0].arrival >= 60 * MINUTE


def test_closed_window_leaves_out_whom_nobody_reaches_in_time(planner: Planner,
                                                              street: Problem) -> None:
    plan = planned(street, ((A, B, C, D),))
    closed = with_customer(street, C, latest=15 * MINUTE)
    replanning = Replanning(closed, Terms(plan, 10 * MINUTE))
    solution = replanning.plan(planner, OPTIONS).solution
    assert solution.unassigned == (C,)
    assert minutes(solution.routes[0].trips[0])[3:] == [(D, 18, 23), (0, 31, 31)]
    (reason,) = replanning.reasons(solution, C)
    assert (reason.code, "truck-1" in reason.message) == ("ABOARD", True)


def test_overtime_counts_from_before_the_new_plan(planner: Planner, street: Problem) -> None:
    # Home at 36 min, 8 after the shift, after 36 min of work, 6 more than usual.
    tired = with_trucks(street, latest=28 * MINUTE, max_working_duration=30 * MINUTE,
                        overtime=Overtime(60.0, 8 * MINUTE))
    plan = planned(tired, ((A, B, C, D),))
    for now in (10, 25):
        replanning = Replanning(tired, Terms(plan, now * MINUTE))
        result = replanning.plan(planner, OPTIONS)
        assert result.solution.unassigned == ()
        assert result.evaluation.routes[0].overtime == 8 * MINUTE
        assert result.evaluation.cost.overtime == pytest.approx(8.0)
    weary = with_trucks(tired, overtime=Overtime(60.0, 8 * MINUTE - 1))
    assert len(replan(planner, weary, Terms(plan, 10 * MINUTE)).unassigned) == 1


@pytest.mark.parametrize(("now", "left_out"), [(30, ()), (45, (C, D)), (55, (A, B, C, D))])
def test_a_truck_may_begin_in_overtime(planner: Planner, street: Problem, now: int,
                                       left_out: tuple[int, ...]) -> None:
    # Home by 60 min: from 45 on, one reaches a and one b, which take 9 and 13.
    tired = with_trucks(street, latest=20 * MINUTE, overtime=Overtime(60.0, 40 * MINUTE))
    nobody = Solution((), (A, B, C, D))
    assert replan(planner, tired, Terms(nobody, now * MINUTE)).unassigned == left_out


def test_stops_made_count_for_the_rest_of_a_trip(planner: Planner, street: Problem) -> None:
    fewer = with_trucks(street, max_stops=3)
    solution = replan(planner, fewer, Terms(planned(street, ((A, B, C, D),)), 10 * MINUTE))
    assert len(solution.unassigned) == 1
    assert len(solution.routes[0].trips[0].stops) == 5


def test_what_has_happened_is_excused(planner: Planner, street: Problem) -> None:
    closed = with_customer(street, A, latest=MINUTE)
    replanning = Replanning(closed, Terms(planned(street, ((A, B, C, D),)), 10 * MINUTE))
    result = replanning.plan(planner, OPTIONS)
    assert [(item.code, item.path) for item in replanning.excused] == [
        ("TIME_WINDOW", "routes[0].trips[0].stops[1]")]
    assert result.evaluation.is_feasible
    assert [item.code for item in check(closed, result.solution).violations] == ["TIME_WINDOW"]


def test_stated_times_are_kept_where_the_model_would_be_elsewhere(planner: Planner,
                                                                  street: Problem) -> None:
    plan = planned(street, ((A, B, C),))
    stops = list(plan.routes[0].trips[0].stops)
    # The truck stood at a for 6 min more than planned, and reports when it will be at b.
    stops[1] = replace(stops[1], departure=13 * MINUTE)
    stops[2] = Stop(B, 15 * MINUTE, 15 * MINUTE, 20 * MINUTE)
    late = Solution((Route(0, 0, (Trip(tuple(stops)),)),), (D,))
    solution = replan(planner, street, Terms(late, 14 * MINUTE))
    assert minutes(route_of(solution, ONE).trips[0]) == [
        (0, 0, 0), (A, 2, 13), (B, 15, 20), (C, 22, 27), (0, 33, 33)]


def test_pinned_customers_stay_with_their_trucks(planner: Planner, street: Problem) -> None:
    plan = planned(street, ((A, B),), ((C,),))
    assert len(replan(planner, street, Terms(plan)).routes) == 1
    solution = replan(planner, street, Terms(plan, pinned=frozenset({A, C})))
    assert A in served(route_of(solution, ONE))
    assert C in served(route_of(solution, TWO))


def test_pinned_customer_who_does_not_fit_is_left_out(planner: Planner, street: Problem) -> None:
    heavy = with_customer(street, C, demand=(10_001,))
    replanning = Replanning(heavy, Terms(planned(street, ((A, B),), ((C,),)),
                                         pinned=frozenset({C})))
    solution = replanning.plan(planner, OPTIONS).solution
    assert solution.unassigned == (C,)
    assert [reason.code for reason in replanning.reasons(solution, C)] == ["PINNED"]


def test_vehicles_that_have_done_nothing_keep_their_numbers(planner: Planner,
                                                            street: Problem) -> None:
    small = replace(street, vehicle_types=(
        replace(street.vehicle_types[0], capacity=(2000,), count=3),))
    plan = solution_of(small, RouteDecision(0, 2, (TripDecision((0, A, B, 0)),)),
                       RouteDecision(0, 1, (TripDecision((0, C, D, 0)),)))
    solution = replan(planner, small, Terms(plan))
    assert {route.vehicle: served(route) for route in solution.routes} == {1: {C, D}, 2: {A, B}}


def test_second_trip_begins_after_the_first_and_counts_all_hours(
        planner: Planner, street: Problem) -> None:
    kind = replace(street.vehicle_types[0], count=1, max_trips=2, reload_duration=10 * MINUTE,
                   cost_per_hour=60.0, max_working_duration=90 * MINUTE)
    problem = replace(street, vehicle_types=(kind,))
    # Back at 9 min; it is 20 min now.
    plan = planned(problem, ((A,),))
    replanning = Replanning(problem, Terms(plan, 20 * MINUTE))
    result = replanning.plan(planner, OPTIONS)
    first, second = result.solution.routes[0].trips
    assert minutes(first) == [(0, 0, 0), (A, 2, 7), (0, 9, 9)]
    assert minutes(second)[0][1] == 20
    # The clock has run since 0 min, also while the truck stood.
    assert result.evaluation.routes[0].working_duration == second.stops[-1].departure
    assert result.evaluation.cost.time == second.stops[-1].departure / MINUTE
    short = replace(problem, vehicle_types=(replace(kind, max_working_duration=25 * MINUTE),))
    assert Replanning(short, Terms(plan, 20 * MINUTE)).plan(planner, OPTIONS).solution.unassigned


def test_truck_under_way_loads_new_parcels_on_its_next_trip(planner: Planner,
                                                            street: Problem) -> None:
    kind = replace(street.vehicle_types[0], count=1, max_trips=2, reload_duration=10 * MINUTE)
    problem = replace(street, vehicle_types=(kind,))
    solution = replan(planner, problem, Terms(planned(problem, ((A, B, C),)), 10 * MINUTE))
    first, second = solution.routes[0].trips
    assert minutes(first)[-1] == (0, 27, 27)
    assert minutes(second) == [(0, 37, 37), (D, 45, 50), (0, 58, 58)]


def test_truck_without_a_trip_left_does_not_come_back_by_magic(planner: Planner,
                                                               street: Problem) -> None:
    # Serving d would be worth leaving a customer aboard.
    kind = replace(street.vehicle_types[0], count=1)
    problem = replace(street, vehicle_types=(kind,))
    replanning = Replanning(problem, Terms(planned(problem, ((A, B, C),)), 10 * MINUTE))
    solution = replanning.plan(planner, OPTIONS).solution
    assert solution.unassigned == (D,)
    (reason,) = replanning.reasons(solution, D)
    assert reason.code == "FLEET_EXHAUSTED"


def test_reasons_know_who_is_served_after_what_has_happened(planner: Planner,
                                                            street: Problem) -> None:
    # A is served; what is left is B, C and D, by other numbers.
    problem = replace(street, relations=(Relation("before", (B, D), max_lag=10 * MINUTE),))
    problem = with_customer(problem, B, latest=60 * MINUTE)
    problem = with_customer(problem, D, earliest=200 * MINUTE, latest=210 * MINUTE)
    problem = with_trucks(problem, count=1, max_trips=2)
    replanning = Replanning(problem, Terms(planned(problem, ((A,), (B, C))), 8 * MINUTE))
    solution = replanning.plan(planner, OPTIONS).solution
    assert solution.unassigned == (D,)
    (reason,) = replanning.reasons(solution, D)
    assert reason.remedy is not None
    assert reason.remedy.startswith("fits if max_lag of its orders were at least 1")


def test_truck_that_can_only_just_get_home_goes_home(planner: Planner, street: Problem) -> None:
    kind = replace(street.vehicle_types[0], latest=17 * MINUTE)
    problem = replace(street, vehicle_types=(kind,))
    replanning = Replanning(problem, Terms(planned(street, ((A, B, C),)), 10 * MINUTE))
    result = replanning.plan(planner, OPTIONS)
    # It is home at 18 min, a minute too late already.
    assert minutes(result.solution.routes[0].trips[0])[-1] == (0, 18, 18)
    assert [item.code for item in replanning.excused] == ["SHIFT"]
    assert set(result.solution.unassigned) == {C, D}


def test_all_served_is_the_whole_plan(planner: Planner, street: Problem) -> None:
    plan = planned(street, ((A, B, C, D),))
    result = Replanning(street, Terms(plan, 1000 * MINUTE)).plan(planner, OPTIONS)
    assert result.solution == plan
    assert (result.search_iterations, result.deterministic) == (0, True)


@pytest.mark.parametrize("patience", [60.0, -1.0])
def test_clock_that_ends_an_insertion_is_owned_up_to(
        monkeypatch: pytest.MonkeyPatch, planner: Planner, street: Problem,
        patience: float) -> None:
    monkeypatch.setattr("model.planner.patience", lambda _: time.perf_counter() + patience)
    monkeypatch.setattr("model.search.improve.GRACE", 0.0)
    plan = planned(street, ((A, B), (C,)))
    result = Replanning(street, Terms(replace(plan, unassigned=(D,)), 8 * MINUTE)).plan(
        planner, replace(OPTIONS, time_limit=0.0))
    assert result.deterministic == (patience > 0)
    assert (result.solution.unassigned == ()) == (patience > 0)


def test_empty_plan_is_planned_from_nothing(planner: Planner, street: Problem) -> None:
    nobody = Solution((), (A, B, C, D))
    for iterations in (0, 50):
        options = replace(OPTIONS, search_iterations=iterations)
        assert served(*replan(planner, street, Terms(nobody), options).routes) == {A, B, C, D}


def test_plan_that_breaks_rules_is_repaired(planner: Planner, street: Problem) -> None:
    kind = replace(street.vehicle_types[0], capacity=(2000,), latest=60 * MINUTE)
    problem = with_customer(replace(street, vehicle_types=(kind,)), B, latest=6 * MINUTE)
    solution = replan(planner, problem, Terms(planned(street, ((A, B, C, D),))))
    assert served(*solution.routes) == {A, B, C, D}


def test_progress_tells_of_whole_plans(planner: Planner, street: Problem) -> None:
    replanning = Replanning(street, Terms(planned(street, ((A, B, C),)), 10 * MINUTE))
    told: list[tuple[float, float]] = []

    def note(progress: Progress) -> None:
        evaluation = replanning.check(progress.plan())
        assert evaluation.is_feasible
        told.append((progress.cost, evaluation.cost.total))

    replanning.plan(planner, OPTIONS, listener=Listener(on_progress=note))
    assert len(told) >= 2
    for stated, true in told:
        assert stated == pytest.approx(true)


def test_result_can_be_gone_on_from(planner: Planner, street: Problem) -> None:
    replanning = Replanning(street, Terms(planned(street, ((A, B, C),)), 10 * MINUTE))
    first = replanning.plan(planner, OPTIONS)
    again = replanning.plan(planner, replace(OPTIONS, search_iterations=0), start=first.solution)
    assert again.solution == first.solution


def test_too_many_vehicles_of_their_own_are_refused(
        tiny_problem: Callable[..., Problem], truck: VehicleType) -> None:
    number = MAX_OWN_TYPES + 1
    customers = [Customer(str(index), (1000,)) for index in range(number)]
    problem = tiny_problem(*customers, truck=replace(truck, count=number),
                           places=[0.0, *([1.0] * number)])
    plan = planned(problem, *[((node,),) for node in range(1, number + 1)])
    with pytest.raises(TooManyTypesError, match=str(number)):
        Replanning(problem, Terms(plan, pinned=frozenset(range(1, number + 1))))


def test_vehicle_under_way_for_ages_is_no_error(planner: Planner, street: Problem) -> None:
    slow = with_customer(street, B, service_duration=MAX_QUANTITY)
    plan = planned(slow, ((A, B, C),))
    assert Replanning(slow, Terms(plan, 10 * MINUTE)).plan(planner, OPTIONS).solution.routes


def test_result_that_breaks_a_rule_is_never_returned(street: Problem) -> None:
    class Careless(Planner):
        def plan(self, problem, options, received_at=None, listener=None, start=None):
            raise PlanCheckError("it can't be")

    replanning = Replanning(street, Terms(planned(street, ((A, B),))))
    with pytest.raises(PlanCheckError):
        replanning.plan(Careless(NO_POLICY), OPTIONS)
