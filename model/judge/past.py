"""What of a plan has happened by an instant: facts that a new plan has to begin with.

What has departed stays as it is, to the millisecond. A truck that is driving arrives when the plan
says and serves that stop; a drone that was launched flies its sortie to the end. All else is free,
but for trips that fetch and bring shipments, are flown, or by drivers who rest: they are made to
the end.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, NamedTuple

from model.judge.changes import EarlierPlan
from model.judge.clock import service_start
from model.judge.launches import launch_begins
from model.problem import UNREACHABLE, Problem, VehicleType
from model.solution import Route, Solution, Sortie, Stop, TakenBreak, Trip, Vehicle, Visit


class KnownStop(NamedTuple):
    """What is known of a stop in ms; None: that is yet to come."""

    node: int
    arrival: int
    service_start: int | None
    departure: int | None


class KnownSortie(NamedTuple):
    """A flight that was launched."""

    drone: int
    launch_stop: int
    visits: tuple[Visit, ...]
    launch_time: int
    recovery_node: int
    recovery_stop: int | None  # None: one of those yet to come
    recovery_start: int | None  # None: still in the air


@dataclass(frozen=True)
class KnownTrip:
    """The beginning of a trip.

    `rest` tells what may follow: nothing since it is over, the way home alone, or stops and flights
    to deliver what is aboard.
    """

    stops: tuple[KnownStop, ...]
    sorties: tuple[KnownSortie, ...]  # the first ones of the trip
    aboard: frozenset[int]  # customers whose parcels were loaded
    rest: Literal["nothing", "home", "anything"]
    breaks: tuple[TakenBreak, ...] = ()  # before the stops that are known

    @property
    def served(self) -> frozenset[int]:
        """The stops and visits that have happened, or will as planned."""
        flown = [visit.node for sortie in self.sorties for visit in sortie.visits]
        return frozenset([*(stop.node for stop in self.stops), *flown])


@dataclass(frozen=True)
class Past:
    """What a new plan has to keep to."""

    now: int = 0  # ms; nothing new happens before
    trips: Mapping[Vehicle, tuple[KnownTrip, ...]] = field(default_factory=dict)
    unavailable: frozenset[Vehicle] = frozenset()  # do nothing more
    grounded: Mapping[Vehicle, frozenset[int]] = field(default_factory=dict)
    """Drones, by number on their truck, that are launched no more."""
    pinned: Mapping[int, Vehicle] = field(default_factory=dict)  # customer -> who alone may serve
    returned: Mapping[int, int] = field(default_factory=dict)  # customer -> parcel is back then
    orders: Mapping[Vehicle, tuple[int, ...]] = field(default_factory=dict)
    """Whom trucks served before, in their order, where pinned customers keep their places."""
    earlier: EarlierPlan | None = None  # what changes are counted from; None: they cost nothing
    had: Mapping[Vehicle, frozenset[int]] = field(default_factory=dict)
    """Whom vehicles served before, by first places, if who is new comes behind all these."""

    @cached_property
    def told(self) -> frozenset[int]:
        """Whom any vehicle served before, if who is new comes behind these."""
        return frozenset[int]().union(*self.had.values())

    def room_after(self, problem: Problem, route: Route, node: int) -> tuple[int, int]:
        """Return the trip, and the stop of it, from which on somebody may come into a route."""
        had = self.had.get(route.driven_by, frozenset())
        first = 0, 1
        if not had or problem.first_place(node) in self.told:
            return first
        for number, trip in enumerate(route.trips):
            ends = [(index, stop.node) for index, stop in enumerate(trip.stops)]
            ends += [(sortie.recovery_stop, visit.node)
                     for sortie in trip.sorties for visit in sortie.visits]
            first = max([first, *((number, index + 1) for index, each in ends
                                  if each >= 0 and problem.first_place(each) in had)])
        return first

    def keepers(self) -> list[Vehicle]:
        """Return the vehicles whose customers cost something if others serve them."""
        if self.earlier is None or not self.earlier.prices.vehicle:
            return []
        return [Vehicle(*place.vehicle) for place in self.earlier.places.values()]

    def under_way(self, vehicle: Vehicle) -> KnownTrip | None:
        """Return the trip that a vehicle is on and may add to."""
        trips = self.trips.get(vehicle, ())
        return trips[-1] if trips and trips[-1].rest == "anything" else None

    def grounded_on(self, vehicle: Vehicle) -> frozenset[int]:
        """Return which of a vehicle's drones are launched no more."""
        return self.grounded.get(vehicle, frozenset())

    def served(self) -> frozenset[int]:
        """Return the stops and visits that have happened, or will as planned."""
        return frozenset[int]().union(*(
            trip.served for trips in self.trips.values() for trip in trips))

    def carriers(self) -> dict[int, Vehicle]:
        """Return who has the parcels that are on their way, customers served by now included."""
        return {node: vehicle for vehicle in self.trips
                if (trip := self.under_way(vehicle)) is not None
                for node in trip.aboard if node not in self.returned}


EVERYTHING_OPEN = Past()


def known_trips(problem: Problem, plan: Solution, now: int,
                unavailable: frozenset[Vehicle]) -> dict[Vehicle, tuple[KnownTrip, ...]]:
    """Return what each vehicle has done by `now`, for those that have done anything.

    `plan` may name customers who are no more, by negative nodes, where nothing has happened yet.
    An unavailable vehicle has served those whose service has begun, by itself or a drone.
    """
    known = {}
    for route in plan.routes:
        vehicle = route.driven_by
        trips = tuple(_known_trips(problem, route, now, vehicle in unavailable))
        if trips:
            known[vehicle] = trips
    return known


def parcels_aboard(problem: Problem, plan: Solution, now: int,
                   vehicles: Collection[Vehicle]) -> dict[Vehicle, frozenset[int]]:
    """Return whose parcels some vehicles had loaded on the last trip that they began by `now`.

    That of a vehicle that breaks down counts too, even if nothing of it is known afterwards.
    """
    routes = tuple(route for route in plan.routes
                   if route.driven_by in vehicles)
    begun = known_trips(problem, Solution(routes), now, frozenset())
    return {vehicle: trips[-1].aboard for vehicle, trips in begun.items()}


def _known_trips(problem: Problem, route: Route, now: int,
                 is_unavailable: bool) -> Iterator[KnownTrip]:
    for trip in route.trips:
        kind = problem.vehicle_types[route.vehicle_type]
        is_cut = is_unavailable and not kind.flies
        until = now if is_cut else bound_until(problem, kind, trip, now)
        known = known_trip(problem, kind, trip, until)
        if known is None:
            return
        if is_unavailable and known.rest != "nothing":
            known = _cut_short(problem, route.vehicle_type, known, now)
            if not known.sorties and all(s.node < problem.num_depots for s in known.stops):
                return
        yield known


def bound_until(problem: Problem, kind: VehicleType, trip: Trip, now: int) -> int:
    """Return up to when a trip is made as planned once it has begun: some to their end.

    Whoever has taken off flies its trip to the end, ends of shipments are served in pairs, and
    drivers rest as planned.
    """
    is_bound = kind.flies or bool(kind.breaks) or kind.driving is not None
    is_whole = (is_bound and min([stop.node for stop in trip.stops], default=0) >= 0) or any(
        node in problem.shipment_at for node in trip.nodes)
    begins = [*(stop.departure for stop in trip.stops[:1]), *launch_begins(trip.sorties, kind)]
    if not is_whole or min(begins, default=now + 1) > now:
        return now
    return max([now, *(stop.departure for stop in trip.stops)])


def known_trip(problem: Problem, kind: VehicleType, trip: Trip, now: int) -> KnownTrip | None:
    """Return what has happened on a trip; None if it has not begun."""
    left = 0
    while left < len(trip.stops) and trip.stops[left].departure <= now:
        left += 1
    launched = [sortie for sortie, begin in zip(
        trip.sorties, launch_begins(trip.sorties, kind), strict=True) if begin <= now]
    if not left and not launched:
        return None
    stops = [KnownStop(stop.node, stop.arrival,
                       stop.service_start if _opens(problem, stop) else stop.arrival,
                       stop.departure)
             for stop in trip.stops[:left]]
    is_over = left == len(trip.stops)
    if not is_over:
        stops.append(_bound_for(problem, trip.stops[left], now))
    sorties = tuple(_known_sortie(sortie, trip, len(stops), now) for sortie in launched)
    return KnownTrip(tuple(stops), sorties, frozenset(
        node for node in trip.served if node >= 0 and node not in problem.shipment_at),
                     "nothing" if is_over else "anything", _before(trip.breaks, stops))


def _before(breaks: Sequence[TakenBreak], stops: Sequence[KnownStop]) -> tuple[TakenBreak, ...]:
    """Return the breaks on the legs to some stops."""
    return tuple([taken for taken in breaks if taken.stop < len(stops) - 1])


def _opens(problem: Problem, stop: Stop) -> bool:
    """Tell whether a truck may have to wait at a stop: for a customer, or until a place opens."""
    return (stop.node >= problem.num_depots or stop.is_launch_site
            or (stop.node >= 0 and problem.depots[stop.node].earliest > 0))


def _bound_for(problem: Problem, stop: Stop, now: int) -> KnownStop:
    """Return the stop where a truck is or will be next."""
    begun = stop.arrival if not _opens(problem, stop) else (
        stop.service_start if stop.service_start <= now else None)
    return KnownStop(stop.node, stop.arrival, begun, None)


def _known_sortie(sortie: Sortie, trip: Trip, known_stops: int, now: int) -> KnownSortie:
    stop = sortie.recovery_stop
    return KnownSortie(sortie.drone, sortie.launch_stop, sortie.visits, sortie.launch_time,
                       trip.stops[stop].node, stop if stop < known_stops else None,
                       sortie.recovery_start if sortie.recovery_start <= now else None)


def _cut_short(problem: Problem, kind: int, known: KnownTrip, now: int) -> KnownTrip:
    """Return what a vehicle has done that breaks down: the rest of its trip is the way home.

    Its drones in the air that have served anyone come down at the depot, or at the last stop that
    they can fly to; a flight that ends nowhere is as if it had not been.
    """
    vehicle_type = problem.vehicle_types[kind]
    stops, last = known.stops, known.stops[-1]
    is_there = last.arrival <= now
    is_home = len(stops) > 1 and is_there and (
        last.node < problem.num_depots and not problem.is_launch_site(last.node))
    is_serving = (is_there if problem.is_launch_site(last.node)
                  else last.node >= problem.num_depots and last.service_start is not None)
    if len(stops) > 1 and last.departure is None and not (is_home or is_serving):
        stops = stops[:-1]
    nodes = [stop.node for stop in stops] + ([] if is_home else [vehicle_type.ends_at])
    # Where it stood and served nobody is no stop: what was launched there counts from that before.
    flown = [sortie._replace(launch_stop=min(sortie.launch_stop, len(stops) - 1))
             for sortie in known.sorties]
    landed = [_landed(problem, vehicle_type, sortie, nodes, len(stops), now) for sortie in flown]
    return KnownTrip(stops, tuple(sortie for sortie in landed if sortie is not None),
                     known.aboard, "nothing" if is_home else "home",
                     _before(known.breaks, stops) if is_home
                     else _taken_by(known.breaks, len(stops) - 1, now))


def _taken_by(breaks: Sequence[TakenBreak], last: int, now: int) -> tuple[TakenBreak, ...]:
    """Return the breaks on the legs to a stop, and those that have begun behind it.

    Of one at the end of a leg that leads elsewhere now all is known but that it was on the way.
    """
    begun = [taken for taken in breaks if taken.stop == last and taken.start <= now]
    return (*[taken for taken in breaks if taken.stop < last],
            *[replace(taken, place="way") if taken.place == "arrival" else taken
              for taken in begun])


def _landed(problem: Problem, kind: VehicleType, sortie: KnownSortie, nodes: list[int],
            known_stops: int, now: int) -> KnownSortie | None:
    """Return a flight whose truck goes no further than the stops at `nodes`.

    It ends at the last one that can be flown to; None if there is none, or it has served nobody.
    """
    stop = sortie.recovery_stop
    if sortie.recovery_start is not None and stop is not None and stop < known_stops:
        return sortie
    visits = tuple(visit for visit in sortie.visits if visit.service_start <= now)
    if kind.drones is None or not visits:
        return None
    flight = problem.travel[kind.drone_type(sortie.drone).travel].duration
    ends = len(nodes) if sortie.recovery_start is None else known_stops
    landings = [index for index in range(sortie.launch_stop, ends)
                if flight.item(visits[-1].node, nodes[index]) < UNREACHABLE
                and problem.may_launch_at(nodes[index])]
    if not landings or flight.item(nodes[sortie.launch_stop], visits[0].node) == UNREACHABLE:
        return None
    landing = landings[-1]
    return sortie._replace(visits=visits, recovery_node=nodes[landing],
                           recovery_stop=landing if landing < known_stops else None)


def resumed_service(problem: Problem, vehicle_type: VehicleType, node: int, ready: int,
                    fact: KnownStop | None, now: int) -> tuple[int, int]:
    """Return when service at a stop begins and ends; at depots, when the truck is there.

    At launch sites, when drones may take off.
    """
    begun = None if fact is None else fact.service_start
    if node < problem.num_depots:
        opened = max(ready, problem.depots[node].earliest) if begun is None else begun
        return opened, opened
    customer = problem.customer_at(node)
    start = service_start(customer, max(ready, now)) if begun is None else begun
    return start, start + vehicle_type.service_at(customer)
