"""What limits vehicles that fly by themselves, each a little looser."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from model.judge.clock import MS_PER_MINUTE
from model.judge.hubs import lacks_battery, lacks_charger
from model.judge.metrics import TripMetrics
from model.problem import MAX_QUANTITY, MM_PER_KM, UNLIMITED, Depot, Problem, VehicleType
from model.solution import Solution

_Changed = tuple[str, Literal["minute", "km", "rule"], float | None, VehicleType]
"""A field, the unit of one more, how many are left, and the type with one more, or without it."""


def flight_limits(kind: VehicleType, trip: TripMetrics | None) -> Iterator[_Changed]:
    """Yield how long, how far, and when, vehicles that fly by themselves may."""
    handling = kind.launch_duration + kind.recovery_duration
    if kind.endurance < UNLIMITED:
        slack = None if trip is None else (
            kind.endurance - trip.duration + handling) / MS_PER_MINUTE
        longer = min(kind.endurance + MS_PER_MINUTE, UNLIMITED)
        yield "endurance", "minute", slack, replace(kind, endurance=longer)
    if kind.max_range is not None:
        yield "max_range", "km", None, replace(kind, max_range=one_km_more(kind.max_range))
    if kind.storms:
        yield "max_wind_kmh", "rule", None, replace(kind, storms=())


def hub_limits(problem: Problem, solution: Solution) -> Iterator[tuple[str, int, Problem]]:
    """Yield what a plan leaves nothing of at depots of vehicles that fly, a type of those each.

    With one more there.
    """
    for k, kind in enumerate(problem.vehicle_types):
        depot = problem.depots[kind.depot]
        if depot.batteries is not None and lacks_battery(problem, kind, solution):
            yield "depot.batteries", k, _with_depot(
                problem, kind.depot, replace(depot, batteries=depot.batteries + 1))
        trips = [len(route.trips) for route in solution.routes if route.vehicle_type == k]
        if depot.chargers is not None and any(
                lacks_charger(problem, kind, number, solution) for number in trips):
            yield "depot.chargers", k, _with_depot(
                problem, kind.depot, replace(depot, chargers=depot.chargers + 1))


def hour_limits(problem: Problem) -> Iterator[tuple[str, Problem]]:
    """Yield the hours of zones, if there are any, and the problem in which all are open."""
    kinds = tuple([_opened(kind) for kind in problem.vehicle_types])
    if kinds != problem.vehicle_types:
        yield "airspace.zones", replace(problem, vehicle_types=kinds)


def _opened(kind: VehicleType) -> VehicleType:
    """Return vehicles that may fly to and from zones at any hour, and their drones."""
    drones = [replace(each, closings=()) for each in kind.drone_types]
    return replace(kind, closings=(), drones=drones[0] if drones else None,
                   more_drones=tuple(drones[1:]))


def _with_depot(problem: Problem, node: int, depot: Depot) -> Problem:
    depots = [*problem.depots]
    depots[node] = depot
    return replace(problem, depots=tuple(depots))


def one_km_more(distance: int) -> int:
    """Return a distance of a kilometre more, if a problem may state it."""
    return min(distance + MM_PER_KM, MAX_QUANTITY)
