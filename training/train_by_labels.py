"""Train a policy further by labels: which decision would have been better, and by how much.

Run with `python -m training.train_by_labels --folder runs/by-labels --labels runs/labels`, beside
`training.labels`, which plans by the newest weights. A run that finds its checkpoint goes on from
there. The weights worth exporting are the mean of those of late steps, which the checkpoint has as
`policy`.
"""

import csv
import os
import signal
import threading
import time
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import torch
import tyro
from torch import Tensor
from torch.nn.functional import softplus
from tqdm import tqdm

from model.policy.network import MASKED, PolicyNetwork
from training.config import TrainConfig
from training.dataset import join
from training.examples import Lesson, make_lesson
from training.export import WEIGHTS
from training.instances import generate, sample_variant
from training.labels import NEWEST, Labelled, read
from training.learn import draw_weights, policy_gradient, shared_advantage, training_costs
from training.policies import POLICIES
from training.rollout import make_batch, roll_out, sampler

HELD_OUT = 20
"""One problem in so many is never learnt from."""

REREAD_EVERY, NEWEST_EVERY, SAVE_EVERY = 30.0, 1200.0, 120.0
"""Seconds between looks for new labels, newer weights to plan by, checkpoints."""

LABELLING = "attention"
"""The policy that `training.labels` plans by, and whose newest weights it is told."""

CPU = torch.device("cpu")
STOP = threading.Event()
"""Set by a signal: finish the step, save, end."""


@dataclass(frozen=True)
class LabelConfig:
    """A run."""

    policy: str = LABELLING
    seed: int = 0
    learning_rate: float = 1e-4
    warm_up: int = 50  # steps
    decay: tuple[int, int] = (10**9, 10**9)  # steps between which the rate falls to a twentieth
    plans: int = 16  # in a step
    shown: float = 0.1  # weight of the search's decisions after the better choice
    calm: float = 10.0  # of the distance from the policy it began with, where nothing was wrong
    ordered: float = 1.0  # weight of pairs
    compared: float = 1.0  # weight of choices that were tried
    reinforce_every: int = 4  # steps; 0: never
    problems: int = 6  # in a step of REINFORCE
    rollouts: int = 8  # of each
    averaged: float = 0.998  # share of the mean of weights that stays at each step
    kept: int = 40_000  # plans
    gradient_clip: float = 1.0

    def rate_at(self, step: int) -> float:
        """Return the learning rate of a step."""
        rate = self.learning_rate * min(1.0, (step + 1) / self.warm_up)
        first, last = self.decay
        if step >= first:
            rate *= max(0.05, 1 - 0.95 * (step - first) / max(1, last - first))
        return rate


class Buffer:
    """The labels that are there, without those held out, in the order of their size."""

    def __init__(self, folder: Path, kept: int) -> None:
        self._folder, self._kept = folder, kept
        self._known: set[Path] = set()
        self._read_at = -REREAD_EVERY
        self.plans: list[Labelled] = []
        self.held_out: list[Labelled] = []

    def refresh(self) -> None:
        """Read the files that are new. In place."""
        if time.monotonic() - self._read_at < REREAD_EVERY:
            return
        self._read_at = time.monotonic()
        for path in sorted(set(self._folder.glob("*.npz")) - self._known,
                           key=lambda path: path.stat().st_mtime):
            self._known.add(path)
            for plan in read(path):
                out = plan.origin.seed % HELD_OUT == 0
                (self.held_out if out else self.plans).append(plan)
        del self.plans[:-self._kept]

    def draw(self, number: int, rng: np.random.Generator) -> list[Labelled]:
        """Return plans of similar size."""
        size = self.plans[int(rng.integers(len(self.plans)))].origin.size
        pool = rng.choice(len(self.plans), min(8 * number, len(self.plans)), replace=False)
        nearest = sorted(pool.tolist(), key=lambda i: abs(self.plans[i].origin.size - size))
        return [self.plans[index] for index in nearest[:number]]


@dataclass(frozen=True)
class Seen:
    """What one step saw."""

    loss: float
    pair: float
    shown: float
    calm: float
    compared: float
    best: float  # share of trials whose cheapest choice is preferred, by what it saves
    order: float  # share of pairs in the right order
    pairs: int


def logits_of(policy: PolicyNetwork, lesson: Lesson) -> Tensor:
    """Score the candidates of all decisions, (plan, decision, candidate)."""
    memory = policy.encode(*lesson.batch.encoder_inputs(CPU))
    here, candidate, feature, allowed, glob = lesson.inputs
    plan = torch.arange(len(here))[:, None]
    hidden = policy.remember(memory, lesson.past)[plan, lesson.stretch, lesson.step]
    return policy.score(memory, here, candidate, feature, allowed, glob, hidden)


def learn(policy: PolicyNetwork, old: PolicyNetwork, lesson: Lesson,
          config: LabelConfig) -> tuple[Tensor, Seen]:
    """Return the loss of a lesson, and what it is made of."""
    logits = logits_of(policy, lesson)
    log_probability = torch.log_softmax(logits, dim=2)
    margin = pick(logits, lesson.right) - pick(logits, lesson.wrong)
    is_pair = lesson.weight > 0
    pair = (lesson.weight * softplus(-margin)).sum() / is_pair.sum().clamp_min(1)
    shown = -mean(pick(log_probability, lesson.right), lesson.shown)
    calm = logits.new_zeros(())
    if config.calm > 0:
        with torch.no_grad():
            before = torch.log_softmax(logits_of(old, lesson), dim=2)
        calm = mean((before.exp() * (before - log_probability)).sum(dim=2), lesson.calm)
    compared, best = compare(logits, lesson)
    loss = (config.ordered * pair + config.shown * shown + config.calm * calm
            + config.compared * compared)
    pairs = int(is_pair.sum())
    right = float(((margin > 0) & is_pair).sum()) / max(1, pairs)
    return loss, Seen(float(loss.detach()), float(pair.detach()), float(shown.detach()),
                      float(calm.detach()), float(compared.detach()),
                      best, right, pairs)


def compare(logits: Tensor, lesson: Lesson) -> tuple[Tensor, float]:
    """Return the loss of choices that were tried, and by how much of their spread it is right.

    Each pair of choices counts by what lies between them, and the cheapest counts against all that
    were not tried together, which the policy liked less.
    """
    known = ~lesson.rise.isnan()
    rise = torch.where(known, lesson.rise, 0.0)
    score = logits.gather(2, lesson.tried)
    both = known[..., :, None] & known[..., None, :]
    apart = rise[..., None, :] - rise[..., :, None]
    weight = torch.where(both & (apart > 0), (apart / 0.005).clamp_max(4.0), 0.0)
    margin = score[..., :, None] - score[..., None, :]
    pairs = (weight * softplus(-margin)).sum()
    is_trial = known.sum(dim=2) > 1
    untried = logits.scatter(2, lesson.tried, MASKED).logsumexp(dim=2)
    cheapest = torch.where(known, lesson.rise, torch.inf).argmin(dim=2, keepdim=True)
    ahead = score.gather(2, cheapest)[..., 0] - untried
    others = torch.where(is_trial, softplus(-ahead), 0.0).sum()
    with torch.no_grad():
        chosen = torch.where(known, score, -torch.inf).argmax(dim=2, keepdim=True)
        lost = rise.gather(2, chosen)[..., 0].clamp_max(0.05)
        most = rise.amax(dim=2).clamp_max(0.05)
        best = 1 - float((lost * is_trial).sum() / (most * is_trial).sum().clamp_min(1e-9))
    return (pairs + others) / is_trial.sum().clamp_min(1), best


def pick(values: Tensor, index: Tensor) -> Tensor:
    """Return the values (plan, decision, candidate) at (plan, decision)."""
    return values.gather(2, index[..., None])[..., 0]


def mean(values: Tensor, chosen: Tensor) -> Tensor:
    """Return the mean of some values; 0 if there are none."""
    return torch.where(chosen, values, 0.0).sum() / chosen.sum().clamp_min(1)


class LabelsRun:
    """What a checkpoint keeps: the policy, the mean of its weights, the optimiser, the step."""

    def __init__(self, config: LabelConfig, began_with: Path) -> None:
        self.config = config
        self.policy = POLICIES[config.policy]()
        self.policy.load_state_dict(torch.load(began_with / WEIGHTS, weights_only=True))
        self.old, self.average = deepcopy(self.policy), deepcopy(self.policy)
        self.optimizer = torch.optim.AdamW(self.policy.parameters(), lr=config.learning_rate,
                                           weight_decay=1e-6)
        self.step, self.past_seconds, self.began = 0, 0.0, time.monotonic()
        self.spread = 1.0

    def seconds(self) -> float:
        """Return the training time of all legs so far."""
        return self.past_seconds + time.monotonic() - self.began

    def train_step(self, buffer: Buffer) -> dict[str, float]:
        """Learn from some plans, or from rollouts. In place; return numbers."""
        config = self.config
        rng = np.random.default_rng((config.seed, self.step))
        self.optimizer.zero_grad()
        numbers: dict[str, float] = {}
        if config.reinforce_every and self.step % config.reinforce_every == 0:
            self._reinforce(rng)
        else:
            lesson = make_lesson(buffer.draw(config.plans, rng), rng)
            if lesson is not None:
                loss, seen = learn(self.policy, self.old, lesson, config)
                loss.backward()
                numbers = asdict(seen)
        torch.nn.utils.clip_grad_norm_(self.policy.parameters(), config.gradient_clip)
        for group in self.optimizer.param_groups:
            group["lr"] = config.rate_at(self.step)
        self.optimizer.step()
        self.step += 1
        kept = min(config.averaged, self.step / (self.step + 10))
        with torch.no_grad():
            for mine, new in zip(self.average.parameters(), self.policy.parameters(), strict=True):
                mine.lerp_(new, 1 - kept)
        return numbers

    def _reinforce(self, rng: np.random.Generator) -> None:
        """Add the gradient of REINFORCE on problems of all classes. In place."""
        config = self.config
        size = int(np.exp(rng.uniform(np.log(20), np.log(60))))
        names = [sample_variant(rng) for _ in range(config.problems)]
        batch = make_batch([generate(rng, size, name) for name in names], names, rng)
        generator = torch.Generator().manual_seed(int(rng.integers(2**62)))
        outcome = roll_out(self.policy, batch, config.rollouts, sampler(generator), CPU, 1)
        costs = torch.from_numpy(training_costs(batch, outcome, config.rollouts,
                                                TrainConfig.unassigned_weight)).float()
        advantage = shared_advantage(costs, costs).flatten()
        self.spread = 0.95 * self.spread + 0.05 * float(advantage.std())
        advantage = (advantage / self.spread).clamp(-4, 4)
        decisions = join(outcome.record)
        weight = draw_weights(decisions, advantage, TrainConfig.kept, generator)
        policy_gradient(self.policy, batch, decisions, weight, advantage,
                        TrainConfig.max_candidates, False)

    def save(self, path: Path) -> None:
        """Write the checkpoint whole or not at all."""
        write({"config": asdict(self.config), "policy": self.average.state_dict(),
               "last": self.policy.state_dict(), "old": self.old.state_dict(),
               "optimizer": self.optimizer.state_dict(), "step": self.step,
               "spread": self.spread, "seconds": self.seconds()}, path)

    def load(self, path: Path) -> None:
        """Go on from a checkpoint. In place."""
        content: dict[str, Any] = torch.load(path, map_location="cpu", weights_only=False)
        for network, name in ((self.average, "policy"), (self.policy, "last"), (self.old, "old")):
            network.load_state_dict(content[name])
        self.optimizer.load_state_dict(content["optimizer"])
        self.step, self.spread = content["step"], content["spread"]
        self.past_seconds = content["seconds"]


def write(content: dict[str, Any], path: Path) -> None:
    """Write a file of PyTorch's whole or not at all."""
    torch.save(content, path.with_suffix(".part"))
    path.with_suffix(".part").replace(path)


@torch.no_grad()
def right_order(policy: PolicyNetwork, plans: Sequence[Labelled],
                at_once: int = 32) -> tuple[float, float]:
    """Return how often a policy is right where it was judged.

    In which share of the mistakes of plans it prefers the better choice, and how much of what lies
    between choices that were tried it saves; 0 where there are none.
    """
    right = total = trials = 0
    saved = 0.0
    ordered = sorted(plans, key=lambda plan: plan.origin.size)
    for first in range(0, len(ordered), at_once):
        lesson = make_lesson(ordered[first:first + at_once], np.random.default_rng(0), False)
        if lesson is not None:
            logits = logits_of(policy, lesson)
            better = pick(logits, lesson.right) > pick(logits, lesson.wrong)
            right += int((better & (lesson.weight > 0)).sum())
            total += int((lesson.weight > 0).sum())
            number = int(((~lesson.rise.isnan()).sum(dim=2) > 1).sum())
            saved += compare(logits, lesson)[1] * number
            trials += number
    return right / max(1, total), saved / max(1, trials)


@dataclass(frozen=True)
class LabelsLeg:
    """Learn from labels; goes on from the checkpoint in the folder if there is one."""

    folder: Path
    """Where checkpoint and log go."""
    labels: Path
    """Folder of `training.labels`."""
    config: Annotated[LabelConfig, tyro.conf.arg(name="")] = field(default_factory=LabelConfig)
    """The run."""
    begin_with: Path | None = None
    """Folder of an exported policy, if not the one of its name."""
    minutes: float = 60.0
    """Length of this leg."""
    max_steps: int | None = None
    """Stop at this step even if time is left."""
    validate_every: int = 200
    """Steps between looks at the labels held out."""

    @property
    def began_with(self) -> Path:
        """The folder of the policy that it begins with."""
        return self.begin_with or Path("model/weights") / self.config.policy


def train(leg: LabelsLeg) -> LabelsRun:
    """Train for some minutes or up to a step; return the run.

    Raises
    ------
    ValueError
        If there are no labels.
    """
    config, folder, labels = leg.config, leg.folder, leg.labels
    folder.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(config.seed)
    torch.set_num_threads(1)
    run, buffer = LabelsRun(config, leg.began_with), Buffer(labels, config.kept)
    if (folder / "checkpoint.pt").exists():
        run.load(folder / "checkpoint.pt")
    buffer.refresh()
    if not buffer.plans:
        raise ValueError(f"labels: {str(labels)!r} has none")
    began = saved = told = time.monotonic()
    bar = tqdm(desc="by labels", unit="step")
    while (run.step != leg.max_steps and time.monotonic() - began < 60 * leg.minutes
           and not STOP.is_set()):
        buffer.refresh()
        row = run.train_step(buffer)
        bar.update()
        is_validated = run.step % leg.validate_every == 0
        if row or is_validated:
            order, best = (right_order(run.average, buffer.held_out) if is_validated
                           else (None, None))
            log(folder / "log.csv", {
                "step": run.step, "seconds": run.seconds(), "plans": len(buffer.plans),
                **dict.fromkeys(Seen.__dataclass_fields__), **row, "held_out": order,
                "held_out_best": best})
        if time.monotonic() - saved > SAVE_EVERY:
            run.save(folder / "checkpoint.pt")
            saved = time.monotonic()
        if config.policy == LABELLING and time.monotonic() - told > NEWEST_EVERY:
            write(run.average.state_dict(), labels / NEWEST)
            told = time.monotonic()
    run.save(folder / "checkpoint.pt")
    return run


def log(path: Path, row: dict[str, float | None]) -> None:
    """Append a row."""
    is_new = not path.exists()
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, list(row))
        if is_new:
            writer.writeheader()
        writer.writerow(row)


def main() -> None:
    """Learn by what the command line states."""
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    leg = tyro.cli(LabelsLeg)
    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, lambda *_: STOP.set())
    train(leg)


if __name__ == "__main__":
    main()
