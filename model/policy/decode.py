"""Plans from an exported policy: greedy or sampled, one network call a decision for all samples."""

import json
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
import onnxruntime as ort
from onnxruntime.capi import onnxruntime_pybind11_state as ort_errors

from model.kernel.alarm import silent
from model.kernel.cores import num_cores
from model.kernel.instance import Instance
from model.policy.features import step
from model.policy.observation import Observation, empty_observation
from model.policy.rollouts import (
    NOTHING, STEP_WEIGHTS, Rollout, StepWeights, read_weights, roll_out,
)
from model.policy.tokens import Float32Array, Scales, Tokens, scales, tokens
from model.problem import BoolArray, IntArray, Problem
from model.simulation.cost import by_term
from model.simulation.simulator import max_steps, reset

ORT_ERRORS = (ort_errors.NoSuchFile, ort_errors.InvalidProtobuf, ort_errors.InvalidGraph,
              ort_errors.Fail)

NO_ACTION = -1

BLOCK = 16
"""Samples planned side by side, in one thread, so that memory is bounded."""

LANES = 2
"""Blocks of samples planned at the same time, each with its own random numbers. The next go on from
the best of all, so that more at a time would be sooner and worse. A policy whose step isn't
compiled, whose samples don't go on from one another, plans them all on all cores."""

SYMMETRIES = tuple((swapped, x, y) for swapped in (False, True) for x in (1, -1) for y in (1, -1))
"""Ways to lay the same plane before the policy: axes swapped or not, and their signs. Blocks of
samples take turns at them, since a policy errs differently on each."""


@dataclass(frozen=True)
class DecodeConfig:
    """How to choose actions."""

    decoding: Literal["greedy", "sample"] = "greedy"
    num_samples: int = 64
    temperature: float = 1.0
    seed: int = 0


@dataclass(frozen=True, eq=False)
class Policy:
    """An exported policy: one run of `encoder` per plan, one of `step` per decision."""

    name: str
    encoder: ort.InferenceSession
    step: ort.InferenceSession
    hidden_size: int
    num_features: int  # of the action features, the first that it was trained with
    step_weights: StepWeights | None = None  # of a policy whose step is compiled, too


@dataclass(frozen=True, eq=False)
class Scene:
    """A problem as the policy sees it."""

    instance: Instance
    scale: Scales
    tokens: Tokens
    memory: Float32Array  # (token, width)


def load_policy(folder: Path) -> Policy:
    """Load `encoder.onnx`, `step.onnx` and `card.json`; `step.npz` if there is one.

    Raises
    ------
    ValueError
        If one of them is missing or can't be read.
    """
    ort.disable_telemetry_events()  # in case it was loaded before this package
    options = ort.SessionOptions()
    options.intra_op_num_threads = 1
    options.inter_op_num_threads = 1
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        card = json.loads((folder / "card.json").read_text())
        encoder, step = (ort.InferenceSession(str(folder / f"{part}.onnx"), options,
                                              providers=["CPUExecutionProvider"])
                         for part in ("encoder", "step"))
        weights = folder / STEP_WEIGHTS
        step_weights = read_weights(weights) if weights.exists() else None
    except (OSError, ValueError, *ORT_ERRORS) as error:
        raise ValueError(f"policy folder: {str(folder)!r} is not usable: {error}") from error
    feature, = (entry for entry in step.get_inputs() if entry.name == "feature")
    return Policy(folder.name, encoder, step, int(card["hidden_size"]), int(feature.shape[2]),
                  step_weights)


def prepare(policy: Policy, problem: Problem, instance: Instance) -> Scene:
    """Run the encoder."""
    scale = scales(instance)
    seen = tokens(instance, scale, problem.coordinates[None])
    return Scene(instance, scale, seen, encode(policy, seen, 0))


def encode(policy: Policy, seen: Tokens, symmetry: int) -> Float32Array:
    """Return what the encoder makes of a problem laid out by one of the `SYMMETRIES`."""
    swapped, x, y = SYMMETRIES[symmetry]
    node = seen.node.copy()
    node[..., :2] = (node[..., 1::-1] if swapped else node[..., :2]) * np.array([x, y], np.float32)
    memory, = policy.encoder.run(None, {"node": node, "type": seen.type, "pair": seen.pair})
    return memory


def decode(policy: Policy, scene: Scene, config: DecodeConfig,
           deadline: float | None = None, stop: IntArray | None = None) -> Rollout:
    """Plan by the policy; return the cheapest of the rollouts.

    Parameters
    ----------
    policy
        An exported policy.
    scene
        The problem, prepared by the same policy.
    config
        Greedy or sampled; the same seed gives the same plan.
    deadline
        On `time.perf_counter`; no block of samples begins later, but the first. None: no limit.
    stop
        Flag of an alarm at which rollouts are given up; `NOTHING` is returned if all are.
    """
    flag = silent() if stop is None else stop
    if config.decoding == "greedy":
        return _decode_block(policy, scene, [0.0], np.random.default_rng(config.seed), NOTHING,
                             flag)
    if config.num_samples < 1 or config.temperature <= 0:
        raise ValueError(f"num_samples, temperature: {config.num_samples!r}, "
                         f"{config.temperature!r} are not allowed")
    firsts = range(0, config.num_samples, BLOCK)
    seeds = np.random.SeedSequence(config.seed).spawn(len(firsts))

    lanes = len(firsts) if policy.step_weights is None else LANES
    found = NOTHING

    def plan_block(first: int, seed: np.random.SeedSequence) -> Rollout:
        if flag[0] or (first > 0 and deadline is not None and time.perf_counter() >= deadline):
            return found
        symmetry = first // BLOCK % len(SYMMETRIES)
        seen = scene if symmetry == 0 else replace(
            scene, memory=encode(policy, scene.tokens, symmetry))
        temperatures = [config.temperature] * min(BLOCK, config.num_samples - first)
        if config.num_samples > 1:
            temperatures[0] = 0.0
        return _decode_block(policy, seen, temperatures, np.random.default_rng(seed), found, flag)

    with ThreadPoolExecutor(min(lanes, len(firsts), num_cores())) as pool:
        for begin in range(0, len(firsts), lanes):
            now = slice(begin, begin + lanes)
            found = min(pool.map(plan_block, firsts[now], seeds[now]),
                        key=lambda rollout: rollout.cost)
    return found


def _decode_block(policy: Policy, scene: Scene, temperatures: list[float],
                  rng: np.random.Generator, so_far: Rollout, stop: IntArray) -> Rollout:
    """Plan a rollout by each temperature; return the cheapest of them and that so far.

    Those of a policy whose step is compiled go on from the best so far. An alarm ends them.
    """
    if policy.step_weights is not None:
        return roll_out(policy.step_weights, scene.memory, scene.instance, scene.scale,
                        scene.tokens.type, temperatures, rng, so_far, stop)
    rows, warmth = len(temperatures), np.array([temperatures], np.float32).T
    instance = scene.instance
    state = reset(instance, np.zeros(rows, np.int64))
    seen = empty_observation(rows, instance.node.shape[2], instance.type.shape[1])
    hidden = np.zeros((rows, policy.hidden_size), np.float32)
    choice = np.zeros(rows, np.int64)
    actions = []
    for _ in range(max_steps(instance)):
        if stop[0]:
            return so_far
        most = step(instance, scene.scale, state, scene.tokens.type, 0, rows, rows, choice, seen)
        if most == 0:
            break
        logits, hidden = policy.step.run(None, step_inputs(policy, scene, seen, most, hidden))
        noise = rng.standard_exponential(logits.shape, np.float32)
        noise[warmth[:, 0] == 0.0] = 1.0
        disturbed(logits, np.where(warmth > 0.0, warmth, 1.0), noise).argmax(axis=1, out=choice)
        actions.append(np.where(seen.count > 0, seen.action[np.arange(rows), choice], NO_ACTION))
    cost = by_term(state.cost[:rows]).sum(axis=1)
    best = int(cost.argmin())
    if cost[best] >= so_far.cost:
        return so_far
    of_best = np.array([step_actions[best] for step_actions in actions])
    return Rollout(of_best[of_best != NO_ACTION], float(cost[best]))


def disturbed(logits: Float32Array, temperature: Float32Array,
              noise: Float32Array) -> Float32Array:
    """Return logits (rollout, candidate) whose largest is a draw by their probabilities.

    `temperature` is (rollout, 1), `noise` exponential, like the logits. Noise may be exactly zero,
    whose logarithm would let even what is masked win.
    """
    return logits / temperature - np.log(np.maximum(noise, np.finfo(np.float32).tiny))


def step_inputs(policy: Policy, scene: Scene, seen: Observation, most: int,
                hidden: Float32Array) -> dict[str, IntArray | Float32Array | BoolArray]:
    """Return the inputs of `step.onnx`, padded to `most` candidates."""
    return {
        "memory": scene.memory,
        "here": seen.here,
        "candidate": np.ascontiguousarray(seen.token[:, :most]),
        "feature": np.ascontiguousarray(seen.feature[:, :most, : policy.num_features]),
        "allowed": np.arange(most) < seen.count[:, None],
        "glob": seen.glob,
        "hidden": hidden,
    }
