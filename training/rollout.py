"""Rollouts of a policy in the simulator, recorded step by step."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.engine.instance import Instance, pack
from model.engine.records import Records
from model.policy.decision_features import Rollouts, Scene
from model.policy.network import PolicyNetwork
from model.policy.problem_features import Scales, Tokens, scales, tokens
from model.problem import IntArray, Problem
from model.simulation.actions import max_steps
from training.dataset import Decisions

Chooser = Callable[[Tensor], Tensor]
"""From logits (..., candidate) to the index of the chosen candidate (...)."""


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
    def scene(self) -> Scene:
        """Return what decisions see of the problems."""
        return Scene(self.instance, self.scale, self.tokens.type)

    def encoder_inputs(self, device: torch.device) -> tuple[Tensor, ...]:
        """Return node, type and pair features and the token mask as tensors."""
        seen = self.tokens
        return tuple(to_device(array, device)
                     for array in (seen.node, seen.type, seen.pair, seen.mask))


@dataclass(frozen=True, eq=False)
class Outcome:
    """Where rollouts ended."""

    cost: Records  # (rollout,) by term
    num_unserved: IntArray  # (rollout,)
    record: list[Decisions]  # step by step


def to_device(array: np.ndarray, device: torch.device) -> Tensor:
    """Return an array as a tensor; on its way to an accelerator, it may be changed at once."""
    tensor = torch.from_numpy(array)
    if device.type == "cuda":
        return tensor.pin_memory().to(device, non_blocking=True)
    return tensor.to(device)


def to_host(tensor: Tensor) -> Callable[[], IntArray]:
    """Begin to copy a tensor of integers; return what waits for it, but for no later work."""
    copy = tensor.to("cpu", non_blocking=True)
    if tensor.device.type != "cuda":
        return copy.numpy
    copied = torch.cuda.Event()
    copied.record()

    def wait() -> IntArray:
        copied.synchronize()
        return copy.numpy()
    return wait


def make_batch(problems: Sequence[Problem], names: Sequence[str],
               rng: np.random.Generator | None = None) -> Batch:
    """Pack problems and describe them to the encoder, with `rng` in a random symmetry each."""
    instance = pack(problems)
    scale = scales(instance)
    coordinates = np.zeros((len(problems), instance.node.shape[2], 2))
    for row, problem in enumerate(problems):
        places = problem.coordinates
        if rng is not None:
            flip = rng.choice([-1.0, 1.0], 2)
            places = (places[:, ::-1] if rng.random() < 0.5 else places) * flip
        coordinates[row, : problem.num_nodes] = places
    return Batch(instance, scale, tokens(instance, scale, coordinates), tuple(names))


def greedy(logits: Tensor) -> Tensor:
    """Choose the likeliest candidates."""
    return logits.argmax(dim=-1)


def sampler(generator: torch.Generator) -> Chooser:
    """Choose candidates at random by their probabilities, with Gumbel noise."""
    def choose(logits: Tensor) -> Tensor:
        noise = torch.empty_like(logits).exponential_(generator=generator)
        # Noise may be exactly zero, whose logarithm would let even what is masked win.
        return (logits - torch.log(noise.clamp_min(torch.finfo(noise.dtype).tiny))).argmax(dim=-1)
    return choose


class Simulation:
    """Rollouts of some of a batch's problems in the simulator, by several threads."""

    def __init__(self, batch: Batch, problems: range, num_rollouts: int, num_threads: int) -> None:
        self.batch = batch
        self.num_rows = len(problems) * num_rollouts
        self.shape = (len(problems), num_rollouts)
        self.first_rollout = problems.start * num_rollouts  # among those of all problems
        self._rollouts = Rollouts(batch.scene, np.repeat(np.array(problems), num_rollouts),
                                  num_threads)
        self.state, self.seen = self._rollouts.state, self._rollouts.seen
        bounds = np.linspace(0, self.num_rows, num_threads + 1).astype(int).tolist()
        self._parts = list(zip(bounds, bounds[1:], range(num_threads), strict=False))
        self._pool = ThreadPoolExecutor(num_threads)

    def step(self, choice: IntArray) -> int:
        """Do the chosen actions, then list the legal ones. In place; return the largest count.

        `choice` is (rollout,), of no effect at the first step.
        """
        def part(first: int, behind: int, thread: int) -> int:
            return self._rollouts.step(choice, first, behind, thread)
        return max(self._pool.map(part, *zip(*self._parts, strict=True)))

    def inputs(self, most: int, device: torch.device) -> tuple[Tensor, ...]:
        """Return here, candidate, feature, allowed and glob for `score`, (problem, rollout, ...).

        Rollouts that have ended have no candidate.
        """
        seen = self.seen
        arrays = (seen.here, seen.token[:, :most], seen.feature[:, :most],
                  np.arange(most) < seen.count[:, None], seen.glob)
        return tuple(to_device(array, device).unflatten(0, self.shape) for array in arrays)

    def decisions(self, number: int, most: int, logits: Tensor, chosen: Tensor) -> Decisions:
        """Return what the rollouts that go on have seen at step `number` and have chosen."""
        seen = self.seen
        rows = np.flatnonzero(seen.count)
        count = seen.count[rows]
        is_real = np.arange(most) < count[:, None]
        arrays = (rows, np.full(len(rows), number), count, seen.here[rows], seen.glob[rows],
                  seen.token[rows, :most][is_real], seen.feature[rows, :most][is_real])
        alive, *tensors = (to_device(array, logits.device) for array in arrays)
        choice = chosen.flatten()[alive]
        log_probability = torch.log_softmax(logits.flatten(0, 1)[alive], dim=1)
        probability = log_probability.exp()
        of_chosen = probability.gather(1, choice[:, None])[:, 0]
        surprise = (1 - 2 * of_chosen + (probability ** 2).sum(dim=1)).clamp_min(0).sqrt()
        entropy = -(probability * log_probability).sum(dim=1)
        return Decisions(*(alive + self.first_rollout, *tensors, choice, surprise, entropy))

    def close(self) -> None:
        """Let go of the threads. In place."""
        self._pool.shutdown()


class PolicyRollouts:
    """Rollouts of some of a batch's problems by a policy, a decision of each at a time."""

    def __init__(self, simulation: Simulation, memory: Tensor, hidden: Tensor) -> None:
        self.simulation = simulation
        self.memory = memory
        self.hidden = hidden
        self.chosen = to_host(torch.zeros(simulation.num_rows, dtype=torch.int64))
        self.record: list[Decisions] = []

    def step(self, policy: PolicyNetwork, choose: Chooser) -> bool:
        """Do what was chosen and choose again. In place; False once all rollouts have ended."""
        simulation, device = self.simulation, self.memory.device
        most = simulation.step(self.chosen())
        if most == 0:
            return False
        here, candidate, feature, allowed, glob = simulation.inputs(most, device)
        self.hidden = policy.advance(self.memory, here, self.hidden)
        logits = policy.score(self.memory, here, candidate, feature, allowed, glob,
                              self.hidden).float()
        chosen = choose(logits)
        self.chosen = to_host(chosen.flatten())
        self.record.append(simulation.decisions(len(self.record), most, logits, chosen))
        return True


@torch.no_grad()
def roll_out(policy: PolicyNetwork, batch: Batch, num_rollouts: int, choose: Chooser,
             device: torch.device, num_threads: int = 2, num_parts: int | None = None) -> Outcome:
    """Plan each problem of a batch `num_rollouts` times with a policy.

    On an accelerator in two parts (`num_parts`): it scores what one chooses from while the
    simulator moves the other.
    """
    if num_parts is None:
        num_parts = 1 if device.type == "cpu" else min(2, batch.num_problems)
    memory = policy.encode(*batch.encoder_inputs(device)).float()
    parts = []
    for bounds in np.array_split(np.arange(batch.num_problems), num_parts):
        problems = range(int(bounds[0]), int(bounds[-1]) + 1)
        simulation = Simulation(batch, problems, num_rollouts, num_threads)
        parts.append(PolicyRollouts(simulation, memory[problems.start:problems.stop],
                                    memory.new_zeros(*simulation.shape, policy.hidden_size)))
    going = parts
    for _ in range(max_steps(batch.instance)):
        going = [part for part in going if part.step(policy, choose)]
        if not going:
            break
    for part in parts:
        part.simulation.close()
    states = [(part.simulation.state, part.simulation.num_rows) for part in parts]
    return Outcome(np.concatenate([state.cost[:rows] for state, rows in states]),
                   np.concatenate([state.num_unserved[:rows] for state, rows in states]),
                   [decisions for part in parts for decisions in part.record])
