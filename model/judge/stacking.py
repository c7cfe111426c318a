"""Vehicles whose load is one stack: only what was loaded last can be unloaded."""

from collections.abc import Iterator

from model.judge.loads import comes_early, moved_at
from model.problem import Problem
from model.solution import Trip


def unstacked(problem: Problem, trip: Trip) -> Iterator[tuple[str, str]]:
    """Yield what lies below something when it is unloaded, as part of a path, and why.

    Parcels from the depot lie at the bottom. What is brought there stays, so it lies on no
    shipment, and nothing that leaves later lies beneath it.
    """
    stack: list[int] = []  # nodes of deliveries, once for each part
    for index, (leaves, comes) in enumerate(moved_at(problem, trip)):
        where, each = f".stops[{index}]", problem.shipment_at.get(trip.stops[index].node)
        if leaves and stack:
            yield where, "a shipment lies on a parcel that leaves here"
        if each is not None and each.delivery == trip.stops[index].node:
            parts = stack.count(each.delivery)
            if any(node != each.delivery for node in stack[len(stack) - parts:]):
                yield where, f"another shipment lies on {each.id}"
            stack = [node for node in stack if node != each.delivery]
        elif each is not None:
            stack.append(each.delivery)
        if comes and stack:
            yield where, "what is picked up here stays on a shipment"
    for number, sortie in enumerate(trip.sorties):
        if any(visit.node in problem.shipment_at for visit in sortie.visits):
            yield f".sorties[{number}]", "no drone takes a shipment from a stack"
    for where in comes_early(problem, trip):
        yield where, "what was picked up stays on a parcel that leaves later"
