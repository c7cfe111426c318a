"""Customers of random instances, as columns until the last step."""

from dataclasses import dataclass, replace

import numpy as np

from model.problem import (
    FULL_SPEED,
    UNLIMITED,
    BoolArray,
    Customer,
    DroneType,
    FloatArray,
    IntArray,
    ServedBy,
    Travel,
    VehicleType,
)
from training.ground import Square, integer, log_uniform, uniform

SERVED_BY: tuple[ServedBy, ...] = ("either", "truck", "drone")
EITHER, TRUCK, DRONE = range(3)

SKILLS = ("cooling", "crane")
SKILL_SETS = (frozenset[str](), frozenset(SKILLS[:1]), frozenset(SKILLS[1:]), frozenset(SKILLS),
              frozenset({"nowhere"}))
"""What a customer may ask for; no vehicle offers the last, `UNOFFERED`."""

UNOFFERED = 4

DEMANDS = ((1, 9), (1, 9), (1, 1), (1, 100), (50, 100), (5, 40))
"""Ranges of integer demands, in whole units of the instance."""


@dataclass(frozen=True, eq=False)
class Orders:
    """One array per field of `Customer`, in its units."""

    demand: IntArray  # (customer, dimension)
    service_duration: IntArray
    earliest: IntArray
    latest: IntArray
    release_time: IntArray
    late_cost: FloatArray  # per hour, nan: the window is hard
    early_cost: FloatArray  # per hour
    served_by: IntArray  # index into SERVED_BY
    skills: IntArray  # index into SKILL_SETS

    def customers(self) -> tuple[Customer, ...]:
        """Build the customers, named "1" to "n"."""
        columns = zip(self.demand.tolist(), self.service_duration.tolist(),
                      self.earliest.tolist(), self.latest.tolist(), self.late_cost.tolist(),
                      self.early_cost.tolist(), self.served_by.tolist(), self.skills.tolist(),
                      self.release_time.tolist(), strict=True)
        return tuple(
            Customer(str(number), tuple(demand), service, earliest, latest,
                     None if late != late else late, early, SERVED_BY[kind], SKILL_SETS[skills],
                     release)
            for number, (demand, service, earliest, latest, late, early, kind, skills, release)
            in enumerate(columns, start=1))


@dataclass(frozen=True, eq=False)
class Reach:
    """Bounds on serving each customer alone by one vehicle type, slowest hours assumed."""

    opens: int
    closes: int
    outbound: IntArray  # (customer,) ms
    inbound: IntArray  # (customer,) ms


def open_orders(demand: IntArray, service_duration: IntArray) -> Orders:
    """Return orders that anything with room may serve at any time."""
    num_customers = len(demand)
    zeros = np.zeros(num_customers, dtype=np.int64)
    return Orders(demand=demand, service_duration=service_duration, earliest=zeros,
                  latest=np.full(num_customers, UNLIMITED), release_time=zeros,
                  late_cost=np.full(num_customers, np.nan), early_cost=np.zeros(num_customers),
                  served_by=zeros, skills=zeros)


def draw_demand(rng: np.random.Generator, num_customers: int, dimensions: int = 1) -> IntArray:
    """Draw (customer, dimension) demands: a range of `DEMANDS`, times a unit, per dimension."""
    columns = []
    for _ in range(dimensions):
        low, high = DEMANDS[integer(rng, 0, len(DEMANDS) - 1)]
        unit = 1000 if rng.random() < 0.5 else int(log_uniform(rng, 1, 1_000_000))
        columns.append(rng.integers(low, high + 1, size=num_customers) * unit)
    return np.stack(columns, axis=1)


def draw_service(rng: np.random.Generator, num_customers: int, ground: Square) -> IntArray:
    """Draw service durations: none, equal, or spread, up to 0.4 crossings."""
    kind, mean = rng.random(), log_uniform(rng, 0.02, 0.25) * ground.crossing
    if kind < 0.2:
        return np.zeros(num_customers, dtype=np.int64)
    spread = 0.0 if kind < 0.5 else uniform(rng, 0.1, 0.6)
    factor = 1.0 + spread * (2.0 * rng.random(num_customers) - 1.0)
    return (mean * factor).astype(np.int64)


def reach_of(vehicle_type: VehicleType, travel: tuple[Travel, ...], num_depots: int) -> Reach:
    """Bound the legs of a trip, or of a flight, to each customer alone."""
    duration, first, last = (travel[vehicle_type.travel].duration, vehicle_type.begins_at,
                             vehicle_type.ends_at)
    outbound, inbound = duration[first, num_depots:], duration[num_depots:, last]
    profile, drones = vehicle_type.speed_profile, vehicle_type.drones
    if profile is not None:
        slowness = FULL_SPEED / min(profile.factors)
        outbound = np.ceil(outbound * slowness).astype(np.int64) + 1
        inbound = np.ceil(inbound * slowness).astype(np.int64) + 1
    if drones is not None:
        flight = travel[drones.travel].duration
        outbound = np.maximum(outbound, flight[first, num_depots:]) + drones.launch_duration
        inbound = np.maximum(inbound, flight[num_depots:, last]) + drones.recovery_duration
    return Reach(vehicle_type.earliest, vehicle_type.latest, outbound, inbound)


def last_start(orders: Orders, reach: Reach) -> IntArray:
    """Return the last start of service from which the vehicle is home in time."""
    return reach.closes - reach.inbound - orders.service_duration


def with_windows(rng: np.random.Generator, orders: Orders, reach: Reach, share: float,
                 width: tuple[float, float]) -> Orders:
    """Give a share of the customers windows that a vehicle on its own can meet.

    A window opens uniformly between the earliest possible arrival and the last opening from which
    the vehicle still gets home; its width (ms) is uniform. The others are open all day.
    """
    num_customers = len(orders.demand)
    first, last = reach.opens + reach.outbound, last_start(orders, reach)
    widths = np.rint(width[0] + (width[1] - width[0]) * rng.random(num_customers))
    room = np.maximum(last - first - widths, 0.0)
    earliest = first + (room * rng.random(num_customers)).astype(np.int64)
    return _opened(rng, orders, share, earliest, widths.astype(np.int64), last)


def with_appointments(rng: np.random.Generator, orders: Orders, reach: Reach, share: float,
                      start: IntArray, width: float) -> Orders:
    """Give a share of the customers windows of a width (ms) about given times, (customer,).

    They are moved to where a vehicle on its own can meet them. The others are open all day.
    """
    first, last = reach.opens + reach.outbound, last_start(orders, reach)
    earliest = np.clip(start - int(0.5 * width), first, last)
    return _opened(rng, orders, share, earliest, int(width), last)


def _opened(rng: np.random.Generator, orders: Orders, share: float, earliest: IntArray,
            width: IntArray | int, last: IntArray) -> Orders:
    """Open a share of the customers' windows for a width, until the last start at the latest."""
    chosen = rng.random(len(earliest)) < share
    return replace(orders, earliest=np.where(chosen, earliest, 0),
                   latest=np.where(chosen, np.minimum(earliest + width, last), last))


def with_releases(rng: np.random.Generator, orders: Orders, reach: Reach, share: float) -> Orders:
    """Release a share of the parcels in the first 0.7 of the time in which one can still leave."""
    last_departure = np.minimum(orders.latest, last_start(orders, reach)) - reach.outbound
    room = np.maximum(last_departure - reach.opens, 0)
    release = reach.opens + (room * (0.7 * rng.random(len(room)))).astype(np.int64)
    return replace(orders, release_time=np.where(rng.random(len(room)) < share, release, 0))


def with_soft_windows(rng: np.random.Generator, orders: Orders, cost_per_hour: float,
                      share: float) -> Orders:
    """Let a share of the windows be missed at 0.5 to 20 times a cost; half charge for waiting."""
    num_customers = len(orders.demand)
    late = cost_per_hour * log_uniform(rng, 0.5, 20.0)
    early = cost_per_hour * uniform(rng, 0.1, 1.0) if rng.random() < 0.5 else 0.0
    factor = 1.0 + (rng.random(num_customers) if rng.random() < 0.5 else 0.0)
    soft = rng.random(num_customers) < share
    return replace(orders, late_cost=np.where(soft, late * factor, np.nan),
                   early_cost=np.where(soft, early * factor, 0.0))


def with_skills(rng: np.random.Generator, orders: Orders, share: float) -> Orders:
    """Let a share of the customers ask for one or both skills."""
    num_customers = len(orders.demand)
    asked = rng.integers(1, 4, size=num_customers)
    return replace(orders, skills=np.where(rng.random(num_customers) < share, asked, 0))


def reachable_by_drone(orders: Orders, drones: DroneType, flight: Travel,
                       hubs: BoolArray) -> BoolArray:
    """Mark the customers that a drone can serve by a loop from one of the hubs (node,)."""
    num_depots = len(flight.duration) - len(orders.demand)
    there = flight.duration[:]
    loop = there + there.T
    shortest = loop[hubs, num_depots:].min(axis=0) + orders.service_duration
    is_light = np.all(orders.demand <= np.array(drones.capacity), axis=1)
    reachable: BoolArray = np.logical_and(is_light, shortest <= drones.endurance)
    return reachable


def with_modes(rng: np.random.Generator, orders: Orders, vehicle_type: VehicleType,
               flight: Travel, shares: tuple[float, float], depot_only: bool) -> Orders:
    """Reserve shares of the customers for drones and for trucks.

    A customer chosen for drones that no loop reaches, from where the first trip begins or (unless
    `depot_only`) from another customer that a truck may stop at, stays open to either.
    """
    drones = vehicle_type.drones
    if drones is None:
        raise ValueError(f"vehicle type {vehicle_type.id} drones: None is not allowed")
    num_customers = len(orders.demand)
    draw = rng.random(num_customers)
    chosen = draw < shares[0]
    hubs = np.zeros(len(flight.duration), dtype=np.bool_)
    hubs[vehicle_type.begins_at] = True
    if not depot_only:
        hubs[-num_customers:] = ~chosen
    by_drone = chosen & reachable_by_drone(orders, drones, flight, hubs)
    by_truck = (draw >= shares[0]) & (draw < shares[0] + shares[1])
    return replace(orders, served_by=np.where(by_drone, DRONE, np.where(by_truck, TRUCK, EITHER)))
