"""Rollouts of a policy in the compiled simulator, recorded step by step."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.features import Observation, empty_observation, step
from model.instance import Instance, pack
from model.policy import PolicyNetwork
from model.problem import FloatArray, IntArray, Problem
from model.simulator import max_steps, reset
from model.tokens import Scales, Tokens, scales, tokens
from training.dataset import Decisions, Record, pad

Chooser = Callable[[Tensor], Tensor]
"""From logits (rollout, candidate) to the index of the chosen candidate (rollout,)."""


@dataclass(frozen=True, eq=False)
class Batch:
    """Problems packed for training, with what the encoder sees of them."""

    instance: Instance
    scale: Scales
    tokens: Tokens
    names: tuple[str, ...]  # variant of each problem

    @property
    def num_problems(self) -> int:
        """Problems in the batch."""
        return len(self.instance.size)

    @property
    def num_tokens(self) -> int:
        """Tokens of each problem, padding included."""
        return self.tokens.mask.shape[1]

    def encoder_inputs(self, device: torch.device) -> tuple[Tensor, ...]:
        """Return node, type and pair features and the token mask as tensors."""
        seen = self.tokens
        return tuple(torch.from_numpy(array).to(device)
                     for array in (seen.node, seen.type, seen.pair, seen.mask))


@dataclass(frozen=True, eq=False)
class Outcome:
    """Where rollouts ended."""

    cost: FloatArray  # (rollout, 6) by term
    num_unserved: IntArray  # (rollout,)
    record: Record


def make_batch(problems: Sequence[Problem], names: Sequence[str],
               rng: np.random.Generator | None = None) -> Batch:
    """Pack problems and describe them to the encoder, with `rng` in a random symmetry each."""
    instance = pack(problems)
    scale = scales(instance)
    coordinates = np.zeros((len(problems), instance.node.shape[1], 2))
    for row, problem in enumerate(problems):
        places = problem.coordinates
        if rng is not None:
            flip = rng.choice([-1.0, 1.0], 2)
            places = (places[:, ::-1] if rng.random() < 0.5 else places) * flip
        coordinates[row, : problem.num_nodes] = places
    return Batch(instance, scale, tokens(instance, scale, coordinates), tuple(names))


def greedy(logits: Tensor) -> Tensor:
    """Choose the likeliest candidates."""
    return logits.argmax(dim=1)


def sampler(generator: torch.Generator) -> Chooser:
    """Choose candidates at random by their probabilities, with Gumbel noise."""
    def choose(logits: Tensor) -> Tensor:
        noise = torch.empty_like(logits).exponential_(generator=generator)
        # Noise may be exactly zero, whose logarithm would let even what is masked win.
        return (logits - torch.log(noise.clamp_min(torch.finfo(noise.dtype).tiny))).argmax(dim=1)
    return choose


class Simulation:
    """Rollouts of a batch in the simulator, run by several threads."""

    def __init__(self, batch: Batch, rollouts: IntArray, num_threads: int) -> None:
        self.batch = batch
        self.num_rollouts = len(rollouts)
        self.offset = rollouts * batch.num_tokens
        self.state = reset(batch.instance, rollouts, num_threads)
        self.seen: Observation = empty_observation(
            self.num_rollouts, batch.instance.node.shape[1], batch.instance.type.shape[1])
        bounds = np.linspace(0, self.num_rollouts, num_threads + 1).astype(int).tolist()
        self._parts = list(zip(bounds, bounds[1:], range(num_threads), strict=False))
        self._pool = ThreadPoolExecutor(num_threads)

    def step(self, choice: IntArray) -> int:
        """Do the chosen actions, then list the legal ones. In place; return the largest count.

        `choice` is (rollout,), of no effect at the first step.
        """
        def part(first: int, behind: int, thread: int) -> int:
            return int(step(self.batch.instance, self.batch.scale, self.state,
                            self.batch.tokens.type, first, behind, self.num_rollouts + thread,
                            choice, self.seen))
        return max(self._pool.map(part, *zip(*self._parts, strict=True)))

    def decisions(self, number: int, most: int, device: torch.device) -> Decisions:
        """Return what the rollouts that go on have seen at step `number`, on a device."""
        seen = self.seen
        rows = np.flatnonzero(seen.count)
        count, offset = seen.count[rows], self.offset[rows]
        width = seen.token.shape[1]
        flat = (np.arange(most) + (rows * width)[:, None])[np.arange(most) < count[:, None]]
        candidate = seen.token.reshape(-1)[flat] + np.repeat(offset, count)
        feature = seen.feature.reshape(-1, seen.feature.shape[2])[flat]
        arrays = (rows, np.full(len(rows), number), count, seen.here[rows] + offset,
                  seen.glob[rows], candidate, feature)
        return Decisions(*(torch.from_numpy(array).to(device) for array in arrays))

    def close(self) -> None:
        """Let go of the threads. In place."""
        self._pool.shutdown()


@torch.no_grad()
def roll_out(policy: PolicyNetwork, batch: Batch, rollouts: IntArray, choose: Chooser,
             device: torch.device, num_threads: int = 2) -> Outcome:
    """Plan with a policy; `rollouts` (rollout,) names the problem of each."""
    simulation = Simulation(batch, rollouts, num_threads)
    memory = policy.encode(*batch.encoder_inputs(device)).flatten(0, 1).float()
    hidden = memory.new_zeros(len(rollouts), policy.hidden_size)
    choice = np.zeros(len(rollouts), np.int64)
    record = Record()
    for number in range(max_steps(batch.instance)):
        most = simulation.step(choice)
        if most == 0:
            break
        seen = simulation.decisions(number, most, device)
        first = torch.cumsum(seen.count, 0) - seen.count
        now = pad(seen, seen.count, torch.arange(len(seen.count), device=device), first, most)
        after = policy.advance(memory, now.here, hidden[now.rollout])
        hidden[now.rollout] = after
        chosen = choose(policy.score(memory, now.here, now.candidate, now.feature, now.allowed,
                                     now.glob, after).float())
        record.seen.append(seen)
        record.choice.append(chosen)
        choice[simulation.seen.count > 0] = chosen.cpu().numpy()
    simulation.close()
    state = simulation.state
    return Outcome(state.cost[: len(rollouts)].copy(),
                   state.num_unserved[: len(rollouts)].copy(), record)
