"""Shipments: both ends on one trip, pickup first, and how long the parcel is under way."""

from collections.abc import Iterator, Sequence
from operator import add

from model.problem import Problem, VehicleType
from model.solution import Trip

BEFORE_ALL = -2
BEFORE_DRONES = -1
"""In place of an instant at a stop: a truck delivers, and picks up for drones launched there."""


def change_aboard(problem: Problem, node: int) -> tuple[int, ...] | None:
    """Return by how much a stop at a shipment's end changes what is aboard; None elsewhere."""
    each = problem.shipment_at.get(node)
    return None if each is None else each.change_at(node)


def fetched_before(problem: Problem, nodes: Sequence[int]) -> set[int]:
    """Return the deliveries, on a flight to these nodes, of what it has fetched itself."""
    within = set[int]()
    for index, node in enumerate(nodes):
        each = problem.shipment_at.get(node)
        if each is not None and node == each.delivery and (
                set(each.pickups).issubset(nodes[:index])):
            within.add(node)
    return within


def brought_within(problem: Problem, nodes: Sequence[int]) -> set[int]:
    """Return the deliveries of what a drone has fetched before on the same sortie, to these nodes.

    None of what is fetched in parts, all of which come aboard the truck.
    """
    return {node for node in fetched_before(problem, nodes) if not problem.shipment_at[node].more}


def flown_out(problem: Problem, node: int) -> tuple[int, ...]:
    """Return what a truck's drone brings to a customer, from aboard its truck."""
    each, demand = problem.shipment_at.get(node), problem.customer_at(node).demand
    if each is None or node != each.delivery:
        return demand
    return tuple(map(add, each.total, demand))


def flown_back(problem: Problem, node: int) -> tuple[int, ...]:
    """Return what a truck's drone takes along from a customer."""
    each = problem.shipment_at.get(node)
    return each.change_at(node) if each is not None and node != each.delivery else (
        problem.customer_at(node).taken_in)


def hands_over(problem: Problem, node: int, nodes: Sequence[int]) -> bool:
    """Tell whether a drone launched at a stop brings what its truck picks up there, to `nodes`."""
    each = problem.shipment_at.get(node)
    return each is not None and node != each.delivery and each.delivery in nodes


def parted(problem: Problem, trip: Trip) -> Iterator[tuple[str, str]]:
    """Yield whoever serves an end of a shipment whose others aren't where they should be, and why.

    As part of a path. A parcel is aboard its truck once that has picked it up at a stop, or has
    recovered the drone that did; it is so before the truck comes to the stop where it delivers it,
    or before it launches the drone that does. Both ends may be served on one sortie, if there are
    two.
    """
    within = {node for sortie in trip.sorties for node in brought_within(problem, sortie.nodes)}
    position = dict[int, tuple[str, tuple[int, int]]]()
    for index, stop in trip.numbered_stops:
        each = problem.shipment_at.get(stop.node)
        delivers = each is not None and stop.node == each.delivery
        position[stop.node] = f".stops[{index}]", (index, BEFORE_ALL if delivers else BEFORE_DRONES)
    position |= _flown_ends(problem, trip)
    driven = {stop.node for stop in trip.customer_stops}
    for node, (where, counts) in position.items():
        each = problem.shipment_at.get(node)
        if each is None:
            continue
        others = each.pickups if node == each.delivery else (each.delivery,)
        if not position.keys() >= {*others}:
            yield where, f"the other end of shipment {each.id} isn't on this trip"
        elif node == each.delivery and node not in within and (
                max(position[other][1] for other in others) > counts):
            yield where, (f"shipment {each.id} is delivered before it is picked up"
                          if driven.issuperset((node, *others)) else
                          f"shipment {each.id} isn't aboard as its truck comes to where it leaves")


def _flown_ends(problem: Problem,
                trip: Trip) -> Iterator[tuple[int, tuple[str, tuple[int, int]]]]:
    """Yield ends of shipments that drones visit, as part of a path, and from when they count.

    That is the stop and the instant at which the drone of a pickup is recovered, or that of a
    delivery takes off; what a delivery's own sortie fetches afterwards is never there before.
    """
    for index, sortie in enumerate(trip.sorties):
        for number, visit in enumerate(sortie.visits):
            each = problem.shipment_at.get(visit.node)
            if each is None:
                continue
            counts = sortie.recovery_stop, sortie.recovery_time
            if visit.node == each.delivery:
                fetches = not {*each.pickups}.isdisjoint(sortie.nodes)
                counts = sortie.launch_stop, BEFORE_ALL if fetches else sortie.launch_time
            yield visit.node, (f".sorties[{index}].visits[{number}]", counts)


def times_between(problem: Problem, kind: VehicleType,
                  trip: Trip) -> Iterator[tuple[str, str, int]]:
    """Yield deliveries, as part of a path, of which shipment, and how much too long it was aboard.

    From the end of service at its pickup, or any, to the start of service; at most 0 if it wasn't.
    """
    if not problem.limits_time_between:
        return
    duration = problem.travel[kind.travel].duration
    left: dict[int, int] = {}  # by pickup
    served = []
    for index, stop in trip.numbered_stops:
        each = problem.shipment_at.get(stop.node)
        if each is not None and stop.node != each.delivery:
            service = kind.service_at(problem.customer_at(stop.node))
            left[stop.node] = stop.service_start + service
        served.append((f".stops[{index}]", stop.node, stop.service_start))
    for index, sortie in enumerate(trip.sorties):
        for number, visit in enumerate(sortie.visits):
            each = problem.shipment_at.get(visit.node)
            if each is not None and visit.node != each.delivery:
                left[visit.node] = visit.departure
            served.append((f".sorties[{index}].visits[{number}]", visit.node, visit.service_start))
    for where, node, start in served:
        each = problem.shipment_at.get(node)
        if each is None or node != each.delivery:
            continue
        excess = [start - left[pickup] - limit for pickup in each.pickups if pickup in left
                  and (limit := each.longest_between(duration.item(pickup, node))) is not None]
        if excess:
            yield where, each.id, max(excess)
