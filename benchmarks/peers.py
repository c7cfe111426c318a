"""What a solver answers to a published instance, and how the answer is judged.

Solvers state sequences only: their times, loads and costs are recomputed by `model.judge`, so that
all are measured by the same rules.
"""

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from benchmarks.published import Published, to_problem
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Problem
from model.solution import Solution

PeerRoute = tuple[int, list[list[int]]]
"""Index of the vehicle type, then the trips, each the nodes of its customers in order."""


@dataclass(frozen=True)
class PeerAnswer:
    """A solver's plan."""

    routes: list[PeerRoute]
    seconds: float  # wall-clock of the solver's call alone
    version: str  # of the solver


@dataclass(frozen=True)
class Verdict:
    """What the checker says of a plan."""

    cost: float  # in the unit of the published cost, without customers left out
    is_feasible: bool  # no rule is broken, customers left out aside
    num_unassigned: int

    @property
    def counts(self) -> bool:
        """The plan serves everybody and breaks no rule."""
        return self.is_feasible and self.num_unassigned == 0


def timed_plan(problem: Problem, routes: Iterable[PeerRoute]) -> Solution:
    """Return a plan with its times; empty trips and routes are left out."""
    used: Counter[int] = Counter()
    planned = []
    missing = set(range(problem.num_depots, problem.num_nodes))
    for vehicle_type, trips in routes:
        decisions = tuple(TripDecision((0, *trip, 0)) for trip in trips if trip)
        if decisions:
            decision = RouteDecision(vehicle_type, used[vehicle_type], decisions)
            planned.append(schedule(problem, decision))
            used[vehicle_type] += 1
            missing.difference_update(*trips)
    return Solution(tuple(planned), tuple(sorted(missing)))


def judge(problem: Problem, routes: Iterable[PeerRoute]) -> Verdict:
    """Judge a plan of a published instance's problem.

    Raises
    ------
    ValueError
        If the plan names a vehicle type or a node that is not there.
    """
    solution = timed_plan(problem, routes)
    evaluation = check(problem, solution)
    return Verdict(evaluation.cost.total - evaluation.cost.unassigned, evaluation.is_feasible,
                   len(solution.unassigned))


def better(instance: Published, first: PeerAnswer, second: PeerAnswer) -> PeerAnswer:
    """Return the better of two plans of one instance, `first` if they are equally good."""
    problem = to_problem(instance)

    def badness(answer: PeerAnswer) -> tuple[bool, int, float]:
        verdict = judge(problem, answer.routes)
        return not verdict.is_feasible, verdict.num_unassigned, verdict.cost

    return min((first, second), key=badness)


def needs_trips_or_releases(instance: Published) -> bool:
    """Tell whether vehicles may reload or parcels come late, which few solvers know."""
    return instance.max_trips > 1 or bool(instance.release.any())


def useful_counts(instance: Published) -> list[int]:
    """Return how many vehicles of each type are worth offering, never more than there are.

    Most solvers slow down with the number of vehicles. With one type the bound is what a simple
    plan needs, and at least demand / capacity with some room.
    """
    demand = int(instance.demand.sum())
    counts = []
    for vehicle in instance.vehicles:
        enough = math.ceil(1.1 * demand / vehicle.capacity) + 2
        if len(instance.vehicles) == 1:
            enough = max(enough, _routes_of_nearest(instance) + 2)
        counts.append(min(vehicle.count, enough))
    return counts


def _routes_of_nearest(instance: Published) -> int:
    """Return how many routes always going to the nearest customer in time takes, one type."""
    capacity = instance.vehicles[0].capacity
    left = np.arange(len(instance.demand)) > 0
    node, time, load, count = 0, int(instance.earliest[0]), 0, 1
    while left.any():
        arrival = time + instance.travel[node]
        start = arrival.clip(instance.earliest)
        back = start + instance.service + instance.travel[:, 0]
        fits = (left & (load + instance.demand <= capacity) & (arrival <= instance.latest)
                & (back <= instance.latest[0]))
        if fits.any():
            candidates = fits.nonzero()[0]
            node = int(candidates[start[candidates].argmin()])
            time = int(start[node] + instance.service[node])
            load += int(instance.demand[node])
            left[node] = False
        elif node == 0:
            break  # nobody can serve those that are left
        else:
            node, time, load, count = 0, int(instance.earliest[0]), 0, count + 1
    return count
