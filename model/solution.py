"""A plan: routes of trips, with the sorties flown from them. Times in ms, nodes as in `Problem`."""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from typing import Literal, NamedTuple

BreakPlace = Literal["departure", "way", "arrival"]
"""Where a break between two stops is taken: at the first, on the way, or at the second."""


@dataclass(frozen=True, slots=True)
class Stop:
    """A place where the truck stops.

    The first stop of a trip is the depot: `arrival` is when loading is done and launches may
    begin, `departure` when the truck leaves. The last stop is the depot again: `departure` is when
    truck and drones are all back, the end of the trip.
    """

    node: int
    arrival: int
    service_start: int  # equals `arrival` at depots
    departure: int
    setup: int = field(default=0, repr=False, compare=False)  # from arrival; follows from places
    is_launch_site: bool = field(default=False, repr=False, compare=False)  # follows from `node`

    @property
    def ready(self) -> int:
        """When the truck, set up, could serve, launch or recover."""
        return self.arrival + self.setup

    def at(self, node: int) -> "Stop":
        """Return the same at another node; `dataclasses.replace` takes several times as long."""
        return Stop(node, self.arrival, self.service_start, self.departure, self.setup,
                    self.is_launch_site)


@dataclass(frozen=True, slots=True)
class Visit:
    """A customer served by a drone."""

    node: int
    arrival: int
    service_start: int
    departure: int
    setup: int = field(default=0, repr=False, compare=False)  # from arrival; follows from places

    @property
    def ready(self) -> int:
        """When the drone, set up, could serve."""
        return self.arrival + self.setup


@dataclass(frozen=True, slots=True)
class Sortie:
    """One drone flight, from launch to recovery, within one trip."""

    drone: int  # 0-based, on its truck
    launch_stop: int  # index into Trip.stops
    recovery_stop: int  # the same stop or a later one
    visits: tuple[Visit, ...]
    launch_time: int  # take-off; the launch duration lies before it
    recovery_start: int
    recovery_time: int  # the end of recovery

    @property
    def nodes(self) -> tuple[int, ...]:
        """Whom it serves, in order."""
        return tuple([visit.node for visit in self.visits])


@dataclass(frozen=True, slots=True)
class TakenBreak:
    """A break of the driver, between two stops: after the departure from one, before the arrival
    at the next.
    """

    number: int  # index into VehicleType.breaks; `REST` of one that is asked by driving rules
    stop: int  # index into Trip.stops of the first of both
    place: BreakPlace
    arrival: int  # when the truck stands there
    start: int
    end: int


class Charge(NamedTuple):
    """From when until when a vehicle that flies is charged at a depot."""

    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Trip:
    """Depot to depot on one loading."""

    stops: tuple[Stop, ...]
    sorties: tuple[Sortie, ...] = ()
    breaks: tuple[TakenBreak, ...] = ()  # in order
    charges: tuple[Charge, ...] = ()  # before it, in order, where places to charge are shared

    @property
    def customer_stops(self) -> list[Stop]:
        """The stops at which the truck serves somebody."""
        return [stop for _, stop in self.numbered_stops]

    @property
    def numbered_stops(self) -> list[tuple[int, Stop]]:
        """The stops at which the truck serves somebody, each with its index."""
        return [(index, stop) for index, stop in enumerate(self.stops[1:-1], 1)
                if not stop.is_launch_site]

    @property
    def nodes(self) -> list[int]:
        """All places that it comes to, by truck and then by drones."""
        return [*[stop.node for stop in self.stops],
                *[node for sortie in self.sorties for node in sortie.nodes]]

    @property
    def visits(self) -> list[Stop | Visit]:
        """Where it serves somebody, by truck and then by drones."""
        return [*self.customer_stops,
                *[visit for sortie in self.sorties for visit in sortie.visits]]

    @property
    def served(self) -> list[int]:
        """Whom it serves, by truck and then by drones."""
        return [visit.node for visit in self.visits]


class Vehicle(NamedTuple):
    """One vehicle of the fleet."""

    type: int  # index into Problem.vehicle_types
    number: int  # 0-based, within its type


@dataclass(frozen=True, slots=True)
class OneVehicle:
    """What one vehicle does."""

    vehicle_type: int  # index into Problem.vehicle_types
    vehicle: int  # 0-based, within its type

    @property
    def driven_by(self) -> Vehicle:
        """The vehicle."""
        return Vehicle(self.vehicle_type, self.vehicle)


@dataclass(frozen=True, slots=True)
class Route(OneVehicle):
    """All trips of one vehicle, in order."""

    trips: tuple[Trip, ...]

    @property
    def visits(self) -> list[Stop | Visit]:
        """Where it serves somebody, trip by trip."""
        return [visit for trip in self.trips for visit in trip.visits]

    @property
    def served(self) -> list[int]:
        """Whom it serves, trip by trip."""
        return [visit.node for visit in self.visits]


@dataclass(frozen=True, slots=True)
class Solution:
    """A plan for a whole problem."""

    routes: tuple[Route, ...]
    unassigned: tuple[int, ...] = ()  # customer nodes

    @property
    def served(self) -> set[int]:
        """Whom it serves."""
        return {node for route in self.routes for node in route.served}


def _as_it_is(vehicle_type: int, vehicle: int) -> tuple[int, int]:
    return vehicle_type, vehicle


def renumbered(plan: Solution, node: Callable[[int], int],
               vehicle: Callable[[int, int], tuple[int, int]] = _as_it_is) -> Solution:
    """Return a plan with other numbers for its nodes and, if asked for, its vehicles.

    Errors of `node` and `vehicle` (a `KeyError`, say, for what has no number) come through.
    """
    def trip(old: Trip) -> Trip:
        return Trip(tuple([stop.at(node(stop.node)) for stop in old.stops]),
                    tuple(sortie(each) for each in old.sorties), old.breaks, old.charges)

    def sortie(old: Sortie) -> Sortie:
        return replace(old, visits=tuple([
            Visit(node(visit.node), visit.arrival, visit.service_start, visit.departure,
                  visit.setup) for visit in old.visits]))

    return Solution(tuple([Route(*vehicle(*route.driven_by),
                                 tuple(map(trip, route.trips))) for route in plan.routes]),
                    tuple(sorted(map(node, plan.unassigned))))


@dataclass(frozen=True, slots=True)
class Cost:
    """What a plan costs, by term."""

    fixed: float = 0.0
    distance: float = 0.0  # vehicles and drones
    stops: float = 0.0  # by trucks
    time: float = 0.0  # vehicles and drones
    overtime: float = 0.0
    lateness: float = 0.0
    earliness: float = 0.0
    makespan: float = 0.0  # of the plan as a whole
    balance: float = 0.0  # likewise
    too_few_vehicles: float = 0.0  # likewise
    unassigned: float = 0.0
    changes: float = 0.0  # of a plan gone on from

    @property
    def total(self) -> float:
        """Sum of all terms."""
        return sum([getattr(self, term) for term in COST_TERMS])


COST_TERMS = tuple(term.name for term in fields(Cost))
"""Names of the terms, as replies, pictures and people see them."""
