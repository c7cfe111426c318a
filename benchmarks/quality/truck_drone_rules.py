"""Instances of the public truck-and-drone sets, and the rules of theirs that `Problem` lacks.

A search that is told these rules obeys them; whether a plan does is judged here.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from model.judge.rules import Violation
from model.problem import Problem
from model.solution import Solution, Trip

LOOPS = "loops"
"""A sortie may not be recovered at the stop where it was launched."""

CROSSINGS = "crossings"
"""A sortie may be recovered at the stop where it was launched only."""


@dataclass(frozen=True, eq=False)
class TruckDroneInstance:
    """A public instance under its set's rules, as far as `Problem` expresses them."""

    name: str
    set_name: str
    size: int  # customers of the set; a variant may have more
    problem: Problem  # the first of `variants`
    reference: float | None  # in the unit of the plan's total cost, which is the set's own
    kind: str  # of the reference: "optimal", "upper bound", "truck only" or "none"
    forbids: frozenset[str]  # rules of the set that `problem` does not keep
    variants: tuple[Problem, ...]  # the best plan of any of them counts
    heuristic: float | None = None  # value of a published heuristic, where there is another


def broken_rules(problem: Problem, solution: Solution, forbids: Iterable[str]) -> list[Violation]:
    """Judge a plan by what its set forbids beyond `Problem`; `check` judges the rest.

    Raises
    ------
    ValueError
        If `forbids` holds anything but `LOOPS` and `CROSSINGS`.
    """
    rules = sorted(forbids)
    for rule in rules:
        if rule not in RULES:
            raise ValueError(f"forbids: {rule!r} is not one of {', '.join(RULES)}")
    return [
        Violation(rule.upper().replace(" ", "_"), message,
                  f"routes[{index}].trips[{number}].sorties[{flight}]")
        for index, route in enumerate(solution.routes)
        for number, trip in enumerate(route.trips)
        for rule in rules
        for flight, message in RULES[rule](problem, route.vehicle_type, trip)
    ]


def _loops(problem: Problem, vehicle_type: int, trip: Trip) -> Iterator[tuple[int, str]]:
    for index, sortie in enumerate(trip.sorties):
        if sortie.recovery_stop == sortie.launch_stop:
            yield index, f"launched and recovered at stop {sortie.launch_stop}"


def _crossings(problem: Problem, vehicle_type: int, trip: Trip) -> Iterator[tuple[int, str]]:
    for index, sortie in enumerate(trip.sorties):
        if sortie.recovery_stop != sortie.launch_stop:
            yield index, (f"launched at stop {sortie.launch_stop}, recovered at stop "
                          f"{sortie.recovery_stop}")


RULES: Mapping[str, Callable[[Problem, int, Trip], Iterator[tuple[int, str]]]] = {
    LOOPS: _loops, CROSSINGS: _crossings,
}
"""Each yields the sortie that breaks a rule and how, for a trip of a vehicle type."""
