"""Rollouts of `attention` in one compiled loop.

Its step as `step.onnx` computes it, for one rollout and without padding. A decision is so small
that a call of ONNX Runtime takes longer than its arithmetic, and a plan makes many of them.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from model.kernel.alarm import rung, silent
from model.kernel.compiled import compiled, inlined, inlined_arithmetic
from model.kernel.instance import Instance
from model.policy.features import step
from model.policy.observation import (
    NUM_ACTION_FEATURES, NUM_GLOBAL_FEATURES, Observation, empty_observation,
)
from model.policy.resampling import MOST_ANEW, MOST_ANEW_GREEDILY, part_to_keep
from model.policy.tokens import Float32Array, Scales
from model.problem import IntArray
from model.simulation.cost import by_term
from model.simulation.simulator import apply, max_steps, reset
from model.simulation.transition import State

STEP_WEIGHTS = "step.npz"
"""File in a policy's folder."""

WIDTH = 96
NUM_HEADS = 4
HEAD_WIDTH = WIDTH // NUM_HEADS
ACTION_WIDTH = 48
"""Sizes of the network, compiled in: loops of fixed length run twice as fast."""

KEY, VALUE, POINTER, SHARE = WIDTH, 2 * WIDTH, 3 * WIDTH, 4 * WIDTH
"""Where the parts of a token's memory begin; what queries read comes first."""

CLIP = 10.0
"""What the scores are clipped to, softly."""

LEAST_NOISE = float(np.finfo(np.float32).tiny)
"""Noise may be exactly zero, which has no logarithm."""

UNROLLED = 4
"""Rows of a matrix that are multiplied together."""
ABREAST = 4
"""Candidates that are multiplied together, so that a matrix is read once for all of them."""


class StepWeights(NamedTuple):
    """The weights of a decision, matrices as (input, output)."""

    globe: Float32Array
    globe_bias: Float32Array
    globe_output: Float32Array
    globe_output_bias: Float32Array
    action: Float32Array
    action_bias: Float32Array
    glimpse_bias: Float32Array
    glimpse_output: Float32Array
    action_query: Float32Array
    action_mix: Float32Array
    action_mix_bias: Float32Array
    action_score: Float32Array


SHAPES = {
    "globe": (NUM_GLOBAL_FEATURES, WIDTH), "globe_bias": (WIDTH,),
    "globe_output": (WIDTH, WIDTH), "globe_output_bias": (WIDTH,),
    "action": (NUM_ACTION_FEATURES, ACTION_WIDTH), "action_bias": (ACTION_WIDTH,),
    "glimpse_bias": (NUM_HEADS, ACTION_WIDTH), "glimpse_output": (WIDTH, WIDTH),
    "action_query": (WIDTH, ACTION_WIDTH), "action_mix": (ACTION_WIDTH, ACTION_WIDTH),
    "action_mix_bias": (ACTION_WIDTH,), "action_score": (ACTION_WIDTH,),
}
"""Of `StepWeights`; numbers of rows are multiples of UNROLLED."""


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


class Desk(NamedTuple):
    """Room for the numbers of one decision."""

    hidden: Float32Array  # (WIDTH,)
    query: Float32Array  # (WIDTH,)
    glimpsed: Float32Array  # (WIDTH,)
    asked: Float32Array  # (ACTION_WIDTH,)
    action: Float32Array  # (candidate, ACTION_WIDTH)
    mixed: Float32Array  # (candidate, ACTION_WIDTH)
    weight: Float32Array  # (NUM_HEADS, candidate)


def read_weights(path: Path) -> StepWeights:
    """Read what `training.export` wrote.

    Raises
    ------
    ValueError
        If an array is missing or has another shape than is compiled in.
    """
    with np.load(path, allow_pickle=False) as stored:
        arrays = {name: np.ascontiguousarray(stored[name], dtype=np.float32)
                  for name in StepWeights._fields if name in stored}
    for name, shape in SHAPES.items():
        if name not in arrays or arrays[name].shape != shape:
            raise ValueError(f"{path.name}: {name!r} is not there in the shape {shape}")
    return StepWeights(**arrays)


@compiled
def new_desk(most: int) -> Desk:
    """Return room for `most` candidates."""
    return Desk(np.empty(WIDTH, np.float32), np.empty(WIDTH, np.float32),
                np.empty(WIDTH, np.float32), np.empty(ACTION_WIDTH, np.float32),
                np.empty((most, ACTION_WIDTH), np.float32),
                np.empty((most, ACTION_WIDTH), np.float32),
                np.empty((NUM_HEADS, most), np.float32))


@inlined_arithmetic
def _add_product(x: Float32Array, matrix: Float32Array, result: Float32Array) -> None:
    """Add `x` times a matrix. In place."""
    for i in range(0, matrix.shape[0], UNROLLED):
        a, b, c, d = x[i], x[i + 1], x[i + 2], x[i + 3]
        row_a, row_b, row_c, row_d = matrix[i], matrix[i + 1], matrix[i + 2], matrix[i + 3]
        for j in range(matrix.shape[1]):
            result[j] += a * row_a[j] + b * row_b[j] + c * row_c[j] + d * row_d[j]


@inlined_arithmetic
def _add_products(x: Float32Array, matrix: Float32Array, result: Float32Array) -> None:
    """Add each row of `x` times a matrix of ACTION_WIDTH columns to a row. In place."""
    abreast = len(x) - len(x) % ABREAST
    for row in range(0, abreast, ABREAST):
        first, second, third, fourth = x[row], x[row + 1], x[row + 2], x[row + 3]
        for i in range(0, matrix.shape[0], 2):
            upper, lower = matrix[i], matrix[i + 1]
            a, b, c, d = first[i], second[i], third[i], fourth[i]
            e, f, g, h = first[i + 1], second[i + 1], third[i + 1], fourth[i + 1]
            for j in range(ACTION_WIDTH):
                result[row, j] += a * upper[j] + e * lower[j]
                result[row + 1, j] += b * upper[j] + f * lower[j]
                result[row + 2, j] += c * upper[j] + g * lower[j]
                result[row + 3, j] += d * upper[j] + h * lower[j]
    for row in range(abreast, len(x)):
        _add_product(x[row], matrix, result[row])


@inlined_arithmetic
def _begin_query(weights: StepWeights, place: Float32Array, glob: Float32Array,
                 desk: Desk) -> None:
    """Ask from the present place and the state of the vehicle. In place."""
    for j in range(WIDTH):
        desk.hidden[j] = weights.globe_bias[j]
        desk.query[j] = weights.globe_output_bias[j] + place[j]
    _add_product(glob, weights.globe, desk.hidden)
    for j in range(WIDTH):
        desk.hidden[j] = desk.hidden[j] / (np.float32(1.0) + np.exp(-desk.hidden[j]))
    _add_product(desk.hidden, weights.globe_output, desk.query)


@inlined_arithmetic
def _describe_actions(weights: StepWeights, memory: Float32Array, tokens: IntArray,
                      feature: Float32Array, desk: Desk) -> None:
    """Begin the network over actions, (candidate, ACTION_WIDTH). In place."""
    action = desk.action[: len(tokens)]
    for index in range(len(tokens)):
        token = memory[tokens[index]]
        for j in range(ACTION_WIDTH):
            action[index, j] = weights.action_bias[j] + token[SHARE + j]
    _add_products(feature, weights.action, action)
    for index in range(len(tokens)):
        for j in range(ACTION_WIDTH):
            action[index, j] = max(action[index, j], np.float32(0.0))


@inlined_arithmetic
def _weigh(weights: StepWeights, token: Float32Array, index: int, desk: Desk) -> None:
    """Find how much each head looks at a candidate, before the softmax. In place."""
    action, query = desk.action[index], desk.query
    a = b = c = d = np.float32(0.0)
    for j in range(ACTION_WIDTH):
        a += weights.glimpse_bias[0, j] * action[j]
        b += weights.glimpse_bias[1, j] * action[j]
        c += weights.glimpse_bias[2, j] * action[j]
        d += weights.glimpse_bias[3, j] * action[j]
    p = q = r = s = np.float32(0.0)
    for j in range(HEAD_WIDTH):
        p += query[j] * token[KEY + j]
        q += query[HEAD_WIDTH + j] * token[KEY + HEAD_WIDTH + j]
        r += query[2 * HEAD_WIDTH + j] * token[KEY + 2 * HEAD_WIDTH + j]
        s += query[3 * HEAD_WIDTH + j] * token[KEY + 3 * HEAD_WIDTH + j]
    scale = np.float32(HEAD_WIDTH ** -0.5)
    weight = desk.weight
    weight[0, index], weight[1, index] = a + p * scale, b + q * scale
    weight[2, index], weight[3, index] = c + r * scale, d + s * scale


@inlined_arithmetic
def _normalise(weight: Float32Array) -> None:
    """Replace numbers by their softmax. In place."""
    top = weight[0]
    for index in range(len(weight)):
        top = max(top, weight[index])
    total = np.float32(0.0)
    for index in range(len(weight)):
        weight[index] = np.exp(weight[index] - top)
        total += weight[index]
    for index in range(len(weight)):
        weight[index] /= total


@inlined_arithmetic
def _glimpse(memory: Float32Array, tokens: IntArray, desk: Desk) -> None:
    """Mix the candidates' values by weight. In place."""
    weight, glimpsed = desk.weight, desk.glimpsed
    for j in range(WIDTH):
        glimpsed[j] = np.float32(0.0)
    for index in range(len(tokens)):
        token = memory[tokens[index]]
        a, b, c, d = weight[0, index], weight[1, index], weight[2, index], weight[3, index]
        for j in range(HEAD_WIDTH):
            glimpsed[j] += a * token[VALUE + j]
            glimpsed[HEAD_WIDTH + j] += b * token[VALUE + HEAD_WIDTH + j]
            glimpsed[2 * HEAD_WIDTH + j] += c * token[VALUE + 2 * HEAD_WIDTH + j]
            glimpsed[3 * HEAD_WIDTH + j] += d * token[VALUE + 3 * HEAD_WIDTH + j]


@inlined_arithmetic
def _mix_actions(weights: StepWeights, count: int, desk: Desk) -> None:
    """End the network over actions but for its score, (candidate, ACTION_WIDTH). In place."""
    for j in range(ACTION_WIDTH):
        desk.asked[j] = weights.action_mix_bias[j]
    _add_product(desk.query, weights.action_query, desk.asked)
    for index in range(count):
        for j in range(ACTION_WIDTH):
            desk.mixed[index, j] = desk.asked[j]
    _add_products(desk.action[:count], weights.action_mix, desk.mixed[:count])


@inlined_arithmetic
def _score(weights: StepWeights, token: Float32Array, index: int, desk: Desk) -> float:
    """Return the score of a candidate, before it is clipped."""
    mixed, query = desk.mixed[index], desk.query
    dot = extra = np.float32(0.0)
    for j in range(WIDTH):
        dot += query[j] * token[POINTER + j]
    for j in range(ACTION_WIDTH):
        extra += weights.action_score[j] * max(mixed[j], np.float32(0.0))
    return float(dot * np.float32(WIDTH ** -0.5) + extra)


@inlined
def _score_all(weights: StepWeights, memory: Float32Array, seen: Observation, r: int, desk: Desk,
               scores: Float32Array) -> None:
    """Write the scores of a rollout's candidates, before they are clipped. In place."""
    count = seen.count[r]
    tokens = seen.token[r, :count]
    _begin_query(weights, memory[seen.here[r]], seen.glob[r], desk)
    _describe_actions(weights, memory, tokens, seen.feature[r, :count], desk)
    for index in range(count):
        _weigh(weights, memory[tokens[index]], index, desk)
    for head in range(NUM_HEADS):
        _normalise(desk.weight[head, :count])
    _glimpse(memory, tokens, desk)
    _add_product(desk.glimpsed, weights.glimpse_output, desk.query)
    _mix_actions(weights, count, desk)
    for index in range(count):
        scores[index] = _score(weights, memory[tokens[index]], index, desk)


@compiled
def choose(scores: Float32Array, temperature: float, rng: np.random.Generator) -> int:
    """Return the likeliest candidate, or one drawn by probability if the temperature isn't 0."""
    best, most = 0, -np.inf
    for index in range(len(scores)):
        value = scores[index]
        if temperature > 0:
            noise = max(rng.standard_exponential(), LEAST_NOISE)
            value = CLIP * math.tanh(value * 2 / CLIP) / temperature - math.log(noise)
        if value > most:
            best, most = index, value
    return best


@compiled
def _roll_out(weights: StepWeights, memory: Float32Array, instance: Instance, scale: Scales,
              state: State, type_token: Float32Array, seen: Observation, r: int,
              temperature: float, rng: np.random.Generator, kept: int, actions: IntArray,
              stop: IntArray) -> int:
    """Plan one rollout from its `kept` first actions on; write the others and return how many.

    In place. `GIVEN_UP` if an alarm rings before.
    """
    for index in range(kept):
        apply(instance, state, r, actions[index])
    desk = new_desk(seen.token.shape[1])
    scores = np.empty(seen.token.shape[1], np.float32)
    choice = np.zeros(len(seen.count), np.int64)
    scratch = len(seen.count)
    for index in range(kept, len(actions)):
        if rung(stop):
            return GIVEN_UP
        if step(instance, scale, state, type_token, r, r + 1, scratch, choice, seen) == 0:
            return index
        _score_all(weights, memory, seen, r, desk, scores)
        choice[r] = choose(scores[: seen.count[r]], temperature, rng)
        actions[index] = seen.action[r, choice[r]]
    return len(actions)


@compiled
def candidate_scores(weights: StepWeights, memory: Float32Array, seen: Observation,
                     r: int) -> Float32Array:
    """Return the scores of a rollout's candidates, (candidate,), before they are clipped."""
    scores = np.empty(seen.count[r], np.float32)
    _score_all(weights, memory, seen, r, new_desk(seen.count[r]), scores)
    return scores


def roll_out(weights: StepWeights, memory: Float32Array, instance: Instance, scale: Scales,
             type_token: Float32Array, temperatures: Sequence[float], rng: np.random.Generator,
             so_far: Rollout = NOTHING, stop: IntArray | None = None) -> list[Rollout]:
    """Plan a problem several times; return the plans.

    Parameters
    ----------
    weights
        Of the policy's decisions.
    memory
        (token, memory width) that its encoder made of the problem.
    instance, scale, type_token
        The problem, packed alone, and what `model.policy.tokens` says of it.
    temperatures
        Of each rollout if it plans all; 0 for the likeliest action at each step.
    rng
        For all others.
    so_far
        What was found before. Rollouts keep a part of the cheapest so far.
    stop
        Flag of an alarm at which the rest is given up.
    """
    flag = silent() if stop is None else stop
    rows = len(temperatures)
    state = reset(instance, np.zeros(rows, np.int64))
    seen = empty_observation(rows, instance.node.shape[2], instance.type.shape[1])
    actions = np.empty(max_steps(instance), np.int64)
    hotter = HOTTER_WITH_DRONES if (instance.type["drones"] > 0).any() else HOTTER
    plans = []
    for r, temperature in enumerate(temperatures):
        kept = NOTHING.actions
        if so_far is not NOTHING:
            most_anew = MOST_ANEW if temperature > 0 else MOST_ANEW_GREEDILY
            kept = part_to_keep(instance, so_far.actions, most_anew, rng)
            temperature *= hotter
        actions[: len(kept)] = kept
        count = _roll_out(weights, memory, instance, scale, state, type_token, seen, r,
                          float(temperature), rng, len(kept), actions, flag)
        if count == GIVEN_UP:
            break
        cost = float(by_term(state.cost[r : r + 1]).sum())
        plans.append(Rollout(actions[:count].copy(), cost))
        so_far = min(so_far, plans[-1], key=cost_of)
    return plans


def cost_of(rollout: Rollout) -> float:
    """Return what a plan costs, to compare plans by."""
    return rollout.cost
