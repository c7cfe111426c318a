"""What vehicles that fly share at depots: a battery each trip, or places to charge in turn."""

from collections import Counter
from collections.abc import Iterable, Iterator

from model.judge.chargers import charging_lack, most_charged, with_charging
from model.judge.rules import Violation
from model.problem import Problem, VehicleType, shares_chargers
from model.solution import Route, Solution


def batteries_taken(problem: Problem, routes: Iterable[Route]) -> Counter[int]:
    """Return how many batteries routes take of each depot, by its node."""
    return Counter(trip.stops[0].node for route in routes
                   if problem.vehicle_types[route.vehicle_type].takes_batteries
                   for trip in route.trips)


def lacks_battery(problem: Problem, kind: VehicleType, solution: Solution) -> bool:
    """Tell whether a plan has taken all batteries at the depot of a type that takes some."""
    stock = problem.depots[kind.depot].batteries
    return kind.takes_batteries and stock is not None and (
        batteries_taken(problem, solution.routes)[kind.depot] >= stock)


def lacks_charger(problem: Problem, kind: VehicleType, trips: int, solution: Solution) -> bool:
    """Tell whether a vehicle of so many trips may have to wait longer for a place to charge than
    one place more would let it: a plan uses all at once.
    """
    stock = problem.depots[kind.depot].chargers
    return (trips > 0 or bool(kind.charge_left)) and stock is not None and (
        shares_chargers(problem, kind)
        and most_charged(problem, with_charging(problem, solution), kind.depot) >= stock)


def hub_violations(problem: Problem, solution: Solution) -> Iterator[Violation]:
    """Yield the first trips for which a depot has too few batteries or places to charge."""
    if not problem.limits_hubs:
        return
    known = {index: route for index, route in enumerate(solution.routes)
             if 0 <= route.vehicle_type < len(problem.vehicle_types)
             and all(trip.stops for trip in route.trips)}
    taken = batteries_taken(problem, known.values())
    for node, depot in enumerate(problem.depots):
        if depot.batteries is not None and taken[node] > depot.batteries:
            paths = [f"routes[{index}].trips[{number}]" for index, route in known.items()
                     if problem.vehicle_types[route.vehicle_type].takes_batteries
                     for number, trip in enumerate(route.trips) if trip.stops[0].node == node]
            yield Violation("BATTERIES", f"{len(paths)} trips begin at {depot.id}, which has "
                            f"{depot.batteries} charged batteries", paths[depot.batteries])
    lack = charging_lack(problem, solution)
    if lack is not None:
        yield Violation("CHARGERS", lack.message, f"routes[{lack.route}].trips[{lack.trip}]")
