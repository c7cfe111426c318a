"""When everything in a route happens, from the decisions that leave a choice.

A decision fixes sequences, launches and recoveries at each stop in order, when a trip begins, and
until when trucks wait for others. All else follows as soon as possible, but launches are held back
while windows would let a flight last longer than the endurance, or hover for more than its battery
holds, or that is being charged. Times in ms, plain Python integers."""

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from model.judge.breaks import BreakDecision, begin_of, decisions_of, drive, drive_on
from model.judge.clock import leg_end, service_start, with_setups
from model.judge.energy import Rest, first_rest
from model.judge.flown_trips import charged_start, excess_of
from model.judge.holding import held
from model.judge.lags import Awaited, awaited, waits_of
from model.judge.launches import launch_begins, launch_duration
from model.judge.pairs import hands_over
from model.judge.past import KnownTrip, resumed_service
from model.judge.takeoff import charged_launch, held_takeoff, rest_after
from model.problem import DroneType, Problem, VehicleType
from model.solution import Charge, OneVehicle, Route, Sortie, Stop, Trip, Visit


class Operation(NamedTuple):
    """Launch or recovery of a sortie at a stop."""

    sortie: int  # index into TripDecision.sorties
    is_launch: bool


@dataclass(frozen=True)
class SortieDecision:
    """Who flies where."""

    nodes: tuple[int, ...]  # customers, in order
    launch_stop: int  # index into TripDecision.nodes
    recovery_stop: int
    drone: int = 0


@dataclass(frozen=True)
class TripDecision:
    """What is free to choose in a trip."""

    nodes: tuple[int, ...]  # of all stops, depots included
    sorties: tuple[SortieDecision, ...] = ()
    operations: tuple[tuple[Operation, ...], ...] | None = None  # per stop; None: by arrival
    start: int | None = None  # arrival at the first stop; None: as soon as possible
    breaks: tuple[BreakDecision, ...] = ()
    awaited: tuple[Awaited, ...] = ()  # customers of orders across vehicles
    charges: tuple[Charge, ...] = ()

    def customers(self, first: int) -> tuple[int, ...]:
        """Return those whom it serves, whose nodes begin at `first`, the truck's first."""
        return (*[node for node in self.nodes[1:-1] if node >= first],
                *(node for sortie in self.sorties for node in sortie.nodes))

    def path_of(self, sortie: SortieDecision) -> tuple[int, ...]:
        """Return the nodes of a sortie: where it is launched, customers, where it is recovered."""
        return (self.nodes[sortie.launch_stop], *sortie.nodes, self.nodes[sortie.recovery_stop])

    def __post_init__(self) -> None:
        if len(self.nodes) < 2:
            raise ValueError(f"trip nodes: {self.nodes!r} is not allowed")
        for sortie in self.sorties:
            if not 0 <= sortie.launch_stop <= sortie.recovery_stop < len(self.nodes):
                raise ValueError(f"sortie stops: {sortie!r} is not allowed")
        if self.operations is not None and not _is_complete(self.operations, self.sorties):
            raise ValueError(f"trip operations: {self.operations!r} is not allowed")


@dataclass(frozen=True)
class RouteDecision(OneVehicle):
    """What is free to choose in a route."""

    trips: tuple[TripDecision, ...]


@dataclass
class _Flight:
    """A sortie that has taken off."""

    launch_time: int
    visits: tuple[Visit, ...]
    arrival: int  # at the recovery stop's node
    recovery_start: int = 0
    rest: Rest | None = None  # as it comes aboard, where batteries are charged there


def _is_complete(operations: tuple[tuple[Operation, ...], ...],
                 sorties: tuple[SortieDecision, ...]) -> bool:
    """Tell whether every sortie is launched and then recovered, once each, at its stops."""
    planned = [(stop, operation.sortie, not operation.is_launch)
               for stop, group in enumerate(operations) for operation in group]
    needed = [
        place
        for index, sortie in enumerate(sorties)
        for place in ((sortie.launch_stop, index, False), (sortie.recovery_stop, index, True))
    ]
    position = {place: index for index, place in enumerate(planned)}
    return sorted(planned) == sorted(needed) and all(
        position[launch] < position[recovery]
        for launch, recovery in zip(needed[::2], needed[1::2], strict=True)
    )


def read_decision(trip: Trip, kind: VehicleType, bound: Container[int] = ()) -> TripDecision:
    """Return the choices that a timed trip states; the order at a stop is that of beginnings.

    What takes no time comes before others that begin with it. Trucks wait at `bound` customers.
    """
    nodes = tuple([stop.node for stop in trip.stops])
    start, taken, waits = trip.stops[0].arrival, decisions_of(trip), waits_of(trip, bound)
    if not trip.sorties:
        return TripDecision(nodes, (), None, start, taken, waits, trip.charges)
    keyed: list[list[tuple[tuple[int, ...], Operation]]] = [[] for _ in nodes]
    sorties = []
    begins = launch_begins(trip.sorties, kind)
    for index, sortie in enumerate(trip.sorties):
        visited = tuple([visit.node for visit in sortie.visits])
        first, last = sortie.launch_stop, sortie.recovery_stop
        sorties.append(SortieDecision(visited, first, last, sortie.drone))
        begin, end = begins[index], sortie.launch_time
        phase = 1 if first == last else 2
        keyed[first].append(((begin, end, phase, index, 0), Operation(index, True)))
        recovery = (sortie.recovery_start, sortie.recovery_time, 0, index, 1)
        if first == last and sortie.recovery_start <= sortie.launch_time:
            recovery = (max(begin, recovery[0]), max(end, recovery[1]), phase, index, 1)
        keyed[last].append((recovery, Operation(index, False)))
    operations = tuple(tuple(operation for _, operation in sorted(group)) for group in keyed)
    return TripDecision(nodes, tuple(sorties), operations, start, taken, waits)


def latest_release(problem: Problem, decision: TripDecision) -> int:
    """Return when the last parcel of a trip is at the depot."""
    customers, first = problem.customers, len(problem.depots)
    return max([customers[node - first].release_time for node in decision.customers(first)],
               default=0)


def _fly(problem: Problem, drones: DroneType, decision: TripDecision, sortie: SortieDecision,
         launch_time: int) -> _Flight:
    """Return the flight of a sortie that takes off at `launch_time`."""
    duration = problem.travel[drones.travel].duration
    first = len(problem.depots)
    node, time = decision.nodes[sortie.launch_stop], launch_time
    visits = []
    for following in sortie.nodes:
        customer = problem.customers[following - first]
        arrival = time + duration.item(node, following)
        setup = problem.setup_between(node, following)
        start = service_start(customer, arrival + setup)
        time = start + drones.service_at(customer)
        visits.append(Visit(following, arrival, start, time, setup))
        node = following
    return _flight(problem, drones, decision, sortie, launch_time, tuple(visits))


def _flight(problem: Problem, drones: DroneType, decision: TripDecision, sortie: SortieDecision,
            launch_time: int, visits: tuple[Visit, ...]) -> _Flight:
    """Return the flight of a sortie whose visits are timed, so that it is known when it is back."""
    node, time = decision.nodes[sortie.launch_stop], launch_time
    if visits:
        node, time = visits[-1].node, visits[-1].departure
    home = problem.travel[drones.travel].duration.item(
        node, decision.nodes[sortie.recovery_stop])
    return _Flight(launch_time, visits, time + home)


def _by_arrival(sorties: tuple[SortieDecision, ...], stop: int, flights: dict[int, _Flight],
                most: int) -> Iterator[Operation]:
    """Yield recoveries of earlier sorties, then launches, then recoveries of loops.

    A drone's loop ends before it is launched again, and with it those that are back sooner; loops
    end, too, before more drones than `most` would be in the air. `flights` fills in the meantime.
    """
    def arrival(index: int) -> tuple[int, int]:
        return flights[index].arrival, index

    ends_here = [index for index, sortie in enumerate(sorties) if sortie.recovery_stop == stop]
    for index in sorted([i for i in ends_here if sorties[i].launch_stop < stop], key=arrival):
        yield Operation(index, False)
    loops: list[int] = []
    for index, sortie in enumerate(sorties):
        if sortie.launch_stop == stop:
            last = max([arrival(i) for i in loops if sorties[i].drone == sortie.drone],
                       default=(-1, -1))
            for loop in sorted([i for i in loops if arrival(i) <= last], key=arrival):
                loops.remove(loop)
                yield Operation(loop, False)
            away = sum([sorties[other].recovery_stop > stop for other in flights])
            while loops and away + len(loops) >= most:
                first = min(loops, key=arrival)
                loops.remove(first)
                yield Operation(first, False)
            yield Operation(index, True)
            if sortie.recovery_stop == stop:
                loops.append(index)
    for index in sorted(loops, key=arrival):
        yield Operation(index, False)


def _operate(problem: Problem, kind: VehicleType, decision: TripDecision, stop: int, time: int,
             served: int, flights: dict[int, _Flight], known: KnownTrip | None = None,
             now: int = 0) -> int:
    """Launch and recover at a stop from `time` on, in place; return when all is done.

    What a truck picks up there, until `served`, is launched no sooner. What is known stays, and
    nothing else begins before `now`.
    """
    operations: Iterable[Operation]
    if decision.operations is None:
        operations = _by_arrival(decision.sorties, stop, flights, kind.most_airborne)
    else:
        operations = decision.operations[stop]
    facts, earliest = ((), time) if known is None else (known.sorties, now)
    for index, is_launch in operations:
        fact = facts[index] if index < len(facts) else None
        sortie = decision.sorties[index]
        drones = kind.drone_type(sortie.drone)
        path, rest = decision.path_of(sortie), _rest_before(kind, decision, flights, index)
        if is_launch and fact is not None:
            time = fact.launch_time
            visits = with_setups(problem, decision.nodes[sortie.launch_stop], fact.visits)
            flights[index] = _flight(problem, drones, decision, sortie, time, visits)
        elif is_launch:
            loaded = served if hands_over(problem, path[0], sortie.nodes) else 0
            begin = max(time, earliest, loaded, charged_launch(problem, drones, path, rest))
            soonest = begin + launch_duration(drones, not flights)
            time = held_takeoff(problem, drones, path, soonest)
            flights[index] = _fly(problem, drones, decision, sortie, time)
        else:
            flight = flights[index]
            begun = None if fact is None else fact.recovery_start
            flight.recovery_start = (max(time, flight.arrival, earliest) if begun is None
                                     else begun)
            time = flight.recovery_start + drones.recovery_duration
            flight.rest = rest_after(problem, drones, rest, path, flight.visits,
                                     flight.launch_time, flight.recovery_start)
    return time


def _rest_before(kind: VehicleType, decision: TripDecision, flights: dict[int, _Flight],
                 index: int) -> Rest | None:
    """Return how the drone of a sortie came aboard before; None if nothing is charged there."""
    drone = decision.sorties[index].drone
    energy = kind.drone_type(drone).energy
    if energy is None or not energy.charge:
        return None
    rests = [flight.rest for other, flight in flights.items()
             if other != index and decision.sorties[other].drone == drone]
    return rests[-1] if rests else first_rest(kind, energy, drone)


def _timed_sorties(decision: TripDecision, flights: dict[int, _Flight],
                   kind: VehicleType) -> tuple[Sortie, ...]:
    return tuple(
        Sortie(sortie.drone, sortie.launch_stop, sortie.recovery_stop, flights[index].visits,
               flights[index].launch_time, flights[index].recovery_start,
               flights[index].recovery_start + kind.drone_type(sortie.drone).recovery_duration)
        for index, sortie in enumerate(decision.sorties)
    )


def schedule_trip(problem: Problem, vehicle_type: VehicleType, decision: TripDecision, ready: int,
                  before: Sequence[Trip] = ()) -> Trip:
    """Return a trip with its times; `before` are those of the route before it.

    Without a start of its own it begins once `ready`, or later if that keeps parcels from being
    aboard too long, anybody served too late after others, or who flies from a wait or a storm.
    """
    trip = _schedule_trip(problem, vehicle_type, decision, ready, before)
    if decision.start is not None or not (
            problem.limits_time_aboard or problem.limits_time_between or problem.lags
            or vehicle_type.flies):
        return trip
    return held(
        problem, vehicle_type, trip, lambda start: _schedule_trip(
            problem, vehicle_type, replace(decision, start=start), ready, before),
        lambda timed: excess_of(problem, vehicle_type, timed))[0]


def _schedule_trip(problem: Problem, vehicle_type: VehicleType, decision: TripDecision,
                   ready: int, before: Sequence[Trip]) -> Trip:
    duration, setup = problem.travel[vehicle_type.travel].duration, 0
    profile, drones = vehicle_type.speed_profile, vehicle_type.drones
    customers, first, last = problem.customers, len(problem.depots), len(decision.nodes) - 1
    flights, stops = dict[int, _Flight](), list[Stop]()
    arrival = decision.start
    if arrival is None:
        opens = problem.depots[decision.nodes[0]].earliest
        arrival = max(ready, latest_release(problem, decision), opens)
    began = before[0] if before else Trip((Stop(decision.nodes[0], arrival, arrival, arrival),))
    begin, breaks, departure, node = begin_of(vehicle_type, began), [], 0, 0
    for index, following in enumerate(decision.nodes):
        if index:
            leg = duration.item(node, following)
            arrival = leg_end(departure, leg, profile)
            if decision.breaks:
                arrival, taken = drive(vehicle_type, begin, departure, leg, [
                    each for each in decision.breaks if each.stop == index - 1])
                breaks += taken
            setup = problem.setup_between(node, following)
        node = following
        start = departure = arrival
        if index == 0:
            departure = max(arrival, vehicle_type.busy_until) + vehicle_type.launch_duration
        if index and node < first:
            start = departure = max(arrival, problem.depots[node].earliest)
            departure += vehicle_type.recovery_duration if index == last else 0
        elif index:
            customer = customers[node - first]
            start = service_start(customer, max(
                arrival + setup, awaited(problem, node, before, stops, flights, decision.awaited)))
            departure = start + vehicle_type.service_at(customer)
        if drones is not None and decision.sorties:
            departure = max(departure,
                            _operate(problem, vehicle_type, decision, index, start if node < first
                                     else arrival + setup, departure, flights))
        stops.append(Stop(node, arrival, start, departure, setup, problem.is_launch_site(node)))
    if drones is None or not decision.sorties:
        return Trip(tuple(stops), (), tuple(breaks), decision.charges)
    return Trip(tuple(stops), _timed_sorties(decision, flights, vehicle_type), tuple(breaks))


def resume_trip(problem: Problem, kind: VehicleType, decision: TripDecision,
                known: KnownTrip, now: int, before: Sequence[Trip] = ()) -> Trip:
    """Return a trip that is under way with its times; `before` are those of the route before it.

    What is known stays, its sorties being the first of the decision; all else follows as soon as
    possible from `now` on.
    """
    drones = kind.drones
    flights, stops, breaks = dict[int, _Flight](), list[Stop](), list(known.breaks)
    for index, node in enumerate(decision.nodes):
        fact = known.stops[index] if index < len(known.stops) else None
        if fact is not None:
            arrival = fact.arrival
        else:
            leg = problem.travel[kind.travel].duration.item(stops[-1].node, node)
            begin = begin_of(kind, before[0] if before else Trip(tuple(stops)))
            arrival, taken = drive_on(kind, begin, stops, leg, known.breaks, decision.breaks)
            breaks += taken
            arrival = max(arrival, 0 if problem.is_nowhere(node) else now)
        setup = problem.setup_between(stops[-1].node, node) if stops else 0
        ready = arrival + setup
        start, departure = resumed_service(problem, kind, node, max(
            ready, awaited(problem, node, before, stops, flights, decision.awaited)), fact, now)
        if node < problem.num_depots:
            ready = start
            departure += kind.recovery_duration if index == len(decision.nodes) - 1 else 0
        if drones is not None and decision.sorties:
            departure = max(departure, _operate(problem, kind, decision, index, ready,
                                                departure, flights, known, now))
        departure = departure if problem.is_nowhere(node) else max(departure, now)
        if fact is not None and fact.departure is not None:
            departure = fact.departure
        stops.append(Stop(node, arrival, start, departure, setup, problem.is_launch_site(node)))
    if drones is None or not decision.sorties:
        return Trip(tuple(stops), (), tuple(breaks), decision.charges)
    return Trip(tuple(stops), _timed_sorties(decision, flights, kind), tuple(breaks))


def schedule(problem: Problem, decision: RouteDecision) -> Route:
    """Return a route with its times; whether it is legal is for `check` to say.

    Raises
    ------
    ValueError
        If the decision names a vehicle type or a node that is not there, or has sorties where
        the type has no drones.
    """
    if not 0 <= decision.vehicle_type < len(problem.vehicle_types):
        raise ValueError(f"route vehicle_type: {decision.vehicle_type!r} is not allowed")
    vehicle_type = problem.vehicle_types[decision.vehicle_type]
    trips: list[Trip] = []
    ready = vehicle_type.earliest
    for trip in decision.trips:
        _require_known(problem, vehicle_type, trip)
        ready = max(ready, charged_start(problem, vehicle_type, trips, trip.nodes))
        trips.append(schedule_trip(problem, vehicle_type, trip, ready, trips))
        ready = trips[-1].stops[-1].departure + vehicle_type.reload_duration
    return Route(decision.vehicle_type, decision.vehicle, tuple(trips))


def _require_known(problem: Problem, vehicle_type: VehicleType, decision: TripDecision) -> None:
    """Raise `ValueError` for a node or a drone that is not there."""
    if decision.sorties and vehicle_type.drones is None:
        raise ValueError(f"trip sorties: {decision.sorties!r} is not allowed")
    for node in (decision.nodes[0], decision.nodes[-1]):
        if not 0 <= node < problem.num_depots:
            raise ValueError(f"trip depot: {node!r} is not allowed")
    for node in (*decision.nodes[1:-1], *(node for sortie in decision.sorties
                                          for node in sortie.nodes)):
        if not problem.is_launch_site(node):
            problem.customer_at(node)
