"""Train a policy by REINFORCE. Read from top to bottom; run with `python -m training.train`.

One process, or many: `torchrun --nproc-per-node=N -m training.train ...`. A run that finds its
checkpoint goes on from there exactly: weights, optimisers, step of the curriculum, random numbers.
"""

import csv
import dataclasses
import os
import signal
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import torch
import torch.distributed as dist
import tyro
from torch.utils.tensorboard import SummaryWriter
from tqdm import tqdm

from model.policy.pointer import Critic
from model.simulation.state import by_term
from training.config import TrainConfig
from training.dataset import join
from training.export import WEIGHTS
from training.heuristics import nearest_neighbour
from training.instances import VALIDATED, generate, sample_variant, validation_set
from training.learn import BASELINES, critic_step, draw_weights, policy_gradient, training_costs
from training.policies import POLICIES, train_new_alone, widened
from training.rollout import Batch, greedy, make_batch, roll_out, sampler

SAVE_EVERY = 120.0
VALIDATE_EVERY = 300.0
BF16_DEVICES = ("cuda",)
STOP = threading.Event()
"""Set by a signal: finish the step, save, end."""


@dataclass(frozen=True)
class TrainingLeg:
    """Train a policy; goes on from the checkpoint in the folder if there is one."""

    folder: Path
    """Receives `checkpoint.pt`, `log.csv`, `validation.csv` and TensorBoard's events."""
    config: Annotated[TrainConfig, tyro.conf.arg(name="")] = field(default_factory=TrainConfig)
    """The run."""
    minutes: float = 60.0
    """Length of this leg."""
    device: str = "cpu"
    """`cpu` or `cuda`."""
    max_steps: int | None = None
    """Stop at this step even if time is left."""
    validation_size: int = 80
    """How many problems of the fixed validation set to plan at each validation."""
    begin_with: Path | None = None
    """Folder of an exported policy, whose weights a run without a checkpoint begins with."""


def train(leg: TrainingLeg) -> dict[str, float]:
    """Train for some minutes or up to a step; return the last validation's ratios by variant.

    Raises
    ------
    ValueError
        If the folder to begin with has no weights of this policy.
    """
    with processes() as (rank, world):
        ratios = _train(leg, rank, world)
        if world > 1:
            # A process that leaves while another still listens to it may be aborted.
            dist.barrier()
    return ratios


def _train(leg: TrainingLeg, rank: int, world: int) -> dict[str, float]:
    config, folder, max_steps = leg.config, leg.folder, leg.max_steps
    device = torch.device(leg.device)
    folder.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(config.seed)
    run = Run(config, device, rank)
    run.begin(folder / "checkpoint.pt", leg.begin_with)
    validation = validation_batches(leg.validation_size, config.variants or VALIDATED)
    log = Log(folder) if rank == 0 else None
    began = saved = time.monotonic()
    validated = began - VALIDATE_EVERY + min(60.0, VALIDATE_EVERY)
    bar = tqdm(desc=config.policy, unit="problem", disable=rank != 0)
    while not agree_to_stop(run.step == max_steps or time.monotonic() - began > 60 * leg.minutes
                            or STOP.is_set(), world):
        numbers = run.train_step(world)
        bar.update(int(numbers["problems"]) * world)
        if log is None:
            continue
        log.write("log.csv", {"step": run.step, "seconds": run.seconds(), **numbers})
        bar.set_postfix(n=int(numbers["customers"]), cost=f"{numbers['cost']:.3f}",
                        entropy=f"{numbers['entropy']:.2f}")
        if time.monotonic() - validated > VALIDATE_EVERY:
            log.write("validation.csv", {"step": run.step, "seconds": run.seconds(),
                                         **validate(run, validation)})
            validated = time.monotonic()
        if time.monotonic() - saved > SAVE_EVERY:
            run.save(folder / "checkpoint.pt")
            saved = time.monotonic()
    ratios: dict[str, float] = {}
    if log is not None:
        run.save(folder / "checkpoint.pt")
        ratios = validate(run, validation)
        log.write("validation.csv", {"step": run.step, "seconds": run.seconds(), **ratios})
        log.close()
    bar.close()
    return ratios


@contextmanager
def processes() -> Iterator[tuple[int, int]]:
    """Join the other processes if a launcher started several; yield rank and number.

    However training ends, PyTorch's threads end before the interpreter does: one that lets go of a
    tensor later aborts the process.
    """
    if "WORLD_SIZE" not in os.environ:
        yield 0, 1
        return
    dist.init_process_group("nccl" if torch.cuda.is_available() else "gloo")
    try:
        yield dist.get_rank(), dist.get_world_size()
    finally:
        dist.destroy_process_group()


def agree_to_stop(wish: bool, world: int) -> bool:
    """Tell whether any process wishes to stop, so that none waits for another's gradients."""
    if world == 1:
        return wish
    wishes = torch.tensor(float(wish), device="cuda" if torch.cuda.is_available() else "cpu")
    dist.all_reduce(wishes, op=dist.ReduceOp.MAX)
    return bool(wishes > 0)


class Run:
    """What a checkpoint keeps: networks, optimisers, step."""

    def __init__(self, config: TrainConfig, device: torch.device, rank: int) -> None:
        self.config = config
        self.device = device
        self.num_threads = len(os.sched_getaffinity(0))
        self.policy = POLICIES[config.policy]().to(device)
        self.critic = Critic().to(device)
        self.optimizer = torch.optim.AdamW(self.policy.parameters(), lr=config.learning_rate,
                                           weight_decay=1e-6)
        self.critic_optimizer = torch.optim.Adam(self.critic.parameters(), lr=config.critic_rate)
        self.rank = rank
        self.known = dict[str, int]()  # columns of layers, of which it began with fewer
        self.step = 0
        self.spread = 1.0  # running standard deviation of advantages
        self.past_seconds = 0.0
        self.began = time.monotonic()

    def seconds(self) -> float:
        """Return the training time of all legs so far."""
        return self.past_seconds + time.monotonic() - self.began

    def draw_batch(self, rng: np.random.Generator) -> Batch:
        """Draw problems of one size, of all variants."""
        size = self.config.size_at(self.step)
        if rng.random() < self.config.size_mix:
            size = int(rng.integers(self.config.sizes[0][1] // 2, size + 1))
        number, some = self.config.problems_at(size), self.config.variants
        names = [some[int(rng.integers(len(some)))] if some else sample_variant(rng)
                 for _ in range(number)]
        problems = [generate(rng, size, name) for name in names]
        return make_batch(problems, names, rng)

    def train_step(self, world: int) -> dict[str, float]:
        """Roll out, compare with the baseline, move both networks. In place; return numbers."""
        config = self.config
        began = time.monotonic()
        # Random numbers follow from seed, process and step alone, so a resumed run goes on exactly.
        rng = np.random.default_rng((config.seed, self.rank, self.step))
        generator = torch.Generator(self.device).manual_seed(int(rng.integers(2**62)))
        batch = self.draw_batch(rng)
        with torch.autocast(self.device.type, torch.bfloat16,
                            enabled=self.device.type in BF16_DEVICES):
            outcome = roll_out(self.policy, batch, config.num_rollouts, sampler(generator),
                               self.device, self.num_threads)
        rolled = time.monotonic()
        costs = torch.from_numpy(training_costs(
            batch, outcome, config.num_rollouts, config.unassigned_weight)).float().to(self.device)
        node, kind, _, mask = batch.encoder_inputs(self.device)
        value, critic_loss = critic_step(self.critic, self.critic_optimizer, (node, kind, mask),
                                         costs)
        advantage = BASELINES[config.baseline](costs, value).flatten()
        self.spread = 0.95 * self.spread + 0.05 * float(advantage.std())
        advantage = (advantage / self.spread).clamp(-4, 4)
        self.optimizer.zero_grad()
        decisions = join(outcome.record)
        weight = draw_weights(decisions, advantage, config.kept, generator)
        loss = policy_gradient(self.policy, batch, decisions, weight, advantage,
                               config.max_candidates, self.device.type in BF16_DEVICES)
        norm = self.move(world)
        self.step += 1
        ended = time.monotonic()
        return {"customers": int(batch.instance.size[0].customers), "problems": batch.num_problems,
                "cost": float(costs.mean()), "unserved": float(outcome.num_unserved.mean()),
                "policy_loss": loss.policy, "critic_loss": critic_loss, "entropy": loss.entropy,
                "gradient_norm": norm, "problems_per_second":
                batch.num_problems * world / (ended - began), "rollout_share":
                (rolled - began) / (ended - began)}

    def move(self, world: int) -> float:
        """Take the optimiser's step with the gradients of all processes; return their norm."""
        if world > 1:
            for parameter in self.policy.parameters():
                if parameter.grad is None:
                    parameter.grad = torch.zeros_like(parameter)
                dist.all_reduce(parameter.grad, op=dist.ReduceOp.AVG)
            for parameter in self.critic.parameters():
                dist.all_reduce(parameter.data, op=dist.ReduceOp.AVG)
        norm = torch.nn.utils.clip_grad_norm_(self.policy.parameters(), self.config.gradient_clip)
        for group in self.optimizer.param_groups:
            group["lr"] = self.config.learning_rate_at(self.step)
        self.optimizer.step()
        return float(norm)

    def save(self, path: Path) -> None:
        """Write the checkpoint whole or not at all."""
        content = {
            "config": dataclasses.asdict(self.config), "policy": self.policy.state_dict(),
            "critic": self.critic.state_dict(), "optimizer": self.optimizer.state_dict(),
            "critic_optimizer": self.critic_optimizer.state_dict(),
            "known": self.known, "step": self.step, "spread": self.spread,
            "seconds": self.seconds()}
        torch.save(content, path.with_suffix(".part"))
        path.with_suffix(".part").replace(path)

    def load(self, path: Path) -> None:
        """Go on from a checkpoint. In place."""
        content: dict[str, Any] = torch.load(path, map_location=self.device, weights_only=False)
        self.policy.load_state_dict(content["policy"])
        self.know(content["known"])
        self.critic.load_state_dict(content["critic"])
        self.optimizer.load_state_dict(content["optimizer"])
        self.critic_optimizer.load_state_dict(content["critic_optimizer"])
        self.step, self.spread = content["step"], content["spread"]
        self.past_seconds = content["seconds"]


    def begin(self, checkpoint: Path, exported: Path | None) -> None:
        """Go on from a checkpoint; without one, begin with an exported policy, if any. In place."""
        if checkpoint.exists():
            self.load(checkpoint)
        elif exported is not None:
            self.take_weights(exported / WEIGHTS)

    def take_weights(self, path: Path) -> None:
        """Begin with an exported policy's weights; of features that they lack, with none. In place.

        Raises
        ------
        ValueError
            If they can't be read, or are another policy's.
        """
        try:
            weights = torch.load(path, map_location=self.device, weights_only=True)
            self.policy.load_state_dict(widened(self.policy, weights))
            self.know({name: weights[name].shape[1] for name, own in self.policy.named_parameters()
                       if weights[name].shape != own.shape})
        except (OSError, RuntimeError) as error:
            raise ValueError(f"begin_with: {str(path)!r} is not usable: {error}") from error


    def know(self, columns: dict[str, int]) -> None:
        """Note how many columns layers had; train those behind alone, if the run does. In place."""
        self.known = columns
        if self.config.only_new:
            train_new_alone(self.policy, columns)


def validation_batches(size: int, names: Sequence[str] = VALIDATED
                       ) -> list[tuple[Batch, np.ndarray]]:
    """Pack the fixed validation set by size, each with its nearest-neighbour costs."""
    groups: dict[int, list[tuple[str, Any]]] = {}
    for name, problem in validation_set(size, names=names):
        groups.setdefault(problem.num_customers, []).append((name.split("-")[0], problem))
    batches = [make_batch([problem for _, problem in group], [name for name, _ in group])
               for group in groups.values()]
    return [(batch, nearest_neighbour(batch)) for batch in batches]


def validate(run: Run, batches: list[tuple[Batch, np.ndarray]]) -> dict[str, float]:
    """Plan greedily; return, by variant and size, costs over the nearest neighbour's.

    Geometric means: one customer left out can make a ratio of ten.
    """
    ratios: dict[str, list[float]] = {}
    for batch, reference in batches:
        outcome = roll_out(run.policy, batch, 1, greedy, run.device,
                           run.num_threads)
        size = int(batch.instance.size[0].customers)
        for name, cost, nearest in zip(batch.names, by_term(outcome.cost).sum(axis=1), reference,
                                       strict=True):
            for key in (name, f"n{size}", "all"):
                ratios.setdefault(key, []).append(max(float(cost), 1e-9) / max(nearest, 1e-9))
    return {key: float(np.exp(np.mean(np.log(ratios[key])))) for key in sorted(ratios)}


class Log:
    """CSV files and TensorBoard's events in one folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._board = SummaryWriter(str(folder))

    def write(self, name: str, row: dict[str, float]) -> None:
        """Append a row and plot its numbers over the step."""
        path = self._folder / name
        is_new = not path.exists()
        with path.open("a", newline="") as file:
            writer = csv.DictWriter(file, list(row))
            if is_new:
                writer.writeheader()
            writer.writerow(row)
        for key, value in row.items():
            self._board.add_scalar(f"{path.stem}/{key}", value, int(row["step"]))

    def close(self) -> None:
        """Write what is left."""
        self._board.close()


def main() -> None:
    """Train by what the command line states."""
    leg = tyro.cli(TrainingLeg)
    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, lambda *_: STOP.set())
    print(train(leg))


if __name__ == "__main__":
    main()
