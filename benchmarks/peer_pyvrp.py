"""PyVRP on a published instance."""

import time
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

from benchmarks.peers import PeerAnswer, PeerRoute
from benchmarks.published import Published


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer:
    """Plan within a wall-clock limit, on one thread."""
    pyvrp: Any = import_module("pyvrp")
    stop: Any = import_module("pyvrp.stop")
    data = _to_data(pyvrp, instance)
    began = time.perf_counter()
    result = pyvrp.solve(data, stop.MaxRuntime(seconds), seed=seed, collect_stats=False,
                         display=False)
    elapsed = time.perf_counter() - began
    routes = [_read_route(route) for route in result.best.routes()]
    return PeerAnswer(routes, elapsed, version("pyvrp"))


def _load_scale(instance: Published) -> int:
    """Return what to scale loads by: as the distances are, or its penalties for them run dry."""
    x, y = instance.coordinates.T
    longest = float(np.hypot(x[:, None] - x, y[:, None] - y).max())
    return max(1, round(float(instance.travel.max()) / longest)) if longest else 1


def _to_data(pyvrp: Any, instance: Published) -> Any:
    scale = _load_scale(instance)
    nodes = range(1, instance.num_customers + 1)
    # Without windows the limits stay away: their operators need not run.
    windows = [{"tw_early": int(instance.earliest[node]), "tw_late": int(instance.latest[node])}
               if instance.has_windows else {} for node in range(instance.num_customers + 1)]
    clients = [
        pyvrp.Client(node, delivery=[int(instance.demand[node]) * scale],
                     service_duration=int(instance.service[node]),
                     release_time=int(instance.release[node]), **windows[node])
        for node in nodes]
    reloads = {} if instance.max_trips == 1 else {
        "reload_depots": [0], "max_reloads": instance.max_trips - 1}
    types = [
        pyvrp.VehicleType(vehicle.count, [vehicle.capacity * scale],
                          fixed_cost=vehicle.fixed_cost, unit_distance_cost=vehicle.unit_cost,
                          **windows[0], **reloads)
        for vehicle in instance.vehicles]
    locations = [pyvrp.Location(float(x), float(y)) for x, y in instance.coordinates]
    return pyvrp.ProblemData(locations, clients, [pyvrp.Depot(0)], types, [instance.travel],
                             [instance.travel])


def _read_route(route: Any) -> PeerRoute:
    trips: list[list[int]] = [[]]
    for activity in route:
        if activity.is_depot():
            trips.append([])
        else:
            trips[-1].append(activity.idx + 1)
    return route.vehicle_type(), [trip for trip in trips if trip]
