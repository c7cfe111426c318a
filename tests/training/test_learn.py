"""The gradient step: probabilities computed anew, chunked gradients, baselines."""

from collections.abc import Callable

import numpy as np
import pytest
import torch
from torch import Tensor

from model.policy.attention import AttentionConfig, AttentionPolicy
from model.policy.network import PolicyNetwork
from model.policy.pointer import Critic, PointerConfig, PointerPolicy
from model.simulation.state import empty_costs
from training.dataset import Decisions, chunks, join, paths
from training.instances import VARIANTS, generate
from training.learn import (
    critic_advantage, critic_step, draw_weights, policy_gradient, shared_advantage, training_costs,
)
from training.policies import AnyPolicy
from training.rollout import Batch, Outcome, greedy, make_batch, roll_out, sampler

pytestmark = pytest.mark.slow

CPU = torch.device("cpu")
NUM_ROLLOUTS = 3

POLICIES: dict[str, Callable[[], AnyPolicy]] = {
    "pointer": lambda: PointerPolicy(PointerConfig(width=16)),
    "attention": lambda: AttentionPolicy(
        AttentionConfig(width=16, num_heads=2, num_layers=2, inner=16, action_width=8)),
}


@pytest.fixture(scope="module")
def batch() -> Batch:
    rng = np.random.default_rng(3)
    names = list(VARIANTS)
    return make_batch([generate(rng, 7, name) for name in names], names)


@pytest.fixture(params=POLICIES)
def policy(request: pytest.FixtureRequest) -> AnyPolicy:
    torch.manual_seed(5)
    return POLICIES[request.param]()


def play(policy: PolicyNetwork, batch: Batch, scored: list[Tensor] | None = None) -> Outcome:
    """Sample rollouts; keep the probabilities that each step saw."""
    draw = sampler(torch.Generator().manual_seed(1))

    def choose(logits: Tensor) -> Tensor:
        choice = draw(logits)
        if scored is not None:
            log_probability = torch.log_softmax(logits, dim=2)
            scored.append(log_probability.gather(2, choice[..., None]).flatten())
        return choice

    return roll_out(policy, batch, NUM_ROLLOUTS, choose, CPU, 2)


def all_of(decisions: Decisions) -> Tensor:
    """Weigh every decision the same."""
    return torch.ones(len(decisions.count))


def gradient_of(policy: AnyPolicy, batch: Batch, decisions: Decisions, weight: Tensor,
                advantage: Tensor, max_candidates: int = 10_000) -> dict[str, Tensor]:
    """Return the gradient by name of the parameter."""
    policy.zero_grad()
    policy_gradient(policy, batch, decisions, weight, advantage, max_candidates, False)
    return {name: parameter.grad.clone() for name, parameter in policy.named_parameters()
            if parameter.grad is not None}


def test_rollouts_in_parts_are_those_of_the_whole(policy: AnyPolicy, batch: Batch) -> None:
    whole, parts = (roll_out(policy, batch, NUM_ROLLOUTS, greedy, CPU, 2, num_parts)
                    for num_parts in (1, 3))
    assert np.array_equal(whole.cost, parts.cost)
    assert np.array_equal(whole.num_unserved, parts.num_unserved)
    one, other = join(whole.record), join(parts.record)
    key, other_key = (decisions.rollout * 1000 + decisions.step for decisions in (one, other))
    in_order, others_in_order = key.argsort(), other_key.argsort()
    assert torch.equal(key[in_order], other_key[others_in_order])
    for name in ("count", "here", "choice"):
        assert torch.equal(getattr(one, name)[in_order], getattr(other, name)[others_in_order])


@torch.no_grad()
def test_probabilities_computed_anew_are_those_of_the_rollout(
        policy: AnyPolicy, batch: Batch) -> None:
    scored: list[Tensor] = []
    decisions = join(play(policy, batch, scored).record)
    memory = policy.encode(*batch.encoder_inputs(CPU))
    path = paths(decisions, batch.num_problems * NUM_ROLLOUTS)
    hidden = policy.remember(memory, path.unflatten(0, (-1, NUM_ROLLOUTS))).flatten(0, 1)
    seen = set()
    for chunk in chunks(decisions, all_of(decisions), NUM_ROLLOUTS, 500):
        logits = policy.score(memory[chunk.problem], chunk.here, chunk.candidate, chunk.feature,
                              chunk.allowed, chunk.glob, hidden[chunk.rollout, chunk.step])
        chosen = torch.log_softmax(logits, dim=2).gather(2, chunk.choice[..., None])[..., 0]
        for r, s, p in zip(*(x[chunk.weight > 0].tolist() for x in (
                chunk.rollout, chunk.step, chosen)), strict=True):
            assert p == pytest.approx(float(scored[s][r]), abs=1e-4)
            seen.add((r, s))
    with_choice = decisions.count > 1
    assert seen == set(zip(decisions.rollout[with_choice].tolist(),
                           decisions.step[with_choice].tolist(), strict=True))
    assert len(seen) > 100


def test_size_of_chunks_does_not_change_the_gradient(policy: AnyPolicy, batch: Batch) -> None:
    decisions = join(play(policy, batch).record)
    advantage = torch.linspace(-1, 1, batch.num_problems * NUM_ROLLOUTS)
    parted, whole = (gradient_of(policy, batch, decisions, all_of(decisions), advantage, size)
                     for size in (200, 100_000))
    assert parted.keys() == whole.keys()
    for name, gradient in parted.items():
        torch.testing.assert_close(gradient, whole[name], rtol=1e-3, atol=1e-5)
    assert any(bool(gradient.abs().max() > 1e-4) for gradient in parted.values())


@pytest.mark.thorough_after(1)
def test_a_part_of_the_decisions_estimates_the_gradient(policy: AnyPolicy) -> None:
    rng = np.random.default_rng(3)
    batch = make_batch([generate(rng, 7, name) for name in ("vrptw", "drone")], ["vrptw", "drone"])
    decisions = join(play(policy, batch).record)
    advantage = torch.linspace(-1, 1, batch.num_problems * NUM_ROLLOUTS)
    generator = torch.Generator().manual_seed(3)
    drawn = [draw_weights(decisions, advantage, 0.5, generator) for _ in range(40)]
    with_choice = int((decisions.count > 1).sum())
    assert np.mean([int((w > 0).sum()) for w in drawn]) == pytest.approx(0.5 * with_choice, rel=0.1)

    def flat_gradient(weight: Tensor) -> Tensor:
        gradients = gradient_of(policy, batch, decisions, weight, advantage)
        return torch.cat([gradient.flatten() for gradient in gradients.values()])

    exact = flat_gradient(all_of(decisions))
    errors = [flat_gradient(weight) - exact for weight in drawn]
    one, mean = torch.stack(errors).norm(dim=1).mean(), torch.stack(errors).mean(dim=0).norm()
    assert mean < 0.3 * one  # 1 / sqrt(40) without bias


def test_surprise_is_the_length_of_the_gradient_by_logits(batch: Batch) -> None:
    torch.manual_seed(5)
    policy = POLICIES["attention"]()
    scored: list[Tensor] = []
    decisions = join(play(policy, batch, scored).record)
    assert (decisions.surprise[decisions.count == 1] < 1e-3).all()
    assert (decisions.entropy[decisions.count == 1] < 1e-6).all()
    assert ((decisions.surprise >= 0) & (decisions.surprise <= 2 ** 0.5)).all()
    chosen = torch.stack([scored[int(s)][int(r)] for r, s in
                          zip(decisions.rollout, decisions.step, strict=True)]).exp()
    assert (decisions.surprise >= 1 - chosen - 1e-5).all()


def test_a_step_along_the_gradient_makes_cheap_rollouts_likelier(
        policy: AnyPolicy, batch: Batch) -> None:
    outcome = play(policy, batch)
    costs = torch.from_numpy(training_costs(batch, outcome, NUM_ROLLOUTS, 0.2)).float()
    advantage = shared_advantage(costs, costs[:, 0]).flatten()
    decisions = join(outcome.record)
    weight = all_of(decisions)
    before = policy_gradient(policy, batch, decisions, weight, advantage, 10_000, False)
    with torch.no_grad():
        for parameter in policy.parameters():
            if parameter.grad is not None:
                parameter.sub_(1e-3 * parameter.grad)
    policy.zero_grad()
    after = policy_gradient(policy, batch, decisions, weight, advantage, 10_000, False)
    assert after.policy < before.policy


def test_shared_advantage_has_no_mean_and_grows_with_the_root_of_the_spread() -> None:
    logarithms = torch.tensor([[2.0, 2.0, 2.0], [1.9, 2.0, 2.1], [1.6, 2.0, 2.4]])
    same, near, far = shared_advantage(logarithms.exp(), torch.zeros(3))
    torch.testing.assert_close(same, torch.zeros(3))
    torch.testing.assert_close(near, torch.tensor([-1.0, 0.0, 1.0]) * near[2])
    assert float(far[2] / near[2]) == pytest.approx(2.0, rel=0.02)  # 4 times the spread


def test_critic_advantage_compares_with_the_estimate() -> None:
    advantage = critic_advantage(torch.tensor([[3.0, 1.0]]), torch.tensor([2.0]))
    torch.testing.assert_close(advantage, torch.tensor([[0.5, -0.5]]))


def test_critic_learns_the_costs_of_a_batch(batch: Batch) -> None:
    torch.manual_seed(0)
    critic = Critic(16)
    optimizer = torch.optim.Adam(critic.parameters(), lr=1e-2)
    node, kind, _, mask = batch.encoder_inputs(CPU)
    costs = torch.linspace(1, 4, batch.num_problems)[:, None]
    errors = [critic_step(critic, optimizer, (node, kind, mask), costs)[1] for _ in range(100)]
    assert errors[-1] < 0.2 * errors[0]


def test_customers_left_out_weigh_less_in_training(batch: Batch) -> None:
    cost = empty_costs(batch.num_problems)
    cost["distance"], cost["unassigned"] = 2.0, 10.0
    outcome = Outcome(cost, np.ones(batch.num_problems, np.int64), None)  # type: ignore[arg-type]
    unit = batch.scale.cost * batch.instance.size["customers"]
    np.testing.assert_allclose(training_costs(batch, outcome, 1, 0.2)[:, 0] * unit, 4.0)
