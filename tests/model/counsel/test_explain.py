from dataclasses import replace

import numpy as np
import pytest

from model.counsel.explain import explain
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    MAX_MONEY, MAX_QUANTITY, UNLIMITED, UNREACHABLE, DrivingRules, IncompatibleGoods, Overtime,
    SpeedProfile, Travel,
)
from model.solution import Solution
from tests.model.remedies import applied, told

MINUTE = 60_000
KM = 1_000_000

NOBODY_SERVED = Solution((), (1, 2, 3, 4))

# d is at km 4: reached by truck at 8, served until 13, back at 21


def reason_for_d(problem, solution=NOBODY_SERVED):
    (reason,) = explain(problem, solution, 4)
    return reason


@pytest.mark.parametrize(("code", "on_truck", "on_customer", "message", "remedy"), [
    ("SKILLS", {"skills": frozenset({"lift"})}, {"skills": frozenset({"lift", "crane"})},
     "truck lacks crane.", "fits if truck had crane"),
    ("CAPACITY", {}, {"demand": (10_500,)}, "Its demand of 10.5 exceeds the capacity of 10.",
     "fits if capacity were at least 10.5"),
    ("TIME_WINDOW", {}, {"latest": 7 * MINUTE},
     "The earliest arrival is 1 minute after its window closes.",
     "fits if its window closed 1 minute later"),
    ("TIME_WINDOW", {"earliest": 10 * MINUTE}, {"latest": 6 * MINUTE - 1},
     "The earliest arrival is 12.1 minutes after its window closes.",
     "fits if its window closed 12.1 minutes later"),
    ("SHIFT", {"latest": 19 * MINUTE}, {}, "truck would be back 2 minutes after its shift ends.",
     "fits if truck's shift ended 2 minutes later"),
    ("WORKING_HOURS", {"max_working_duration": 20 * MINUTE}, {"earliest": 60 * MINUTE},
     "Serving it alone takes 1 minute more than truck may work.",
     "fits if truck could work 1 minute longer"),
    ("RANGE", {"max_trip_distance": 7 * KM - 1}, {},
     "A trip there and back is 1.1 km longer than a trip may be.",
     "fits if trips could be 1.1 km longer"),
    ("DISTANCE", {"max_distance": 7 * KM - 1}, {},
     "The way there and back is 1.1 km more than truck may drive.",
     "fits if truck could drive 1.1 km farther"),
    ("TRAVEL_DURATION", {"max_travel_duration": 15 * MINUTE}, {},
     "The way there and back takes 1 minute more than truck may travel.",
     "fits if truck could travel 1 minute longer"),
    ("DRIVING", {"driving": DrivingRules(9 * MINUTE, MINUTE, (), 15 * MINUTE)}, {},
     "Serving it alone takes 1 minute more than drivers of truck may be at the wheel in a day.",
     "fits if truck's drivers could drive 16 minutes a day"),
    ("SHIFT", {"latest": 10 * MINUTE, "overtime": Overtime(1.0, 9 * MINUTE)}, {},
     "truck would be back 2 minutes after its shift and all the overtime allowed.",
     "fits if truck could work 2 minutes more overtime"),
    ("WORKING_HOURS", {"max_working_duration": 20 * MINUTE, "overtime": Overtime(1.0, 0)}, {},
     "Serving it alone takes 1 minute more than truck may work with all the overtime allowed.",
     "fits if truck could work 1 minute more overtime"),
    ("STOPS", {"max_stops": 0}, {}, "truck serves nobody itself, by its max_stops.",
     "fits if truck could make 1 stop"),
    ("SHIFT", {"latest": 19 * MINUTE, "max_working_duration": MINUTE}, {},
     "truck would be back 2 minutes after its shift ends.",
     "fits if truck's shift ended 2 minutes later and if truck could work 20 minutes longer"),
    ("KIND", {}, {"served_by": "drone"}, "Only a drone may serve it and truck carries none.",
     "fits if a truck may serve it"),
    ("KIND", {"latest": 0}, {"served_by": "drone"},
     "Only a drone may serve it and truck carries none.", None),
])
def test_reason_names_the_rule_and_a_remedy_that_works(
    code, on_truck, on_customer, message, remedy, tiny_problem, customers, truck
):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, **on_customer), truck=replace(truck, **on_truck))
    reason = reason_for_d(problem)
    assert told(reason) == (0, code, message, *filter(None, [remedy]))
    assert [len(each.parts) for each in reason.remedies] == [
        remedy.count(" and if ") + 1 for remedy in filter(None, [remedy])]


@pytest.mark.parametrize(("code", "on_drones", "message", "remedy"), [
    ("CAPACITY", {"capacity": (900,)}, "Its demand of 1 exceeds the drone capacity of 0.9.",
     "fits if the drone capacity were at least 1"),
    # 4 minutes there, 5 of service, 4 back; from c's place still 7
    ("RANGE", {"endurance": 6 * MINUTE},
     "A flight from the depot and back lasts 7 minutes more than the endurance.",
     "fits if endurance were 7 minutes longer"),
    # 4 km from the depot, 1 km from c's place
    ("RANGE", {"max_range": KM // 2, "straight": 1},
     "It lies 3.5 km farther away than the max_range.",
     "fits if max_range were 3.5 km longer"),
    ("WIND", {"storms": ((0, UNLIMITED),)},
     "The wind is too strong for a flight there and back, by max_wind_kmh.",
     "fits without max_wind_kmh"),
    ("SORTIES", {"batteries": 0}, "No drone of truck takes off, by its batteries.",
     "fits if truck carried 1 battery"),
])
def test_reason_of_a_drone(code, on_drones, message, remedy, tiny_problem, customers, truck,
                           drones):
    *others, d = customers
    carrier = replace(truck, drones=replace(drones, **on_drones))
    problem = tiny_problem(*others, replace(d, served_by="drone"), truck=carrier)
    reason = reason_for_d(problem)
    assert told(reason) == (0, code, message, remedy)
    assert reason_for_d(applied(problem, reason, 4)).code == "SEARCH"


def test_reason_of_who_flies_in_a_storm(tiny_problem, customers, truck):
    flyer = replace(truck, flies=True, storms=((0, UNLIMITED),))
    problem = tiny_problem(*customers, truck=flyer)
    reason = reason_for_d(problem)
    assert told(reason) == (0, "WIND", "The wind is too strong for a flight there and back, by "
                            "max_wind_kmh.", "fits without max_wind_kmh")
    assert reason_for_d(applied(problem, reason, 4)).code == "SEARCH"
    over = replace(flyer, storms=((0, 30 * MINUTE),))
    assert reason_for_d(tiny_problem(*customers, truck=over)).code == "SEARCH"


def test_reason_of_who_lies_in_a_zone_that_stays_closed(tiny_problem, customers, truck, drones):
    *others, d = customers
    closed = replace(d, served_by="drone", zones=2)
    for until, code in ((UNLIMITED, "AIRSPACE"), (30 * MINUTE, "SEARCH")):
        carrier = replace(truck, drones=replace(drones, closings=((0, until, 2),)))
        reason = reason_for_d(tiny_problem(*others, closed, truck=carrier))
        assert reason.code == code
        if code == "AIRSPACE":
            assert told(reason) == (0, code, "No flight there and back is over before a zone is "
                                    "closed, or begins behind.", "fits if a truck may serve it")
    other = replace(truck, drones=replace(drones, closings=((0, UNLIMITED, 1),)))
    assert reason_for_d(tiny_problem(*others, closed, truck=other)).code == "SEARCH"


def test_no_drone_may_take_off(tiny_problem, customers, truck, drones):
    *others, d = [replace(customer, launch=False) for customer in customers]
    problem = tiny_problem(*others, replace(d, served_by="drone"),
                           truck=replace(truck, drones=drones))
    (depot,) = problem.depots
    problem = replace(problem, depots=(replace(depot, launch=False),))
    reason = reason_for_d(problem)
    assert told(reason) == (0, "LAUNCH", f"No drone takes off at {depot.id}, by its launch.",
                            f"fits if drones may take off at {depot.id}")
    helped = applied(problem, reason, 4)
    assert reason_for_d(helped).code == "SEARCH"


def test_no_flight_leads_there(tiny_problem, customers, truck, drones):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, served_by="drone"),
                           truck=replace(truck, drones=drones))
    closed = problem.travel[1].duration[:].copy()
    closed[:4, 4] = UNREACHABLE
    travel = (problem.travel[0], Travel(closed, problem.travel[1].distance))
    reason = reason_for_d(replace(problem, travel=travel))
    assert (reason.code, reason.remedy) == ("RANGE", "fits if a truck may serve it")


def serve(problem, *nodes):
    """One vehicle for each node."""
    return tuple(schedule(problem, RouteDecision(0, vehicle, (TripDecision((0, node, 0)),)))
                 for vehicle, node in enumerate(nodes))


def test_a_setup_makes_it_late(tiny_problem, customers, truck):
    *others, d = customers
    problem = tiny_problem(
        *others, replace(d, setup_duration=2 * MINUTE, latest=9 * MINUTE), truck=truck)
    assert told(reason_for_d(problem)) == (
        0, "TIME_WINDOW", "The earliest arrival is 1 minute after its window closes.",
        "fits if its window closed 1 minute later")


def test_a_parcel_is_aboard_too_long(tiny_problem, customers, truck):
    *others, d = customers
    # the way to d takes 8 minutes, from whenever the truck leaves
    problem = tiny_problem(
        *others, replace(d, max_time_aboard=7 * MINUTE, earliest=60 * MINUTE), truck=truck)
    assert told(reason_for_d(problem)) == (
        0, "TIME_ABOARD", "Its parcel would be aboard 1 minute longer than it may be.",
        "fits if it could be aboard 1 minute longer")


def test_goods_of_one_customer_may_not_go_together(tiny_problem, customers, truck):
    *others, d = customers
    problem = replace(
        tiny_problem(*others, replace(d, goods=frozenset({"food", "paint", "ice"})), truck=truck),
        incompatible_goods=(IncompatibleGoods(frozenset({"paint", "food"})),))
    assert told(reason_for_d(problem)) == (
        0, "GOODS", "Its own food and paint may not be carried together.")


def test_one_more_vehicle_would_do(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    reason = reason_for_d(problem, Solution(serve(problem, 1, 2), (3, 4)))
    assert told(reason) == (0, "FLEET_EXHAUSTED", "truck could serve it alone, but all 2 are in "
                            "use.", "fits with one more vehicle")


def test_leaving_out_is_cheaper(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=replace(truck, fixed_cost=12.5, cost_per_km=1.0),
                           unassigned_cost=20.0)
    reason = reason_for_d(problem, Solution(serve(problem, 1), (2, 3, 4)))
    assert (reason.code, reason.remedy) == ("COST", "served if unassigned_cost were above 20.50")


def test_one_more_vehicle_would_not_do_where_leaving_out_is_cheaper(tiny_problem, customers,
                                                                    truck):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, unassigned_cost=20.0),
                           truck=replace(truck, fixed_cost=12.5, cost_per_km=1.0))
    reason = reason_for_d(problem, Solution(serve(problem, 1, 2), (3, 4)))
    assert told(reason) == (0, "COST", "truck could serve it alone at a cost of 20.50; leaving it "
                            "out costs 20.00, and all 2 are in use.")


def test_only_the_other_type_may_serve_it(tiny_problem, customers, truck, drones):
    table = np.array([[True, True, True, False], [True] * 4])
    problem = replace(tiny_problem(*customers, truck=replace(truck, drones=drones),
                                   more_types=(replace(truck, id="van"),)), may_serve=table)
    reason, other = explain(problem, Solution((), (4,)), 4)
    assert told(reason) == (0, "VEHICLE", "truck may not serve it.", "fits if truck may serve it")
    assert other.code == "SEARCH"


def test_leaving_out_this_one_is_cheaper(tiny_problem, customers, truck):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, unassigned_cost=20.0),
                           truck=replace(truck, fixed_cost=12.5, cost_per_km=1.0))
    reason = reason_for_d(problem, Solution(serve(problem, 1), (2, 3, 4)))
    assert (reason.code, reason.message, reason.remedy) == (
        "COST", "truck could serve it alone at a cost of 20.50; leaving it out costs 20.00.",
        "served if its unassigned_cost were above 20.50")
    changed = applied(problem, reason, 4)
    assert changed.unassigned_cost == problem.unassigned_cost
    assert reason_for_d(changed, Solution(serve(changed, 1), (2, 3, 4))).code == "SEARCH"


@pytest.mark.parametrize(("on_truck", "on_customer", "code"), [
    ({}, {"latest": MAX_QUANTITY - 1, "release_time": MAX_QUANTITY - 1}, "TIME_WINDOW"),
    ({"latest": MAX_QUANTITY}, {"earliest": MAX_QUANTITY - 1}, "SHIFT"),
    ({"fixed_cost": MAX_MONEY, "cost_per_km": 1.0}, {}, "COST"),
])
def test_no_remedy_asks_for_what_no_request_can_state(on_truck, on_customer, code, tiny_problem,
                                                      customers, truck):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, **on_customer), truck=replace(truck, **on_truck))
    reason = reason_for_d(problem)
    assert (reason.code, reason.remedy) == (code, None)


def test_search_left_it_out(tiny_problem, customers, truck):
    problem = tiny_problem(*customers, truck=truck)
    reason = reason_for_d(problem, Solution(serve(problem, 1), (2, 3, 4)))
    assert (reason.code, reason.remedy) == ("SEARCH", None)


def test_drone_from_another_stop_counts(tiny_problem, customers, truck, drones):
    *others, d = customers
    near = replace(truck, drones=replace(drones, endurance=7 * MINUTE))
    problem = tiny_problem(*others, replace(d, served_by="drone"), truck=near)
    reason = reason_for_d(problem, Solution(serve(problem, 1, 2), (3, 4)))
    assert (reason.code, reason.remedy) == ("FLEET_EXHAUSTED", None)
    assert reason.message == ("A drone of truck could serve it from a stop at c, "
                              "but all 2 are in use.")


def test_drone_is_tried_where_the_truck_fails(tiny_problem, customers, truck, drones):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, latest=5 * MINUTE),  # by air 5, by road 8
                           truck=replace(truck, drones=drones))
    assert reason_for_d(problem).code == "SEARCH"


def test_drone_leaves_late_enough_not_to_wait(tiny_problem, customers, truck, drones):
    *others, d = customers
    carrier = replace(truck, drones=replace(drones, endurance=13 * MINUTE))
    problem = tiny_problem(*others, replace(d, served_by="drone", earliest=60 * MINUTE),
                           truck=carrier)
    assert reason_for_d(problem).code == "SEARCH"


def test_later_start_avoids_slow_hours(tiny_problem, customers, truck):
    slow_first = replace(truck, speed_profile=SpeedProfile((30 * MINUTE,), (500_000, 1_000_000)),
                         max_working_duration=21 * MINUTE)
    problem = tiny_problem(*customers, truck=slow_first)
    assert reason_for_d(problem).code == "SEARCH"  # fits from minute 30 on
    closing = replace(slow_first, latest=50 * MINUTE)
    assert reason_for_d(tiny_problem(*customers, truck=closing)).code == "WORKING_HOURS"


def test_each_vehicle_type_has_its_reason(tiny_problem, customers, truck):
    small = replace(truck, id="van", capacity=(500,), depot=1)
    problem = tiny_problem(*customers, truck=truck, more_types=(small,), num_depots=2)
    reasons = explain(problem, Solution((), (2, 3, 4, 5)), 5)
    assert [(reason.vehicle_type, reason.code) for reason in reasons] == [
        (0, "SEARCH"), (1, "CAPACITY"),
    ]


def test_where_no_time_is_left_no_more_is_said_than_is_true(
    tiny_problem, customers, truck, monkeypatch
):
    monkeypatch.setattr("model.counsel.explain.attempts", None)
    problem = tiny_problem(*customers, truck=replace(truck, latest=19 * MINUTE))
    (reason,) = explain(problem, NOBODY_SERVED, 4, until=0.0)
    assert told(reason) == (0, "SEARCH", "The search found no room for it on truck; there was no "
                            "time left to find out whether there could be any.")


def test_who_is_left_out_after_the_time_is_told_so_for_each_type(tiny_problem, customers, truck):
    van = replace(truck, id="van", depot=1)
    problem = tiny_problem(*customers, truck=truck, more_types=(van,), num_depots=2)
    reasons = explain(problem, Solution((), (2, 3, 4, 5)), 5, until=0.0)
    assert [(reason.vehicle_type, reason.code, reason.remedy) for reason in reasons] == [
        (0, "SEARCH", None), (1, "SEARCH", None)]
    assert "on truck" in reasons[0].message
    assert "on van" in reasons[1].message
    assert reasons is explain(problem, Solution((), (2, 3, 4, 5)), 4, until=0.0)


def test_a_later_window_counts_if_it_fits(tiny_problem, customers, truck, drones):
    *others, d = customers
    several = replace(d, gaps=((7 * MINUTE, 40 * MINUTE),), latest=50 * MINUTE)
    hours = replace(truck, max_working_duration=21 * MINUTE)
    assert reason_for_d(tiny_problem(*others, several, truck=hours)).code == "SEARCH"
    short = replace(hours, latest=60 * MINUTE)
    assert reason_for_d(tiny_problem(*others, several, truck=short)).code == "SEARCH"
    closing = tiny_problem(*others, several, truck=replace(hours, latest=48 * MINUTE))
    reason = reason_for_d(closing)
    assert told(reason) == (0, "TIME_WINDOW", "The earliest arrival is 1 minute after its window 1 "
                            "closes, and window 2 is too late for truck.",
                            "fits if its window 1 closed 1 minute later")
    assert reason_for_d(applied(closing, reason, 4)).code == "SEARCH"
    ended = reason_for_d(tiny_problem(*others, replace(several, gaps=((MINUTE, 2 * MINUTE),),
                                                       latest=6 * MINUTE), truck=hours))
    assert (ended.code, ended.remedy) == ("TIME_WINDOW",
                                          "fits if its last window closed 2 minutes later")
    flown = replace(several, served_by="drone")
    assert reason_for_d(tiny_problem(*others, flown, truck=replace(
        truck, drones=replace(drones, endurance=14 * MINUTE)))).code == "SEARCH"
