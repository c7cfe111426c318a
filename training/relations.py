"""Variants with shipments, with several places and prices by vehicle, and with relations.

Each adds its rule to problems of another variant (`GROUNDS`), where some customers become ends of
shipments, other places of others, or are named by relations.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from model.problem import (
    FULL_SPEED, UNLIMITED, Customer, IntArray, Problem, Relation, Shipment, VehicleType,
)
from training.ground import integer, log_uniform, uniform
from training.variants import (
    InstanceConfig, cvrp, drone, hetero, multitrip, soft, vrptw,
)

GROUNDS = (cvrp, vrptw, soft, hetero, multitrip, drone)
"""What the rules are added to; shipments to all but the last, whose drones fetch nothing."""

NEAR = 6
"""Nearest customers among whom those belong together who don't do so by chance."""


def shipments(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Parcels that are fetched at one customer and brought to another on the same trip.

    All, or 30 to 90 %, of the customers are such ends, both anywhere or near each other. In three
    of ten problems parcels are under way for 1.2 to 4 times the direct way at most. Windows, shifts
    and limits leave room for each shipment alone: where they don't, they are wider.
    """
    ground = GROUNDS[integer(rng, 0, len(GROUNDS) - 2)](rng, num_customers, config)
    share = 1.0 if rng.random() < 0.5 else uniform(rng, 0.3, 0.9)
    ends = _pairs(rng, ground, int(share * num_customers / 2))
    longest = rng.random() < 0.3
    customers, made = list(ground.customers), list[Shipment]()
    for number, (pickup, delivery) in enumerate(ends):
        made.append(Shipment(
            str(number), pickup, delivery, ground.customer_at(pickup).demand,
            max_detour=int(1000 * log_uniform(rng, 1.2, 4.0)) if longest else None))
        for node in (pickup, delivery):
            customers[node - ground.num_depots] = replace(
                ground.customer_at(node), demand=(0,) * ground.num_dimensions, release_time=0,
                skills=ground.customer_at(pickup).skills, served_by="truck",
                unassigned_cost=0.0 if node == delivery else None)
    problem = replace(ground, customers=tuple(customers), shipments=tuple(made))
    return _with_room(problem)


def _pairs(rng: np.random.Generator, problem: Problem, number: int) -> list[tuple[int, int]]:
    """Draw disjoint pairs of customers, anywhere or near each other."""
    near, left = rng.random() < 0.4, rng.permutation(problem.num_customers).tolist()
    pairs = []
    for _ in range(number):
        one = left.pop()
        if near:
            legs = problem.travel[0].distance[problem.num_depots + one, problem.num_depots:]
            left.sort(key=lambda other: -int(legs[other]))
            other = left.pop(max(0, len(left) - integer(rng, 1, NEAR)))
        else:
            other = left.pop()
        pairs.append((problem.num_depots + one, problem.num_depots + other))
    return pairs


def _slowest(problem: Problem) -> IntArray:
    """Return the longest that each leg takes a truck of any type, (node, node)."""
    legs = [np.ceil(problem.travel[kind.travel].duration[:] * (FULL_SPEED / min(
        kind.speed_profile.factors if kind.speed_profile else (FULL_SPEED,)))) + 1
        for kind in problem.vehicle_types]
    slowest: IntArray = np.max(legs, axis=0).astype(np.int64)
    return slowest


def _with_room(problem: Problem) -> Problem:
    """Widen windows, shifts and limits so that each shipment can be served alone."""
    legs, customers = _slowest(problem), list(problem.customers)
    opens = max(kind.earliest for kind in problem.vehicle_types)
    last = longest = 0
    first = problem.num_depots
    for each in problem.shipments:
        begins = [kind.begins_at for kind in problem.vehicle_types]
        pickup, delivery = (problem.customer_at(node) for node in (each.pickup, each.delivery))
        out = int(legs[begins, each.pickup].max())
        ready = max(opens + out, pickup.earliest) + pickup.service_duration
        arrival = ready + int(legs[each.pickup, each.delivery])
        if arrival > delivery.latest:
            customers[each.delivery - first] = delivery = _opened(delivery)
        ends = [kind.ends_at for kind in problem.vehicle_types]
        done = max(arrival, delivery.earliest) + delivery.service_duration
        last = max(last, done + int(legs[each.delivery, ends].max()))
        longest = max(longest, *[_trip(problem, kind, each) for kind in problem.vehicle_types])

    def widened(kind: VehicleType) -> VehicleType:
        working, trip = kind.max_working_duration, kind.max_trip_distance
        return replace(
            kind, latest=min(UNLIMITED, max(kind.latest, last)),
            max_working_duration=None if working is None else max(working, last - kind.earliest),
            max_trip_distance=None if trip is None else max(trip, longest))

    return replace(problem, customers=tuple(customers),
                   vehicle_types=tuple(map(widened, problem.vehicle_types)))


def _opened(customer: Customer) -> Customer:
    """Return a customer who is there all day."""
    return replace(customer, earliest=0, latest=UNLIMITED, gaps=(), late_cost_per_hour=None,
                   early_cost_per_hour=0.0)


def _trip(problem: Problem, kind: VehicleType, each: Shipment) -> int:
    """Return how far it is to serve a shipment alone."""
    legs = problem.travel[kind.travel].distance
    return int(legs[kind.begins_at, each.pickup] + legs[each.pickup, each.delivery]
               + legs[each.delivery, kind.ends_at])


def chosen(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Customers with two to four places of which one is used, and prices by vehicle.

    20 to 90 % of the nodes are such places, of the same or of prices of 0.02 to 0.5 direct trips;
    in half of the problems it costs as much by which type 20 to 100 % of the customers are served.
    """
    problem = GROUNDS[integer(rng, 0, len(GROUNDS) - 1)](rng, num_customers, config)
    costs = np.zeros((len(problem.vehicle_types), num_customers))
    most = problem.unassigned_cost / 10 * log_uniform(rng, 0.02, 0.5)
    has_places, has_prices = rng.random() < 0.7, rng.random() < 0.5
    if has_prices or not has_places:
        costs += most * rng.random(costs.shape) * (rng.random(costs.shape) < uniform(rng, 0.2, 1))
    if has_places:
        problem = _with_places(rng, problem)
        if rng.random() < 0.5:
            others = [node - problem.num_depots for places in problem.choices
                      for node in places[1:]]
            costs[:, others] += most * rng.random(len(others))
    return replace(problem, vehicle_costs=costs if costs.any() else None)


def _with_places(rng: np.random.Generator, problem: Problem) -> Problem:
    """Let some customers be other places of others."""
    free = [node for node in range(problem.num_depots, problem.num_nodes)
            if problem.customer_at(node).served_by != "drone"]
    left, customers = rng.permutation(free).tolist(), list(problem.customers)
    wanted = len(left) * (1 - uniform(rng, 0.2, 0.9))
    choices = list[tuple[int, ...]]()
    while len(left) > max(wanted, 3):
        size = integer(rng, 2, 4)
        places, left = tuple(left[:size]), left[size:]
        choices.append(places)
        own = problem.customer_at(places[0])
        for node in places[1:]:
            customers[node - problem.num_depots] = replace(
                problem.customer_at(node), demand=own.demand, pickup=own.pickup, goods=own.goods,
                release_time=0, skills=own.skills, served_by=own.served_by, unassigned_cost=0.0)
        customers[places[0] - problem.num_depots] = replace(own, release_time=0)
    return replace(problem, customers=tuple(customers), choices=tuple(choices))


def related(rng: np.random.Generator, num_customers: int, config: InstanceConfig) -> Problem:
    """Customers who go together, apart, or one before another.

    One relation for each 4 to 16 customers, of two to four each, anywhere or near each other; on
    one trip, or by one vehicle. Lags are 0, or up to the time that a mean leg takes, and at most 1
    to 6 such times more in a third of the problems.
    """
    problem = GROUNDS[integer(rng, 0, len(GROUNDS) - 1)](rng, num_customers, config)
    if num_customers < 2:
        return problem
    leg = float(problem.travel[0].duration[:].mean())
    has_lags, is_short = rng.random() < 0.5, rng.random() < 0.33
    relations = []
    for _ in range(min(60, 1 + int(num_customers / uniform(rng, 4, 16)))):
        nodes = _some(rng, problem, integer(rng, 2, min(4, num_customers)))
        scope: Literal["trip", "vehicle"] = "trip" if rng.random() < 0.4 else "vehicle"
        kind = rng.random()
        if kind < 0.4:
            relations.append(Relation("together", nodes, scope))
        elif kind < 0.65:
            relations.append(Relation("apart", nodes, scope))
        else:
            least = int(leg * rng.random()) if has_lags else 0
            most = least + int(leg * uniform(rng, 1, 6)) if is_short else None
            relations.append(Relation("before", nodes[:3], scope, least, most))
    return replace(problem, relations=tuple(relations))


def _some(rng: np.random.Generator, problem: Problem, number: int) -> tuple[int, ...]:
    """Draw customers, anywhere or near one another."""
    first = problem.num_depots
    nodes: IntArray = rng.permutation(problem.num_customers)[:number]
    if rng.random() < 0.5:
        legs = problem.travel[0].distance[first + int(nodes[0]), first:]
        nodes = rng.permutation(np.argsort(legs, kind="stable")[:number])
    return tuple((first + nodes).tolist())
