"""The rules that a timed route has to keep."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from operator import gt

from model.judge.breaks import broken_breaks
from model.judge.driving import broken_driving, limited_distance, travel_duration
from model.judge.energy import charges, sortie_energy
from model.judge.flown_trips import airborne, trip_charges
from model.judge.freshness import excess_aboard
from model.judge.loads import highest, picks_up_early, sortie_loads
from model.judge.metrics import RouteMetrics, TripMetrics, allowed_overtime
from model.judge.takeoff import closing_met, storm_met
from model.judge.timing import TripDecision, latest_release
from model.problem import (
    MICROJOULES_PER_WH, UNLIMITED, USUAL_DECIMALS, DroneType, Problem, VehicleType, zones_of,
)
from model.solution import Sortie, Stop, Trip, Visit


@dataclass(frozen=True)
class Violation:
    """A broken rule."""

    code: str
    message: str
    path: str  # of the offender, such as routes[0].trips[1].stops[2]


@dataclass(frozen=True)
class TimedTrip:
    """A trip with the choices it states and the times that follow from them."""

    decision: TripDecision
    trip: Trip
    metrics: TripMetrics
    path: str


def decimal(parts: int, places: int = USUAL_DECIMALS) -> str:
    """Return thousandths, or other decimal parts, as a decimal number for people."""
    return f"{parts / 10**places:.{places}f}".rstrip("0").rstrip(".")


def seconds(time: int) -> str:
    """Return a time or duration for people."""
    return f"{decimal(time)} s"


LARGE = 1000
"""Watt-hours of which no part is told."""


def watt_hours(energy: int) -> str:
    """Return an energy in µJ for people."""
    amount = energy / MICROJOULES_PER_WH
    return f"{amount:.4g} Wh" if amount < LARGE else f"{amount:.0f} Wh"


def amounts(problem: Problem, load: tuple[int, ...]) -> str:
    """Return the amounts of a load or capacity for people."""
    return ", ".join(decimal(amount, places) for amount, places
                     in zip(load, problem.amount_decimals, strict=True))


def _exceeds(load: tuple[int, ...], limits: tuple[int, ...]) -> bool:
    return any(map(gt, load, limits))


def trip_violations(problem: Problem, kind: int, timed: TimedTrip) -> Iterator[Violation]:
    """What a trip by a type of vehicle breaks on its own."""
    vehicle_type = problem.vehicle_types[kind]
    trip, metrics, path = timed.trip, timed.metrics, timed.path
    served = trip.customer_stops
    if not served and not any(sortie.visits for sortie in trip.sorties):
        yield Violation("EMPTY_TRIP", "a trip without customers", path)
    if _exceeds(metrics.highest_load, vehicle_type.capacity):
        message = (f"load {amounts(problem, metrics.highest_load)} exceeds "
                   f"{amounts(problem, vehicle_type.capacity)}")
        yield Violation("CAPACITY", message, path)
    if vehicle_type.pickups == "last":
        for where in picks_up_early(problem, vehicle_type, trip):
            message = f"{vehicle_type.id} picks up only after all deliveries of a trip, one or more"
            yield Violation("PICKUP_ORDER", message, f"{path}{where}")
    limit = vehicle_type.max_trip_distance
    if limit is not None and metrics.distance > limit:
        message = f"{decimal(metrics.distance)} m, at most {decimal(limit)} m are allowed"
        yield Violation("TRIP_DISTANCE", message, path)
    yield from _count_violations(vehicle_type, trip, path)
    yield from _goods_violations(problem, [timed], "trip", path)
    yield from _battery_violations(vehicle_type, trip, path)
    release = latest_release(problem, timed.decision)
    if trip.stops[0].arrival < release:
        message = f"begins at {seconds(trip.stops[0].arrival)}, released at {seconds(release)}"
        yield Violation("RELEASE", message, path)
    yield from _visit_violations(problem, kind, trip.numbered_stops, f"{path}.stops")
    yield from _aboard_violations(problem, vehicle_type, timed)
    if vehicle_type.flies:
        yield from _flown_violations(problem, vehicle_type, trip, path)
    if vehicle_type.drones is not None and trip.sorties:
        yield from _drone_busy(timed)
        yield from _airborne_violations(vehicle_type, timed)
        yield from _energy_violations(problem, vehicle_type, timed)
        for index, sortie in enumerate(trip.sorties):
            sortie_path = f"{path}.sorties[{index}]"
            yield from _sortie_violations(problem, kind, trip, sortie, sortie_path)


def _flown_violations(problem: Problem, kind: VehicleType, trip: Trip,
                      path: str) -> Iterator[Violation]:
    """What a trip breaks of who flies by itself."""
    if airborne(trip) > kind.endurance:
        yield _endurance_violation(airborne(trip), kind.endurance, path)
    zones = zones_of(problem, [stop.node for stop in trip.stops])
    yield from _storm_violations(kind, zones, trip.stops[0].departure, trip.stops[-1].arrival, path)
    if kind.max_range is not None:
        ends = (trip.stops[0].node, trip.stops[-1].node)
        yield from _range_violations(problem, kind, ends, trip.stops[1:-1], f"{path}.stops", 1)


def _count_violations(vehicle_type: VehicleType, trip: Trip, path: str) -> Iterator[Violation]:
    """What a trip has too many of."""
    for code, count, limit in (("MAX_STOPS", len(trip.customer_stops), vehicle_type.max_stops),
                               ("MAX_SORTIES", len(trip.sorties), vehicle_type.max_sorties)):
        if limit is not None and count > limit:
            what = "customers of the truck" if code == "MAX_STOPS" else "sorties"
            yield Violation(code, f"{count} {what}, at most {limit} are allowed", path)


def _battery_violations(vehicle_type: VehicleType, trip: Trip, path: str) -> Iterator[Violation]:
    """Whether each sortie has a battery of its own."""
    for index, drones in enumerate(vehicle_type.drone_types):
        stock, whose = drones.batteries, "" if drones.id is None else f" of {drones.id}"
        flown = [number for number, sortie in enumerate(trip.sorties)
                 if vehicle_type.drone_index(sortie.drone) == index]
        if stock is not None and len(flown) > stock:
            message = f"{len(flown)} sorties{whose}, with {stock} batteries, one for each"
            yield Violation("BATTERIES", message, f"{path}.sorties[{flown[stock]}]")


def _visit_violations(
    problem: Problem,
    kind: int,
    visits: Iterable[tuple[int, Stop | Visit]],
    path: str,
) -> Iterator[Violation]:
    """What customers demand of those who come: type and kind of vehicle, skills and window."""
    first_customer, vehicle_type = len(problem.depots), problem.vehicle_types[kind]
    for index, visit in visits:
        customer = problem.customers[visit.node - first_customer]
        if not problem.allows(kind, visit.node):
            message = f"{vehicle_type.id} may not serve customer {customer.id}"
            yield Violation("VEHICLE", message, f"{path}[{index}]")
        way = "truck" if isinstance(visit, Stop) and not vehicle_type.flies else "drone"
        if customer.served_by not in (way, "either"):
            message = f"customer {customer.id} is served by {customer.served_by} only"
            yield Violation("SERVED_BY", message, f"{path}[{index}]")
        if not customer.skills <= vehicle_type.skills:
            missing = ", ".join(sorted(customer.skills - vehicle_type.skills))
            yield Violation("SKILLS", f"{vehicle_type.id} lacks {missing}", f"{path}[{index}]")
        if visit.service_start > customer.latest and customer.late_cost_per_hour is None:
            message = (f"customer {customer.id} is reached at {seconds(visit.service_start)}, "
                       f"after {seconds(customer.latest)}")
            yield Violation("TIME_WINDOW", message, f"{path}[{index}]")


def _goods_violations(problem: Problem, trips: list[TimedTrip], scope: str,
                      path: str) -> Iterator[Violation]:
    """Goods that are carried together and must not be."""
    for incompatible in problem.incompatible_goods:
        if incompatible.scope != scope:
            continue
        carried = {goods for timed in trips for node in timed.decision.customers(problem.num_depots)
                   for goods in problem.customer_at(node).goods & incompatible.goods}
        if len(carried) > 1:
            message = f"{' and '.join(sorted(carried))} may not be carried together"
            yield Violation("GOODS", message, path)


def _aboard_violations(problem: Problem, kind: VehicleType,
                       timed: TimedTrip) -> Iterator[Violation]:
    """Parcels that are too long aboard before their customers are served."""
    trip, path = timed.trip, timed.path
    if not problem.limits_time_aboard:
        return
    visits: list[tuple[str, Stop | Visit]] = [
        (f"{path}.stops[{index}]", stop) for index, stop in trip.numbered_stops]
    visits += [(f"{path}.sorties[{index}].visits[{number}]", visit)
              for index, sortie in enumerate(trip.sorties)
              for number, visit in enumerate(sortie.visits)]
    for place, visit in visits:
        excess = excess_aboard(problem, kind, trip, visit)
        if excess > 0:
            customer = problem.customer_at(visit.node)
            yield Violation("TIME_ABOARD", f"the parcel of {customer.id} is {seconds(excess)} too "
                            "long aboard before service", place)


def _drone_busy(timed: TimedTrip) -> Iterator[Violation]:
    """A drone is aboard when it is launched."""
    flying: set[int] = set()
    for group in timed.decision.operations or ():
        for index, is_launch in group:
            drone = timed.decision.sorties[index].drone
            if not is_launch:
                flying.discard(drone)
            elif drone in flying:
                path = f"{timed.path}.sorties[{index}]"
                yield Violation("DRONE_BUSY", f"drone-{drone + 1} is still on a sortie", path)
            else:
                flying.add(drone)


def _airborne_violations(vehicle_type: VehicleType, timed: TimedTrip) -> Iterator[Violation]:
    """Sorties that leave too many drones in the air, or their truck on its way."""
    sorties, most = timed.trip.sorties, vehicle_type.most_airborne
    for index, sortie in enumerate(sorties):
        flying = sum([other.launch_time <= sortie.launch_time < other.recovery_start
                      for other in sorties])
        if flying > most:
            message = f"{flying} drones in the air, at most {most} are allowed"
            yield Violation("MAX_AIRBORNE", message, f"{timed.path}.sorties[{index}]")
    for index, sortie in enumerate(sorties):
        if vehicle_type.truck_waits and sortie.launch_stop != sortie.recovery_stop:
            message = f"{vehicle_type.id} drives on while a drone is out"
            yield Violation("TRUCK_WAITS", message, f"{timed.path}.sorties[{index}]")


def _sortie_violations(
    problem: Problem,
    kind: int,
    trip: Trip,
    sortie: Sortie,
    path: str,
) -> Iterator[Violation]:
    vehicle_type = problem.vehicle_types[kind]
    drones, count = vehicle_type.drone_type(sortie.drone), vehicle_type.num_drones
    if not 0 <= sortie.drone < count:
        yield Violation("COUNT", f"there is no drone-{sortie.drone + 1}: it has {count}", path)
    if not 1 <= len(sortie.visits) <= drones.max_customers_per_sortie:
        message = f"{len(sortie.visits)} customers, 1 to {drones.max_customers_per_sortie} allowed"
        yield Violation("SORTIE_SIZE", message, path)
    yield from _visit_violations(problem, kind, enumerate(sortie.visits), f"{path}.visits")
    payload = highest(sortie_loads(problem, sortie))
    if _exceeds(payload, drones.capacity):
        message = (f"payload {amounts(problem, payload)} exceeds "
                   f"{amounts(problem, drones.capacity)}")
        yield Violation("PAYLOAD", message, path)
    for what, stop in (("takes off", sortie.launch_stop), ("is recovered", sortie.recovery_stop)):
        node = trip.stops[stop].node
        if not problem.may_launch_at(node):
            yield Violation("LAUNCH", f"no drone {what} at {problem.place_at(node).id}", path)
    flight = airborne_duration(problem, drones, trip, sortie)
    if flight > drones.endurance:
        yield _endurance_violation(flight, drones.endurance, path)
    zones = zones_of(problem, [trip.stops[sortie.launch_stop].node, *(
        visit.node for visit in sortie.visits), trip.stops[sortie.recovery_stop].node])
    yield from _storm_violations(drones, zones, sortie.launch_time, sortie.recovery_start, path)
    if drones.max_range is not None:
        ends = [trip.stops[stop].node for stop in (sortie.launch_stop, sortie.recovery_stop)]
        yield from _range_violations(problem, drones, ends, sortie.visits, f"{path}.visits", 0)


def _range_violations(problem: Problem, flyer: DroneType | VehicleType, ends: Sequence[int],
                      visits: Sequence[Stop | Visit], path: str,
                      first_index: int) -> Iterator[Violation]:
    """Customers who lie too far from where a flight begins, or ends."""
    for index, visit in enumerate(visits, first_index):
        far, limit = farthest(problem, flyer, ends, visit.node), flyer.max_range
        if limit is not None and far > limit:
            message = (f"customer {problem.customer_at(visit.node).id} lies {decimal(far)} m from "
                       f"where it is launched or recovered, at most {decimal(limit)} m are allowed")
            yield Violation("MAX_RANGE", message, f"{path}[{index}]")


def farthest(problem: Problem, flyer: DroneType | VehicleType, ends: Sequence[int],
             node: int) -> int:
    """Return how far a customer lies from the ends of a flight, at most, straight."""
    distance = problem.travel[flyer.straight].distance
    return max(distance.item(end, node) for end in ends)


def _endurance_violation(flight: int, endurance: int, path: str) -> Violation:
    return Violation("ENDURANCE", f"{seconds(flight)} in the air, endurance is "
                     f"{seconds(endurance)}", path)


def _storm_violations(flyer: DroneType | VehicleType, zones: int, takeoff: int, end: int,
                      path: str) -> Iterator[Violation]:
    """Whether it is in the air while it storms, or while a zone is closed to which it flies."""
    if storm_met(flyer, 0, takeoff, end) is not None:
        yield Violation("WIND", "flies while the wind is too strong for it", path)
    if closing_met(flyer, zones, takeoff, end):
        yield Violation("AIRSPACE", "flies to or from a zone in the hours in which that is closed",
                        path)


def _energy_violation(taken: int, charge: int, path: str) -> Violation:
    return Violation("ENERGY", f"takes {watt_hours(taken)}, {watt_hours(max(0, charge))} are there",
                     path)


def _energy_violations(problem: Problem, vehicle_type: VehicleType,
                       timed: TimedTrip) -> Iterator[Violation]:
    """Sorties that take more than there is, beside the reserve, as they are launched."""
    trip = timed.trip
    there = charges(problem, vehicle_type, trip)
    for index, (sortie, charge) in enumerate(zip(trip.sorties, there, strict=True)):
        drones = vehicle_type.drone_type(sortie.drone)
        energy = drones.energy
        if energy is None:
            continue
        taken = sortie_energy(problem, drones, energy, trip, sortie)
        if taken > charge:
            yield _energy_violation(taken, charge, f"{timed.path}.sorties[{index}]")


def airborne_duration(problem: Problem, drones: DroneType, trip: Trip, sortie: Sortie) -> int:
    """Return what counts against endurance."""
    if drones.endurance_includes_waiting or not sortie.visits:
        return sortie.recovery_start - sortie.launch_time
    last, node = sortie.visits[-1], trip.stops[sortie.recovery_stop].node
    homeward = problem.travel[drones.travel].duration.item(last.node, node)
    return last.departure + homeward - sortie.launch_time


def _place_violations(problem: Problem, vehicle_type: VehicleType, trips: list[TimedTrip],
                      has_begun: bool) -> Iterator[Violation]:
    """Each trip begins where the one before ended, at a depot; the outer ends have places.

    Vehicles all of whose trips had begun may stay where the last one was to end.
    """
    begin = vehicle_type.begins_at
    for index, timed in enumerate(trips):
        first, *_, last = [stop.node for stop in timed.trip.stops]
        ends = [*vehicle_type.reload_places]
        if index == len(trips) - 1:
            ends = [vehicle_type.ends_at, *(ends if has_begun else ())]
        if first != begin:
            message = (f"{vehicle_type.id} begins the trip at {problem.place_at(begin).id}, not "
                       f"{problem.place_at(first).id}")
            yield Violation("DEPOT", message, f"{timed.path}.stops[0]")
        if last not in ends:
            message = (f"{vehicle_type.id} ends the trip at {problem.place_at(ends[0]).id}, not "
                       f"{problem.place_at(last).id}")
            yield Violation("DEPOT", message, f"{timed.path}.stops[{len(timed.trip.stops) - 1}]")
        begin = last


def route_violations(
    problem: Problem, vehicle_type: VehicleType, trips: list[TimedTrip], metrics: RouteMetrics,
    path: str, has_begun: bool = False,
) -> Iterator[Violation]:
    """What trips break together: goods, where they begin and end, batteries, shift, work."""
    there = trip_charges(problem, vehicle_type, [timed.trip for timed in trips])
    for timed, charge in zip(trips, there, strict=False):
        taken = timed.metrics.energy
        if taken is not None and taken > charge:
            yield _energy_violation(taken, charge, timed.path)
    yield from _goods_violations(problem, trips, "vehicle", path)
    yield from _place_violations(problem, vehicle_type, trips, has_begun)
    ready, over = vehicle_type.earliest, allowed_overtime(vehicle_type)
    more = f", with {seconds(over)} of overtime" if 0 < over < UNLIMITED else ""
    for index, timed in enumerate(trips):
        begin, end = timed.trip.stops[0].arrival, timed.trip.stops[-1].departure
        if begin < ready:
            code, cause = ("RELOAD", "reloaded") if index else ("SHIFT", "on shift")
            message = f"begins at {seconds(begin)}, {cause} at {seconds(ready)}"
            yield Violation(code, message, timed.path)
        if end > vehicle_type.latest + over:
            message = f"ends at {seconds(end)}, shift ends at {seconds(vehicle_type.latest)}{more}"
            yield Violation("SHIFT", message, timed.path)
        ready = end + vehicle_type.reload_duration
    for number, message in broken_breaks(problem, vehicle_type, [timed.trip for timed in trips]):
        yield Violation("BREAK", message, path if number is None else trips[number].path)
    for number, message in broken_driving(vehicle_type, [timed.trip for timed in trips]):
        yield Violation("DRIVING", message, trips[number].path)
    limit = vehicle_type.max_travel_duration
    if limit is not None and (travel := travel_duration(timed.trip for timed in trips)) > limit:
        message = f"is on legs for {seconds(travel)}, at most {seconds(limit)} are allowed"
        yield Violation("TRAVEL_DURATION", message, path)
    limit = vehicle_type.max_distance
    if limit is not None and (distance := limited_distance(
            problem, vehicle_type, [timed.trip for timed in trips])) > limit:
        message = f"drives {decimal(distance)} m, at most {decimal(limit)} m are allowed"
        yield Violation("DISTANCE", message, path)
    limit = vehicle_type.max_working_duration
    if limit is not None and metrics.working_duration > limit + over:
        message = (f"works {seconds(metrics.working_duration)}, at most {seconds(limit)} are "
                   f"allowed{more}")
        yield Violation("WORKING_DURATION", message, path)
