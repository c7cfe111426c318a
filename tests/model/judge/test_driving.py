"""What counts as work and as driving, and what interrupts it; a street of ten minutes a step."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.breaks import BreakDecision
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    REST, UNLIMITED, Break, Customer, Depot, DrivingRules, Problem, Travel, VehicleType,
)
from model.solution import Solution

MINUTE = 60_000


def street(rules: DrivingRules, *customers: Customer,
           breaks: tuple[Break, ...] = ()) -> Problem:
    """Return customers ten minutes apart from each other, and from the depot."""
    places = np.arange(len(customers) + 1)
    legs = np.abs(places[:, None] - places) * 10 * MINUTE
    van = VehicleType("van", 1, (9,), 0, driving=rules, breaks=breaks)
    return Problem((Depot("hub"),), customers, (van,), (Travel(legs, legs),),
                   np.zeros((len(places), 2)), unassigned_cost=1.0)


def broken(problem: Problem, *breaks: BreakDecision) -> set[str]:
    """Return the codes of what is broken if all are served in order, with some breaks."""
    nodes = (0, *range(1, problem.num_nodes), 0)
    route = schedule(problem, RouteDecision(0, 0, (TripDecision(nodes, breaks=breaks),)))
    return {violation.code for violation in check(problem, Solution((route,))).violations}


@pytest.mark.parametrize(("length", "is_work"), [(4, True), (5, False), (9, False)])
def test_breaks_too_short_for_a_part_of_a_rest_are_work(length: int, is_work: bool) -> None:
    """Driving takes 20 minutes."""
    rules = DrivingRules(UNLIMITED, 10 * MINUTE, (5 * MINUTE, 8 * MINUTE), max_work=20 * MINUTE)
    short = Break("short", length * MINUTE, 0, UNLIMITED)
    problem = street(rules, Customer("a", (1,)), breaks=(short,))
    assert broken(problem, BreakDecision(0, 0, "arrival")) == ({"DRIVING"} if is_work else set())


def test_without_parts_all_that_is_no_rest_is_work() -> None:
    rules = DrivingRules(UNLIMITED, 10 * MINUTE, max_work=20 * MINUTE)
    for length, found in ((9, {"DRIVING"}), (10, set[str]())):
        short = Break("short", length * MINUTE, 0, UNLIMITED)
        problem = street(rules, Customer("a", (1,)), breaks=(short,))
        assert broken(problem, BreakDecision(0, 0, "arrival")) == found


INTERRUPTED = DrivingRules(15 * MINUTE, 10 * MINUTE, other_work_interrupts=True)


@pytest.mark.parametrize(("customer", "is_legal"), [
    (Customer("served", (1,), service_duration=10 * MINUTE), True),
    (Customer("shortly", (1,), service_duration=9 * MINUTE), False),
    (Customer("waited for", (1,), service_duration=4 * MINUTE, earliest=16 * MINUTE), True),
    (Customer("set up", (1,), service_duration=4 * MINUTE, setup_duration=6 * MINUTE), True)])
def test_whatever_is_done_at_a_stop_interrupts_driving(customer: Customer,
                                                       is_legal: bool) -> None:
    assert broken(street(INTERRUPTED, customer)) == (set() if is_legal else {"DRIVING"})
    plain = replace(INTERRUPTED, other_work_interrupts=False)
    assert broken(street(plain, customer)) == {"DRIVING"}


def test_stops_at_one_place_are_one_interruption() -> None:
    problem = street(INTERRUPTED, *[Customer(name, (1,), service_duration=5 * MINUTE)
                                    for name in "ab"])
    legs = np.array([[0, 10, 10], [10, 0, 0], [10, 0, 0]]) * MINUTE
    assert broken(replace(problem, travel=(Travel(legs, legs),))) == set()
    assert broken(problem) == {"DRIVING"}


def test_interruptions_are_no_rest_from_work() -> None:
    rules = replace(INTERRUPTED, max_work=29 * MINUTE)
    customer = Customer("a", (1,), service_duration=10 * MINUTE)
    assert broken(street(rules, customer)) == {"DRIVING"}
    rest = BreakDecision(REST, 0, "arrival", 0, 10 * MINUTE)
    assert broken(street(rules, customer), rest) == set()


def test_nobody_drives_for_longer_in_a_day_by_interruptions() -> None:
    rules = replace(INTERRUPTED, max_driving_per_day=19 * MINUTE)
    assert broken(street(rules, Customer("a", (1,), service_duration=10 * MINUTE))) == {"DRIVING"}


def test_how_far_a_truck_goes_by_other_legs_than_it_drives_may_be_limited() -> None:
    plain = street(DrivingRules(UNLIMITED, 0), Customer("a", (1,)), Customer("b", (1,)))
    legs = np.arange(9).reshape(3, 3)
    far = int(legs[0, 1] + legs[1, 2] + legs[2, 0])
    for most, found in ((far, set[str]()), (far - 1, {"DISTANCE"})):
        van = replace(plain.vehicle_types[0], driving=None, limited=1, max_distance=most)
        assert broken(replace(plain, vehicle_types=(van,),
                              travel=(*plain.travel, Travel(legs, legs)))) == found
