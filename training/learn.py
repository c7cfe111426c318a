"""One gradient step: rewards, baselines, and the teacher-forced pass over recorded rollouts."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.cost import COST_UNASSIGNED
from model.policy import PolicyNetwork
from model.policy_pointer import Critic
from model.problem import FloatArray
from training.dataset import Chunk, Decisions, chunks, paths
from training.rollout import Batch, Outcome


@dataclass(frozen=True)
class Loss:
    """What one step saw."""

    policy: float
    entropy: float  # nats a decision
    decisions: int


def training_costs(batch: Batch, outcome: Outcome, num_rollouts: int,
                   unassigned_weight: float) -> FloatArray:
    """Return (problem, rollout) costs in units of the problem's scale and size.

    The penalty for customers left out is softened: one customer left out would outweigh every
    other difference between two plans.
    """
    weight = np.ones(outcome.cost.shape[1])
    weight[COST_UNASSIGNED] = unassigned_weight
    cost = (outcome.cost * weight).sum(axis=1).reshape(-1, num_rollouts)
    unit = batch.scale.cost * np.maximum(batch.instance.size[:, 1], 1)
    return cost / unit[:, None]


def shared_advantage(costs: Tensor, value: Tensor) -> Tensor:
    """Compare each rollout with the mean of its problem's rollouts."""
    mean = costs.mean(dim=1, keepdim=True)
    return (costs - mean) / mean.clamp_min(1e-6)


def critic_advantage(costs: Tensor, value: Tensor) -> Tensor:
    """Compare each rollout with what the critic expects of its problem."""
    expected = value.detach()[:, None]
    return (costs - expected) / expected.abs().clamp_min(0.1)


BASELINES: dict[str, Callable[[Tensor, Tensor], Tensor]] = {
    "critic": critic_advantage,
    "shared": shared_advantage,
}


def policy_gradient(policy: PolicyNetwork, batch: Batch, decisions: Decisions, choice: Tensor,
                    advantage: Tensor, max_candidates: int, entropy_weight: float,
                    autocast: bool) -> Loss:
    """Add the REINFORCE gradient of recorded rollouts to the policy's gradients. In place.

    Probabilities are computed anew for all decisions at once, given the recorded actions; chunk by
    chunk, so that memory stays bounded.

    Parameters
    ----------
    policy
        The network that made the rollouts.
    batch
        Their problems.
    decisions
        What each decision saw.
    choice
        (decision,) what it chose.
    advantage
        (rollout,) cost above the baseline, in standard deviations.
    max_candidates
        Size of a chunk.
    entropy_weight
        Weight of the entropy bonus.
    autocast
        Run the network in bfloat16 where that is safe.
    """
    device = advantage.device
    num_rollouts = len(advantage)
    with torch.autocast(device.type, torch.bfloat16, enabled=autocast):
        memory = policy.encode(*batch.encoder_inputs(device)).flatten(0, 1).float()
        memory_leaf = memory.detach().requires_grad_()
        hidden = policy.remember(memory_leaf, paths(decisions, num_rollouts))
    hidden_leaf = hidden.detach().requires_grad_()
    total, entropy = advantage.new_zeros(()), advantage.new_zeros(())
    for chunk in chunks(decisions, choice, max_candidates):
        log_probability = _log_probability(policy, memory_leaf, hidden_leaf, chunk, autocast)
        chosen = log_probability.gather(1, chunk.choice[:, None])[:, 0]
        probability = log_probability.exp()
        uncertainty = -(probability * log_probability).masked_fill(~chunk.allowed, 0.0).sum()
        loss = (advantage[chunk.rollout] * chosen).sum() - entropy_weight * uncertainty
        (loss / num_rollouts).backward()
        total += loss.detach()
        entropy += uncertainty.detach()
    if hidden.requires_grad and hidden_leaf.grad is not None and policy.hidden_size:
        hidden.backward(hidden_leaf.grad)
    if memory_leaf.grad is not None:
        memory.backward(memory_leaf.grad)
    count = len(decisions.count)
    return Loss(float(total) / num_rollouts, float(entropy) / count, count)


def _log_probability(policy: PolicyNetwork, memory: Tensor, hidden: Tensor, chunk: Chunk,
                     autocast: bool) -> Tensor:
    with torch.autocast(memory.device.type, torch.bfloat16, enabled=autocast):
        logits = policy.score(memory, chunk.here, chunk.candidate, chunk.feature, chunk.allowed,
                              chunk.glob, hidden[chunk.rollout, chunk.step])
    return torch.log_softmax(logits.float(), dim=1)


def critic_step(critic: Critic, optimizer: torch.optim.Optimizer, inputs: tuple[Tensor, ...],
                costs: Tensor) -> tuple[Tensor, float]:
    """Move the critic towards the mean cost of each problem. In place.

    Returns its estimates from before the step, (problem,), and their mean squared error.
    """
    value = critic(*inputs)
    loss = ((value - costs.mean(dim=1)) ** 2).mean()
    optimizer.zero_grad()
    loss.backward()
    optimizer.step()
    return value.detach(), float(loss.detach())
