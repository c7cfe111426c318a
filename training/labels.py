"""Make labels: plans of a policy whose dear decisions the search has found. Read top to bottom.

Run with `python -m training.labels --folder runs/labels`. Each plan is drawn by the newest weights,
half of them greedily; `training.train_by_labels` learns from what is there. A file holds some
plans, is written whole or not at all, and states each problem by the numbers it is drawn from.
"""

import time
import zipfile
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import numpy as np
import torch
import typer
from tqdm import tqdm

from model.policy.attention import AttentionConfig, AttentionPolicy
from model.policy.decision_features import Observation, Rollouts
from model.policy.rolling import StepWeights, candidate_scores, roll_out
from model.policy.problem_features import Float32Array
from model.problem import FloatArray, IntArray, Problem
from training.completion import CompletionSetting, apply_all, can_complete
from training.deviations import go_on, judge_by_policy
from training.export import WEIGHTS
from training.instances import DEFAULT_CONFIG, generate
from training.mistakes import PATH, CompletionJudge, Judgement, Mistake
from training.rollout import Batch, make_batch
from training.variants import uniform_vrptw

HOT = 1.3
"""Temperature of every second plan."""

SHARES = {"uniform": 0.3, "vrptw": 0.15, "appointed": 0.08, "soft": 0.06, "hetero": 0.08,
          "cvrp": 0.05, "multitrip": 0.06, "drone": 0.06, "table1": 0.04, "mixed": 0.06,
          "pickups": 0.02, "various": 0.02, "particular": 0.02}
"""How often each class of problems is drawn. `uniform` is a half of `vrptw`."""

SIZES = (20, 100)
"""Fewest and most customers; their logarithm is uniform."""

TRIED = 5
"""Choices that are tried at one decision: the likeliest and the plan's own."""

MOST_TRIALS = 12
"""Decisions of a plan at which others are tried, drawn at random."""

PLANS_A_FILE = 40

NEWEST = "newest.pt"
"""File in the folder of labels with weights of the policy, newer than those it began with."""

NONE = -1


@dataclass(frozen=True)
class Origin:
    """What a problem is drawn from."""

    variant: str
    size: int
    seed: int

    def problem(self) -> Problem:
        """Draw it."""
        rng = np.random.default_rng(self.seed)
        if self.variant == "uniform":
            return uniform_vrptw(rng, self.size, DEFAULT_CONFIG)
        return generate(rng, self.size, self.variant)


@dataclass(frozen=True)
class Pair:
    """A decision that was wrong, and a better one."""

    step: int  # number of the action
    rise: float  # of the plan's cost, a share of it
    path: IntArray  # (PATH,) codes from the better choice on, NONE behind the last


@dataclass(frozen=True)
class ChoiceTrial:
    """What each of some choices comes to at one decision."""

    step: int  # number of the action
    codes: IntArray  # (TRIED,) of the choices, NONE behind the last
    costs: FloatArray  # (TRIED,) of the plans that go on by them, at best; nan where it isn't known


@dataclass(frozen=True)
class Labelled:
    """A judged plan."""

    origin: Origin
    actions: IntArray
    fine: np.ndarray  # (action,) no decision nearby costs anything
    pairs: list[Pair]
    # Lengths of beginnings that the search completed, ascending, and what whole plans cost then;
    # none of a plan that the policy judged by itself.
    cuts: IntArray = field(default_factory=lambda: np.zeros(0, np.int64))
    worth: FloatArray = field(default_factory=lambda: np.zeros(0))
    trials: list[ChoiceTrial] = field(default_factory=list)


def read_policy(path: Path) -> AttentionPolicy:
    """Return `attention` with the weights of a file, which may be a checkpoint."""
    content = torch.load(path, map_location="cpu", weights_only=False)
    policy = AttentionPolicy(AttentionConfig())
    policy.load_state_dict(content.get("policy", content))
    return policy


class Actor:
    """A policy that plans and scores, by weights that may change."""

    def __init__(self, weights: Path) -> None:
        self.use(read_policy(weights))

    def use(self, policy: AttentionPolicy) -> None:
        """Plan by a policy from now on. In place."""
        self._policy = policy
        self._encoded: tuple[Batch, np.ndarray] | None = None
        self._weights = StepWeights(**{
            name: np.ascontiguousarray(weight.detach().numpy())
            for name, weight in policy.decision_weights().items()})

    @torch.no_grad()
    def memory(self, batch: Batch) -> np.ndarray:
        """Return what the encoder makes of the only problem of a batch."""
        encoded = self._policy.encode(*batch.encoder_inputs(torch.device("cpu")))
        return np.ascontiguousarray(encoded[0].numpy())

    def plan(self, batch: Batch, temperature: float, rng: np.random.Generator) -> IntArray:
        """Return the actions of a plan, greedy at temperature 0."""
        self._encoded = batch, self.memory(batch)
        plan, = roll_out(self._weights, self._encoded[1], batch.scene, [temperature], rng)
        return plan.actions

    def scores(self, batch: Batch, seen: Observation, r: int) -> Float32Array:
        """Return the scores of what a rollout of the only problem of a batch sees."""
        if self._encoded is None or self._encoded[0] is not batch:
            self._encoded = batch, self.memory(batch)
        return candidate_scores(self._weights, self._encoded[1], seen, r)

    def preferred(self, batch: Batch, actions: IntArray, choices: Sequence[int]) -> int | None:
        """Return which of some codes the policy prefers after actions; None if none is legal."""
        rollouts = Rollouts(batch.scene, np.zeros(1, np.int64))
        seen = rollouts.seen
        apply_all(batch.instance, rollouts.state, 0, actions)
        count = rollouts.observe()
        legal = seen.action[0, :count].tolist()
        if not set(choices) & set(legal):
            return None
        scores = self.scores(batch, seen, 0)
        return max(set(choices) & set(legal), key=lambda code: float(scores[legal.index(code)]))


def to_pair(actor: Actor, batch: Batch, actions: IntArray, mistake: Mistake) -> Pair | None:
    """Return a mistake with the better choice that the policy likes best; None if it isn't legal.
    """
    chosen = actor.preferred(batch, actions[:mistake.step],
                             [int(path[0]) for path in mistake.better])
    if chosen is None or chosen == actions[mistake.step]:
        return None
    path = next(path for path in mistake.better if path[0] == chosen)[:PATH]
    padded = np.full(PATH, NONE)
    padded[:len(path)] = path
    return Pair(mistake.step, mistake.rise, padded)


def try_others(actor: Actor, problem: Problem, batch: Batch, actions: IntArray,
               rng: np.random.Generator, effort: float = 1.0) -> list[ChoiceTrial]:
    """Return what the likeliest choices come to at some decisions of a plan.

    By the search, or by the policy itself in two symmetries where the search can't tell.
    """
    steps = np.sort(rng.permutation(len(actions)))[::-1]
    _, _, ranked = go_on(actor, batch, [actions[:step] for step in steps], 1)
    chosen = [(int(step), list(dict.fromkeys([*codes[:TRIED - 1], int(actions[step])])))
              for step, codes in zip(steps, ranked, strict=True) if len(codes) > 1]
    drawn = np.sort(rng.permutation(len(chosen))[:MOST_TRIALS])
    at, codes = [chosen[place][0] for place in drawn], [chosen[place][1] for place in drawn]
    if can_complete(problem):
        setting = CompletionSetting(problem, batch.instance)
        found = list(CompletionJudge(setting, actions, effort).compare(at, codes))
    else:
        beginnings = [np.append(actions[:step], code)
                      for step, some in zip(at, codes, strict=True) for code in some]
        layouts = (batch, make_batch([problem], [""], rng))
        costs = np.mean([go_on(actor, layout, beginnings)[1] for layout in layouts], axis=0)
        ends = np.cumsum([len(some) for some in codes])
        found = [part.tolist() for part in np.split(costs, ends[:-1])] if beginnings else []
    return [ChoiceTrial(step, _padded(some, NONE).astype(np.int64), _padded(costs, np.nan))
            for step, some, costs in zip(at, codes, found, strict=True)]


def _padded(values: Sequence[float], by: float) -> FloatArray:
    return np.array([*values, *[by] * (TRIED - len(values))], np.float64)


def label(actor: Actor, origin: Origin, effort: float = 1.0) -> tuple[Labelled, Judgement]:
    """Plan a problem and judge the plan, by the policy alone where the search can't complete it."""
    rng = np.random.default_rng((origin.seed, 1))
    problem, batch, actions = _planned(actor, origin, rng)
    if can_complete(problem):
        setting = CompletionSetting(problem, batch.instance)
        judgement = CompletionJudge(setting, actions, effort).judge()
    else:
        layouts = [batch, make_batch([problem], [origin.variant], rng)]
        judgement = judge_by_policy(actor, layouts, actions, rng)
    pairs = [to_pair(actor, batch, actions, mistake) for mistake in judgement.mistakes]
    cuts = sorted(judgement.worth)
    return Labelled(
        origin, actions, judgement.fine, [pair for pair in pairs if pair is not None],
        np.array(cuts, np.int64), np.array([judgement.worth[cut] for cut in cuts])), judgement


def label_by_trials(actor: Actor, origin: Origin, effort: float = 1.0) -> Labelled:
    """Plan a problem and try other choices at some decisions."""
    rng = np.random.default_rng((origin.seed, 2))
    problem, batch, actions = _planned(actor, origin, rng)
    return Labelled(origin, actions, np.zeros(len(actions), np.bool_), [],
                    trials=try_others(actor, problem, batch, actions, rng, effort))


def _planned(actor: Actor, origin: Origin, rng: np.random.Generator
             ) -> tuple[Problem, Batch, IntArray]:
    """Draw a problem and plan it, greedily or not."""
    problem = origin.problem()
    batch = make_batch([problem], [origin.variant])
    return problem, batch, actor.plan(batch, HOT * float(rng.random() < 0.5), rng)


def draw_origin(rng: np.random.Generator) -> Origin:
    """Draw where a problem comes from."""
    names = tuple(SHARES)
    variant = names[int(rng.choice(len(names), p=np.array(list(SHARES.values()))))]
    size = int(np.exp(rng.uniform(np.log(SIZES[0]), np.log(SIZES[1] + 1))))
    return Origin(variant, min(size, SIZES[1]), int(rng.integers(2**62)))


def write(path: Path, plans: Sequence[Labelled]) -> None:
    """Write plans whole or not at all."""
    pairs = [(index, pair) for index, plan in enumerate(plans) for pair in plan.pairs]
    trials = [(index, trial) for index, plan in enumerate(plans) for trial in plan.trials]
    part = path.with_suffix(".part")
    with part.open("wb") as file:
        np.savez_compressed(
            file, variant=np.array([plan.origin.variant for plan in plans]),
            size=np.array([plan.origin.size for plan in plans]),
            seed=np.array([plan.origin.seed for plan in plans]),
            length=np.array([len(plan.actions) for plan in plans]),
            action=np.concatenate([plan.actions for plan in plans]).astype(np.int32),
            fine=np.concatenate([plan.fine for plan in plans]),
            plan=np.array([index for index, _ in pairs], np.int32),
            step=np.array([pair.step for _, pair in pairs], np.int32),
            rise=np.array([pair.rise for _, pair in pairs], np.float32),
            path=np.array([pair.path for _, pair in pairs], np.int32).reshape(-1, PATH),
            cuts=np.array([len(plan.cuts) for plan in plans]),
            cut=np.concatenate([plan.cuts for plan in plans]).astype(np.int32),
            worth=np.concatenate([plan.worth for plan in plans]),
            tried=np.array([index for index, _ in trials], np.int32),
            tried_at=np.array([trial.step for _, trial in trials], np.int32),
            choice=np.array([trial.codes for _, trial in trials], np.int32).reshape(-1, TRIED),
            comes_to=np.array([trial.costs for _, trial in trials]).reshape(-1, TRIED))
    part.replace(path)


def read(path: Path) -> list[Labelled]:
    """Return the plans of a file; none if it is damaged."""
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
            rows = {name: stored[name] for name in stored.files}
        ends, last = np.cumsum(rows["length"]), np.cumsum(rows["cuts"])
        pairs: list[list[Pair]] = [[] for _ in ends]
        for plan, number, rise, codes in zip(rows["plan"], rows["step"], rows["rise"],
                                             rows["path"], strict=True):
            pairs[plan].append(Pair(int(number), float(rise), codes.astype(np.int64)))
        trials: list[list[ChoiceTrial]] = [[] for _ in ends]
        for plan, number, codes, costs in zip(rows["tried"], rows["tried_at"], rows["choice"],
                                              rows["comes_to"], strict=True):
            trials[plan].append(ChoiceTrial(int(number), codes.astype(np.int64), costs))
        return [Labelled(Origin(str(rows["variant"][index]), int(rows["size"][index]),
                                int(rows["seed"][index])),
                         rows["action"][end - length:end].astype(np.int64),
                         rows["fine"][end - length:end], pairs[index],
                         rows["cut"][behind - cuts:behind].astype(np.int64),
                         rows["worth"][behind - cuts:behind], trials[index])
                for index, (end, length, behind, cuts) in enumerate(zip(
                    ends, rows["length"], last, rows["cuts"], strict=True))]
    except (OSError, ValueError, KeyError, EOFError, IndexError, zipfile.BadZipFile, zlib.error):
        return []


def main(
    folder: Annotated[Path, typer.Option(help="receives the labels")],
    weights: Annotated[Path, typer.Option(help="folder of an exported policy")]
    = Path("model/weights/attention"),
    minutes: float = 60.0, seed: int = 1,
    effort: Annotated[float, typer.Option(help="times the usual turns of the search")] = 1.0,
    max_plans: Annotated[int | None, typer.Option(help="stop after so many plans")] = None,
    trials: Annotated[bool, typer.Option(help="try other choices at some decisions, whatever they "
                                              "cost, instead")] = False,
) -> None:
    """Make labels until the time is over; goes on behind the files that are there."""
    folder.mkdir(parents=True, exist_ok=True)
    actor, newest, read_at = Actor(weights / WEIGHTS), folder / NEWEST, 0.0
    number = len(list(folder.glob(f"{seed:03d}-*.npz")))
    plans: list[Labelled] = []
    end, made = time.monotonic() + 60 * minutes, 0
    bar = tqdm(desc="labels", unit="plan")
    while time.monotonic() < end and made != max_plans:
        if newest.exists() and newest.stat().st_mtime > read_at:
            read_at = newest.stat().st_mtime
            actor = Actor(newest)
        rng = np.random.default_rng((seed, number, len(plans)))
        origin = draw_origin(rng)
        plans.append(label_by_trials(actor, origin, effort) if trials
                     else label(actor, origin, effort)[0])
        made += 1
        bar.update()
        if len(plans) == PLANS_A_FILE:
            write(folder / f"{seed:03d}-{number:05d}.npz", plans)
            number, plans = number + 1, []
    if plans:
        write(folder / f"{seed:03d}-{number:05d}.npz", plans)


if __name__ == "__main__":
    typer.run(main)
