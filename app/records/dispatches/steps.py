"""A plan and its problem -> what each driver does, step by step."""

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import get_args

from app.records.dispatches.schemas import (
    GoodsReply, DestinationReply, StepKind, StepReply, WindowReply,
)
from app.requests.conversion.launches import drones_named, launch_durations
from app.schemas.customer import CustomerInput
from app.schemas.fields import Avoided, point_of
from app.schemas.plan import RouteInput, SortieInput, StopInput, TripInput
from app.schemas.request import PlanRequest
from app.schemas.vehicle import PlaceInput, VehicleTypeInput

GEOGRAPHIC = "geographic"

ID_LENGTH = 16
"""Hexadecimal digits that tell a vehicle's steps apart."""

_RANKS: Mapping[StepKind, int] = {"return": 0, "recover": 1, "launch": 2, "stop": 3, "depart": 4}
"""Of steps at the same time: drones are met and sent off before the driver goes to the door."""


@dataclass(frozen=True)
class TimedStep:
    """A step and when it begins, by which those at one stop are ordered."""

    begin: float
    step: StepReply


def stop_kind(trip: TripInput, number: int) -> StepKind | None:
    """Return what a driver does at a stop but for drones; None: nothing to tell of."""
    if trip.stops[number].kind in ("launch_site", "break"):
        return None
    if trip.stops[number].kind == "customer":
        return "stop"
    return "depart" if number == 0 else "return"


def stop_ids(index: int, trip: TripInput, number: int) -> list[str]:
    """Return the name of what a driver does at a stop of a vehicle's trip but for drones, if any.
    """
    kind = stop_kind(trip, number)
    return [] if kind is None else [_step_id(index, kind, [trip.stops[number].id])]


def flight_id(index: int, kind: StepKind, sortie: SortieInput) -> str:
    """Return the name of a launch or a recovery on a vehicle's trip."""
    return _step_id(index, kind, [visit.id for visit in sortie.customers])


def _step_id(index: int, kind: StepKind, served: Sequence[str]) -> str:
    """Name a step by whom it is for: so it is the same in another plan of the day."""
    told = hashlib.sha256("\n".join(served).encode()).hexdigest()[:ID_LENGTH]
    return f"{index + 1}-{kind}-{told}"


class StepMaker:
    """Makes the steps of routes of one problem."""

    def __init__(self, problem: PlanRequest) -> None:
        self._is_geographic = problem.coordinate_system == GEOGRAPHIC
        self._depots = {depot.id: point_of(depot.location) for depot in problem.depots}
        self._customers = {customer.id: customer for customer in problem.customers}
        ends = [shipment.named_ends() for shipment in problem.shipments]
        self._fetched = frozenset([name for named in ends for name, _ in named[:-1]])
        self._shipped = self._fetched.union([named[-1][0] for named in ends])
        # Those come back to are named as depots and customers are.
        self._sites = (
            self._depots
            | {customer.id: point_of(customer.location) for customer in problem.customers}
            | {site.id: point_of(site.location) for site in problem.launch_sites})
        self._types = {kind.id: kind for kind in problem.fleet}
        self._units = [dimension.unit or dimension.name
                       for dimension in problem.load_dimensions or ()]

    def steps(self, route: RouteInput) -> list[StepReply]:
        """Return what the driver of a route does, in order."""
        kind = self._types[route.type]
        return [step for index, trip in enumerate(route.trips)
                for step in self._steps_of_trip(kind, index, trip)]

    def _steps_of_trip(self, kind: VehicleTypeInput, index: int,
                       trip: TripInput) -> list[StepReply]:
        at_stops = [list(self._visits(kind, index, trip, position))
                    for position in range(len(trip.stops))]
        for number, (sortie, lasts) in enumerate(
                zip(trip.sorties, launch_durations(kind, trip), strict=True)):
            drones = drones_named(kind, sortie.drone)
            recovery = drones.recovery_duration if drones else 0.0
            at_stops[sortie.launch_stop].append(
                self._flight("launch", kind, index, trip, number, lasts / 1000))
            at_stops[sortie.recovery_stop].append(
                self._flight("recover", kind, index, trip, number, recovery))
        return [visit.step for visits in at_stops for visit in sorted(
            visits, key=lambda visit: (visit.begin, _RANKS[visit.step.kind]))]

    def _visits(self, kind: VehicleTypeInput, index: int, trip: TripInput,
                position: int) -> Iterator[TimedStep]:
        """Yield what is done at a stop but for drones, if anything."""
        stop, name = trip.stops[position], stop_kind(trip, position)
        if name is None:
            return
        times = {"stop": stop.service_start, "depart": stop.departure, "return": stop.arrival}
        (name_of_step,) = stop_ids(index, trip, position)
        step = self._step(name, kind, index, stop, position, times[name]).model_copy(
            update={"id": name_of_step})
        if name == "stop":
            customer = self._customers[stop.id]
            yield TimedStep(stop.service_start, step.model_copy(update={
                "windows": _windows(customer), "customers": [self._goods(stop.id)],
                "duration": stop.departure - stop.service_start}))
            return
        load = self._load(trip) if name == "depart" else None
        yield TimedStep(step.time, step.model_copy(update={"load": load}))

    def _flight(self, name: StepKind, kind: VehicleTypeInput, index: int, trip: TripInput,
                number: int, lasts: float) -> TimedStep:
        """Return the launch or the recovery of a drone."""
        sortie = trip.sorties[number]
        is_launch = name == "launch"
        position = sortie.launch_stop if is_launch else sortie.recovery_stop
        time = sortie.launch_time if is_launch else sortie.recovery_time
        step = self._step(name, kind, index, trip.stops[position], position, time)
        return TimedStep(time - lasts, step.model_copy(update={
            "id": flight_id(index, name, sortie), "drone": sortie.drone, "duration": lasts,
            "customers": [self._goods(visit.id) for visit in sortie.customers]}))

    def _step(self, name: StepKind, kind: VehicleTypeInput, index: int, stop: StopInput,
              position: int, time: float) -> StepReply:
        return StepReply(
            id="", kind=name, trip=index + 1, stop=position,
            place=stop.id, place_kind=stop.kind, location=self._location(kind, stop),
            avoid=[each for each in get_args(Avoided) if each in kind.avoid], arrival=stop.arrival,
            time=time, departure=stop.departure, duration=0.0, windows=[], drone=None, customers=[],
            load=None, load_units=self._units)

    def _location(self, kind: VehicleTypeInput, stop: StopInput) -> DestinationReply | None:
        if not self._is_geographic:
            return None
        if stop.kind == "customer":
            place = point_of(self._customers[stop.id].location)
        elif stop.kind == "depot":
            place = self._depots[stop.id]
        elif stop.kind == "launch_site":
            place = self._sites[stop.id]
        elif stop.kind == "start":
            place = point_of(kind.start_location)
        else:
            place = point_of(kind.end.location) if isinstance(kind.end, PlaceInput) else None
        return None if place is None else DestinationReply(latitude=place[1], longitude=place[0])

    def _load(self, trip: TripInput) -> list[float]:
        """Return what is aboard when a trip departs: all that it delivers but shipments."""
        demands = [_nothing(customer.demand) if name in self._shipped else customer.demand
                   for name in customers_of(trip.stops, trip.sorties)
                   for customer in [self._customers[name]]]
        return [_plain(sum(amounts)) for amounts in zip(*demands, strict=True)]

    def _goods(self, name: str) -> GoodsReply:
        """Return what is handed over to a customer, and taken in: at a pickup all that is its."""
        customer = self._customers[name]
        hand_over, take_in = customer.demand, customer.pickup
        if name in self._fetched:
            hand_over, take_in = _nothing(customer.demand), customer.demand
        return GoodsReply(id=name, hand_over=hand_over, take_in=take_in, info=customer.info)


def customers_of(stops: Sequence[StopInput], sorties: Sequence[SortieInput]) -> list[str]:
    """Return the customers of a trip, by truck and by drone."""
    return [*(stop.id for stop in stops if stop.kind == "customer"),
            *(visit.id for sortie in sorties for visit in sortie.customers)]


def _nothing(amounts: Sequence[float]) -> list[float]:
    return [0.0] * len(amounts)


def _windows(customer: CustomerInput) -> list[WindowReply]:
    windows = [WindowReply(earliest=window.earliest, latest=window.latest)
               for window in customer.windows]
    return [window for window in windows if window.earliest > 0 or window.latest is not None]


def _plain(amount: float) -> float:
    """Return a sum without the noise of binary fractions: amounts have at most nine decimals."""
    return round(amount, 9)
