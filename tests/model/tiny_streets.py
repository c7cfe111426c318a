"""Tiny problems of trucks alone, whose plans can all be tried."""

import numpy as np

from model.problem import MM_PER_KM, Customer, Depot, Problem, Travel, VehicleType

MINUTE = 60_000


def draw_streets(rng: np.random.Generator) -> Problem:
    """Draw a problem of 3 or 4 customers on a grid, by two or three trucks of one trip each."""
    number = int(rng.integers(3, 5))
    places = rng.integers(0, 6, (number + 1, 2))
    blocks = np.abs(places[:, None] - places).sum(axis=2)
    return Problem(
        depots=(Depot("depot"),),
        customers=tuple([_customer(rng, str(index)) for index in range(number)]),
        vehicle_types=(VehicleType(
            "truck", count=int(rng.integers(2, 4)), capacity=(9,), travel=0,
            fixed_cost=float(rng.integers(0, 6)), cost_per_km=1.0, latest=90 * MINUTE),),
        travel=(Travel(blocks * 2 * MINUTE, blocks * MM_PER_KM),),
        coordinates=places.astype(np.float64), unassigned_cost=30.0)


def _customer(rng: np.random.Generator, name: str) -> Customer:
    earliest = int(rng.integers(0, 30)) * MINUTE
    return Customer(name, demand=(1,), service_duration=int(rng.integers(0, 6)) * MINUTE,
                    earliest=earliest, latest=earliest + int(rng.integers(5, 40)) * MINUTE)
