"""Rollouts of `attention` by the engine.

Its step as `step.onnx` computes it, for one rollout and without padding. A decision is so small
that a call of ONNX Runtime takes longer than its arithmetic, and a plan makes many of them.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.engine.alarm import Alarm
from model.engine.library import call, packed
from model.engine.structs import Struct
from model.policy.decision_features import (
    NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES, Observation, Scene,
)
from model.policy.keeping import MOST_ANEW, MOST_ANEW_GREEDILY, part_to_keep
from model.policy.problem_features import Float32Array
from model.problem import IntArray
from model.simulation.actions import max_steps, reset
from model.simulation.state import by_term

STEP_WEIGHTS = "step.npz"
"""File in a policy's folder."""

WIDTH = 96
NUM_HEADS = 4
ACTION_WIDTH = 48
"""Sizes of the network, those of `engine/policy/decision.h`."""

SHARE = 4 * WIDTH
"""Where the last part of a token's memory begins."""

CLIP = 10.0
"""What the scores are clipped to, softly."""


class StepWeights(Struct):
    """The weights of a decision, matrices as (input, output)."""


SHAPES = {
    "globe": (NUM_GLOBAL_FEATURES, WIDTH), "globe_bias": (WIDTH,),
    "globe_output": (WIDTH, WIDTH), "globe_output_bias": (WIDTH,),
    "action": (NUM_ACTION_FEATURES, ACTION_WIDTH), "action_bias": (ACTION_WIDTH,),
    "glimpse_bias": (NUM_HEADS, ACTION_WIDTH), "glimpse_output": (WIDTH, WIDTH),
    "action_query": (WIDTH, ACTION_WIDTH), "action_mix": (ACTION_WIDTH, ACTION_WIDTH),
    "action_mix_bias": (ACTION_WIDTH,), "action_score": (ACTION_WIDTH,),
}
"""Of `StepWeights`."""


class Rollout(NamedTuple):
    """A plan as it was made."""

    actions: IntArray  # (action,) codes
    cost: float


NOTHING = Rollout(np.zeros(0, np.int64), math.inf)

GIVEN_UP = -1
"""Number of actions of a rollout that was not ended."""

HOTTER, HOTTER_WITH_DRONES = 2.0, 1.4
"""Times the temperature of rollouts that keep a part: what is likely is in the best already, and a
good route is of use in whatever plan it was drawn. Less of it where drones fly."""


class Course(NamedTuple):
    """How a rollout begins and goes on."""

    temperature: float  # 0 for the likeliest action at each step
    random: NDArray[np.uint64]  # (1,) state of random numbers, which is moved on
    kept: int  # actions that are given
    actions: IntArray  # (action,) codes


def read_weights(path: Path) -> StepWeights:
    """Read what `training.export` wrote.

    Raises
    ------
    ValueError
        If an array is missing or has another shape than the engine's.
    """
    with np.load(path, allow_pickle=False) as stored:
        arrays = {name: np.ascontiguousarray(stored[name], dtype=np.float32)
                  for name in StepWeights._fields if name in stored}
    for name, shape in SHAPES.items():
        if name not in arrays or arrays[name].shape != shape:
            raise ValueError(f"{path.name}: {name!r} is not there in the shape {shape}")
    return StepWeights(**arrays)


def choose(scores: Float32Array, temperature: float, random: NDArray[np.uint64]) -> int:
    """Return the likeliest candidate, or one drawn by probability if the temperature isn't 0.

    `random` is a state of random numbers, (1,), which is moved on.
    """
    return int(call("tandem_choose", scores, temperature, random))


def candidate_scores(weights: StepWeights, memory: Float32Array, seen: Observation,
                     r: int) -> Float32Array:
    """Return the scores of a rollout's candidates, (candidate,), before they are clipped."""
    scores = np.empty(seen.count[r], np.float32)
    call("tandem_candidate_scores", weights, memory, seen, r, scores)
    return scores


def roll_out(weights: StepWeights, memory: Float32Array, scene: Scene,
             temperatures: Sequence[float], rng: np.random.Generator, so_far: Rollout = NOTHING,
             alarm: IntArray | None = None) -> list[Rollout]:
    """Plan a problem several times, one after another; return the plans.

    Parameters
    ----------
    weights
        Of the policy's decisions.
    memory
        (token, memory width) that its encoder made of the problem.
    scene
        The problem, packed alone.
    temperatures
        Of each rollout if it plans all; 0 for the likeliest action at each step.
    rng
        For all others.
    so_far
        What was found before. Rollouts keep a part of the cheapest so far.
    alarm
        Setting of an alarm at which the rest is given up.
    """
    instance, most = scene.instance, max_steps(scene.instance)
    state = reset(instance, np.zeros(len(temperatures), np.int64))
    given = packed(weights), memory, packed(scene), state
    alarm = Alarm().setting if alarm is None else alarm
    hotter = HOTTER_WITH_DRONES if (instance.type["drones"] > 0).any() else HOTTER
    random = rng.spawn(1)[0].integers(1 << 64, size=1, dtype=np.uint64)
    plans: list[Rollout] = []
    for r, temperature in enumerate(temperatures):
        kept = NOTHING.actions
        if so_far is not NOTHING:
            most_anew = MOST_ANEW if temperature > 0 else MOST_ANEW_GREEDILY
            kept = part_to_keep(instance, so_far.actions, most_anew, rng)
            temperature *= hotter
        actions = np.empty(most, np.int64)
        actions[:len(kept)] = kept
        count = call("tandem_roll_out", *given, r,
                     Course(temperature, random, len(kept), actions), alarm)
        if count == GIVEN_UP:
            break
        found = Rollout(actions[:count].copy(), float(by_term(state.cost[r:r + 1]).sum()))
        plans.append(found)
        so_far = min(so_far, found, key=cost_of)
    return plans


def cost_of(rollout: Rollout) -> float:
    """Return what a plan costs, to compare plans by."""
    return rollout.cost
