"""A customer goes where that costs least, on a trip as it is or a trip more; all were tried."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.problem import (
    MM_PER_KM, MOST_PICKUPS, UNLIMITED, Customer, Depot, Part, Problem, Shipment, Travel,
    VehicleType,
)
from model.search.beginning.construct import begin_anew
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.route.layout import ProblemData
from model.search.problem_data import make_data
from model.solution import Route, Solution
from tests.model.search.found import read_plan
from tests.model.tiny_legs import with_other_legs
from tests.seeds import seeds

pytestmark = pytest.mark.slow

MINUTE = 60_000
CUSTOMERS = 7
SHIPMENTS = 4
SEEDS = 40  # some of which let neither a blink nor a dear route of its own spoil the insertion

Trips = tuple[tuple[int, ...], ...]


def problem_with_trips(seed: int, number: int = CUSTOMERS) -> Problem:
    """Return a problem where distance alone costs, with several trips, windows and releases."""
    rng = np.random.default_rng(seed)
    place = rng.integers(-6, 7, (number + 1, 2))
    legs = np.abs(place[:, None] - place).sum(axis=2)
    travel = Travel((2 * MINUTE * legs).astype(np.int64), (MM_PER_KM * legs).astype(np.int64))
    customers = tuple(
        Customer(str(index), (int(rng.integers(1, 4)) * 1000,), int(rng.integers(0, 3)) * MINUTE,
                 latest=int(rng.integers(60, 240)) * MINUTE if rng.random() < 0.5 else UNLIMITED,
                 release_time=int(rng.integers(0, 50)) * MINUTE)
        for index in range(number))
    truck = VehicleType(
        "truck", 2, (6000,), 0, fixed_cost=60.0, cost_per_km=1.0, max_trips=4,
        reload_duration=2 * MINUTE, latest=int(rng.integers(250, 400)) * MINUTE,
        max_trip_distance=int(rng.integers(24, 40)) * MM_PER_KM if seed % 2 else None)
    return Problem((Depot("hub"),), customers, (truck,), (travel,), place.astype(np.float64),
                   unassigned_cost=1000.0)


def problem_by_time(seed: int, number: int = CUSTOMERS) -> Problem:
    """Return the same where hours cost, every other time, and windows may be missed at a cost."""
    rng = np.random.default_rng(seed)
    problem = problem_with_trips(seed, number)
    is_soft, is_timed = seed % 4 > 0, seed % 4 != 1
    customers = tuple(
        replace(customer, earliest=opens, latest=opens + int(rng.integers(10, 60)) * MINUTE,
                late_cost_per_hour=float(rng.integers(5, 60)) if is_soft else None,
                early_cost_per_hour=float(rng.integers(5, 30)) if seed % 4 == 3 else 0.0)
        for customer in problem.customers
        for opens in [customer.release_time + int(rng.integers(15, 60)) * MINUTE])
    truck = replace(problem.vehicle_types[0], cost_per_hour=6.0 if is_timed else 0.0)
    return replace(problem, customers=customers, vehicle_types=(truck,))


def problem_of_fresh_goods(seed: int) -> Problem:
    """Return one where parcels are soon too long aboard, at no hourly cost; every other with
    windows before which vehicles wait.
    """
    rng = np.random.default_rng(seed)
    problem = problem_by_time(4 * seed + 1) if seed % 2 else problem_with_trips(seed)
    return replace(problem, customers=tuple(
        replace(customer, max_time_aboard=int(rng.integers(20, 60)) * MINUTE)
        for customer in problem.customers))


def problem_of_shipments(seed: int) -> Problem:
    """Return one of shipments that several rules price: by lateness, by load, or by travel."""
    rng = np.random.default_rng(seed)
    problem = problem_by_time(seed - seed % 4 + 2, 2 * SHIPMENTS)
    windows = ({"late_cost_per_hour": 200.0} if seed % 3 == 0
               else {"earliest": 0, "latest": UNLIMITED, "late_cost_per_hour": None})
    ends = tuple(replace(customer, demand=(0,), release_time=0, **windows)
                 for customer in problem.customers)
    truck = replace(problem.vehicle_types[0], count=1, max_trips=1, max_trip_distance=None,
                    cost_per_load_km=1.0 if seed % 3 == 1 else 0.0,
                    max_travel_duration=100 * MINUTE if seed % 3 == 2 else None)
    shipments = tuple(Shipment(str(pickup), pickup, pickup + 1, (int(rng.integers(1, 5)) * 1000,))
                      for pickup in range(1, 2 * SHIPMENTS, 2))
    return replace(problem, customers=ends, vehicle_types=(truck,), shipments=shipments)


def with_shipment(trip: tuple[int, ...], pickup: int) -> Iterator[Trips]:
    """Yield all ways to put a shipment on a route of one trip."""
    for first in range(len(trip) + 1):
        for last in range(first, len(trip) + 1):
            yield ((*trip[:first], pickup, *trip[first:last], pickup + 1, *trip[last:]),)


def trips_of(route: Route) -> Trips:
    """Return the customers of each trip."""
    return tuple(tuple(stop.node for stop in trip.stops[1:-1]) for trip in route.trips)


def with_customer(trips: Trips, node: int) -> Iterator[Trips]:
    """Yield all ways to put a customer on a trip, on one of its own, or where one is split."""
    for index in range(len(trips) + 1):
        yield (*trips[:index], (node,), *trips[index:])
    for index, trip in enumerate(trips):
        before, behind = trips[:index], trips[index + 1:]
        for cut in range(len(trip) + 1):
            front, rear = trip[:cut], trip[cut:]
            yield (*before, (*front, node, *rear), *behind)
            if front and rear:
                yield (*before, (*front, node), rear, *behind)
                yield (*before, front, (node, *rear), *behind)


def cost_of(problem: Problem, data: ProblemData, trips_by_route: list[Trips]) -> float:
    """Return the cost of a plan of trips by vehicle; infinite if it breaks a rule.

    With the departures that the search gives its plans, as late as costs nothing.
    """
    routes = tuple(
        schedule(problem, RouteDecision(0, number, tuple(TripDecision((0, *trip, 0))
                                                         for trip in trips)))
        for number, trips in enumerate(trips_by_route))
    if not check(problem, Solution(routes, ())).is_feasible:
        return math.inf
    whole = read_plan(data, make_searcher(problem, data, Solution(routes),
                                           np.random.SeedSequence(0)))
    return check(problem, whole).cost.total


def least_cost(problem: Problem, data: ProblemData, plan: Solution, node: int) -> float:
    """Return the least cost of a plan with one customer more."""
    routes = [trips_of(route) for route in plan.routes]
    ways = [[*routes[:index], way, *routes[index + 1:]]
            for index, route in enumerate(routes) for way in with_customer(route, node)]
    if len(routes) < problem.vehicle_types[0].count:
        ways.append([*routes, ((node,),)])
    return min(cost_of(problem, data, way) for way in ways)


def inserted_cost(problem: Problem, data: ProblemData, plan: Solution, seed: int) -> float:
    """Return the cost after the search inserted who is missing; infinite if it couldn't."""
    searcher = make_searcher(problem, data, plan, np.random.SeedSequence(seed))
    begin_anew(data, searcher, False)
    return math.inf if searcher.count.missing else float(searcher.value.cost)


def without(plan: Solution, problem: Problem, node: int) -> Solution:
    """Return a plan without a customer."""
    routes: list[Route] = []
    for route in plan.routes:
        left = [[at for at in trip if at != node] for trip in trips_of(route)]
        trips = tuple(TripDecision((0, *trip, 0)) for trip in left if trip)
        if trips:
            routes.append(schedule(problem, RouteDecision(0, len(routes), trips)))
    return Solution(tuple(routes), (node,))


@pytest.mark.thorough_after(4)
@pytest.mark.parametrize("problem", [
    *(problem_with_trips(seed) for seed in seeds(12)),
    *(problem_by_time(seed) for seed in seeds(12)),
    *(problem_of_fresh_goods(seed) for seed in seeds(12)),
    *(with_other_legs(np.random.default_rng(seed), problem_by_time(seed)) for seed in seeds(12))])
def test_a_customer_goes_where_that_costs_least(problem: Problem) -> None:
    nobody = Solution((), tuple(range(1, CUSTOMERS + 1)))
    plan = improve(problem, pack([problem]), nobody, SearchConfig(turns=20)).solution
    served = [node for route in plan.routes for trip in trips_of(route) for node in trip]
    data = make_data(problem, pack([problem]))
    for node in served:
        rest = without(plan, problem, node)
        expected = least_cost(problem, data, rest, node)
        found = min(inserted_cost(problem, data, rest, seed) for seed in range(SEEDS))
        assert found == pytest.approx(expected)


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("seed", seeds(12))
def test_a_shipment_goes_where_that_costs_least(seed: int) -> None:
    problem = problem_of_shipments(seed)
    if seed % 6 == 5:
        problem = with_other_legs(np.random.default_rng(seed), problem)
    nobody = Solution((), tuple(range(1, 2 * SHIPMENTS + 1)))
    plan = improve(problem, pack([problem]), nobody, SearchConfig(turns=20)).solution
    data = make_data(problem, pack([problem]))
    served = {node for route in plan.routes for node in trips_of(route)[0]}
    for pickup in sorted(served)[::2]:
        left = [tuple(node for node in trips_of(route)[0] if node not in (pickup, pickup + 1))
                for route in plan.routes]
        routes = [(trip,) for trip in left if trip]
        ways = [[*routes[:index], way, *routes[index + 1:]]
                for index, (trip,) in enumerate(routes) for way in with_shipment(trip, pickup)]
        if len(routes) < problem.vehicle_types[0].count:
            ways.append([*routes, ((pickup, pickup + 1),)])
        expected = min(cost_of(problem, data, way) for way in ways)
        rest = Solution(tuple(
            schedule(problem, RouteDecision(0, number, (TripDecision((0, *trip, 0)),)))
            for number, (trip,) in enumerate(routes)), (pickup, pickup + 1))
        found = min(inserted_cost(problem, data, rest, each) for each in range(SEEDS))
        assert found == pytest.approx(expected)


def test_a_route_has_room_for_a_shipment_of_many_pickups() -> None:
    place = np.arange(MOST_PICKUPS + 2)
    legs = np.abs(place[:, None] - place)
    ends = tuple(Customer(str(each), (0,), 0, served_by="truck") for each in place[1:])
    parts = tuple(Part(int(node), (0,)) for node in place[2:-1])
    paired = Problem(
        (Depot("hub"),), ends, (VehicleType("truck", 1, (1,), 0, max_stops=1),),
        (Travel(legs * MINUTE, legs * MM_PER_KM),), np.stack([place, place], 1).astype(np.float64),
        unassigned_cost=1000.0,
        shipments=(Shipment("s", 1, len(ends), (0,), more=parts),))
    searcher = make_searcher(paired, make_data(paired, pack([paired])), Solution((), ()),
                             np.random.SeedSequence(0))
    # Where it is tried on a trip of its own, all ends lie between its start and its end.
    assert searcher.room.stops >= len(ends) + 2
