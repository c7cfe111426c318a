"""The gradient step: probabilities computed anew, chunked gradients, baselines."""

from collections.abc import Callable

import numpy as np
import pytest
import torch
from torch import Tensor

from model.policy import PolicyNetwork
from model.policy_attention import AttentionConfig, AttentionPolicy
from model.policy_pointer import Critic, PointerConfig, PointerPolicy
from training.dataset import chunks, join, paths
from training.instances import VARIANTS, generate
from training.learn import (
    critic_advantage, critic_step, policy_gradient, shared_advantage, training_costs,
)
from training.policies import AnyPolicy
from training.rollout import Batch, Outcome, make_batch, roll_out, sampler

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
            log_probability = torch.log_softmax(logits, dim=1)
            scored.append(log_probability.gather(1, choice[:, None])[:, 0])
        return choice

    rollouts = np.repeat(np.arange(batch.num_problems), NUM_ROLLOUTS)
    return roll_out(policy, batch, rollouts, choose, CPU, 2)


@torch.no_grad()
def test_probabilities_computed_anew_are_those_of_the_rollout(
        policy: AnyPolicy, batch: Batch) -> None:
    scored: list[Tensor] = []
    decisions, choice = join(play(policy, batch, scored).record)
    expected = torch.cat(scored)
    memory = policy.encode(*batch.encoder_inputs(CPU)).flatten(0, 1).detach()
    hidden = policy.remember(memory, paths(decisions, batch.num_problems * NUM_ROLLOUTS))
    by_decision = {(int(r), int(s)): float(p) for r, s, p
                   in zip(decisions.rollout, decisions.step, expected, strict=True)}
    seen = 0
    for chunk in chunks(decisions, choice, 500):
        logits = policy.score(memory, chunk.here, chunk.candidate, chunk.feature, chunk.allowed,
                              chunk.glob, hidden[chunk.rollout, chunk.step])
        chosen = torch.log_softmax(logits, dim=1).gather(1, chunk.choice[:, None])[:, 0]
        for r, s, p in zip(chunk.rollout, chunk.step, chosen, strict=True):
            assert float(p) == pytest.approx(by_decision.pop((int(r), int(s))), abs=1e-4)
            seen += 1
    assert seen > 100
    assert all(probability == 0.0 for probability in by_decision.values())  # no choice there


def test_size_of_chunks_does_not_change_the_gradient(policy: AnyPolicy, batch: Batch) -> None:
    decisions, choice = join(play(policy, batch).record)
    advantage = torch.linspace(-1, 1, batch.num_problems * NUM_ROLLOUTS)
    gradients = []
    for max_candidates in (200, 100_000):
        policy.zero_grad()
        policy_gradient(policy, batch, decisions, choice, advantage, max_candidates, 0.1, False)
        gradients.append({name: parameter.grad.clone()
                          for name, parameter in policy.named_parameters()
                          if parameter.grad is not None})
    assert gradients[0].keys() == gradients[1].keys()
    for name, gradient in gradients[0].items():
        torch.testing.assert_close(gradient, gradients[1][name], rtol=1e-3, atol=1e-5)
    assert any(bool(gradient.abs().max() > 1e-4) for gradient in gradients[0].values())


def test_a_step_along_the_gradient_makes_cheap_rollouts_likelier(
        policy: AnyPolicy, batch: Batch) -> None:
    outcome = play(policy, batch)
    costs = torch.from_numpy(training_costs(batch, outcome, NUM_ROLLOUTS, 0.2)).float()
    advantage = shared_advantage(costs, costs[:, 0]).flatten()
    decisions, choice = join(outcome.record)
    before = policy_gradient(policy, batch, decisions, choice, advantage, 10_000, 0.0, False)
    with torch.no_grad():
        for parameter in policy.parameters():
            if parameter.grad is not None:
                parameter.sub_(1e-3 * parameter.grad)
    policy.zero_grad()
    after = policy_gradient(policy, batch, decisions, choice, advantage, 10_000, 0.0, False)
    assert after.policy < before.policy


def test_shared_advantage_has_no_mean_and_orders_by_cost() -> None:
    costs = torch.tensor([[1.0, 2.0, 3.0], [10.0, 10.0, 10.0]])
    advantage = shared_advantage(costs, torch.zeros(2))
    torch.testing.assert_close(advantage, torch.tensor([[-0.5, 0.0, 0.5], [0.0, 0.0, 0.0]]))


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
    cost = np.zeros((batch.num_problems, 6))
    cost[:, 1], cost[:, 5] = 2.0, 10.0
    outcome = Outcome(cost, np.ones(batch.num_problems, np.int64), None)  # type: ignore[arg-type]
    unit = batch.scale.cost * batch.instance.size[:, 1]
    np.testing.assert_allclose(training_costs(batch, outcome, 1, 0.2)[:, 0] * unit, 4.0)
