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


def parted(problem: Problem, trip: Trip) -> Iterator[tuple[str, str]]:
    """Yield whoever serves an end of a shipment whose other end isn't where it should be, and why.

    As part of a path. What a drone delivers is aboard its truck as that comes to the launch.
    """
    position = {stop.node: index for index, stop in trip.numbered_stops}
    flown = {visit.node: sortie.launch_stop for sortie in trip.sorties for visit in sortie.visits}
    for node, index in position.items():
        each = problem.shipment_at.get(node)
        if each is None:
            continue
        other = each.delivery if node == each.pickup else each.pickup
        if other not in position and (node == each.delivery or other not in flown):
            yield f".stops[{index}]", f"the other end of shipment {each.id} isn't on this trip"
        elif node == each.delivery and position[other] > index:
            yield f".stops[{index}]", f"shipment {each.id} is delivered before it is picked up"
    for where, node, launch_stop in _flown_ends(problem, trip):
        each = problem.shipment_at[node]
        if node == each.pickup:
            yield where, f"shipment {each.id} is picked up by a drone"
        elif position.get(each.pickup, launch_stop) >= launch_stop:
            yield where, (f"shipment {each.id} isn't aboard where the drone is launched that "
                          "delivers it")


def _flown_ends(problem: Problem, trip: Trip) -> Iterator[tuple[str, int, int]]:
    """Yield drones' visits to ends of shipments, as part of a path, by node and launch stop."""
    for index, sortie in enumerate(trip.sorties):
        for number, visit in enumerate(sortie.visits):
            if visit.node in problem.shipment_at:
                yield f".sorties[{index}].visits[{number}]", visit.node, sortie.launch_stop


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
        served += [(f".sorties[{index}].visits[{number}]", visit.node, visit.service_start)
                   for number, visit in enumerate(sortie.visits)]
    for where, node, start in served:
        if node not in left:
            continue
        each = problem.shipment_at[node]
        limit = each.longest_between(duration.item(each.pickup, each.delivery))
        if limit is not None:
            yield where, each.id, start - left[node] - limit
