"""Prices of the plan as a whole: by hand, and the search against all plans of tiny problems."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import permutations
from typing import get_args

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, Balance, Customer, Depot, Fairness, Measure,
    Problem, Travel, VehicleType,
)
from model.search.beginning.translate import make_searcher
from model.search.improve import SearchConfig, improve
from model.search.problem_data import make_data
from model.search.route.engine import leg_cost
from model.solution import Solution
from tests.model.tiny import draw_tiny, with_duty, with_pickups, with_reloads
from tests.model.tiny_shipments import with_shipments

MINUTE = 60_000
ONLY_END = Fairness(makespan_cost_per_hour=60.0)


def street_problem(seed: int, fairness: Fairness, number: int = 5, **kind: int) -> Problem:
    """Return a problem on a grid of streets, 2 minutes per km."""
    rng = np.random.default_rng(seed)
    place = rng.integers(-6, 7, (number + 1, 2))
    step = np.abs(place[:, None] - place).sum(axis=2)
    travel = Travel((2 * MINUTE * step).astype(np.int64), (step * MM_PER_KM).astype(np.int64))
    customers = tuple(Customer(str(index), (int(rng.integers(1, 5)) * 1000,),
                               service_duration=int(rng.integers(0, 9)) * MINUTE)
                      for index in range(number))
    van = VehicleType("van", 3, (20_000,), 0, fixed_cost=3.0, **kind)
    small = VehicleType("small", 1, (6000,), 0, cost_per_km=0.7, cost_per_hour=6.0)
    return Problem((Depot("hub"),), customers, (replace(van, cost_per_km=1.0), small), (travel,),
                   place.astype(np.float64), 1000.0, fairness=fairness)


def routes_of(groups: Sequence[tuple[int, ...]]) -> Iterator[list[RouteDecision]]:
    """Yield who drives routes: vans, or the small one for one of them."""
    for small in range(-1, len(groups)):
        yield [RouteDecision(int(index == small), 0 if index == small else index,
                             (TripDecision((0, *nodes, 0)),))
               for index, nodes in enumerate(groups)]


def splits(order: tuple[int, ...], most: int) -> Iterator[tuple[tuple[int, ...], ...]]:
    """Yield an order cut into parts, the first customers ascending so that each comes once."""
    if not order:
        yield ()
    elif most > 0:
        for size in range(1, len(order) + 1):
            for rest in splits(order[size:], most - 1):
                if not rest or order[0] < rest[0][0]:
                    yield (order[:size], *rest)


def cheapest(problem: Problem) -> float:
    """Return what the cheapest of all plans costs that serve everybody."""
    best = float("inf")
    for order in permutations(range(1, problem.num_nodes)):
        for groups in splits(order, 3):
            for decisions in routes_of(groups):
                plan = Solution(tuple([schedule(problem, each) for each in decisions]))
                evaluation = check(problem, plan)
                if evaluation.is_feasible:
                    best = min(best, evaluation.cost.total)
    return best


def searched(problem: Problem, turns: int = 600) -> Solution:
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    found = improve(problem, pack([problem]), nobody, SearchConfig(turns=turns))
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    counted = evaluation.cost.total + told_apart(problem, found.solution)
    assert counted == pytest.approx(found.cost, rel=1e-9)
    return found.solution


def told_apart(problem: Problem, plan: Solution) -> float:
    """Return what the search adds to tell plans apart that end at the same time."""
    per_hour = problem.fairness.makespan_cost_per_hour
    if not per_hour or not plan.routes:
        return 0.0
    vehicles = sum(kind.count for kind in problem.vehicle_types)
    per_hour /= MS_PER_HOUR
    ways, ends = 0.0, []
    for route, metrics in zip(plan.routes, check(problem, plan).routes, strict=True):
        kind = problem.vehicle_types[route.vehicle_type]
        duration, distance = problem.travel[kind.travel].longest()
        least = 0.001 * per_hour / min(vehicles, problem.num_customers) * duration / distance
        ways += max(0.0, least - kind.cost_per_km / MM_PER_KM) * sum(
            trip.distance for trip in metrics.trips)
        ends.append(route.trips[-1].stops[-1].departure)
    squares = sum(end * end for end in ends)
    return ways + 0.02 * per_hour * squares / (len(ends) * max(ends))


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("seed", "fairness"), [
    (1, ONLY_END), (2, ONLY_END), (3, Fairness(0.0, Balance("duration", 40.0))),
    (4, Fairness(0.0, Balance("stops", 6.0))), (5, Fairness(0.0, Balance("load", 4.0))),
    (6, Fairness(0.0, Balance("distance", 3.0))), (7, Fairness(30.0, Balance("stops", 2.0))),
    (8, Fairness(min_vehicles=3, too_few_cost=1000.0)),
    (9, Fairness(0.0, Balance("stops", 2.0), 2, 1000.0))])
def test_search_finds_the_cheapest_plan_as_a_whole(seed: int, fairness: Fairness) -> None:
    problem = street_problem(seed, fairness)
    found = check(problem, searched(problem)).cost
    assert found.total == pytest.approx(cheapest(problem), rel=1e-9)
    assert found.makespan > 0 or fairness.makespan_cost_per_hour == found.too_few_vehicles == 0


def test_a_missing_leg_makes_no_other_dear_where_the_last_end_costs() -> None:
    problem = replace(street_problem(1, ONLY_END), unassigned_cost=100.0)
    duration, distance = problem.travel[0].arrays()
    duration[1, 2] = MAX_QUANTITY
    in_time = [replace(kind, latest=MAX_QUANTITY // 2) for kind in problem.vehicle_types]
    lacking = replace(problem, travel=(Travel(duration, distance),), vehicle_types=tuple(in_time))
    plan = improve(lacking, pack([lacking]), Solution((), tuple(range(1, 6))),
                   SearchConfig(turns=600)).solution
    found = check(lacking, plan)
    assert found.violations == ()
    assert plan.unassigned == ()
    assert found.cost.total == pytest.approx(cheapest(lacking), rel=1e-9)


@pytest.mark.parametrize("draw", [draw_tiny, with_pickups, with_reloads, with_duty, with_shipments])
def test_search_counts_as_the_judge_does_whatever_else_is_stated(
        draw: Callable[..., Problem]) -> None:
    for seed, measure in enumerate(get_args(Measure)):
        rng = np.random.default_rng(seed)
        problem = draw_tiny(rng) if draw is draw_tiny else draw(rng, draw_tiny(rng))
        fairness = Fairness(30.0 * (seed % 2), Balance(measure, 1.0 + seed), 2, 50.0)
        searched(replace(problem, fairness=fairness), turns=60)


def test_trips_are_shared_out_where_the_last_end_alone_costs() -> None:
    step = np.full((13, 13), 10 * MINUTE) * (1 - np.eye(13, dtype=np.int64))
    customers = tuple(Customer(str(index), (1000,)) for index in range(12))
    drone = VehicleType("drone", 3, (1000,), 0, flies=True, max_trips=12)
    problem = Problem((Depot("hub"),), customers, (drone,), (Travel(step, step),),
                      np.zeros((13, 2)), 1000.0, fairness=ONLY_END)
    plan = searched(problem, turns=300)
    assert sorted(len(route.trips) for route in plan.routes) == [4, 4, 4]


@pytest.mark.parametrize(("per_km", "leg"), [(0.0, 5.0), (0.07, 0.07)])
def test_leg_costs_its_share_of_the_last_end_where_that_alone_costs(per_km: float,
                                                                    leg: float) -> None:
    step = np.full((9, 9), 10 * MINUTE) * (1 - np.eye(9, dtype=np.int64))
    ways = Travel(step, step * MM_PER_KM // (10 * MINUTE))
    customers = tuple(Customer(str(index), (1000,)) for index in range(8))
    van = VehicleType("van", 2, (4000,), 0, cost_per_km=per_km)
    problem = Problem((Depot("hub"),), customers, (van,), (ways,), np.zeros((9, 2)), 1000.0,
                      fairness=ONLY_END)
    plan = searched(problem, turns=60)
    assert [len(route.trips[0].customer_stops) for route in plan.routes] == [4, 4]
    data = make_data(problem, pack([problem]))
    searcher = make_searcher(problem, data, plan, np.random.SeedSequence(1))
    assert leg_cost(data, searcher)[0] == pytest.approx(leg)
