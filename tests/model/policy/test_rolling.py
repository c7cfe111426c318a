"""Rollouts by the engine, the same on any number of threads."""

from pathlib import Path

import numpy as np
import pytest

from model.engine.alarm import Alarm
from model.engine.instance import pack
from model.policy import decode as decoding
from model.policy.decode import (
    DecodeConfig, Policy, View, decode, encode, load_policy, prepare,
)
from model.policy.rolling import roll_out
from training.instances import generate

WEIGHTS = Path(__file__).parents[3] / "model" / "weights"


@pytest.fixture(scope="module")
def policy() -> Policy:
    return load_policy(WEIGHTS / "attention")


@pytest.fixture(scope="module")
def view() -> View:
    problem = generate(np.random.default_rng(3), 30, "drone")
    return prepare(problem, pack([problem]))


def test_plans_are_the_same_on_any_number_of_threads(
        policy: Policy, view: View, monkeypatch: pytest.MonkeyPatch) -> None:
    plans = []
    for threads in (1, 3, 8):
        monkeypatch.setattr(decoding, "num_cores", lambda threads=threads: threads)
        plans += [decode(policy, view, config)
                  for config in (DecodeConfig(), DecodeConfig("sample", 40))]
    assert len({plan.actions.tobytes() for plan in plans[::2]}) == 1
    assert len({plan.actions.tobytes() for plan in plans[1::2]}) == 1
    assert len({plan.cost for plan in plans}) == 2


def test_first_view_is_planned_as_it_is_alone(policy: Policy, view: View) -> None:
    assert policy.step_weights is not None
    alone, = roll_out(policy.step_weights, encode(policy, view.tokens), view.scene, [0.0],
                      np.random.default_rng(0))
    plan = decode(policy, view, DecodeConfig(most_views=1))
    assert plan.actions.tolist() == alone.actions.tolist()
    assert plan.cost == alone.cost


def test_rollouts_are_given_up_at_an_alarm(policy: Policy, view: View) -> None:
    assert policy.step_weights is not None
    assert not roll_out(policy.step_weights, encode(policy, view.tokens), view.scene, [0.0] * 3,
                        np.random.default_rng(0), alarm=Alarm(0.0).setting)
