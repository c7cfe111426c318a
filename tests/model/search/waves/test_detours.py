"""What orders cost on routes, against routes driven stop by stop."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.search.improve import SearchConfig, improve
from model.search.waves.detours import detours
from model.search.waves.future import Future, Wave, future_of
from model.solution import Solution
from tests.seeds import seeds

MINUTE, KM = 60_000, 1_000_000
LEAVES = 100 * MINUTE


def drawn(seed: int) -> Future:
    rng = np.random.default_rng(seed)
    count = 9
    legs = rng.integers(5, 60, (count + 1, count + 1))
    np.fill_diagonal(legs, 0)
    opens = rng.integers(0, 300, count)
    customers = tuple([
        Customer(str(node), (int(rng.integers(1, 4)) * 1000,), 5 * MINUTE, int(start) * MINUTE,
                 int(start + rng.integers(100, 400)) * MINUTE)
        for node, start in enumerate(opens, 1)])
    van = VehicleType("van", 9, (8000,), 0, fixed_cost=7.0, cost_per_km=1.0, cost_per_hour=3.0,
                      latest=600 * MINUTE)
    problem = Problem((Depot("depot"),), customers, (van,), (Travel(legs * MINUTE, legs * KM),),
                      np.zeros((count + 1, 2)), 1e4, may_serve=rng.random((1, count)) < 0.9)
    return future_of(Wave(problem, tuple(range(1, count + 1)), (LEAVES,)), ())


def cost_of(problem: Problem, nodes: Sequence[int]) -> float:
    """Return what a route costs, infinite if it breaks a rule; legs alone take paid time."""
    kind, now, at, cost = problem.vehicle_types[0], LEAVES, 0, 7.0 if nodes else 0.0
    if sum(problem.customers[node - 1].demand[0] for node in nodes) > kind.capacity[0]:
        return np.inf
    for node in (*nodes, 0):
        leg = int(problem.travel[0].duration[at, node])
        now, at, cost = now + leg, node, cost + leg / MINUTE * (1.0 + 3.0 / 60)
        if node:
            order = problem.customers[node - 1]
            now = max(now, order.earliest)
            if now > order.latest or not problem.allows(0, node):
                return np.inf
            now += order.service_duration
    return cost if now <= kind.latest else np.inf


@pytest.mark.parametrize("seed", seeds(30))
def test_detours_are_what_routes_cost_more(seed: int) -> None:
    future = drawn(seed)
    problem = future.problem
    some = replace(problem, customers=problem.customers[:5], coordinates=problem.coordinates[:6],
                   may_serve=(problem.may_serve[:, :5] if problem.may_serve is not None else None),
                   travel=(problem.travel[0].among(np.arange(6)),))
    plan = improve(some, pack([some]), Solution((), tuple(range(1, 6))),
                   SearchConfig(turns=50)).solution
    rows = [[stop.node for stop in route.trips[0].customer_stops] for route in plan.routes]
    found = detours(future, plan.routes, range(1))
    for node in future.open:
        mine = [row for row in rows if node in row]
        ways = [cost_of(problem, row) - cost_of(problem, [each for each in row if each != node])
                for row in mine] or [
            cost_of(problem, [*row[:place], node, *row[place:]]) - cost_of(problem, row)
            for row in (*rows, []) for place in range(len(row) + 1)]
        assert found[node - 1] == pytest.approx(min(ways))
