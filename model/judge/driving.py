"""How long drivers are at the wheel, and at work, and whether they rest in between.

All that is not a rest, or a part of one, is work, waiting and short breaks included. Times in ms.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from model.judge.breaks import begin_of
from model.problem import REST, DrivingRules, Problem, VehicleType
from model.solution import Sortie, Trip


class Spell(NamedTuple):
    """A time at the wheel, or a break, on the way from a stop of a trip."""

    begin: int
    end: int
    is_break: bool
    stop: int  # index of the stop before it


def spells(trip: Trip) -> Iterator[Spell]:
    """Yield what a driver does between the stops of a trip, in order."""
    for stop, (here, there) in enumerate(zip(trip.stops, trip.stops[1:], strict=False)):
        left = here.departure
        for taken in trip.breaks:
            if taken.stop == stop:
                yield Spell(left, taken.arrival, False, stop)
                yield Spell(taken.start, taken.end, True, stop)
                left = taken.end
        yield Spell(left, there.arrival, False, stop)


def travel_duration(trips: Iterable[Trip]) -> int:
    """Return how long a truck is on the legs of its trips."""
    return sum([spell.end - spell.begin for trip in trips for spell in spells(trip)
                if not spell.is_break])


def limited_distance(problem: Problem, kind: VehicleType, trips: Sequence[Trip]) -> int:
    """Return how far a truck drives on all its trips, as that is limited."""
    legs = problem.travel[kind.travel if kind.limited is None else kind.limited].distance
    return sum([legs.item(here.node, there.node)
                for trip in trips for here, there in pairwise(trip.stops)])


class Driver:
    """What is counted of a driver since the last rest."""

    def __init__(self, rules: DrivingRules, begin: int) -> None:
        self._rules = rules
        self.driven = rules.driven_before
        self.day = rules.driven_before
        self.is_half_rested = rules.half_rested_before
        self._since = begin - rules.worked_before
        self._stands_since = begin  # not at the wheel

    def worked(self, now: int) -> int:
        """Return how long it has been at work."""
        return now - self._since

    def driven_by(self, now: int) -> int:
        """Return how long it has been at the wheel that counts if it drives on then."""
        is_interrupted = (self._rules.other_work_interrupts
                          and now - self._stands_since >= self._rules.rest)
        return 0 if is_interrupted else self.driven

    def drive(self, begin: int, end: int) -> None:
        """Be at the wheel. In place."""
        if begin == end:
            return
        self.driven = self.driven_by(begin) + end - begin
        self.day += end - begin
        self._stands_since = end

    def pause(self, begin: int, end: int) -> None:
        """Take a break, which may be a rest, or a part of one. In place."""
        length, split = end - begin, self._rules.split
        if length >= self._rules.rest or (self.is_half_rested and length >= split[1]):
            self.driven, self.is_half_rested, self._since = 0, False, end
            return
        if split and length >= split[0]:
            self._since += length
            self.is_half_rested = True


def driver_after(rules: DrivingRules, kind: VehicleType, trips: Sequence[Trip]) -> Driver:
    """Return what is counted of the driver of a route once its trips are over."""
    driver = Driver(rules, begin_of(kind, trips[0]))
    for spell in (spell for trip in trips for spell in spells(trip)):
        if spell.is_break:
            driver.pause(spell.begin, spell.end)
        else:
            driver.drive(spell.begin, spell.end)
    return driver


class Excess(NamedTuple):
    """Too much of something, in ms, on the way from a stop."""

    trip: int
    stop: int
    what: str  # "driving", "day" or "work"
    excess: int


def excesses(kind: VehicleType, trips: Sequence[Trip]) -> Iterator[Excess]:
    """Yield where the driver of a route drives or works for too long."""
    rules = kind.driving
    if rules is None:
        return
    driver = Driver(rules, begin_of(kind, trips[0]))
    index = 0
    for index, trip in enumerate(trips):
        for spell in spells(trip):
            if spell.is_break:
                yield from _positive(index, spell.stop, "work",
                                     driver.worked(spell.begin) - rules.max_work)
                driver.pause(spell.begin, spell.end)
                continue
            driver.drive(spell.begin, spell.end)
            yield from _positive(index, spell.stop, "driving", driver.driven - rules.max_driving)
            yield from _positive(index, spell.stop, "work",
                                 driver.worked(spell.end) - rules.max_work)
    last = trips[-1].stops
    yield from _positive(index, len(last) - 2, "work",
                         driver.worked(last[-1].departure) - rules.max_work)
    yield from _positive(index, len(last) - 2, "day", driver.day - rules.max_driving_per_day)


def _positive(trip: int, stop: int, what: str, excess: int) -> Iterable[Excess]:
    return [Excess(trip, stop, what, excess)] if excess > 0 else []


def is_out(sorties: Iterable[Sortie], stop: int) -> bool:
    """Tell whether a drone is out behind a stop."""
    return any(sortie.launch_stop <= stop < sortie.recovery_stop for sortie in sorties)


WORDS = {
    "driving": "its driver is at the wheel {} longer than allowed without a rest",
    "day": "its driver is at the wheel {} longer than allowed in a day",
    "work": "its driver is at work {} longer than allowed without a rest",
}


def broken_driving(kind: VehicleType, trips: Sequence[Trip]) -> Iterator[tuple[int, str]]:
    """Yield what is wrong with a route's driving, each kind at its first trip."""
    if kind.driving is not None and not kind.driving.while_drones_fly:
        for index, trip in enumerate(trips):
            if any(taken.number == REST and is_out(trip.sorties, taken.stop)
                   for taken in trip.breaks):
                yield index, "its driver rests while a drone is out"
    told: set[str] = set()
    for excess in excesses(kind, trips):
        if excess.what not in told:
            told.add(excess.what)
            yield excess.trip, WORDS[excess.what].format(f"{excess.excess / 1000:g} s")
