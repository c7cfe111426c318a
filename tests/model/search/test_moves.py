"""Small problems where one kind of move is needed, and found."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.engine.instance import pack
from model.problem import MM_PER_KM, Customer, Depot, DroneType, Problem, Travel, VehicleType
from model.search.neighbourhood.neighbourhood import Neighbourhood, make_neighbourhood
from model.search.improve import Improved, Progress, SearchConfig, improve
from model.search.strategy import Moves
from model.solution import Solution
from tests.seeds import seeds

pytestmark = pytest.mark.slow

MINUTE = 60_000

TRUCK = VehicleType("truck", 2, (40_000,), 0, cost_per_km=1.0)
THOUSANDS = 2000
"""Customers so many that a first plan looks beside neighbours alone."""
COLD = {"hot": 0.01, "cold": 0.001}
"""Temperatures at which no detour of many turns is made."""


def on_a_plane(places: Sequence[tuple[float, float]], *kinds: VehicleType,
               demand: int = 1000) -> Problem:
    """Return a problem with a depot at (0, 0) and equal customers, places in km, a minute a km."""
    place = np.array([(0, 0), *places], dtype=np.float64)
    legs = np.rint(np.linalg.norm(place[:, None] - place, axis=2) * MM_PER_KM).astype(np.int64)
    travel = Travel(legs * MINUTE // MM_PER_KM, legs)
    customers = tuple(Customer(str(number), (demand,)) for number in range(len(places)))
    return Problem((Depot("hub"),), customers, kinds, (travel,), place, unassigned_cost=1e6)


def plan(problem: Problem, *routes: tuple[int, Sequence[int]]) -> Solution:
    """Return the plan whose routes, a type and its customers each, are of one trip."""
    numbers = [0] * len(problem.vehicle_types)
    timed = []
    for kind, customers in routes:
        trip = TripDecision((0, *customers, 0))
        timed.append(schedule(problem, RouteDecision(kind, numbers[kind], (trip,))))
        numbers[kind] += 1
    return Solution(tuple(timed))


def improved_cost(problem: Problem, start: Solution, turns: int, seed: int) -> float:
    """Return the cost after a cold search."""
    assert check(problem, start).violations == ()
    config = SearchConfig(seed=seed, turns=turns, **COLD)
    found: Improved = improve(problem, pack([problem]), start, config)
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    return evaluation.cost.total


@pytest.mark.parametrize("count", [1, 2])
def test_trucks_with_drones_begin_hardly_dearer_than_trucks_alone(count: int) -> None:
    places = np.random.default_rng(4).uniform(-9.0, 9.0, (450, 2)).tolist()
    truck = replace(TRUCK, count=60, capacity=(10_000,))
    flying = replace(truck, drones=DroneType(count, (1000,), 0, cost_per_km=0.3))
    costs = []
    for kind in (truck, flying):
        problem = on_a_plane(places, kind)
        costs.append(improve(problem, pack([problem]), Solution((), ()),
                             SearchConfig(turns=100)).first_cost)
    assert costs[1] < 1.02 * costs[0]


def crossed(kind: VehicleType) -> tuple[Problem, Solution, float]:
    """Return two full trucks that change sides halfway, that plan, and the cost if they did not.

    The tails are longer than any string that is removed at once, and no customer fits into the
    other truck alone.
    """
    north = [(float(x), 6.0) for x in range(1, 25)]
    south = [(float(x), -6.0) for x in range(1, 25)]
    problem = on_a_plane([*north, *south], replace(kind, capacity=(24_000,)))
    up, down = list(range(1, 25)), list(range(25, 49))
    start = plan(problem, (0, up[:12] + down[12:]), (0, down[:12] + up[12:]))
    return problem, start, check(problem, plan(problem, (0, up), (0, down))).cost.total


@pytest.mark.parametrize("kind", [
    TRUCK,
    replace(TRUCK, cost_per_hour=2.0),
    replace(TRUCK, max_trips=2, cost_per_hour=2.0),
    replace(TRUCK, drones=DroneType(1, (100,), 0)),
], ids=["distance", "time", "trips", "drones"])
def test_tails_are_exchanged(kind: VehicleType) -> None:
    problem, start, straight = crossed(kind)
    assert straight < check(problem, start).cost.total - 10
    for seed in seeds(3):
        assert improved_cost(problem, start, 2000, seed) <= straight * (1 + 1e-9)


def test_tails_are_exchanged_between_trucks_of_other_depots() -> None:
    yard = [(0.0, -6.0)]
    north = [(float(x), 6.0) for x in range(1, 25)]
    south = [(float(x), -6.0) for x in range(1, 25)]
    trucks = tuple(replace(TRUCK, id=f"truck-{depot}", count=1, depot=depot, capacity=(24_000,))
                   for depot in range(2))
    # The first customer's place is the second depot.
    problem = on_a_plane([*yard, *north, *south], TRUCK)
    problem = replace(problem, depots=(Depot("hub"), Depot("yard")), vehicle_types=trucks,
                      customers=problem.customers[1:])
    up, down = list(range(2, 26)), list(range(26, 50))

    def planned(*routes: list[int]) -> Solution:
        return Solution(tuple(
            schedule(problem, RouteDecision(kind, 0, (TripDecision((kind, *nodes, kind)),)))
            for kind, nodes in enumerate(routes)))

    start = planned(up[:12] + down[12:], down[:12] + up[12:])
    straight = check(problem, planned(up, down)).cost.total
    assert straight < check(problem, start).cost.total - 10
    for seed in seeds(3):
        assert improved_cost(problem, start, 4000, seed) <= straight * (1 + 1e-9)


def test_customers_who_pay_together_are_served_though_more_are_left_out() -> None:
    places = [(10.0 * x, 10.0 * y) for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1), (2, 0))]
    groups = [(x + 0.1 * step, y) for x, y in places for step in range(8)]
    truck = replace(TRUCK, count=5, capacity=(8000,))
    problem = replace(on_a_plane(groups, truck), unassigned_cost=6.0)
    start = Solution((), tuple(range(1, problem.num_nodes)))
    for seed in seeds(3):
        # Each place pays 48 and takes 28 to 42 to get to.
        assert improved_cost(problem, start, 2000, seed) < 0.9 * 48 * len(places)


def test_a_tail_becomes_a_route_of_its_own() -> None:
    morning = [(20.0 + x, 0.0) for x in range(14)]
    evening = [(-20.0 - x, 0.0) for x in range(14)]
    problem = on_a_plane([*morning, *evening], replace(TRUCK, cost_per_hour=1.0))
    customers = (*problem.customers[:14], *(replace(customer, earliest=1000 * MINUTE)
                                            for customer in problem.customers[14:]))
    problem = replace(problem, customers=customers)
    start = plan(problem, (0, range(1, 29)))
    for seed in seeds(3):
        # One truck for both waits for hours, which are paid; two trucks drive no farther.
        cost = improved_cost(problem, start, 1000, seed)
        assert cost < check(problem, start).cost.total - 10


def test_vehicles_are_traded() -> None:
    near = [(1 + 0.1 * x, 0.0) for x in range(14)]
    far = [(-50 - 0.1 * x, 0.0) for x in range(14)]
    thrifty = replace(TRUCK, id="thrifty", count=1, capacity=(14_000,), cost_per_km=1.0)
    thirsty = replace(TRUCK, id="thirsty", count=1, capacity=(14_000,), cost_per_km=3.0)
    problem = on_a_plane([*near, *far], thrifty, thirsty)
    start = plan(problem, (0, range(1, 15)), (1, range(15, 29)))
    traded = plan(problem, (0, range(15, 29)), (1, range(1, 15)))
    for seed in seeds(3):
        cost = improved_cost(problem, start, 300, seed)
        assert cost <= check(problem, traded).cost.total * (1 + 1e-9)


def test_cheaper_vehicles_left_over_are_taken() -> None:
    near = [(1 + 0.1 * x, 0.0) for x in range(14)]
    far = [(-5 - 0.1 * x, 0.0) for x in range(14)]
    large = replace(TRUCK, id="large", count=2, capacity=(20_000,), fixed_cost=50.0)
    small = replace(TRUCK, id="small", count=2, capacity=(14_000,), fixed_cost=20.0)
    problem = on_a_plane([*near, *far], large, small)
    start = plan(problem, (0, range(1, 15)), (0, range(15, 29)))
    smaller = plan(problem, (1, range(1, 15)), (1, range(15, 29)))
    for seed in seeds(3):
        cost = improved_cost(problem, start, 300, seed)
        assert cost <= check(problem, smaller).cost.total * (1 + 1e-9)


def test_a_larger_vehicle_makes_room_for_a_customer_more() -> None:
    places = [(10 + 0.1 * x, 0.0) for x in range(15)]
    small = replace(TRUCK, id="small", count=2, capacity=(14_000,), fixed_cost=20.0)
    large = replace(TRUCK, id="large", count=1, capacity=(15_000,), fixed_cost=25.0)
    problem = on_a_plane(places, small, large)
    start = plan(problem, (0, range(1, 15)), (0, (15,)))
    alone = plan(problem, (1, range(1, 16)))
    for seed in seeds(3):
        cost = improved_cost(problem, start, 300, seed)
        assert cost <= check(problem, alone).cost.total * (1 + 1e-9)


def test_trips_joined_by_their_ends_leave_no_empty_trip() -> None:
    """The second trip of one truck and the first of the other lie side by side and fit in one."""
    places = [(float(x), y) for y in (-9.0, 1.0, 2.0, 9.0) for x in range(5, 19)]
    truck = replace(TRUCK, count=2, max_trips=3)
    problem = on_a_plane(places, truck)
    trips = [TripDecision((0, *range(first, first + 14), 0)) for first in (1, 15)]
    others = [TripDecision((0, *range(first + 13, first - 1, -1), 0)) for first in (29, 43)]
    start = Solution((schedule(problem, RouteDecision(0, 0, tuple(trips))),
                      schedule(problem, RouteDecision(0, 1, tuple(others)))))
    for seed in seeds(40):
        for turns in (5, 40):
            improved_cost(problem, start, turns, seed)


SMALL = replace(TRUCK, id="small", capacity=(2000,), fixed_cost=1.0, max_trips=5)
LARGE = replace(TRUCK, id="large", capacity=(10_000,), fixed_cost=5.0, max_trips=5)
FAR_OFF = [(10.0, index / 10) for index in range(10)]


@pytest.mark.parametrize("seed", seeds(3))
def test_routes_of_several_trips_change_their_vehicle(seed: int) -> None:
    problem = on_a_plane(FAR_OFF, SMALL, LARGE)
    trips = tuple(TripDecision((0, 1 + first, 2 + first, 0)) for first in range(0, 10, 2))
    start = Solution((schedule(problem, RouteDecision(0, 0, trips)),))
    # Five trips by the small one are 1 + 101, one by the large one is 5 + 21.
    assert improved_cost(problem, start, 400, seed) < 27


def test_sorties_of_several_change_to_no_drone_that_lifts_less() -> None:
    places = [(4, 0), (4, 1), (-4, 0), (-4, 1), (0, 5), (1, 5)]
    kinds = tuple(
        VehicleType(name, 2, (6000,), 0, fixed_cost=fixed, cost_per_km=10.0, drones=DroneType(
            1, (payload,), 0, cost_per_km=0.1, max_customers_per_sortie=2))
        for name, fixed, payload in (("strong", 1.0, 2000), ("weak", 0.0, 1000)))
    problem = on_a_plane(places, *kinds)
    nobody = Solution((), tuple(range(1, 7)))
    pairs = 0
    for seed in range(6):
        found = improve(problem, pack([problem]), nobody, SearchConfig(seed=seed, turns=400))
        assert check(problem, found.solution).violations == ()
        pairs += sum(len(sortie.visits) > 1 for route in found.solution.routes
                     for trip in route.trips for sortie in trip.sorties)
    assert pairs > 0


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("seed", seeds(8))
def test_routes_of_two_trips_are_given_to_no_truck_that_drives_one(seed: int) -> None:
    places = np.random.default_rng(seed).uniform(-9, 9, (16, 2)).tolist()
    shuttle = VehicleType("shuttle", 3, (4000,), 0, fixed_cost=9.0, cost_per_km=1.0, max_trips=2)
    single = VehicleType("single", 1, (8000,), 0, fixed_cost=8.0, cost_per_km=1.0)
    problem = on_a_plane(places, shuttle, single)
    for turns in range(1, 40):
        found = improve(problem, pack([problem]), Solution((), tuple(range(1, 17))),
                        SearchConfig(seed=seed, turns=turns))
        assert check(problem, found.solution).violations == ()


@pytest.mark.parametrize("seed", seeds(5))
def test_customers_are_shared_out_between_two_trucks_and_their_drones(seed: int) -> None:
    places = [(23, -41), (-5, 20), (-28, 42), (38, -6), (38, -22), (1, -42)]
    drones = DroneType(1, (1000,), 0, endurance=160 * MINUTE, cost_per_km=0.1)
    problem = on_a_plane(places, VehicleType("truck", 3, (99_000,), 0, cost_per_km=1.0,
                                             drones=drones))
    config = SearchConfig(seed=seed, turns=300, moves=Moves(loops=False))
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 7))), config)
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    assert evaluation.cost.total == pytest.approx(127.234, abs=0.001)


@pytest.mark.parametrize("seed", seeds(4))
def test_full_trucks_and_their_drones_are_not_given_more(seed: int) -> None:
    places = np.random.default_rng(seed).uniform(-40, 40, (30, 2)).tolist()
    truck = VehicleType("truck", 15, (3000,), 0, cost_per_km=1.0,
                        drones=DroneType(1, (1000,), 0, cost_per_km=0.1))
    problem = on_a_plane(places, truck)
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 31))),
                    SearchConfig(seed=seed, turns=1500))
    assert check(problem, found.solution).violations == ()


def test_first_plan_looks_beyond_what_the_first_customer_costs() -> None:
    problem = on_a_plane(FAR_OFF, replace(SMALL, count=9), replace(LARGE, count=9))
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 11))),
                    SearchConfig(turns=0))
    assert check(problem, found.solution).cost.total < 27


def test_first_plan_uses_other_types_where_one_does_not_suffice() -> None:
    problem = on_a_plane(FAR_OFF, replace(SMALL, count=1, max_trips=1),
                         replace(LARGE, count=1, capacity=(8000,), max_trips=1))
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, 11))),
                    SearchConfig(turns=0))
    assert found.solution.unassigned == ()


@pytest.mark.thorough
def test_thousands_begin_with_a_plan_that_is_not_far_from_good() -> None:
    # Beside neighbours; where all routes were looked at, it was twice as dear as need be.
    places = np.random.default_rng(3).uniform(-30.0, 30.0, (THOUSANDS, 2)).tolist()
    problem = on_a_plane(list(map(tuple, places)),
                         replace(SMALL, count=150, fixed_cost=8.0, capacity=(12_000,)),
                         replace(LARGE, count=60, fixed_cost=12.0, capacity=(24_000,)))
    instance = pack([problem])
    begun = improve(problem, instance, Solution((), ()), SearchConfig(turns=0))
    assert check(problem, begun.solution).violations == ()
    assert begun.solution.unassigned == ()
    better = improve(problem, instance, begun.solution, SearchConfig(turns=40_000))
    assert better.cost < begun.cost < 1.35 * better.cost


@pytest.mark.thorough
def test_thousands_begin_with_the_same_plan_where_making_the_neighbourhood_took_its_time(
        monkeypatch: pytest.MonkeyPatch) -> None:
    # A tenth of the time was over: no plan by one type after another was tried any more.
    places = np.random.default_rng(3).uniform(-30.0, 30.0, (THOUSANDS, 2)).tolist()
    problem = on_a_plane(list(map(tuple, places)),
                         replace(SMALL, count=150, fixed_cost=2.0, capacity=(12_000,)),
                         replace(LARGE, count=60, fixed_cost=30.0, capacity=(24_000,)))
    instance, nothing, began = pack([problem]), Solution((), ()), time.perf_counter()
    begun = improve(problem, instance, nothing, SearchConfig(turns=0))
    limit = 10.0 * max(1.0, time.perf_counter() - began)  # enough on a busy machine, too

    def slowly(*args: Any, **options: Any) -> Neighbourhood:
        time.sleep(limit / 10)
        return make_neighbourhood(*args, **options)

    monkeypatch.setattr("model.search.improve.make_neighbourhood", slowly)
    told: list[Progress] = []
    late = improve(problem, instance, nothing, SearchConfig(), time.perf_counter() + limit,
                   lambda: bool(told), told.append)
    assert late.first_cost == begun.first_cost


@pytest.mark.thorough
def test_thousands_begin_with_several_trips_a_vehicle_and_more_are_found() -> None:
    places = np.random.default_rng(4).uniform(-30.0, 30.0, (THOUSANDS, 2)).tolist()
    problem = on_a_plane(list(map(tuple, places)), replace(
        SMALL, count=400, fixed_cost=50.0, capacity=(10_000,), max_trips=4))
    instance = pack([problem])
    begun = improve(problem, instance, Solution((), ()), SearchConfig(turns=0)).solution
    assert check(problem, begun).violations == ()
    assert begun.unassigned == ()
    assert sum(len(route.trips) for route in begun.routes) > 3 * len(begun.routes)
    single = Solution(tuple(replace(route, trips=(trip,))
                            for route in begun.routes for trip in route.trips), ())
    joined = improve(problem, instance, single, SearchConfig(turns=40_000)).solution
    assert check(problem, joined).violations == ()
    assert len(joined.routes) < 0.9 * len(single.routes)


@pytest.mark.parametrize("seed", [1, 2, 4, 9])
def test_vehicles_that_drive_for_nothing_are_all_used(seed: int) -> None:
    # To take one of them for a full one of the others then costs less than nothing.
    rng = np.random.default_rng(seed)
    places = [(float(x), float(y)) for x, y in rng.uniform(-20, 20, (60, 2))]
    free = replace(TRUCK, id="free", count=5, capacity=(30_000,), cost_per_km=0.0)
    paid = replace(TRUCK, id="paid", count=30, capacity=(20_000,))
    problem = on_a_plane(places, free, paid)
    problem = replace(problem, customers=tuple(
        replace(customer, demand=(int(rng.integers(1, 11)) * 1000,))
        for customer in problem.customers))
    found = improve(problem, pack([problem]), Solution((), ()),
                    SearchConfig(seed=seed, turns=5000))
    assert check(problem, found.solution).violations == ()
    assert found.solution.unassigned == ()
    assert sum(route.vehicle_type == 0 for route in found.solution.routes) == free.count
