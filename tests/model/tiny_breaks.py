"""Tiny problems whose drivers have breaks; every time is a whole number of minutes."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from model.problem import UNLIMITED, Break, Customer, Depot, Problem, Travel, VehicleType
from tests.model.tiny import MINUTE


def _minutes(rng: np.random.Generator, low: int, high: int) -> int:
    return int(rng.integers(low, high + 1)) * MINUTE


def short_day(rng: np.random.Generator, resting: Callable[[VehicleType], VehicleType]) -> Problem:
    """Draw two customers with windows, and one truck as `resting` has it: an hour, all told."""
    steps = rng.integers(1, 9, (3, 3)) * MINUTE
    steps = np.minimum(steps, steps.T)
    np.fill_diagonal(steps, 0)
    customers = []
    for index in range(2):
        earliest = int(rng.integers(0, 30))
        latest = earliest + int(rng.integers(0, 15)) if rng.random() < 0.7 else UNLIMITED
        customers.append(Customer(
            str(index), (1,), service_duration=int(rng.integers(0, 4)) * MINUTE,
            earliest=earliest * MINUTE, latest=min(UNLIMITED, latest * MINUTE)))
    truck = resting(VehicleType("truck", 1, (3,), 0, cost_per_km=1.0, cost_per_hour=30.0,
                                latest=60 * MINUTE))
    return Problem((Depot("hub"),), tuple(customers), (truck,), (Travel(steps, steps),),
                   rng.random((3, 2)), unassigned_cost=60.0)


def with_breaks(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem most of whose drivers have one to three breaks, one behind the other."""
    def drawn(kind: VehicleType) -> VehicleType:
        breaks, opens = [], _minutes(rng, 0, 8)
        for number in range(int(rng.integers(0, 4))):
            width = _minutes(rng, 0, 8)
            breaks.append(Break(
                str(number), _minutes(rng, 1, 6), opens, opens + width,
                after_departure=bool(rng.random() < 0.3), anywhere=bool(rng.random() < 0.3),
                paid=bool(rng.random() < 0.7),
                max_load=None if rng.random() < 0.6 else tuple(
                    [int(rng.integers(0, most + 1)) for most in kind.capacity])))
            opens += width + _minutes(rng, 0, 6)
        return replace(kind, breaks=tuple(breaks))

    return replace(problem, vehicle_types=tuple(map(drawn, problem.vehicle_types)))
