"""Shipments: both ends on one trip, pickup first, and how long the parcel is under way."""

from collections.abc import Iterator

from model.problem import Problem, VehicleType
from model.solution import Trip


def change_aboard(problem: Problem, node: int) -> tuple[int, ...] | None:
    """Return by how much a stop at a shipment's end changes what is aboard; None elsewhere."""
    each = problem.shipment_at.get(node)
    if each is None:
        return None
    return each.amount if node == each.pickup else tuple([-amount for amount in each.amount])


def flown_out(problem: Problem, node: int) -> tuple[int, ...]:
    """Return what a truck's drone brings to a customer, from aboard its truck."""
    each = problem.shipment_at.get(node)
    if each is None or node == each.pickup:
        return problem.customer_at(node).demand
    return each.amount


def flown_back(problem: Problem, node: int) -> tuple[int, ...]:
    """Return what a truck's drone takes along from a customer."""
    each = problem.shipment_at.get(node)
    return each.amount if each is not None and node == each.pickup else (
        problem.customer_at(node).taken_in)


def parted(problem: Problem, trip: Trip) -> Iterator[tuple[str, str]]:
    """Yield whoever serves an end of a shipment whose other end isn't where it should be, and why.

    As part of a path. A parcel is aboard its truck from the stop on where that picks it up, or
    recovers the drone that does; it is so as the truck comes to the stop where it delivers it, or
    launches the drone that does.
    """
    position = {stop.node: (f".stops[{index}]", index) for index, stop in trip.numbered_stops}
    position |= _flown_ends(problem, trip)
    driven = {stop.node for stop in trip.customer_stops}
    for node, (where, index) in position.items():
        each = problem.shipment_at.get(node)
        if each is None:
            continue
        other = each.delivery if node == each.pickup else each.pickup
        if other not in position:
            yield where, f"the other end of shipment {each.id} isn't on this trip"
        elif node == each.delivery and position[other][1] >= index:
            yield where, (f"shipment {each.id} is delivered before it is picked up"
                          if driven.issuperset((node, other)) else
                          f"shipment {each.id} isn't aboard as its truck comes to where it leaves")


def _flown_ends(problem: Problem, trip: Trip) -> Iterator[tuple[int, tuple[str, int]]]:
    """Yield ends of shipments that drones visit, as part of a path, and at which stop they count.

    That is where the drone of a pickup is recovered, and where that of a delivery is launched.
    """
    for index, sortie in enumerate(trip.sorties):
        for number, visit in enumerate(sortie.visits):
            each = problem.shipment_at.get(visit.node)
            if each is not None:
                stop = sortie.recovery_stop if visit.node == each.pickup else sortie.launch_stop
                yield visit.node, (f".sorties[{index}].visits[{number}]", stop)


def times_between(problem: Problem, kind: VehicleType,
                  trip: Trip) -> Iterator[tuple[str, str, int]]:
    """Yield deliveries, as part of a path, of which shipment, and how much too long it was aboard.

    From the end of service at its pickup to the start of service; at most 0 if it wasn't.
    """
    if not problem.limits_time_between:
        return
    duration = problem.travel[kind.travel].duration
    left: dict[int, int] = {}  # by delivery
    served = []
    for index, stop in trip.numbered_stops:
        each = problem.shipment_at.get(stop.node)
        if each is not None and stop.node == each.pickup:
            service = kind.service_at(problem.customer_at(stop.node))
            left[each.delivery] = stop.service_start + service
        served.append((f".stops[{index}]", stop.node, stop.service_start))
    for index, sortie in enumerate(trip.sorties):
        for number, visit in enumerate(sortie.visits):
            each = problem.shipment_at.get(visit.node)
            if each is not None and visit.node == each.pickup:
                left[each.delivery] = visit.departure
            served.append((f".sorties[{index}].visits[{number}]", visit.node, visit.service_start))
    for where, node, start in served:
        if node not in left:
            continue
        each = problem.shipment_at[node]
        limit = each.longest_between(duration.item(each.pickup, each.delivery))
        if limit is not None:
            yield where, each.id, start - left[node] - limit
