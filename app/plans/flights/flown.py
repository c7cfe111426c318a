"""What of a plan is flown: drones' sorties, and trips of vehicles that fly by themselves."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from app.requests.conversion.launches import drones_named
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.winds import Winds
from app.schemas.drones import Flyer
from app.schemas.plan import PlanInput, RouteInput, StopInput, TripInput, VisitInput
from app.schemas.vehicle import VehicleTypeInput
from model.travel.wind import Breeze


@dataclass(frozen=True)
class PlannedFlight:
    """A flight as a plan has it. Times in seconds since plan start."""

    vehicle: str
    drone: str
    flyer: Flyer
    winds: tuple[Breeze, ...]  # of the hours of the shift; (): the steady one
    nodes: tuple[int, ...]
    launch: str  # id of the stop
    recovery: str
    visits: tuple[VisitInput | StopInput, ...]
    launch_time: float
    met_time: float  # when the recovery begins
    recovery_time: float
    number: int = 0  # of the drone's flights, from 1


def flown_in(placed: PlacedRequest, plan: PlanInput) -> Iterator[PlannedFlight]:
    """Yield all flights, by vehicle in the order of take-off."""
    nodes = {name: node for node, name in enumerate(placed.names)}
    types = {kind.id: kind for kind in placed.request.fleet}
    winds = Winds(placed.request)
    for route in plan.routes:
        kind = types[route.type]
        flights = _trips if kind.flies else _sorties
        found = [each for trip in route.trips
                 for each in flights(route, trip, kind, winds, nodes)]
        flown: dict[str, int] = {}
        for each in sorted(found, key=lambda each: each.launch_time):
            number = flown[each.drone] = flown.get(each.drone, 0) + 1
            yield replace(each, number=number)


Nodes = Mapping[tuple[str, str], int]


def _sorties(route: RouteInput, trip: TripInput, kind: VehicleTypeInput, winds: Winds,
             nodes: Nodes) -> Iterator[PlannedFlight]:
    for sortie in trip.sorties:
        drones = drones_named(kind, sortie.drone)
        if drones is None:
            continue
        launch, recovery = trip.stops[sortie.launch_stop], trip.stops[sortie.recovery_stop]
        yield PlannedFlight(
            vehicle=route.vehicle, drone=sortie.drone, flyer=drones,
            winds=winds.flown(kind, drones),
            nodes=(_node(nodes, launch), *(nodes["customer", visit.id]
                                           for visit in sortie.customers), _node(nodes, recovery)),
            launch=launch.id, recovery=recovery.id, visits=sortie.customers,
            launch_time=sortie.launch_time,
            met_time=sortie.recovery_time - drones.recovery_duration,
            recovery_time=sortie.recovery_time)


def _trips(route: RouteInput, trip: TripInput, kind: VehicleTypeInput, winds: Winds,
           nodes: Nodes) -> Iterator[PlannedFlight]:
    """Yield a trip, unless nobody is on it."""
    launch, *visits, recovery = trip.stops
    if visits:
        yield PlannedFlight(
            vehicle=route.vehicle, drone=route.vehicle, flyer=kind, winds=winds.flown(kind, kind),
            nodes=tuple(_node(nodes, stop) for stop in trip.stops),
            launch=launch.id, recovery=recovery.id, visits=tuple(visits),
            launch_time=launch.departure, met_time=recovery.arrival,
            recovery_time=recovery.departure)


def _node(nodes: Nodes, stop: StopInput) -> int:
    return nodes[stop.kind, stop.id]
