"""Random masked rollouts of packed problems, recorded step by step."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Any

import numpy as np

from model.engine.instance import Instance, pack
from model.policy import problem_features
from model.policy.decision_features import Rollouts, Scene
from model.problem import UNREACHABLE, FloatArray, Problem, Travel
from model.problem.quantities import Unit, units_of
from model.simulation.actions import NUM_KINDS, RETURN, legal_actions
from model.simulation.state import State, by_term, empty_outlooks
from model.solution import COST_TERMS
from training.instances import VARIANTS, generate


@dataclass
class Step:
    """What one rollout saw and did."""

    codes: list[int]  # legal actions
    choice: int  # index into them
    feature: FloatArray
    glob: FloatArray
    token: list[int]
    here: int


@dataclass
class Rollout:
    """One rollout, from the first step on."""

    steps: list[Step] = field(default_factory=list)
    cost: FloatArray = field(default_factory=lambda: np.zeros(len(COST_TERMS) - 1))

    @property
    def actions(self) -> list[int]:
        """Codes of the actions done."""
        return [step.codes[step.choice] for step in self.steps]


@dataclass(frozen=True)
class Batch:
    """Rollouts of problems packed together, one a problem."""

    problems: Sequence[Problem]
    instance: Instance
    tokens: problem_features.Tokens
    rollouts: list[Rollout]
    state: State


def choose(rng: np.random.Generator, codes: Sequence[int]) -> int:
    """Draw a candidate; returns are rarer, so that trips grow."""
    weight = np.array([0.3 if code % NUM_KINDS == RETURN else 1.0 for code in codes])
    return int(rng.choice(len(codes), p=weight / weight.sum()))


def roll(problems: Sequence[Problem], seed: int) -> Batch:
    """Run one random rollout a problem, all in one batch; each draws from its own stream.

    Raises
    ------
    RuntimeError
        If a rollout does not end.
    """
    instance, rows = pack(problems), len(problems)
    scale = problem_features.scales(instance)
    width = instance.node.shape[2]
    coordinates = np.zeros((rows, width, 2))
    for row, problem in enumerate(problems):
        coordinates[row, : problem.num_nodes] = problem.coordinates
    tokens = problem_features.tokens(instance, scale, coordinates)
    under_way = Rollouts(Scene(instance, scale, tokens.type), np.arange(rows))
    state, seen = under_way.state, under_way.seen
    rngs = [np.random.default_rng((seed, problem.num_customers)) for problem in problems]
    rollouts = [Rollout() for _ in problems]
    choice = np.zeros(rows, np.int64)
    vehicles = int(instance.type["count"].sum(axis=1).max())
    for _ in range(2 * width + vehicles + 2):
        if not under_way.step(choice):
            break
        for row in np.flatnonzero(seen.count).tolist():
            count = seen.count[row]
            codes = seen.action[row, :count].tolist()
            choice[row] = choose(rngs[row], codes)
            rollouts[row].steps.append(Step(
                codes, int(choice[row]), seen.feature[row, :count].copy(), seen.glob[row].copy(),
                seen.token[row, :count].tolist(), int(seen.here[row])))
    else:
        raise RuntimeError("a rollout does not end")
    for row in range(rows):
        rollouts[row].cost = by_term(state.cost)[row].copy()
    return Batch(problems, instance, tokens, rollouts, state)


def legal(problem: Problem, instance: Instance, state: State) -> list[int]:
    """Return the legal actions of the only rollout of a state."""
    most = 2 * problem.num_nodes + 1 + len(problem.vehicle_types)
    actions, outlooks = np.zeros(most, np.int64), empty_outlooks(most)
    count = legal_actions(instance, state, 0, 1, actions, outlooks)
    return actions[:count].tolist()


def random_problems(seed: int, count: int, largest: int = 25,
                    variants: Iterable[str] = VARIANTS) -> list[Problem]:
    """Draw problems of training variants in turn, of 1 to `largest` customers."""
    rng = np.random.default_rng(seed)
    names = list(variants)
    return [generate(rng, int(rng.integers(1, largest + 1)), names[index % len(names)])
            for index in range(count)]


@dataclass(frozen=True)
class Units:
    """Factors by which a problem's numbers grow when its units shrink."""

    length: int = 1
    time: int = 1
    amount: int = 1
    money: float = 1.0

    def factor(self, unit: Unit) -> float:
        """Return by what numbers of a unit grow."""
        times = (self.length**unit.length, self.time**unit.time, self.amount**unit.amount)
        return math.prod(times) * self.money**unit.money

    def converted(self, value: Any, unit: Unit | None = None) -> Any:
        """Convert a data class or what one of its fields holds."""
        if is_dataclass(value) and not isinstance(value, type):
            units = units_of(type(value))
            return replace(value, **{each.name: self.converted(
                getattr(value, each.name), units.get(each.name)) for each in fields(value)})
        if isinstance(value, tuple):
            return tuple([self.converted(each, unit) for each in value])
        if isinstance(value, Mapping):
            return {name: self.converted(each, unit) for name, each in value.items()}
        if unit is None or value is None or value == unit.most:
            return value
        return type(value)(value * self.factor(unit))

    def travel(self, travel: Travel) -> Travel:
        """Convert legs."""
        return Travel(*(np.where(legs < UNREACHABLE, legs * factor, UNREACHABLE) for legs, factor
                        in zip(travel.arrays(), (self.time, self.length), strict=True)))


def in_other_units(problem: Problem, units: Units) -> Problem:
    """Return the same problem with every number in other units."""
    return replace(
        problem, travel=tuple(map(units.travel, problem.travel)),
        vehicle_costs=None if problem.vehicle_costs is None
        else problem.vehicle_costs * units.money,
        coordinates=problem.coordinates * units.length,
        unassigned_cost=units.money * problem.unassigned_cost,
        **{name: units.converted(getattr(problem, name)) for name in (
            "depots", "customers", "vehicle_types", "shipments", "relations")})
