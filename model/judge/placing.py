"""Breaks put between the stops of a route that lacks some."""

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from model.judge.breaks import ON_A_LEG, BreakDecision, begin_of, broken_breaks, is_due
from model.judge.driving import Excess, excesses, is_out
from model.judge.likely_places import LikelyPlace, likely_places
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import REST, Break, DrivingRules, Problem, VehicleType
from model.solution import BreakPlace, Route, Trip

AT_STOPS: tuple[BreakPlace, ...] = "departure", "arrival"
"""Where a stated break is put between two stops."""

MOST_TIMED_STOPS, LEAST_TRIES = 3000, 3
"""Stops that are timed to place a break, and how many places are tried however long a route is:
those that are likely best."""


def with_due_breaks(problem: Problem, decision: RouteDecision) -> RouteDecision:
    """Return a route that has the breaks that are due, each where nobody is served too late, and
    the route then ends first.

    Breaks that are placed already stay. One that can't be anywhere is left out, and those behind.
    A driver also rests by driving rules. On a route of many stops the likeliest places are tried.
    """
    kind = problem.vehicle_types[decision.vehicle_type]
    decision = with_due_rests(problem, decision)
    route = schedule(problem, decision)
    for number, each in enumerate(kind.breaks):
        begin, end = begin_of(kind, route.trips[0]), _end(route)
        taken = {placed.number for trip in decision.trips for placed in trip.breaks}
        if number in taken or not is_due(each, begin, end):
            continue
        best = _best_placed(problem, decision, route, number)
        decision, route = best.decision, best.route
        if best.is_wrong:
            break
    return decision


class _Placed(NamedTuple):
    """A route with a break more."""

    is_wrong: bool
    lateness: int
    end: int
    place: LikelyPlace
    decision: RouteDecision
    route: Route

    @property
    def rank(self) -> tuple[bool, int, int, int, int, int]:
        """What is smaller for a better place; of equal ones the first."""
        return (self.is_wrong, self.lateness, self.end,
                self.place.trip, self.place.stop, self.place.place_number)


def _best_placed(problem: Problem, decision: RouteDecision, route: Route,
                 number: int) -> _Placed:
    """Return a route that has one break more at the best of the places tried; `route` is it now."""
    kind = problem.vehicle_types[decision.vehicle_type]
    bare = decision if kind.driving is None else _unrested(decision)
    bare_route = route if bare is decision else schedule(problem, bare)
    places = _places(kind, kind.breaks[number])
    likely = likely_places(problem, bare, bare_route, number, places)
    left = max(LEAST_TRIES, MOST_TIMED_STOPS // _timed_stops(kind, route))
    is_told = _is_told(problem, bare)
    lateness, end = _lateness(problem, bare_route), _end(bare_route)
    best: _Placed | None = None
    for place in likely[:left]:
        if best is not None and is_told and best.rank[:3] <= (
                place.is_wrong, lateness + place.lateness, end + place.delay):
            break
        tried = _tried(problem, bare, place, BreakDecision(
            number, place.stop, places[place.place_number]))
        best = tried if best is None or tried.rank < best.rank else best
    if best is None:
        raise ValueError(f"route trips: {decision.trips!r} is not allowed")
    return best


def _unrested(decision: RouteDecision) -> RouteDecision:
    """Return a route whose driver rests nowhere but in breaks that are stated."""
    return replace(decision, trips=tuple([
        replace(trip, breaks=tuple([each for each in trip.breaks if each.number != REST]))
        for trip in decision.trips]))


def _end(route: Route) -> int:
    return route.trips[-1].stops[-1].departure


def _lateness(problem: Problem, route: Route) -> int:
    """Return by how much customers are served after their hard windows."""
    return sum([max(0, stop.service_start - problem.customer_at(stop.node).latest)
                for trip in route.trips for _, stop in trip.numbered_stops
                if problem.customer_at(stop.node).late_cost_per_hour is None])


def _places(kind: VehicleType, each: Break) -> tuple[BreakPlace, ...]:
    """Return where a break may be put between two stops."""
    return (*AT_STOPS, "way") if each.anywhere and not kind.speed_profile else AT_STOPS


def _tried(problem: Problem, decision: RouteDecision, place: LikelyPlace,
           more: BreakDecision) -> _Placed:
    """Return a route with a break more, and where its driver rests then."""
    kind, trips = problem.vehicle_types[decision.vehicle_type], [*decision.trips]
    trips[place.trip] = _with(trips[place.trip], more)
    placed = with_due_rests(problem, replace(decision, trips=tuple(trips)))
    route = schedule(problem, placed)
    is_wrong = any(of is not None for of, _ in broken_breaks(problem, kind, route.trips)) or any(
        True for _ in excesses(kind, route.trips))
    return _Placed(is_wrong, _lateness(problem, route), _end(route), place, placed, route)


def _timed_stops(kind: VehicleType, route: Route) -> int:
    """Return how many stops are timed to try one place of a break."""
    stops = sum([len(trip.stops) for trip in route.trips])
    rests = sum([taken.number == REST for trip in route.trips for taken in trip.breaks])
    return stops if kind.driving is None else (rests + 2) * stops


def _is_told(problem: Problem, decision: RouteDecision) -> bool:
    """Tell whether nothing on a route is earlier for a break than its likely places tell."""
    kind = problem.vehicle_types[decision.vehicle_type]
    return not (kind.flies or kind.speed_profile or kind.driving or problem.lags
                or problem.limits_time_aboard or problem.limits_time_between
                or any(trip.sorties for trip in decision.trips))


def _with(trip: TripDecision, more: BreakDecision) -> TripDecision:
    def order(taken: BreakDecision) -> tuple[int, int, int]:
        return taken.stop, ON_A_LEG.index(taken.place), max(0, taken.number)

    return replace(trip, breaks=tuple(sorted((*trip.breaks, more), key=order)))


MOST_RESTS = 64
"""Rests that are put on one route."""


def with_due_rests(problem: Problem, decision: RouteDecision) -> RouteDecision:
    """Return a route whose driver rests, each time as late as allowed.

    Or, where that is too late for somebody, while the truck waits, too.
    """
    rules = problem.vehicle_types[decision.vehicle_type].driving
    if rules is None:
        return decision
    rested = _rested_late(problem, decision, rules)
    if _wrong(problem, rested) == (0, 0):
        return rested
    waiting = _rested_late(problem, _with_waits(problem, decision, rules), rules)
    return min(rested, waiting, key=lambda way: _wrong(problem, way))


def _wrong(problem: Problem, decision: RouteDecision) -> tuple[int, int]:
    """Return how often a route breaks driving rules, and by how much it comes too late."""
    kind, route = problem.vehicle_types[decision.vehicle_type], schedule(problem, decision)
    return sum(1 for _ in excesses(kind, route.trips)), _lateness(problem, route)


def _with_waits(problem: Problem, decision: RouteDecision, rules: DrivingRules) -> RouteDecision:
    """Return a route whose driver rests where the truck waits for so long."""
    route, trips = schedule(problem, decision), list[TripDecision]()
    for trip, timed in zip(decision.trips, route.trips, strict=True):
        for stop, (before, after) in enumerate(pairwise(timed.stops)):
            ready = max([after.arrival, *(taken.end for taken in timed.breaks
                                          if taken.stop == stop)])
            if before.node == after.node or after.service_start - ready < rules.rest or (
                    not rules.while_drones_fly and is_out(timed.sorties, stop)):
                continue
            trip = _with(trip, BreakDecision(REST, stop, "arrival", 0, rules.rest))
        trips.append(trip)
    return replace(decision, trips=tuple(trips))


def _rested_late(problem: Problem, decision: RouteDecision,
                 rules: DrivingRules) -> RouteDecision:
    """Return a route whose driver rests, each time as late as allowed.

    Where a rest would help nothing, it and those behind are left out.
    """
    kind = problem.vehicle_types[decision.vehicle_type]
    before, reached = decision, (-1, 0, 0)
    for _ in range(MOST_RESTS):
        trips = schedule(problem, decision).trips
        found = [each for each in excesses(kind, trips) if each.what != "day"]
        if not found:
            break
        first = found[0]
        there = sum(each.excess for each in found
                    if (each.trip, each.stop) == (first.trip, first.stop))
        if (first.trip, first.stop, -there) <= reached:
            return before
        before, reached = decision, (first.trip, first.stop, -there)
        rested = _with(decision.trips[first.trip], _rest(rules, trips[first.trip], first))
        decision = replace(decision, trips=(*decision.trips[:first.trip], rested,
                                            *decision.trips[first.trip + 1:]))
    return decision


def _rest(rules: DrivingRules, trip: Trip, excess: Excess) -> BreakDecision:
    """Return a rest on the leg where somebody drives or works for too long, or before it.

    Before the launches of drones that are out then, where nobody rests meanwhile.
    """
    stop = excess.stop
    while stop > 0 and not rules.while_drones_fly and is_out(trip.sorties, stop):
        stop -= 1
    if stop < excess.stop:
        return BreakDecision(REST, stop, "arrival", 0, rules.rest)
    here, there = trip.stops[stop], trip.stops[stop + 1]
    left = max([here.departure, *(taken.end for taken in trip.breaks if taken.stop == stop)])
    driven = there.arrival - left - excess.excess
    if driven >= 0:
        return BreakDecision(REST, stop, "way", driven, rules.rest)
    return BreakDecision(REST, max(0, stop - 1), "arrival", 0, rules.rest)
