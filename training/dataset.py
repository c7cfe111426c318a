"""Recorded decisions, flattened over candidates, and their padding into tensors for the network."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.problem import IntArray

GROUP = 64
"""Problems side by side in a chunk, with about equally many candidates each."""
ALIKE = 0.6
"""Least share of a chunk's most candidates that a group's largest decision of a rank has."""


@dataclass(frozen=True, eq=False)
class Decisions:
    """Decisions of a set of rollouts on one device; candidates are flattened."""

    rollout: Tensor  # (decision,) among those of all problems
    step: Tensor  # (decision,) within its rollout
    count: Tensor  # (decision,) candidates
    here: Tensor  # (decision,) token of the place
    glob: Tensor  # (decision, feature)
    candidate: Tensor  # (candidate,) token
    feature: Tensor  # (candidate, feature)
    choice: Tensor  # (decision,) index of the chosen candidate
    surprise: Tensor  # (decision,) length of the gradient of log probability by logits
    entropy: Tensor  # (decision,) nats


@dataclass(frozen=True, eq=False)
class Chunk:
    """Decisions of similar size of some problems, padded to the most decisions and candidates."""

    problem: Tensor  # (problem,)
    rollout: Tensor  # (problem, decision)
    step: Tensor  # (problem, decision)
    here: Tensor  # (problem, decision)
    choice: Tensor  # (problem, decision)
    weight: Tensor  # (problem, decision) 0 for padding
    glob: Tensor  # (problem, decision, feature)
    candidate: Tensor  # (problem, decision, candidate) token
    feature: Tensor  # (problem, decision, candidate, feature)
    allowed: Tensor  # (problem, decision, candidate)


def join(steps: Sequence[Decisions]) -> Decisions:
    """Join the decisions of all steps."""
    return Decisions(*(torch.cat([getattr(part, name) for part in steps])
                       for name in Decisions.__dataclass_fields__))


def paths(decisions: Decisions, num_rollouts: int) -> Tensor:
    """Return the places before each decision, (rollout, step), 0 behind the last."""
    path = decisions.here.new_zeros(num_rollouts, int(decisions.step.max()) + 1)
    path[decisions.rollout, decisions.step] = decisions.here
    return path


def chunks(decisions: Decisions, weight: Tensor, num_rollouts: int,
           max_candidates: int) -> Iterator[Chunk]:
    """Yield all decisions of some weight, `max_candidates` at most in each chunk.

    Parameters
    ----------
    decisions
        Those of `num_rollouts` rollouts of each problem.
    weight
        (decision,); those of none are left out, like those with one candidate alone.
    num_rollouts
        Rollouts of each problem.
    max_candidates
        Bound of a chunk's padded candidates.
    """
    count = decisions.count.cpu().numpy()
    kept = np.flatnonzero((count > 1) & (weight.cpu().numpy() > 0))
    problem = decisions.rollout.cpu().numpy()[kept] // num_rollouts
    kept = kept[np.lexsort((-count[kept], problem))]
    problems, begin, size = np.unique(np.sort(problem), return_index=True, return_counts=True)
    order = np.argsort([count[kept[first:first + number]].sum()
                        for first, number in zip(begin, size, strict=True)])
    first_candidate = torch.cumsum(decisions.count, 0) - decisions.count
    for part in range(0, len(order), GROUP):
        rows = order[part:part + GROUP]
        ranks = np.arange(size[rows].max())
        ranked = np.where(ranks < size[rows, None],
                          kept[np.minimum(begin[rows, None] + ranks, len(kept) - 1)], -1)
        for index in _bands(ranked, np.where(ranked < 0, 0, count[ranked]).max(axis=0),
                            max_candidates):
            yield _pad(decisions, weight, first_candidate, problems[rows], index)


def _bands(ranked: IntArray, most: IntArray, max_candidates: int) -> Iterator[IntArray]:
    """Cut (problem, rank) where candidates, `most` (rank,) of falling size, get fewer."""
    begin = 0
    while begin < len(most):
        alike = int(np.searchsorted(-most, -ALIKE * most[begin], side="right"))
        room = max(1, max_candidates // (len(ranked) * int(most[begin])))
        end = min(alike, begin + room)
        yield ranked[:, begin:end]
        begin = end


def _pad(decisions: Decisions, weight: Tensor, first_candidate: Tensor, problems: IntArray,
         ranked: IntArray) -> Chunk:
    """Pad the decisions `ranked` (problem, decision), -1 where there is none."""
    device = weight.device
    index = torch.from_numpy(ranked).to(device)
    is_real = index >= 0
    index = index.clamp_min(0)
    count = torch.where(is_real, decisions.count[index], 0)
    offset = torch.arange(int(count.max()), device=device)
    allowed = offset < count[..., None]
    flat = torch.where(allowed, first_candidate[index][..., None] + offset, 0)
    return Chunk(
        torch.from_numpy(problems).to(device), decisions.rollout[index], decisions.step[index],
        decisions.here[index], decisions.choice[index] * is_real, weight[index] * is_real,
        decisions.glob[index], decisions.candidate[flat] * allowed, decisions.feature[flat],
        allowed)
