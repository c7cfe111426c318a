"""Shipments aboard vehicles that break down: others bring from a depot what these have fetched.

What is left of such a shipment is a customer to whom its parcel is delivered; where it was fetched
was a customer who gave it along. So it is judged, planned and priced as customers are. If some of
several parts are yet to be fetched, these are a shipment, with which the parcel is delivered.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from model.judge.past import known_trips
from model.problem import Customer, Problem, Relation, Shipment
from model.solution import Solution, Vehicle


@dataclass(frozen=True)
class Parting:
    """What vehicles that break down have aboard of a shipment."""

    shipment: Shipment
    fetched: frozenset[int]  # pickups
    vehicle: Vehicle  # that has it, or the last part of it

    @property
    def left(self) -> tuple[int, ...]:
        """The ends that are yet to be served, that of the delivery last."""
        return tuple([node for node in self.shipment.nodes if node not in self.fetched])

    @property
    def rest(self) -> Shipment | None:
        """What is yet to be fetched; None if nothing is."""
        parts = [part for part in self.shipment.parts if part.pickup not in self.fetched]
        if not parts:
            return None
        first, *more = parts
        return replace(self.shipment, pickup=first.pickup, amount=first.amount, more=tuple(more))


def parted_shipments(problem: Problem, plan: Solution, now: int,
                     unavailable: frozenset[Vehicle]) -> list[Parting]:
    """Return what vehicles have aboard of shipments that break down."""
    if not problem.shipments:
        return []
    routes = tuple(route for route in plan.routes
                   if route.driven_by in unavailable)
    served: dict[int, Vehicle] = {}
    for vehicle, trips in known_trips(problem, Solution(routes), now, unavailable).items():
        served |= dict.fromkeys(frozenset[int]().union(*(trip.served for trip in trips)), vehicle)
    found = []
    for shipment in problem.shipments:
        fetched = [node for node in shipment.pickups if node in served]
        if fetched and shipment.delivery not in served:
            found.append(Parting(shipment, frozenset(fetched), served[fetched[-1]]))
    return found


def with_parted(problem: Problem, parted: list[Parting]) -> Problem:
    """Return the problem in which shipments are parcels that were taken in, and are delivered."""
    if not parted:
        return problem
    customers = [*problem.customers]
    for each in parted:
        for node in each.shipment.nodes:
            index = node - problem.num_depots
            customers[index] = _parted_at(problem, each, node)
    rests = {each.shipment: each.rest for each in parted}
    shipments = [rests.get(each, each) for each in problem.shipments]
    left = {node: each.left for each in parted for node in each.fetched}
    return replace(
        problem, customers=tuple(customers),
        shipments=tuple([each for each in shipments if each is not None]),
        relations=tuple([rest for each in problem.relations
                         if (rest := _left_of(problem, each, left)) is not None]))


def _parted_at(problem: Problem, parting: Parting, node: int) -> Customer:
    """Return who is at an end of a shipment that is parted.

    For whoever is yet to be served first it costs something to be left out.
    """
    shipment, customer = parting.shipment, problem.customer_at(node)
    if node in parting.fetched:
        return replace(customer, pickup=shipment.change_at(node), unassigned_cost=0.0)
    if node == parting.left[0]:
        cost = problem.customer_at(shipment.pickup).unassigned_cost
        customer = replace(customer, unassigned_cost=cost)
    if node == shipment.delivery:
        amounts = [part.amount for part in shipment.parts if part.pickup in parting.fetched]
        customer = replace(customer, demand=tuple(map(sum, zip(*amounts, strict=True))))
    return customer


def _left_of(problem: Problem, relation: Relation,
             left: Mapping[int, tuple[int, ...]]) -> Relation | None:
    """Return what a relation says of shipments that are yet to be delivered; None if nothing.

    `left` are the ends that are yet to be served, by those where something was fetched. Who goes
    with a shipment, or doesn't, is to do so with whoever delivers it. In an order an end is served
    when it was, but a vehicle that fetched something isn't asked to deliver it.
    """
    if relation.kind != "before":
        nodes = tuple(dict.fromkeys([left.get(node, (node,))[0] for node in relation.nodes]))
        return replace(relation, nodes=nodes) if len(nodes) > 1 else None
    stay = {node: node for node in relation.nodes
            if not {*left.get(node, ())}.intersection(relation.nodes)}
    return relation.among(stay, problem.first_place)
