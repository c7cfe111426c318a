"""A trip so far, as the oracle of the mask sees it, and what its drones could do."""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import groupby

from model.judge.clock import opening
from model.judge.energy import (
    charges, hover_energy, leg_energy, power_at, sortie_energy, weights_aboard,
)
from model.judge.flown_trips import charged_between, trip_energy
from model.judge.lags import starts_of
from model.judge.pairs import flown_back, flown_out
from model.judge.rules import airborne_duration
from model.judge.takeoff import storm_met
from model.judge.timing import (
    Operation, SortieDecision, TripDecision, latest_release, schedule_trip,
)
from model.problem import DroneType, Problem, VehicleType, zones_of
from model.solution import Route, Sortie, Stop, Trip

MOST_TIMED = 1000
"""Lists of trips whose times are kept, and answers: those that the next actions ask for again."""


@dataclass(frozen=True)
class Flight:
    """A sortie; `recovery_stop` is None while it is in the air."""

    customer: int
    drone: int
    launch_stop: int
    recovery_stop: int | None = None


@dataclass(frozen=True)
class OpenTrip:
    """A trip so far, with the launches and recoveries of each stop in order."""

    nodes: tuple[int, ...]
    flights: tuple[Flight, ...] = ()
    operations: tuple[tuple[Operation, ...], ...] = ((),)
    begins: int = 0  # no sooner, so that no parcel of those served so far is aboard too long

    @property
    def flying(self) -> list[int]:
        """Sorties in the air."""
        return [index for index, flight in enumerate(self.flights) if flight.recovery_stop is None]

    def decision(self) -> TripDecision:
        """Return the decisions of a trip that is over."""
        sorties = tuple(SortieDecision((f.customer,), f.launch_stop, f.recovery_stop or 0, f.drone)
                        for f in self.flights)
        return TripDecision(self.nodes, sorties, self.operations)


@lru_cache(MOST_TIMED)
def timed_trips(problem: Problem, kind: int, trips: tuple[OpenTrip, ...],
                 start: int | None) -> tuple[Trip, ...]:
    """Time trips; those before the last are mostly known, as they are over."""
    if not trips:
        return ()
    before = timed_trips(problem, kind, trips[:-1], start)
    vehicle_type, last = problem.vehicle_types[kind], trips[-1]
    ready = vehicle_type.earliest
    if before:
        ready = before[-1].stops[-1].departure + vehicle_type.reload_duration
    decision = last.decision()
    begin = max(ready, last.begins, latest_release(problem, decision))
    if start is not None and not before:
        begin = start
    decision = replace(decision, start=begin)
    return (*before, schedule_trip(problem, vehicle_type, decision, ready, before))


def flight_duration(problem: Problem, kind: VehicleType, trip: OpenTrip, index: int,
                    to: int) -> int:
    """Return how long a flight takes that ends at `to`, if nobody waits."""
    drones = kind.drone_type(trip.flights[index].drone)
    flight, legs = trip.flights[index], problem.travel[drones.travel].duration
    service = drones.service_at(problem.customer_at(flight.customer))
    here = trip.nodes[flight.launch_stop]
    setup = problem.setup_between(here, flight.customer)
    return legs.item(here, flight.customer) + setup + service + legs.item(flight.customer, to)


def lasts(problem: Problem, kind: VehicleType, trip: OpenTrip, index: int, to: int) -> bool:
    """Tell whether a flight may end at `to`, and endurance and energy suffice if nobody waits.

    Not where what it fetches is delivered: that is to be aboard before.
    """
    flight = trip.flights[index]
    each = problem.shipment_at.get(to)
    if each is not None and to == each.delivery and flight.customer in each.pickups:
        return False
    drones = kind.drone_type(flight.drone)
    if not (problem.may_launch_at(to) and in_range(problem, drones, to, flight.customer)):
        return False
    if flight_duration(problem, kind, trip, index, to) > drones.endurance:
        return False
    if drones.energy is None:
        return True
    legs, customer = problem.travel[drones.travel].duration, problem.customer_at(flight.customer)
    brought, taken_back = weights_aboard(problem, drones.energy, [flight.customer])
    here = trip.nodes[flight.launch_stop]
    out = legs.item(here, flight.customer) + problem.setup_between(here, flight.customer)
    taken = leg_energy(drones.energy, out, brought) + leg_energy(
        drones.energy, legs.item(flight.customer, to), taken_back)
    if not drones.energy.lands:
        taken += hover_energy(drones.energy, drones.service_at(customer), brought)
    return taken <= drones.energy.available


def in_range(problem: Problem, drones: DroneType, node: int, customer: int) -> bool:
    """Tell whether a customer may be flown to from a node, or back."""
    distance = problem.travel[drones.straight].distance.item(node, customer)
    return drones.max_range is None or distance <= drones.max_range


def drones_of(kind: VehicleType, trip: OpenTrip, index: int) -> DroneType:
    """Return the type of drones one of which flies a sortie."""
    return kind.drone_type(trip.flights[index].drone)


def served_at(problem: Problem, kind: VehicleType, stop: Stop) -> int:
    """Return when a truck has done its own service at a stop."""
    if stop.node < problem.num_depots:
        return stop.service_start
    return stop.service_start + kind.service_at(problem.customer_at(stop.node))


def back_at(problem: Problem, kind: VehicleType, trip: OpenTrip, index: int, take_off: int) -> int:
    """Return when a loop is back that takes off then."""
    flight, legs = trip.flights[index], problem.travel[
        drones_of(kind, trip, index).travel].duration
    place, customer = trip.nodes[flight.launch_stop], problem.customer_at(flight.customer)
    begun = (take_off + legs.item(place, flight.customer)
             + problem.setup_between(place, flight.customer))
    waiting = max(0, opening(customer, begun) - begun)
    return take_off + waiting + flight_duration(problem, kind, trip, index, place)


def by_return(problem: Problem, kind: VehicleType, trip: OpenTrip, timed: Trip) -> OpenTrip:
    """Return a trip whose recoveries that take no time are, one behind another, as drones return.
    """
    def takes_time(operation: Operation) -> bool:
        drones = drones_of(kind, trip, operation.sortie)
        return operation.is_launch or drones.recovery_duration > 0

    def back(operation: Operation) -> int:
        flown = timed.sorties[operation.sortie]
        legs = problem.travel[drones_of(kind, trip, operation.sortie).travel].duration
        last, place = flown.visits[-1], timed.stops[flown.recovery_stop]
        return last.departure + legs.item(last.node, place.node)

    groups = []
    for group in trip.operations:
        runs = [(is_slow, list(run)) for is_slow, run in groupby(group, takes_time)]
        groups.append(tuple([operation for is_slow, run in runs for operation in (
            run if is_slow else sorted(run, key=back))]))
    return replace(trip, operations=tuple(groups))


def preferred(problem: Problem, kind: VehicleType, trip: OpenTrip, node: int,
              free: list[int]) -> list[int]:
    """Return the drones that lift a parcel so far and have a battery, first who could come back.
    """
    asked = flown_out(problem, node), flown_back(problem, node)

    def lifts(drone: int) -> bool:
        drones = kind.drone_type(drone)
        flown = [flight for flight in trip.flights
                 if kind.drone_index(flight.drone) == kind.drone_index(drone)]
        return (in_range(problem, drones, trip.nodes[-1], node)
                and all(amount <= most for amounts in asked
                    for amount, most in zip(amounts, drones.capacity, strict=True))
                and (drones.batteries is None or len(flown) < drones.batteries))

    def comes_back(drone: int) -> bool:
        here = trip.nodes[-1]
        tried = replace(trip, flights=(Flight(node, drone, len(trip.nodes) - 1),))
        return lasts(problem, kind, tried, 0, here)

    able = [drone for drone in free if lifts(drone)]
    return sorted(able, key=lambda drone: not comes_back(drone))


def keeps_lags(problem: Problem, route: Route) -> bool:
    """Tell whether all on a route are served as long behind others as they should."""
    starts = starts_of(route.visits)
    return all(lag.least <= start - starts[lag.node] <= lag.most for node, start in starts.items()
               for lag in problem.lags.get(node, ()) if lag.node in starts)


def drained(problem: Problem, kind: VehicleType, trip: Trip, index: int) -> bool:
    """Tell whether a sortie takes more than its battery has."""
    drones = kind.drone_type(trip.sorties[index].drone)
    return drones.energy is not None and sortie_energy(
        problem, drones, drones.energy, trip, trip.sorties[index]) > charges(
        problem, kind, trip)[index]


def excess_of_charge(problem: Problem, kind: VehicleType, before: tuple[Trip, ...],
                     timed: Trip) -> int:
    """Return by how much later a trip has to begin at least to be charged for all it takes."""
    energy, needed = kind.energy, trip_energy(problem, kind, timed) or 0
    if energy is None or not (kind.flies and energy.charge):
        return 0
    there, = charged_between(problem, kind, before, timed.stops[0].arrival)
    if not there < needed <= energy.available:
        return 0
    hover = 0 if energy.lands else max(
        power_at(energy, energy.hover, weight) for weight in weights_aboard(
            problem, energy, [stop.node for stop in timed.stops[1:-1]]))
    return -((there - needed) // (energy.charge + hover))


def in_storm(problem: Problem, kind: VehicleType, trip: Trip, launched: Sortie,
             recovered: Sortie) -> bool:
    """Tell whether it storms from the take-off of a sortie to its recovery, as another says when.

    Or a zone is closed to which the sortie flies.
    """
    drones = kind.drone_type(launched.drone)
    ends = [trip.stops[stop].node for stop in (launched.launch_stop, launched.recovery_stop)]
    zones = zones_of(problem, [*ends, *(visit.node for visit in launched.visits)])
    return storm_met(drones, zones, launched.launch_time, recovered.recovery_start) is not None


def cannot_be_flown(problem: Problem, kind: VehicleType, trip: Trip, index: int) -> bool:
    """Tell whether a sortie lasts too long, into a storm, or begins too far from its customer."""
    sortie = trip.sorties[index]
    drones = kind.drone_type(sortie.drone)
    return (drones.endurance < airborne_duration(problem, drones, trip, sortie)
            or drained(problem, kind, trip, index) or in_storm(problem, kind, trip, sortie, sortie)
            or not in_range(problem, drones, trip.stops[sortie.launch_stop].node,
                            sortie.visits[0].node))
