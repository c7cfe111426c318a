"""Tiny problems some of whose customers are ends of shipments."""

from dataclasses import replace

import numpy as np

from model.problem import Customer, Part, Problem, Shipment
from tests.model.tiny import MINUTE


def _limit(rng: np.random.Generator, least: int, most: int, unit: int) -> int | None:
    return int(rng.integers(least, most + 1)) * unit if rng.random() < 0.3 else None


def with_shipments(rng: np.random.Generator, problem: Problem, most: int = 3) -> Problem:
    """Return a problem some of whose customers are ends of shipments, up to so many; to come last.

    What some vehicles load is a stack.
    """
    chosen = rng.permutation(problem.num_customers).tolist()
    number = int(rng.integers(1, min(most, problem.num_customers // 2) + 1))
    customers, shipments = list(problem.customers), list[Shipment]()
    for index in range(number):
        ends = chosen[2 * index], chosen[2 * index + 1]
        for end, place in enumerate(ends):
            customer, nothing = customers[place], (0,) * problem.num_dimensions
            customers[place] = replace(
                customer, demand=nothing, pickup=(), release_time=0, max_time_aboard=None,
                goods=customers[ends[0]].goods,
                served_by="truck" if customer.served_by == "drone" else customer.served_by,
                unassigned_cost=0.0 if end else customer.unassigned_cost)
        pickup, delivery = (problem.num_depots + place for place in ends)
        amount = tuple(rng.integers(0, 4, problem.num_dimensions).tolist())
        shipments.append(Shipment(
            str(index), pickup, delivery, amount,
            _limit(rng, 3, 25, MINUTE), _limit(rng, 1, 4, 1000)))
    _gather(chosen, problem.num_depots, customers, shipments)
    kinds = tuple(replace(kind, lifo=bool(rng.random() < 0.3)) for kind in problem.vehicle_types)
    taken = {node for each in shipments for node in each.nodes}
    return replace(
        problem, customers=tuple(customers), shipments=tuple(shipments), vehicle_types=kinds,
        relations=tuple(each for each in problem.relations if taken.isdisjoint(each.nodes)))


def _gather(chosen: list[int], num_depots: int, customers: list[Customer],
            shipments: list[Shipment]) -> None:
    """Let who is left, two at most, be further pickups of the first shipment. In place."""
    rng = np.random.default_rng(chosen)
    left = chosen[2 * len(shipments):][:int(rng.integers(0, 3))]
    first = shipments[0]
    nothing = (0,) * len(first.amount)
    ends = [node - num_depots for node in first.nodes] if left else []
    for place in ends:
        customers[place] = replace(customers[place], served_by="truck")
    for place in left:
        customers[place] = replace(
            customers[place], demand=nothing, pickup=(), release_time=0, max_time_aboard=None,
            goods=customers[first.pickup - num_depots].goods, served_by="truck",
            unassigned_cost=0.0)
    shipments[0] = replace(first, more=tuple(
        Part(num_depots + place, tuple(rng.integers(0, 3, len(first.amount)).tolist()))
        for place in left))


def with_flown_shipments(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of shipments that drones may fetch and deliver, most of which can."""
    problem = with_shipments(rng, problem, 2)
    return _flown(replace(problem, shipments=tuple(replace(each, more=())
                                                   for each in problem.shipments)))


def with_flown_parts(rng: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem of one shipment in two or three parts that drones may fetch and deliver.

    One of fewer than three customers has whatever shipments there are.
    """
    drawn = with_shipments(rng, problem, 1)
    for _ in range(20):
        if problem.num_customers < 3 or drawn.shipments[0].more:
            break
        drawn = with_shipments(rng, problem, 1)
    return _flown(drawn)


def _flown(problem: Problem) -> Problem:
    ends = problem.shipment_at.keys()
    kinds = tuple(replace(kind, lifo=False, max_stops=None, capacity=tuple(
        2 * amount + 3 for amount in kind.capacity), drones=kind.drones and replace(
            kind.drones, endurance=60 * MINUTE)) for kind in problem.vehicle_types)
    customers = [
        replace(customer, served_by="either", latest=60 * MINUTE, skills=frozenset())
        if problem.num_depots + place in ends else customer
        for place, customer in enumerate(problem.customers)]
    return replace(problem, customers=tuple(customers), vehicle_types=kinds)
