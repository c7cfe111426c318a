"""Plans made of the routes of several plans."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pytest

from model.judge.check import check
from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.policy import route_pool
from model.policy.route_pool import RoutePool
from model.policy.rolling import NOTHING, Rollout
from model.problem import IntArray, Problem
from model.policy.extract import extract
from model.simulation.actions import DRIVE, LAUNCH, NUM_KINDS, OPEN
from tests.model.rollouts import random_problems, roll
from tests.model.tiny_company import with_relations
from tests.seeds import often


def rolled(problem: Problem, number: int) -> list[Rollout]:
    """Return random plans of a problem."""
    return [Rollout(np.array(rollout.actions, np.int64), float(rollout.cost.sum()))
            for seed in range(number) for rollout in roll([problem], seed).rollouts]


def improved(problem: Problem, plans: Sequence[Rollout]) -> Rollout:
    """Return the cheapest plan by the routes of some."""
    pool = RoutePool(pack([problem]))
    for plan in plans:
        pool.add(plan.actions)
    return pool.improved(min(plans, key=lambda plan: plan.cost), np.random.default_rng(0))


def cost_of(problem: Problem, actions: IntArray) -> float:
    """Return what a plan costs, which keeps all rules."""
    evaluation = check(problem, extract(problem, pack([problem]), actions))
    assert not evaluation.violations
    return evaluation.cost.total


def split(actions: IntArray) -> list[IntArray]:
    """Return the actions of each vehicle."""
    return np.split(actions, np.flatnonzero(actions % NUM_KINDS == OPEN)[1:])


def customers(actions: IntArray) -> set[int]:
    """Return whom actions serve."""
    return set((actions[np.isin(actions % NUM_KINDS, (DRIVE, LAUNCH))] // NUM_KINDS).tolist())


def choices(routes: Sequence[IntArray], room: IntArray) -> Iterator[list[IntArray]]:
    """Yield all routes that may be driven together."""
    if not routes:
        yield []
        return
    first, *others = routes
    yield from choices(others, room)
    kind = first[0] // NUM_KINDS
    if room[kind] > 0:
        left = room.copy()
        left[kind] -= 1
        free = [route for route in others if not customers(route) & customers(first)]
        yield from ([first, *rest] for rest in choices(free, left))


def test_plans_keep_all_rules_and_cost_what_they_are_said_to() -> None:
    gained = 0
    for problem in random_problems(41, often(80)):
        plans = rolled(problem, 6)
        best = min(plan.cost for plan in plans)
        found = improved(problem, plans)
        assert found.cost <= best
        assert cost_of(problem, found.actions) == pytest.approx(found.cost, rel=1e-9)
        gained += found.cost < best
    assert gained > often(10)


def test_plans_keep_those_together_who_are_to_be_served_together() -> None:
    for seed, problem in enumerate(random_problems(61, often(80))):
        related = with_relations(np.random.default_rng(seed), problem)
        found = improved(related, rolled(related, 4))
        assert cost_of(related, found.actions) == pytest.approx(found.cost, rel=1e-9)


def test_plans_are_the_cheapest_by_routes_of_all() -> None:
    looked_at = 0
    for problem in random_problems(43, often(60)):
        if problem.num_customers > 8:
            continue
        plans = rolled(problem, 3)
        routes = list({codes.tobytes(): codes for plan in plans for codes in split(plan.actions)}
                      .values())
        room = np.array([kind.count for kind in problem.vehicle_types])
        costs = [cost_of(problem, np.concatenate([np.zeros(0, np.int64), *choice]))
                 for choice in choices(routes, room)]
        assert improved(problem, plans).cost == pytest.approx(min(costs), rel=1e-9)
        looked_at += len(costs) > 4
    assert looked_at > often(8)


def test_more_customers_are_looked_at_region_by_region(monkeypatch: pytest.MonkeyPatch) -> None:
    problems = [problem for problem in random_problems(47, often(40)) if problem.num_customers > 8]
    whole = [improved(problem, rolled(problem, 6)).cost for problem in problems]
    monkeypatch.setattr(route_pool, "REGION", 6)
    gained = 0
    for problem, at_once in zip(problems, whole, strict=True):
        plans = rolled(problem, 6)
        found = improved(problem, plans)
        assert cost_of(problem, found.actions) == pytest.approx(found.cost, rel=1e-9)
        assert at_once * (1 - 1e-9) <= found.cost <= min(plan.cost for plan in plans)
        gained += found.cost < min(plan.cost for plan in plans)
    assert gained > often(2)


def test_old_routes_are_forgotten_but_not_the_best_plans(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = max(random_problems(53, 20), key=lambda problem: problem.num_customers)
    plans = sorted(rolled(problem, 12), key=lambda plan: plan.cost)
    monkeypatch.setattr(route_pool, "MOST_ROUTES", 4)
    found = improved(problem, plans)
    assert found.cost <= plans[0].cost
    assert cost_of(problem, found.actions) == pytest.approx(found.cost, rel=1e-9)


def test_the_best_so_far_is_kept_after_an_alarm() -> None:
    problem = max(random_problems(53, 20), key=lambda problem: problem.num_customers)
    pool = RoutePool(pack([problem]))
    plans = rolled(problem, 3)
    for plan in plans:
        pool.add(plan.actions)
    assert pool.improved(plans[0], np.random.default_rng(0), Alarm(0.0).setting) is plans[0]


def test_nobody_is_served_where_that_costs_less() -> None:
    problem = max(random_problems(53, 20), key=lambda problem: problem.num_customers)
    free = replace(problem, unassigned_cost=0.0, customers=tuple(
        replace(customer, unassigned_cost=1e-6) for customer in problem.customers))
    found = improved(free, rolled(free, 2))
    assert len(found.actions) == 0
    assert found.cost == pytest.approx(1e-6 * free.num_customers)


def test_nothing_comes_of_nothing() -> None:
    problem, = random_problems(1, 1)
    pool = RoutePool(pack([problem]))
    assert pool.improved(NOTHING, np.random.default_rng(0)) is NOTHING
    nobody = Rollout(np.zeros(0, np.int64), 7.0)
    pool.add(nobody.actions)
    assert pool.improved(nobody, np.random.default_rng(0)) is nobody
