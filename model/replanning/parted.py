"""Shipments aboard vehicles that break down: others bring from a depot what these have fetched.

What is left of such a shipment is a customer to whom its parcel is delivered; where it was fetched
was a customer who gave it along. So it is judged, planned and priced as customers are.
"""

from collections.abc import Collection
from dataclasses import replace

from model.judge.past import Vehicle, known_trips
from model.problem import Problem, Relation, Shipment
from model.solution import Solution


class PartlyFetchedError(ValueError):
    """A vehicle breaks down with a part of a shipment aboard, and the rest is not fetched yet."""


def parted_shipments(problem: Problem, plan: Solution, now: int,
                     unavailable: frozenset[Vehicle]) -> dict[Shipment, Vehicle]:
    """Return shipments that vehicles have aboard which break down, by whom.

    Raises
    ------
    PartlyFetchedError
        If one was to be fetched at several places, and was so at some of them.
    """
    found: dict[Shipment, Vehicle] = {}
    if not problem.shipments:
        return found
    routes = tuple(route for route in plan.routes
                   if (route.vehicle_type, route.vehicle) in unavailable)
    for vehicle, trips in known_trips(problem, Solution(routes), now, unavailable).items():
        served = frozenset[int]().union(*(trip.served for trip in trips))
        for shipment in problem.shipments:
            fetched = served.intersection(shipment.pickups)
            if not fetched or shipment.delivery in served:
                continue
            if len(fetched) < len(shipment.pickups):
                name = problem.vehicle_types[vehicle.type].vehicle_name(vehicle.number)
                raise PartlyFetchedError(f"{name} has fetched a part of {shipment.id!r}, and not "
                                         "the rest")
            found[shipment] = vehicle
    return found


def with_parted(problem: Problem, parted: Collection[Shipment]) -> Problem:
    """Return the problem in which shipments are parcels that were taken in, and are delivered."""
    if not parted:
        return problem
    customers = [*problem.customers]
    for shipment in parted:
        first = problem.customer_at(shipment.pickup)
        for node in shipment.nodes:
            index, amount = node - problem.num_depots, shipment.change_at(node)
            if node == shipment.delivery:
                customers[index] = replace(
                    customers[index], demand=shipment.total,
                    unassigned_cost=first.unassigned_cost)
            else:
                customers[index] = replace(customers[index], pickup=amount, unassigned_cost=0.0)
    return replace(
        problem, customers=tuple(customers),
        shipments=tuple([each for each in problem.shipments if each not in parted]),
        relations=tuple([left for each in problem.relations
                         if (left := _left_of(problem, each, parted)) is not None]))


def _left_of(problem: Problem, relation: Relation,
             parted: Collection[Shipment]) -> Relation | None:
    """Return what a relation says of shipments that are yet to be delivered; None if nothing.

    Who goes with a shipment, or doesn't, is to do so with whoever delivers it. In an order an end
    is served when it was, but a vehicle that fetched it isn't asked to deliver it.
    """
    delivery = {node: each.delivery for each in parted for node in each.pickups}
    if relation.kind != "before":
        nodes = tuple(dict.fromkeys([delivery.get(node, node) for node in relation.nodes]))
        return replace(relation, nodes=nodes) if len(nodes) > 1 else None
    stay = {node: node for node in relation.nodes if delivery.get(node) not in relation.nodes}
    return relation.among(stay, problem.first_place)
