"""Trips of vehicles that fly by themselves are packed on few of them, in time."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    Customer, Depot, DroneType, Energy, Fairness, Problem, Travel, VehicleType,
)
from model.search.beginning.packing import (
    comes_by_trips, packed_in_fewer, packed_plan, packed_routes, with_single_trips,
)
from model.search.beginning.translate import best_plan, make_searcher
from model.search.fewer_flown import FewerFlown, fewer_may_pay
from model.search.improve import SearchConfig, improve
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.search.problem_data import make_data
from model.search.route.engine import ANY, anneal
from model.search.strategy import ALL_MOVES
from model.solution import Route, Solution, Stop, Trip

MINUTE = 60_000

DRONE = VehicleType(
    "drone", 3, (2000,), 0, fixed_cost=5.0, cost_per_km=1.0, flies=True, max_trips=4,
    reload_duration=MINUTE, launch_duration=MINUTE, recovery_duration=MINUTE)


def street(*customers: Customer, kind: VehicleType = DRONE, step: int = 1) -> Problem:
    """Return a problem whose customers live one after another along a street, minutes apart."""
    place = np.arange(len(customers) + 1) * step
    legs = np.abs(place[:, None] - place).astype(np.int64)
    return Problem((Depot("hub"),), customers, (kind,), (Travel(legs * MINUTE, legs * 1_000_000),),
                   np.stack([place, place], axis=1).astype(np.float64), 1000.0)


def order(name: str, released: int = 0, latest: int = 10_000) -> Customer:
    """Return an order of one unit, in minutes."""
    return Customer(name, (1000,), release_time=released * MINUTE, latest=latest * MINUTE)


def trips_of(problem: Problem, *trips: tuple[int, ...]) -> list[list[tuple[int, ...]]]:
    """Return the customers of each vehicle's trips as they are packed."""
    return [[tuple(stop.node for stop in trip.stops[1:-1]) for trip in route.trips]
            for route in packed_routes(problem, 0, trips)]


def test_one_vehicle_flies_what_it_can_one_after_another() -> None:
    problem = street(order("a"), order("b"), order("c"))
    row, = trips_of(problem, (1,), (2,), (3,))
    assert sorted(row) == [(1,), (2,), (3,)]


def test_who_must_be_served_at_once_gets_another_vehicle() -> None:
    problem = street(order("a", latest=2), order("b", latest=3))
    assert sorted(trips_of(problem, (1,), (2,))) == [[(1,)], [(2,)]]


def test_trips_come_between_those_that_cannot_wait() -> None:
    """Two are ready late, one early; what may wait fills the time between."""
    problem = street(order("a", latest=2), order("b", 30, 33), order("c", latest=25))
    assert trips_of(problem, (1,), (2,), (3,)) == [[(1,), (3,), (2,)]]


def test_what_no_vehicle_can_fly_any_more_is_left_out() -> None:
    problem = street(order("a", latest=2), order("b", latest=3), kind=replace(DRONE, count=1))
    assert len(trips_of(problem, (1,), (2,))) == 1


def test_no_vehicle_makes_more_trips_than_it_may() -> None:
    problem = street(order("a"), order("b"), order("c"), kind=replace(DRONE, max_trips=2))
    assert sorted(map(len, trips_of(problem, (1,), (2,), (3,)))) == [1, 2]


def test_batteries_are_charged_between_packed_trips() -> None:
    power = (1000, 1000)
    energy = Energy(10**9, 1.0, (0, 2000), power, power, power, power, charge=500)
    first, second = order("a", latest=2), order("b", latest=10)
    assert trips_of(street(first, second), (1,), (2,)) == [[(1,), (2,)]]
    charged = street(first, second, kind=replace(DRONE, energy=energy))
    assert trips_of(charged, (1,), (2,)) == [[(1,)], [(2,)]]


def test_trips_are_packed_around_a_storm() -> None:
    """One is over before it, one fits in behind; a long one that can't wait comes first."""
    kind = replace(DRONE, storms=((5 * MINUTE, 60 * MINUTE),))
    problem = street(order("a", latest=100), order("b", latest=3), kind=kind)
    assert trips_of(problem, (1,), (2,)) == [[(2,), (1,)]]
    route = schedule(problem, RouteDecision(0, 0, (TripDecision((0, 2, 0)),
                                                   TripDecision((0, 1, 0)))))
    assert [trip.stops[0].departure for trip in route.trips] == [MINUTE, 60 * MINUTE]
    assert check(problem, Solution((route,))).violations == ()
    assert trips_of(street(order("a"), order("b"), order("c", 4, 59), kind=kind), (3,)) == []


def test_trips_are_packed_around_the_hours_of_zones_to_which_they_fly() -> None:
    kind = replace(DRONE, closings=((5 * MINUTE, 60 * MINUTE, 1),))
    held, other = replace(order("a", latest=100), zones=1), order("b", latest=30)
    # While it waits for one zone to open, it flies elsewhere.
    assert trips_of(street(held, other, kind=kind), (1,), (2,)) == [[(1,), (2,)]]
    assert trips_of(street(replace(order("c", 4, 59), zones=1), kind=kind), (1,)) == []
    assert trips_of(street(replace(order("c", 4, 59), zones=2), kind=kind), (1,)) == [[(1,)]]


def test_numbers_of_the_search_are_those_of_the_problem_by_a_list() -> None:
    problem = street(order("a", latest=2), order("b"))
    routes = packed_routes(problem, 0, [(1,), (2,)], [0, 2, 1])
    assert [stop.node for trip in routes[0].trips for stop in trip.stops[1:-1]] == [2, 1]


def test_packed_trips_are_in_time() -> None:
    rng = np.random.default_rng(1)
    customers = [order(str(index), int(rng.integers(0, 60)), int(rng.integers(60, 120)))
                 for index in range(12)]
    problem = street(*customers, kind=replace(DRONE, max_trips=20))
    routes = packed_routes(problem, 0, [(node,) for node in range(1, 13)])
    plan = Solution(tuple(schedule(problem, RouteDecision(0, route.vehicle, tuple(
        [TripDecision(tuple([stop.node for stop in trip.stops])) for trip in route.trips])))
        for route in routes), ())
    broken = {violation.code for violation in check(problem, plan).violations} - {"MISSING"}
    assert broken == set()


def test_a_search_ends_with_its_trips_on_as_few_vehicles_as_may_be() -> None:
    rng = np.random.default_rng(2)
    customers = [order(str(index), released, released + 30)
                 for index, released in enumerate(rng.integers(0, 120, 16).tolist())]
    problem = street(*customers, kind=replace(DRONE, count=8, max_trips=20))
    apart = Solution(tuple(
        schedule(problem, RouteDecision(0, number, (TripDecision((0, number + 1, 0)),)))
        for number in range(8)), tuple(range(9, 17)))
    found = improve(problem, pack([problem]), apart, SearchConfig(turns=1)).solution
    evaluation = check(problem, found)
    assert evaluation.violations == ()
    assert found.unassigned == ()
    assert len(found.routes) < 8


def in_fewer(problem: Problem) -> Solution:
    """Return what a search by fewer vehicles makes of a trip and a vehicle for each customer."""
    instance, nodes = pack([problem]), list(range(problem.num_nodes))
    neighbourhood = make_neighbourhood(problem, instance, along=False)
    data = make_data(problem, instance, ALL_MOVES, neighbourhood)
    plan = Solution(tuple([Route(0, node - 1, (Trip(tuple([Stop(stop, 0, 0, 0)
                                                          for stop in (0, node, 0)])),))
                           for node in nodes[1:]]))
    whole = make_searcher(problem, data, plan, np.random.SeedSequence(1))
    rounds = iter(np.linspace(0.0, 1.0, 200).tolist())
    FewerFlown(problem, data, whole, nodes, lambda: next(rounds)).run(
        lambda: anneal(data, whole, 20, ANY))
    assert data.type["count"].tolist() == [kind.count for kind in problem.vehicle_types]
    return best_plan(data, whole, nodes)


def test_fewer_fly_where_that_costs_less() -> None:
    """Each of two has to leave at once: a trip of both takes one vehicle, which costs less."""
    problem = street(order("a", latest=2), order("b", latest=3))
    found = in_fewer(problem)
    assert [[stop.node for stop in trip.stops] for route in found.routes
            for trip in route.trips] == [[0, 1, 2, 0]]
    assert check(problem, found).violations == ()


def test_as_many_fly_as_before_where_fewer_cannot() -> None:
    problem = street(order("a", latest=2), order("b", latest=3), kind=replace(DRONE, max_stops=1))
    found = in_fewer(problem)
    assert len(found.routes) == 2
    assert found.unassigned == ()
    assert check(problem, found).violations == ()


def test_trips_on_one_vehicle_fewer_leave_out_whom_they_must() -> None:
    problem = street(order("a", latest=2), order("b", latest=3), order("c"))
    routes = packed_routes(problem, 0, [(1,), (2,), (3,)])
    assert len(routes) == 2
    fewer, = packed_in_fewer(problem, 0, routes, range(4))
    assert {stop.node for trip in fewer.trips for stop in trip.stops[1:-1]} in ({1, 3}, {2, 3})
    assert fewer_may_pay(problem)
    assert not fewer_may_pay(replace(problem, vehicle_types=(replace(DRONE, fixed_cost=0.0),)))


def test_joined_trips_last_in_the_air_and_on_the_battery() -> None:
    """Two orders fit one trip by weight, not by what both take of the battery."""
    power = (1000, 1000)
    energy = Energy(13 * MINUTE * 1000, 1.0, (0, 2000), power, power, power, power)
    for kind in (replace(DRONE, endurance=7 * MINUTE), replace(DRONE, energy=energy)):
        far = street(order("a"), order("b"), kind=kind, step=3)
        found = improve(far, pack([far]), Solution((), (1, 2)), SearchConfig(turns=0)).solution
        assert check(far, found).violations == ()


def fleet_of_both(**stated: object) -> Problem:
    """Return a day of forty orders for a truck and drones that fly several trips."""
    rng = np.random.default_rng(4)
    customers = [replace(order(str(index), released, released + 60),
                         demand=(int(rng.integers(500, 2300)),))
                 for index, released in enumerate(rng.integers(0, 400, 40).tolist())]
    problem = street(*customers, kind=replace(DRONE, count=6, max_trips=30, **stated))
    place = np.array([0, *[1 + index % 10 for index in range(40)]])
    legs = np.abs(place[:, None] - place)
    problem = replace(problem, travel=(Travel(legs * MINUTE, legs * 1_000_000),))
    truck = VehicleType("truck", 1, (20_000,), 0, cost_per_km=2.0, max_trips=8)
    return replace(problem, vehicle_types=(truck, *problem.vehicle_types))


def test_trips_are_first_found_as_if_each_were_a_vehicles_own() -> None:
    problem = fleet_of_both()
    assert comes_by_trips(problem)
    truck, drone = with_single_trips(problem).vehicle_types
    assert truck == problem.vehicle_types[0]
    assert (drone.max_trips, drone.count, drone.fixed_cost) == (1, 40, 0.0)
    single = Solution((Route(0, 0, (Trip(tuple([Stop(node, 0, 0, 0) for node in (0, 1, 0)])),)),
                       *[Route(1, number, (Trip(tuple([Stop(node, 0, 0, 0)
                                                       for node in (0, number + 2, 0)])),))
                         for number in range(39)]))
    packed = packed_plan(problem, single)
    assert packed.routes[0] == single.routes[0]
    flown = [stop.node for route in packed.routes[1:] for trip in route.trips
             for stop in trip.stops[1:-1]]
    assert len(flown) == len(set(flown)) > 30
    assert len(packed.routes) <= 7


def test_trips_have_times_where_the_clock_ends_as_they_are_packed(
        monkeypatch: pytest.MonkeyPatch) -> None:
    stopped = []

    def packed(problem: Problem, single: Solution) -> Solution:
        stopped.append(True)
        return packed_plan(problem, single)

    monkeypatch.setattr("model.search.improve.packed_plan", packed)
    problem = fleet_of_both()
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    found = improve(problem, pack([problem]), nobody, SearchConfig(turns=20),
                    should_stop=lambda: bool(stopped))
    assert found.solution.routes
    assert check(problem, found.solution).violations == ()


def test_no_trips_are_found_first_for_drones_on_trucks_few_customers_fair_or_limited_work() -> None:
    problem = fleet_of_both()
    truck, drone = problem.vehicle_types
    carrier = replace(truck, drones=DroneType(1, (1000,), 0))
    assert not comes_by_trips(replace(problem, vehicle_types=(carrier, drone)))
    assert not comes_by_trips(replace(problem, vehicle_types=(truck,)))
    assert not comes_by_trips(replace(problem, fairness=Fairness(makespan_cost_per_hour=1.0)))
    short = replace(drone, max_working_duration=120 * MINUTE)
    assert not comes_by_trips(replace(problem, vehicle_types=(truck, short)))
    assert comes_by_trips(replace(problem, vehicle_types=(short,)))
    assert not comes_by_trips(street(order("a")))


@pytest.mark.parametrize("stated", [{}, {"endurance": 30 * MINUTE}])
def test_a_search_from_nothing_serves_all_by_truck_and_drones(stated: dict[str, object]) -> None:
    problem = fleet_of_both(**stated)
    nobody = Solution((), tuple(range(1, 41)))
    found = [improve(problem, pack([problem]), nobody, SearchConfig(turns=600)).solution
             for _ in range(2)]
    assert found[0] == found[1]
    evaluation = check(problem, found[0])
    assert evaluation.violations == ()
    assert found[0].unassigned == ()
    assert {route.vehicle_type for route in found[0].routes} == {0, 1}
