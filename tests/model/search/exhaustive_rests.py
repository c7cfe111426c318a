"""All ways to put breaks and rests between the stops of a route, and when it may begin then."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, product

from model.judge.breaks import BreakDecision
from model.judge.timing import TripDecision
from model.problem import REST, Problem, VehicleType
from model.solution import BreakPlace

MINUTE = 60_000

MOST_RESTS = 2
"""Rests of a driver that are tried."""

Trips = tuple[TripDecision, ...]
Place = tuple[int, int, BreakPlace]  # trip, stop before, where


def rested(problem: Problem, kind: VehicleType, trips: Trips) -> Iterator[Trips]:
    """Yield a route with all breaks that its driver might take, whole minutes at the wheel before.
    """
    most = MOST_RESTS if kind.driving is not None else 0
    for size in range(len(kind.breaks) + 1):
        for numbers in combinations(range(len(kind.breaks)), size):
            for rests in range(most + 1):
                yield from _with_rests(problem, kind, trips, numbers, rests)


def _places(trips: Trips) -> Iterator[Place]:
    for index, trip in enumerate(trips):
        for stop in range(len(trip.nodes) - 1):
            for place in ("departure", "way", "arrival"):
                yield index, stop, place  # type: ignore[misc]


def _with_rests(problem: Problem, kind: VehicleType, trips: Trips, numbers: tuple[int, ...],
                rests: int) -> Iterator[Trips]:
    """Yield a route with those breaks, in order, and so many rests."""
    places = list(_places(trips))
    options = list[tuple[Place, BreakDecision]]()
    for index, stop, place in places if rests else ():
        nodes = trips[index].nodes
        leg = problem.travel[kind.travel].duration.item(nodes[stop], nodes[stop + 1])
        # At the end of a leg it is as at the stop behind.
        driven = range(MINUTE, leg, MINUTE) if place == "way" else range(1)
        options += [((index, stop, place), BreakDecision(REST, stop, place, done, length))
                    for done in driven for length in _lengths(kind)]
    order = {place: rank for rank, place in enumerate(places)}
    stated = [[(place, BreakDecision(number, place[1], place[2])) for place in places]
              for number in numbers]
    for which in combinations(range(len(numbers) + rests), rests):
        left = iter(stated)
        ways = [options if turn in which else next(left) for turn in range(len(numbers) + rests)]
        for chosen in product(*ways):
            ranks = [order[place] for place, _ in chosen]
            if ranks == sorted(ranks):
                yield _put(trips, list(chosen))


def _lengths(kind: VehicleType) -> list[int]:
    assert kind.driving is not None
    return sorted({kind.driving.rest, *kind.driving.split})


def least_rest(kind: VehicleType, trips: Trips) -> int:
    """Return how long the breaks of a route are that count in the working duration."""
    return sum([taken.duration if taken.number == REST else kind.breaks[taken.number].duration
                for trip in trips for taken in trip.breaks
                if taken.number == REST or kind.breaks[taken.number].paid])


def _put(trips: Trips, taken: list[tuple[Place, BreakDecision]]) -> Trips:
    return tuple([replace(trip, breaks=tuple([decision for (at, _, _), decision in taken
                                              if at == index]))
                  for index, trip in enumerate(trips)])
