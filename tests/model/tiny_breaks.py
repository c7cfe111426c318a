"""Tiny problems whose drivers have breaks; every time is a whole number of minutes."""

from dataclasses import replace

import numpy as np

from model.problem import Break, Problem, VehicleType
from tests.model.tiny import MINUTE


def _minutes(rng: np.random.Generator, low: int, high: int) -> int:
    return int(rng.integers(low, high + 1)) * MINUTE


def with_breaks(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem most of whose drivers have one to three breaks, one behind the other."""
    def drawn(kind: VehicleType) -> VehicleType:
        breaks, opens = [], _minutes(rng, 0, 8)
        for number in range(int(rng.integers(0, 4))):
            width = _minutes(rng, 0, 8)
            breaks.append(Break(
                str(number), _minutes(rng, 1, 6), opens, opens + width,
                after_departure=bool(rng.random() < 0.3), anywhere=bool(rng.random() < 0.3),
                paid=bool(rng.random() < 0.7)))
            opens += width + _minutes(rng, 0, 6)
        return replace(kind, breaks=tuple(breaks))

    return replace(problem, vehicle_types=tuple(map(drawn, problem.vehicle_types)))
