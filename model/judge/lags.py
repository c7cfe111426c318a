"""Who is served before whom by one vehicle, and how much later the other is."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Protocol

from model.problem import Problem
from model.solution import Stop, Trip, Visit


def starts_of(halts: Iterable[Stop | Visit]) -> dict[int, int]:
    """Return when service begins at the nodes of some halts."""
    return {halt.node: halt.service_start for halt in halts}


def halts_of(trips: Iterable[Trip]) -> Iterator[Stop | Visit]:
    """Yield where customers are served on some trips."""
    for trip in trips:
        yield from trip.customer_stops
        yield from chain.from_iterable([sortie.visits for sortie in trip.sorties])


class Flown(Protocol):
    """A flight that has taken off, timed or about to be."""

    visits: tuple[Visit, ...]


def awaited(problem: Problem, node: int, before: Iterable[Trip], stops: Iterable[Stop],
            flights: Mapping[int, Flown]) -> int:
    """Return until when a truck waits at a customer for those who are served some time before.

    They are so on trips before, or on stops and flights of the same trip.
    """
    if node not in problem.lags:
        return 0
    starts = starts_of(chain(halts_of(before), stops,
                             *[flight.visits for flight in flights.values()]))
    return max([starts[lag.node] + lag.least for lag in problem.lags[node] if lag.node in starts],
               default=0)


def excess_of_lags(problem: Problem, trip: Trip) -> int:
    """Return by how much a customer of a trip is served too long after another; 0 if none is."""
    if not problem.lags:
        return 0
    starts = starts_of(halts_of((trip,)))
    return max([0, *(start - starts[lag.node] - lag.most for node, start in starts.items()
                     for lag in problem.lags.get(node, ()) if lag.node in starts)])
