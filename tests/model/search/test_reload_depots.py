"""Trips of who flies begin at depots near enough with a battery, as brute force has it."""

from collections.abc import Iterator
from itertools import combinations, permutations, product

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.seeds import seeds

pytestmark = pytest.mark.thorough

METRE = 1000


def drawn(rng: np.random.Generator) -> Problem:
    """Draw three customers, and one who flies to one or two of them at once from two depots."""
    places = rng.integers(0, 100, (5, 2)) * METRE
    legs = np.ceil(np.linalg.norm(places[:, None] - places, axis=-1)).astype(np.int64)
    stocks = [None if rng.random() < 0.4 else int(rng.integers(0, 3)) for _ in range(2)]
    home = int(rng.integers(2))
    flyer = VehicleType(
        "flyer", 1, (2,), 0, depot=home, cost_per_km=1000.0, max_trips=3, reload_depots=(1 - home,),
        flies=True,
        max_range=None if rng.random() < 0.4 else int(rng.integers(30, 90)) * METRE)
    return Problem(tuple([Depot(str(stock), batteries=stock) for stock in stocks]),
                   tuple([Customer(str(index), (1,)) for index in range(3)]), (flyer,),
                   (Travel(legs, legs),), places / METRE, unassigned_cost=1000.0)


def ways(problem: Problem) -> Iterator[tuple[TripDecision, ...]]:
    """Yield all routes, in all orders, cut into trips in all ways, with all depots between."""
    kind, = problem.vehicle_types
    customers = range(problem.num_depots, problem.num_nodes)
    for number in range(1, len(customers) + 1):
        for nodes in permutations(customers, number):
            for cuts in (each for size in range(number) for each in combinations(
                    range(1, number), size)):
                parts = [nodes[first:last] for first, last in zip(
                    (0, *cuts), (*cuts, number), strict=True)]
                for between in product(kind.reload_places, repeat=len(cuts)):
                    ends = (kind.begins_at, *between, kind.ends_at)
                    yield tuple([TripDecision((ends[index], *part, ends[index + 1]))
                                 for index, part in enumerate(parts)])


def cheapest(problem: Problem) -> float:
    """Return what the cheapest plan costs that the judge accepts."""
    customers = range(problem.num_depots, problem.num_nodes)
    best = len(customers) * problem.unassigned_cost
    for trips in ways(problem):
        served = {node for trip in trips for node in trip.nodes[1:-1]}
        left = tuple([node for node in customers if node not in served])
        judged = check(problem, Solution((schedule(problem, RouteDecision(0, 0, trips)),), left))
        if judged.is_feasible:
            best = min(best, judged.cost.total)
    return best


def test_trips_nearly_always_begin_and_end_at_the_best_depots() -> None:
    dearer = 0
    for seed in seeds(60):
        problem = drawn(np.random.default_rng(seed))
        found = improve(problem, pack([problem], False), Solution((), (2, 3, 4)),
                        SearchConfig(turns=200)).solution
        judged = check(problem, found)
        assert judged.violations == (), seed
        dearer += judged.cost.total > cheapest(problem) + 1e-6
    assert dearer <= 2


def test_policies_leave_out_who_is_too_far_from_any_depot() -> None:
    """Rollouts end trips anywhere; a search serves whoever lies near some of the depots."""
    for seed in seeds(20):
        problem = drawn(np.random.default_rng(seed))
        kind, = problem.vehicle_types
        anywhere, somewhere = (pack([problem], legs).can_drive[0, 0, 2:] for legs in (True, False))
        near = problem.travel[0].distance[:2, 2:] <= (kind.max_range or 2**40)
        assert anywhere.tolist() == near.all(axis=0).tolist()
        assert somewhere.tolist() == near.any(axis=0).tolist()
