"""What breaks and driving rules would have to be for a trip on which one customer is tried alone.

Each change is tried: the trip is planned and judged again.
"""

from collections.abc import Iterator
from dataclasses import replace

from model.counsel.diagnosis import more_of, up_to_tenth, with_type
from model.counsel.remedy import Change, Part, in_units
from model.counsel.trial import Attempt, again
from model.judge.breaks import begin_of, window_of
from model.judge.clock import MS_PER_MINUTE
from model.judge.driving import travel_duration
from model.judge.loads import trip_loads
from model.problem import MAX_QUANTITY, Break, VehicleType
from model.solution import Trip

Tried = tuple[Change, VehicleType]


def rest_remedy(attempt: Attempt) -> Part:
    """Return the least change of breaks or driving rules that suffices, if one does."""
    kind = attempt.vehicle_type
    if not kind.breaks and kind.driving is None:
        return ()
    free = again(attempt, with_type(attempt, replace(kind, breaks=(), driving=None)))
    if free.codes:
        return ()
    return next(((change,) for change, changed
                 in _changes(attempt, free.solution.routes[0].trips[0])
                 if not again(attempt, with_type(attempt, changed)).codes), ())


def _changes(attempt: Attempt, free: Trip) -> Iterator[Tried]:
    """Yield what may be changed, the least first, and the type as it then is.

    Parameters
    ----------
    free
        The trip without breaks.
    """
    kind = attempt.vehicle_type
    for number, each in enumerate(kind.breaks):
        for change, changed in (*_heavier(attempt, each, free), *_later(kind, each, free)):
            yield change, replace(kind, breaks=(*kind.breaks[:number], changed,
                                               *kind.breaks[number + 1:]))
    for number, each in enumerate(kind.breaks):
        yield (Change("break", each.id),
               replace(kind, breaks=(*kind.breaks[:number], *kind.breaks[number + 1:])))
    yield from _longer_spells(kind, free)


def _heavier(attempt: Attempt, each: Break, free: Trip) -> Iterator[tuple[Change, Break]]:
    """Yield a break with more aboard."""
    if each.max_load is None:
        return
    loads = {tuple(map(max, load, each.max_load))
             for load in trip_loads(attempt.problem, attempt.vehicle_type, free)}
    for load in sorted(loads - {each.max_load}, key=sum):
        yield (Change("break_load", each.id, amounts=in_units(attempt.problem, load)),
               replace(each, max_load=load))


def _later(kind: VehicleType, each: Break, free: Trip) -> Iterator[tuple[Change, Break]]:
    """Yield a break that may begin later: as a stop of the trip is reached or left, or it ends."""
    _, closes = window_of(each, begin_of(kind, free))
    for moment in sorted({time for stop in free.stops for time in (stop.arrival, stop.departure)}):
        later = up_to_tenth(moment - closes, MS_PER_MINUTE)
        if later > 0 and each.latest + later <= MAX_QUANTITY:
            yield (Change("break_start", each.id, later),
                   replace(each, latest=each.latest + later))


def _longer_spells(kind: VehicleType, free: Trip) -> Iterator[Tried]:
    """Yield driving rules that ask for no rest on the trip."""
    rules = kind.driving
    if rules is None:
        return
    if not rules.while_drones_fly and free.sorties:
        yield (Change("rests_in_flight", kind.id),
               replace(kind, driving=replace(rules, while_drones_fly=True)))
    driven = up_to_tenth(rules.driven_before + travel_duration((free,)), MS_PER_MINUTE)
    worked = up_to_tenth(rules.worked_before + free.stops[-1].departure - begin_of(kind, free),
                         MS_PER_MINUTE)
    for name, most, needed in (("driving", rules.max_driving, driven),
                               ("work_spell", rules.max_work, worked)):
        if most < needed:
            part, longer = more_of(name, kind, needed - most, kind.id)
            yield from ((change, longer) for change in part)
