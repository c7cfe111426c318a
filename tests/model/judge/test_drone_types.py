"""Drones of several types on one truck, by hand."""

from dataclasses import replace

import pytest

from model.counsel.explain import explain
from model.judge.check import check
from model.judge.past import Past, known_trips
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, read_decision, schedule
from model.problem import VehicleType
from model.solution import Solution, Vehicle

MINUTE = 60_000

# a at kilometre 1, b at 2, c at 3, d at 4; the second drone is of the other type
BOTH = TripDecision((0, 1, 2, 0), (SortieDecision((3,), 1, 2, 0), SortieDecision((4,), 1, 2, 1)),
                    start=0)


@pytest.fixture
def two_types(tiny_problem, customers, truck, drones):
    """Return a problem whose trucks carry a drone of each of two types, with changes of both."""
    def build(first=None, second=None, **changes):
        small = replace(drones, id="small", **(first or {}))
        large = replace(drones, id="large", **(second or {}))
        return tiny_problem(*customers, truck=replace(
            truck, drones=small, more_drones=(large,), **changes))

    return build


def plan(problem, trip=BOTH):
    route = schedule(problem, RouteDecision(0, 0, (trip,)))
    served = {*trip.nodes, *(node for sortie in trip.sorties for node in sortie.nodes)}
    return Solution((route,), tuple(sorted(set(range(1, problem.num_nodes)) - served)))


def codes(problem, solution):
    return [violation.code for violation in check(problem, solution).violations]


def test_each_drone_takes_the_time_of_its_type(two_types):
    slower = {"launch_duration": 4 * MINUTE, "recovery_duration": 3 * MINUTE,
              "service_duration": MINUTE}
    problem = two_types(second=slower)
    solution = plan(problem)
    # at a in minute 2: small takes off at 3, at c 5 to 10; large at 7, at d 10 to 11, at b 13.
    # The truck leaves a at 7, at b 9; small is at b in minute 11, recovered 12, large 13 to 16.
    small, large = solution.routes[0].trips[0].sorties
    assert (small.launch_time, small.recovery_start, small.recovery_time) == (
        3 * MINUTE, 11 * MINUTE, 12 * MINUTE)
    assert (large.launch_time, large.recovery_start, large.recovery_time) == (
        7 * MINUTE, 13 * MINUTE, 16 * MINUTE)
    assert codes(problem, solution) == []
    trip = solution.routes[0].trips[0]
    again = read_decision(trip, problem.vehicle_types[0])
    assert schedule(problem, RouteDecision(0, 0, (again,))).trips == (trip,)


def test_each_drone_flies_by_the_legs_of_its_type(two_types):
    problem = two_types(second={"travel": 0})
    small, large = plan(problem).routes[0].trips[0].sorties
    assert small.visits[0].arrival - small.launch_time == 2 * MINUTE
    assert large.visits[0].arrival - large.launch_time == 2 * 3 * MINUTE


@pytest.mark.parametrize(("code", "kept", "broken"), [
    ("PAYLOAD", {"capacity": (1000,)}, {"capacity": (999,)}),
    ("ENDURANCE", {"endurance": 10 * MINUTE}, {"endurance": 10 * MINUTE - 1}),
    ("BATTERIES", {"batteries": 1}, {"batteries": 0})])
def test_limits_of_a_drone_are_those_of_its_type(two_types, code, kept, broken):
    # large takes off at 4, is at d 7 to 12 and at b 14
    tight = {"capacity": (1000,), "endurance": 8 * MINUTE, "batteries": 1}
    solution = plan(two_types())
    assert codes(two_types(tight, kept), solution) == []
    assert codes(two_types(tight, broken), solution) == [code]


def test_there_are_as_many_drones_as_all_types_have(two_types):
    solution = plan(two_types(), replace(BOTH, sorties=(SortieDecision((3,), 1, 2, 2),)))
    assert codes(two_types(), solution) == ["COUNT"]
    assert codes(two_types({"count": 2}), solution) == []


def test_flights_cost_what_their_type_does(two_types):
    problem = two_types({"cost_per_km": 1.0, "cost_per_hour": 6.0},
                        {"cost_per_km": 10.0, "cost_per_hour": 60.0})
    cost = check(problem, plan(problem)).cost
    # small flies 2 + 1 km, from minute 3 to 12; large 3 + 2 km, from 4 to 15
    assert cost.distance == pytest.approx(3 * 1.0 + 5 * 10.0)
    assert cost.time == pytest.approx(9 * 0.1 + 11 * 1.0)


def test_only_the_first_launch_of_all_types_needs_no_swap(two_types):
    problem = two_types(second={"swap_duration": 2 * MINUTE})
    small, large = plan(problem).routes[0].trips[0].sorties
    assert (small.launch_time, large.launch_time) == (3 * MINUTE, 6 * MINUTE)
    swapped = replace(BOTH, sorties=(SortieDecision((4,), 1, 2, 1), SortieDecision((3,), 1, 2, 0)))
    large, small = plan(problem, swapped).routes[0].trips[0].sorties
    assert (large.launch_time, small.launch_time) == (3 * MINUTE, 4 * MINUTE)


def test_a_launch_has_begun_by_the_time_of_its_type(two_types):
    problem = two_types(second={"launch_duration": 4 * MINUTE})
    solution = plan(problem)
    # large takes off at 7, and its launch begins at 3
    trip, = known_trips(problem, solution, 3 * MINUTE, frozenset())[Vehicle(0, 0)]
    assert [sortie.drone for sortie in trip.sorties] == [0, 1]
    assert check(problem, solution, Past(3 * MINUTE, {Vehicle(0, 0): (trip,)})).violations == ()


def test_a_second_type_is_tried_before_a_customer_is_given_up(two_types):
    heavy = {"capacity": (0,)}
    problem = two_types(heavy)
    fourth = replace(problem.customers[3], served_by="drone")
    problem = replace(problem, customers=(*problem.customers[:3], fourth))
    nobody = Solution((), (1, 2, 3, 4))
    assert explain(problem, nobody, 4)[0].code == "SEARCH"
    kind = replace(problem.vehicle_types[0],
                   more_drones=(replace(problem.vehicle_types[0].more_drones[0], endurance=0),))
    reason, = explain(replace(problem, vehicle_types=(kind,)), nobody, 4)
    assert (reason.code, reason.remedy) == (
        "CAPACITY", "fits if the drone capacity of small were at least 1")


def test_drones_of_further_types_need_a_first() -> None:
    with pytest.raises(ValueError, match="more_drones"):
        VehicleType("truck", 1, (1,), 0, more_drones=(None,))  # type: ignore[arg-type]
