"""What is to be expected of a plan's promises: chances of being late, and when who comes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from model.judge.clock import closing
from model.counsel.lateness.drawn import DAYS, DrawnDays, Spread
from model.counsel.lateness.simulation import Encounter, TripEncounters, drive_route
from model.problem import MS_PER_HOUR, UNLIMITED, Problem
from model.solution import Route, Solution

SEED = 64
"""Of all draws: a plan is told the same chances again."""

EARLY, LATE = 0.1, 0.9
"""Shares of days on which who comes has come by then."""


@dataclass(frozen=True)
class Expectation:
    """What is to be expected at a customer."""

    chance: float | None  # of being late for the window; None: it doesn't end
    expected: float  # ms of lateness in the mean
    deviation: float  # ms, standard, of the start of service
    early: int  # ms: on a tenth of all days who comes has come by then
    late: int  # ms: on nine tenths


@dataclass(frozen=True)
class TripOutlook:
    """What is to be expected at a trip's customers, by truck in order, and by sortie."""

    stops: tuple[Expectation, ...]
    sorties: tuple[tuple[Expectation, ...], ...]


def outlook(problem: Problem, route: Route, spread: Spread, now: int = 0,
            number: int = 0) -> list[TripOutlook]:
    """Return what is to be expected of a timed route, trip by trip.

    What lies before `now` has happened as planned; routes of another `number` are drawn otherwise.
    """
    drawn = DrawnDays((SEED, number), now, problem.vehicle_types[route.vehicle_type].speed_profile)
    trips = drive_route(problem, route, spread, drawn)
    told = iter(_told(problem, [met for trip in trips for met in trip]))

    def of(met: Sequence[Encounter]) -> tuple[Expectation, ...]:
        return tuple([next(told) for _ in met])

    def of_trip(trip: TripEncounters) -> TripOutlook:
        return TripOutlook(of(trip.stops), tuple([of(visits) for visits in trip.sorties]))

    return [of_trip(trip) for trip in trips]


def expectations(problem: Problem, plan: Solution, spread: Spread,
                 now: int = 0) -> Iterator[tuple[int, Expectation]]:
    """Yield what is to be expected of a plan, by the nodes of its customers."""
    for number, route in enumerate(plan.routes):
        trips = outlook(problem, route, spread, now, number)
        for trip, told in zip(route.trips, trips, strict=True):
            stops = [stop for stop in trip.stops if stop.node >= problem.num_depots]
            yield from zip([stop.node for stop in stops], told.stops, strict=True)
            for sortie, visits in zip(trip.sorties, told.sorties, strict=True):
                yield from zip(sortie.nodes, visits, strict=True)


def late_hours(problem: Problem, plan: Solution, spread: Spread, now: int = 0) -> float:
    """Return the hours of lateness to be expected of a plan, over all customers."""
    return sum([each.expected for _, each in expectations(problem, plan, spread, now)]
               ) / MS_PER_HOUR


def _told(problem: Problem, met: Sequence[Encounter]) -> list[Expectation]:
    if not met:
        return []
    starts = np.stack([each.starts[1:] for each in met])
    closes = [closing(problem.customer_at(each.visit.node), each.visit.service_start)
              for each in met]
    late = starts - np.array(closes, float)[:, None]
    chances = np.count_nonzero(late > 0, axis=1) / DAYS
    expected = np.maximum(late, 0.0).mean(axis=1)
    deviations = starts.std(axis=1)
    first, last = round(EARLY * DAYS), round(LATE * DAYS) - 1
    arrivals = np.partition(np.stack([each.arrivals[1:] for each in met]), (first, last), axis=1)
    return [Expectation(None if close >= UNLIMITED else chance, mean, deviation, round(early),
                    round(latest))
            for close, chance, mean, deviation, early, latest in zip(
                closes, chances.tolist(), expected.tolist(), deviations.tolist(),
                arrivals[:, first].tolist(), arrivals[:, last].tolist(), strict=True)]
