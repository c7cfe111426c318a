"""A head that tells what plans will cost learns it, and says so of states as they are."""

from pathlib import Path

import numpy as np
import pytest
import torch

from model.policy.attention import AttentionPolicy
from training.completion import CompletionSetting, cost_of
from training.examples import problem_of
from training.export import WEIGHTS
from training.labels import Actor, Labelled, Origin, label, read_policy, write
from training.rollout import make_batch
from training.value import Value, bands, errors, look, train

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

EXPORTED = Path(__file__).parents[2] / "model" / "weights" / "attention"


@pytest.fixture(scope="module")
def policy() -> AttentionPolicy:
    return read_policy(EXPORTED / WEIGHTS)


@pytest.fixture(scope="module")
def plans() -> list[Labelled]:
    actor = Actor(EXPORTED / WEIGHTS)
    return [label(actor, Origin("uniform", 12, 20 * seed + 1), 0.3)[0] for seed in range(6)]


def test_states_are_worth_what_was_found(policy: AttentionPolicy, plans: list[Labelled]) -> None:
    found = look(policy, plans, np.random.default_rng(3))
    assert found is not None
    assert bool(found.is_state.any(dim=1).all())
    for index, plan in enumerate(plans):
        batch = make_batch([problem_of(plan.origin)], [""])
        unit = float(batch.scale.cost[0]) * plan.origin.size
        known = plan.worth[:-1] / unit
        total = cost_of(CompletionSetting.of(problem_of(plan.origin)), plan.actions) / unit
        for place in torch.nonzero(found.is_state[index])[:, 0].tolist():
            worth, spent = float(found.worth[index, place]), float(found.spent[index, place])
            assert min(abs(known - worth)) < 1e-5
            assert 0 <= spent <= worth + 1e-5
            assert worth <= total + 1e-5


def test_head_learns(policy: AttentionPolicy, plans: list[Labelled], tmp_path: Path) -> None:
    write(tmp_path / "001-00000.npz", plans)
    fresh = look(policy, plans, np.random.default_rng(5))
    assert fresh is not None
    before = errors(Value(policy.config.width), fresh).abs().mean()
    value, buffer, _ = train(tmp_path, tmp_path, EXPORTED, 5.0, 3e-3, 60)
    assert len(buffer.plans) == len(plans)
    assert errors(value, fresh).abs().mean() < before / 3
    *parts, (name, number, mean, median) = bands(value, policy, plans)
    assert name == "all"
    assert number == sum(part[1] for part in parts) > len(plans)
    assert 0 < median <= 2 * mean < 0.5
    kept = Value(policy.config.width)
    kept.load_state_dict(torch.load(tmp_path / "value.pt", weights_only=True))
    assert torch.equal(errors(kept, fresh), errors(value, fresh))


def test_labels_without_beginnings_are_an_error(plans: list[Labelled], tmp_path: Path) -> None:
    bare = [Labelled(plan.origin, plan.actions, plan.fine, plan.pairs) for plan in plans]
    write(tmp_path / "001-00000.npz", bare)
    with pytest.raises(ValueError, match="labels"):
        train(tmp_path, tmp_path, EXPORTED, 5.0, 1e-3, 1)
