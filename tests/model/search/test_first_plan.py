"""Routes of a first plan are turned round where they may be, and where that is shorter."""

from dataclasses import replace
from itertools import chain

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import UNLIMITED, Points, Problem, StraightLegs, Travel
from model.search import problem_data
from model.search.beginning.either_way import shortest_routes
from model.search.beginning.savings import NEIGHBOURS, joined, ranked_pairs, routes_of
from model.search.first_plan import first_plan
from model.search.problem_data import make_data, may_be_turned
from tests.model.search.test_moves import TRUCK, on_a_plane

NUMBER, HELD = 300, 30
"""Customers, and how many of them a truck holds."""


def scattered(count: int = 1, seed: int = 0) -> Problem:
    """Return a problem with customers scattered around the depot."""
    places = np.random.default_rng(seed).uniform(-100, 100, (NUMBER, 2))
    return on_a_plane(list(map(tuple, places)), replace(TRUCK, count=count,
                                                        capacity=(1000 * HELD,)))


def length(problem: Problem, routes: list[list[int]]) -> int:
    """Return how far routes are."""
    distance = problem.travel[0].distance
    return sum(int(distance.item(origin, to)) for route in routes
               for origin, to in zip([0, *route], [*route, 0], strict=True))


@pytest.mark.parametrize("seed", range(3))
def test_everyone_is_on_one_route_that_holds_him(seed: int) -> None:
    problem = scattered(seed=seed)
    routes = shortest_routes(make_data(problem, pack([problem])), 0)
    assert sorted(chain.from_iterable(routes)) == list(range(1, NUMBER + 1))
    assert max(map(len, routes)) <= HELD


def test_routes_are_turned_only_where_that_is_shorter() -> None:
    turned = 0
    for seed in range(3):
        problem = scattered(seed=seed)
        data = make_data(problem, pack([problem]))
        ranks = min(NEIGHBOURS, data.near.shape[1])
        one_way = routes_of(data, 0, joined(data, 0, ranks, ranked_pairs(data, 0, ranks)))
        either_way = shortest_routes(data, 0)
        assert len(either_way) <= len(one_way)  # there is a vehicle too few for either
        if len(either_way) == len(one_way):
            assert length(problem, either_way) <= length(problem, one_way)
        turned += either_way != one_way
    assert turned > 0


def by_neighbours(problem: Problem, ranks: int) -> list[list[int]]:
    """Return routes that are joined at either end, by so many neighbours of each customer first."""
    data = make_data(problem, pack([problem]))
    return routes_of(data, 0, joined(data, 0, ranks, ranked_pairs(data, 0, ranks), True))


def test_a_route_with_room_goes_on_where_none_is_near() -> None:
    towns = [(float(place), 0.0) for place in (100, 101, 102, 50, 51, 52, 53, 54)]
    problem = on_a_plane(towns, replace(TRUCK, count=9, capacity=(4000,)))
    assert sorted(map(sorted, by_neighbours(problem, 2))) == [[1, 2, 3, 8], [4, 5, 6, 7]]


@pytest.mark.parametrize("seed", range(5))
def test_no_two_routes_that_a_truck_holds_are_left(seed: int) -> None:
    routes = by_neighbours(scattered(seed=seed), 4)
    assert sorted(chain.from_iterable(routes)) == list(range(1, NUMBER + 1))
    least, next_one, *_, most = sorted(map(len, routes))
    assert most <= HELD < least + next_one


def test_routes_are_turned_only_where_loads_alone_limit_them(
        monkeypatch: pytest.MonkeyPatch) -> None:
    def may(problem: Problem) -> bool:
        return may_be_turned(make_data(problem, pack([problem])))

    problem = scattered()
    kind, = problem.vehicle_types
    assert not may(problem)  # too few
    monkeypatch.setattr(problem_data, "TURNED_FROM", NUMBER)
    assert may(problem)
    first, *others = problem.customers
    assert not may(replace(problem, customers=(replace(first, latest=10**9), *others)))
    assert not may(replace(problem, customers=(replace(first, pickup=(1,)), *others)))
    assert kind.latest == UNLIMITED
    assert not may(replace(problem, vehicle_types=(replace(kind, latest=10**9),)))
    duration, distance = problem.travel[0].arrays()
    longer = distance.copy()
    longer[1, 2] += 1
    assert not may(replace(problem, travel=(Travel(duration, longer),)))
    straight = Travel.along(StraightLegs(Points(problem.coordinates * 1000.0), 60.0))
    assert may(replace(problem, travel=(straight,)))


def test_first_plan_serves_each_customer_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(problem_data, "TURNED_FROM", NUMBER)
    problem = scattered(count=NUMBER)
    plan = first_plan(problem, make_data(problem, pack([problem])))
    served = [stop.node for route in plan.routes for stop in route.trips[0].stops[1:-1]]
    assert sorted(served) == list(range(1, NUMBER + 1))
