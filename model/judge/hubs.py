"""What vehicles that fly share at depots: a battery each trip, or a place to charge all day."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from model.judge.rules import Violation
from model.problem import Problem, VehicleType
from model.solution import Route, Solution


class Taken(NamedTuple):
    """What is taken of each depot, by its node."""

    batteries: Counter[int]
    chargers: Counter[int]


def is_charged(problem: Problem, route: Route) -> bool:
    """Tell whether a vehicle needs a place to charge at its depot."""
    return len(route.trips) > problem.vehicle_types[route.vehicle_type].trips_uncharged


def taken_at_hubs(problem: Problem, routes: Iterable[Route]) -> Taken:
    """Return what routes take."""
    taken = Taken(Counter(), Counter())
    for route in routes:
        kind = problem.vehicle_types[route.vehicle_type]
        if kind.takes_batteries:
            taken.batteries.update([trip.stops[0].node for trip in route.trips])
        if is_charged(problem, route):
            taken.chargers[kind.depot] += 1
    return taken


def lacks_battery(problem: Problem, kind: VehicleType, solution: Solution) -> bool:
    """Tell whether a plan has taken all batteries at the depot of a type that takes some."""
    stock = problem.depots[kind.depot].batteries
    return kind.takes_batteries and stock is not None and (
        taken_at_hubs(problem, solution.routes).batteries[kind.depot] >= stock)


def lacks_charger(problem: Problem, kind: VehicleType, trips: int, solution: Solution) -> bool:
    """Tell whether a vehicle of so many trips makes no more for want of a place to charge."""
    stock = problem.depots[kind.depot].chargers
    return trips == kind.trips_uncharged and stock is not None and (
        taken_at_hubs(problem, solution.routes).chargers[kind.depot] >= stock)


def hub_violations(problem: Problem, solution: Solution) -> Iterator[Violation]:
    """Yield the first trip, and the first vehicle, for which a depot has too little."""
    if not problem.limits_hubs:
        return
    known = [(index, route) for index, route in enumerate(solution.routes)
             if 0 <= route.vehicle_type < len(problem.vehicle_types)
             and all(trip.stops for trip in route.trips)]
    taken = taken_at_hubs(problem, [route for _, route in known])
    for node, depot in enumerate(problem.depots):
        if depot.batteries is not None and taken.batteries[node] > depot.batteries:
            paths = [f"routes[{index}].trips[{number}]" for index, route in known
                     if problem.vehicle_types[route.vehicle_type].takes_batteries
                     for number, trip in enumerate(route.trips) if trip.stops[0].node == node]
            yield Violation("BATTERIES", f"{len(paths)} trips begin at {depot.id}, which has "
                            f"{depot.batteries} charged batteries", paths[depot.batteries])
        if depot.chargers is not None and taken.chargers[node] > depot.chargers:
            paths = [f"routes[{index}]" for index, route in known
                     if problem.vehicle_types[route.vehicle_type].depot == node
                     and is_charged(problem, route)]
            yield Violation("CHARGERS", f"{len(paths)} vehicles are charged at {depot.id}, which "
                            f"has places for {depot.chargers}", paths[depot.chargers])
