"""Vehicles, prices and the final assembly of random instances."""

import math
from dataclasses import dataclass, replace

import numpy as np

from model.problem import (
    FULL_SPEED,
    MM_PER_KM,
    MS_PER_HOUR,
    UNLIMITED,
    Customer,
    Depot,
    DroneType,
    IntArray,
    Problem,
    SpeedProfile,
    Travel,
    VehicleType,
)
from training.ground import Square, integer, log_uniform, uniform
from training.orders import SKILLS, Orders, Reach


@dataclass(frozen=True)
class Prices:
    """Costs of a vehicle."""

    fixed: float
    per_km: float
    per_hour: float


def draw_prices(rng: np.random.Generator, ground: Square, fixed: float, distance: float,
                time: float) -> Prices:
    """Draw costs of which each is charged with its probability, distance if neither it nor time.

    Driving one side costs 0.01 to 1000, log-uniform, and 0.3 to 3 times as much by time as by
    distance; using a vehicle costs 0.2 to 5 such sides.
    """
    side = log_uniform(rng, 0.01, 1000.0)
    by_time = rng.random() < time
    by_distance = rng.random() < distance or not by_time
    return Prices(
        fixed=side * log_uniform(rng, 0.2, 5.0) if rng.random() < fixed else 0.0,
        per_km=side / ground.side_km if by_distance else 0.0,
        per_hour=side * log_uniform(rng, 0.3, 3.0) / ground.crossing_hours if by_time else 0.0)


def capacity_for(demand: IntArray, customers: float) -> tuple[int, ...]:
    """Return the capacity that holds so many mean demands, and at least the largest."""
    room = np.ceil(demand.mean(axis=0) * customers).astype(np.int64)
    return tuple(np.maximum(room, demand.max(axis=0)).tolist())


def num_loads(demand: IntArray, capacity: tuple[int, ...]) -> float:
    """Return how many full loads the demand makes, in its tightest dimension."""
    totals: list[int] = demand.sum(axis=0).tolist()
    return max(total / max(room, 1) for total, room in zip(totals, capacity, strict=True))


def vehicles_needed(ground: Square, orders: Orders, capacity: tuple[int, ...], day: float,
                    trips: int = 1) -> float:
    """Estimate the vehicles needed by load and by time; `day` (ms) may be infinite.

    A load takes one crossing to and fro, and each customer 0.3 besides its service.
    """
    loads = num_loads(orders.demand, capacity)
    legs = ground.crossing * (loads + 0.3 * len(orders.demand))
    return max(loads / trips, (legs + float(orders.service_duration.sum())) / day)


def draw_profile(rng: np.random.Generator, opens: int, closes: int) -> SpeedProfile:
    """Draw 1 to 4 changes within the shift between factors of 0.4 to 1."""
    changes = integer(rng, 1, 4)
    times = opens + (closes - opens) * np.sort(rng.random(changes))
    factors = (FULL_SPEED * (0.4 + 0.6 * rng.random(changes + 1))).astype(np.int64)
    distinct = times.astype(np.int64) + np.arange(changes)
    return SpeedProfile(tuple(distinct.tolist()), tuple(factors.tolist()))


def draw_drones(rng: np.random.Generator, ground: Square, travel: int, orders: Orders,
                prices: Prices) -> DroneType:
    """Draw the 1 or 2 drones of a truck.

    Payload: the demand that 50 to 95 % of the customers stay below. Endurance: none, or 0.3 to 3
    crossings, waiting included four times out of five. Launch and recovery take up to 0.05
    crossings. A kilometre costs 0.1 to 1 of the truck's; an hour is free or 0.05 to 0.5.
    """
    limited = rng.random() < 0.7
    handling = uniform(rng, 0.0, 0.05) * ground.crossing if rng.random() < 0.7 else 0.0
    service = None
    if rng.random() < 0.3:
        service = int(uniform(rng, 0.2, 1.0) * int(orders.service_duration.min(initial=UNLIMITED)))
    ranked = np.sort(orders.demand, axis=0)
    payload = ranked[int(uniform(rng, 0.5, 0.95) * len(ranked))]
    endurance = int(log_uniform(rng, 0.3, 3.0) * ground.crossing) if limited else UNLIMITED
    return DroneType(
        count=integer(rng, 1, 2), capacity=tuple(payload.tolist()), travel=travel,
        endurance=endurance, endurance_includes_waiting=rng.random() < 0.8,
        launch_duration=int(handling), recovery_duration=int(handling * uniform(rng, 0.5, 1.0)),
        service_duration=service,
        max_customers_per_sortie=1 if rng.random() < 0.6 else integer(rng, 2, 3),
        cost_per_km=prices.per_km * uniform(rng, 0.1, 1.0),
        cost_per_hour=prices.per_hour * uniform(rng, 0.05, 0.5) if rng.random() < 0.3 else 0.0)


def truck_type(name: str, count: int, capacity: tuple[int, ...], prices: Prices,
               travel: int = 0) -> VehicleType:
    """Return a type without rules."""
    return VehicleType(name, count, capacity, travel, fixed_cost=prices.fixed,
                       cost_per_km=prices.per_km, cost_per_hour=prices.per_hour)


def _offered(rng: np.random.Generator, everything: bool) -> frozenset[str]:
    return frozenset(skill for skill in SKILLS if everything or rng.random() < 0.4)


def draw_types(rng: np.random.Generator, ground: Square, orders: Orders, prices: Prices,
               num_types: int, day: float) -> tuple[tuple[VehicleType, ...], tuple[Travel, ...]]:
    """Draw types, of which the first has the largest capacity and every skill.

    The others hold 0.3 to 1 of it (never less than the median demand), at fixed costs that grow
    with the square root of that; kilometres and hours cost 0.6 to 1.2, speeds are equal or 0.6 to
    1.2. Together they are 1.05 to 2 times what is needed in a day (`vehicles_needed`), in random
    parts; three times out of ten there is a vehicle of each type per customer.
    """
    demand = orders.demand
    largest = np.array(capacity_for(demand, uniform(rng, 5, 20)))
    smallest = np.median(demand, axis=0)
    unlimited, varied = rng.random() < 0.3, rng.random() < 0.5
    part = 0.3 + rng.random(num_types)
    parts = (part * (uniform(rng, 1.05, 2.0) / part.sum())).tolist()
    types, travel = [], [ground.road()]
    for index in range(num_types):
        size = uniform(rng, 0.3, 1.0) if index else 1.0
        capacity = tuple(np.maximum(largest * size, smallest).astype(np.int64).tolist())
        count = math.ceil(vehicles_needed(ground, orders, capacity, day) * parts[index])
        if index and varied:
            travel.append(ground.road(uniform(rng, 0.6, 1.2)))
        scale = math.sqrt(size)
        own = Prices(prices.fixed * scale, prices.per_km * uniform(rng, 0.6, 1.2),
                     prices.per_hour * uniform(rng, 0.6, 1.2))
        kind = truck_type(f"type-{index + 1}", len(demand) if unlimited else max(count, 1),
                          capacity, own, len(travel) - 1)
        types.append(replace(kind, skills=_offered(rng, everything=index == 0)))
    return tuple(types), tuple(travel)


def shuffled(rng: np.random.Generator,
             types: tuple[VehicleType, ...]) -> tuple[VehicleType, ...]:
    """Return the types in random order, so that the first is nothing special."""
    return tuple(types[index] for index in rng.permutation(len(types)).tolist())


def with_shift(vehicle_type: VehicleType, reach: Reach, service_duration: IntArray, opens: int,
               length: float) -> tuple[VehicleType, Reach]:
    """Set a shift, made long enough to serve any one customer."""
    needed = int((reach.outbound + reach.inbound + service_duration).max(initial=0))
    closes = opens + max(int(length), math.ceil(1.05 * needed))
    return (replace(vehicle_type, earliest=opens, latest=closes),
            replace(reach, opens=opens, closes=closes))


def with_limits(rng: np.random.Generator, vehicle_type: VehicleType, reach: Reach,
                service_duration: IntArray, ground: Square,
                chances: tuple[float, float]) -> VehicleType:
    """Limit working duration (0.4 to 0.9 of the shift) and trip distance (2 to 6 sides), by chance.

    Neither limit forbids serving any one customer.
    """
    working, trip = None, None
    if rng.random() < chances[0]:
        needed = int((reach.outbound + reach.inbound + service_duration).max(initial=0))
        shift = uniform(rng, 0.4, 0.9) * (reach.closes - reach.opens)
        working = max(int(shift), math.ceil(1.05 * needed))
    if rng.random() < chances[1]:
        start, end = vehicle_type.begins_at, vehicle_type.ends_at
        first = ground.num_depots
        loops = ground.distance[start, first:] + ground.distance[first:, end]
        wanted = int(uniform(rng, 2.0, 6.0) * ground.side)
        trip = max(wanted, math.ceil(1.05 * int(loops.max(initial=0))))
    return replace(vehicle_type, max_working_duration=working, max_trip_distance=trip)


def drawn_unassigned_cost(ground: Square, customers: tuple[Customer, ...],
                          vehicle_types: tuple[VehicleType, ...],
                          travel: tuple[Travel, ...]) -> float:
    """Return a cost per unassigned customer above that of any detour.

    Ten times a dearest vehicle that makes the longest leg twice and the longest service, its
    drone the longest flight twice, and half a shift (5 crossings if it has no end) of the dearest
    lateness and earliness.
    """
    service = max((customer.service_duration for customer in customers), default=0)
    span = [leg.duration[:].max().item() for leg in travel]
    length = [leg.distance[:].max().item() / MM_PER_KM for leg in travel]
    dearest = 0.0
    for kind in vehicle_types:
        cost = (kind.fixed_cost + 2 * length[kind.travel] * kind.cost_per_km
                + (2 * span[kind.travel] + service) / MS_PER_HOUR * kind.cost_per_hour)
        if kind.drones is not None:
            flight = kind.drones.travel
            cost += (2 * length[flight] * kind.drones.cost_per_km
                     + (2 * span[flight] + service) / MS_PER_HOUR * kind.drones.cost_per_hour)
        dearest = max(dearest, cost)
    late = max((customer.late_cost_per_hour or 0.0 for customer in customers), default=0.0)
    early = max((customer.early_cost_per_hour for customer in customers), default=0.0)
    closes = max(kind.latest for kind in vehicle_types)
    shift = closes / MS_PER_HOUR if closes < UNLIMITED else 10 * ground.crossing_hours
    return 10 * dearest + 5 * shift * (late + early)


def assemble(ground: Square, orders: Orders, vehicle_types: tuple[VehicleType, ...],
             travel: tuple[Travel, ...]) -> Problem:
    """Put an instance together."""
    customers = orders.customers()
    depots = tuple(Depot(f"depot-{number}") for number in range(1, ground.num_depots + 1))
    return Problem(depots, customers, vehicle_types, travel, ground.coordinates,
                   drawn_unassigned_cost(ground, customers, vehicle_types, travel))
