"""Vehicles that have begun to work, have customers of their own or not all drones: each is a type.

One that can still deliver what it carries becomes two: for the trip that it is on, which goes on
from the place where it is, and for later ones, which begin once that would be over by the plan
given.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from operator import le
from typing import Literal, NamedTuple

from model.judge.chargers import level_after
from model.judge.driving import travel_duration
from model.judge.flown_trips import charged_between
from model.judge.freshness import first_departure
from model.judge.loads import highest, trip_loads
from model.judge.metrics import allowed_overtime
from model.judge.past import Past
from model.problem import MAX_QUANTITY, MS_PER_HOUR, Problem, VehicleType, shares_chargers
from model.replanning.amend import customers_of
from model.replanning.kept import Kept, WayOn, charged_then, with_drones_then
from model.replanning.rested import with_clock
from model.solution import Vehicle

MAX_OWN_TYPES = 500
"""Types that vehicles may become; memory grows by them."""


class TooManyTypesError(ValueError):
    """More vehicles are under way than can be planned for."""


class Legs(NamedTuple):
    """What a vehicle drives, its setups left out."""

    duration: int  # ms
    distance: int  # mm


@dataclass(frozen=True)
class VehicleWorker:
    """What one vehicle, and no other, does from now on."""

    vehicle: Vehicle
    kind: VehicleType
    aboard: tuple[int, ...] = ()  # if any, nobody else is served
    place: int | None = None  # node of the whole problem where it goes on with its trip
    drones: tuple[int, ...] = ()  # by number: what number it has in the whole problem

    @property
    def is_under_way(self) -> bool:
        """Whether this is the rest of the trip that it is on."""
        return bool(self.aboard)


def vehicle_name(problem: Problem, vehicle: Vehicle) -> str:
    """Return the name of a vehicle, such as `truck-1`."""
    return problem.vehicle_types[vehicle.type].vehicle_name(vehicle.number)


def find_workers(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept]) -> list[VehicleWorker]:
    """Return who becomes a type of its own."""
    workers = []
    for route in kept.values():
        home_by = _home_by(problem.vehicle_types[route.vehicle.type], route)
        way_on = route.way_on
        if way_on is not None and _can_go_on(problem, route, way_on.aboard, home_by):
            home = min(way_on.planned_end, home_by)
            planned = _planned(problem, route, way_on)
            driven = _driven(problem, route, is_home=False)
            later = _later(problem, past, route, home, home_by, Legs(
                driven.duration + planned.duration, driven.distance + planned.distance))
            rest = _rest_of_trip(problem, route, way_on, home_by if later is None else home,
                                 driven)
            if later is not None:
                rest = replace(rest, kind=_with_as_much(rest.kind, planned))
            workers.append(rest)
        else:
            later = _later(problem, past, route, route.end, home_by, _driven(problem, route))
        if later is not None:
            workers.append(later)
    workers += _others(problem, past, kept)
    if len(workers) > MAX_OWN_TYPES:
        raise TooManyTypesError(f"{len(workers)} routes are under way, have customers of "
                                "their own or grounded drones, and at most "
                                f"{MAX_OWN_TYPES} are allowed")
    return [_with_drones_left(worker, past) for worker in workers]


def _others(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept]) -> list[VehicleWorker]:
    """Return who has done nothing yet, and has customers of its own or drones grounded."""
    workers = []
    for vehicle in dict.fromkeys((*past.pinned.values(), *past.grounded, *past.keepers())):
        kind = from_now_on(problem.vehicle_types[vehicle.type], past.now)
        if vehicle not in kept and vehicle not in past.unavailable and kind is not None:
            workers.append(VehicleWorker(vehicle, replace(kind, id=vehicle_name(problem, vehicle),
                                                          count=1, numbers=())))
    return workers


def _with_drones_left(worker: VehicleWorker, past: Past) -> VehicleWorker:
    """Return a vehicle without the drones that are grounded, its others numbered anew."""
    kind, grounded = worker.kind, past.grounded_on(worker.vehicle)
    if kind.flies:
        return worker
    left = [drone for drone in range(kind.num_drones) if drone not in grounded]
    counts = Counter(map(kind.drone_index, left))
    types = [replace(drones, count=counts[index])
             for index, drones in enumerate(kind.drone_types) if counts[index]]
    own = replace(kind, drones=types[0] if types else None, more_drones=tuple(types[1:]),
                  charge_left=tuple(kind.charge_left[drone] for drone in left if kind.charge_left))
    return replace(worker, kind=own, drones=tuple(left))


def from_now_on(kind: VehicleType, now: int) -> VehicleType | None:
    """Return vehicles that begin no sooner than now; None if their work would be over by then.

    Whoever begins in overtime pays for that since the end of the shift, whatever else it does.
    """
    earliest, overtime = max(kind.earliest, now), kind.overtime
    over = earliest - kind.latest
    if over <= 0:
        return replace(kind, earliest=earliest)
    if overtime is None or over > overtime.max_duration:
        return None
    return replace(
        kind, earliest=earliest, latest=earliest,
        overtime=replace(overtime, max_duration=overtime.max_duration - over),
        fixed_cost=kind.fixed_cost + over / MS_PER_HOUR * overtime.cost_per_hour)


def _home_by(kind: VehicleType, route: Kept) -> int:
    """Return when a vehicle has to be home that has begun to work, with all its overtime."""
    return min(_home_in_time(kind, route) + allowed_overtime(kind), MAX_QUANTITY - 1)


def _home_in_time(kind: VehicleType, route: Kept) -> int:
    """Return when a vehicle that has begun to work would be home without overtime."""
    if kind.max_working_duration is None:
        return kind.latest
    return min(kind.latest, first_departure(kind, route.route.trips[0]) + kind.max_working_duration)


def _distance(problem: Problem, route: Kept, nodes: Sequence[int]) -> int:
    distance = problem.travel[problem.vehicle_types[route.vehicle.type].travel].distance
    return sum(map(distance.item, nodes, nodes[1:]))


def _driven(problem: Problem, route: Kept, is_home: bool = True) -> Legs:
    """Return what a vehicle has driven on all its trips, with the way home or without."""
    *trips, last = route.route.trips
    *before, on = (trip.nodes for trip in route.decision.trips)
    stops, nodes = (last.stops, on) if is_home else (last.stops[:-1], on[:-1])
    return Legs(travel_duration((*trips, replace(last, stops=stops))),
                sum(_distance(problem, route, each) for each in (*before, nodes)))


def _planned(problem: Problem, route: Kept, way_on: WayOn) -> Legs:
    """Return what a vehicle drives on the rest of its trip, by the plan given."""
    duration = problem.travel[problem.vehicle_types[route.vehicle.type].travel].duration
    nodes = way_on.planned.nodes
    return Legs(sum(map(duration.item, nodes, nodes[1:])), _distance(problem, route, nodes))


def _with_as_much(kind: VehicleType, legs: Legs) -> VehicleType:
    """Return a type that may drive such legs and no more, as far as any are limited."""
    return replace(
        kind,
        max_travel_duration=None if kind.max_travel_duration is None else legs.duration,
        max_distance=None if kind.max_distance is None else legs.distance)


def _load(problem: Problem, route: Kept, aboard: Sequence[int]) -> tuple[int, ...]:
    """Return what the rest of a trip has to leave room for beside what it delivers and picks up.

    That is the most that the truck has carried so far for those whom it serves in any case; if it
    had room for all that is `aboard` as well, what it has picked up.
    """
    kind = problem.vehicle_types[route.vehicle.type]
    loads = trip_loads(problem, kind, route.route.trips[-1])
    most = highest(loads)
    if not any(problem.customer_at(node).pickup
               for node in (*customers_of(problem, route.decision.trips[-1]), *aboard)):
        return most
    rest = [problem.customer_at(node).demand for node in aboard]
    before = map(sum, zip(most, *rest, strict=True))
    return loads[-1] if all(map(le, before, kind.capacity)) else most


def _has(problem: Problem, nodes: Iterable[int], what: Literal["demand", "pickup"]) -> bool:
    """Tell whether anything is delivered to, or picked up at, customers."""
    return any(any(getattr(problem.customer_at(node), what)) for node in nodes)


def _left(limit: int | None, done: int) -> int | None:
    """Return what is left of a limit, below 0 if it is exceeded; None without a limit."""
    return None if limit is None else limit - done


def _counts_left(problem: Problem, route: Kept) -> tuple[int | None, int | None]:
    """Return how many stops and sorties a vehicle may add to its last trip."""
    kind, trip = problem.vehicle_types[route.vehicle.type], route.decision.trips[-1]
    served = len(trip.nodes) - 2 - sum(map(problem.is_launch_site, trip.nodes[1:-1]))
    return (_left(kind.max_stops, served),
            _left(kind.max_sorties, len(trip.sorties)))


def _batteries_left(problem: Problem, route: Kept) -> list[int | None]:
    """Return how many batteries a vehicle has for the rest of its last trip, by type of drone."""
    kind, trip = problem.vehicle_types[route.vehicle.type], route.decision.trips[-1]
    return [_left(drones.batteries, sum([kind.drone_index(sortie.drone) == index
                                         for sortie in trip.sorties]))
            for index, drones in enumerate(kind.drone_types)]


def _can_go_on(problem: Problem, route: Kept, aboard: Sequence[int], home_by: int) -> bool:
    """Tell whether a vehicle can deliver some of what it carries, otherwise than it was to.

    Who flies does what it was to, as far as it can.
    """
    kind = problem.vehicle_types[route.vehicle.type]
    if kind.flies:
        return False
    nodes, driven = route.decision.trips[-1].nodes, _driven(problem, route)
    served = customers_of(problem, route.decision.trips[-1])
    in_order = kind.lifo or kind.pickups == "last"
    is_blocked = (in_order and _has(problem, served, "pickup")
                  and _has(problem, aboard, "demand"))
    return (route.end <= home_by and not is_blocked
            and all(count is None or count >= 0
                    for count in (*_counts_left(problem, route), *_batteries_left(problem, route)))
            and all(map(le, _load(problem, route, aboard), kind.capacity))
            and all(most is None or used <= most for most, used in (
                (kind.max_trip_distance, _distance(problem, route, nodes)),
                (kind.max_distance, driven.distance),
                (kind.max_travel_duration, driven.duration))))


def _rest_of_trip(problem: Problem, route: Kept, way_on: WayOn, home_by: int,
                  driven: Legs) -> VehicleWorker:
    """Return what a vehicle can do on the trip that it is on."""
    kind, trip = problem.vehicle_types[route.vehicle.type], route.decision.trips[-1]
    stops, sorties = _counts_left(problem, route)
    equipped = with_drones_then(kind, bool(trip.sorties))
    drones = [replace(drones, batteries=left) for drones, left
              in zip(equipped.drone_types, _batteries_left(problem, route), strict=True)]
    own = replace(
        _own_type(problem, route, way_on.ready, home_by, 1), end=trip.nodes[-1],
        max_trip_distance=_left(kind.max_trip_distance,
                                _distance(problem, route, trip.nodes[:-1])),
        max_distance=_left(kind.max_distance, driven.distance),
        max_travel_duration=_left(kind.max_travel_duration, driven.duration),
        max_stops=stops, max_sorties=sorties,
        drones=drones[0] if drones else None, more_drones=tuple(drones[1:]),
        initial_load=_load(problem, route, way_on.aboard),
        has_delivered=_has(problem, customers_of(problem, trip), "demand"),
        busy_until=way_on.ready + way_on.service_left, works_since=way_on.ready)
    own = charged_then(problem, own, route.route.trips[-1], way_on.ready)
    place = trip.nodes[way_on.position]
    return VehicleWorker(route.vehicle, own, way_on.aboard, place)


def _later(problem: Problem, past: Past, route: Kept, home: int, home_by: int,
           driven: Legs) -> VehicleWorker | None:
    """Return what trips a vehicle can begin that is back at `home`; None if there are none."""
    kind = problem.vehicle_types[route.vehicle.type]
    ready = max(past.now, home + kind.reload_duration)
    trips_left = kind.max_trips - len(route.route.trips)
    place = route.decision.trips[-1].nodes[-1]
    travel_left = _left(kind.max_travel_duration, driven.duration)
    way_left = _left(kind.max_distance, driven.distance)
    if (route.vehicle in past.unavailable or trips_left < 1 or ready > home_by
            or place not in kind.reload_places or min(travel_left or 0, way_left or 0) < 0):
        return None
    own = replace(_own_type(problem, route, ready, home_by, trips_left), start=place,
                  max_travel_duration=travel_left, max_distance=way_left,
                  charge_left=_charge_left(problem, route, ready))
    own = replace(own, works_since=home) if kind.cost_per_hour else own
    rested = with_clock(kind, own, route.route, home)
    return None if rested is None else VehicleWorker(route.vehicle, rested)


def _charge_left(problem: Problem, route: Kept, ready: int) -> tuple[int, ...]:
    """Return what a vehicle that flies has when it may begin another trip; nothing of others.

    Where places to charge are shared, it is charged as planned until now, and no more.
    """
    kind = problem.vehicle_types[route.vehicle.type]
    if shares_chargers(problem, kind):
        return (level_after(problem, kind, route.route.trips, route.charges),)
    return charged_between(problem, kind, route.route.trips, ready)


def _own_type(problem: Problem, route: Kept, earliest: int, home_by: int,
              trips: int) -> VehicleType:
    """Return a vehicle that has begun to work as a type of its own.

    Its overtime begins when it would be home in time, or after what of it has passed.
    """
    kind = problem.vehicle_types[route.vehicle.type]
    latest, overtime = home_by, None
    if kind.overtime is not None:
        latest = min(home_by, max(earliest, _home_in_time(kind, route)))
        overtime = replace(kind.overtime, max_duration=home_by - latest)
    return replace(kind, id=vehicle_name(problem, route.vehicle), count=1, numbers=(),
                   fixed_cost=0.0, earliest=earliest, latest=latest, overtime=overtime,
                   max_working_duration=None, max_trips=trips)
