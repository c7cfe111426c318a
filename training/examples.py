"""Decisions to learn from, seen again by replaying judged plans in the simulator."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import torch
from torch import Tensor

from model.engine.instance import Instance
from model.policy.decision_features import Observation, Rollouts
from model.problem import FloatArray, IntArray, Problem
from model.simulation.actions import LAUNCH, NUM_KINDS, OPEN
from training.completion import apply_all
from training.labels import NONE, TRIED, ChoiceTrial, Labelled, Origin
from training.rollout import Batch, make_batch

MOST_PAIRS = 6
"""Mistakes of one plan that a step learns from."""

CALM_ROWS, CALM_DECISIONS = 4, 4
"""Stretches of decisions that cost nothing, of one plan, and their length."""

REMEMBERED = 3000
"""Problems that aren't drawn anew."""


@dataclass(frozen=True)
class Stretch:
    """Some decisions of a plan, or of a better one, in a row."""

    plan: int  # in the batch
    before: IntArray  # actions
    path: IntArray  # codes
    wrong: int = NONE  # code of what the plan chose instead of the first
    weight: float = 0.0  # of that pair
    trial: ChoiceTrial | None = None  # of the only decision


@dataclass(frozen=True, eq=False)
class Lesson:
    """Decisions of a batch of plans, padded to the most decisions and candidates."""

    batch: Batch
    inputs: tuple[Tensor, ...]  # of `score`, but for memory and hidden
    past: Tensor  # (plan, stretch, action) tokens of the places before all actions of a stretch
    stretch: Tensor  # (plan, decision) in which it is
    step: Tensor  # (plan, decision) number of the action
    right: Tensor  # (plan, decision) index of the code in the path
    wrong: Tensor  # (plan, decision) index of the plan's choice where there is a pair
    weight: Tensor  # (plan, decision) of the pair, 0 for none
    shown: Tensor  # (plan, decision) True = the search decided so
    calm: Tensor  # (plan, decision) True = the plan did, and it costs nothing
    tried: Tensor  # (plan, decision, TRIED) index of choices that were tried
    rise: Tensor  # (plan, decision, TRIED) of the cost by the cheapest's, a share of it; nan: none


@lru_cache(maxsize=REMEMBERED)
def problem_of(origin: Origin) -> Problem:
    """Draw a problem, or remember it."""
    return origin.problem()


def pair_weight(rise: float) -> float:
    """Return how much a pair counts by what the mistake costs, a share of the plan's cost."""
    return min(rise / 0.005, 4.0)


def stretches(plans: Sequence[Labelled], rng: np.random.Generator) -> Iterator[Stretch]:
    """Yield what to learn of each plan: its mistakes, and some of what costs nothing."""
    for index, plan in enumerate(plans):
        for trial in plan.trials:
            yield Stretch(index, plan.actions[:trial.step],
                          plan.actions[trial.step:trial.step + 1], trial=trial)
        chosen = rng.permutation(len(plan.pairs))[:MOST_PAIRS]
        for pair in (plan.pairs[number] for number in chosen.tolist()):
            yield Stretch(index, plan.actions[:pair.step], pair.path[pair.path != NONE],
                          int(plan.actions[pair.step]), pair_weight(pair.rise))
        fine = np.flatnonzero(plan.fine)
        for first in rng.choice(fine, min(CALM_ROWS, len(fine)), replace=False).tolist():
            behind = first + CALM_DECISIONS
            run = plan.actions[first:behind][np.logical_and.accumulate(plan.fine[first:behind])]
            yield Stretch(index, plan.actions[:first], run)


def places(instance: Instance, plan: int, actions: IntArray) -> IntArray:
    """Return the nodes where a plan's vehicles are before each action and after the last."""
    target, what = np.divmod(actions, NUM_KINDS)
    opens = what == OPEN
    node = np.where(opens, instance.type[plan]["begins_at"][np.where(opens, target, 0)], target)
    moves = np.flatnonzero(what != LAUNCH)
    last = np.searchsorted(moves, np.arange(len(actions)), side="right") - 1
    return np.concatenate([[0], np.where(last < 0, 0, node[moves[last]])]) if len(moves) else (
        np.zeros(len(actions) + 1, np.int64))


def make_lesson(plans: Sequence[Labelled], rng: np.random.Generator,
                symmetric: bool = True) -> Lesson | None:
    """Replay some decisions of plans, each plan's problem laid out in a random symmetry.

    None if no plan has any.
    """
    batch = make_batch([problem_of(plan.origin) for plan in plans],
                       [plan.origin.variant for plan in plans], rng if symmetric else None)
    rows = sorted(stretches(plans, rng), key=lambda row: -len(row.path))
    return replayed(batch, rows, begun(batch, rows)) if rows else None


def begun(batch: Batch, rows: Sequence[Stretch]) -> Rollouts:
    """Return rollouts as stretches begin."""
    rollouts = Rollouts(batch.scene, np.array([row.plan for row in rows]))
    for r, row in enumerate(rows):
        apply_all(batch.instance, rollouts.state, r, row.before)
    return rollouts


def replayed(batch: Batch, rows: Sequence[Stretch], rollouts: Rollouts) -> Lesson | None:
    """Return the decisions of stretches, the longest of which come first, from where they begin.

    `rollouts` are of no use afterwards. None if there is no decision.
    """
    seen = list(_replay(rows, rollouts))
    return _padded(batch, batch.num_problems, rows, seen) if seen else None


@dataclass(frozen=True, eq=False)
class _Seen:
    """One decision as it was seen."""

    plan: int
    row: int  # of the stretches
    step: int
    here: int
    token: IntArray
    feature: np.ndarray
    glob: np.ndarray
    right: int
    wrong: int
    weight: float
    calm: bool
    compared: bool
    tried: IntArray
    rise: FloatArray


def _replay(rows: Sequence[Stretch], rollouts: Rollouts) -> Iterator[_Seen]:
    """Yield all decisions of stretches, the longest of which come first."""
    number, seen = len(rows), rollouts.seen
    choice, left = np.zeros(number, np.int64), np.ones(number, np.bool_)
    for index in range(len(rows[0].path)):
        going = sum(index < len(row.path) for row in rows)
        rollouts.step(choice, behind=going)
        for r in np.flatnonzero(left[:going]).tolist():
            found = _decision(seen, r, rows[r], index)
            if found is None:
                left[r], seen.count[r] = False, 0
                continue
            choice[r] = found.right
            yield found


def _decision(seen: Observation, r: int, row: Stretch, index: int) -> _Seen | None:
    """Return one decision of a stretch; None if what follows isn't legal."""
    count = int(seen.count[r])
    legal = seen.action[r, :count].tolist()
    is_pair = index == 0 and row.wrong != NONE
    if int(row.path[index]) not in legal or (is_pair and row.wrong not in legal):
        return None
    return _Seen(row.plan, r, len(row.before) + index, int(seen.here[r]),
                 seen.token[r, :count].copy(), seen.feature[r, :count].copy(),
                 seen.glob[r].copy(), legal.index(int(row.path[index])),
                 legal.index(row.wrong) if is_pair else 0,
                 row.weight if is_pair else 0.0, row.wrong == NONE and row.trial is None,
                 row.trial is not None, *_rises(row.trial, legal))


def _rises(trial: ChoiceTrial | None, legal: Sequence[int]) -> tuple[IntArray, FloatArray]:
    """Return the indices of choices that were tried, and by how much dearer plans get by each."""
    unknown = np.zeros(TRIED, np.int64), np.full(TRIED, np.nan)
    if trial is None:
        return unknown
    known = np.isin(trial.codes, legal) & ~np.isnan(trial.costs)
    if not known.any():
        return unknown
    costs = np.where(known, trial.costs, np.inf)
    first = legal.index(int(trial.codes[known.argmax()]))  # in place of what isn't legal
    tried = [legal.index(code) if code in legal else first for code in trial.codes.tolist()]
    return np.array(tried), np.where(known, costs / costs.min() - 1, np.nan)


def _pasts(batch: Batch, plans: int, rows: Sequence[Stretch]) -> tuple[IntArray, IntArray]:
    """Return (plan, stretch, action) places, and the number of each row within its plan."""
    number, counts = np.zeros(len(rows), np.int64), np.zeros(plans, np.int64)
    walks = []
    for index, row in enumerate(rows):
        number[index] = counts[row.plan]
        counts[row.plan] += 1
        walks.append(places(batch.instance, row.plan, np.concatenate([row.before, row.path])))
    past = np.zeros((plans, counts.max(), max(map(len, walks))), np.int64)
    for row, index, walk in zip(rows, number.tolist(), walks, strict=True):
        past[row.plan, index, :len(walk)] = walk
    return past, number


def _padded(batch: Batch, plans: int, rows: Sequence[Stretch], seen: Sequence[_Seen]) -> Lesson:
    """Lay decisions side by side; those with one candidate alone are left out."""
    past, number = _pasts(batch, plans, rows)
    of_plan: list[list[_Seen]] = [[] for _ in range(plans)]
    for each in seen:
        if len(each.token) > 1:
            of_plan[each.plan].append(each)
    shape = plans, max(1, *map(len, of_plan))
    most = max((len(each.token) for each in seen), default=1)
    here, right, wrong, stretch, step_of = (np.zeros(shape, np.int64) for _ in range(5))
    weight, allowed = np.zeros(shape, np.float32), np.zeros((*shape, most), np.bool_)
    shown, calm = np.zeros(shape, np.bool_), np.zeros(shape, np.bool_)
    candidate = np.zeros((*shape, most), np.int64)
    feature = np.zeros((*shape, most, seen[0].feature.shape[1]), np.float32)
    glob = np.zeros((*shape, len(seen[0].glob)), np.float32)
    tried, rise = np.zeros((*shape, TRIED), np.int64), np.full((*shape, TRIED), np.nan, np.float32)
    allowed[..., 0] = True
    for plan, decisions in enumerate(of_plan):
        for place, each in enumerate(decisions):
            at, count = (plan, place), len(each.token)
            here[at], glob[at], right[at], wrong[at] = each.here, each.glob, each.right, each.wrong
            candidate[plan, place, :count], feature[plan, place, :count] = each.token, each.feature
            allowed[plan, place, :count], weight[at] = True, each.weight
            calm[at], shown[at] = each.calm, not (each.calm or each.compared)
            tried[at], rise[at] = each.tried, each.rise
            stretch[at], step_of[at] = number[each.row], each.step
    tensors = [torch.from_numpy(array) for array in (
        here, candidate, feature, allowed, glob, past, stretch, step_of, right, wrong, weight,
        shown, calm, tried, rise)]
    return Lesson(batch, tuple(tensors[:5]), *tensors[5:])
