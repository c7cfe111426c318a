"""Recorded decisions, flattened over candidates, and their padding into tensors for the network."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
import torch
from torch import Tensor


@dataclass(frozen=True, eq=False)
class Decisions:
    """Decisions of a set of rollouts on one device; candidates are flattened."""

    rollout: Tensor  # (decision,)
    step: Tensor  # (decision,) within its rollout
    count: Tensor  # (decision,) candidates
    here: Tensor  # (decision,) token of the place
    glob: Tensor  # (decision, feature)
    candidate: Tensor  # (candidate,) token
    feature: Tensor  # (candidate, feature)


@dataclass
class Record:
    """What rollouts decided, step after step."""

    seen: list[Decisions] = field(default_factory=list)
    choice: list[Tensor] = field(default_factory=list)  # (decision,) index of the candidate


@dataclass(frozen=True, eq=False)
class Chunk:
    """Decisions of similar size, padded to the largest."""

    rollout: Tensor  # (decision,)
    step: Tensor  # (decision,)
    here: Tensor  # (decision,)
    choice: Tensor  # (decision,)
    glob: Tensor  # (decision, feature)
    candidate: Tensor  # (decision, candidate) token
    feature: Tensor  # (decision, candidate, feature)
    allowed: Tensor  # (decision, candidate)


def join(record: Record) -> tuple[Decisions, Tensor]:
    """Join all steps: the decisions and their choices."""
    parts = record.seen
    joined = Decisions(*(torch.cat([getattr(part, name) for part in parts])
                         for name in Decisions.__dataclass_fields__))
    return joined, torch.cat(record.choice)


def paths(decisions: Decisions, num_rollouts: int) -> Tensor:
    """Return the places before each decision, (rollout, step), 0 behind the last."""
    path = decisions.here.new_zeros(num_rollouts, int(decisions.step.max()) + 1)
    path[decisions.rollout, decisions.step] = decisions.here
    return path


def chunks(decisions: Decisions, choice: Tensor, max_candidates: int) -> Iterator[Chunk]:
    """Yield all decisions with a choice to learn from, `max_candidates` at most in each chunk.

    Decisions with one candidate alone teach nothing and are left out.
    """
    order = torch.argsort(decisions.count)
    first = torch.cumsum(decisions.count, 0) - decisions.count
    sizes = decisions.count[order].cpu().numpy()
    begin = int(np.searchsorted(sizes, 2))
    while begin < len(sizes):
        alike = int(np.searchsorted(sizes, 1.2 * sizes[begin] + 2, side="right"))
        end = min(alike, begin + max(1, max_candidates // int(sizes[alike - 1])))
        yield pad(decisions, choice, order[begin:end], first[order[begin:end]],
                  int(sizes[end - 1]))
        begin = end


def pad(decisions: Decisions, choice: Tensor, index: Tensor, first: Tensor, most: int) -> Chunk:
    """Pad the candidates of the decisions `index`, that begin at `first`, to `most`."""
    offset = torch.arange(most, device=index.device)
    allowed = offset < decisions.count[index][:, None]
    flat = torch.where(allowed, first[:, None] + offset, 0)
    feature = decisions.feature[flat] * allowed[..., None]
    return Chunk(decisions.rollout[index], decisions.step[index], decisions.here[index],
                 choice[index], decisions.glob[index], decisions.candidate[flat], feature, allowed)
