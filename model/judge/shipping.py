"""What trips break of shipments, and of the order in which loads are unloaded."""

from collections.abc import Iterator

from model.judge.pairs import parted, times_between
from model.judge.rules import TimedTrip, Violation, seconds
from model.judge.stacking import unstacked
from model.problem import Problem, VehicleType


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
