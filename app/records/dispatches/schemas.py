"""What is sent to and got from the endpoints of dispatches and drivers."""

from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import AwareDatetime, BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from app.maps.addresses.shapes import Latitude, Longitude
from app.schemas.check import PlannedProblem
from app.schemas.fields import Avoided, Info

StepKind = Literal["depart", "stop", "launch", "recover", "return"]
BREAKDOWN: Literal["vehicle"] = "vehicle"
"""In place of a step's id: what is told is of the vehicle. It has failed, or goes on again."""

SEEN: Literal["changes"] = "changes"
"""In place of a step's id: the driver has seen what is new and what was taken away."""

POSITION: Literal["position"] = "position"
"""In place of a step's id: where the vehicle is."""

Outcome = Literal["done", "failed"]
EventKind = Literal["done", "failed", "undone"]
LinkState = Literal["open", "revoked", "over"]

MAX_EVENTS_AT_ONCE = 500
MAX_REASON_LENGTH = 500

PLAN_START = (
    "The instant from which the plan counts its seconds, ISO 8601 with zone, such as "
    "`2026-11-23T00:00:00+01:00`. Null: that of the problem; if there is none, the last midnight "
    "in UTC."
)
TIME_ZONE = (
    "Zone in which drivers read times, by its name in the IANA's list, such as `Europe/Berlin`. "
    "Null: the problem's; if there is none, the offset of `plan_start`."
)

PlanStart = Annotated[AwareDatetime | None, Field(description=PLAN_START)]
TimeZone = Annotated[str | None, Field(max_length=100, description=TIME_ZONE)]


class DriverInput(BaseModel):
    """What is sent of a plan on the road."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class DispatchOptions(DriverInput):
    """When a plan's day is."""

    plan_start: PlanStart = None
    time_zone: TimeZone = None


class DispatchRequest(PlannedProblem):
    """A problem and the plan for it that is to be driven."""

    plan_start: PlanStart = None
    time_zone: TimeZone = None


class DestinationReply(_Reply):
    """Where to go, as navigators take it."""

    latitude: float = Field(description="Degrees north.")
    longitude: float = Field(description="Degrees east.")


class WindowReply(_Reply):
    """When a customer is to be served, in seconds since plan start."""

    earliest: float = Field(description="When it opens.")
    latest: float | None = Field(description="When it closes; null: never.")


class GoodsReply(_Reply):
    """What a customer gets and gives."""

    id: str = Field(description="Id of the customer.")
    hand_over: list[float] = Field(description="What is delivered, by dimension.")
    take_in: list[float] | None = Field(description="What is picked up.")
    info: Info = Field(description="What the request tells of the customer.")


class StepReply(_Reply):
    """One thing that a driver does."""

    id: str = Field(description="Name of the step within this vehicle's day.")
    kind: StepKind = Field(
        description="`depart` from the depot, serve a `stop`, `launch` or `recover` a drone, or "
        "`return`."
    )
    trip: int = Field(description="Trip, from 1.")
    stop: int = Field(description="Position of its stop in the trip, from 0.")
    place: str = Field(description="Id of the place.")
    place_kind: Literal["depot", "customer", "start", "end", "launch_site"] = Field(
        description="What is there; `start` and `end` are a vehicle's own.")
    location: DestinationReply | None = Field(
        description="Null: not known as latitude and longitude.")
    avoid: list[Avoided] = Field([], description="What the vehicle keeps off on its way there.")
    arrival: float = Field(description="Planned arrival at the place, seconds since plan start.")
    time: float = Field(
        description="When the step is planned: start of service, take-off, end of the recovery, "
        "departure or arrival."
    )
    departure: float = Field(description="Planned departure from the place.")
    duration: float = Field(description="How long the step takes in seconds.")
    windows: list[WindowReply] = Field(description="When service may start; empty: at any time.")
    drone: str | None = Field(description="The drone that is launched or recovered.")
    customers: list[GoodsReply] = Field(
        description="Who is served here, or by the drone launched; none at depots."
    )
    load: list[float] | None = Field(description="What is loaded before the trip departs.")
    load_units: list[str] = Field(
        [], description="What amounts are in, by dimension: its unit, else its name.")


class StepStanding(_Reply):
    """What was told last of a step."""

    id: str = Field(description="Name of the step within its vehicle's day.")
    kind: StepKind | Literal["vehicle"] = Field(
        description="What the driver does; `vehicle`: it has broken down.")
    place: str = Field(description="Id of its place, or of the customers of its drone; empty for "
                       "the vehicle.")
    state: Outcome = Field(description="What became of it.")
    time: float = Field(description="When, in seconds since plan start.")
    late: float = Field(0.0, description="How many seconds behind the plan that was; 0: none.")
    reason: str | None = Field(None, description="Why it failed, in the driver's words.")


class ProofReply(_Reply):
    """A proof of delivery, without its pictures."""

    id: str = Field(description="Its name.")
    vehicle: str = Field(description="Id of the vehicle.")
    step: str = Field(description="Id of the step.")
    orders: list[str] = Field(description="Whom it is of.")
    name: str = Field(description="Of who took it.")
    time: float = Field(description="When, in seconds since plan start.")
    photo: bool = Field(description="Whether there is a photo.")
    signature: bool = Field(description="Whether there is a signature.")


class ProofsReply(_Reply):
    """Proofs of delivery, the youngest first."""

    proofs: list[ProofReply] = Field(description="The youngest first.")


class DriverDay(_Reply):
    """One vehicle's day: no other's is in it."""

    link: str = Field(description="Id of the link.")
    vehicle: str = Field(description="Id of the vehicle.")
    name: str = Field(description="What people call it.")
    plan_start: datetime = Field(description="The instant from which seconds count.")
    time_zone: str | None = Field(description="Zone in which to read times.")
    ends_at: datetime = Field(description="When the link ends.")
    steps: list[StepReply] = Field(description="What the driver does, in order.")
    flights: int = Field(
        description="Flights of its drones that `GET /drive/flights` writes for their controllers.")
    flies: bool = Field(description="Whether the vehicle is a drone whose own trips these are.")
    asks_position: bool = Field(description="Whether a `position` is of use to who plans.")
    standing: list[StepStanding] = Field(description="What was told of steps so far.")


class EventInput(DriverInput):
    """Something a driver tells."""

    id: Annotated[str, Field(min_length=1, max_length=36, pattern="^[A-Za-z0-9-]+$")] = Field(
        description="A name that is this event's own, such as a UUID: sent again it counts once."
    )
    step: Annotated[str, Field(min_length=1, max_length=40)] = Field(
        description="Id of the step; `vehicle`, with `failed`: it has broken down; `changes`, with "
        "`done`: what is new was seen; `position`, with `done`: where the vehicle is.")
    kind: EventKind = Field(description="`undone` takes back what was told before.")
    time: AwareDatetime = Field(description="When it happened, by the sender's clock.")
    reason: Annotated[str, Field(max_length=MAX_REASON_LENGTH)] | None = Field(
        None, description="Why it failed."
    )
    location: tuple[Longitude, Latitude] | None = Field(
        None, description="Of a `position`. It is kept for days alone, on a map of the earth.")

    @model_validator(mode="after")
    def _is_somewhere(self) -> Self:
        """Refuse a position without a place, and a place of anything else."""
        if (self.step == POSITION) != (self.location is not None):
            raise PydanticCustomError(
                "WRONG_TYPE", "`location` and a step of `position` belong together.")
        return self


class EventsRequest(DriverInput):
    """What a driver tells, in the order in which it happened."""

    now: AwareDatetime = Field(
        description="The sender's clock now: a clock that is wrong is set right by it."
    )
    events: Annotated[list[EventInput], Field(max_length=MAX_EVENTS_AT_ONCE)] = Field(
        description="The oldest first.")


class EventsReply(_Reply):
    """What became of events."""

    accepted: list[str] = Field(description="Ids of the events that are kept, earlier ones too.")
    standing: list[StepStanding] = Field(description="What was told of steps so far.")


class DriverLinkReply(_Reply):
    """A vehicle's link and how far its driver is."""

    id: str = Field(description="Id of the link.")
    vehicle: str = Field(description="Id of the vehicle.")
    name: str = Field(description="What people call it.")
    state: LinkState = Field(description="Whether it opens the day, and if not, why.")
    url: str | None = Field(
        None, description="The link itself, told once: when it is made. Send it to the driver."
    )
    qr: str | None = Field(None, description="The link as a QR code: an image as `data:` URL.")
    opened_at: datetime | None = Field(description="When it was opened first.")
    told_at: datetime | None = Field(description="When the driver told something last.")
    seen_at: datetime | None = Field(
        None, description="When the driver last said that what is new was seen.")
    steps: int = Field(description="Steps of the day.")
    done: int = Field(description="Steps that were told to be done.")
    failed: int = Field(description="Steps that were told to have failed.")
    next: str | None = Field(description="Id of the first step of which nothing was told.")
    standing: list[StepStanding] = Field(description="Steps of which something was told.")


class DispatchSummary(_Reply):
    """A plan on the road."""

    id: str = Field(description="Id of the dispatch.")
    created_at: datetime = Field(description="When it was made.")
    plan_start: datetime = Field(description="The instant from which seconds count.")
    time_zone: str | None = Field(description="Zone in which drivers read times.")
    ends_at: datetime = Field(description="When its links end.")
    expires_at: datetime = Field(description="When all that is kept of it is deleted.")
    day: str | None = Field(None, description="Its name among `/days`, if it is one of them.")


class DispatchReply(DispatchSummary):
    """A plan on the road, and how far it is."""

    links: list[DriverLinkReply] = Field(description="One for each vehicle.")


class DispatchListReply(_Reply):
    """Plans on the road, the youngest first."""

    dispatches: list[DispatchSummary] = Field(description="The youngest first.")


class FailedReply(_Reply):
    """A customer who wasn't served."""

    customer: str = Field(description="Id of the customer.")
    vehicle: str = Field(description="Id of the vehicle.")
    step: StepKind = Field(description="What failed.")
    time: float = Field(description="Seconds since plan start.")
    reason: str | None = Field(description="Why, in the driver's words.")
    is_open: bool = Field(
        description="Whether the plan to go on from lacks the customer, so that it is planned "
        "again. If not, its stop had to stay in the plan."
    )
    parcel_back: float = Field(
        description="When the vehicle, and so the parcel, is expected at the depot: a "
        "`release_time` for the customer."
    )


class DoubtfulReply(_Reply):
    """An order that the plan has as served by now, and of which nobody told."""

    customer: str = Field(description="Id of the customer.")
    vehicle: str = Field(description="Id of the vehicle.")
    time: float = Field(description="When the plan has it as served, in seconds since plan start.")
    is_served: bool = Field(
        description="Whether the plan to go on from holds it to be served. Say what was with "
        "`served` or `unserved`.")


class GoingOnReply(_Reply):
    """How to plan on from what drivers told."""

    replan: dict[str, Any] = Field(
        description="`replan` of a request of `POST /plan`: the plan with the times that drivers "
        "told, and now."
    )
    broken: list[str] = Field(description="Vehicles that have broken down: `unavailable`.")
    grounded: list[str] = Field(
        description="Drones that didn't come back or are broken: `unavailable`, too.")
    told: list[str] = Field(description="Vehicles whose drivers told something; others are held "
                            "to be where the plan has them.")
    failed: list[FailedReply] = Field(description="Customers who weren't served.")
    doubtful: list[DoubtfulReply] = Field(
        description="Orders that the plan has as served by now, and of which nobody told.")
