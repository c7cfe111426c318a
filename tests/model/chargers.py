"""Drones of a hub that are charged between trips along a street."""

import numpy as np

from model.problem import Customer, Depot, Energy, Problem, Travel, VehicleType

MINUTE = 60_000

POWER = (1000, 1000)


def charged_street(*customers: Customer, chargers: int | None, minutes: int = 2,
                   count: int = 2, far: tuple[int, ...] = ()) -> Problem:
    """Return a problem of drones for one customer each trip, a minute away unless `far` says.

    Charging takes as long as flying did; a battery lasts for so many minutes in the air. Launches
    and recoveries take a minute.
    """
    energy = Energy(minutes * MINUTE * 1000, 1.0, (0, 2000), POWER, POWER, POWER, POWER,
                    charge=1000)
    kind = VehicleType("drone", count, (1000,), 0, cost_per_km=1.0, flies=True, max_trips=9,
                       launch_duration=MINUTE, recovery_duration=MINUTE, energy=energy)
    away = np.array(far or (1,) * len(customers))
    legs = np.zeros((len(customers) + 1,) * 2, np.int64)
    legs[0, 1:] = legs[1:, 0] = away
    legs[1:, 1:] = (away[:, None] + away) * (1 - np.eye(len(away), dtype=np.int64))
    place = np.array([0, *far] if far else [0, *[1] * len(customers)], np.float64)
    return Problem((Depot("hub", chargers=chargers),), customers, (kind,),
                   (Travel(legs * MINUTE, legs * 1_000_000),), np.stack([place, place], axis=1),
                   1000.0)


def battery_of(kind: VehicleType) -> Energy:
    """Return the battery of a type that has one."""
    assert kind.energy is not None
    return kind.energy


def order(name: str, latest: int = 10_000, released: int = 0) -> Customer:
    """Return an order of one unit, in minutes."""
    return Customer(name, (1000,), release_time=released * MINUTE, latest=latest * MINUTE)
