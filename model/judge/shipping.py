"""What trips break of shipments, and of the order in which loads are unloaded."""

from collections.abc import Iterator

from model.judge.loads import comes_early, moved_at
from model.judge.pairs import parted, times_between
from model.judge.rules import TimedTrip, Violation, seconds
from model.problem import Problem, VehicleType
from model.solution import Trip


def shipment_violations(problem: Problem, kind: VehicleType,
                        timed: TimedTrip) -> Iterator[Violation]:
    """Shipments that aren't brought from one end to the other, by a truck, or not in time."""
    trip, path = timed.trip, timed.path
    if kind.lifo:
        for where, message in unstacked(problem, trip):
            yield Violation("LIFO", f"{kind.id} unloads what was loaded last: {message}",
                            f"{path}{where}")
    if not problem.shipments:
        return
    for where, message in parted(problem, trip):
        yield Violation("PAIR", message, f"{path}{where}")
    for where, name, excess in times_between(problem, kind, trip):
        if excess > 0:
            yield Violation("TIME_BETWEEN", f"shipment {name} is {seconds(excess)} too long "
                            "under way", f"{path}{where}")


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
