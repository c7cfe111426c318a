"""Trips that are made to their end as planned, of vehicles that are later than that.

What is stated of stops that are yet to come may be sooner than these can be reached. Then all that
follows the stop that a vehicle is bound for is timed anew; what it breaks it breaks. How long it
stays at that stop counts as stated, if that is long enough.
"""

from collections.abc import Collection, Iterator
from dataclasses import replace
from itertools import groupby, takewhile

from model.judge.past import KnownStop, KnownTrip, bound_until, known_trip
from model.judge.timing import read_decision, resume_trip
from model.problem import Problem, VehicleType
from model.replanning.kept import by_launch
from model.solution import BreakPlace, Route, Solution, TakenBreak, Trip, Vehicle


def as_late(problem: Problem, plan: Solution, now: int,
            unavailable: Collection[Vehicle]) -> Solution:
    """Return a plan in which vehicles that are late on such trips come later to what follows.

    Those that break down do nothing more but land where they fly.
    """
    return replace(plan, routes=tuple([
        route if route.driven_by in unavailable
        and not problem.vehicle_types[route.vehicle_type].flies
        else _as_late(problem, route, now) for route in plan.routes]))


def _as_late(problem: Problem, route: Route, now: int) -> Route:
    kind, trips = problem.vehicle_types[route.vehicle_type], list(route.trips)
    for index, trip in enumerate(trips):
        known = known_trip(problem, kind, trip, now)
        if known is None:
            break
        if known.rest == "anything" and bound_until(problem, kind, trip, now) > now and all(
                node >= 0 for node in trip.nodes):
            timed = _resumed(problem, kind, trip, known, now, trips[:index])
            if _is_later(timed, trip):
                trips[index] = timed
    return replace(route, trips=tuple(trips))


def _resumed(problem: Problem, kind: VehicleType, trip: Trip, known: KnownTrip, now: int,
             before: list[Trip]) -> Trip:
    """Return a trip as it goes on from where its vehicle is bound for, as soon as possible."""
    launched, others = by_launch(trip, known)
    ordered = replace(trip, sorties=(*launched, *others))
    decision = read_decision(ordered, kind, problem.lags_across)
    *stops, bound = known.stops
    stated = trip.stops[len(stops)]

    def resumed(there: KnownStop) -> Trip:
        told = replace(known, stops=(*stops, there))
        return resume_trip(problem, kind, decision, told, now, before)

    if bound.service_start is None:
        begun = resumed(bound).stops[len(stops)].service_start
        bound = bound._replace(service_start=max(stated.service_start, begun))
    left = resumed(bound).stops[len(stops)].departure
    bound = bound._replace(departure=max(stated.departure, left))
    timed = resumed(bound)
    return replace(timed, breaks=tuple(_placed(timed)), charges=trip.charges)


def _placed(trip: Trip) -> Iterator[TakenBreak]:
    """Yield the breaks of a trip at the places that their times tell, as plans are read."""
    for _, group in groupby(trip.breaks, key=lambda taken: taken.stop):
        breaks = list(group)
        first, last = trip.stops[breaks[0].stop:][:2]
        begins = [first.departure, *(taken.end for taken in breaks)]
        ends = [*(taken.arrival for taken in breaks[1:]), last.arrival]
        leaving = sum(1 for _ in takewhile(
            lambda each: each[0].arrival == each[1], zip(breaks, begins, strict=False)))
        coming = sum(1 for _ in takewhile(
            lambda each: each[0].end == each[1], zip(reversed(breaks), reversed(ends),
                                                     strict=True)))
        for place, taken in enumerate(breaks):
            where: BreakPlace = "departure" if place < leaving else (
                "arrival" if place >= len(breaks) - coming else "way")
            yield replace(taken, place=where)


def _is_later(timed: Trip, stated: Trip) -> bool:
    """Tell whether any stop is reached, served or left later than stated."""
    return any(one > other for mine, given in zip(timed.stops, stated.stops, strict=True)
               for one, other in zip(
                   (mine.arrival, mine.service_start, mine.departure),
                   (given.arrival, given.service_start, given.departure), strict=True))
