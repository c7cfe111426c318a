"""Changes of a plan gone on from have a price."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
import pytest

from model.judge.changes import ChangePrices, count_changes, earlier_plan
from model.judge.check import check
from model.judge.past import Past
from model.planner import Planner, PlanOptions
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.replanning.replan import Replanning, Terms
from model.solution import Solution
from tests.model.street import MINUTE, ONE, TWO, A, B, C, D, planned, replan
from tests.seeds import seeds

Tours = tuple[tuple[int, ...], ...]

OPTIONS = PlanOptions("any", time_limit=600.0, search_iterations=300)


def tours_of(plan: Solution) -> dict[tuple[int, int], list[int]]:
    """Return whom each vehicle serves, in order."""
    return {route.driven_by: [stop.node for trip in route.trips for stop in trip.customer_stops]
            for route in plan.routes}


def counted(before: Solution, after: Solution) -> tuple[int, int]:
    """Return how many orders changed vehicle, and place in it, by trying all that may stay."""
    was, now = tours_of(before), tours_of(after)
    owner = {node: vehicle for vehicle, tour in was.items() for node in tour}
    moved = out_of_order = 0
    for vehicle, tour in now.items():
        moved += sum(owner.get(node, vehicle) != vehicle for node in tour)
        stayed = [node for node in tour if owner.get(node) == vehicle]
        most = next(size for size in range(len(stayed), -1, -1)
                    for kept in combinations(stayed, size)
                    if sorted(kept, key=was.get(vehicle, []).index) == list(kept))
        out_of_order += len(stayed) - most
    return moved, out_of_order


def square(rng: np.random.Generator, number: int) -> Problem:
    """Return customers in a square, and two vans that one of them nearly fills."""
    places = rng.integers(0, 12, (number + 1, 2))
    legs = np.abs(places[:, None] - places).sum(axis=2).astype(np.int64)
    customers = tuple(Customer(str(index), (1000,)) for index in range(number))
    van = VehicleType("van", 2, (1000 * (number - 1),), 0, cost_per_km=1.0)
    return Problem((Depot("hub"),), customers, (van,), (Travel(legs * MINUTE, legs * 1_000_000),),
                   places.astype(np.float64), 1000.0)


def splits(nodes: Sequence[int], most: int) -> Iterator[Tours]:
    """Yield all tours of two vans."""
    for order in permutations(nodes):
        for cut in range(len(nodes) - most, most + 1):
            yield order[:cut], order[cut:]


def plan_by(problem: Problem, tours: Tours) -> Solution:
    """Return the plan of some tours, a trip each."""
    plan = planned(problem, *((tour,) if tour else () for tour in tours))
    return replace(plan, routes=tuple(route for route in plan.routes if route.trips))


@pytest.mark.parametrize("seed", seeds(60))
def test_changes_are_counted_as_by_trying_all(seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = square(rng, 6)
    before, after = (plan_by(problem, (tuple(order[:cut]), tuple(order[cut:]))) for order, cut in (
        (rng.permutation(6) + 1, 3), (rng.permutation(6) + 1, int(rng.integers(1, 6)))))
    earlier = earlier_plan(problem, before, ChangePrices(), {}, ())
    changes = count_changes(problem, after, earlier)
    assert changes[:2] == counted(before, after)
    told = {stop.node: stop.arrival for route in before.routes for trip in route.trips
            for stop in trip.customer_stops}
    assert changes.promised == sum(
        abs(stop.arrival - told[stop.node]) for route in after.routes for trip in route.trips
        for stop in trip.customer_stops)


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("seed", seeds(30))
def test_the_cheapest_plan_with_its_changes_is_found(planner: Planner, seed: int) -> None:
    rng = np.random.default_rng(seed)
    problem = square(rng, 5)
    order = tuple(rng.permutation(5) + 1)
    # Whoever is last is new.
    given = plan_by(problem, (order[:2], order[2:4]))
    prices = ChangePrices(*rng.choice((0.0, 1.0, 4.0, 20.0), 2))
    replanning = Replanning(problem, Terms(given, prices=prices))
    earlier = earlier_plan(problem, given, prices, {}, ())
    best = min(check(problem, plan_by(problem, tours), Past(earlier=earlier)).cost.total
               for tours in splits(order, 4))
    result = replanning.plan(planner, OPTIONS)
    assert replanning.check(result.solution).violations == ()
    assert result.final_cost == pytest.approx(best)
    moved, out_of_order = counted(given, result.solution)
    assert result.evaluation.cost.changes == pytest.approx(
        moved * prices.vehicle + out_of_order * prices.position)


def test_nobody_moves_where_that_costs_more_than_it_saves(planner: Planner,
                                                          street: Problem) -> None:
    given = planned(street, ((B,),), ((D, A),))
    free = replan(planner, street, Terms(given))
    dear = ChangePrices(vehicle=1000.0, position=1000.0)
    held = replan(planner, street, Terms(given, prices=dear))
    assert len(tours_of(free)) == 1
    assert {vehicle: [node for node in tour if node != C]
            for vehicle, tour in tours_of(held).items()} == {ONE: [B], TWO: [D, A]}
    assert C in tours_of(held)[TWO] + tours_of(held)[ONE]


def test_who_takes_over_from_a_broken_vehicle_has_not_moved(street: Problem,
                                                            planner: Planner) -> None:
    given = planned(street, ((A, B),))
    replanning = Replanning(street, Terms(given, now=0, unavailable=frozenset({ONE}),
                                          prices=ChangePrices(vehicle=50.0)))
    result = replanning.plan(planner, OPTIONS)
    assert set(tours_of(result.solution)[TWO]) >= {A, B}
    assert result.evaluation.cost.changes == 0


def test_another_arrival_than_promised_costs_by_the_minute(street: Problem) -> None:
    given = planned(street, ((A, B),))
    arrivals = [stop.arrival for stop in given.routes[0].trips[0].customer_stops]
    prices = ChangePrices(promise_per_minute=2.0)
    replanning = Replanning(street, Terms(given, prices=prices, promised={
        A: arrivals[0] + 3 * MINUTE}))
    assert replanning.check(given).cost.changes == pytest.approx(6.0)
