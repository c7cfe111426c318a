"""What of a plan given can't have happened in a problem."""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from model.judge.past import Past
from model.judge.rules import Violation
from model.solution import Solution


class SettledPartError(ValueError):
    """What has happened can't have happened in this problem."""

    def __init__(self, violations: Collection[Violation]) -> None:
        super().__init__("; ".join(f"{violation.path}: {violation.message}"
                                   for violation in violations))
        self.violations = tuple(violations)


def refuse(violations: Iterable[Violation]) -> None:
    """Raise `SettledPartError` if there is anything that can't have happened."""
    found = tuple(violations)
    if found:
        raise SettledPartError(found)


def gone_from(plan: Solution, past: Past) -> Iterator[Violation]:
    """Yield where something has happened at places that are no more."""
    for index, route in enumerate(plan.routes):
        known = past.trips.get(route.driven_by, ())
        for number, trip in enumerate(known):
            path = f"routes[{index}].trips[{number}]"
            for place, stop in enumerate(trip.stops):
                if stop.node < 0:
                    yield Violation("UNKNOWN_NODE", "it is gone", f"{path}.stops[{place}]")
            for place, sortie in enumerate(trip.sorties):
                if min(sortie.recovery_node, *(visit.node for visit in sortie.visits)) < 0:
                    yield Violation("UNKNOWN_NODE", "whom it serves, or where it is met, is gone",
                                    f"{path}.sorties[{place}]")


def as_given(plan: Solution, settled: Solution, violations: Iterable[Violation],
             codes: Collection[str]) -> Iterator[Violation]:
    """Yield violations of some codes by the settled routes with paths in the plan given."""
    places = {route.driven_by: index for index, route in enumerate(plan.routes)}
    for violation in violations:
        if violation.code not in codes:
            continue
        begin, _, _ = violation.path.partition("]")
        if begin.startswith("routes["):
            number = int(begin.removeprefix("routes["))
            route = settled.routes[number]
            index = places[route.driven_by]
            path = violation.path.replace(f"routes[{number}]", f"routes[{index}]", 1)
            violation = replace(violation, path=path)
        yield violation
