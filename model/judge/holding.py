"""Trips held until nothing that is limited lasts too long, and no storm is met."""

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence

from model.judge.flown_trips import wait_for_calm
from model.problem import UNLIMITED, Problem, VehicleType
from model.solution import Stop, Trip, Visit


MOST_STOPS_TIMED_ANEW, FEWEST_TIMES = 8_000, 50
"""How many stops are timed anew, and how often all are in any case, until holding is given up."""


def held(problem: Problem, kind: VehicleType, soonest: Trip, begun_at: Callable[[int], Trip],
         excess_of: Callable[[Trip], int]) -> tuple[Trip, bool]:
    """Return a trip that begins late enough for nothing to last too long, and whether that helps.

    What lasts too long has to begin at least so much later. Where all else is as much later then,
    that doesn't help: nothing does until a window or a speed turns what follows.

    Parameters
    ----------
    soonest
        The trip begun as soon as it can be.
    begun_at
        Returns the trip begun then.
    excess_of
        Returns by how much a trip would have to begin later, at least.
    """
    trip, excess = soonest, max(0, excess_of(soonest))
    wait, best = excess or wait_for_calm(problem, kind, trip), trip
    for _ in range(max(FEWEST_TIMES, MOST_STOPS_TIMED_ANEW // len(trip.stops))):
        if not wait:
            return trip, True
        turn = time_to_turn(problem, kind, trip)
        trip, before = begun_at(trip.stops[0].arrival + wait), excess
        wait = excess = max(0, excess_of(trip))
        best = trip if excess < before else best
        if 0 < before <= excess and (turn > trip.stops[0].arrival or turn == UNLIMITED):
            turn = time_to_turn(problem, kind, trip)
            if turn == UNLIMITED:
                return best, False
            wait = max(excess, turn - trip.stops[0].arrival)
        wait = wait or wait_for_calm(problem, kind, trip)
    return best, False


def time_to_turn(problem: Problem, kind: VehicleType, trip: Trip) -> int:
    """Return when a trip would begin that, by being later, meets another window or speed first."""
    begin = trip.stops[0].arrival
    return min((begin + instant - time for time, instants in _met(problem, kind, trip)
                for instant in instants[bisect_right(instants, time):][:1]), default=UNLIMITED)


def _met(problem: Problem, kind: VehicleType,
         trip: Trip) -> Iterator[tuple[int, Sequence[int]]]:
    """Yield instants of a trip, each with those, in order, at which what follows is another."""
    changes = () if kind.speed_profile is None else kind.speed_profile.times
    for stop in trip.stops:
        yield stop.arrival, changes
        yield stop.departure, changes
    visits: list[Stop | Visit] = [*trip.stops]
    visits += [visit for sortie in trip.sorties for visit in sortie.visits]
    for visit in visits:
        if visit.node >= problem.num_depots:
            customer = problem.customer_at(visit.node)
            yield visit.ready, sorted([customer.earliest, *(customer.span or ()), *(
                time for closes, opens in customer.gaps for time in (closes + 1, opens))])
