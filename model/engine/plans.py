"""Plans to and from the engine, as the numbers that `tandem.h` tells the order of."""

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

import numpy as np

from model.engine.handle import Handle
from model.engine.header import interface
from model.engine.lent import lent_rows
from model.engine.library import call
from model.problem import IntArray
from model.solution import BreakPlace, Charge, Route, Sortie, Stop, TakenBreak, Trip, Visit

PLACES: tuple[BreakPlace, ...] = "departure", "way", "arrival"


def told(name: str, *args: Any) -> tuple[Route, ...]:
    """Return the routes that a function of the engine tells, given all it takes but a plan."""
    plan, seen = Handle("plan"), interface().new("tandem_i64_1d *")
    call(name, *args, plan)
    call("tandem_numbers_of", plan, seen)
    return tuple(_routes(iter(lent_rows(seen, plan).tolist())))


def numbers_of(routes: Iterable[Route]) -> IntArray:
    """Return routes as the engine takes them."""
    return np.fromiter((number for route in routes for number in _route(route)), np.int64)


def _routes(numbers: Iterator[int]) -> Iterator[Route]:
    for kind in numbers:
        vehicle, trips = islice(numbers, 2)
        yield Route(kind, vehicle, tuple([_trip(numbers) for _ in range(trips)]))


def _trip(numbers: Iterator[int]) -> Trip:
    since, until, stops, sorties, breaks = islice(numbers, 5)
    return Trip(tuple([_stop(*islice(numbers, 6)) for _ in range(stops)]),
                tuple([_sortie(numbers) for _ in range(sorties)]),
                tuple([_break(*islice(numbers, 6)) for _ in range(breaks)]),
                (Charge(since, until),) if since < until else ())


def _stop(node: int, arrival: int, start: int, departure: int, setup: int, is_site: int) -> Stop:
    return Stop(node, arrival, start, departure, setup, bool(is_site))


def _sortie(numbers: Iterator[int]) -> Sortie:
    drone, launch, recovery, takeoff, begin, end, visits = islice(numbers, 7)
    return Sortie(drone, launch, recovery,
                  tuple([Visit(*[*islice(numbers, 6)][:5]) for _ in range(visits)]),
                  takeoff, begin, end)


def _break(number: int, stop: int, place: int, arrival: int, start: int, end: int) -> TakenBreak:
    return TakenBreak(number, stop, PLACES[place], arrival, start, end)


def _route(route: Route) -> Iterator[int]:
    yield from (route.vehicle_type, route.vehicle, len(route.trips))
    for trip in route.trips:
        # Who is charged in turn once before each trip at most: if in pieces, it is timed anew.
        yield from trip.charges[0] if len(trip.charges) == 1 else (0, 0)
        yield from (len(trip.stops), len(trip.sorties), len(trip.breaks))
        for stop in trip.stops:
            yield from _visited(stop, stop.is_launch_site)
        for sortie in sorted(trip.sorties, key=lambda each: (
                each.launch_stop, each.launch_time, each.recovery_stop)):
            yield from (sortie.drone, sortie.launch_stop, sortie.recovery_stop, sortie.launch_time,
                        sortie.recovery_start, sortie.recovery_time, len(sortie.visits))
            for visit in sortie.visits:
                yield from _visited(visit, False)
        for each in trip.breaks:
            yield from (each.number, each.stop, PLACES.index(each.place),
                        each.arrival, each.start, each.end)


def _visited(at: Stop | Visit, is_launch_site: bool) -> tuple[int, ...]:
    return at.node, at.arrival, at.service_start, at.departure, at.setup, is_launch_site
