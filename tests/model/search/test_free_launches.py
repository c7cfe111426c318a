"""The search serves whoever can be served where windows open long after all else is done."""

import numpy as np
import pytest

from model.problem import Customer, DroneType, Problem, VehicleType
from tests.model.search.free_launches import can_serve_all
from tests.model.search.test_optimum import street_problem
from tests.model.simulation.test_held_launches import searched
from tests.seeds import often, seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

MINUTE = 60_000


def late_problem(seed: int) -> Problem:
    """Return a problem of one truck, one drone and three customers.

    Where waiting counts, the truck serves at once and at any time: what it does at a stop while a
    drone that was launched there is in the air is not looked at otherwise.
    """
    rng = np.random.default_rng(seed)
    counts = bool(rng.random() < 0.5)

    def draw(name: str, served_by: str) -> Customer:
        earliest = int(rng.integers(20, 90)) * MINUTE
        service = int(rng.integers(0, 4)) * MINUTE
        if served_by == "truck" and (counts or rng.random() < 0.5):
            return Customer(name, (1000,), service_duration=0 if counts else service,
                            served_by=served_by)
        return Customer(name, (1000,), service_duration=service, earliest=earliest,
                        latest=earliest + int(rng.integers(0, 20)) * MINUTE, served_by=served_by)

    kinds = [("drone", "truck", "drone"), ("drone", "truck", "truck")][int(rng.integers(2))]
    drones = DroneType(1, (9000,), 1, endurance=int(rng.integers(8, 25)) * MINUTE,
                       endurance_includes_waiting=counts, launch_duration=MINUTE,
                       recovery_duration=MINUTE)
    truck = VehicleType("truck", 1, (9000,), 0, cost_per_km=1.0, cost_per_hour=10.0,
                        latest=int(rng.integers(60, 120)) * MINUTE, drones=drones)
    customers = tuple(draw(str(index), kind) for index, kind in enumerate(kinds))
    return street_problem(rng, customers, truck, unassigned_cost=1e6)


def test_whoever_can_be_served_is_served_whenever_launches_may_be() -> None:
    served = impossible = 0
    for seed in seeds(40):
        problem = late_problem(seed)
        # Now and then one search ends where one customer bars the way for another.
        if not all(searched(problem, 1000, chance).unassigned for chance in range(4)):
            served += 1
        else:
            assert not can_serve_all(problem), f"seed {seed}"
            impossible += 1
    assert served > often(10)
    assert impossible > often(5)
