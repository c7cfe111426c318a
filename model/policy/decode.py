"""Plans from an exported policy: greedy or sampled, one network call a decision for all samples."""

import json
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from threading import Event
from typing import Literal, NamedTuple

import numpy as np
import onnxruntime as ort
from onnxruntime.capi import onnxruntime_pybind11_state as ort_errors

from model.engine.alarm import Alarm, has_rung
from model.engine.cores import num_cores
from model.engine.instance import Instance
from model.engine.threads import side_by_side
from model.policy.decision_features import Observation, Rollouts, Scene
from model.policy.problem_features import PARTNER, PLACE, Float32Array, Tokens, scales, tokens
from model.policy.rolling import (
    NOTHING, STEP_WEIGHTS, Rollout, StepWeights, cost_of, read_weights, roll_out,
)
from model.policy.route_pool import RoutePool
from model.problem import BoolArray, IntArray, Problem
from model.simulation.actions import max_steps
from model.simulation.state import by_term

ORT_ERRORS = (ort_errors.NoSuchFile, ort_errors.InvalidProtobuf, ort_errors.InvalidGraph,
              ort_errors.Fail)

NO_ACTION = -1

BLOCK = 16
"""Samples of a policy whose step isn't in the engine that are planned side by side, in one thread,
so that memory is bounded. They don't go on from one another: all blocks are planned on all
cores."""

LINE = 8
"""Samples of a policy whose step is in the engine that are planned one after another, in one
thread, and go on from the best so far."""

LANES = 2
"""Lines of samples at the same time, each with its own random numbers. The next go on from the best
by routes of all, so that more at a time, or longer ones, would be sooner and worse."""

SYMMETRIES = tuple((swapped, x, y) for swapped in (False, True) for x in (1, -1) for y in (1, -1))
"""Ways to lay the same plane before the policy: axes swapped or not, and their signs. There is a
greedy plan for each, and blocks of samples take turns, since a policy errs differently on each."""

VIEWED_CUSTOMERS = 600
"""Customers in all views of greedy plans, so that fewer are planned where one takes longer."""


@dataclass(frozen=True)
class DecodeConfig:
    """How to choose actions."""

    decoding: Literal["greedy", "sample"] = "greedy"
    num_samples: int = 64
    temperature: float = 1.0
    seed: int = 0
    most_views: int = len(SYMMETRIES)  # from which to plan greedily, if nothing is sampled


@dataclass(frozen=True, eq=False)
class Policy:
    """An exported policy: one run of `encoder` per plan, one of `step` per decision."""

    name: str
    encoder: ort.InferenceSession
    step: ort.InferenceSession
    hidden_size: int
    num_features: int  # of the action features, the first that it was trained with
    step_weights: StepWeights | None = None  # of a policy whose step is in the engine, too


@dataclass(frozen=True, eq=False)
class View:
    """A problem as policies see it."""

    scene: Scene
    tokens: Tokens


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
    # It would keep what the largest problem took, twice over, and is no faster.
    options.enable_cpu_mem_arena = False
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


def prepare(problem: Problem, instance: Instance) -> View:
    """Describe a problem to policies; `instance` is the same, packed alone."""
    scale = scales(instance)
    seen = tokens(instance, scale, problem.coordinates[None])
    return View(Scene(instance, scale, seen.type), seen)


def laid_out(seen: Tokens, symmetry: int) -> Tokens:
    """Return a problem's tokens with its plane laid out by one of the `SYMMETRIES`."""
    swapped, x, y = SYMMETRIES[symmetry]
    node = seen.node.copy()
    for first in (PLACE, PARTNER):
        both = node[..., first:first + 2]
        node[..., first:first + 2] = (both[..., ::-1] if swapped else both) * np.array(
            [x, y], np.float32)
    return seen._replace(node=node)


def encode(policy: Policy, seen: Tokens) -> Float32Array:
    """Return what the encoder makes of a problem, (token, width)."""
    memory, = policy.encoder.run(None, {"node": seen.node, "type": seen.type, "pair": seen.pair})
    return memory


def decode(policy: Policy, view: View, config: DecodeConfig,
           deadline: float | None = None, alarm: IntArray | None = None) -> Rollout:
    """Plan by the policy; return the cheapest plan by routes of all rollouts.

    Parameters
    ----------
    policy
        An exported policy.
    view
        The problem.
    config
        Greedy or sampled; the same seed gives the same plan. Where several samples are asked for,
        greedy plans are among them.
    deadline
        On `time.perf_counter`; no round of samples begins later, but the first block. None: no
        limit.
    alarm
        Setting of an alarm at which rollouts are given up; `NOTHING` is returned if all are.
    """
    if config.num_samples < 1 or config.temperature <= 0:
        raise ValueError(f"num_samples, temperature: {config.num_samples!r}, "
                         f"{config.temperature!r} are not allowed")
    rounds = _rounds(policy, view, config)
    blocks = sum(map(len, rounds))
    sequence = np.random.SeedSequence(config.seed)
    # One by one, as an alarm may leave most of them unused.
    seeds = (sequence.spawn(1)[0] for _ in range(blocks + len(rounds)))
    routes, found = RoutePool(view.scene.instance), NOTHING
    planning = _Planning(policy, view, deadline, Alarm().setting if alarm is None else alarm)
    cores = num_cores()
    for now in rounds:
        own = [next(seeds) for _ in now]
        for rollout in planning.plan(now, own, found, cores):
            routes.add(rollout.actions)
            found = min(found, rollout, key=cost_of)
        if blocks > 1:
            found = routes.improved(found, np.random.default_rng(next(seeds)), planning.alarm)
        if has_rung(planning.alarm):
            break
    return found


class _Block(NamedTuple):
    """Rollouts in one thread."""

    symmetry: int  # one of SYMMETRIES
    temperatures: list[float]
    is_first: bool = False


def _rounds(policy: Policy, view: View, config: DecodeConfig) -> list[list[_Block]]:
    """Return the blocks that are planned at the same time, those of each round."""
    views = VIEWED_CUSTOMERS // max(1, int(view.scene.instance.size[0].customers))
    views = min(max(views, 1), len(SYMMETRIES))
    in_engine = policy.step_weights is not None
    if config.decoding == "greedy":
        return _greedy(min(views, config.most_views), in_engine)
    if config.num_samples == 1:
        return [[_Block(0, [config.temperature], is_first=True)]]
    samples = max(config.num_samples - views, 1)
    # Parts of the best, planned greedily, would let many samples go on from too much of one plan.
    greedy = _greedy(views, in_engine and samples < views)
    size = LINE if in_engine else BLOCK
    drawn = [_Block(index % len(SYMMETRIES), [config.temperature] * min(size, samples - first))
             for index, first in enumerate(range(0, samples, size))]
    lanes = LANES if in_engine else len(drawn)
    return [*greedy, *(drawn[first:first + lanes] for first in range(0, len(drawn), lanes))]


def _greedy(views: int, in_parts: bool) -> list[list[_Block]]:
    """Return the blocks of greedy plans, about as much work as a plan from each of so many views.

    Parts of the best plan planned anew are worth as much as half of the views, which have to be
    encoded and planned as a whole.
    """
    parts = views // 2 if in_parts else 0
    whole = [_Block(symmetry, [0.0], symmetry == 0) for symmetry in range(views - parts)]
    lines = [_Block(symmetry, [0.0] * parts) for symmetry in range(min(LANES, len(whole)))]
    return [whole, lines] if parts > 0 else [whole]


class _Planning:
    """Plans a problem in rounds, from several views."""

    def __init__(self, policy: Policy, view: View, deadline: float | None,
                 alarm: IntArray) -> None:
        self.policy = policy
        self.scene = view.scene
        self.alarm = alarm
        self._tokens = view.tokens
        self._deadline = deadline
        self._memories: dict[int, Float32Array] = {}  # by symmetry

    def plan(self, blocks: Sequence[_Block], seeds: Sequence[np.random.SeedSequence],
             so_far: Rollout, cores: int) -> list[Rollout]:
        """Return what blocks plan, those that are due, before what they go on from changes."""
        under_way = [_UnderWay(self, block, np.random.default_rng(seed))
                     for block, seed in zip(blocks, seeds, strict=True)]
        # All are encoded first: so no core waits at the end while another does both for the last.
        tasks: list[Callable[[], list[Rollout]]] = [each.encode for each in under_way]
        tasks += [partial(each.plan, so_far) for each in under_way]
        return list(chain.from_iterable(side_by_side(tasks, cores)))

    def encoded(self, block: _Block) -> Float32Array | None:
        """Return what the encoder makes of a block's view; None if the block isn't due."""
        is_late = self._deadline is not None and time.perf_counter() >= self._deadline
        if has_rung(self.alarm) or (is_late and not block.is_first):
            return None
        symmetry = block.symmetry
        if symmetry not in self._memories:
            self._memories[symmetry] = encode(self.policy, laid_out(self._tokens, symmetry))
        return self._memories[symmetry]


class _UnderWay:
    """A block that is encoded in one thread and planned in one, which may be another."""

    def __init__(self, planning: _Planning, block: _Block, rng: np.random.Generator) -> None:
        self._planning = planning
        self._block = block
        self._rng = rng
        self._memory: Float32Array | None = None
        self._is_encoded = Event()

    def encode(self) -> list[Rollout]:
        """Run the encoder; that is no plan yet."""
        try:
            self._memory = self._planning.encoded(self._block)
        finally:
            self._is_encoded.set()
        return []

    def plan(self, so_far: Rollout) -> list[Rollout]:
        """Return what the block plans once it is encoded, if it was due."""
        self._is_encoded.wait()
        if self._memory is None:
            return []
        return _decode_block(self._planning.policy, self._planning.scene, self._memory,
                             self._block.temperatures, self._rng, so_far, self._planning.alarm)


def _decode_block(policy: Policy, scene: Scene, memory: Float32Array, temperatures: list[float],
                  rng: np.random.Generator, so_far: Rollout,
                  alarm: IntArray) -> list[Rollout]:
    """Plan a rollout by each temperature.

    Those of a policy whose step is in the engine go on from the best so far. An alarm ends them.
    """
    if policy.step_weights is not None:
        return roll_out(policy.step_weights, memory, scene, temperatures, rng, so_far, alarm)
    rows, warmth = len(temperatures), np.array([temperatures], np.float32).T
    rollouts = Rollouts(scene, np.zeros(rows, np.int64))
    seen = rollouts.seen
    hidden = np.zeros((rows, policy.hidden_size), np.float32)
    choice = np.zeros(rows, np.int64)
    actions = []
    for _ in range(max_steps(scene.instance)):
        if has_rung(alarm):
            return []
        most = rollouts.step(choice)
        if most == 0:
            break
        logits, hidden = policy.step.run(None, step_inputs(policy, memory, seen, most, hidden))
        noise = rng.standard_exponential(logits.shape, np.float32)
        noise[warmth[:, 0] == 0.0] = 1.0
        disturbed(logits, np.where(warmth > 0.0, warmth, 1.0), noise).argmax(axis=1, out=choice)
        actions.append(np.where(seen.count > 0, seen.action[np.arange(rows), choice], NO_ACTION))
    cost = by_term(rollouts.state.cost[:rows]).sum(axis=1)
    by_rollout = np.array(actions).reshape(-1, rows).T
    return [Rollout(taken[taken != NO_ACTION], float(cost[r]))
            for r, taken in enumerate(by_rollout)]


def disturbed(logits: Float32Array, temperature: Float32Array,
              noise: Float32Array) -> Float32Array:
    """Return logits (rollout, candidate) whose largest is a draw by their probabilities.

    `temperature` is (rollout, 1), `noise` exponential, like the logits. Noise may be exactly zero,
    whose logarithm would let even what is masked win.
    """
    return logits / temperature - np.log(np.maximum(noise, np.finfo(np.float32).tiny))


def step_inputs(policy: Policy, memory: Float32Array, seen: Observation, most: int,
                hidden: Float32Array) -> dict[str, IntArray | Float32Array | BoolArray]:
    """Return the inputs of `step.onnx`, padded to `most` candidates."""
    return {
        "memory": memory,
        "here": seen.here,
        "candidate": np.ascontiguousarray(seen.token[:, :most]),
        "feature": np.ascontiguousarray(seen.feature[:, :most, : policy.num_features]),
        "allowed": np.arange(most) < seen.count[:, None],
        "glob": seen.glob,
        "hidden": hidden,
    }
