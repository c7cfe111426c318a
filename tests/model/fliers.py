"""Tiny problems some of whose vehicles fly by themselves."""

from dataclasses import replace

import numpy as np

from model.problem import UNLIMITED, Energy, Problem, VehicleType
from tests.model.tiny import MINUTE, draw_battery


def with_fliers(rng: np.random.Generator, problem: Problem, share: float = 0.7) -> Problem:
    """Return a problem in which a share of the types are drones that fly from depots.

    Some are limited by endurance, some by a battery that is full, or charged, before each trip. All
    takes whole minutes.
    """
    def battery() -> Energy | None:
        if rng.random() < 0.4:
            return None
        energy = draw_battery(rng, problem.num_dimensions)
        # Who waits for a window has to hold it, whatever is aboard.
        energy = replace(energy, hover=tuple(1 + power for power in energy.hover))
        if rng.random() < 0.6:
            return energy
        return replace(energy, charge=1, climb_duration=0, descent_duration=0)

    def flying(kind: VehicleType) -> VehicleType:
        if rng.random() >= share:
            return kind
        endurance = int(rng.integers(3, 26)) * MINUTE if rng.random() < 0.7 else UNLIMITED
        return replace(
            kind, flies=True, travel=1, drones=None, more_drones=(), charge_left=(),
            speed_profile=None, endurance=endurance,
            launch_duration=int(rng.integers(3)) * MINUTE,
            recovery_duration=int(rng.integers(3)) * MINUTE, energy=battery())

    return replace(problem, vehicle_types=tuple(map(flying, problem.vehicle_types)))
