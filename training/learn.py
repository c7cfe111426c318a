"""One gradient step: rewards, baselines, and the teacher-forced pass over recorded rollouts."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.policy.network import PolicyNetwork
from model.policy.pointer import Critic
from model.problem import FloatArray
from model.simulation.state import by_term, empty_costs
from training.dataset import Chunk, Decisions, chunks, paths
from training.rollout import Batch, Outcome


LEAST_SPREAD = 0.002
"""Relative differences between rollouts below which they count for little."""


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
    weight = empty_costs(1)
    by_term(weight)[:] = 1.0
    weight["unassigned"] = unassigned_weight
    cost = (by_term(outcome.cost) * by_term(weight)).sum(axis=1).reshape(-1, num_rollouts)
    unit = batch.scale.cost * np.maximum(batch.instance.size["customers"], 1)
    return cost / unit[:, None]


def shared_advantage(costs: Tensor, value: Tensor) -> Tensor:
    """Compare the logarithm of each rollout's cost with the mean of its problem's rollouts.

    So the geometric mean of costs is what falls, and a rollout that leaves customers out does not
    drown the others. Differences are divided by the root of their standard deviation: halfway
    between all problems counting the same and counting by how much their rollouts differ.
    """
    logarithm = costs.clamp_min(1e-6).log()
    relative = logarithm - logarithm.mean(dim=1, keepdim=True)
    return relative / (relative.std(dim=1, keepdim=True) + LEAST_SPREAD).sqrt()


def critic_advantage(costs: Tensor, value: Tensor) -> Tensor:
    """Compare each rollout with what the critic expects of its problem."""
    expected = value.detach()[:, None]
    return (costs - expected) / expected.abs().clamp_min(0.1)


BASELINES: dict[str, Callable[[Tensor, Tensor], Tensor]] = {
    "critic": critic_advantage,
    "shared": shared_advantage,
}


def draw_weights(decisions: Decisions, advantage: Tensor, kept: float,
                 generator: torch.Generator) -> Tensor:
    """Draw the decisions that the gradient is estimated from, and how much each of them counts.

    A decision is drawn with a probability proportional to the length of its part of the gradient
    (by logits), 1 at most, so certain ones are mostly left out, and counts by the inverse, so the
    estimate is unbiased.

    Parameters
    ----------
    decisions
        Recorded decisions.
    advantage
        (rollout,).
    kept
        Share of the decisions with a choice that is drawn, in expectation.
    generator
        Random numbers.

    Returns
    -------
    (decision,) weights, 0 for those not drawn.
    """
    length = advantage[decisions.rollout].abs() * decisions.surprise * (decisions.count > 1)
    wanted = kept * float((decisions.count > 1).sum())
    low, high = 0.0, float(length.max()) / max(kept, 1e-6) + 1e-9
    for _ in range(30):
        middle = (low + high) / 2
        if float((length / middle).clamp_max(1.0).sum()) > wanted:
            low = middle
        else:
            high = middle
    probability = (length / high).clamp_max(1.0)
    draw = torch.rand(len(length), generator=generator, device=length.device)
    return torch.where(draw < probability, 1 / probability.clamp_min(1e-9), 0.0)


def policy_gradient(policy: PolicyNetwork, batch: Batch, decisions: Decisions, weight: Tensor,
                    advantage: Tensor, max_candidates: int, autocast: bool) -> Loss:
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
        What each decision saw and chose.
    weight
        (decision,) how much each counts; those of no weight are not computed.
    advantage
        (rollout,) cost above the baseline, in standard deviations.
    max_candidates
        Size of a chunk.
    autocast
        Run the network in bfloat16 where that is safe.
    """
    device = advantage.device
    num_rollouts = len(advantage) // batch.num_problems
    with torch.autocast(device.type, torch.bfloat16, enabled=autocast):
        memory = policy.encode(*batch.encoder_inputs(device)).float()
        path = paths(decisions, len(advantage)).unflatten(0, (batch.num_problems, num_rollouts))
        hidden = policy.remember(memory, path).flatten(0, 1)
    memory_gradient, hidden_gradient = torch.zeros_like(memory), torch.zeros_like(hidden)
    total, computed = advantage.new_zeros(()), 0
    for chunk in chunks(decisions, weight, num_rollouts, max_candidates):
        # Leaves of the chunk's size alone: gradients of the whole memory would be added up anew
        # for each chunk.
        own_memory = memory.detach()[chunk.problem].requires_grad_()
        own_hidden = hidden.detach()[chunk.rollout, chunk.step].requires_grad_()
        chosen = _log_probability(policy, own_memory, own_hidden, chunk, autocast)
        loss = (advantage[chunk.rollout] * chunk.weight * chosen).sum()
        (loss / len(advantage)).backward()
        memory_gradient.index_add_(0, chunk.problem, _gradient(own_memory))
        hidden_gradient.index_put_((chunk.rollout, chunk.step), _gradient(own_hidden),
                                   accumulate=True)
        total += loss.detach()
        computed += int((chunk.weight > 0).sum())
    if hidden.requires_grad:
        torch.autograd.backward([memory, hidden], [memory_gradient, hidden_gradient])
    else:
        memory.backward(memory_gradient)
    return Loss(float(total) / len(advantage), float(decisions.entropy.mean()), computed)


def _gradient(leaf: Tensor) -> Tensor:
    """Return the gradient of a leaf, 0 if nothing depends on it."""
    return torch.zeros_like(leaf) if leaf.grad is None else leaf.grad


def _log_probability(policy: PolicyNetwork, memory: Tensor, hidden: Tensor, chunk: Chunk,
                     autocast: bool) -> Tensor:
    """Return the log-probabilities of what was chosen, (problem, decision)."""
    with torch.autocast(memory.device.type, torch.bfloat16, enabled=autocast):
        logits = policy.score(memory, chunk.here, chunk.candidate, chunk.feature, chunk.allowed,
                              chunk.glob, hidden)
    return torch.log_softmax(logits.float(), dim=2).gather(2, chunk.choice[..., None])[..., 0]


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
