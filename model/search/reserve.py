"""How long before its deadline a search ends, for what is done with its plan afterwards."""

from collections.abc import Callable

from model.problem import Problem

SECONDS_AFTER, SECONDS_PER_CUSTOMER, SECONDS_WITH_DRONES, SECONDS_PER_REASON = (
    0.0025, 2e-5, 4e-5, 2e-6)
"""Kept back for reading a plan, checking it and writing it down: in all, for each customer, where
drones fly or trips are packed so much more, and for each reason why a type of vehicle doesn't serve
one."""

READING_CUSTOMER, READING_ROUTE, READING_SORTIE = 1.1e-5, 1.9e-4, 2e-4
"""The same of a plan that is known: for each customer, route and sortie. More is kept back for
that where it is more."""


def usual_reserve(problem: Problem) -> float:
    """Return the seconds that are kept back for any plan."""
    each = SECONDS_PER_CUSTOMER + SECONDS_PER_REASON * len(problem.vehicle_types)
    if any(kind.drones is not None or kind.flies for kind in problem.vehicle_types):
        each += SECONDS_WITH_DRONES
    return SECONDS_AFTER + each * problem.num_customers


def more_by_plan(problem: Problem) -> Callable[[int, int], float]:
    """Return how much more is kept back for a plan of so many routes and sorties."""
    usual = usual_reserve(problem)

    def reading(routes: int, sorties: int) -> float:
        known = (SECONDS_AFTER + READING_CUSTOMER * problem.num_customers
                 + READING_ROUTE * routes + READING_SORTIE * sorties)
        return max(0.0, known - usual)

    return reading
