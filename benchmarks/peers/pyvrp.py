"""PyVRP on a published instance."""

import time
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from benchmarks.peers.answers import PeerAnswer, PeerRoute
from benchmarks.peers.published import Published, PublishedVehicle
from model.problem import IntArray

FAR = 1000
"""How many times the longest leg one takes that nobody may drive."""


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer:
    """Plan within a wall-clock limit, on one thread."""
    pyvrp: Any = import_module("pyvrp")
    stop: Any = import_module("pyvrp.stop")
    visits = _visits(instance)
    data = _to_data(pyvrp, instance, visits)
    began = time.perf_counter()
    result = pyvrp.solve(data, stop.MaxRuntime(seconds), seed=seed, collect_stats=False,
                         display=False)
    elapsed = time.perf_counter() - began
    nodes = [node for node, _, _ in visits]
    routes = [_read_route(route, nodes) for route in result.best.routes()]
    return PeerAnswer(routes, elapsed, version("pyvrp"))


def _load_scale(instance: Published) -> int:
    """Return what to scale loads by: as the distances are, or its penalties for them run dry."""
    x, y = instance.coordinates.T
    longest = float(np.hypot(x[:, None] - x, y[:, None] - y).max())
    return max(1, round(float(instance.travel.max()) / longest)) if longest else 1


def _visits(instance: Published) -> list[tuple[int, int, int]]:
    """Return a node, earliest and latest start for each window of a customer."""
    visits = []
    for node in instance.customers:
        opens = int(instance.earliest[node])
        for closes, reopens in instance.gaps_at(node):
            visits.append((node, opens, closes))
            opens = reopens
        visits.append((node, opens, int(instance.latest[node])))
    return visits


def _to_data(pyvrp: Any, instance: Published, visits: list[tuple[int, int, int]]) -> Any:
    """Return the instance with a client for each visit, of whom one is served of each customer."""
    scale = _load_scale(instance)
    members: dict[int, list[int]] = {}
    for index, (node, _, _) in enumerate(visits):
        members.setdefault(node, []).append(index)
    several = {node: group for node, group in members.items() if len(group) > 1}
    number = {node: index for index, node in enumerate(several)}
    clients = []
    for node, opens, closes in visits:
        alternatives = {"group": number[node]} if node in several else {}
        prize = {} if instance.prize is None else {"prize": int(instance.prize[node])}
        pickup = ({} if instance.pickup is None
                  else {"pickup": [int(instance.pickup[node]) * scale]})
        # Without windows the limits stay away: their operators need not run.
        window = {"tw_early": opens, "tw_late": closes} if instance.has_windows else {}
        clients.append(pyvrp.Client(
            node, delivery=[int(instance.demand[node]) * scale],
            service_duration=int(instance.service[node]),
            release_time=int(instance.release[node]),
            required=instance.prize is None and node not in several,
            **alternatives, **prize, **pickup, **window))
    tables = list(dict.fromkeys(kind.serves for kind in instance.vehicles))
    types = [_vehicle_type(pyvrp, instance, kind, scale, tables.index(kind.serves))
             for kind in instance.vehicles]
    legs = [_legs(instance, table) for table in tables]
    locations = [pyvrp.Location(float(x), float(y)) for x, y in instance.coordinates]
    return pyvrp.ProblemData(
        locations, clients, [pyvrp.Depot(depot) for depot in range(instance.num_depots)], types,
        legs, legs, [pyvrp.ClientGroup(group) for group in several.values()])


def _vehicle_type(pyvrp: Any, instance: Published, kind: PublishedVehicle, scale: int,
                  profile: int) -> Any:
    limits: dict[str, Any] = {}
    if instance.has_windows:
        limits |= {"tw_early": int(instance.earliest[kind.depot]),
                   "tw_late": int(instance.latest[kind.depot])}
    if instance.max_trips > 1:
        limits |= {"reload_depots": [0], "max_reloads": instance.max_trips - 1}
    if kind.max_duration is not None:
        limits["shift_duration"] = kind.max_duration
    return pyvrp.VehicleType(
        kind.count, [kind.capacity * scale], start_depot=kind.depot,
        end_depot=instance.end_of(kind), fixed_cost=kind.fixed_cost,
        unit_distance_cost=kind.unit_cost, profile=profile, **limits)


def _legs(instance: Published, serves: tuple[int, ...] | None) -> IntArray:
    """Return the legs, those that would break a rule being far too long.

    Its own reader does the same, but by legs so long that version 0.14.1 never comes back.
    """
    far = FAR * int(instance.travel.max())
    legs, depots = instance.travel.copy(), slice(instance.num_depots)
    if instance.pickups_last and instance.pickup is not None:
        brought, taken = instance.demand > 0, instance.pickup > 0
        legs[depots, taken] = far
        legs[np.ix_(taken, brought)] = far
    if serves is not None:
        forbidden = np.ones(len(legs), np.bool_)
        forbidden[depots] = False
        forbidden[list(serves)] = False
        legs[:, forbidden] = legs[forbidden] = far
    np.fill_diagonal(legs, 0)
    return legs


def _read_route(route: Any, nodes: list[int]) -> PeerRoute:
    trips: list[list[int]] = [[]]
    for activity in route:
        if activity.is_depot():
            trips.append([])
        else:
            trips[-1].append(nodes[activity.idx])
    return route.vehicle_type(), [trip for trip in trips if trip]
