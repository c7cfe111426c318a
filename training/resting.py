"""The variant whose drivers have breaks, rest by rules, or travel for so long and no longer."""

from dataclasses import replace

import numpy as np

from model.problem import UNLIMITED, Break, DrivingRules, Problem, VehicleType
from training.ground import integer, uniform
from training.variants import InstanceConfig, drone, hetero, multitrip, soft, vrptw

GROUNDS = (vrptw, soft, multitrip, hetero, drone)
"""What the rules are added to."""


def resting(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Breaks (in half of the problems), rests by driving rules, and limits of all legs together.

    A day is the shift, or 8 mean legs. One to three breaks take 0.03 to 0.1 of it each, and begin
    in windows of 0.05 to 0.3; at the wheel one may be for 1.5 to 5 times the longest leg, or at
    work for up to twice as long; legs take 0.4 to 0.9 of the day at most, and no less than one
    customer takes.
    """
    problem = GROUNDS[integer(rng, 0, len(GROUNDS) - 1)](rng, num_customers, config)
    has_breaks = rng.random() < 0.5
    customers = problem.num_depots

    def with_rests(kind: VehicleType) -> VehicleType:
        legs = problem.travel[kind.travel].duration[:]
        longest = int(legs[kind.begins_at, customers:].max() + legs[customers:, kind.ends_at].max())
        day = kind.latest - kind.earliest if kind.latest < UNLIMITED else int(8 * legs.mean())
        if has_breaks:
            return replace(kind, breaks=_breaks(rng, kind, day))
        if kind.speed_profile is not None:
            return kind
        most = max(int(uniform(rng, 0.4, 0.9) * day), 2 * longest)
        kind = replace(kind, max_travel_duration=most if rng.random() < 0.4 else None)
        return replace(kind, driving=_rules(rng, int(legs.max()))) if rng.random() < 0.8 else kind

    return replace(problem, vehicle_types=tuple(map(with_rests, problem.vehicle_types)))


def _breaks(rng: np.random.Generator, kind: VehicleType, day: int) -> tuple[Break, ...]:
    """Draw one to three breaks, one behind the other."""
    after_departure, at = bool(rng.random() < 0.3), uniform(rng, 0.15, 0.4)
    breaks = []
    for number in range(integer(rng, 1, 3)):
        since = 0 if after_departure else kind.earliest
        width = uniform(rng, 0.05, 0.3)
        breaks.append(Break(
            str(number), int(uniform(rng, 0.03, 0.1) * day), since + int(at * day),
            since + int((at + width) * day), after_departure, anywhere=bool(rng.random() < 0.5),
            paid=bool(rng.random() < 0.7)))
        at += width + uniform(rng, 0.05, 0.3)
    return tuple(breaks)


def _rules(rng: np.random.Generator, longest: int) -> DrivingRules:
    """Draw rules by which no leg has to be interrupted that was begun rested."""
    driving = int(longest * uniform(rng, 1.5, 5.0))
    rest = int(driving * uniform(rng, 0.1, 0.4))
    split = (rest // 3, rest - rest // 3) if rng.random() < 0.6 else ()
    work = int(driving * uniform(rng, 1.2, 2.0)) if rng.random() < 0.3 else UNLIMITED
    return DrivingRules(driving, rest, split, max_work=work)
