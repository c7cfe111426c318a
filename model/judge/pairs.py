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


def parted(problem: Problem, trip: Trip) -> Iterator[tuple[int, str]]:
    """Yield the stops, by index, of shipments whose other end isn't where it should be, and why."""
    position = {stop.node: index for index, stop in trip.numbered_stops}
    for node, index in position.items():
        each = problem.shipment_at.get(node)
        if each is None:
            continue
        other = position.get(each.delivery if node == each.pickup else each.pickup)
        if other is None:
            yield index, f"the other end of shipment {each.id} isn't on this trip"
        elif node == each.delivery and other > index:
            yield index, f"shipment {each.id} is delivered before it is picked up"


def times_between(problem: Problem, kind: VehicleType, trip: Trip) -> Iterator[tuple[int, int]]:
    """Yield the stops, by index, of deliveries, and by how much each parcel was too long aboard.

    From the end of service at its pickup to the start of service; at most 0 if it wasn't.
    """
    if not problem.limits_time_between:
        return
    duration = problem.travel[kind.travel].duration
    left: dict[int, int] = {}  # by delivery
    for index, stop in trip.numbered_stops:
        each = problem.shipment_at.get(stop.node)
        if each is None:
            continue
        if stop.node == each.pickup:
            service = kind.service_at(problem.customer_at(stop.node))
            left[each.delivery] = stop.service_start + service
            continue
        limit = each.longest_between(duration.item(each.pickup, each.delivery))
        if limit is not None and stop.node in left:
            yield index, stop.service_start - left[stop.node] - limit
