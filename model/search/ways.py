"""What ways cost beside a last end, inside the search alone.

Where only the last vehicle counts, no way would be longer than another for all others: vehicles
that end alike are told apart by few turns, and those with long ways don't get shorter ones.
"""

from collections.abc import Iterator
from dataclasses import replace

from model.engine.instance import Instance
from model.problem import MM_PER_KM, MS_PER_HOUR, Problem

WAYS_BY_END, WAYS_AT_FIRST = 0.001, 0.1
"""What ways of all vehicles cost at least, by what as much later a last end does; and at first."""

BY_WAYS_SHARE, BY_WAYS_COOLED = 0.7, 0.4
"""The share of the time for which they do, and through how much of the cooling that is."""


def come_ways_first(problem: Problem) -> bool:
    """Tell whether a search that is given no plan begins with ways that cost more.

    One vehicle alone ends sooner by each that is shorter.
    """
    return problem.fairness.makespan_cost_per_hour > 0 and _num_vehicles(problem) > 1


def with_dear_ways(problem: Problem) -> Problem:
    """Return a problem whose ways cost what they do at first."""
    return replace(problem, vehicle_types=tuple(
        replace(kind, cost_per_km=max(kind.cost_per_km, least)) for kind, least in
        zip(problem.vehicle_types, _least_per_km(problem, WAYS_AT_FIRST), strict=True)))


def with_ways_priced(problem: Problem, instance: Instance) -> Instance:
    """Return a packed problem in which ways cost a little where the last end alone does.

    Time would do as well, but for who has to be held back then.
    """
    if not problem.fairness.makespan_cost_per_hour:
        return instance
    rate = instance.rate.copy()
    for row, least in enumerate(_least_per_km(problem, WAYS_BY_END)):
        rate["distance"][0, row] = max(rate["distance"][0, row], least)
    return instance._replace(rate=rate)


def _least_per_km(problem: Problem, share: float) -> Iterator[float]:
    """Yield what a kilometre costs at least by each vehicle type."""
    per_hour = share * problem.fairness.makespan_cost_per_hour
    per_hour /= max(1, min(_num_vehicles(problem), problem.num_customers))
    for kind in problem.vehicle_types:
        duration, distance = problem.travel[kind.travel].longest()
        yield per_hour * (duration / MS_PER_HOUR) / (distance / MM_PER_KM) if distance else 0.0


def _num_vehicles(problem: Problem) -> int:
    return sum([kind.count for kind in problem.vehicle_types])
