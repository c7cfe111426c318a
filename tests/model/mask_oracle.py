"""What each action leads to, found in plain Python with the checker alone.

A second reading of the decision process: it keeps the decisions of one vehicle, times them with
`model.judge.timing`, and asks `check` whether the vehicle could go home after one more action.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import permutations

from model.judge.check import Evaluation, check
from model.judge.clock import opening
from model.judge.energy import Rest, charges, first_rest, sortie_energy
from model.judge.flown_trips import excess_of
from model.judge.holding import held
from model.judge.launches import launch_duration
from model.judge.pairs import hands_over
from model.judge.takeoff import charged_launch, held_takeoff
from model.judge.timing import Operation
from model.problem import UNREACHABLE, Problem, VehicleType
from model.simulation.actions import DRIVE, LAUNCH, NUM_KINDS, OPEN, RETURN
from model.solution import Route, Solution, Stop, Trip, Visit
from tests.model.fliers import without_taken
from tests.model.open_trip import (
    MOST_TIMED, Flight, OpenTrip, back_at, by_return, cannot_be_flown, drained, drones_of,
    excess_of_charge, in_storm, keeps_lags, lasts, preferred, served_at, timed_trips,
)
from tests.model.tiny_company import companions
from tests.model.tiny_hours import keeps_day

MINUTE = 60_000

WHOEVER_ELSE = {"SERVED_BY", "SKILLS", "VEHICLE"}
"""Rules that a stop or visit breaks whoever else is served, and when."""


@dataclass(frozen=True)
class Vehicle:
    """What one vehicle has done; the last trip is under way unless `is_idle`."""

    kind: int
    index: int
    trips: tuple[OpenTrip, ...] = ()
    is_idle: bool = True


def _recovered(trip: OpenTrip, to: int, loops: list[int], order: list[int],
               here: list[Operation]) -> OpenTrip:
    """Drive on to `to`, recovering the loops here and all others there, in the order given.

    `here` are the launches and recoveries of this stop.
    """
    last = len(trip.nodes) - 1
    flights = tuple(
        flight if flight.recovery_stop is not None
        else replace(flight, recovery_stop=last if index in loops else last + 1)
        for index, flight in enumerate(trip.flights))
    after = tuple(Operation(index, False) for index in order if index not in loops)
    return OpenTrip((*trip.nodes, to), flights, (*trip.operations[:-1], tuple(here), after),
                    trip.begins)


def _timed(problem: Problem, vehicle: Vehicle, trip: OpenTrip) -> Trip:
    """Time the last trip, cut short by a way home, as soon as possible."""
    home = problem.vehicle_types[vehicle.kind].ends_at
    if trip.nodes[-1] >= problem.num_depots:
        trip = OpenTrip((*trip.nodes, home), trip.flights, (*trip.operations, ()), trip.begins)
    return _timed_route(problem, replace(vehicle, trips=(*vehicle.trips[:-1], trip))).trips[-1]


def _timed_route(problem: Problem, vehicle: Vehicle, start: int | None = None) -> Route:
    """Time all trips, the first begun at `start`, the others no sooner than they are held."""
    trips = timed_trips(problem, vehicle.kind, vehicle.trips, start)
    return Route(vehicle.kind, vehicle.index, trips)


def _held(problem: Problem, vehicle: Vehicle, timed: Trip) -> Vehicle | None:
    """Return the vehicle with its trip held until no parcel is too long aboard, if that helps."""
    trip, kind = vehicle.trips[-1], problem.vehicle_types[vehicle.kind]

    def excess_of_last(timed: Trip) -> int:
        before = _timed_route(problem, replace(vehicle, trips=vehicle.trips[:-1])).trips
        return max(excess_of(problem, kind, timed), excess_of_charge(problem, kind, before, timed))

    def begun_at(start: int) -> OpenTrip:
        tried = replace(trip, begins=start)
        return by_return(problem, kind, tried, _timed(problem, vehicle, tried))

    later, helps = held(problem, kind, timed, lambda start: _timed(
        problem, vehicle, begun_at(start)), excess_of_last)
    if not helps:
        return None
    trip = trip if later is timed else begun_at(later.stops[0].arrival)
    return replace(vehicle, trips=(*vehicle.trips[:-1], trip))


def _rest(problem: Problem, kind: VehicleType, trip: Trip, drone: int, stop: int) -> Rest | None:
    """Return how a drone has last come aboard before a stop; None if nothing is charged there."""
    drones = kind.drone_type(drone)
    if drones.energy is None or not drones.energy.charge:
        return None
    flown = [index for index, sortie in enumerate(trip.sorties)
             if sortie.drone == drone and sortie.launch_stop < stop]
    if not flown:
        return first_rest(kind, drones.energy, drone)
    last = trip.sorties[flown[-1]]
    left = charges(problem, kind, trip)[flown[-1]]
    return Rest(left - sortie_energy(problem, drones, drones.energy, trip, last),
                last.recovery_time)


def _at_this_stop(problem: Problem, kind: VehicleType, recovered: OpenTrip,
                  arrived: list[Operation], crew: int, served: int,
                  rests: dict[int, Rest | None], loops: list[int]) -> list[Operation]:
    """Return what is done at the last stop, the crew being free from `crew` on.

    What can be launched first is, of sorties whose drones have come aboard as `rests` says, and
    with what is picked up there once it is `served`; loops are recovered behind, or while a launch
    is held back.
    """
    launches = list(rests)
    decision, order, back = recovered.decision(), list(arrived), dict[int, int]()
    launched = len(launches) < len(recovered.flights)

    def take_off(index: int) -> tuple[int, int]:
        """Return when a sortie would take off, and how long its launch lasts."""
        drones, path = drones_of(kind, recovered, index), decision.path_of(
            decision.sorties[index])
        lasting = launch_duration(drones, is_first=not launched)
        loaded = served if hands_over(problem, path[0], path[1:-1]) else 0
        begin = max(crew, loaded, charged_launch(problem, drones, path, rests[index]))
        return held_takeoff(problem, drones, path, begin + lasting), lasting

    def may_fly(index: int) -> bool:
        """Tell whether there is room in the air; the last is for those that come back here."""
        free = kind.most_airborne - len(back) - len(set(rests) - set(launches) - set(loops))
        return free > 1 or (free == 1 and (index in loops or not set(launches) & set(loops)))

    while launches or back:
        able = [index for index in launches if may_fly(index)]
        taken = {index: take_off(index) for index in able}
        launch = min(able, key=lambda index: (taken[index][0], recovered.flights[index].drone),
                     default=None)
        loop = min(back, key=lambda index: (back[index], recovered.flights[index].drone),
                   default=None)
        begin = 0 if launch is None else taken[launch][0] - taken[launch][1]
        if loop is not None and (launch is None or (
                begin > crew and max(crew, back[loop]) <= begin)):
            crew = max(crew, back.pop(loop)) + drones_of(kind, recovered, loop).recovery_duration
            order.append(Operation(loop, False))
        elif launch is not None:
            crew, launched = taken[launch][0], True
            order.append(Operation(launch, True))
            launches = [index for index in launches if index != launch]
            if launch in loops:
                back[launch] = back_at(problem, kind, recovered, launch, crew)
    return order


def _settle(problem: Problem, vehicle: Vehicle, to: int) -> Vehicle | None:
    """Drive the vehicle to a node; None if a sortie can be recovered neither here nor there."""
    trip = vehicle.trips[-1]
    if trip.flying:
        return _settle_flights(problem, vehicle, to)
    settled = _recovered(trip, to, [], [], list(trip.operations[-1]))
    return _held(problem, replace(vehicle, trips=(*vehicle.trips[:-1], settled)),
                 _timed(problem, vehicle, settled))


def _to_come_back(problem: Problem, kind: VehicleType, trip: OpenTrip, to: int) -> list[int]:
    """Return the sorties that can't end at `to`, or that would be too many in the air meanwhile."""
    away = [index for index in trip.flying if lasts(problem, kind, trip, index, to)]
    away.sort(key=lambda index: trip.flights[index].drone)
    away = away[:0 if kind.truck_waits else kind.most_airborne]
    return [index for index in trip.flying if index not in away]


def _settle_flights(problem: Problem, vehicle: Vehicle, to: int) -> Vehicle | None:
    """Drive the vehicle to a node while drones are in the air."""
    trip = vehicle.trips[-1]
    vehicle_type, flying = problem.vehicle_types[vehicle.kind], trip.flying
    loops = _to_come_back(problem, vehicle_type, trip, to)
    while True:
        here = len(trip.nodes) - 1
        operations = list(trip.operations[-1])
        arrived = [operation for operation in operations if not operation.is_launch]
        rough = _recovered(trip, to, loops, flying, [
            *operations, *(Operation(index, False) for index in loops)])
        timed = _timed(problem, vehicle, rough)
        crew = max([timed.stops[here].ready,
                    *(timed.sorties[index].recovery_time for index, _ in arrived)])
        rests = {index: _rest(problem, vehicle_type, timed, trip.flights[index].drone, here)
                 for index in flying}
        operations = _at_this_stop(problem, vehicle_type, rough, arrived, crew,
                                   served_at(problem, vehicle_type, timed.stops[here]), rests,
                                   loops)
        settled = _recovered(trip, to, loops, flying, operations)
        timed = _timed(problem, vehicle, settled)
        arrivals = {}
        for index in flying:
            visit = timed.sorties[index].visits[0]
            place = timed.stops[timed.sorties[index].recovery_stop].node
            drones = drones_of(vehicle_type, trip, index)
            arrivals[index] = visit.departure + int(
                problem.travel[drones.travel].duration[visit.node, place])
        order = sorted(flying, key=lambda index: (arrivals[index], trip.flights[index].drone))
        if order != flying:
            settled = _recovered(trip, to, loops, order, operations)
            timed = _timed(problem, vehicle, settled)
        late = [index for index in order if arrivals[index] >= UNREACHABLE
                or cannot_be_flown(problem, vehicle_type, timed, index)]
        if not late:
            return _held(problem, replace(vehicle, trips=(*vehicle.trips[:-1], settled)), timed)
        if set(late) & set(loops):
            return None
        assert settled.flights[late[0]].recovery_stop == here + 1
        loops.append(late[0])


@lru_cache(MOST_TIMED)
def after(problem: Problem, vehicle: Vehicle, kind: int, node: int) -> Vehicle | None:
    """Return the vehicle after one more action, None if the action cannot be done at all."""
    start = problem.vehicle_types[vehicle.kind].begins_at
    if vehicle.trips:
        start = vehicle.trips[-1].nodes[-1]
    if vehicle.is_idle:
        if kind == RETURN:
            return None
        vehicle = replace(vehicle, trips=(*vehicle.trips, OpenTrip((start,))), is_idle=False)
    if kind == LAUNCH:
        return _launched(problem, vehicle, node)
    moved = _settle(problem, vehicle, node)
    return replace(moved, is_idle=kind == RETURN) if moved else None


def _launched(problem: Problem, vehicle: Vehicle, node: int) -> Vehicle | None:
    trip, vehicle_type = vehicle.trips[-1], problem.vehicle_types[vehicle.kind]
    each = problem.shipment_at.get(node)
    if each is not None and node == each.delivery and any(
            trip.flights[index].customer in each.pickups for index in trip.flying):
        return None  # it isn't aboard
    busy = {trip.flights[index].drone for index in trip.flying}
    free = [drone for drone in range(vehicle_type.num_drones) if drone not in busy]
    if len(vehicle_type.drone_types) > 1:
        free = preferred(problem, vehicle_type, trip, node, free)
    if not free:
        return None
    flight = Flight(node, free[0], len(trip.nodes) - 1)
    launch = Operation(len(trip.flights), True)
    operations = (*trip.operations[:-1], (*trip.operations[-1], launch))
    trip = OpenTrip(trip.nodes, (*trip.flights, flight), operations, trip.begins)
    return replace(vehicle, trips=(*vehicle.trips[:-1], trip))


@lru_cache(MOST_TIMED)
def judge(problem: Problem, vehicle: Vehicle, start: int | None) -> tuple[Route, Evaluation]:
    """Time and check the route of a vehicle at home whose first trip begins at `start`."""
    route = _timed_route(problem, vehicle, start)
    served = {node for trip in vehicle.trips for node in trip.nodes}
    served |= {flight.customer for trip in vehicle.trips for flight in trip.flights}
    rest = problem.left_out(served)
    return route, check(problem, Solution((route,), rest))


def costs_nothing(problem: Problem, soon: Route, late: Route) -> bool:
    """Tell whether a later start adds no lateness, lengthens no sortie and ends no later.

    With drones, nobody may be served in another window either, nor any battery be drained.
    """
    kind = problem.vehicle_types[soon.vehicle_type]
    has_drones = any(trip.sorties for trip in soon.trips)

    def may_be(halt: Stop | Visit, later: Stop | Visit) -> bool:
        customer = problem.customer_at(halt.node)
        starts = halt.service_start, later.service_start
        if has_drones and opening(customer, starts[0]) != opening(customer, starts[1]):
            return False
        return starts[1] <= max(starts[0], customer.latest)

    if _end(late) > _end(soon) or not (keeps_lags(problem, late) and keeps_day(problem, late)):
        return False
    for trip, other in zip(soon.trips, late.trips, strict=True):
        if not all(map(may_be, trip.customer_stops, other.customer_stops)):
            return False
        if any(drained(problem, kind, other, index) for index in range(len(other.sorties))):
            return False
        for sortie, flown in zip(trip.sorties, other.sorties, strict=True):
            longer = (flown.recovery_start - flown.launch_time
                      > sortie.recovery_start - sortie.launch_time)
            if longer or in_storm(problem, kind, trip, sortie, flown) or not all(
                    map(may_be, sortie.visits, flown.visits)):
                return False
    return True


def _end(route: Route) -> int:
    return route.trips[-1].stops[-1].departure


def _aboard(problem: Problem, vehicle: Vehicle) -> list[int]:
    """Return where the shipments aboard, at least in part, have still to be served."""
    if vehicle.is_idle or not vehicle.trips:
        return []
    last = vehicle.trips[-1]
    seen = {*last.nodes, *(flight.customer for flight in last.flights)}
    return [node for each in problem.shipments if seen & {*each.pickups}
            for node in each.nodes if not seen & {node, each.delivery}]


@lru_cache(MOST_TIMED)
def can_end(problem: Problem, vehicle: Vehicle | None, any_start: bool = False) -> bool:
    """Tell whether the vehicle can deliver what is aboard, go home and the plan be legal."""
    if vehicle is None:
        return False
    for order in permutations(_aboard(problem, vehicle)):
        later: Vehicle | None = vehicle
        for node in order:
            later = later and after(problem, later, DRIVE, node)
        if later is not None and _can_go_home(problem, later, any_start):
            return True
    return False


@lru_cache(MOST_TIMED)
def _may_serve(problem: Problem, type_index: int, kind: int, node: int) -> bool:
    """Tell whether the checker lets a vehicle type serve a customer so, whatever else it does."""
    alone = _gone_home(problem, after(problem, Vehicle(type_index, 0), kind, node))
    return alone is None or not WHOEVER_ELSE & {
        violation.code for violation in judge(problem, alone, None)[1].violations}


def _gone_home(problem: Problem, vehicle: Vehicle | None) -> Vehicle | None:
    if vehicle is None or vehicle.is_idle:
        return vehicle
    home = _settle(problem, vehicle, problem.vehicle_types[vehicle.kind].ends_at)
    return home and replace(home, is_idle=True)


def _can_go_home(problem: Problem, busy: Vehicle, any_start: bool) -> bool:
    """Tell whether the vehicle can go straight home and the plan be legal."""
    vehicle = _gone_home(problem, busy)
    if vehicle is None:
        return False
    soon, judged = judge(problem, vehicle, None)
    broken = {violation.code for violation in judged.violations}
    if not broken:
        return True
    if broken != {"WORKING_DURATION"} and not any_start:
        return False
    begin = soon.trips[0].stops[0].arrival
    for start in range(begin - begin % MINUTE, soon.trips[-1].stops[-1].departure, MINUTE):
        if not any_start:
            late = _timed_route(problem, vehicle, start)
            if _end(late) > _end(soon):  # and what begins later still doesn't end sooner
                return False
            if not costs_nothing(problem, soon, late):
                continue
        if judge(problem, vehicle, start)[1].is_feasible:
            return True
    return False


def legal_codes(problem: Problem, vehicle: Vehicle | None, served: set[int], used: list[int],
                any_start: bool = False) -> Iterator[int]:
    """Yield the code of every action that may be done next."""
    customers = [node for node in range(problem.num_depots, problem.num_nodes)
                 if node not in served]
    if vehicle is not None:
        vehicle_type = problem.vehicle_types[vehicle.kind]
        home = vehicle_type.ends_at
        actions = [(kind, node) for node in customers for kind in (DRIVE, LAUNCH)
                   if _may_serve(problem, vehicle.kind, kind, node)]
        for kind, node in [*actions, (RETURN, home)]:
            if can_end(problem, after(problem, vehicle, kind, node), any_start):
                yield node * NUM_KINDS + kind
        for place in {*vehicle_type.reload_places} - {home}:
            reloaded = after(problem, vehicle, RETURN, place)
            if reloaded is not None and _is_useful(problem, reloaded, customers, any_start):
                yield place * NUM_KINDS + RETURN
    if vehicle is None or (vehicle.is_idle and vehicle.trips
                           and vehicle.trips[-1].nodes[-1] == home):
        left = problem
        if vehicle is not None:
            route, _ = judge(problem, vehicle, None)
            left, alone = without_taken(problem, (route,)), companions(problem, route.served)
            customers = [node for node in customers if node not in alone]
        for kind, vehicle_type in enumerate(problem.vehicle_types):
            if used[kind] < vehicle_type.count and _is_useful(
                    left, Vehicle(kind, used[kind]), customers, any_start):
                yield kind * NUM_KINDS + OPEN


def _is_useful(problem: Problem, idle: Vehicle, customers: list[int], any_start: bool) -> bool:
    return any(can_end(problem, after(problem, idle, kind, node), any_start)
               for kind in (DRIVE, LAUNCH) for node in customers
               if _may_serve(problem, idle.kind, kind, node))
