"""Orders across vehicles: the cheapest plans of tiny problems, by brute force."""

from collections.abc import Iterator, Sequence
from itertools import pairwise, permutations

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import (
    MM_PER_KM, Customer, Depot, DrivingRules, Problem, Relation, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.policy.extract import extract
from model.solution import Solution
from tests.model.rollouts import roll
from tests.model.simulation.test_simulator import Change
from tests.model.tiny import MINUTE, draw_tiny
from tests.model.tiny_breaks import with_breaks
from tests.model.tiny_company import with_order, with_order_across
from tests.model.tiny_driving import with_driving
from tests.model.tiny_launches import with_launch_sites, with_some_revisits
from tests.model.tiny_streets import draw_streets, draw_town
from tests.seeds import often, seeds

pytestmark = pytest.mark.slow

Routes = tuple[tuple[int, ...], ...]


def all_routes(left: tuple[int, ...], vehicles: int) -> Iterator[Routes]:
    """Yield all ways in which alike vehicles serve customers or leave them out."""
    if vehicles == 0 or not left:
        yield ()
        return
    yield from all_routes((), 0)
    for size in range(1, len(left) + 1):
        for own in permutations(left, size):
            rest = tuple(node for node in left if node not in own)
            for others in all_routes(rest, vehicles - 1):
                if not others or min(own) < min(others[0]):
                    yield (own, *others)


def can_be_driven(problem: Problem, routes: Routes) -> bool:
    """Tell whether there are times at which all rules hold: the soonest are, if any."""
    kind, duration = problem.vehicle_types[0], problem.travel[0].duration
    start = {node: problem.customer_at(node).earliest for own in routes for node in own}
    for _ in range(200):
        before = dict(start)
        for own in routes:
            left, here = kind.earliest, 0
            for node in own:
                start[node] = max(start[node], left + duration.item(here, node))
                left, here = start[node] + problem.customer_at(node).service_duration, node
        for node, lags in problem.lags_across.items():
            soonest = [start[lag.node] + lag.least for lag in lags if lag.node in start]
            if node in start:
                start[node] = max([start[node], *soonest])
        if any(start[node] > problem.customer_at(node).latest for node in start):
            return False
        if start == before:
            return all(start[own[-1]] + problem.customer_at(own[-1]).service_duration
                       + duration.item(own[-1], 0) <= kind.latest for own in routes)
    return False


def cost_of(problem: Problem, routes: Sequence[Sequence[int]]) -> float:
    kind, distance = problem.vehicle_types[0], problem.travel[0].distance
    driven = sum(distance.item(*leg) for own in routes for leg in pairwise((0, *own, 0)))
    left_out = problem.num_customers - sum(map(len, routes))
    return (driven / MM_PER_KM * kind.cost_per_km + len(routes) * kind.fixed_cost
            + left_out * problem.unassigned_cost)


def test_the_search_finds_the_cheapest_plan_of_orders_across_vehicles() -> None:
    across = bound = 0
    for seed in seeds(40):
        rng = np.random.default_rng((seed, 4))
        problem = with_order_across(rng, draw_streets(rng))
        nodes = tuple(range(1, problem.num_nodes))
        priced = sorted((cost_of(problem, routes), routes)
                        for routes in all_routes(nodes, problem.vehicle_types[0].count))
        least, best = next((cost, routes) for cost, routes in priced
                           if can_be_driven(problem, routes))
        found = None
        for turns in (200, 3000):
            found = improve(problem, pack([problem]), Solution((), nodes),
                            SearchConfig(seed, turns=turns)).solution
            evaluation = check(problem, found)
            assert evaluation.violations == (), f"seed {seed}"
            if evaluation.cost.total == pytest.approx(least):
                break
        assert evaluation.cost.total == pytest.approx(least), f"seed {seed}"
        bound += least > priced[0][0]
        across += any(len({number for number, own in enumerate(best) if set(own) & set(each.nodes)})
                      > 1 for each in problem.relations)
    assert across > often(10)
    assert bound > often(10)


@pytest.mark.parametrize("seed", range(4))
def test_trucks_with_drones_wait_for_each_other_as_they_were_priced(seed: int) -> None:
    problem = draw_town(np.random.default_rng(seed))
    found = improve(problem, pack([problem]), Solution((), tuple(range(1, problem.num_nodes))),
                    SearchConfig(seed, turns=120))
    evaluation = check(problem, found.solution)
    assert evaluation.violations == ()
    assert found.cost == pytest.approx(evaluation.cost.total)
    assert any(trip.sorties for route in found.solution.routes for trip in route.trips)


def with_sites_and_driving(rng: np.random.Generator, problem: Problem) -> Problem:
    change = (with_launch_sites, with_some_revisits)[int(rng.integers(2))]
    return with_driving(rng, change(rng, problem))


def test_a_driver_rests_while_it_waits_for_an_order() -> None:
    legs = np.array([[0, 0, 4], [0, 0, 4], [4, 4, 0]], np.int64)
    rules = DrivingRules(8 * MINUTE, 5 * MINUTE, max_work=20 * MINUTE)
    problem = Problem(
        (Depot("hub"),), (Customer("a", (1,), service_duration=2 * MINUTE, earliest=28 * MINUTE),
                          Customer("b", (1,), service_duration=MINUTE)),
        (VehicleType("van", 1, (2,), 0, cost_per_hour=20.0, driving=rules),),
        (Travel(legs * MINUTE, legs * MM_PER_KM),), np.zeros((3, 2)), 1000.0,
        relations=(Relation("before", (1, 2), min_lag=18 * MINUTE),))
    plan = improve(problem, pack([problem]), Solution((), (1, 2)), SearchConfig(turns=60)).solution
    assert check(problem, plan).violations == ()
    assert plan.unassigned == ()


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("resting", [with_driving, with_breaks, with_sites_and_driving])
@pytest.mark.parametrize("change", [with_order, with_order_across])
def test_rollouts_and_search_keep_orders_beside_rests(resting: Change, change: Change) -> None:
    rests = 0
    for seed in seeds(24):
        rng = np.random.default_rng((seed, 61))
        problem = change(rng, resting(rng, draw_tiny(rng)))
        instance = pack([problem])
        rollout = roll([problem], seed).rollouts[0]
        found = improve(problem, instance, Solution((), problem.left_out(())),
                        SearchConfig(seed, turns=100))
        for plan, cost in ((extract(problem, instance, rollout.actions), rollout.cost.sum()),
                           (found.solution, found.cost)):
            evaluation = check(problem, plan)
            assert evaluation.violations == (), f"seed {seed}"
            assert cost == pytest.approx(evaluation.cost.total), f"seed {seed}"
            rests += sum(len(trip.breaks) for route in plan.routes for trip in route.trips)
    assert rests > often(10)
