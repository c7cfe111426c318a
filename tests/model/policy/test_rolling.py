"""Rollouts by the engine, the same on any number of threads."""

from pathlib import Path

import numpy as np
import pytest

from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.policy.decode import Policy, View, encode, load_policy, prepare
from model.policy.rolling import roll_out, roll_out_views
from training.instances import generate

WEIGHTS = Path(__file__).parents[3] / "model" / "weights"


@pytest.fixture(scope="module")
def policy() -> Policy:
    return load_policy(WEIGHTS / "attention")


@pytest.fixture(scope="module")
def view(policy: Policy) -> View:
    problem = generate(np.random.default_rng(3), 30, "drone")
    return prepare(policy, problem, pack([problem]))


def test_views_are_planned_as_each_alone_on_any_number_of_threads(policy: Policy,
                                                                  view: View) -> None:
    assert policy.step_weights is not None
    memories = [encode(policy, view.tokens, symmetry) for symmetry in range(5)]
    alone = [roll_out(policy.step_weights, memory, view.scene, [0.0], np.random.default_rng(0))[0]
             for memory in memories]
    for threads in (1, 3, 8):
        plans = roll_out_views(policy.step_weights, memories, view.scene, None, threads)
        for plan, own in zip(plans, alone, strict=True):
            assert plan.actions.tolist() == own.actions.tolist()
            assert plan.cost == own.cost


def test_views_are_given_up_at_an_alarm(policy: Policy, view: View) -> None:
    assert policy.step_weights is not None
    rung = Alarm(0.0).setting
    assert not roll_out_views(policy.step_weights, [view.memory] * 3, view.scene, rung, 2)
