from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from model.judge.check import check
from model.judge.clock import leg_end, leg_start
from model.judge.timing import (
    Operation,
    RouteDecision,
    SortieDecision,
    TripDecision,
    read_decision,
    schedule,
)
from model.problem import SpeedProfile
from model.solution import Solution, Stop, Visit

MINUTE = 60_000
HALVED_AT_5 = SpeedProfile((5 * MINUTE,), (1_000_000, 500_000))

profiles = st.lists(
    st.tuples(st.integers(1, 40), st.integers(1, 1_000_000)), max_size=5
).map(lambda steps: SpeedProfile(
    tuple(sum(step for step, _ in steps[: index + 1]) for index in range(len(steps))),
    (500_000, *(factor for _, factor in steps)),
))


def minutes(*times):
    return tuple(time * MINUTE for time in times)


def stop_at(node, *times):
    return Stop(node, *minutes(*times))


def one_trip(problem, decision):
    return schedule(problem, RouteDecision(0, 0, (decision,))).trips[0]


@pytest.mark.parametrize(("departure", "duration", "end"), [
    (0, 3, 3),  # before the change
    (0, 10, 15),  # five minutes at full speed, the other five take ten
    (4, 1, 5),  # ends at the change
    (5, 1, 7),
    (9, 0, 9),
])
def test_leg_across_a_change_is_driven_partly_at_each_speed(departure, duration, end):
    assert leg_end(departure * MINUTE, duration * MINUTE, HALVED_AT_5) == end * MINUTE


def test_leg_end_rounds_up_to_a_millisecond():
    assert leg_end(0, 1, SpeedProfile((), (300_000,))) == 4  # 3.33


def test_leg_crosses_several_changes():
    profile = SpeedProfile((10, 20, 30), (1_000_000, 100_000, 500_000, 250_000))
    # 10 done by 10, 1 by 20, 5 by 30, 4 left at a quarter
    assert leg_end(0, 20, profile) == 46


@given(profiles, st.integers(0, 200), st.integers(0, 100))
def test_leg_end_is_the_first_millisecond_with_all_work_done(profile, departure, duration):
    def done(time):
        bounds = (departure, *(t for t in profile.times if departure < t < time), time)
        factor_at = [profile.factors[sum(t <= b for t in profile.times)] for b in bounds]
        return sum(
            Fraction((end - begin) * factor, 1_000_000)
            for begin, end, factor in zip(bounds, bounds[1:], factor_at, strict=False)
        )

    end = leg_end(departure, duration, profile)
    assert done(end) >= duration
    assert end == departure or done(end - 1) < duration


@given(profiles, st.integers(0, 200), st.integers(0, 100))
def test_leg_start_is_the_latest_departure_in_time(profile, arrival, duration):
    start = leg_start(arrival, duration, profile)
    assert leg_end(start, duration, profile) <= arrival
    assert leg_end(start + 1, duration, profile) > arrival


def test_truck_waits_for_the_window_and_serves(tiny_problem, customers, truck):
    a, b = replace(customers[0], earliest=10 * MINUTE), customers[1]
    trip = one_trip(tiny_problem(a, b, truck=truck), TripDecision((0, 1, 2, 0)))
    assert trip.stops == (stop_at(0, 0, 0, 0), stop_at(1, 2, 10, 15), stop_at(2, 17, 17, 22),
                          stop_at(0, 26, 26, 26))


@pytest.mark.parametrize(("start", "served"), [(0, 5), (3, 5), (4, 6), (5, 20), (18, 20), (19, 21)])
def test_who_comes_between_two_windows_waits_for_the_next(
        start, served, tiny_problem, customers, truck):
    a = replace(customers[0], earliest=5 * MINUTE, gaps=(minutes(6, 20),), latest=30 * MINUTE)
    trip = one_trip(tiny_problem(a, truck=truck),
                    TripDecision((0, 1, 0), start=start * MINUTE))
    assert trip.stops[1] == stop_at(1, start + 2, served, served + 5)


@pytest.mark.parametrize(("closes", "takeoff"), [(4, 1), (3, 48)])
def test_launch_is_held_back_for_the_window_that_is_met(
        closes, takeoff, tiny_problem, customers, truck, drones):
    c = replace(customers[2], gaps=(minutes(closes, 60),))
    problem = tiny_problem(*customers[:2], c, truck=replace(
        truck, drones=replace(drones, endurance=20 * MINUTE)))
    trip = one_trip(problem, TripDecision((0, 0), (SortieDecision((3,), 0, 0),)))
    sortie, = trip.sorties
    assert sortie.launch_time == takeoff * MINUTE
    assert sortie.visits[0].service_start == (4 if takeoff == 1 else 60) * MINUTE


def test_trip_begins_on_shift_and_after_release(tiny_problem, customers, truck):
    problem = tiny_problem(replace(customers[0], release_time=3 * MINUTE),
                           truck=replace(truck, earliest=2 * MINUTE))
    assert one_trip(problem, TripDecision((0, 1, 0))).stops[0].arrival == 3 * MINUTE


def test_next_trip_begins_after_reloading(tiny_problem, customers, truck):
    problem = tiny_problem(*customers[:2], truck=replace(truck, reload_duration=10 * MINUTE))
    decision = RouteDecision(0, 0, (TripDecision((0, 1, 0)), TripDecision((0, 2, 0))))
    first, second = schedule(problem, decision).trips
    assert first.stops[-1] == stop_at(0, 9, 9, 9)
    assert second.stops[:2] == (stop_at(0, 19, 19, 19), stop_at(2, 23, 23, 28))


def test_sortie_to_a_later_stop(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers[:3], truck=replace(truck, drones=drones))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),)))
    sortie = trip.sorties[0]
    assert sortie.visits == (Visit(3, *minutes(5, 5, 10)),)
    assert (sortie.launch_time, sortie.recovery_start, sortie.recovery_time) == minutes(3, 11, 12)
    assert trip.stops[1:] == (stop_at(1, 2, 2, 7), stop_at(2, 9, 9, 14), stop_at(0, 18, 18, 18))


def test_drone_waits_for_the_truck(tiny_problem, customers, truck, drones):
    quick = replace(drones, service_duration=0)
    problem = tiny_problem(*customers[:3], truck=replace(truck, drones=quick))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),)))
    assert trip.sorties[0].recovery_start == 9 * MINUTE  # there since minute 6


def test_truck_waits_for_a_loop(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers[:3], truck=replace(truck, drones=drones))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 1),)))
    assert trip.sorties[0].recovery_time == 13 * MINUTE
    assert trip.stops[1:3] == (stop_at(1, 2, 2, 13), stop_at(2, 15, 15, 20))


def test_loop_at_the_depot_needs_no_driving(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers[:3], truck=replace(truck, drones=drones))
    trip = one_trip(problem, TripDecision((0, 0), (SortieDecision((3,), 0, 0),)))
    assert trip.sorties[0].visits == (Visit(3, *minutes(4, 4, 9)),)
    assert trip.stops == (stop_at(0, 0, 0, 13), stop_at(0, 13, 13, 13))


def test_service_takes_trucks_and_drones_of_a_type_their_own_time(
    tiny_problem, customers, truck, drones
):
    flown = replace(drones, service_duration=7 * MINUTE, service_durations={"c": 2 * MINUTE})
    slow = replace(truck, service_durations={"a": 4 * MINUTE, "c": 9 * MINUTE}, drones=flown)
    problem = tiny_problem(*customers, truck=slow)
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),)))
    assert trip.stops[1:3] == (stop_at(1, 2, 2, 6), stop_at(2, 8, 8, 13))
    assert trip.sorties[0].visits == (Visit(3, *minutes(5, 5, 7)),)
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), (SortieDecision((4,), 1, 2),)))
    visit, = trip.sorties[0].visits
    assert visit.departure - visit.arrival == 7 * MINUTE


def test_whoever_comes_from_elsewhere_sets_up_first(tiny_problem, customers, truck, drones):
    a, b, c, d = customers
    a = replace(a, setup_duration=3 * MINUTE, site=1, earliest=4 * MINUTE, latest=5 * MINUTE)
    b = replace(b, setup_duration=9 * MINUTE, site=1)
    c = replace(c, setup_duration=2 * MINUTE)
    problem = tiny_problem(a, b, c, d, truck=replace(truck, drones=drones))
    decision = TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),))
    route = schedule(problem, RouteDecision(0, 0, (decision,)))
    trip = route.trips[0]
    # b is where a is; the launch waits for the setup at a
    assert trip.stops[1:3] == (stop_at(1, 2, 5, 10), stop_at(2, 12, 12, 17))
    assert [stop.setup for stop in trip.stops] == list(minutes(0, 3, 0, 0))
    assert trip.sorties[0].launch_time == 6 * MINUTE
    assert trip.sorties[0].visits == (Visit(3, *minutes(8, 10, 15)),)
    assert trip.sorties[0].visits[0].setup == 2 * MINUTE
    assert check(problem, Solution((route,), (4,))).violations == ()
    late = tiny_problem(replace(a, latest=5 * MINUTE - 1), b, c, d, truck=problem.vehicle_types[0])
    violation, = check(late, Solution((route,), (4,))).violations
    assert (violation.code, violation.path) == ("TIME_WINDOW", "routes[0].trips[0].stops[1]")


def test_a_trip_leaves_as_late_as_parcels_have_to_be_fresh(tiny_problem, customers, truck, drones):
    a, b, c, d = customers
    b = replace(b, earliest=40 * MINUTE, max_time_aboard=10 * MINUTE)
    c = replace(c, max_time_aboard=5 * MINUTE)
    problem = tiny_problem(a, b, c, d, truck=replace(truck, max_trips=2, drones=drones))
    trips = (TripDecision((0, 4, 0)), TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),)))
    route = schedule(problem, RouteDecision(0, 0, trips))
    # back at 21, and b opens at 40: to leave at 30 is soon enough; c is flown to by 35
    assert route.trips[1].stops[:3] == (stop_at(0, 30, 30, 30), stop_at(1, 32, 32, 37),
                                        stop_at(2, 39, 40, 45))
    assert check(problem, Solution((route,))).violations == ()
    fresher = tiny_problem(a, b, replace(c, max_time_aboard=5 * MINUTE - 1), d,
                           truck=problem.vehicle_types[0])
    late = schedule(fresher, RouteDecision(0, 0, trips))
    violation, = check(fresher, Solution((late,))).violations
    assert (violation.code, violation.path) == (
        "TIME_ABOARD", "routes[0].trips[1].sorties[0].visits[0]")


def test_two_drones_are_launched_and_recovered_one_after_another(
    tiny_problem, customers, truck, drones
):
    problem = tiny_problem(*customers, truck=replace(truck, drones=replace(drones, count=2)))
    sorties = (SortieDecision((3,), 1, 2, 0), SortieDecision((4,), 1, 2, 1))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), sorties))
    assert [sortie.launch_time for sortie in trip.sorties] == [3 * MINUTE, 4 * MINUTE]
    assert [sortie.recovery_start for sortie in trip.sorties] == [11 * MINUTE, 14 * MINUTE]
    assert trip.stops[2] == stop_at(2, 9, 9, 15)


def test_drone_is_recovered_before_it_is_launched_again(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones))
    sorties = (SortieDecision((3,), 1, 1), SortieDecision((4,), 1, 2))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), sorties))
    assert trip.sorties[0].recovery_time == 13 * MINUTE
    assert trip.sorties[1].launch_time == 14 * MINUTE


def test_loop_that_is_back_sooner_ends_before_another_drone_is_launched_again(
    tiny_problem, customers, truck, drones
):
    instant = replace(drones, count=2, launch_duration=0, recovery_duration=0)
    problem = tiny_problem(*customers, truck=replace(truck, drones=instant))
    sorties = (SortieDecision((2,), 1, 1, 1), SortieDecision((3,), 1, 1, 0),
               SortieDecision((4,), 1, 1, 0))
    route = schedule(problem, RouteDecision(0, 0, (TripDecision((0, 1, 0), sorties),)))
    assert [sortie.recovery_start for sortie in route.trips[0].sorties] == list(minutes(9, 11, 22))
    assert check(problem, Solution((route,), ())).is_feasible


def test_battery_is_swapped_before_each_launch_of_a_trip_but_the_first(
    tiny_problem, customers, truck, drones
):
    swapping = replace(drones, count=2, swap_duration=3 * MINUTE)
    problem = tiny_problem(*customers, truck=replace(truck, drones=swapping))
    sorties = (SortieDecision((3,), 1, 1, 0), SortieDecision((4,), 1, 2, 1),
               SortieDecision((2,), 2, 2, 0))
    trip = one_trip(problem, TripDecision((0, 1, 0), sorties))
    # the first is swapped for the second drone; at the depot from minute 15, which is back at 19
    assert [sortie.launch_time for sortie in trip.sorties] == list(minutes(3, 7, 24))
    assert [sortie.recovery_start for sortie in trip.sorties] == list(minutes(12, 19, 33))
    decision = read_decision(trip, problem.vehicle_types[0])
    assert schedule(problem, RouteDecision(0, 0, (decision,))).trips == (trip,)


def test_battery_is_swapped_again_once_the_truck_has_reloaded(
    tiny_problem, customers, truck, drones
):
    swapping = replace(drones, swap_duration=3 * MINUTE)
    problem = tiny_problem(*customers, truck=replace(truck, max_trips=2, drones=swapping))
    loops = tuple(TripDecision((0, 0), (SortieDecision((node,), 0, 0),)) for node in (1, 2))
    first, second = schedule(problem, RouteDecision(0, 0, loops)).trips
    begin = second.stops[0].arrival
    assert (first.sorties[0].launch_time, second.sorties[0].launch_time) == (MINUTE, begin + MINUTE)


def test_order_of_operations_is_a_choice(tiny_problem, customers, truck, drones):
    problem = tiny_problem(*customers, truck=replace(truck, drones=replace(drones, count=2)))
    sorties = (SortieDecision((3,), 0, 1, 0), SortieDecision((4,), 1, 2, 1))
    recover_first = TripDecision((0, 1, 2, 0), sorties)
    launch_first = replace(recover_first, operations=(
        (Operation(0, True),), (Operation(1, True), Operation(0, False)), (Operation(1, False),),
        (),
    ))
    # the truck is at a from minute 3, the first drone from minute 11
    assert one_trip(problem, recover_first).sorties[1].launch_time == 13 * MINUTE
    trip = one_trip(problem, launch_first)
    assert trip.sorties[1].launch_time == 4 * MINUTE
    assert trip.sorties[0].recovery_start == 11 * MINUTE
    assert read_decision(trip, problem.vehicle_types[0]).operations == launch_first.operations


def test_operation_without_duration_is_read_before_one_that_begins_with_it(
    tiny_problem, customers, truck, drones
):
    instant = replace(drones, count=2, launch_duration=0, service_duration=0)
    problem = tiny_problem(*customers, truck=replace(truck, drones=instant))
    sorties = (SortieDecision((3,), 0, 2, 0), SortieDecision((4,), 2, 3, 1))
    operations = ((Operation(0, True),), (), (Operation(1, True), Operation(0, False)),
                  (Operation(1, False),))
    trip = one_trip(problem, TripDecision((0, 1, 2, 0), sorties, operations))
    assert trip.sorties[1].launch_time == trip.sorties[0].recovery_start == 9 * MINUTE
    assert read_decision(trip, problem.vehicle_types[0]).operations == operations


@pytest.mark.parametrize("decision", [
    lambda: TripDecision((0,)),
    lambda: TripDecision((0, 1, 0), (SortieDecision((2,), 1, 3),)),
    lambda: TripDecision((0, 1, 0), (SortieDecision((2,), 2, 1),)),
    lambda: TripDecision((0, 0), (SortieDecision((2,), 0, 1),), ((Operation(0, True),), ())),
])
def test_decision_refuses_what_has_no_times(decision):
    with pytest.raises(ValueError, match="not allowed"):
        decision()


@pytest.mark.parametrize("decision", [
    RouteDecision(1, 0, ()),
    RouteDecision(0, 0, (TripDecision((0, 9, 0)),)),
    RouteDecision(0, 0, (TripDecision((0, 0, 0)),)),
    RouteDecision(0, 0, (TripDecision((1, 0)),)),
    RouteDecision(0, 0, (TripDecision((0, 0), (SortieDecision((1,), 0, 0),)),)),
])
def test_schedule_refuses_unknown_nodes_types_and_drones(
    decision, tiny_problem, customers, truck
):
    with pytest.raises(ValueError, match="not allowed"):
        schedule(tiny_problem(*customers, truck=truck), decision)
