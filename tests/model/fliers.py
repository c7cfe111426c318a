"""Tiny problems some of whose vehicles fly by themselves, from hubs that may have little."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from model.judge.hubs import batteries_taken
from model.problem import UNLIMITED, Energy, Problem, VehicleType
from model.solution import Route
from tests.model.tiny import MINUTE, draw_battery
from training.instances import generate


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
            speed_profile=None, max_travel_duration=None, endurance=endurance,
            launch_duration=int(rng.integers(3)) * MINUTE,
            recovery_duration=int(rng.integers(3)) * MINUTE, energy=battery())

    return replace(problem, vehicle_types=tuple(map(flying, problem.vehicle_types)))


def from_few_batteries(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of several trips in the air, for which hubs have too few batteries."""
    problem = from_few_hubs(rng, problem)
    return replace(problem, depots=tuple(replace(depot, chargers=None)
                                         for depot in problem.depots))


def with_hubs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem whose depots have few batteries, or places to charge, for who flies."""
    def few(most: int) -> int | None:
        return int(rng.integers(0, most)) if rng.random() < 0.8 else None

    return replace(problem, depots=tuple(
        replace(depot, batteries=few(3), chargers=few(2)) if depot.kind == "depot" else depot
        for depot in problem.depots))


def from_few_hubs(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of several trips in the air, for which hubs have too little."""
    problem = with_hubs(rng, with_fliers(rng, problem, 0.9))
    return replace(problem, vehicle_types=tuple(
        replace(kind, max_trips=int(rng.integers(1, 4)), earliest=0, latest=UNLIMITED)
        for kind in problem.vehicle_types), customers=tuple(
            replace(customer, served_by="either") for customer in problem.customers))


def without_taken(problem: Problem, routes: Sequence[Route]) -> Problem:
    """Return a problem whose depots have the batteries that some routes leave.

    It is the same one wherever as many are left: what is known of it is known already.
    """
    if not routes or all(depot.batteries is None for depot in problem.depots):
        return problem
    taken = batteries_taken(problem, routes)
    return _with_batteries(problem, tuple(
        None if depot.batteries is None else depot.batteries - taken[node]
        for node, depot in enumerate(problem.depots)))


@lru_cache(1000)
def _with_batteries(problem: Problem, left: tuple[int | None, ...]) -> Problem:
    return replace(problem, depots=tuple(
        replace(depot, batteries=batteries)
        for depot, batteries in zip(problem.depots, left, strict=True)))


def from_hubs(rng: np.random.Generator, customers: int, batteries: int) -> Problem:
    """Return a day of drones that fly trips of a few customers each from a depot."""
    problem = generate(rng, customers, "multitrip")
    few = 4 * max(customer.demand[0] for customer in problem.customers)
    return replace(
        problem, depots=tuple(replace(depot, batteries=batteries) for depot in problem.depots),
        customers=tuple(replace(customer, served_by="either") for customer in problem.customers),
        vehicle_types=tuple(replace(
            kind, flies=True, drones=None, more_drones=(), speed_profile=None, count=12,
            capacity=(few, *kind.capacity[1:]), max_trips=4) for kind in problem.vehicle_types))


def charging(problem: Problem, chargers: int) -> Problem:
    """Return a problem whose drones are charged between trips, a few of them."""
    power = (1000, 1000)
    energy = Energy(10**12, 1.0, (0, 2000), power, power, power, power, charge=1000)
    return replace(
        problem, depots=tuple(replace(depot, batteries=None, chargers=chargers)
                              for depot in problem.depots),
        vehicle_types=tuple(replace(kind, energy=energy) for kind in problem.vehicle_types))
