"""Breaks and rests put between the stops of a route that lacks some."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

from model.judge.break_ways import best_breaks
from model.judge.breaks import ON_A_LEG, BreakDecision
from model.judge.courses import course_of
from model.judge.driving import Excess, excesses, is_out
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import REST, DrivingRules, Problem
from model.solution import Route, Trip

MOST_TRIED = 8
"""Ways to take breaks that are tried where drones, or hours of slow traffic, are only estimated."""


def with_breaks(problem: Problem, decision: RouteDecision, route: Route,
                stated: Mapping[int, tuple[int, int]], known: int,
                likely: int) -> Iterator[RouteDecision]:
    """Yield a route without breaks with them where they are best, and begun when that is best.

    `route` is the same with times, begun as soon as it may; the first trips are known. If the first
    trip states its start, it begins then. `stated` has trip and stop of breaks that are taken
    there, and `likely` is an instant at which it may be good to begin.
    """
    course = course_of(problem, decision, route, known)
    most = 1 if is_exact(problem, decision) else MOST_TRIED
    for found in best_breaks(course, stated, likely, most):
        trips = list(decision.trips[:known])
        for number, trip in enumerate(decision.trips[known:], known):
            trips.append(replace(trip, start=trip.start if number else found.begin, breaks=tuple(
                [taken for of, taken in found.breaks if of == number])))
        yield replace(decision, trips=tuple(trips))


def is_exact(problem: Problem, decision: RouteDecision | Route) -> bool:
    """Tell whether all is known of how a route goes on behind a break."""
    kind = problem.vehicle_types[decision.vehicle_type]
    is_held = len(decision.trips) > 1 and (problem.limits_time_aboard
                                           or problem.limits_time_between)
    return not (kind.flies or kind.speed_profile or kind.driving or is_held
                or any(trip.sorties for trip in decision.trips))


def _lateness(problem: Problem, route: Route) -> int:
    """Return by how much customers are served after their hard windows."""
    return sum([max(0, stop.service_start - problem.customer_at(stop.node).latest)
                for trip in route.trips for _, stop in trip.numbered_stops
                if problem.customer_at(stop.node).late_cost_per_hour is None])


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
