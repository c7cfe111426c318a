"""What it costs to serve orders on some routes of a plan, by trucks' detours alone."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from model.problem import MM_PER_KM, MS_PER_HOUR, FloatArray, IntArray, Problem, VehicleType
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
    saved = _saved(problem, routes)
    for index, kind in enumerate(problem.vehicle_types):
        legs = [leg for route in routes if route.vehicle_type == index
                for trip in route.trips for leg in _legs(problem, kind, trip)]
        if legs:
            best = np.minimum(best, _cheapest(problem, index, legs, orders))
        if index in kinds:
            alone = _Leg(kind.begins_at, kind.ends_at, kind.earliest, kind.latest, kind.capacity)
            best = np.minimum(best, kind.fixed_cost + _cheapest(problem, index, [alone], orders))
    costs = zip(nodes, best.tolist(), strict=True)
    return np.array([saved.get(node, cost) for node, cost in costs])


def _along(problem: Problem, kind: VehicleType) -> tuple[IntArray, FloatArray]:
    """Return how long legs of a type take, and what they cost."""
    duration, distance = problem.travel[kind.travel].arrays()
    return duration, (distance * (kind.cost_per_km / MM_PER_KM)
                      + duration * (kind.cost_per_hour / MS_PER_HOUR))


def _saved(problem: Problem, routes: Sequence[Route]) -> dict[int, float]:
    """Return what each route saves without each of its orders, by node."""
    saved = dict[int, float]()
    for route in routes:
        kind = problem.vehicle_types[route.vehicle_type]
        cost = _along(problem, kind)[1]
        for trip in route.trips:
            at = [stop.node for stop in trip.stops]
            only = len(at) == 3
            for before, node, behind in zip(at, at[1:], at[2:], strict=False):
                saved[node] = float(cost[before, node] + cost[node, behind]
                                    + (kind.fixed_cost if only else -cost[before, behind]))
    return saved


def _legs(problem: Problem, kind: VehicleType, trip: Trip) -> Iterator[_Leg]:
    """Yield the legs of a trip."""
    at = [stop.node for stop in trip.stops]
    orders = [problem.customers[node - problem.num_depots] for node in at[1:-1]]
    duration = _along(problem, kind)[0]
    used = np.sum([each.demand for each in orders], axis=0)
    room = tuple((np.array(kind.capacity) - used).tolist())
    leaves, latest = [kind.earliest], [kind.latest]
    for (before, node), each in zip(pairwise(at), orders, strict=False):
        arrival = max(leaves[-1] + int(duration[before, node]), each.earliest)
        leaves.append(arrival + kind.service_at(each))
    for (behind, node), each in zip(pairwise(at[::-1]), orders[::-1], strict=False):
        by = latest[-1] - int(duration[node, behind]) - kind.service_at(each)
        latest.append(min(by, each.latest))
    for (before, behind), leave, by in zip(pairwise(at), leaves, latest[::-1], strict=True):
        yield _Leg(before, behind, leave, by, room)


def _cheapest(problem: Problem, index: int, legs: Sequence[_Leg], nodes: IntArray) -> FloatArray:
    """Return each order's shortest detour from one of some legs of a type, (order,)."""
    kind, first = problem.vehicle_types[index], problem.num_depots
    orders = [problem.customers[node - first] for node in nodes.tolist()]
    opens, closes, service = np.array(
        [(each.earliest, each.latest, kind.service_at(each)) for each in orders],
        np.int64).reshape(-1, 3).T[:, :, None]
    before, behind, leave, latest = np.array(
        [(leg.before, leg.behind, leg.leave, leg.latest) for leg in legs], np.int64).T
    duration, cost = _along(problem, kind)
    arrival = np.maximum(leave + duration[np.ix_(before, nodes)].T, opens)
    fits = ((arrival <= closes)
            & (arrival + service + duration[np.ix_(nodes, behind)] <= latest))
    demand = np.array([each.demand for each in orders]).reshape(len(orders), 1, -1)
    fits &= (demand <= np.array([leg.room for leg in legs])).all(axis=2)
    if problem.may_serve is not None:
        fits &= problem.may_serve[index, nodes - first][:, None]
    more = cost[np.ix_(before, nodes)].T + cost[np.ix_(nodes, behind)] - cost[before, behind]
    return np.where(fits, more, np.inf).min(axis=1, initial=np.inf)
