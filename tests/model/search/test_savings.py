"""Routes by savings: what they keep to, where they begin, and which searches begin with them."""

from dataclasses import replace
from itertools import chain
from typing import Any

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Depot, DroneType, Problem, Travel, VehicleType
from model.search.beginning.savings import savings_routes
from model.search.first_plan import first_plan
from model.search.problem_data import make_data
from model.search.strategy import Moves
from tests.model.search.test_moves import MINUTE, TRUCK, on_a_plane


def test_savings_join_what_lies_on_the_way() -> None:
    problem = on_a_plane([(1, 0), (2, 0), (3, 0), (-1, 0), (-2, 0)], TRUCK)
    data = make_data(problem, pack([problem]))
    routes = sorted(sorted(route) for route in savings_routes(data, 0))
    assert routes == [[1, 2, 3], [4, 5]]


def test_savings_keep_to_capacity_and_windows() -> None:
    problem = on_a_plane([(1, 0), (2, 0), (3, 0)], replace(TRUCK, count=3, capacity=(2000,)))
    data = make_data(problem, pack([problem]))
    assert sorted(map(sorted, savings_routes(data, 0))) == [[1], [2, 3]]
    near, middle, far = problem.customers
    early = (replace(near, latest=MINUTE), replace(middle, latest=2 * MINUTE),
             replace(far, latest=3 * MINUTE))
    problem = replace(problem, customers=early, vehicle_types=(TRUCK,))
    assert savings_routes(make_data(problem, pack([problem])), 0) == [[1, 2, 3]]
    problem = replace(problem, customers=(near, replace(middle, latest=2 * MINUTE),
                                          replace(far, latest=3 * MINUTE)))
    windows = replace(problem, customers=(replace(near, earliest=9 * MINUTE),
                                          *problem.customers[1:]))
    assert savings_routes(make_data(windows, pack([windows])), 0) == [[2, 3, 1]]


def test_savings_keep_to_the_working_duration() -> None:
    truck = replace(TRUCK, max_working_duration=5 * MINUTE)
    problem = on_a_plane([(1, 0), (2, 0), (3, 0)], truck)
    assert sorted(map(sorted, savings_routes(make_data(problem, pack([problem])), 0))) == [
        [1, 2], [3]]
    near, middle, far = problem.customers
    # Whoever leaves later waits less, as far as the first window lets him.
    problem = replace(problem, customers=(
        replace(near, earliest=9 * MINUTE, latest=12 * MINUTE),
        replace(middle, earliest=11 * MINUTE), far))
    assert [1, 2] in savings_routes(make_data(problem, pack([problem])), 0)
    problem = replace(problem, customers=(
        replace(near, latest=9 * MINUTE), replace(middle, earliest=12 * MINUTE), far))
    assert [1] in savings_routes(make_data(problem, pack([problem])), 0)


@pytest.mark.parametrize(("beside", "other"), [
    ({"earliest": 600 * MINUTE}, {"latest": 60 * MINUTE}),
    ({"latest": MINUTE, "late_cost_per_hour": 1.0}, {})])
def test_savings_join_whom_waiting_and_lateness_leave_time_for(
        beside: dict[str, Any], other: dict[str, Any]) -> None:
    problem = on_a_plane([(10, 0), (10, 0.5), (9, -3)], replace(TRUCK, count=2, capacity=(2000,)))
    first, second, third = problem.customers
    assert [1, 2] in map(sorted, savings_routes(make_data(problem, pack([problem])), 0))
    first = replace(first, earliest=20 * MINUTE, latest=30 * MINUTE)
    problem = replace(problem, customers=(
        first, replace(second, **beside), replace(third, **other)))
    routes = savings_routes(make_data(problem, pack([problem])), 0)
    assert sorted(map(sorted, routes)) == [[1, 3], [2]]


def test_savings_go_by_distance_where_driving_takes_no_time() -> None:
    problem = on_a_plane([(1, 0), (2, 0), (-1, 0)], replace(TRUCK, capacity=(2000,)))
    near, far, other = problem.customers
    travel, = problem.travel
    problem = replace(
        problem, travel=(Travel(np.zeros_like(travel.duration[:]), travel.distance),),
        customers=(replace(near, latest=MINUTE), replace(far, earliest=9 * MINUTE), other))
    routes = savings_routes(make_data(problem, pack([problem])), 0)
    assert sorted(map(sorted, routes)) == [[1, 2], [3]]


def from_two_places(*kinds: VehicleType) -> Problem:
    """Return a problem with depots at either end of a line of customers, a type at each."""
    problem = on_a_plane([(20, 0), (1, 0), (2, 0), (18, 0), (19, 0)], TRUCK)
    return replace(problem, depots=(Depot("hub"), Depot("far")), customers=problem.customers[1:],
                   vehicle_types=kinds)


def test_savings_serve_from_the_nearest_of_several_places() -> None:
    problem = from_two_places(TRUCK, replace(TRUCK, id="far", depot=1))
    first = first_plan(problem, make_data(problem, pack([problem])))
    assert [(route.vehicle_type, sorted(stop.node for stop in route.trips[0].stops))
            for route in first.routes] == [(0, [0, 0, 2, 3]), (1, [1, 1, 4, 5])]
    # Insertion begins where it costs least; savings of one type would all begin at its place.
    for other in ({"capacity": (5000,)}, {"cost_per_hour": 1.0}, {"fixed_cost": 1.0}):
        problem = from_two_places(TRUCK, replace(TRUCK, id="far", depot=1, **other))
        assert first_plan(problem, make_data(problem, pack([problem]))).routes == ()


def test_savings_leave_whom_a_type_may_not_serve_to_others() -> None:
    problem = from_two_places(TRUCK, replace(TRUCK, id="far", depot=1))
    may = np.ones((2, problem.num_customers), np.bool_)
    may[0, 0] = may[1, 3] = False
    problem = replace(problem, may_serve=may)
    first = first_plan(problem, make_data(problem, pack([problem])))
    served = [[stop.node for stop in route.trips[0].stops[1:-1]] for route in first.routes]
    assert sorted(chain.from_iterable(served)) == [2, 3, 4, 5]
    for route, customers in zip(first.routes, served, strict=True):
        assert may[route.vehicle_type, np.array(customers) - problem.num_depots].all()


def test_savings_go_on_by_the_next_type_once_all_vehicles_of_the_cheapest_drive() -> None:
    problem = on_a_plane(
        [(1, 9), (2, 9), (9, 1), (9, 2), (-9, -9)],
        replace(TRUCK, id="dear", count=9, capacity=(2000,), fixed_cost=5.0),
        replace(TRUCK, id="cheap", count=1, capacity=(2000,)),
        replace(TRUCK, id="small", count=9, capacity=(1000,), fixed_cost=4.0))
    first = first_plan(problem, make_data(problem, pack([problem])))
    served = [(problem.vehicle_types[route.vehicle_type].id,
               {stop.node for stop in route.trips[0].stops} - {0}) for route in first.routes]
    assert [kind for kind, _ in served] == ["cheap", "dear", "dear"]
    assert {frozenset(nodes) for _, nodes in served} == {
        frozenset({1, 2}), frozenset({3, 4}), frozenset({5})}


def test_savings_begin_the_search_where_vehicles_are_alike_or_distance_alone_costs() -> None:
    places = [(1.0, 0.0), (2.0, 0.0)]
    van = replace(TRUCK, id="van", capacity=(1000,))
    with_drone = replace(TRUCK, drones=DroneType(1, (1000,), 0))
    twice = (TRUCK, replace(van, max_trips=2))
    for kinds, joined in (((TRUCK,), True), ((TRUCK, van), True), (twice, False),
                          ((with_drone,), False), ((replace(TRUCK, max_trips=2),), True)):
        problem = on_a_plane(places, *kinds)
        first = first_plan(problem, make_data(problem, pack([problem])))
        assert (len(first.routes) == 1) == joined
        grounded = make_data(problem, pack([problem]), Moves(loops=False, crossings=False))
        assert (len(first_plan(problem, grounded).routes) == 1) == (kinds != twice)
