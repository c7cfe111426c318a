"""What the planner has no words for, said by vehicles that don't exist and by prices."""

from collections.abc import Sequence
from dataclasses import replace
from math import gcd

import numpy as np

from app.vroom.models import Model
from app.vroom.nodes import PARTS, Nodes
from model.problem import (
    MAX_QUANTITY, MM_PER_KM, MS_PER_HOUR, FloatArray, IntArray, Problem, Travel, VehicleType,
)

ONLY = "only"
"""Skill for jobs with one window, which vehicles that take other windows lack."""

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
    first = problem.num_depots
    marks = {node: f"one of {job}" for job, copies in several.items() for node in copies}
    customers = tuple(
        replace(customer, skills=customer.skills | {marks.get(node, ONLY)})
        for node, customer in enumerate(problem.customers, start=first))
    kinds = [replace(kind, skills=kind.skills | {ONLY, *marks.values()})
             for kind in problem.vehicle_types]
    for copies in several.values():
        customer = customers[copies[0] - first]
        skills = frozenset(skill for node in copies for skill in customers[node - first].skills)
        kinds.append(VehicleType(
            f"not {customer.id}", len(copies) - 1, customer.demand, travel=len(problem.travel),
            max_trip_distance=PARTS, skills=skills))
    number = problem.num_nodes
    each = np.zeros((number, number), np.int64)
    each[:, first:] = PARTS
    nowhere = Travel(np.zeros((number, number), np.int64), each)
    limited = {kind.travel for kind in problem.vehicle_types if kind.max_trip_distance is not None}
    travels = tuple(travel if index in limited else _dearer_to(travel, list(marks))
                    for index, travel in enumerate(problem.travel))
    return replace(problem, customers=customers, vehicle_types=tuple(kinds),
                   travel=(*travels, nowhere))


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
    """Return a model whose last kind of vehicle leaves jobs out, at a cost that goes by priority.

    The planner's own cost of leaving a customer out is the same for all.

    Parameters
    ----------
    priorities
        (request's job,).
    """
    stated = np.array([priorities[job] for job in model.nodes.jobs], np.int64)
    return replace(
        model, problem=_add_nobody(model.problem, stated), leaves_out=True,
        relaxed=tuple(_add_nobody(relaxed, stated) for relaxed in model.relaxed))


def _add_nobody(problem: Problem, priorities: IntArray) -> Problem:
    drop = _dropping_cost(problem, priorities)
    first, number = problem.num_depots, problem.num_nodes
    # Two on one route cost more than two routes, so that all routes are alike.
    distance = np.zeros((number, number))
    distance[:, first:] = drop
    distance[first:, first:] *= 2
    scale = min(1.0, MAX_QUANTITY / (distance.max() * MM_PER_KM))
    whole: IntArray = np.rint(distance * scale * MM_PER_KM).astype(np.int64)
    nobody = VehicleType(
        "nobody", problem.num_customers, _largest_demand(problem), travel=len(problem.travel),
        cost_per_km=1.0 / scale,
        skills=frozenset(skill for customer in problem.customers for skill in customer.skills))
    travel = Travel(np.zeros((number, number), np.int64), whole)
    return replace(
        problem, vehicle_types=(*problem.vehicle_types, nobody), travel=(*problem.travel, travel),
        unassigned_cost=problem.unassigned_cost + 10 * float(drop.max()))


def _dropping_cost(problem: Problem, priorities: IntArray) -> FloatArray:
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
        away = travel.distance[kind.depot, first:] + travel.distance[first:, kind.depot]
        time = travel.duration[kind.depot, first:] + travel.duration[first:, kind.depot]
        cost = (away / MM_PER_KM * kind.cost_per_km
                + time / MS_PER_HOUR * kind.cost_per_hour + kind.fixed_cost)
        dearest = max(dearest, float(cost.max()))
    return dearest


def _largest_demand(problem: Problem) -> tuple[int, ...]:
    return tuple(max(column) for column in
                 zip(*(customer.demand for customer in problem.customers), strict=True))
