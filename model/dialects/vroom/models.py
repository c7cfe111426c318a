"""Problems for the planner, and its plans as routes of jobs."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from model.dialects.vroom.nodes import Nodes, Slots
from model.dialects.vroom.request import Window
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import MAX_QUANTITY, BoolArray, IntArray, Problem
from model.solution import Route, Solution

Routes = Mapping[int, Sequence[Sequence[int]]]
"""Jobs of each route, by the index of the kind that drives it."""

StartWindows = Callable[[int, Sequence[int]], Sequence[Window | None]]
"""Tells of a route of a kind of vehicle in which of its windows each job starts."""


@dataclass(frozen=True, eq=False)
class Model:
    """A problem for the planner, and what its parts stand for.

    Its first kinds of vehicles are the request's. Then comes one for each job with several windows,
    which takes all but one of them for nothing.
    """

    problem: Problem
    nodes: Nodes
    num_kinds: int  # of vehicles that exist
    relaxed: tuple[Problem, ...] = ()
    """Where `problem` is stricter or costs otherwise than it should: the same by true costs, whose
    plans may break rules. At most one."""
    surplus: tuple[float, ...] | None = None
    """(customer,) what is taken minus what is brought, if that keeps plans from being true."""
    has_longest: bool = False  # whether legs are longer than `problem` can tell

    @property
    def is_loose(self) -> bool:
        """Whether its plans may break a rule of the request."""
        return (bool(self.relaxed) or self.has_longest
                or len(set(self.nodes.jobs)) < len(self.nodes.jobs))

    def routes(self, solution: Solution) -> Routes:
        """Return the routes of vehicles that exist, each job on the first one only."""
        routes: dict[int, list[list[int]]] = {}
        seen: set[int] = set()
        for route in solution.routes:
            if route.vehicle_type >= self.num_kinds:
                continue
            jobs = []
            for stop in route.trips[0].stops[1:-1]:
                job = self.nodes.jobs[stop.node - self.problem.num_depots]
                if job not in seen:
                    seen.add(job)
                    jobs.append(job)
            if jobs:
                routes.setdefault(route.vehicle_type, []).append(jobs)
        return routes

    def solution(self, routes: Routes, starts: StartWindows) -> Solution:
        """Return the plan that consists of routes; jobs that the problem lacks are skipped."""
        nodes_of = self.nodes.of_job()
        first = self.problem.num_depots
        writer = _Writer(self.problem)
        for kind, its_routes in routes.items():
            for jobs in its_routes:
                nodes = []
                for job, window in zip(jobs, starts(kind, jobs), strict=True):
                    copies = nodes_of.get(job, [])
                    for node in copies:
                        if self.nodes.windows[node - first] == window:
                            nodes.append(node)
                            copies.remove(node)
                            break
                writer.add(kind, nodes)
        several = self.num_kinds
        for job, copies in self.nodes.of_job().items():
            left = nodes_of[job]
            # Of a job left out, one node is, and the others are taken all the same.
            for node in left[1:] if len(left) == len(copies) else left:
                writer.add(several, [node])
            several += len(copies) > 1
        return writer.solution()

    def servable(self) -> Slots:
        """Return the windows of jobs in which some vehicle might serve them.

        The way through other jobs may be shorter than the direct one, so that only the shortest
        legs to and from a job count.
        """
        problem = self.relaxed[0] if self.relaxed else self.problem
        customers, first = problem.customers, problem.num_depots
        earliest = np.array([customer.earliest for customer in customers], np.int64)
        latest = np.array([customer.latest for customer in customers], np.int64)
        service = np.array([customer.service_duration for customer in customers], np.int64)
        demand = np.array([customer.demand for customer in customers], np.int64)
        servable: BoolArray = np.zeros(len(customers), np.bool_)
        shortest = {travel: _shortest_legs(problem.travel[travel].duration, first)
                    for travel in {kind.travel
                                   for kind in problem.vehicle_types[: self.num_kinds]}}
        for number, kind in enumerate(problem.vehicle_types[: self.num_kinds]):
            to, back = shortest[kind.travel]
            arrival = kind.earliest + to
            end = np.maximum(arrival, earliest) + service + back
            servable |= ((demand <= np.array(kind.capacity)).all(axis=1) & (arrival <= latest)
                         & (end <= kind.latest)
                         & [customer.skills <= kind.skills for customer in customers]
                         & (True if problem.may_serve is None else problem.may_serve[number]))
        slots: dict[int, list[Window | None]] = {}
        for index in np.flatnonzero(servable):
            slots.setdefault(self.nodes.jobs[index], []).append(self.nodes.windows[index])
        return slots


def _shortest_legs(duration: IntArray, first: int) -> tuple[IntArray, IntArray]:
    """Return the shortest leg to each customer, and from each, by itself excepted."""
    legs = duration.copy()
    np.fill_diagonal(legs, MAX_QUANTITY)
    return legs[:, first:].min(axis=0), legs[first:].min(axis=1)


class _Writer:
    """Collects the routes of a plan."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._routes: list[Route] = []
        self._used: dict[int, int] = {}
        self._missing = set(range(problem.num_depots, problem.num_nodes))

    def add(self, kind: int, nodes: Sequence[int]) -> None:
        """Add a route, unless it is empty. In place."""
        if not nodes:
            return
        number = self._used.get(kind, 0)
        self._used[kind] = number + 1
        vehicle_type = self._problem.vehicle_types[kind]
        trip = TripDecision((vehicle_type.begins_at, *nodes, vehicle_type.ends_at))
        self._routes.append(schedule(self._problem, RouteDecision(kind, number, (trip,))))
        self._missing.difference_update(nodes)

    def solution(self) -> Solution:
        """Return the plan."""
        return Solution(tuple(self._routes), tuple(sorted(self._missing)))
