"""What is aboard, by hand-computed cases: a at km 1, b at km 2, c to fly to, d at km 4."""

from dataclasses import replace

import pytest

from model.counsel.explain import explain
from model.judge.check import check
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.solution import Solution
from tests.model.remedies import applied

C_BY_DRONE = TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2),), start=0)
IN_TURN = TripDecision((0, 1, 2, 0), start=0)


def judged(problem, trip):
    """Judge one route of this trip; whoever isn't on it is left out."""
    served = {*trip.nodes, *(node for sortie in trip.sorties for node in sortie.nodes)}
    rest = tuple(node for node in range(1, problem.num_nodes) if node not in served)
    return check(problem, Solution((schedule(problem, RouteDecision(0, 0, (trip,))),), rest))


def codes(evaluation):
    return [violation.code for violation in evaluation.violations]


def test_pickups_stay_aboard_until_the_trip_ends(tiny_problem, customers, truck):
    a, b = (replace(customer, pickup=(pickup,)) for customer, pickup
            in zip(customers[:2], (4000, 500), strict=True))
    trip = judged(tiny_problem(a, b, truck=truck), IN_TURN).routes[0].trips[0]
    assert trip.stop_loads == ((2000,), (5000,), (4500,), (4500,))
    assert (trip.load, trip.highest_load, trip.load_rate) == ((2000,), (5000,), 0.5)


def test_what_is_delivered_makes_room_for_what_is_picked_up(tiny_problem, customers, truck):
    a, b = (replace(customer, demand=(5000,), pickup=(5000,)) for customer in customers[:2])
    assert codes(judged(tiny_problem(a, b, truck=truck), IN_TURN)) == []
    more = replace(a, pickup=(5001,))
    assert codes(judged(tiny_problem(more, b, truck=truck), IN_TURN)) == ["CAPACITY"]
    # Behind b, a's pickup comes when b's parcel is gone, and b's is aboard.
    assert codes(judged(tiny_problem(more, replace(b, pickup=(4999,)), truck=truck),
                        TripDecision((0, 2, 1, 0), start=0))) == []


def test_what_a_drone_picks_up_is_the_trucks_from_its_recovery_on(
        tiny_problem, customers, truck, drones):
    a, b, c = customers[:3]
    problem = tiny_problem(a, b, replace(c, pickup=(3000,)), truck=replace(truck, drones=drones))
    trip = judged(problem, C_BY_DRONE).routes[0].trips[0]
    assert trip.stop_loads == ((3000,), (1000,), (3000,), (3000,))
    assert trip.sorties[0].loads == ((1000,), (3000,))


def test_a_drone_lifts_what_is_aboard_at_each_point(tiny_problem, customers, truck, drones):
    a, b, c = customers[:3]
    both = replace(drones, max_customers_per_sortie=2, capacity=(3000,), endurance=10**9)
    flown = TripDecision((0, 1, 0), (SortieDecision((2, 3), 1, 1),), start=0)
    for there, allowed in (((1000, 2000), True), ((1000, 2001), False)):
        served = (a, replace(b, demand=(2000,), pickup=(there[0],)),
                  replace(c, demand=(1000,), pickup=(there[1],)))
        problem = tiny_problem(*served, truck=replace(truck, drones=both))
        assert codes(judged(problem, flown)) == ([] if allowed else ["PAYLOAD"])


@pytest.mark.parametrize(("order", "broken"), [
    ((1, 2), []), ((2, 1), ["PICKUP_ORDER"]), ((2,), ["PICKUP_ORDER"]), ((1,), [])])
def test_a_truck_picks_up_last(order, broken, tiny_problem, customers, truck):
    a, b = customers[0], replace(customers[1], demand=(0,), pickup=(1000,))
    problem = tiny_problem(a, b, truck=replace(truck, pickups="last"))
    assert codes(judged(problem, TripDecision((0, *order, 0), start=0))) == broken


def test_who_delivered_before_may_begin_with_a_pickup(tiny_problem, customers, truck):
    b = replace(customers[1], demand=(0,), pickup=(1000,))
    problem = tiny_problem(customers[0], b,
                           truck=replace(truck, pickups="last", has_delivered=True))
    assert codes(judged(problem, TripDecision((0, 2, 0), start=0))) == []


def test_a_parcel_leaves_no_later_by_drone_than_the_first_pickup_comes(
        tiny_problem, customers, truck, drones):
    a, b, c = customers[:3]
    last = replace(truck, pickups="last", drones=drones)
    early = replace(a, pickup=(1000,))
    # c's parcel leaves at a's stop, where a's pickup comes aboard; b's leaves behind it.
    assert codes(judged(tiny_problem(early, replace(b, demand=(0,)), c, truck=last),
                        C_BY_DRONE)) == []
    assert codes(judged(tiny_problem(early, b, c, truck=last), C_BY_DRONE)) == ["PICKUP_ORDER"]


def test_driving_a_load_costs(tiny_problem, customers, truck):
    loaded = replace(truck, cost_per_load_km=2.0, initial_load=(1000,))
    a, b = replace(customers[0], pickup=(500,)), customers[1]
    problem = tiny_problem(a, b, truck=loaded)
    # 3 units for 1 km, 2.5 for 1 km, 1.5 for 2 km
    assert judged(problem, IN_TURN).cost.distance == pytest.approx(2.0 * (3.0 + 2.5 + 3.0))


def test_a_reason_tells_that_a_pickup_is_too_much(tiny_problem, customers, truck):
    *others, d = customers
    problem = tiny_problem(*others, replace(d, pickup=(10_500,)), truck=truck)
    reason, = explain(problem, Solution((), (1, 2, 3, 4)), 4)
    assert (reason.code, reason.message, reason.remedy) == (
        "CAPACITY", "Its pickup of 10.5 exceeds the capacity of 10.",
        "fits if capacity were at least 10.5")


def test_a_reason_tells_that_nothing_can_be_delivered_first(tiny_problem, customers, truck):
    pickups = [replace(customer, demand=(0,), pickup=(1000,)) for customer in customers]
    last = replace(truck, pickups="last")
    problem = tiny_problem(*pickups, truck=last)
    reason, = explain(problem, Solution((), (1, 2, 3, 4)), 4)
    assert (reason.code, reason.remedy) == ("PICKUP_ORDER",
                                            "fits if truck may pick up at any time")
    reason, = explain(applied(problem, reason, 4), Solution((), (1, 2, 3, 4)), 4)
    assert reason.code == "SEARCH"
    host = tiny_problem(customers[0], *pickups[1:], truck=last)
    reason, = explain(host, Solution((), (1, 2, 3, 4)), 4)
    assert (reason.code, reason.message) == (
        "SEARCH", "truck could serve it after a, but the search did not find room for it.")
