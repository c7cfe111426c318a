"""Random masked rollouts of packed problems, recorded step by step."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from model.engine.instance import Instance, pack
from model.policy import problem_features
from model.policy.decision_features import Rollouts, Scene
from model.problem import (
    UNLIMITED, UNREACHABLE, Customer, DrivingRules, DroneType, Energy, FloatArray, Overtime,
    Problem, Relation, SpeedProfile, Travel, VehicleType,
)
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
    cost: FloatArray = field(default_factory=lambda: np.zeros(len(COST_TERMS)))

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

    def limit(self, time: int) -> int:
        """Convert a time that may be without limit."""
        return time if time >= UNLIMITED else time * self.time

    def amounts(self, amounts: tuple[int, ...]) -> tuple[int, ...]:
        """Convert a demand or a capacity."""
        return tuple(amount * self.amount for amount in amounts)

    def customer(self, customer: Customer) -> Customer:
        """Convert a customer."""
        late, early = customer.late_cost_per_hour, customer.early_cost_per_hour
        left_out, longest = customer.unassigned_cost, customer.max_time_aboard
        return replace(
            customer, demand=self.amounts(customer.demand), pickup=self.amounts(customer.pickup),
            unassigned_cost=None if left_out is None else left_out * self.money,
            service_duration=self.time * customer.service_duration,
            setup_duration=self.time * customer.setup_duration,
            max_time_aboard=None if longest is None else self.time * longest,
            earliest=self.time * customer.earliest, latest=self.limit(customer.latest),
            gaps=tuple((self.time * closes, self.time * opens) for closes, opens in customer.gaps),
            release_time=self.time * customer.release_time,
            late_cost_per_hour=None if late is None else late * self.money / self.time,
            late_cost=customer.late_cost * self.money,
            early_cost_per_hour=early * self.money / self.time)

    def energy(self, energy: Energy) -> Energy:
        """Convert a battery."""
        return replace(energy, available=self.time * energy.available,
                       weights=self.amounts(energy.weights),
                       climb_duration=self.time * energy.climb_duration,
                       descent_duration=self.time * energy.descent_duration)

    def durations(self, durations: Mapping[str, int]) -> dict[str, int]:
        """Convert durations by name."""
        return {name: self.time * duration for name, duration in durations.items()}

    def overtime(self, overtime: Overtime) -> Overtime:
        """Convert overtime."""
        return Overtime(self.money / self.time * overtime.cost_per_hour,
                        self.limit(overtime.max_duration))

    def drones(self, drones: DroneType) -> DroneType:
        """Convert a drone type."""
        service = drones.service_duration
        return replace(
            drones, capacity=self.amounts(drones.capacity), endurance=self.limit(drones.endurance),
            launch_duration=self.time * drones.launch_duration,
            recovery_duration=self.time * drones.recovery_duration,
            service_duration=None if service is None else self.time * service,
            service_durations=self.durations(drones.service_durations),
            swap_duration=self.time * drones.swap_duration,
            storms=tuple((self.time * begin, self.limit(end)) for begin, end in drones.storms),
            max_range=None if drones.max_range is None else self.length * drones.max_range,
            cost_per_km=self.money / self.length * drones.cost_per_km,
            cost_per_hour=self.money / self.time * drones.cost_per_hour,
            energy=None if drones.energy is None else self.energy(drones.energy))

    def vehicle_type(self, kind: VehicleType) -> VehicleType:
        """Convert a vehicle type."""
        working, distance, profile = (kind.max_working_duration, kind.max_trip_distance,
                                      kind.speed_profile)
        return replace(
            kind, capacity=self.amounts(kind.capacity), fixed_cost=self.money * kind.fixed_cost,
            cost_per_km=self.money / self.length * kind.cost_per_km,
            cost_per_hour=self.money / self.time * kind.cost_per_hour,
            cost_per_stop=self.money * kind.cost_per_stop,
            cost_per_load_km=self.money / self.length / self.amount * kind.cost_per_load_km,
            overtime=None if kind.overtime is None else self.overtime(kind.overtime),
            earliest=self.time * kind.earliest, latest=self.limit(kind.latest),
            max_working_duration=None if working is None else self.time * working,
            max_travel_duration=(None if kind.max_travel_duration is None
                                 else self.time * kind.max_travel_duration),
            max_range=None if kind.max_range is None else self.length * kind.max_range,
            max_trip_distance=None if distance is None else self.length * distance,
            reload_duration=self.time * kind.reload_duration,
            service_durations=self.durations(kind.service_durations),
            endurance=self.limit(kind.endurance),
            launch_duration=self.time * kind.launch_duration,
            recovery_duration=self.time * kind.recovery_duration,
            storms=tuple((self.time * begin, self.limit(end)) for begin, end in kind.storms),
            energy=None if kind.energy is None else self.energy(kind.energy),
            speed_profile=None if profile is None else SpeedProfile(
                tuple(self.time * change for change in profile.times), profile.factors),
            breaks=tuple(replace(
                each, duration=self.time * each.duration, earliest=self.time * each.earliest,
                latest=self.limit(each.latest)) for each in kind.breaks),
            driving=None if kind.driving is None else self.driving(kind.driving),
            drones=None if kind.drones is None else self.drones(kind.drones),
            more_drones=tuple(map(self.drones, kind.more_drones)))

    def driving(self, rules: DrivingRules) -> DrivingRules:
        """Convert driving rules."""
        return replace(
            rules, max_driving=self.limit(rules.max_driving), rest=self.time * rules.rest,
            split=tuple(self.time * part for part in rules.split),
            max_work=self.limit(rules.max_work))

    def relation(self, relation: Relation) -> Relation:
        """Convert a relation."""
        most = relation.max_lag
        return replace(relation, min_lag=self.time * relation.min_lag,
                       max_lag=None if most is None else self.time * most)

    def travel(self, travel: Travel) -> Travel:
        """Convert legs."""
        return Travel(*(np.where(legs < UNREACHABLE, legs * factor, UNREACHABLE) for legs, factor
                        in zip(travel.arrays(), (self.time, self.length), strict=True)))


def in_other_units(problem: Problem, units: Units) -> Problem:
    """Return the same problem with every number in other units."""
    return replace(
        problem, customers=tuple(map(units.customer, problem.customers)),
        vehicle_types=tuple(map(units.vehicle_type, problem.vehicle_types)),
        travel=tuple(map(units.travel, problem.travel)),
        shipments=tuple(replace(
            each, amount=units.amounts(each.amount), more=tuple(
                replace(part, amount=units.amounts(part.amount)) for part in each.more))
            for each in problem.shipments),
        relations=tuple(map(units.relation, problem.relations)),
        vehicle_costs=None if problem.vehicle_costs is None
        else problem.vehicle_costs * units.money,
        coordinates=problem.coordinates * units.length,
        unassigned_cost=units.money * problem.unassigned_cost)
