"""Plans completed by the search go on from what was decided, legally, and cost no more."""

from pathlib import Path

import numpy as np
import pytest

from model.judge.check import check
from model.problem import IntArray, Problem
from model.policy.extract import extract
from model.simulation.actions import NUM_KINDS, OPEN
from training.completion import (
    CompletionSetting, can_complete, complete, cost_of, is_cut, open_type, to_actions, to_routes,
    what_is_left,
)
from training.export import WEIGHTS
from training.instances import VARIANTS, generate
from training.labels import HOT, Actor, Origin
from training.rollout import make_batch

pytestmark = pytest.mark.slow

COMPLETED = ("uniform", "vrptw", "appointed", "soft", "hetero", "cvrp")
TIMED_OTHERWISE = {"soft"}
"""Where waiting costs, the search times routes otherwise than decisions do, so that what it finds
cheaper may be dearer as decided; labels keep the cheaper of both."""

EXPORTED = Path(__file__).parents[2] / "model" / "weights" / "attention" / WEIGHTS


@pytest.fixture(scope="module")
def actor() -> Actor:
    return Actor(EXPORTED)


def plan_of(actor: Actor, problem: Problem) -> IntArray:
    return actor.plan(make_batch([problem], [""]), HOT, np.random.default_rng(1))


@pytest.mark.parametrize("variant", COMPLETED)
def test_completion_is_a_legal_plan_that_begins_as_was_decided(variant: str, actor: Actor) -> None:
    for seed in range(3):
        problem = Origin(variant, 9, seed).problem()
        setting, actions = CompletionSetting.of(problem), plan_of(actor, problem)
        whole = cost_of(setting, actions)
        for cut in range(0, len(actions), 2):
            rest = what_is_left(setting, actions[:cut]) if is_cut(actions, cut) else None
            if rest is None:
                continue
            begun = open_type(actions[:cut])
            routes = complete(rest, to_routes(actions[cut:], begun), 30, seed)
            plan = np.concatenate([actions[:cut], to_actions(problem, routes, begun is not None)])
            evaluation = check(problem, extract(problem, setting.instance, plan))
            assert not evaluation.violations
            assert cost_of(setting, plan) == pytest.approx(evaluation.cost.total)
            if variant not in TIMED_OTHERWISE:
                assert cost_of(setting, plan) <= whole * (1 + 1e-9)


def test_completion_finds_the_way_back_from_a_shuffled_rest(actor: Actor) -> None:
    problem = Origin("uniform", 12, 5).problem()
    setting, actions = CompletionSetting.of(problem), plan_of(actor, problem)
    rest = what_is_left(setting, actions[:4])
    assert rest is not None
    begun = open_type(actions[:4])
    costs = [cost_of(setting, np.concatenate([
        actions[:4], to_actions(problem, complete(rest, routes, 400, 1), begun is not None)]))
        for routes in (to_routes(actions[4:], begun), [])]
    assert costs[1] == pytest.approx(costs[0], rel=0.02)


def test_no_cut_leaves_a_vehicle_empty(actor: Actor) -> None:
    actions = plan_of(actor, Origin("uniform", 12, 5).problem())
    opened = np.flatnonzero(actions % NUM_KINDS == OPEN)
    assert not any(is_cut(actions, place + 1) for place in opened.tolist())
    assert is_cut(actions, 0)


def test_drones_and_further_trips_are_not_for_the_search_to_complete() -> None:
    possible = {name for name in VARIANTS
                if can_complete(generate(np.random.default_rng(2), 8, name))}
    assert set(COMPLETED) - {"uniform"} <= possible
    assert not possible & {"drone", "table1", "multitrip", "pickups"}
