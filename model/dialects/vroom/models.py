"""Problems for the planner, and its plans as routes of jobs."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from model.dialects.vroom.nodes import Nodes
from model.judge.breaks import BreakDecision
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import MAX_QUANTITY, UNLIMITED, BoolArray, Customer, IntArray, Problem
from model.solution import Route, Solution

Routes = Mapping[int, Sequence[Sequence[int]]]
"""Jobs of each route, by the index of the kind that drives it."""


@dataclass(frozen=True, eq=False)
class Model:
    """A problem for the planner, and what its parts stand for."""

    problem: Problem
    nodes: Nodes
    rests: Callable[[int, Sequence[int]], Sequence[tuple[int, int]]] = lambda _kind, _jobs: ()
    """Return the breaks of a route by its kind and jobs, each with the gap in which it is taken."""

    def routes(self, solution: Solution) -> Routes:
        """Return the routes of a plan."""
        routes: dict[int, list[list[int]]] = {}
        first = self.problem.num_depots
        for route in solution.routes:
            routes.setdefault(route.vehicle_type, []).append(
                [self.nodes.jobs[stop.node - first] for stop in route.trips[0].stops[1:-1]])
        return routes

    def solution(self, routes: Routes) -> Solution:
        """Return the plan that consists of routes; jobs that the problem lacks are skipped."""
        node_of = self.nodes.of_job()
        writer = _Writer(self.problem)
        for kind, its_routes in routes.items():
            for jobs in its_routes:
                known = [job for job in jobs if job in node_of]
                if known:
                    writer.add(kind, [node_of[job] for job in known], self.rests(kind, known))
        return writer.solution()

    def servable(self) -> list[int]:
        """Return the jobs that some vehicle might serve.

        The way through other jobs may be shorter than the direct one, so that only the shortest
        legs to and from a job count.
        """
        problem = self.problem
        customers, first = problem.customers, problem.num_depots
        latest = np.array([customer.latest for customer in customers], np.int64)
        most = np.array([problem.asked_at(first + index) for index in range(len(customers))])
        servable: BoolArray = np.zeros(len(customers), np.bool_)
        shortest = {travel: _shortest_legs(problem.travel[travel].duration[:], first)
                    for travel in {kind.travel for kind in problem.vehicle_types}}
        openings = _Openings(customers)
        for number, kind in enumerate(problem.vehicle_types):
            to, back = shortest[kind.travel]
            arrival = kind.earliest + to
            service = np.array([kind.service_at(customer) for customer in customers], np.int64)
            end = np.maximum(arrival, openings.at(arrival)) + service + back
            servable |= ((most <= np.array(kind.capacity)).all(axis=1) & (arrival <= latest)
                         & (end <= kind.latest)
                         & [customer.skills <= kind.skills for customer in customers]
                         & (True if problem.may_serve is None else problem.may_serve[number]))
        # Of a shipment, all ends are or none.
        for each in problem.shipments:
            ends = [node - first for node in each.nodes]
            servable[ends] = servable[ends].all()
        return [self.nodes.jobs[index] for index in np.flatnonzero(servable)]


def _shortest_legs(duration: IntArray, first: int) -> tuple[IntArray, IntArray]:
    """Return the shortest leg to each customer, and from each, by itself excepted."""
    legs = duration.copy()
    np.fill_diagonal(legs, MAX_QUANTITY)
    return legs[:, first:].min(axis=0), legs[first:].min(axis=1)


class _Openings:
    """When the windows of all customers open."""

    def __init__(self, customers: Sequence[Customer]) -> None:
        most = max(len(customer.gaps) for customer in customers)
        self._first = np.array([customer.earliest for customer in customers], np.int64)
        self._gaps = np.full((len(customers), most, 2), UNLIMITED, np.int64)
        for row, customer in enumerate(customers):
            if customer.gaps:
                self._gaps[row, : len(customer.gaps)] = customer.gaps

    def at(self, arrival: IntArray) -> IntArray:
        """Return for each customer the beginning of the window that serves an arrival."""
        opens = self._first
        for gap in range(self._gaps.shape[1]):
            closes, reopens = self._gaps[:, gap].T
            opens = np.where(arrival > closes, reopens, opens)
        return opens


class _Writer:
    """Collects the routes of a plan."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._routes: list[Route] = []
        self._used: dict[int, int] = {}
        self._missing = set(range(problem.num_depots, problem.num_nodes))

    def add(self, kind: int, nodes: Sequence[int], rests: Sequence[tuple[int, int]]) -> None:
        """Add a route with its breaks, each with the index of the stop before it. In place."""
        number = self._used.get(kind, 0)
        self._used[kind] = number + 1
        vehicle_type = self._problem.vehicle_types[kind]
        breaks = [BreakDecision(number, gap, "way") for number, gap in rests
                  if number < len(vehicle_type.breaks)]
        trip = TripDecision((vehicle_type.begins_at, *nodes, vehicle_type.ends_at),
                            breaks=tuple(breaks))
        self._routes.append(schedule(self._problem, RouteDecision(kind, number, (trip,))))
        self._missing.difference_update(nodes)

    def solution(self) -> Solution:
        """Return the plan."""
        return Solution(tuple(self._routes), tuple(sorted(self._missing)))
