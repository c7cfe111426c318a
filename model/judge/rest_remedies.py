"""What breaks and driving rules would have to be for a trip on which one customer is tried alone.

Each change is tried: the trip is planned and judged again.
"""

from collections.abc import Iterator
from dataclasses import replace

from model.judge.breaks import begin_of, window_of
from model.judge.clock import MS_PER_MINUTE
from model.judge.diagnosis import in_minutes, up_to_tenth, with_type
from model.judge.driving import travel_duration
from model.judge.loads import trip_loads
from model.judge.rules import amounts
from model.judge.trial import Attempt, again
from model.problem import MAX_QUANTITY, Break, VehicleType
from model.solution import Trip

Change = tuple[str, VehicleType]


def rest_remedy(attempt: Attempt) -> str | None:
    """Return the least change of breaks or driving rules that suffices; None: none does."""
    kind = attempt.vehicle_type
    if not kind.breaks and kind.driving is None:
        return None
    free = again(attempt, with_type(attempt, replace(kind, breaks=(), driving=None)))
    if free.codes:
        return None
    return next((words for words, changed in _changes(attempt, free.solution.routes[0].trips[0])
                 if not again(attempt, with_type(attempt, changed)).codes), None)


def _changes(attempt: Attempt, free: Trip) -> Iterator[Change]:
    """Yield what may be changed, the least first, and the type as it then is.

    Parameters
    ----------
    free
        The trip without breaks.
    """
    kind = attempt.vehicle_type
    for number, each in enumerate(kind.breaks):
        for words, changed in (*_heavier(attempt, each, free), *_later(kind, each, free)):
            yield words, replace(kind, breaks=(*kind.breaks[:number], changed,
                                               *kind.breaks[number + 1:]))
    for number, each in enumerate(kind.breaks):
        yield (f"fits without break {each.id}",
               replace(kind, breaks=(*kind.breaks[:number], *kind.breaks[number + 1:])))
    yield from _longer_spells(kind, free)


def _heavier(attempt: Attempt, each: Break, free: Trip) -> Iterator[tuple[str, Break]]:
    """Yield a break with more aboard."""
    if each.max_load is None:
        return
    loads = {tuple(map(max, load, each.max_load))
             for load in trip_loads(attempt.problem, attempt.vehicle_type, free)}
    for load in sorted(loads - {each.max_load}, key=sum):
        yield (f"fits if break {each.id} allowed {amounts(attempt.problem, load)} aboard",
               replace(each, max_load=load))


def _later(kind: VehicleType, each: Break, free: Trip) -> Iterator[tuple[str, Break]]:
    """Yield a break that may begin later: as a stop of the trip is reached or left, or it ends."""
    _, closes = window_of(each, begin_of(kind, free))
    for moment in sorted({time for stop in free.stops for time in (stop.arrival, stop.departure)}):
        later = up_to_tenth(moment - closes, MS_PER_MINUTE)
        if later > 0 and each.latest + later <= MAX_QUANTITY:
            yield (f"fits if break {each.id} could begin {in_minutes(later)} later",
                   replace(each, latest=each.latest + later))


def _longer_spells(kind: VehicleType, free: Trip) -> Iterator[Change]:
    """Yield driving rules that ask for no rest on the trip."""
    rules = kind.driving
    if rules is None:
        return
    if not rules.while_drones_fly and free.sorties:
        yield (f"fits if {kind.id}'s drivers may rest while drones fly",
               replace(kind, driving=replace(rules, while_drones_fly=True)))
    driven = up_to_tenth(rules.driven_before + travel_duration((free,)), MS_PER_MINUTE)
    if rules.max_driving < driven <= MAX_QUANTITY:
        yield (f"fits if {kind.id}'s drivers could drive {in_minutes(driven)} without a rest",
               replace(kind, driving=replace(rules, max_driving=driven)))
    worked = up_to_tenth(rules.worked_before + free.stops[-1].departure - begin_of(kind, free),
                         MS_PER_MINUTE)
    if rules.max_work < worked <= MAX_QUANTITY:
        yield (f"fits if {kind.id}'s drivers could work {in_minutes(worked)} without a rest",
               replace(kind, driving=replace(rules, max_work=worked)))
