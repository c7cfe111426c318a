"""Routes whose sequences have changed, timed anew: trips begin when that is cheapest, as tried.

A trip's start is a choice, everything else follows from it. Three are tried: as stated before, as
soon as possible, and as late as moves no end and makes no window missed.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from operator import attrgetter
from typing import NamedTuple

from model.judge.breaks import has_needless_break
from model.judge.check import JudgedRoute, judge_route
from model.judge.clock import closing
from model.judge.flown_trips import charged_start
from model.judge.metrics import working_duration
from model.judge.past import KnownTrip, Past
from model.judge.placing import is_exact, with_breaks, with_due_rests
from model.judge.timing import (
    RouteDecision, TripDecision, latest_release, read_decision, resume_trip, schedule_trip,
)
from model.problem import REST, Problem, VehicleType
from model.solution import Route, Trip

DRIVERS_OWN = "BREAK", "DRIVING"
"""Rules that drivers keep though others are broken then."""

BISECTIONS = 8
"""Steps in which the latest start of a trip with drones or a speed profile is looked for."""


class TimedRoute(NamedTuple):
    """A route and what the judge says of it alone."""

    route: Route
    judged: JudgedRoute

    @property
    def rank(self) -> tuple[int, int, float]:
        """What is smaller for a better route: fewest broken rules, then lowest cost.

        Drivers rest when they have to, and come too late, rather than the other way about.
        """
        broken = [each.code for each in self.judged.violations]
        return len(broken), sum(code in DRIVERS_OWN for code in broken), self.judged.cost.total


def read_route(problem: Problem, route: Route) -> RouteDecision:
    """Return the choices that a timed route states."""
    kind = problem.vehicle_types[route.vehicle_type]
    return RouteDecision(route.vehicle_type, route.vehicle, tuple(
        [read_decision(trip, kind, problem.lags_across) for trip in route.trips]))


def time_route(problem: Problem, decision: RouteDecision, path: str, past: Past) -> TimedRoute:
    """Return a route with the times that the judge finds best of those tried.

    What is known of a trip holds if the decision has it; else all of it is timed anew. Breaks stay
    on the legs that are stated, unless none of those ways keeps the rules.
    """
    best = _best_timed(problem, decision, path, past)
    kind = problem.vehicle_types[decision.vehicle_type]
    if not (kind.breaks or kind.driving) or _is_cheapest(problem, best):
        return best
    timer, late = _Timer(problem, decision, past), best.route.trips[0].stops[0].arrival
    for stays in (True, False) if any(trip.breaks for trip in decision.trips) else (False,):
        # What is estimated is so anew by the best times, where those aren't legal yet.
        rounds = 1 if is_exact(problem, decision) else 3 if best.judged.violations else 2
        tried = set[RouteDecision]()
        for number in range(rounds):
            begin = (0, late, best.route.trips[0].stops[0].arrival)[number]
            for paused in timer.paused(begin, late, stays):
                if paused in tried:
                    continue
                tried.add(paused)
                best = min(best, _best_timed(problem, paused, path, past), key=attrgetter("rank"))
        if not best.judged.violations and not has_needless_break(problem, best.route):
            break
    return best


def _is_cheapest(problem: Problem, timed: TimedRoute) -> bool:
    """Tell whether nothing can be won by other times of a route."""
    cost, kind = timed.judged.cost, problem.vehicle_types[timed.route.vehicle_type]
    waits = any(stop.service_start > stop.ready for trip in timed.route.trips
                for stop in trip.stops) or any(
        taken.start > taken.arrival for trip in timed.route.trips for taken in trip.breaks)
    return not (timed.judged.violations or has_needless_break(problem, timed.route)
                or cost.lateness or cost.earliness or cost.overtime
                or (kind.cost_per_hour and waits))


def _best_timed(problem: Problem, decision: RouteDecision, path: str, past: Past) -> TimedRoute:
    routes = list(_Timer(problem, decision, past).tries())
    kind = problem.vehicle_types[decision.vehicle_type]
    is_paid = kind.cost_per_hour and len(routes) > 1
    least = min(routes, key=lambda route: (_is_late(problem, route), working_duration(kind, route))
                ) if is_paid else routes[0]
    best = TimedRoute(least, judge_route(problem, least, path, past))
    if not any(trip.sorties for trip in decision.trips) and _is_free_of_blame(best):
        # By truck, times alone cost: the others cost more, or as much and come later.
        return best
    tried = [best if route is least else TimedRoute(route, judge_route(problem, route, path, past))
             for route in routes]
    return min(tried, key=attrgetter("rank"))


def _is_free_of_blame(timed: TimedRoute) -> bool:
    """Tell whether a route breaks no rule, and nothing is paid for when it serves and ends."""
    cost = timed.judged.cost
    return not (timed.judged.violations or cost.lateness or cost.earliness or cost.overtime)


def _is_late(problem: Problem, route: Route) -> bool:
    """Tell whether anybody is served too late by the times of a route."""
    return any(_lateness(problem, trip) for trip in route.trips)


def _has(trip: TripDecision, known: KnownTrip) -> bool:
    """Tell whether a trip makes the stops and flights that are known, at first."""
    nodes = tuple([stop.node for stop in known.stops])
    end = len(trip.nodes) if known.rest == "nothing" else len(nodes)
    return trip.nodes[:end] == nodes and len(trip.sorties) >= len(known.sorties) and all(
        (sortie.drone, sortie.launch_stop) == (flown.drone, flown.launch_stop)
        and sortie.nodes == tuple([visit.node for visit in flown.visits])
        for sortie, flown in zip(trip.sorties, known.sorties, strict=False))


class _Timer:
    """Times one route in several ways."""

    def __init__(self, problem: Problem, decision: RouteDecision, past: Past) -> None:
        self._problem = problem
        self._decision = decision
        self._type: VehicleType = problem.vehicle_types[decision.vehicle_type]
        self._known = past.trips.get(decision.driven_by, ())
        self._past = past

    def tries(self) -> Iterator[Route]:
        """Yield the route with each way to choose its starts, none of them twice."""
        trips = self._decision.trips
        soonest = self._timed([None] * len(trips))
        tried = [soonest]
        yield self._route(soonest)
        starts = [trip.start for trip in trips]
        for chosen in (starts, self._latest_starts(soonest)):
            timed = self._timed(chosen)
            if timed not in tried:
                tried.append(timed)
                yield self._route(timed)

    def paused(self, begin: int, likely: int, stays: bool) -> Iterator[RouteDecision]:
        """Yield the route with breaks, and then rests, where they are best, and begun then.

        What is estimated is so for a route that begins then, or as soon as it may. Where breaks
        stay, those that it states lie on the same legs.
        """
        known, trips = 0, self._decision.trips
        while known < len(trips) and self._known_trip(known) is not None:
            known += 1
        bare = [*trips[:known], *[replace(trip, start=None, breaks=()) for trip in trips[known:]]]
        free = replace(self._decision, trips=tuple(bare))
        route = _Timer(self._problem, free, self._past)._soonest_from(begin)
        if self._type.driving is not None and known == 0:
            # Rests take time from the work that remains.
            bare[0] = replace(bare[0], start=route.trips[0].stops[0].arrival)
            free = replace(free, trips=tuple(bare))
        stated = {taken.number: (number, taken.stop)
                  for number, trip in enumerate(trips[known:], known)
                  for taken in trip.breaks if taken.number != REST} if stays else {}
        for paused in with_breaks(self._problem, free, route, stated, known, likely):
            yield with_due_rests(self._problem, paused)

    def _soonest_from(self, begin: int) -> Route:
        """Return the route begun then, or as soon as it may, all else as soon as possible."""
        trips = self._decision.trips
        return self._route(self._timed([begin, *[0] * (len(trips) - 1)]))

    def _route(self, trips: list[Trip]) -> Route:
        return Route(self._decision.vehicle_type, self._decision.vehicle, tuple(trips))

    def _timed(self, starts: list[int | None]) -> list[Trip]:
        """Return the trips, each from its start on, or when it is ready if that is later."""
        timed: list[Trip] = []
        ready = max(self._type.earliest, self._past.now)
        for number, (trip, start) in enumerate(zip(self._decision.trips, starts, strict=True)):
            known = self._known_trip(number)
            if known is None:
                charged = charged_start(self._problem, self._type, timed, trip.nodes)
                begin = max(ready, self._free_from(trip), charged, 0 if start is None else start)
                timed.append(self._from(trip, begin, start is not None, timed))
            else:
                timed.append(resume_trip(self._problem, self._type, trip, known, self._past.now,
                                         timed))
            ready = max(timed[-1].stops[-1].departure + self._type.reload_duration,
                        self._past.now)
        return timed

    def _known_trip(self, number: int) -> KnownTrip | None:
        known = self._known[number] if number < len(self._known) else None
        return known if known and _has(self._decision.trips[number], known) else None

    def _from(self, trip: TripDecision, begin: int, is_chosen: bool = True,
              before: Sequence[Trip] = ()) -> Trip:
        """Return a trip from an instant on, or, if not chosen, once parcels stay fresh."""
        decision = replace(trip, start=begin if is_chosen else None)
        return schedule_trip(self._problem, self._type, decision, begin, before)

    def _free_from(self, trip: TripDecision) -> int:
        """Return when all parcels of a trip are at the depot."""
        nodes = trip.customers(self._problem.num_depots)
        back = max([self._past.returned.get(node, 0) for node in nodes], default=0)
        return max(back, latest_release(self._problem, trip))

    def _latest_starts(self, soonest: list[Trip]) -> list[int | None]:
        """Return starts as late as they cost nothing else, from those as soon as possible."""
        starts: list[int | None] = [None] * len(soonest)
        following: int | None = None
        for number in range(len(soonest) - 1, -1, -1):
            trip = soonest[number]
            if self._known_trip(number) is not None:
                break
            room = 0
            if following is not None:
                room = following - self._type.reload_duration - trip.stops[-1].departure
            following = trip.stops[0].arrival + self._delay(
                self._decision.trips[number], trip, room, soonest[:number])
            starts[number] = following
        return starts

    def _delay(self, decision: TripDecision, trip: Trip, room: int,
               before: Sequence[Trip]) -> int:
        """Return how much later a trip may begin that may end `room` later."""
        if not (trip.sorties or self._type.speed_profile or self._type.busy_until
                or self._problem.launch_sites or self._problem.lags or trip.breaks):
            return _plain_delay(self._problem, trip, room)
        high = room + sum([visit.service_start - visit.ready for visit in trip.visits])
        high += sum([taken.start - taken.arrival for taken in trip.breaks])
        high += trip.stops[-1].service_start - trip.stops[-1].arrival
        low, latest = 0, trip.stops[-1].departure + room
        late = _lateness(self._problem, trip)
        for step in range(BISECTIONS if high else 0):
            middle = high if step == 0 else (low + high) // 2
            tried = self._from(decision, trip.stops[0].arrival + middle, before=before)
            if (tried.stops[-1].departure <= latest and _is_open(self._problem, tried)
                    and _lateness(self._problem, tried) <= late):
                low = middle
            else:
                high = middle
        return low


def _plain_delay(problem: Problem, trip: Trip, room: int) -> int:
    """Return how much later a truck's trip may begin that may end `room` later.

    A delay shrinks by each wait on the way (Savelsbergh 1992).
    """
    waited, most = 0, None
    for stop in trip.stops[1:-1]:
        customer = problem.customer_at(stop.node)
        left = waited + max(0, closing(customer, stop.service_start) - stop.ready)
        most = left if most is None else min(most, left)
        waited += stop.service_start - stop.ready
    waited += trip.stops[-1].service_start - trip.stops[-1].arrival
    start = trip.stops[0]
    closes = problem.depots[start.node].latest - start.departure
    return min(waited + room, *([] if most is None else [most]), max(0, closes))


def _is_open(problem: Problem, trip: Trip) -> bool:
    """Tell whether a trip leaves its depot before that closes."""
    return trip.stops[0].departure <= problem.depots[trip.stops[0].node].latest


def _lateness(problem: Problem, trip: Trip) -> int:
    """Return by how much all customers of a trip are served too late, added up."""
    return sum([max(0, visit.service_start - problem.customer_at(visit.node).latest)
                for visit in trip.visits])
