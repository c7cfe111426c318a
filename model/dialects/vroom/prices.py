"""What leaving jobs out costs."""

from collections.abc import Sequence
from dataclasses import replace
from math import gcd

import numpy as np

from model.dialects.vroom.models import Model
from model.problem import MM_PER_KM, FloatArray, IntArray, Problem

WEIGHT = 20
"""A step of priority weighs as much as so many jobs at most."""


def leave_out_by_priority(model: Model, priorities: Sequence[int]) -> Model:
    """Return a model in which leaving out a job costs the more, the higher its priority.

    Parameters
    ----------
    priorities
        (request's job,).
    """
    stated = np.array([priorities[job] for job in model.nodes.jobs], np.int64)
    return replace(model, problem=_with_dropping_costs(model.problem, stated))


def _with_dropping_costs(problem: Problem, priorities: IntArray) -> Problem:
    costs = _dropping_costs(problem, priorities).tolist()
    return replace(problem, customers=tuple(
        replace(customer, unassigned_cost=cost)
        for customer, cost in zip(problem.customers, costs, strict=True)))


def _dropping_costs(problem: Problem, priorities: IntArray) -> FloatArray:
    """Return (customer,) what leaving out costs: first by priority, then by number."""
    unit = gcd(*priorities.tolist()) or 1
    once = 2.0 * _dearest_trip(problem)
    weight = once * min(WEIGHT, problem.num_customers)
    return once + weight * (priorities / unit)


def _dearest_trip(problem: Problem) -> float:
    """Return what serving a customer alone costs at most."""
    dearest = 1.0
    for kind in problem.vehicle_types:
        travel, first = problem.travel[kind.travel], problem.num_depots
        start, end = kind.begins_at, kind.ends_at
        away = travel.distance[start, first:] + travel.distance[first:, end]
        cost = away / MM_PER_KM * kind.cost_per_km + kind.fixed_cost
        dearest = max(dearest, float(cost.max()))
    return dearest
