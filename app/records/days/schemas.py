"""What is sent to and got from the endpoints of days."""

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.fields import Duration, Input, Instant
from app.schemas.quote import MAX_SLOTS
from app.schemas.request import PlanRequest
from app.schemas.response import PlanReply

PLAN_WITHIN, SHORTEST, LONGEST = 2.0, 0.5, 600.0
ETA_THRESHOLD, RISK_THRESHOLD = 600.0, 0.3

OrderState = Literal["waiting", "planned", "served", "failed", "doubtful", "left_out"]

DayName = Annotated[str, Field(min_length=1, max_length=64, pattern="^[A-Za-z0-9._~-]+$")]


class DayRequest(Input):
    """A day that begins."""

    problem: PlanRequest = Field(
        description="Fleet, depots, and the orders that are known, as `POST /plan` takes them; of "
        "`replan` its plan, with which the day begins. `plan_start` says which day it is; null: "
        "today, in UTC or `time_zone`.")
    id: DayName | None = Field(
        None, description="A name of your own: the same request sent again finds its day. Null: "
        "the service makes one.")
    plan_within: Annotated[float, Field(ge=SHORTEST, le=LONGEST)] = Field(
        PLAN_WITHIN, description="Seconds from an event to the plan that counts with it.")
    clock: Instant | None = Field(
        None, description="What time it is when the day begins, for days that go by the times they "
        "are told: simulated ones, or yesterday's. Null: the service's clock.")
    eta_threshold: Duration = Field(
        ETA_THRESHOLD, description="By how many seconds an arrival has to move before "
        "`eta.changed` tells it again.")
    webhook: Annotated[str, Field(min_length=1)] | None = Field(
        None, description="URL that is told `plan.changed`, `eta.changed` and `order.at_risk` as "
        "they happen, signed and repeated as webhooks of jobs are.")
    risk_threshold: Annotated[float, Field(gt=0, le=1)] = Field(
        RISK_THRESHOLD, description="The chance of being late from which on `order.at_risk` tells "
        "an order. It is over below two thirds of that.")


class AcceptRequest(Input):
    """Which slot of a quote is accepted."""

    slot: Annotated[int, Field(ge=0, lt=MAX_SLOTS)] = Field(description="Its place, from 0.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class PinReply(_Reply):
    """What a dispatcher settled of an order by hand."""

    vehicle: str | None = Field(description="Who serves it. Null: nobody does.")
    after: str | None = Field(None, description="Whom the vehicle serves before.")


class OrderRemedyReply(_Reply):
    """What mends an order that may be late, at the least cost when that was told."""

    code: Literal["serve_sooner"] = Field(description="What it is.")
    vehicle: str = Field(description="Who serves it.")
    arrival: float = Field(description="When.")
    cost: float = Field(description="What the plan costs more.")
    events: list[dict[str, Any]] = Field(
        description="That make it so; add `event_id` and `at`.")


class OrderReply(_Reply):
    """How an order stands."""

    id: str = Field(description="As the plan's stop is named.")
    state: OrderState = Field(
        description="`waiting` for the next plan, `planned`, `served`, `failed`, `doubtful`: the "
        "plan has it as served, and nobody told, or `left_out` of the plan.")
    vehicle: str | None = Field(None, description="Who serves or served it.")
    arrival: float | None = Field(
        None, description="When, by the plan and what was told, in seconds since plan start.")
    earliest: float | None = Field(
        None, description="On a tenth of all days it is served by then, with spreads that are "
        "stated or were seen on this day.")
    latest: float | None = Field(None, description="On nine tenths of them.")
    chance: float | None = Field(None, description="That of being late for its window.")
    told: float | None = Field(None, description="The arrival that `eta.changed` told last.")
    at_risk: bool = Field(False, description="Whether `order.at_risk` holds.")
    pinned: PinReply | None = Field(
        None, description="What `order.pinned` settled and nobody lifted.")
    remedy: OrderRemedyReply | None = Field(None, description="What it was told with.")


class VehicleReply(_Reply):
    """How far a vehicle is."""

    vehicle: str = Field(description="Its id.")
    told_at: float | None = Field(None, description="When something was told of it last.")
    done: int = Field(0, description="Steps that were told to be done.")
    failed: int = Field(0, description="Steps that were told to have failed.")
    position: tuple[float, float] | None = Field(None, description="Where it was told to be.")
    position_at: float | None = Field(None, description="When it was there.")
    broken: bool = Field(False, description="Whether it has broken down.")


class DayReply(_Reply):
    """A day as it stands."""

    id: str = Field(description="Its name.")
    dispatch: str = Field(description="Id by which `/dispatches` has its drivers' links.")
    plan_start: datetime = Field(description="The instant from which seconds count.")
    time_zone: str | None = Field(description="Zone of its wall clock.")
    ends_at: datetime = Field(description="When it is over.")
    now: float = Field(description="What time it is, in seconds since plan start.")
    is_rehearsed: bool = Field(description="Whether it goes by the times that it is told.")
    revision: int = Field(description="Number of its last event.")
    planned: int = Field(description="Number of the last event that the plan counts with.")
    is_planned: bool = Field(description="Whether the plan counts with all that was told.")
    plan_number: int = Field(description="How many plans were made.")
    failure: str | None = Field(None, description="Why the last plan could not be made.")
    orders: list[OrderReply] = Field(description="All that were not cancelled.")
    vehicles: list[VehicleReply] = Field(description="Those of the plan, or told of.")
    out: list[str] = Field(
        [], description="Vehicles and drones that do nothing more.")


class CustomerLink(_Reply):
    """A page of its own for whom an order is."""

    order: str = Field(description="As the plan's stop is named.")
    url: str = Field(description="Opens a page that tells when who comes, and nothing else.")


class CustomerLinksReply(_Reply):
    """Links for customers, which hold until the day is over or the order is cancelled."""

    links: list[CustomerLink] = Field(description="One for each order.")


VisitState = Literal["open", "coming", "served", "failed"]


class ToldArrival(_Reply):
    """When somebody was told when to expect whom."""

    at: datetime = Field(description="When it was told.")
    arrival: datetime = Field(description="The arrival that was told.")


class VisitStatusReply(_Reply):
    """What a customer may know of its order."""

    order: str = Field(description="Its name.")
    state: VisitState = Field(
        description="`open`: not planned, `coming`, `served`, or `failed`.")
    by: Literal["truck", "drone"] | None = Field(None, description="What brings it.")
    vehicle: str | None = Field(
        None, description="Name of the vehicle, also of that from which the drone flies.")
    arrival: datetime | None = Field(None, description="When it is expected, or came.")
    earliest: datetime | None = Field(None, description="On a tenth of all days it came by then.")
    latest: datetime | None = Field(None, description="On nine tenths of them.")
    told: list[ToldArrival] = Field(description="What `eta.changed` told, in order.")
    plan_start: datetime = Field(description="The day's begin.")
    time_zone: str | None = Field(description="Zone of its wall clock.")
    ends_at: datetime = Field(description="Until when the link holds.")


class DayPlanReply(_Reply):
    """A day's plan."""

    number: int = Field(description="From 1.")
    planned: int = Field(description="Number of the last event that it counts with.")
    plan: PlanReply = Field(description="As `POST /plan` replies.")


class TakenReply(_Reply):
    """An event that is kept."""

    event_id: str = Field(description="Its name.")
    number: int = Field(description="Its place among the day's events.")


class DayEventsReply(_Reply):
    """What became of events."""

    accepted: list[TakenReply] = Field(description="All that were sent; earlier ones too.")
    revision: int = Field(description="Number of the day's last event.")


class LoggedReply(_Reply):
    """An event of a day, as `GET /days/{id}/events` streams it."""

    number: int = Field(description="Its place among the day's events.")
    event_id: str | None = Field(None, description="Its name, if a client told it.")
    kind: str = Field(description="What happened; also `plan.changed`, `eta.changed` and "
                      "`order.at_risk`.")
    at: float = Field(description="When, in seconds since plan start.")
    vehicle: str | None = Field(None, description="Of which vehicle.")
    reason: str | None = Field(None, description="Why something failed.")
    about: dict[str, Any] = Field({}, description="What else was told.")
