"""Tiny problems of trucks alone, whose plans can all be tried."""

import numpy as np

from model.problem import (
    MM_PER_KM, Customer, Depot, DroneType, Problem, Relation, Travel, VehicleType,
)

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


def draw_town(rng: np.random.Generator) -> Problem:
    """Draw a problem of some dozens of customers, half of them in orders, by trucks with drones."""
    number = int(rng.integers(15, 60))
    places = rng.integers(0, 20_000, (number + 1, 2)).astype(np.float64)
    distance = np.rint(np.linalg.norm(places[:, None] - places, axis=2)).astype(np.int64) * 1000
    relations = list[Relation]()
    members = rng.permutation(np.arange(1, number + 1)).tolist()
    while len(members) > 0.5 * number:
        size = int(rng.integers(2, 4))
        nodes, members = tuple(members[:size]), members[size:]
        least = int(rng.integers(0, 60)) * MINUTE
        most = least + int(rng.integers(0, 60)) * MINUTE if rng.random() < 0.5 else None
        relations.append(Relation("before", nodes, "vehicle", least, most,
                                  across=bool(rng.random() < 0.8)))
    bound = {node for each in relations if each.across for node in each.nodes}

    def customer(node: int) -> Customer:
        earliest = int(rng.integers(0, 300)) * MINUTE
        return Customer(str(node), demand=(1,), service_duration=5 * MINUTE, earliest=earliest,
                        latest=earliest + int(rng.integers(60, 300)) * MINUTE,
                        served_by="truck" if node in bound else "either")

    drones = DroneType(count=1, capacity=(1,), travel=1, endurance=40 * MINUTE, cost_per_km=0.2)
    return Problem(
        depots=(Depot("depot"),), customers=tuple(map(customer, range(1, number + 1))),
        vehicle_types=(VehicleType(
            "truck", count=max(2, number // 6), capacity=(8,), travel=0, fixed_cost=10.0,
            cost_per_km=1.0, cost_per_hour=float(rng.choice((0, 20))), latest=600 * MINUTE,
            max_trips=int(rng.integers(1, 3)), drones=drones),),
        travel=(Travel(distance * 12 // 100, distance), Travel(distance * 6 // 100, distance)),
        coordinates=places, unassigned_cost=500.0, relations=tuple(relations))
