"""A wave of departures as a problem: who is open, who came, and with which each may leave."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.problem import BoolArray, Customer, IntArray, Problem


@dataclass(frozen=True, slots=True)
class Coming:
    """An order that may come, at a place that the problem knows."""

    node: int  # of the place
    customer: Customer
    release_time: int  # ms, departures before which it misses


Forecast = Callable[[np.random.Generator], Sequence[Coming]]
"""Draws what may come until the last departure looked ahead at."""


@dataclass(frozen=True, eq=False)
class Wave:
    """What is decided: which of the open orders leave now.

    Vehicles are those at home at each departure: one that leaves now doesn't leave once more.
    """

    problem: Problem  # open orders are customers, and so are places where orders may come
    open: tuple[int, ...]  # nodes
    departures: tuple[int, ...]  # ms, ascending: now, then those looked ahead at
    goes_on: bool = True  # there are departures after those

    def __post_init__(self) -> None:
        problem = self.problem
        if not self.departures or list(self.departures) != sorted({*self.departures}):
            raise ValueError(f"departures: {self.departures} is not allowed")
        if (problem.shipments or problem.relations or problem.choices
                or problem.fairness.is_stated):
            raise ValueError("problem: shipments, relations, alternatives or fairness are not "
                             "allowed where departures are chosen")

    @property
    def num_types(self) -> int:
        """Types of vehicles, of which each departure has its own."""
        return len(self.problem.vehicle_types)


@dataclass(frozen=True, eq=False)
class Future:
    """Open orders, and some that came, as a problem with types of vehicles for each departure."""

    wave: Wave
    problem: Problem  # customers are the open orders, in order, then those who came

    @property
    def open(self) -> range:
        """Nodes of the open orders."""
        first = self.problem.num_depots
        return range(first, first + len(self.wave.open))

    def node_of(self, node: int) -> int:
        """Return a depot's or an open order's node in the wave's problem."""
        first = self.problem.num_depots
        return node if node < first else self.wave.open[node - first]

    def departure_of(self, vehicle_type: int) -> int:
        """Return the number of the departure with which vehicles of a type leave."""
        return vehicle_type // self.wave.num_types

    @property
    def later_types(self) -> range:
        """Types of vehicles that don't leave now."""
        return range(self.wave.num_types, len(self.problem.vehicle_types))


def future_of(wave: Wave, coming: Sequence[Coming]) -> Future:
    """Return the problem where some orders came.

    Who may leave when is told by the types of vehicles that may serve it, not by releases, so that
    the search can link stops.
    """
    problem, times = wave.problem, len(wave.departures)
    first, kinds = problem.num_depots, problem.vehicle_types
    customers = [*(problem.customers[node - first] for node in wave.open),
                 *(each.customer for each in coming)]
    released = [*(each.release_time for each in customers[:len(wave.open)]),
                *(each.release_time for each in coming)]
    nodes = np.array([*range(first), *wave.open, *(each.node for each in coming)])
    costs = problem.vehicle_costs_of(range(len(kinds)), nodes[first:].tolist())
    return Future(wave, replace(
        problem, customers=tuple([each if each.release_time == 0 else replace(each, release_time=0)
                                  for each in customers]),
        vehicle_types=tuple([
            replace(kind, earliest=min(max(kind.earliest, leaves), kind.latest))
            for leaves in wave.departures for kind in kinds]),
        travel=tuple([legs.among(nodes) for legs in problem.travel]),
        coordinates=problem.coordinates[nodes], may_serve=_may_serve(wave, nodes, released),
        vehicle_costs=None if costs is None else np.tile(costs, (times, 1)),
        may_stop=None if problem.may_stop is None else np.tile(problem.may_stop, (times, 1))))


def _may_serve(wave: Wave, nodes: IntArray, released: Sequence[int]) -> BoolArray:
    """Return (type, customer): whom vehicles may serve that leave once it is there.

    Nobody by those whose work is over by then.
    """
    problem = wave.problem
    may = np.repeat(np.array(released, np.int64) <= np.array(wave.departures)[:, None],
                    wave.num_types, axis=0)
    late = [kind.latest < leaves for leaves in wave.departures for kind in problem.vehicle_types]
    may[late] = False
    if problem.may_serve is not None:
        columns = nodes[problem.num_depots:] - problem.num_depots
        may &= np.tile(problem.may_serve[:, columns], (len(wave.departures), 1))
    return may
