"""Who is served before whom, by one vehicle or any, and how much later the other is."""

from collections.abc import Container, Iterable, Mapping
from itertools import chain
from typing import NamedTuple, Protocol

from model.problem import SINCE_PLAN_START, Problem
from model.solution import Route, Stop, Trip, Visit


class Awaited(NamedTuple):
    """Until when a truck waits at a customer, for whoever others serve before or behind."""

    node: int
    until: int


def waits_of(trip: Trip, bound: Container[int]) -> tuple[Awaited, ...]:
    """Return until when a truck waits, as a trip states, at those of orders across vehicles."""
    return tuple([Awaited(stop.node, stop.service_start) for stop in trip.customer_stops
                  if stop.node in bound]) if bound else ()


def starts_of(visits: Iterable[Stop | Visit]) -> dict[int, int]:
    """Return when service begins at the nodes of some visits."""
    return {visit.node: visit.service_start for visit in visits}


def starts_across(problem: Problem, route: Route) -> dict[int, int]:
    """Return when service begins at those whom a route serves of orders across vehicles."""
    if not problem.lags_across:
        return {}
    return {node: start for node, start in starts_of(route.visits).items()
            if node in problem.lags_across}


def soonest_across(problem: Problem, routes: Iterable[Route], node: int) -> int:
    """Return when service at a customer may begin at the soonest, for those whom routes serve."""
    starts = {other: start for route in routes
              for other, start in starts_across(problem, route).items()}
    return soonest_after(problem, node, starts)


def soonest_after(problem: Problem, node: int, starts: Mapping[int, int]) -> int:
    """Return the same by when service begins at others, and who was served before the plan."""
    since = {SINCE_PLAN_START: 0, **starts}
    return max([since[lag.node] + lag.least for lag in problem.lags_across.get(node, ())
                if lag.node in since], default=0)


class Flown(Protocol):
    """A flight that has taken off, timed or about to be."""

    visits: tuple[Visit, ...]


def awaited(problem: Problem, node: int, before: Iterable[Trip], stops: Iterable[Stop],
            flights: Mapping[int, Flown], chosen: Iterable[Awaited] = ()) -> int:
    """Return until when a truck waits at a customer for those who are served some time before.

    They are so on trips before, or on stops and flights of the same trip; `chosen` is how long it
    waits for others.
    """
    if node not in problem.lags and node not in problem.lags_across:
        return 0
    starts = starts_of(chain(*[trip.visits for trip in before], stops,
                             *[flight.visits for flight in flights.values()]))
    return max([soonest_after(problem, node, {}),
                *(each.until for each in chosen if each.node == node),
                *(starts[lag.node] + lag.least for lag in problem.lags.get(node, ())
                  if lag.node in starts)])


def excess_of_lags(problem: Problem, trip: Trip) -> int:
    """Return by how much a customer of a trip is served too long after another; 0 if none is."""
    if not problem.lags:
        return 0
    starts = starts_of(trip.visits)
    return max([0, *(start - starts[lag.node] - lag.most for node, start in starts.items()
                     for lag in problem.lags.get(node, ()) if lag.node in starts)])
