"""Breaks between two stops: when they begin, and which of them a route has to have.

A break lies between two stops of a trip: where the truck leaves, on its way, or where it arrives,
before it is ready to serve. No launch, recovery or service falls into it. It begins as soon as its
window opens. Times in ms.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from model.judge.clock import leg_end, work_between, work_end
from model.judge.loads import trip_loads
from model.problem import FULL_SPEED, REST, Break, Problem, VehicleType
from model.solution import BreakPlace, Route, Stop, TakenBreak, Trip

ON_A_LEG: tuple[BreakPlace, ...] = "departure", "way", "arrival"
"""In which order breaks lie between two stops."""


class BreakDecision(NamedTuple):
    """Which break is taken between which stops."""

    number: int  # index into VehicleType.breaks, or `REST`
    stop: int  # index of the stop before it
    place: BreakPlace
    driven: int = 0  # of a rest on the way: how long at the wheel since the break or stop before
    duration: int = 0  # of a rest


def decisions_of(trip: Trip) -> tuple[BreakDecision, ...]:
    """Return the choices that a timed trip states."""
    decisions, before = [], (-1, 0)
    for taken in trip.breaks:
        left = trip.stops[taken.stop].departure if before[0] != taken.stop else before[1]
        rest = (taken.arrival - left, taken.end - taken.start) if taken.number == REST else ()
        decisions.append(BreakDecision(taken.number, taken.stop, taken.place, *rest))
        before = taken.stop, taken.end
    return tuple(decisions)


def begin_of(kind: VehicleType, trip: Trip) -> int:
    """Return when the route begins whose first trip is given."""
    return trip.stops[0].arrival if kind.works_since is None else kind.works_since


def window_of(each: Break, begin: int) -> tuple[int, int]:
    """Return from and until when a break may begin on a route that begins then."""
    since = begin if each.after_departure else 0
    return since + each.earliest, since + each.latest


def drive(kind: VehicleType, begin: int, departure: int, duration: int,
          decisions: Iterable[BreakDecision]) -> tuple[int, list[TakenBreak]]:
    """Return when a leg that breaks interrupt ends, with the breaks, of which all are known."""
    profile = kind.speed_profile
    time, work, taken = departure, duration * FULL_SPEED, []
    for decision in decisions:
        if decision.place == "arrival":
            time, work = work_end(time, work, profile), 0
        if decision.number == REST:
            length = decision.duration
            start = time + (decision.driven if decision.place == "way" else 0)
            start = min(start, work_end(time, work, profile))
        else:
            length = kind.breaks[decision.number].duration
            start = max(time, window_of(kind.breaks[decision.number], begin)[0])
        stood = time
        if decision.place == "way":
            arrival = work_end(time, work, profile)
            work = 0 if arrival <= start else work - work_between(time, start, profile)
            stood = min(arrival, start)
        time = start + length
        taken.append(TakenBreak(decision.number, decision.stop, decision.place, stood, start, time))
    return work_end(time, work, profile), taken


def drive_on(kind: VehicleType, begin: int, stops: Sequence[Stop], duration: int,
             known: Iterable[TakenBreak],
             decisions: Iterable[BreakDecision]) -> tuple[int, list[TakenBreak]]:
    """Return when the leg from the last of some stops ends, with its breaks that are yet to come.

    Those that are known have taken their time; where nobody drives on, they are the end.
    """
    here = len(stops) - 1
    taken = [each for each in known if each.stop == here]
    if not taken:
        return drive(kind, begin, stops[here].departure, duration,
                     [each for each in decisions if each.stop == here])
    paused = sum([each.end - each.arrival for each in taken])
    end = leg_end(stops[here].departure + paused, duration, kind.speed_profile)
    return max(end, taken[-1].end), []


def broken_breaks(problem: Problem, kind: VehicleType,
                  trips: Sequence[Trip]) -> Iterator[tuple[int | None, str]]:
    """Yield what is wrong with the breaks of a route, each with the trip that it is on, if any."""
    begin, end = begin_of(kind, trips[0]), trips[-1].stops[-1].departure
    last = -1
    for index, trip in enumerate(trips):
        under_way: set[int] = set()
        for taken in trip.breaks:
            if taken.place == "way":
                under_way.add(taken.stop)
            if taken.number == REST:
                continue
            each = kind.breaks[taken.number]
            earliest, latest = window_of(each, begin)
            if taken.number <= last:
                yield index, f"break {each.id} comes after another that is stated behind it"
            last = max(last, taken.number)
            if not earliest <= taken.start <= latest:
                yield index, f"break {each.id} doesn't begin in its window"
            # Who has rested on the way isn't where it left any more.
            if taken.place != "arrival" and taken.stop in under_way and not each.anywhere:
                yield index, f"break {each.id} isn't at a stop"
            if each.max_load is not None and is_heavier(
                    trip_loads(problem, kind, trip)[taken.stop + 1], each.max_load):
                yield index, f"too much is aboard during break {each.id}"
    numbers = {taken.number for trip in trips for taken in trip.breaks}
    for number, each in enumerate(kind.breaks):
        if number not in numbers and is_due(each, begin, end):
            yield None, f"break {each.id} is not taken"


def is_heavier(load: Sequence[int], limit: Sequence[int]) -> bool:
    """Tell whether more of something is aboard than is allowed during a break."""
    return any(amount > most for amount, most in zip(load, limit, strict=True))


def is_due(each: Break, begin: int, end: int) -> bool:
    """Tell whether a break can neither be over before a route begins nor begin once it has ended.
    """
    earliest, latest = window_of(each, begin)
    return latest < end and earliest + each.duration > begin


def has_needless_break(problem: Problem, route: Route) -> bool:
    """Tell whether a route has a break that isn't due on it."""
    kind = problem.vehicle_types[route.vehicle_type]
    if not kind.breaks:
        return False
    begin, end = begin_of(kind, route.trips[0]), route.trips[-1].stops[-1].departure
    return any(taken.number != REST and not is_due(kind.breaks[taken.number], begin, end)
               for trip in route.trips for taken in trip.breaks)


def unpaid(kind: VehicleType, trips: Iterable[Trip]) -> int:
    """Return how long the breaks of a route are that don't count in the working duration."""
    return sum([taken.end - taken.start for trip in trips for taken in trip.breaks
                if taken.number != REST and not kind.breaks[taken.number].paid])
