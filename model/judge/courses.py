"""What the vehicle of a route does in order: legs, and where it stops, as far as breaks matter.

Exact for trucks of one speed without drones. Else legs take, and drones at stops, as long as on a
route that is timed already. Later trips begin as soon as they can. Times in ms.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from model.judge.breaks import is_heavier
from model.judge.clock import leg_end
from model.judge.instants import BEGIN, Begins, Instant, fixed
from model.judge.lags import soonest_after
from model.judge.loads import trip_loads
from model.judge.timing import RouteDecision, TripDecision
from model.problem import MS_PER_HOUR, REST, UNLIMITED, Problem, VehicleType
from model.solution import Route, Stop, Trip

OUT, NOBODY = -1, -2
"""In place of a node: the departure of a trip, and no customer."""


class Leg(NamedTuple):
    """A leg and the stop behind it; between two trips, reloading."""

    duration: int = 0
    heavy: frozenset[int] = frozenset()  # breaks for which too much is aboard
    setup: int = 0
    waits: int = 0  # until when it waits, at no price
    opens: tuple[int, ...] = (0,)  # each window in which service begins
    closes: tuple[int, ...] = (UNLIMITED,)
    early_cost: float = 0.0  # per ms
    late_cost: tuple[float, float] | None = None  # per ms, and once; None: the window is hard
    least: tuple[tuple[int, int], ...] = ()  # how long after service begins at other nodes
    most: tuple[tuple[int, int], ...] = ()
    node: int = NOBODY
    service: int = 0
    busy: int = 0  # with drones, from when it is ready
    trip: int = 0
    stop: int | None = None  # index of the stop before it; None: no break is taken there


class RouteCourse(NamedTuple):
    """The course of a route behind the trips that are known."""

    kind: VehicleType
    begin: Instant  # from which its breaks count
    works_since: Instant
    time: Instant  # when the first leg begins
    begins: Begins
    legs: tuple[Leg, ...]
    taken: int  # breaks that are known, as bits


def course_of(problem: Problem, decision: RouteDecision, route: Route, known: int) -> RouteCourse:
    """Return the course of a route whose first trips are known.

    `route` has times, begun as soon as it may. If the first trip states its start, it begins then.
    """
    kind, trips = problem.vehicle_types[route.vehicle_type], route.trips
    first = trips[0].stops[0]
    begin, time = BEGIN, _departure(kind, trips[0])
    begins = Begins(first.arrival, problem.depots[first.node].latest)
    if known:
        begin, time = fixed(first.arrival), fixed(trips[known - 1].stops[-1].departure)
    if known or decision.trips[0].start is not None:
        begins = Begins(first.arrival, first.arrival)
    works_since = begin.or_later(fixed(kind.busy_until))
    if kind.works_since is not None:
        begin = works_since = fixed(kind.works_since)
    legs = list[Leg]()
    for number in range(known, len(trips)):
        legs += [_reload(problem, kind, trips, number)] if number else []
        legs += _legs(problem, kind, decision.trips[number], trips[number], number)
    taken = sum({1 << each.number for trip in trips[:known] for each in trip.breaks
                 if each.number != REST})
    return RouteCourse(kind, begin, works_since, time, begins, tuple(_counted(legs)), taken)


def _counted(legs: Iterable[Leg]) -> Iterator[Leg]:
    """Yield legs whose stops count from nobody who isn't served before."""
    served = {OUT}
    for leg in legs:
        yield leg._replace(least=tuple([each for each in leg.least if each[0] in served]),
                           most=tuple([each for each in leg.most if each[0] in served]))
        served.add(leg.node)


def _departure(kind: VehicleType, trip: Trip) -> Instant:
    """Return when the truck leaves that begins the route with a trip."""
    first = trip.stops[0]
    if trip.sorties:
        return BEGIN.plus(first.departure - first.arrival)
    return BEGIN.or_later(fixed(kind.busy_until)).plus(kind.launch_duration)


def _reload(problem: Problem, kind: VehicleType, trips: Sequence[Trip], number: int) -> Leg:
    """Return what is between a trip and the one before; it waits for what it waited for."""
    first, before = trips[number].stops[0], trips[number - 1].stops[-1]
    ready = before.departure + kind.reload_duration
    service = first.departure - first.arrival
    return Leg(kind.reload_duration + service, node=OUT, trip=number,
               waits=first.departure if first.arrival > ready else 0,
               closes=(problem.depots[first.node].latest,))


def _legs(problem: Problem, kind: VehicleType, decision: TripDecision, trip: Trip,
          number: int) -> Iterator[Leg]:
    """Yield the legs of a trip."""
    duration, loads = problem.travel[kind.travel].duration, trip_loads(problem, kind, trip)
    for index, (here, there) in enumerate(pairwise(trip.stops)):
        leg = leg_end(here.departure, duration.item(here.node, there.node), kind.speed_profile)
        heavy = frozenset([one for one, each in enumerate(kind.breaks) if each.max_load is not None
                           and is_heavier(loads[index + 1], each.max_load)])
        if there.node < problem.num_depots:
            stop = _called(problem, kind, there, there is trip.stops[-1])
        else:
            stop = _served(problem, kind, decision, there.node)
        is_busy = any(index + 1 in (sortie.launch_stop, sortie.recovery_stop)
                      for sortie in trip.sorties)
        yield stop._replace(
            duration=leg - here.departure, heavy=heavy, setup=there.setup, trip=number, stop=index,
            busy=there.departure - there.ready if is_busy else 0)


def _called(problem: Problem, kind: VehicleType, stop: Stop, is_last: bool) -> Leg:
    """Return a stop at a depot, or at a launch site."""
    depot, service = problem.depots[stop.node], kind.recovery_duration if is_last else 0
    return Leg(waits=depot.earliest, closes=(depot.latest - service,), service=service)


def _served(problem: Problem, kind: VehicleType, decision: TripDecision, node: int) -> Leg:
    """Return a stop at a customer."""
    customer, lags = problem.customer_at(node), problem.lags.get(node, ())
    most = [(lag.node, lag.most) for lag in lags if lag.most < UNLIMITED]
    most += _under_way(problem, kind, node)
    most += [] if customer.max_time_aboard is None else [(OUT, customer.max_time_aboard)]
    return Leg(
        waits=max([soonest_after(problem, node, {}), *(
            each.until for each in decision.awaited if each.node == node)]),
        opens=customer.openings, closes=(*(closes for closes, _ in customer.gaps), customer.latest),
        early_cost=customer.early_cost_per_hour / MS_PER_HOUR,
        late_cost=None if customer.late_cost_per_hour is None else (
            customer.late_cost_per_hour / MS_PER_HOUR, customer.late_cost),
        least=tuple([(lag.node, lag.least) for lag in lags]), most=tuple(most), node=node,
        service=kind.service_at(customer))


def _under_way(problem: Problem, kind: VehicleType, node: int) -> Iterator[tuple[int, int]]:
    """Yield how long after service at a shipment's pickups it may begin at its delivery."""
    each, duration = problem.shipment_at.get(node), problem.travel[kind.travel].duration
    if each is None or node != each.delivery:
        return
    for pickup in each.pickups:
        longest = each.longest_between(duration.item(pickup, node))
        if longest is not None:
            yield pickup, kind.service_at(problem.customer_at(pickup)) + longest
