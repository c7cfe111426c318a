"""A plan that a client sends: a reply of `POST /plan`, as it is or cut down to what decides.

What follows from the rest, such as loads and costs, may be there and is not read: it is computed
anew.
"""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.schemas.customer import customer_of, place_of
from app.schemas.fields import Location
from app.schemas.limits import MAX_VEHICLES
from app.schemas.shipment import ENDS, EndKind, end_name
from app.schemas.times import READ_ANY_INSTANT, PlanStart, TimeZone
from model.problem import UNLIMITED

MAX_INSTANT = UNLIMITED / 1000
"""Farthest instant from the plan's start in seconds; no vehicle returns later."""

StopKind = Literal[
    "depot", "customer", "start", "end", "launch_site", "pickup", "delivery", "break"]
STOP_KIND_TEXT = (
    "What the place is: `start` and `end` are those of a vehicle type, `pickup` and `delivery` "
    "those of a shipment. At a `launch_site` the truck stops for its drones alone. A "
    "`break` lies between two places.")
STOP_ID_TEXT = (
    "Id of the depot, the customer, the vehicle type, the shipment, the launch site or the break; "
    "of the customer or depot where a truck comes back to.")

ALTERNATIVE_TEXT = (
    "Id of the place among the customer's `alternatives`, where it isn't its own that is used.")

PART_TEXT = "Id of the pickup among the shipment's `pickups`, where it has several."

NOT_READ = "Not read: it is computed anew."

Instant = Annotated[float, Field(ge=-MAX_INSTANT, le=MAX_INSTANT), READ_ANY_INSTANT]
Number = Annotated[float | None, Field(description=NOT_READ)]
Loads = Annotated[
    Annotated[list[float], Field(fail_fast=True)] | None, Field(description=NOT_READ)]
VISIT_KIND_TEXT = "`pickup`, `delivery`: of a shipment. Left out where it is a customer."
Line = Annotated[str | None, Field(
    description="Encoded polyline, which pictures draw where it leads from place to place.")]
MAX_DETAILS = 1000
"""Most entries of an object that is not read."""

Details = Annotated[dict[str, Any] | None, Field(max_length=MAX_DETAILS, description=NOT_READ)]


class _Plan(BaseModel):
    """Strict on types, names and finiteness."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class VisitInput(_Plan):
    """A customer served by a drone. Times in seconds since plan start."""

    kind: EndKind | None = Field(None, description=VISIT_KIND_TEXT)
    id: str = Field(description="Id of the customer, or of the shipment.")
    alternative: str | None = Field(None, description=ALTERNATIVE_TEXT)
    part: str | None = Field(None, description=PART_TEXT)
    arrival: Instant = Field(description="Arrival of the drone.")
    service_start: Instant = Field(description="Start of service.")
    departure: Instant = Field(description="Departure of the drone.")
    setup: Number = None
    lateness: float | Details = Field(None, description=NOT_READ)
    load: Loads = None
    energy_left_wh: Number = None
    geometry: Line = None
    info: Details = None

    @model_validator(mode="after")
    def _name_place(self) -> Self:
        """Name a shipment's end, or another place, as the customer that it is."""
        if self.kind is not None:
            self.__dict__ |= {"kind": None, "id": end_name(self.id, self.kind, self.part)}
        elif self.alternative is not None:
            self.__dict__["id"] = place_of(self.id, self.alternative)
        return self

    @property
    def customer(self) -> str:
        """Id of the customer, whose place `id` names if it isn't his own."""
        return customer_of(self.id, self.alternative)

    @property
    def ready(self) -> float:
        """When it could serve."""
        return self.arrival + (self.setup or 0.0)


ON_THE_WAY = frozenset({"customer", "launch_site", "break"})
"""Kinds of stops at which only an open trip may end, ends of shipments being customers."""


class StopInput(_Plan):
    """A place where the truck halts. Times in seconds since plan start."""

    kind: StopKind = Field(description=STOP_KIND_TEXT)
    id: str = Field(description=STOP_ID_TEXT)
    alternative: str | None = Field(None, description=ALTERNATIVE_TEXT)
    part: str | None = Field(None, description=PART_TEXT)
    arrival: Instant = Field(
        description="Arrival; at the trip's first stop, when loading is done."
    )
    service_start: Instant = Field(description="Start of service; at depots the arrival.")
    departure: Instant = Field(description="Departure; at the trip's last stop, its end.")
    setup: Number = None
    waiting: Number = None
    lateness: float | Details = Field(None, description=NOT_READ)
    load: Loads = None
    energy_left_wh: Number = None
    geometry: Line = None
    info: Details = None

    @model_validator(mode="after")
    def _name_end(self) -> Self:
        """Name a shipment's end, or another place, as the customer that it is."""
        if self.kind in ENDS:
            self.__dict__ |= {"kind": "customer", "id": end_name(self.id, self.kind, self.part)}
        elif self.alternative is not None:
            self.__dict__["id"] = place_of(self.id, self.alternative)
        return self

    @property
    def customer(self) -> str:
        """Id of the customer, whose place `id` names if it isn't his own."""
        return customer_of(self.id, self.alternative)

    @property
    def ready(self) -> float:
        """When it could serve."""
        return self.arrival + (self.setup or 0.0)


class SortieInput(_Plan):
    """One drone flight. Times in seconds since plan start."""

    drone: str = Field(description="Name of the drone, `<vehicle>/drone-<number>`.")
    drone_type: str | None = Field(None, description="Not read: it follows from the number.")
    launch_stop: int = Field(description="Index in `stops` where it is launched.")
    recovery_stop: int = Field(description="Index in `stops` where it is recovered.")
    customers: tuple[VisitInput, ...] = Field(description="Customers served, in order.")
    launch_time: Instant = Field(description="Take-off; the launch lies before it.")
    recovery_time: Instant = Field(description="End of the recovery.")
    load: Loads = None
    distance: Number = None
    duration: Number = None
    energy_wh: Number = None
    energy_left_wh: Number = None
    recovery_geometry: Line = None


class ChargingInput(_Plan):
    """From when until when a vehicle that flies is charged."""

    start: Instant = Field(description="It is plugged in.")
    end: Instant = Field(description="It is unplugged.")


class TripInput(_Plan):
    """Depot to depot on one loading."""

    stops: tuple[StopInput, ...] = Field(
        description="Stops in order, where the trip begins first, where it ends last; an open "
        "route's last trip ends at its last customer."
    )
    sorties: tuple[SortieInput, ...] = Field((), description="Drone flights of this trip.")
    load: Loads = None
    load_rate: Number = None
    distance: Number = None
    duration: Number = None
    energy_wh: Number = None
    charging: tuple[ChargingInput, ...] = Field(
        (), description="When its vehicle is charged before it. What doesn't hold, or is left out, "
        "is found anew.")


class RouteInput(_Plan):
    """One vehicle's work."""

    vehicle: str = Field(description="Name of the vehicle, `<type>-<number>`.")
    type: str = Field(description="Id of the vehicle type.")
    trips: tuple[TripInput, ...] = Field(description="Trips in order.")
    working_duration: Number = None
    working_rate: Number = None
    overtime: Number = None
    cost: Number = None


class LeftOutInput(_Plan):
    """A customer whom no vehicle serves."""

    kind: Literal["customer", "shipment"] = Field(
        "customer", description="What it is; left out of replies for customers.")
    id: str = Field(description="Id of the customer or the shipment.")
    parts: list[str] = Field([], description="Ids of the shipment's `pickups`, if it has several.")
    reasons: list[dict[str, Any]] | None = Field(None, description=NOT_READ)

    def ends_but(self, served: frozenset[str]) -> "list[LeftOutInput]":
        """Return a shipment's ends as the customers that they are, but for pickups made already."""
        delivery = end_name(self.id, "delivery")
        pickups = [end_name(self.id, "pickup", part) for part in self.parts or (None,)]
        if delivery not in served:
            pickups = [name for name in pickups if name not in served]
        return [LeftOutInput(id=name) for name in (*pickups, delivery)]


class FoundInput(_Plan):
    """Where an address of the request was found."""

    path: str = Field(description="Where it is in the request.")
    location: Location = Field(description="`[longitude, latitude]`.")
    address: str | None = Field(None, description=NOT_READ)
    label: str | None = Field(None, description=NOT_READ)
    quality: str | None = Field(None, description=NOT_READ)
    by: str | None = Field(None, description=NOT_READ)
    doubt: str | None = Field(None, description=NOT_READ)


class PlanInput(_Plan):
    """A plan, as `POST /plan` replied it."""

    routes: Annotated[tuple[RouteInput, ...], Field(max_length=MAX_VEHICLES)] = Field(
        description="One entry per vehicle used.")
    unassigned: tuple[LeftOutInput, ...] = Field((), description="Customers left out.")
    status: str | None = Field(None, description=NOT_READ)
    cost: Details = None
    summary: Details = None
    solver: Details = None
    energy_models: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    hubs: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    lateness: Details = None
    airspace: Details = None
    rules: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    driving_rules: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    outlook: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    replan: Details = None
    plan_start: PlanStart | None = Field(
        None,
        description="When its seconds began. Beside a problem, that of the problem holds instead.",
    )
    time_zone: TimeZone = Field(None, description="As `plan_start`.", validate_default=True)
    currency: str | None = Field(None, description="Not read.")
    load_dimensions: list[dict[str, Any]] | None = Field(None, description="Not read.")
    legs: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    warnings: list[dict[str, Any]] | None = Field(None, description=NOT_READ)
    addresses: list[FoundInput] | None = Field(
        None, description="Where the request's addresses are, for pictures and drivers."
    )

    @model_validator(mode="after")
    def _name_ends(self) -> Self:
        """Name all ends of shipments left out as the customers that they are.

        Of one that a vehicle fetched which broke down what is yet to be served is left out.
        """
        if any(left_out.kind == "shipment" for left_out in self.unassigned):
            served = self._served()
            self.__dict__["unassigned"] = tuple(
                each for left_out in self.unassigned for each in (
                    [left_out] if left_out.kind == "customer"
                    else left_out.ends_but(served)))
        return self

    def _served(self) -> frozenset[str]:
        """Return the names of whom routes serve."""
        trips = [trip for route in self.routes for trip in route.trips]
        return frozenset([
            *(stop.id for trip in trips for stop in trip.stops if stop.kind == "customer"),
            *(visit.id for trip in trips for sortie in trip.sorties
              for visit in sortie.customers)])
