"""Where on a timed route one more break is likely best, told without timing the route anew.

What follows a break is later by as much as it takes, less each wait on the way: forward slack
(Savelsbergh 1992). For trucks of one speed whose trips begin whatever breaks they have, what comes
of a place is never better than told here, and worse only where customers have several windows.
Times in ms.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from model.judge.breaks import ON_A_LEG, begin_of, is_heavier, window_of
from model.judge.loads import trip_loads
from model.judge.timing import RouteDecision
from model.problem import REST, UNLIMITED, Problem, VehicleType
from model.solution import BreakPlace, Route, Stop, TakenBreak, Trip


class LikelyPlace(NamedTuple):
    """A place of a break, and what comes of it; the best is the least."""

    is_wrong: bool  # some break begins outside its window, or out of order
    lateness: int  # of the customer who is then the latest after a hard window
    delay: int  # of the route's end
    trip: int
    stop: int
    place_number: int  # among those asked for


class _Event(NamedTuple):
    """Something that waits for an instant, and what may be too late then."""

    wait: int
    slack: int = UNLIMITED  # of a customer
    break_slack: int = UNLIMITED


class _Spot(NamedTuple):
    """A place in order of the route."""

    trip: int
    stop: int
    place_number: int
    since: int  # when the truck is there at first
    until: int  # when it is no more: of a way, its end
    last: int  # number of the stated break before it
    is_heavy: bool


def likely_places(problem: Problem, decision: RouteDecision, route: Route, number: int,
                  places: Sequence[BreakPlace]) -> list[LikelyPlace]:
    """Return all places of a break on a route that lacks it, the likeliest first.

    `route` is the decision with its times.
    """
    kind = problem.vehicle_types[route.vehicle_type]
    each = kind.breaks[number]
    earliest, latest = window_of(each, begin_of(kind, route.trips[0]))
    before = max([taken.number for trip in route.trips for taken in trip.breaks
                  if taken.number < number], default=REST)
    found, behind = list[LikelyPlace](), _Behind(0, UNLIMITED, UNLIMITED)
    for what in reversed([*_course(problem, decision, route, number, places)]):
        if isinstance(what, _Event):
            behind = behind.with_before(what)
            continue
        late = each.duration + max(0, earliest - what.until)
        found.append(LikelyPlace(
            what.is_heavy or what.last != before or max(what.since, earliest) > latest
            or late > behind.break_slack, max(0, late - behind.slack),
            max(0, late - behind.waits), what.trip, what.stop, what.place_number))
    return sorted(found)


class _Behind(NamedTuple):
    """What follows a place: how much of a delay it takes up, and bears until something is late."""

    waits: int
    slack: int
    break_slack: int

    def with_before(self, event: _Event) -> "_Behind":
        return _Behind(self.waits + event.wait, event.wait + min(self.slack, event.slack),
                       event.wait + min(self.break_slack, event.break_slack))


def _course(problem: Problem, decision: RouteDecision, route: Route, number: int,
            places: Sequence[BreakPlace]) -> Iterator[_Event | _Spot]:
    """Yield what waits on a route, and places for a break among it, in order."""
    kind = problem.vehicle_types[route.vehicle_type]
    ready, last = route.trips[0].stops[0].arrival, REST
    for index, trip in enumerate(route.trips):
        is_chosen = decision.trips[index].start is not None
        yield _Event(UNLIMITED if is_chosen else max(0, trip.stops[0].arrival - ready))
        ready = trip.stops[-1].departure + kind.reload_duration
        heavy = _heavy_stops(problem, kind, trip, number)
        for stop, (here, there) in enumerate(pairwise(trip.stops)):
            taken = [each for each in trip.breaks if each.stop == stop]
            time, on = here.departure, 0
            for place in ON_A_LEG:
                while on < len(taken) and _order(taken[on]) < (ON_A_LEG.index(place), number):
                    yield _taken(kind, route, taken[on])
                    time, last = taken[on].end, max(last, taken[on].number)
                    on += 1
                end = there.arrival if on == len(taken) else taken[on].arrival
                if place in places:
                    yield _Spot(index, stop, places.index(place),
                                end if place == "arrival" else time,
                                time if place == "departure" else end, last, stop in heavy)
            for each in taken[on:]:
                yield _taken(kind, route, each)
                last = max(last, each.number)
            yield _served(problem, there)


def _order(taken: TakenBreak) -> tuple[int, int]:
    return ON_A_LEG.index(taken.place), max(0, taken.number)


def _heavy_stops(problem: Problem, kind: VehicleType, trip: Trip, number: int) -> set[int]:
    """Return the stops behind which too much is aboard for a break."""
    limit = kind.breaks[number].max_load
    if limit is None:
        return set()
    loads = trip_loads(problem, kind, trip)
    return {stop for stop, load in enumerate(loads[1:]) if is_heavier(load, limit)}


def _taken(kind: VehicleType, route: Route, taken: TakenBreak) -> _Event:
    wait = taken.start - taken.arrival
    if taken.number == REST:
        return _Event(wait)
    latest = window_of(kind.breaks[taken.number], begin_of(kind, route.trips[0]))[1]
    return _Event(wait, break_slack=latest - taken.start)


def _served(problem: Problem, stop: Stop) -> _Event:
    wait = max(0, stop.service_start - stop.ready)
    if stop.node < problem.num_depots:
        return _Event(wait)
    customer = problem.customer_at(stop.node)
    if customer.late_cost_per_hour is not None:
        return _Event(wait)
    return _Event(wait, max(0, customer.latest - stop.service_start))
