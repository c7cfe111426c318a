"""What a solver answers to a published instance, and how the answer is judged.

Solvers state sequences only: their times, loads and costs are recomputed by `model.judge`, so that
all are measured by the same rules.
"""

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from benchmarks.peers.published import Published, to_problem
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Problem
from model.solution import Route, Solution

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

    cost: float  # in the unit of the published cost, without who is missing
    is_feasible: bool  # no rule is broken, customers left out aside
    num_missing: int  # customers left out who may not be

    @property
    def counts(self) -> bool:
        """The plan serves everybody and breaks no rule."""
        return self.is_feasible and self.num_missing == 0


def timed_plan(problem: Problem, routes: Iterable[PeerRoute]) -> Solution:
    """Return a plan with its times; empty trips and routes are left out.

    Vehicles leave as early as they may; those that may only work so long, as late as makes them no
    later home.
    """
    used: Counter[int] = Counter()
    planned = []
    missing = set(range(problem.num_depots, problem.num_nodes))
    for vehicle_type, trips in routes:
        kind = problem.vehicle_types[vehicle_type]
        decisions = tuple(TripDecision((kind.begins_at, *trip, kind.ends_at))
                          for trip in trips if trip)
        if decisions:
            decision = RouteDecision(vehicle_type, used[vehicle_type], decisions)
            route = schedule(problem, decision)
            if kind.max_working_duration is not None:
                route = schedule(problem, _leaving_late(problem, decision, route))
            planned.append(route)
            used[vehicle_type] += 1
            missing.difference_update(*trips)
    return Solution(tuple(planned), tuple(sorted(missing)))


def _leaving_late(problem: Problem, decision: RouteDecision, route: Route) -> RouteDecision:
    """Return the same route, of one trip, begun as late as lets it end as early."""
    (trip,), (timed,) = decision.trips, route.trips
    duration = problem.travel[problem.vehicle_types[route.vehicle_type].travel].duration
    latest, behind = timed.stops[-1].arrival, trip.nodes[-1]
    for stop in reversed(timed.stops[1:-1]):
        customer = problem.customer_at(stop.node)
        closings = (*(closes for closes, _ in customer.gaps), customer.latest)
        leave = latest - duration.item(stop.node, behind) - customer.service_duration
        latest = min([leave, *(at for at in closings if at >= stop.service_start)])
        behind = stop.node
    start = latest - duration.item(trip.nodes[0], behind)
    return replace(decision, trips=(replace(trip, start=max(start, timed.stops[0].arrival)),))


def judge(problem: Problem, routes: Iterable[PeerRoute]) -> Verdict:
    """Judge a plan of a published instance's problem.

    Raises
    ------
    ValueError
        If the plan names a vehicle type or a node that is not there.
    """
    solution = timed_plan(problem, routes)
    evaluation = check(problem, solution)
    missing = sum(problem.customer_at(node).unassigned_cost is None
                  for node in solution.unassigned)
    return Verdict(evaluation.cost.total - missing * problem.unassigned_cost,
                   evaluation.is_feasible, missing)


def cost_of_all(name: str, problem: Problem, plan: Solution) -> float:
    """Return what a plan of all customers costs, of a problem by some name.

    Raises
    ------
    ValueError
        If it breaks a rule, or leaves somebody out.
    """
    judged = check(problem, plan)
    if judged.violations or plan.unassigned:
        raise ValueError(f"{name}: the plan breaks a rule, or leaves somebody out")
    return judged.cost.total


def stated_cost(instance: Published, routes: Iterable[PeerRoute]) -> float:
    """Return what a plan costs by the instance's own numbers, without a look at its problem."""
    cost, left_out = 0, set(instance.customers)
    for vehicle_type, trips in routes:
        kind = instance.vehicles[vehicle_type]
        driven = [trip for trip in trips if trip]
        cost += kind.fixed_cost if driven else 0
        for trip in driven:
            stops = [kind.depot, *trip, instance.end_of(kind)]
            cost += kind.unit_cost * sum(int(instance.travel[leg]) for leg in pairwise(stops))
            left_out.difference_update(trip)
    if instance.prize is not None:
        cost += sum(int(instance.prize[node]) for node in left_out)
    return cost / instance.divisor


def better(instance: Published, first: PeerAnswer, second: PeerAnswer) -> PeerAnswer:
    """Return the better of two plans of one instance, `first` if they are equally good."""
    problem = to_problem(instance)

    def badness(answer: PeerAnswer) -> tuple[bool, int, float]:
        verdict = judge(problem, answer.routes)
        return not verdict.is_feasible, verdict.num_missing, verdict.cost

    return min((first, second), key=badness)


def has_rare_rules(instance: Published) -> bool:
    """Tell whether an instance has rules that few solvers know."""
    return (instance.max_trips > 1 or bool(instance.release.any()) or instance.num_depots > 1
            or instance.prize is not None or bool(instance.gaps) or instance.pickup is not None
            or instance.is_open
            or any(kind.max_duration is not None or kind.serves is not None
                   for kind in instance.vehicles))


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
