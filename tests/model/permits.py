"""Tiny problems with what permits ask of drones; every time is a whole number of minutes."""

from dataclasses import replace
from typing import TypeVar

import numpy as np

from model.problem import (
    MM_PER_KM, UNLIMITED, Closings, Customer, Depot, DroneType, Problem, Storms, Travel,
    VehicleType,
)
from tests.model.fliers import with_fliers
from tests.model.tiny import MINUTE, with_drones

Place = TypeVar("Place", Depot, Customer)


def with_ranges(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which most drones may fly no farther than so, straight."""
    place = rng.integers(0, 5, (problem.num_nodes, 2))
    steps = np.abs(place[:, None] - place).max(axis=2).astype(np.int64)
    straight = len(problem.travel)

    def limited(drones: DroneType) -> DroneType:
        if rng.random() < 0.2:
            return drones
        return replace(drones, straight=straight,
                       max_range=int(rng.integers(1, 5)) * MM_PER_KM)

    def by_itself(kind: VehicleType) -> VehicleType:
        if not kind.flies or rng.random() < 0.2:
            return kind
        return replace(kind, straight=straight, max_range=int(rng.integers(2, 5)) * MM_PER_KM)

    return replace(problem, travel=(*problem.travel, Travel(steps * MINUTE, steps * MM_PER_KM)),
                   vehicle_types=tuple(by_itself(with_drones(kind, limited))
                                       for kind in problem.vehicle_types))


def with_few_airborne(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem most of whose trucks wait for drones, or let few of several fly at once."""
    def permitted(kind: VehicleType) -> VehicleType:
        if kind.drones is None:
            return kind
        kind = replace(kind, drones=replace(kind.drones, count=1 + int(rng.integers(3))))
        most = int(rng.integers(1, 3)) if rng.random() < 0.7 else None
        return replace(kind, max_airborne=most, truck_waits=bool(rng.random() < 0.4))

    return replace(problem, vehicle_types=tuple(map(permitted, problem.vehicle_types)))


def with_storms(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem in which most drones don't fly while it storms, some in the end."""
    def storms() -> Storms:
        instants = np.unique(rng.integers(0, 60, 2 * int(rng.integers(1, 4)))).tolist()
        instants = [instant * MINUTE for instant in instants[:len(instants) // 2 * 2]]
        if instants and rng.random() < 0.2:
            instants[-1:] = [UNLIMITED]
        return tuple(zip(instants[::2], instants[1::2], strict=True))

    def grounded(drones: DroneType) -> DroneType:
        return drones if rng.random() < 0.2 else replace(drones, storms=storms())

    def of_kind(kind: VehicleType) -> VehicleType:
        kind = with_drones(kind, grounded)
        return replace(kind, storms=storms()) if kind.flies and rng.random() < 0.8 else kind

    return replace(problem, vehicle_types=tuple(map(of_kind, problem.vehicle_types)))


def with_closings(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem with two zones that hold some places, and are closed to drones at times.

    In some it storms, too.
    """
    def closings() -> Closings:
        found = []
        for zone in (1, 2):
            instants = np.unique(rng.integers(0, 60, 2 * int(rng.integers(1, 4)))).tolist()
            instants = [instant * MINUTE for instant in instants[:len(instants) // 2 * 2]]
            if instants and rng.random() < 0.2:
                instants[-1:] = [UNLIMITED]
            found += [(begin, end, zone) for begin, end in zip(instants[::2], instants[1::2],
                                                               strict=True)]
        return tuple(sorted(found))

    def in_zones(place: Place) -> Place:
        return replace(place, zones=int(rng.integers(4))) if rng.random() < 0.4 else place

    def closed(drones: DroneType) -> DroneType:
        return drones if rng.random() < 0.2 else replace(drones, closings=closings())

    def of_kind(kind: VehicleType) -> VehicleType:
        kind = with_drones(kind, closed)
        return replace(kind, closings=closings()) if kind.flies and rng.random() < 0.8 else kind

    if rng.random() < 0.3:
        problem = with_storms(rng, problem)
    return replace(problem, depots=tuple(map(in_zones, problem.depots)),
                   customers=tuple(map(in_zones, problem.customers)),
                   vehicle_types=tuple(map(of_kind, problem.vehicle_types)))


def fliers_in_closed_zones(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem with vehicles that fly by themselves, and zones that are closed at times."""
    return with_closings(rng, with_fliers(rng, problem))
