"""Train a head that tells what the finished plan will cost, from any state of it, by labels.

Run with `python -m training.value --labels runs/labels --folder runs/value`. A beginning is worth
what the search makes of it (`training.mistakes`), and `attention` stays as it is: the head reads
what the policy makes of the state. Prints by how much it is off on plans that it never saw.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import torch
import typer
from torch import Tensor, nn
from torch.nn.functional import smooth_l1_loss, softplus
from tqdm import tqdm

from model.policy.attention import AttentionPolicy
from model.policy.decision_features import NUM_GLOBAL_FEATURES
from model.simulation.state import by_term
from training.examples import Stretch, begun, problem_of, replayed
from training.export import WEIGHTS
from training.train_by_labels import CPU, Buffer, write
from training.labels import Labelled, read_policy
from training.rollout import make_batch

HIDDEN = 128
"""Width of the head's two hidden layers."""

STATES = 6
"""Of one plan in a step."""

PLANS = 16
"""In a step."""

NEAR = 0.05
"""Relative error from which a larger one counts by its size, not by its square."""


class Value(nn.Module):
    """What a plan costs in the end, by the state in which it is."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.Linear(2 * width + NUM_GLOBAL_FEATURES, HIDDEN), nn.SiLU(),
            nn.Linear(HIDDEN, HIDDEN), nn.SiLU(), nn.Linear(HIDDEN, 1))

    def forward(self, situation: Tensor, mean: Tensor, glob: Tensor, spent: Tensor) -> Tensor:
        """Return (plan, decision) costs of whole plans, in the unit of `spent`.

        Parameters
        ----------
        situation
            (plan, decision, width) what the policy makes of the state.
        mean
            (plan, width) of what it knows of all places.
        glob
            (plan, decision, NUM_GLOBAL_FEATURES), of which the first is the share unserved.
        spent
            (plan, decision) cost so far by the problem's scale and customers.
        """
        known = torch.cat([situation, mean[:, None].expand_as(situation), glob], dim=-1)
        return spent + glob[..., 0] * softplus(self.layers(known)[..., 0])


@dataclass(frozen=True, eq=False)
class States:
    """Some states of plans, and what these are worth."""

    situation: Tensor
    mean: Tensor
    glob: Tensor
    spent: Tensor
    worth: Tensor  # (plan, decision)
    is_state: Tensor  # (plan, decision) False = padding, or worth nothing


def look(policy: AttentionPolicy, plans: Sequence[Labelled],
         rng: np.random.Generator) -> States | None:
    """Return states of plans, each plan's problem laid out in a random symmetry; None if none."""
    batch = make_batch([problem_of(plan.origin) for plan in plans],
                       [plan.origin.variant for plan in plans], rng)
    rows, worth = list[Stretch](), list[float]()
    for index, plan in enumerate(plans):
        for place in rng.permutation(len(plan.cuts) - 1)[:STATES] if len(plan.cuts) > 1 else ():
            cut = int(plan.cuts[place])
            rows.append(Stretch(index, plan.actions[:cut], plan.actions[cut:cut + 1]))
            worth.append(float(plan.worth[place]))
    if not rows:
        return None
    rollouts = begun(batch, rows)
    spent = by_term(rollouts.state.cost[:len(rows)]).sum(axis=1)
    lesson = replayed(batch, rows, rollouts)
    if lesson is None:
        return None
    of_plan = np.array([row.plan for row in rows])
    unit = batch.scale.cost * np.maximum(batch.instance.size["customers"], 1)
    table = np.zeros((2, len(plans), int(lesson.stretch.max()) + 1))
    for index in range(len(plans)):
        own = np.flatnonzero(of_plan == index)[:table.shape[2]]
        table[0, index, :len(own)] = spent[own] / unit[index]
        table[1, index, :len(own)] = np.array(worth)[own] / unit[index]
    numbers = torch.from_numpy(table).float()
    at = torch.arange(len(plans))[:, None], lesson.stretch
    with torch.no_grad():
        memory = policy.encode(*batch.encoder_inputs(CPU))
        here, candidate, feature, allowed, glob = lesson.inputs
        situation = policy.situation(memory, here, candidate, feature, allowed, glob)
        width = policy.config.width
        mask = torch.from_numpy(batch.tokens.mask)[..., None].float()
        places = (memory[..., :width] * mask).sum(dim=1) / mask.sum(dim=1)
    known = numbers[1][at]
    return States(situation, places, glob, numbers[0][at], known, lesson.calm & (known > 0))


def errors(value: Value, states: States) -> Tensor:
    """Return the logarithms of what the head says by what is true, (state,)."""
    told = value(states.situation, states.mean, states.glob, states.spent)
    return (told[states.is_state].clamp_min(1e-6) / states.worth[states.is_state]).log()


def bands(value: Value, policy: AttentionPolicy,
          plans: Sequence[Labelled]) -> Iterator[tuple[str, int, float, float]]:
    """Yield by share unserved: how many states, the mean and the median relative error."""
    rng = np.random.default_rng(0)
    ordered = sorted((plan for plan in plans if len(plan.cuts) > 1),
                     key=lambda plan: plan.origin.size)
    off, left = list[np.ndarray](), list[np.ndarray]()
    for first in range(0, len(ordered), PLANS):
        states = look(policy, ordered[first:first + PLANS], rng)
        if states is not None:
            with torch.no_grad():
                off.append(errors(value, states).expm1().abs().numpy())
            left.append(states.glob[..., 0][states.is_state].numpy())
    error, share = np.concatenate(off), np.concatenate(left)
    for low, high in ((0.0, 0.25), (0.25, 0.5), (0.5, 0.75), (0.75, 1.0)):
        own = error[(share > low) & (share <= high)]
        if len(own):
            yield f"{low:.0%} to {high:.0%}", len(own), float(own.mean()), float(
                np.median(own))
    yield "all", len(error), float(error.mean()), float(np.median(error))


def train(folder: Path, labels: Path, weights: Path, minutes: float, learning_rate: float,
          max_steps: int | None = None) -> tuple[Value, Buffer, AttentionPolicy]:
    """Train the head for some minutes or steps and write it.

    Raises
    ------
    ValueError
        If no label says what beginnings are worth.
    """
    torch.manual_seed(0)
    torch.set_num_threads(1)
    policy, buffer = read_policy(weights / WEIGHTS), Buffer(labels, 10**9)
    buffer.refresh()
    if not any(len(plan.cuts) for plan in buffer.plans):
        raise ValueError(f"labels: {str(labels)!r} has no beginnings that were completed")
    value = Value(policy.config.width)
    optimizer = torch.optim.AdamW(value.parameters(), lr=learning_rate)
    rng, end, step = np.random.default_rng(0), time.monotonic() + 60 * minutes, 0
    bar = tqdm(desc="value", unit="step")
    while step != max_steps and (left := end - time.monotonic()) > 0:
        for group in optimizer.param_groups:
            group["lr"] = learning_rate * min(1.0, 0.05 + left / (60 * minutes))
        states = look(policy, buffer.draw(PLANS, rng), rng)
        if states is not None:
            off = errors(value, states)
            loss = smooth_l1_loss(off, torch.zeros_like(off), beta=NEAR)
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
        step += 1
        bar.update()
    folder.mkdir(parents=True, exist_ok=True)
    write(value.state_dict(), folder / "value.pt")
    return value, buffer, policy


def main(
    folder: Annotated[Path, typer.Option(help="receives value.pt")],
    labels: Annotated[Path, typer.Option(help="of training.labels")],
    weights: Annotated[Path, typer.Option(help="folder of an exported policy")]
    = Path("model/weights/attention"),
    minutes: float = 10.0, learning_rate: float = 1e-3,
) -> None:
    """Train the head and print how far it is off."""
    value, buffer, policy = train(folder, labels, weights, minutes, learning_rate)
    print("| unserved | states | mean error, % | median error, % |\n| --- | ---: | ---: | ---: |")
    for name, number, mean, median in bands(value, policy, buffer.held_out):
        print(f"| {name} | {number} | {100 * mean:.1f} | {100 * median:.1f} |")


if __name__ == "__main__":
    typer.run(main)
