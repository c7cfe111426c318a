"""The rules that a plan has to keep which begins with what has happened."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from model.judge.past import KnownSortie, KnownStop, KnownTrip, Past
from model.judge.rules import Violation, seconds
from model.problem import Problem
from model.solution import Route, Solution, Sortie, Stop, TakenBreak, Trip, Vehicle

PAST_RULES = frozenset({"FROZEN", "PAST", "UNAVAILABLE", "ABOARD", "PINNED", "ORDER", "RETURN"})
"""Codes of the rules here."""


def past_violations(problem: Problem, solution: Solution, past: Past) -> Iterator[Violation]:
    """What a plan breaks of the past."""
    routes = {route.driven_by: route for route in solution.routes}
    for vehicle, trips in past.trips.items():
        if vehicle not in routes:
            message = f"vehicle {vehicle.number + 1} has {len(trips)} trips behind it"
            yield Violation("FROZEN", message, "routes")
        elif len(routes[vehicle].trips) < len(trips):
            path = f"routes[{solution.routes.index(routes[vehicle])}]"
            yield Violation("FROZEN", f"{len(trips)} trips have begun", path)
    carriers = problem.at_all_places(past.carriers())
    for index, route in enumerate(solution.routes):
        yield from _route_violations(problem, route, past, carriers, f"routes[{index}]")


def _route_violations(problem: Problem, route: Route, past: Past, carriers: dict[int, Vehicle],
                      path: str) -> Iterator[Violation]:
    vehicle = route.driven_by
    known = past.trips.get(vehicle, ())
    if vehicle in past.unavailable and len(route.trips) > len(known):
        yield Violation("UNAVAILABLE", f"does nothing more from {seconds(past.now)} on", path)
    yield from _order_violations(problem, route, past, vehicle, path)
    yield from _after_violations(problem, route, past, vehicle, path)
    for number, trip in enumerate(route.trips):
        trip_path = f"{path}.trips[{number}]"
        begun = known[number] if number < len(known) else None
        if begun is not None and not begins_with(trip, begun):
            yield Violation("FROZEN", "differs from what has happened", trip_path)
        elif begun is None and trip.stops and trip.stops[0].arrival < past.now:
            message = f"begins at {seconds(trip.stops[0].arrival)}, before {seconds(past.now)}"
            yield Violation("PAST", message, trip_path)
        yield from _flight_violations(trip, begun, past, vehicle, trip_path)
        aboard = problem.all_places(() if begun is None else begun.aboard)
        for node in _new_customers(trip, begun):
            if not problem.num_depots <= node < problem.num_nodes:
                continue
            name = problem.customer_at(node).id
            if begun is not None and (begun.rest != "anything" or node not in aboard):
                yield Violation("ABOARD", f"the parcel of {name} is not aboard", trip_path)
            elif carriers.get(node, vehicle) != vehicle:
                yield Violation("ABOARD", f"the parcel of {name} is aboard another", trip_path)
            if past.pinned.get(node, vehicle) != vehicle:
                yield Violation("PINNED", f"{name} is another vehicle's", trip_path)
            back = past.returned.get(node, 0)
            if begun is None and trip.stops and trip.stops[0].arrival < back:
                message = f"the parcel of {name} is at the depot again at {seconds(back)}"
                yield Violation("RETURN", message, trip_path)


def _flight_violations(trip: Trip, begun: KnownTrip | None, past: Past, vehicle: Vehicle,
                       path: str) -> Iterator[Violation]:
    """Yield launches of drones that are grounded."""
    known, grounded = 0 if begun is None else len(begun.sorties), past.grounded_on(vehicle)
    for index, sortie in enumerate(trip.sorties):
        if index >= known and sortie.drone in grounded:
            message = f"drone {sortie.drone + 1} is launched no more from {seconds(past.now)} on"
            yield Violation("UNAVAILABLE", message, f"{path}.sorties[{index}]")


def _order_violations(problem: Problem, route: Route, past: Past, vehicle: Vehicle,
                      path: str) -> Iterator[Violation]:
    """Yield who isn't at the place in the order that it keeps, by when service starts."""
    places = {node: place for place, node in enumerate(past.orders.get(vehicle, ()))}
    if not places:
        return
    served = sorted((each for each in _served(route) if each.node in places),
                    key=lambda each: (each.start, each.stop or (), places[each.node]))
    for at, one in enumerate(served):
        if one.node not in past.pinned:
            continue
        place = places[one.node]
        before = [other for other in served[:at]
                  if other.precedes(one) and places[other.node] > place]
        after = [other for other in served[at:]
                 if one.precedes(other) and places[other.node] < place]
        for other in before[:1] or after[:1]:
            order = "after" if before else "before"
            message = (f"{problem.customer_at(one.node).id} is served {order} "
                       f"{problem.customer_at(other.node).id}")
            yield Violation("ORDER", message, path)


def _after_violations(problem: Problem, route: Route, past: Past, vehicle: Vehicle,
                       path: str) -> Iterator[Violation]:
    """Yield the new ones that come before somebody whom their vehicle had before."""
    had = past.had.get(vehicle)
    if not had:
        return
    served = [(problem.first_place(each.node), each) for each in _served(route)
              if problem.num_depots <= each.node < problem.num_nodes]
    there = [each for node, each in served if node in had]
    for node, one in served:
        if node in past.told:
            continue
        before = next((other for other in there if one.precedes(other)), None)
        if before is not None:
            name, other = (problem.customer_at(each.node).id for each in (one, before))
            yield Violation("ORDER", f"{name}, who is new, is served before {other}", path)


class _Served(NamedTuple):
    """A customer whom a route serves."""

    node: int
    start: int
    stop: tuple[int, int] | None  # trip, and stop of its truck; None: by a drone

    def precedes(self, other: "_Served") -> bool:
        """Tell whether this one is served before another; at an instant, by the truck's stops."""
        if self.start != other.start or self.stop is None or other.stop is None:
            return self.start < other.start
        return self.stop < other.stop


def _served(route: Route) -> Iterator[_Served]:
    for number, trip in enumerate(route.trips):
        for index, stop in enumerate(trip.customer_stops):
            yield _Served(stop.node, stop.service_start, (number, index))
        for sortie in trip.sorties:
            yield from (_Served(visit.node, visit.service_start, None) for visit in sortie.visits)


def _new_customers(trip: Trip, begun: KnownTrip | None) -> Iterator[int]:
    """Yield the customers of a trip of whom nothing was known."""
    stops, flights = (0, 0) if begun is None else (len(begun.stops), len(begun.sorties))
    yield from (stop.node for stop in trip.stops[max(1, stops):-1] if not stop.is_launch_site)
    for sortie in trip.sorties[flights:]:
        yield from (visit.node for visit in sortie.visits)


def begins_with(trip: Trip, known: KnownTrip) -> bool:
    """Tell whether a trip begins with what is known of it."""
    flights, length = len(known.sorties), len(known.stops)
    if known.rest == "anything":
        fits = len(trip.stops) >= length
    else:
        fits = (len(trip.stops) == length + (known.rest == "home")
                and (len(trip.sorties), len(trip.breaks)) == (flights, len(known.breaks)))
    return (fits and len(trip.sorties) >= flights
            and len(trip.breaks) >= len(known.breaks)
            and all(map(_is_break, trip.breaks, known.breaks))
            and all(map(_is_stop, trip.stops, known.stops))
            and all(_is_sortie(sortie, fact, trip, length)
                    for sortie, fact in zip(trip.sorties, known.sorties, strict=False)))


def _is_stop(stop: Stop, known: KnownStop) -> bool:
    return (stop.node == known.node and stop.arrival == known.arrival
            and known.service_start in (None, stop.service_start)
            and known.departure in (None, stop.departure))


def _is_break(taken: TakenBreak, known: TakenBreak) -> bool:
    """Tell whether two breaks are one; where on its leg follows from where that leads now."""
    return replace(taken, place=known.place) == known


def _is_sortie(sortie: Sortie, known: KnownSortie, trip: Trip, known_stops: int) -> bool:
    if not known_stops <= sortie.recovery_stop < len(trip.stops):
        is_there = sortie.recovery_stop == known.recovery_stop
    else:
        is_there = (known.recovery_stop is None
                    and trip.stops[sortie.recovery_stop].node == known.recovery_node)
    return (is_there and (sortie.drone, sortie.launch_stop, sortie.visits,
                          sortie.launch_time) == known[:4]
            and known.recovery_start in (None, sortie.recovery_start))
