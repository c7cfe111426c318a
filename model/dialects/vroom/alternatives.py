"""Which windows and which jobs are left out; the former by vehicles that don't exist."""

from collections.abc import Sequence
from dataclasses import replace
from math import gcd

import numpy as np

from model.dialects.vroom.models import Model
from model.dialects.vroom.nodes import PARTS, Nodes
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, FloatArray, IntArray, Problem, Travel, VehicleType,
)

SECOND_NODE = 0.05
"""What reaching a node of several costs more, by a mean leg; much more would heat the search."""

WEIGHT = 20
"""A step of priority weighs as much as so many jobs at most."""


def choose_windows(problem: Problem, nodes: Nodes) -> Problem:
    """Return a problem in which only one of the nodes of a job is to be served.

    For each job with several windows there are vehicles that take one of them each, all but one
    together, for nothing, and nothing else: so that one is left for the others.
    """
    several = {job: copies for job, copies in nodes.of_job().items() if len(copies) > 1}
    if not several:
        return problem
    first, kinds = problem.num_depots, list(problem.vehicle_types)
    table = np.zeros((len(kinds) + len(several), problem.num_customers), np.bool_)
    table[: len(kinds)] = True if problem.may_serve is None else problem.may_serve
    for copies in several.values():
        customer = problem.customer_at(copies[0])
        table[len(kinds), np.array(copies) - first] = True
        kinds.append(VehicleType(
            f"not {customer.id}", len(copies) - 1, customer.demand, travel=len(problem.travel),
            max_trip_distance=PARTS, skills=customer.skills))
    number = problem.num_nodes
    each = np.zeros((number, number), np.int64)
    each[:, first:] = PARTS
    nowhere = Travel(np.zeros((number, number), np.int64), each)
    limited = {kind.travel for kind in problem.vehicle_types if kind.max_trip_distance is not None}
    chosen = [node for copies in several.values() for node in copies]
    travels = tuple(travel if index in limited else _dearer_to(travel, chosen)
                    for index, travel in enumerate(problem.travel))
    return replace(problem, vehicle_types=tuple(kinds), travel=(*travels, nowhere),
                   may_serve=table)


def _dearer_to(travel: Travel, nodes: list[int]) -> Travel:
    """Return a travel on which the way to some nodes costs a little more.

    One node of each job is to be reached, so that this changes nothing, except that two are seldom
    reached because the way by both is no longer.
    """
    distance = travel.distance.copy()
    more = int(distance.mean() * SECOND_NODE)
    distance[:, nodes] = np.minimum(distance[:, nodes] + more, MAX_QUANTITY)
    return Travel(travel.duration, distance)


def bring_first(model: Model, price: float) -> Problem:
    """Return the relaxed problem of a model in which bringing after taking costs more.

    If all that is brought comes first, no vehicle is too full on the way.

    Parameters
    ----------
    price
        By what, as a share of the longest leg.
    """
    problem, surplus = model.relaxed[0], np.array(model.surplus)
    first, number = problem.num_depots, problem.num_nodes
    is_backwards = np.zeros((number, number), np.bool_)
    is_backwards[first:, first:] = (surplus[:, None] > 0) & (surplus < 0)
    real = {kind.travel for kind in problem.vehicle_types[: model.num_kinds]}

    def dearer(distance: IntArray) -> IntArray:
        extra = round(price * int(distance.max()))
        return np.where(is_backwards, np.minimum(distance + extra, MAX_QUANTITY), distance)

    return replace(problem, travel=tuple(
        Travel(travel.duration, dearer(travel.distance)) if number in real else travel
        for number, travel in enumerate(problem.travel)))


def leave_out_by_priority(model: Model, priorities: Sequence[int]) -> Model:
    """Return a model in which leaving out a job costs the more, the higher its priority.

    Parameters
    ----------
    priorities
        (request's job,).
    """
    stated = np.array([priorities[job] for job in model.nodes.jobs], np.int64)
    return replace(model, problem=_with_dropping_costs(model.problem, stated),
                   relaxed=tuple(_with_dropping_costs(relaxed, stated)
                                 for relaxed in model.relaxed))


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
        time = travel.duration[start, first:] + travel.duration[first:, end]
        cost = (away / MM_PER_KM * kind.cost_per_km
                + time / MS_PER_HOUR * kind.cost_per_hour + kind.fixed_cost)
        dearest = max(dearest, float(cost.max()))
    return dearest
