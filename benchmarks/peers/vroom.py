"""VROOM, by its package pyvroom, on a published instance."""

import time
from datetime import timedelta
from importlib import import_module
from importlib.metadata import version
from typing import Any

from benchmarks.peers.answers import PeerAnswer, PeerRoute, better, has_rare_rules, useful_counts
from benchmarks.peers.published import Published

SECONDS_PER_HOUR = 3600


def solve(instance: Published, seconds: float, seed: int) -> PeerAnswer | None:
    """Return the better of exploration levels 0 and 5, each given the whole limit, on one thread.

    None where vehicles may reload. `seed` changes nothing: the search is deterministic.
    """
    if has_rare_rules(instance):
        return None
    low, high = (_explore(instance, seconds, level) for level in (0, 5))
    return better(instance, low, high)


def _explore(instance: Published, seconds: float, level: int) -> PeerAnswer:
    vroom: Any = import_module("vroom")
    problem, types = _to_input(vroom, instance)
    began = time.perf_counter()
    result = problem.solve(exploration_level=level, nb_threads=1,
                           timeout=timedelta(seconds=seconds))
    elapsed = time.perf_counter() - began
    steps = result.routes
    jobs = steps[steps["type"] == "job"]
    routes: dict[int, PeerRoute] = {}
    for vehicle, job in zip(jobs["vehicle_id"], jobs["id"], strict=True):
        routes.setdefault(int(vehicle), (types[int(vehicle)], [[]]))[1][0].append(int(job))
    return PeerAnswer(list(routes.values()), elapsed, version("pyvroom"))


def _to_input(vroom: Any, instance: Published) -> tuple[Any, list[int]]:
    """Return the input, and the type of each vehicle in it."""
    def window(node: int) -> Any:
        return vroom.TimeWindow(int(instance.earliest[node]), int(instance.latest[node]))

    problem = vroom.Input()
    problem.set_durations_matrix("car", instance.travel)
    types: list[int] = []
    for kind, (vehicle, count) in enumerate(
        zip(instance.vehicles, useful_counts(instance), strict=True)
    ):
        # A duration of one unit, a second to VROOM, costs as much as a distance of one.
        costs = vroom.VehicleCosts(vehicle.fixed_cost, SECONDS_PER_HOUR * vehicle.unit_cost)
        for _ in range(count):
            problem.add_vehicle(vroom.Vehicle(
                len(types), start=0, end=0, capacity=[vehicle.capacity], costs=costs,
                time_window=window(0) if instance.has_windows else None))
            types.append(kind)
    for node in range(1, instance.num_customers + 1):
        problem.add_job(vroom.Job(
            node, location=node, delivery=[int(instance.demand[node])],
            default_service=int(instance.service[node]),
            time_windows=[window(node)] if instance.has_windows else []))
    return problem, types
