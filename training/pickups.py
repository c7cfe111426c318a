"""The variant whose customers have something to be picked up, and how such amounts are drawn."""

from dataclasses import replace

import numpy as np

from model.problem import BoolArray, Depot, IntArray, Problem
from model.travel.matrices import with_nowhere
from training.fleets import (
    assemble,
    capacity_for,
    draw_prices,
    truck_type,
    with_limits,
    with_shift,
)
from training.ground import log_uniform, uniform
from training.orders import draw_demand, draw_service, open_orders, reach_of, with_windows
from training.variants import InstanceConfig, draw_ground


def pickups(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Amounts to deliver and to pick up, one vehicle per customer, distance only.

    Half of the instances have both at each customer, the others one of both; in half of those,
    pickups come last on a trip. Capacity for 5 to 20 customers. Routes are open in three of ten,
    trips limited (`fleets.with_limits`) in three; hard windows of 0.2 to 2 crossings in three; in
    two of ten, what is aboard costs up to twice as much as driving, where the vehicle is full.
    """
    ground = draw_ground(rng, num_customers, config)
    amounts = draw_demand(rng, num_customers)
    delivered, taken, is_last = _both_ways(rng, amounts)
    orders = open_orders(delivered, draw_service(rng, num_customers, ground))
    prices = draw_prices(rng, ground, fixed=0.0, distance=1.0, time=0.0)
    truck = replace(
        truck_type("truck", num_customers, capacity_for(amounts, uniform(rng, 5, 20)), prices),
        pickups="last" if is_last else "any")
    if rng.random() < 0.2:
        per_load = prices.per_km * uniform(rng, 0.1, 2.0) * 1000 / truck.capacity[0]
        truck = replace(truck, cost_per_load_km=per_load)
    travel = (ground.road(),)
    reach = reach_of(truck, travel, 1)
    if rng.random() < 0.3:
        truck, reach = with_shift(truck, reach, orders.service_duration, 0,
                                  uniform(rng, 2.5, 8.0) * ground.crossing)
        width = log_uniform(rng, 0.2, 2.0) * ground.crossing
        orders = with_windows(rng, orders, reach, uniform(rng, 0.3, 1.0), (0.5 * width, width))
    truck = with_limits(rng, truck, reach, orders.service_duration, ground, (0.0, 0.3))
    problem = with_pickups(assemble(ground, orders, (truck,), travel), taken)
    return with_open_ends(problem, np.array([True])) if rng.random() < 0.3 else problem


def _both_ways(rng: np.random.Generator, amounts: IntArray) -> tuple[IntArray, IntArray, bool]:
    """Return what is delivered, what is picked up, and whether the latter comes last on a trip."""
    num_customers, kind = len(amounts), rng.random()
    if kind < 0.25:
        taken = (amounts * rng.random((num_customers, 1))).astype(np.int64)
        return amounts - taken, taken, False
    if kind < 0.5:
        return amounts, rng.permutation(amounts), False
    takes = rng.random((num_customers, 1)) < uniform(rng, 0.2, 0.5)
    takes[0] = False  # Where pickups come last, somebody has to come first.
    return np.where(takes, 0, amounts), np.where(takes, amounts, 0), kind < 0.75


def with_pickups(problem: Problem, taken: IntArray) -> Problem:
    """Return a problem in which so much, (customer, dimension), is picked up."""
    customers = tuple([replace(customer, pickup=tuple(amounts)) if any(amounts) else customer
                       for customer, amounts
                       in zip(problem.customers, taken.tolist(), strict=True)])
    return replace(problem, customers=customers)


def with_open_ends(problem: Problem, is_open: BoolArray) -> Problem:
    """Return a problem in which some types' last trips, (type,), end with their last customer."""
    nowhere = problem.num_depots
    flown = {kind.drones.travel for kind in problem.vehicle_types if kind.drones is not None}
    kinds = tuple([replace(kind, end=nowhere) if ends else kind for kind, ends
                   in zip(problem.vehicle_types, is_open.tolist(), strict=True)])
    return replace(
        problem, depots=(*problem.depots, Depot("nowhere", "nowhere")), vehicle_types=kinds,
        travel=tuple([with_nowhere(legs, nowhere, index in flown)
                      for index, legs in enumerate(problem.travel)]),
        coordinates=np.insert(problem.coordinates, nowhere, problem.coordinates.mean(axis=0),
                              axis=0))
