"""What it costs to serve orders on some routes of a plan, by trucks' detours alone."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from model.problem import (
    MM_PER_KM, MS_PER_HOUR, UNLIMITED, Customer, FloatArray, IntArray, Problem, VehicleType,
)
from model.search.waves.future import Future
from model.solution import Route, Trip


@dataclass(frozen=True)
class _Leg:
    """From one stop of a trip to the next."""

    before: int  # node
    behind: int
    leave: int  # ms, as early as can be
    latest: int  # when it has to come behind
    room: tuple[int, ...]  # of the trip, by dimension


def detours(future: Future, routes: Sequence[Route], kinds: range) -> FloatArray:
    """Return what each open order costs on some routes, (order,): infinite where there is no way.

    That is what its route saves without it, if it is on one of these, else the shortest detour of
    them that windows and loads allow, or a trip by a vehicle more of some types.
    """
    problem, nodes = future.problem, future.open
    orders, best = np.array(nodes, np.int64), np.full(len(nodes), np.inf)
    saved = dict[int, float]()
    for index, kind in enumerate(problem.vehicle_types):
        trips = [trip for route in routes if route.vehicle_type == index for trip in route.trips]
        duration, distance = problem.travel[kind.travel].arrays()
        cost = (distance * (kind.cost_per_km / MM_PER_KM)
                + duration * (kind.cost_per_hour / MS_PER_HOUR))
        saved |= {node: more for trip in trips for node, more in _saved(kind, cost, trip)}
        along = _Along(problem, index, duration, cost)
        if legs := [leg for trip in trips for leg in along.legs(trip)]:
            best = np.minimum(best, along.cheapest(legs, orders))
        if index in kinds:
            alone = _Leg(kind.begins_at, kind.ends_at, kind.earliest, kind.latest, kind.capacity)
            best = np.minimum(best, kind.fixed_cost + along.cheapest([alone], orders))
    costs = zip(nodes, best.tolist(), strict=True)
    return np.array([saved.get(node, cost) for node, cost in costs])


def _saved(kind: VehicleType, cost: FloatArray, trip: Trip) -> Iterator[tuple[int, float]]:
    """Yield each order of a trip with what the trip saves without it."""
    at = [stop.node for stop in trip.stops]
    for before, node, behind in zip(at, at[1:], at[2:], strict=False):
        rest = -kind.fixed_cost if len(at) == 3 and not trip.sorties else cost[before, behind]
        yield node, float(cost[before, node] + cost[node, behind] - rest)


def _may_serve(kind: VehicleType, order: Customer) -> bool:
    """Tell whether vehicles of a type serve an order themselves, wherever that is."""
    other = "truck" if kind.flies else "drone"
    return order.served_by != other and order.skills <= kind.skills


@dataclass(frozen=True, eq=False)
class _Along:
    """How vehicles of a type travel."""

    problem: Problem
    index: int  # of the type
    duration: IntArray  # (node, node)
    cost: FloatArray  # (node, node)

    @property
    def kind(self) -> VehicleType:
        """The type."""
        return self.problem.vehicle_types[self.index]

    def _order(self, node: int) -> Customer:
        return self.problem.customers[node - self.problem.num_depots]

    def _window(self, node: int) -> tuple[int, int, int]:
        """Return when service at a stop may begin first and last, and how long it takes."""
        if node < self.problem.num_depots:
            return 0, UNLIMITED, 0
        order = self._order(node)
        return order.earliest, order.latest, self.kind.service_at(order)

    def legs(self, trip: Trip) -> Iterator[_Leg]:
        """Yield the legs of a trip."""
        kind, at = self.kind, [stop.node for stop in trip.stops]
        stops = [self._window(node) for node in at[1:-1]]
        aboard = [self._order(node) for node in trip.served]
        room = tuple([most - sum(each.demand[dimension] for each in aboard)
                      for dimension, most in enumerate(kind.capacity)])
        leaves, latest = [kind.earliest], [kind.latest]
        gaps = self.duration[at[:-1], at[1:]].tolist()
        for gap, (opens, _, service) in zip(gaps, stops, strict=False):
            leaves.append(max(leaves[-1] + gap, opens) + service)
        for gap, (_, closes, service) in zip(gaps[::-1], stops[::-1], strict=False):
            latest.append(min(latest[-1] - gap - service, closes))
        for (before, behind), leave, by in zip(pairwise(at), leaves, latest[::-1], strict=True):
            yield _Leg(before, behind, leave, by, room)

    def cheapest(self, legs: Sequence[_Leg], nodes: IntArray) -> FloatArray:
        """Return each order's shortest detour from one of some legs, (order,)."""
        kind, first, may_serve = self.kind, self.problem.num_depots, self.problem.may_serve
        orders = [self._order(node) for node in nodes.tolist()]
        opens, closes, service = np.array(
            [self._window(node) for node in nodes.tolist()], np.int64).reshape(-1, 3).T[:, :, None]
        before, behind, leave, latest = np.array(
            [(leg.before, leg.behind, leg.leave, leg.latest) for leg in legs], np.int64).T
        onward = np.ix_(nodes, behind)
        arrival = np.maximum(leave + self.duration[np.ix_(before, nodes)].T, opens)
        fits = (arrival <= closes) & (arrival + service + self.duration[onward] <= latest)
        demand = np.array([each.demand for each in orders]).reshape(len(orders), 1, -1)
        fits &= (demand <= np.array([leg.room for leg in legs])).all(axis=2)
        fits &= np.array([_may_serve(kind, each) for each in orders])[:, None]
        if may_serve is not None:
            fits &= may_serve[self.index, nodes - first][:, None]
        more = self.cost[np.ix_(before, nodes)].T + self.cost[onward] - self.cost[before, behind]
        return np.where(fits, more, np.inf).min(axis=1, initial=np.inf)
