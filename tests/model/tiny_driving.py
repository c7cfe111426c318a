"""Tiny problems whose drivers have to rest; every time is a whole number of minutes."""

from dataclasses import replace

import numpy as np

from model.problem import UNLIMITED, DrivingRules, Problem, VehicleType
from tests.model.tiny import MINUTE


def drawn_rules(rng: np.random.Generator) -> DrivingRules:
    """Draw rules that trips of some minutes are long by."""
    def minutes(low: int, high: int) -> int:
        return int(rng.integers(low, high + 1)) * MINUTE

    first, second = minutes(1, 3), minutes(1, 4)
    driving = minutes(4, 14)
    split = (first, second) if rng.random() < 0.5 else ()
    return DrivingRules(
        driving, minutes(1, 6), split,
        driving + minutes(4, 30) if rng.random() < 0.5 else UNLIMITED,
        minutes(8, 25) if rng.random() < 0.4 else UNLIMITED,
        minutes(0, 4) if rng.random() < 0.3 else 0, minutes(0, 4) if rng.random() < 0.3 else 0,
        other_work_interrupts=not split and driving % (2 * MINUTE) == 0,
        half_rested_before=bool(split) and first % (2 * MINUTE) == 0,
        while_drones_fly=bool(rng.random() < 0.7))


def with_driving(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem most of whose drivers have to rest, where they may."""
    def drawn(kind: VehicleType) -> VehicleType:
        rules = drawn_rules(rng) if rng.random() < 0.8 else None
        if kind.flies:
            return kind
        travel = int(rng.integers(8, 40)) * MINUTE if rng.random() < 0.3 else None
        return replace(kind, driving=rules, max_travel_duration=travel)

    return replace(problem, vehicle_types=tuple(map(drawn, problem.vehicle_types)))
