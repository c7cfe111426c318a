"""What clients send to start comparisons and sweeps, and what they get back of jobs.

Replies are written as plain data for speed, as those of `POST /plan` are; these classes document
them, and tests hold the two together.
"""

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.fields import Name
from app.schemas.request import MAX_VEHICLE_TYPES, PlanRequest
from app.schemas.response import CostReply, LoadRateReply, PlanReply
from app.schemas.vehicle import VehicleTypeInput

Kind = Literal["plan", "compare", "sweep"]
State = Literal["queued", "running", "done", "failed", "cancelled"]

MAX_AXES = 10
MAX_VALUES = 1_000


class _Input(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class CompareRequest(_Input):
    """The same customers with several fleets."""

    base: PlanRequest = Field(
        description="A request of `POST /plan`; its fleet is replaced by each in `fleets`."
    )
    fleets: dict[
        Name, Annotated[list[VehicleTypeInput], Field(max_length=MAX_VEHICLE_TYPES)]
    ] = Field(min_length=1, description="Fleets by name.")


class SweepRequest(_Input):
    """The same request with each combination of some fields' values."""

    base: PlanRequest = Field(description="A request of `POST /plan`.")
    grid: dict[
        Annotated[str, Field(max_length=200)],
        Annotated[list[Any], Field(min_length=1, max_length=MAX_VALUES)],
    ] = Field(
        min_length=1,
        max_length=MAX_AXES,
        description="Values by the path of a field of `base`, such as `fleet[0].count`, "
        "`fleet[*].capacity[0]` or `customers[*].time_window.latest`; `[*]` stands for every "
        "entry.",
    )


class WorkingRateReply(_Reply):
    """Working rates over the vehicles used, 0 to 1."""

    min: float = Field(description="Smallest.")
    mean: float = Field(description="Mean.")
    max: float = Field(description="Largest.")


class _ScenarioReply(_Reply):
    job: str = Field(description="Id of the scenario's own job, which has its plan.")
    status: Literal["complete", "partial", "failed", "cancelled"] = Field(
        description="`partial` if customers stay unassigned, `failed` or `cancelled` if there is "
        "no plan; a scenario cancelled later has the best plan until then."
    )
    load_rate: LoadRateReply | None = Field(description="Load rates of the trips. Null: no plan.")
    vehicles: int | None = Field(description="Vehicles used. Null: no plan.")
    trips: int | None = Field(description="Trips of all vehicles. Null: no plan.")
    unassigned: int | None = Field(description="Customers left out. Null: no plan.")
    error: str | None = Field(description="Why it failed. Null: it didn't.")


class FleetReply(_ScenarioReply):
    """What a fleet achieves."""

    cost: CostReply | None = Field(description="Cost by term. Null: no plan.")
    working_rate: WorkingRateReply | None = Field(
        description="Working duration / longest allowed, of vehicles whose type has a "
        "longest. Null: none has, or no plan."
    )
    plan: PlanReply | None = Field(description="The plan. Null: there is none.")


class CompareReply(_Reply):
    """Fleets side by side."""

    fleets: dict[str, FleetReply] = Field(description="What each fleet achieves, by its name.")


class AxisReply(_Reply):
    """A field that was varied."""

    path: str = Field(description="Its path, as in the request.")
    values: list[Any] = Field(description="Its values, as in the request.")


class CellReply(_ScenarioReply):
    """A combination of values and what came of it."""

    values: list[Any] = Field(description="One value for each axis, in their order.")
    cost: float | None = Field(description="Total cost. Null: no plan.")


class SweepReply(_Reply):
    """A grid of scenarios."""

    axes: list[AxisReply] = Field(description="The fields varied.")
    cells: list[CellReply] = Field(
        description="All combinations of their values, the last axis running fastest."
    )


class JobSummaryReply(_Reply):
    """A job without its result. Times are UTC."""

    id: str = Field(description="Id of the job.")
    kind: Kind = Field(description="What it computes.")
    state: State = Field(description="Where it stands; the last three are final.")
    created_at: datetime = Field(description="When it was accepted.")
    started_at: datetime | None = Field(description="When it was begun. Null: not yet.")
    finished_at: datetime | None = Field(description="When it ended. Null: not yet.")
    expires_at: datetime | None = Field(
        description="When it is deleted, with its result. Null: not before it has ended."
    )
    progress: float = Field(description="Share of its time or iterations that is over, 0 to 1.")
    cost: float | None = Field(
        description="Cost of the best plan so far, of all scenarios. Null: there is none yet."
    )
    search_iterations: int = Field(description="Iterations of the search so far.")
    error: str | None = Field(description="Why it failed. Null: it didn't.")
    waiting_for: str | None = Field(
        description="Why it can't begin yet, though its turn has come: roads that don't answer. It "
        "is tried again by itself. Null: nothing hinders it."
    )


class JobReply(JobSummaryReply):
    """A job and what it has found so far. Times are UTC."""

    result: PlanReply | CompareReply | SweepReply | None = Field(
        description="By `kind`, as `POST /plan` replies or as `CompareReply` or `SweepReply`: "
        "while a plan is being made the best so far. Null: there is none yet, or the job failed."
    )


class JobListReply(_Reply):
    """A page of jobs, the youngest first."""

    jobs: list[JobSummaryReply] = Field(description="Jobs without their results.")
    next: str | None = Field(description="`cursor` of the next page. Null: this is the last.")


class ProgressEvent(_Reply):
    """Data of the event `progress`."""

    cost: float | None = Field(description="Cost of the best plan so far. Null: there is none.")
    search_iterations: int = Field(description="Iterations of the search so far.")
    progress: float = Field(description="Share of its time or iterations that is over, 0 to 1.")
    state: State = Field(description="Where the job stands.")
    waiting_for: str | None = Field(description="Why it can't begin yet. Null: nothing hinders it.")
    improved: bool = Field(description="Whether the cost fell since the event before.")


Data = dict[str, Any]
