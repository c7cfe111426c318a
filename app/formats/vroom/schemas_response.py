"""What VROOM answers: the reply of `POST /vroom`. Times in seconds, distances in metres.

Replies are written by `app.formats.vroom.reply` as plain data; these classes document them.
"""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.formats.vroom.schemas import Coordinates

VIOLATIONS = "What given routes violate, with `options.c`; else empty: no rule is broken."


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class VroomViolationReply(_Reply):
    """A rule that a given route breaks."""

    cause: Literal["lead_time", "delay", "load", "max_tasks", "skills", "precedence",
                   "missing_break", "max_travel_time", "max_distance", "max_load"] = Field(
        description="Which.")
    duration: int | None = Field(None, description="Seconds of `lead_time` or `delay`.")


class VroomStepReply(_Reply):
    """A place on a route."""

    type: Literal["start", "job", "pickup", "delivery", "break", "end"] = Field(
        description="What happens there.")
    description: str | None = Field(None, description="Of the job, if stated.")
    location: Coordinates | None = Field(None, description="`[longitude, latitude]`, if stated.")
    location_index: int | None = Field(None, description="Row in `matrices`, if stated.")
    id: int | None = Field(
        None, description="Number of the job, the shipment's end or the break.")
    setup: int = Field(description="Time for setup.")
    service: int = Field(description="Time for service.")
    waiting_time: int = Field(description="Wait for a time window.")
    job: int | None = Field(None, description="`id` by its old name.")
    load: list[int] | None = Field(None, description="Load when the step is done.")
    arrival: int = Field(description="Arrival, in the terms of the request's time windows.")
    duration: int = Field(description="Travel time so far.")
    violations: list[VroomViolationReply] = Field(description=VIOLATIONS)
    distance: int | None = Field(None, description="Way so far.")


class VroomRouteReply(_Reply):
    """What one vehicle does."""

    vehicle: int = Field(description="Number of the vehicle.")
    cost: int = Field(description="Cost, in the unit of the request's costs.")
    description: str | None = Field(None, description="Of the vehicle, if stated.")
    delivery: list[int] | None = Field(None, description="Amounts brought.")
    amount: list[int] | None = Field(None, description="`delivery` by its old name.")
    pickup: list[int] | None = Field(None, description="Amounts taken.")
    setup: int = Field(description="Time for setup.")
    service: int = Field(description="Time for service.")
    duration: int = Field(description="Travel time.")
    waiting_time: int = Field(description="Wait for time windows.")
    priority: int = Field(description="Sum of the jobs' priorities.")
    distance: int | None = Field(None, description="Way, where distances count or are asked for.")
    steps: list[VroomStepReply] = Field(description="Places in order.")
    violations: list[VroomViolationReply] = Field(description=VIOLATIONS)
    geometry: str | None = Field(
        None, description="The drives on roads, or straight lines between the steps where the "
        "service has none, as an encoded polyline, with `options.g`.")


class VroomComputingTimesReply(_Reply):
    """How long it took, in milliseconds."""

    loading: int = Field(description="Reading the request.")
    solving: int = Field(description="Planning.")
    routing: int = Field(description="Always 0.")


class VroomSummaryReply(_Reply):
    """All routes together."""

    cost: int = Field(description="Cost of all routes.")
    routes: int = Field(description="Routes.")
    unassigned: int = Field(description="Jobs left out.")
    delivery: list[int] | None = Field(None, description="Amounts brought.")
    amount: list[int] | None = Field(None, description="`delivery` by its old name.")
    pickup: list[int] | None = Field(None, description="Amounts taken.")
    setup: int = Field(description="Time for setup.")
    service: int = Field(description="Time for service.")
    duration: int = Field(description="Travel time.")
    waiting_time: int = Field(description="Wait for time windows.")
    priority: int = Field(description="Sum of the priorities of jobs served.")
    distance: int | None = Field(None, description="Way, where distances count or are asked for.")
    violations: list[VroomViolationReply] = Field(description=VIOLATIONS)
    computing_times: VroomComputingTimesReply = Field(description="How long it took.")


class VroomUnassignedReply(_Reply):
    """A job left out."""

    id: int = Field(description="Number of the job.")
    location: Coordinates | None = Field(None, description="`[longitude, latitude]`, if stated.")
    location_index: int | None = Field(None, description="Row in `matrices`, if stated.")
    type: Literal["job", "pickup", "delivery"] = Field(description="What was left out.")
    description: str | None = Field(None, description="Of the job, if stated.")
    reasons: list[str] | None = Field(
        None, description="Why, in words, as VROOM does not tell. Null for given routes, and for "
        "the last of very many.")


class VroomReply(_Reply):
    """A solution as VROOM tells it."""

    code: Literal[0] = Field(description="0: no error.")
    summary: VroomSummaryReply = Field(description="All routes together.")
    unassigned: list[VroomUnassignedReply] = Field(description="Jobs left out.")
    routes: list[VroomRouteReply] = Field(description="What each vehicle does that is used.")
