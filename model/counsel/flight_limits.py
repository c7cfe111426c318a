"""What limits flights at depots and by zones, each a little looser."""

from collections.abc import Iterator
from dataclasses import replace

from model.judge.hubs import lacks_battery, lacks_charger
from model.problem import Depot, Problem, VehicleType
from model.solution import Solution

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
