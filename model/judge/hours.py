"""When depots are open."""

from collections.abc import Iterator, Sequence

from model.judge.rules import TimedTrip, Violation, seconds
from model.problem import Problem


def hours_violations(problem: Problem, trips: Sequence[TimedTrip]) -> Iterator[Violation]:
    """Trips that begin or end at a depot while it is closed."""
    for timed in trips:
        stops = timed.trip.stops
        for index in (0, len(stops) - 1):
            depot, stop = problem.depots[stops[index].node], stops[index]
            path = f"{timed.path}.stops[{index}]"
            if stop.service_start < depot.earliest:
                yield Violation("SHIFT", f"{depot.id} opens at {seconds(depot.earliest)}, after "
                                f"{seconds(stop.service_start)}", path)
            if stop.departure > depot.latest:
                yield Violation("SHIFT", f"{depot.id} closes at {seconds(depot.latest)}, before "
                                f"{seconds(stop.departure)}", path)
