"""What has happened by an instant, and the rules for plans that begin with it."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from model.counsel.bench import Bench, Setting
from model.judge.check import check
from model.judge.past import KnownStop, Past, known_trips
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Customer, DroneType, Problem, VehicleType
from model.solution import Route, Solution, Stop
from tests.model.street import MINUTE, ONE, TWO, A, B, C, D, planned


@pytest.fixture
def street(tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...],
           truck: VehicleType) -> Problem:
    """Four customers along a street, two trucks that cost a unit each km."""
    return tiny_problem(*customers, truck=replace(truck, cost_per_km=1.0))


@pytest.mark.parametrize(("now", "left", "bound"), [
    (0, 1, KnownStop(A, 2 * MINUTE, None, None)),
    (2, 1, KnownStop(A, 2 * MINUTE, 2 * MINUTE, None)),
    (7, 2, KnownStop(B, 9 * MINUTE, None, None)),
    (14, 3, KnownStop(0, 18 * MINUTE, 18 * MINUTE, None)),
])
def test_what_has_departed_is_known_and_where_it_is_bound_for(
        street: Problem, now: int, left: int, bound: KnownStop) -> None:
    plan = planned(street, ((A, B),), ((C,),))
    (trip,) = known_trips(street, plan, now * MINUTE, frozenset())[ONE]
    stops = plan.routes[0].trips[0].stops
    assert [stop.departure for stop in trip.stops[:-1]] == [
        stop.departure for stop in stops[:left]]
    assert trip.stops[-1] == bound
    assert (trip.aboard, trip.rest) == ({A, B}, "anything")


def test_nothing_is_known_before_the_first_departure(street: Problem) -> None:
    plan = planned(street, ((A, B),))
    assert known_trips(street, plan, -1, frozenset()) == {}
    (trip,) = known_trips(street, plan, 18 * MINUTE, frozenset())[ONE]
    assert (len(trip.stops), trip.rest) == (4, "nothing")


def test_checker_holds_a_plan_against_the_past(street: Problem) -> None:
    plan = planned(street, ((A, B, C),))
    known = known_trips(street, plan, 10 * MINUTE, frozenset())
    past = Past(10 * MINUTE, known, pinned={D: TWO})

    def codes(solution: Solution, past: Past = past) -> set[str]:
        return {item.code for item in check(street, solution, past).violations}

    def with_d(start: int, vehicle: int = 1) -> Solution:
        trip = TripDecision((0, D, 0), start=start * MINUTE)
        other = schedule(street, RouteDecision(0, vehicle, (trip,)))
        return Solution((*plan.routes, other))

    assert codes(with_d(10)) == set()
    assert codes(with_d(9)) == {"PAST"}
    assert codes(planned(street, ((A, B, C, D),))) == {"ABOARD", "PINNED"}
    assert codes(planned(street, ((A, C),))) >= {"FROZEN"}
    assert codes(Solution((), (A, B, C, D))) == {"FROZEN"}
    assert "UNAVAILABLE" in codes(with_d(10), replace(past, unavailable=frozenset({TWO})))
    assert codes(with_d(10), replace(past, returned={D: 11 * MINUTE})) == {"RETURN"}
    stolen = planned(street, ((A, B),), ((C,),))
    late = replace(stolen.routes[1].trips[0], stops=tuple(
        Stop(stop.node, stop.arrival + 10 * MINUTE, stop.service_start + 10 * MINUTE,
             stop.departure + 10 * MINUTE) for stop in stolen.routes[1].trips[0].stops))
    assert codes(Solution((stolen.routes[0], Route(0, 1, (late,))), (D,))) == {"ABOARD"}


@pytest.mark.parametrize("node", [A, C])
def test_who_was_served_or_flown_to_is_left_out_for_what_he_costs(
        tiny_problem: Callable[..., Problem], customers: tuple[Customer, ...], truck: VehicleType,
        drones: DroneType, node: int) -> None:
    problem = tiny_problem(*customers, truck=replace(
        truck, cost_per_km=1.0, drones=replace(drones, cost_per_km=1.0)))
    trip = TripDecision((0, A, B, 0), (SortieDecision((C,), 0, 1), SortieDecision((D,), 1, 2)),
                        start=0)
    plan = Solution((schedule(problem, RouteDecision(0, 0, (trip,))),))
    assert check(problem, plan).violations == ()
    now = plan.routes[0].trips[0].sorties[0].launch_time
    known = known_trips(problem, plan, now, frozenset())
    assert len(known[ONE][0].sorties) == 1
    bench = Bench(problem, plan, node, Setting(Past(now, known)))
    left_out, = bench.left_out.solution.routes
    served = {stop.node for stop in left_out.trips[0].stops} | {
        visit.node for sortie in left_out.trips[0].sorties for visit in sortie.visits}
    assert served == {0, A, B, C, D} - {node}
    assert bench.left_out.evaluation.cost.unassigned == problem.unassigned_cost
    assert {"FROZEN", "MISSING"} & {
        violation.code for violation in bench.left_out.evaluation.violations}
