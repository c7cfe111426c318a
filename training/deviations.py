"""Which decisions of a plan cost something, found by going on from others by the policy itself.

For problems that the search can't complete soon: with drones, further trips and rarer rules. What
the policy makes of a beginning says less of it than what the search does, so each mistake has to
show in two layouts of the plane.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from model.policy.decision_features import Observation, Rollouts
from model.policy.problem_features import Float32Array
from model.problem import FloatArray, IntArray
from model.simulation.state import by_term
from model.simulation.actions import max_steps
from training.completion import apply_all
from training.mistakes import LEAST_RISE, NO_RISE, PATH, Judgement, Mistake
from training.rollout import Batch

MOST_LOOKED_AT = 24
"""Decisions of a plan that are looked at, drawn at random."""

OTHERS = 3
"""Choices that are tried instead of each, the likeliest."""


class Scorer(Protocol):
    """Scores what a rollout sees; `r` is its row."""

    def scores(self, batch: Batch, seen: Observation, r: int) -> Float32Array:
        """Return (candidate,) scores."""


def go_on(actor: Scorer, batch: Batch, beginnings: Sequence[IntArray],
          decisions: int | None = None) -> tuple[list[list[int]], FloatArray, list[list[int]]]:
    """Plan the only problem of a batch greedily to the end from each beginning on.

    Returns
    -------
    The actions that follow each, what the plans cost, and the legal actions of the last decision
    seen, the likeliest first. With a number of `decisions`, it ends after so many.
    """
    rows = len(beginnings)
    rollouts = Rollouts(batch.scene, np.zeros(rows, np.int64))
    state, seen = rollouts.state, rollouts.seen
    choice, after = np.zeros(rows, np.int64), [list[int]() for _ in range(rows)]
    ranked = [list[int]() for _ in range(rows)]
    for r, actions in enumerate(beginnings):
        apply_all(batch.instance, state, r, actions)
    for _ in range(max_steps(batch.instance) if decisions is None else decisions):
        if rollouts.step(choice) == 0:
            break
        for r in np.flatnonzero(seen.count).tolist():
            scores = actor.scores(batch, seen, r)
            choice[r] = scores.argmax()
            after[r].append(int(seen.action[r, choice[r]]))
            ranked[r] = seen.action[r, np.argsort(-scores, kind="stable")].tolist()
    return after, by_term(state.cost[:rows]).sum(axis=1), ranked


def judge_by_policy(actor: Scorer, layouts: Sequence[Batch], actions: IntArray,
                    rng: np.random.Generator) -> Judgement:
    """Return which of some decisions of a plan cost something.

    Parameters
    ----------
    actor
        The policy.
    layouts
        The same problem in some symmetries.
    actions
        The plan.
    rng
        Chooses the decisions that are looked at.
    """
    looked_at = np.sort(rng.permutation(len(actions))[:MOST_LOOKED_AT])
    fine, mistakes, completions = np.zeros(len(actions), np.bool_), list[Mistake](), 0
    _, _, ranked = go_on(actor, layouts[0], [actions[:place] for place in looked_at], 1)
    tried = [(place, code) for place, codes in zip(looked_at.tolist(), ranked, strict=True)
             if len(codes) > 1
             for code in dict.fromkeys([int(actions[place]), *codes[:OTHERS + 1]])]
    beginnings = [np.append(actions[:place], code) for place, code in tried]
    if not beginnings:
        return Judgement([], fine, 0)
    costs, after = [], list[list[int]]()
    for layout in layouts:
        after, cost, _ = go_on(actor, layout, beginnings)
        costs.append(cost)
        completions += len(beginnings)
    table = np.array(costs)
    for place in dict.fromkeys(place for place, _ in tried):
        rows = [row for row, (other, _) in enumerate(tried) if other == place]
        gain = ((table[:, rows[:1]] - table[:, rows[1:]]) / table.min()).min(axis=0)
        if gain.max() > LEAST_RISE:
            best = rows[1 + int(gain.argmax())]
            path = np.array([tried[best][1], *after[best]][:PATH])
            mistakes.append(Mistake(place, (path,), float(gain.max())))
        fine[place] = gain.max() <= NO_RISE
    return Judgement(mistakes, fine, completions)
