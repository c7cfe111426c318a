"""What VROOM accepts, version 1.15: the request of `POST /vroom`.

Integers must be JSON integers as VROOM demands. Unlike VROOM, unknown fields are refused.
"""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, JsonValue

from app.schemas.limits import MAX_CUSTOMERS, MAX_THREADS
from app.schemas.rows import HeldAsArray, Row

DEFAULT_PROFILE = "car"
DEFAULT_COST_PER_HOUR = 3600
MAX_PRIORITY = 100
MAX_EXPLORATION = 5
MAX_UINT = 2**32 - 1
MAX_AMOUNTS = 32
MAX_WINDOWS = 100
MAX_BREAKS = 32
DEPRECATED: dict[str, JsonValue] = {"deprecated": True}
MAX_PLACES = 3 * MAX_CUSTOMERS
"""Most rows of a matrix, and columns: for each task, and the start and end of each vehicle."""

LONGEST_TASK = 10**8
"""Most seconds of setup or of service."""

Id = Annotated[int, Field(ge=0, le=2**64 - 1)]
UInt = Annotated[int, Field(ge=0, le=MAX_UINT)]
Seconds = Annotated[int, Field(ge=0, le=LONGEST_TASK)]
Text = Annotated[str, Field(max_length=10_000)]
Coordinates = tuple[float, float]
Amounts = Annotated[list[UInt], Field(max_length=MAX_AMOUNTS)]
Skills = Annotated[list[UInt], Field(max_length=1000)]
Window = tuple[UInt, UInt]
Windows = Annotated[list[Window], Field(max_length=MAX_WINDOWS)]
_Row = Annotated[Row, HeldAsArray(
    Annotated[list[UInt], Field(fail_fast=True, max_length=MAX_PLACES)])]
Table = Annotated[list[_Row], Field(fail_fast=True, max_length=MAX_PLACES)]
DurationsPerType = Annotated[dict[Text, Seconds], Field(max_length=1000)]


class _Input(BaseModel):
    """Strict on types, names and finiteness."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class VroomPlaceInput(_Input):
    """What a job and the ends of a shipment have alike."""

    id: Id = Field(description="Number, unique among those of its kind.")
    description: Text = Field("", description="Repeated in the reply.")
    location: Coordinates | None = Field(None, description="`[longitude, latitude]` in degrees.")
    location_index: UInt | None = Field(None, description="Row and column in `matrices`.")
    setup: Seconds = Field(
        0, description="Seconds before service, unless the task before is at the same place.")
    service: Seconds = Field(0, description="Seconds of service.")
    setup_per_type: DurationsPerType = Field({}, description="`setup` by `type` of the vehicle.")
    service_per_type: DurationsPerType = Field(
        {}, description="`service` by `type` of the vehicle.")
    time_windows: Windows | None = Field(
        None, description="When setup and service may start: `[[from, to], ...]`, in seconds.")


class VroomJobInput(VroomPlaceInput):
    """A place to visit."""

    delivery: Amounts | None = Field(None, description="Amounts brought from the start.")
    pickup: Amounts | None = Field(None, description="Amounts taken to the end.")
    amount: Amounts | None = Field(
        None, json_schema_extra=DEPRECATED,
        description="`delivery`, where neither that nor `pickup` is stated.")
    skills: Skills = Field([], description="Skills that the vehicle must have, all.")
    priority: Annotated[int, Field(ge=0, le=MAX_PRIORITY)] = Field(
        0, description="The sum of the priorities of jobs served comes before all else.")


class VroomShipmentStepInput(VroomPlaceInput):
    """Where a shipment is picked up, or delivered."""


class VroomShipmentInput(_Input):
    """What a vehicle fetches at one place and brings to another."""

    pickup: VroomShipmentStepInput = Field(description="Where it is fetched.")
    delivery: VroomShipmentStepInput = Field(description="Where it is brought, behind that.")
    amount: Amounts | None = Field(None, description="Amounts aboard between.")
    skills: Skills = Field([], description="Skills that the vehicle must have, all.")
    priority: Annotated[int, Field(ge=0, le=MAX_PRIORITY)] = Field(
        0, description="As a job's, of each end.")


class VroomBreakInput(_Input):
    """A break, which each route of its vehicle has."""

    id: Id = Field(description="Number of the break, unique among its vehicle's.")
    description: Text = Field("", description="Repeated in the reply.")
    time_windows: Windows | None = Field(
        None, description="When it may start: `[[from, to], ...]`, in seconds.")
    service: Seconds = Field(0, description="Seconds that it takes.")
    max_load: Amounts | None = Field(None, description="What may be aboard at most.")


class VroomCostsInput(_Input):
    """What a vehicle costs."""

    fixed: UInt = Field(0, description="Cost of using the vehicle.")
    per_hour: UInt = Field(DEFAULT_COST_PER_HOUR, description="Cost of an hour of travel.")
    per_km: UInt = Field(0, description="Cost of a kilometre.")
    per_task_hour: UInt = Field(0, description="Cost of an hour of setup and service.")


class VroomStepInput(_Input):
    """A step of a route: to start from, or with `options.c` to be timed."""

    type: Text = Field(description="`start`, `job`, `pickup`, `delivery`, `break` or `end`.")
    id: Id | None = Field(None, description="Number of the job, the shipment's end or the break.")
    service_at: UInt | None = Field(
        None, description="With `options.c`: it starts then, in seconds.")
    service_after: UInt | None = Field(None, description="With `options.c`: not before that.")
    service_before: UInt | None = Field(None, description="With `options.c`: not after that.")


class VroomVehicleInput(_Input):
    """A vehicle."""

    id: Id = Field(description="Number of the vehicle, unique among vehicles.")
    profile: Text = Field(DEFAULT_PROFILE, description="Entry of `matrices`, or kind of speed.")
    description: Text = Field("", description="Repeated in the reply.")
    start: Coordinates | None = Field(
        None, description="Where the vehicle starts; if nowhere, at its first job.")
    start_index: UInt | None = Field(None, description="The same as a row of `matrices`.")
    end: Coordinates | None = Field(
        None, description="Where the vehicle ends; if nowhere, at its last job.")
    end_index: UInt | None = Field(None, description="The same as a column of `matrices`.")
    capacity: Amounts | None = Field(None, description="Largest load.")
    costs: VroomCostsInput = Field(VroomCostsInput(), description="What the vehicle costs.")
    skills: Skills = Field([], description="Skills of the vehicle.")
    type: Text = Field("", description="Name that `setup_per_type` and `service_per_type` use.")
    time_window: Window | None = Field(None, description="When the vehicle works, in seconds.")
    breaks: Annotated[list[VroomBreakInput], Field(max_length=MAX_BREAKS)] = Field(
        [], description="Breaks, taken by when they may start first.")
    speed_factor: float = Field(1.0, description="Travel is this many times as fast, up to 5.")
    max_tasks: UInt | None = Field(None, description="Most jobs.")
    max_travel_time: UInt | None = Field(None, description="Longest travel in seconds.")
    max_distance: UInt | None = Field(None, description="Longest way in metres.")
    steps: list[VroomStepInput] = Field(
        [], description="A route to start from, which must be feasible; with `options.c` the "
                        "route to be timed.")


class VroomMatricesInput(_Input):
    """Legs of one profile; rows are origins."""

    durations: Table | None = Field(None, description="Seconds.")
    distances: Table | None = Field(None, description="Metres.")
    costs: Table | None = Field(None, description="Costs in place of those by hour and kilometre.")


class VroomOptionsInput(_Input):
    """Options of vroom's command line, as vroom-express takes them."""

    g: bool = Field(False, description="Report distances and, as straight lines, geometries.")
    c: bool = Field(False, description="Time the routes in `steps`, and tell what they violate.")
    x: Annotated[int, Field(ge=0, le=MAX_EXPLORATION)] | None = Field(
        None, description="How long to search: 0.1, 0.25, 0.5, 1, 2 or 5 s for 0 to 5. Null: as "
                          "`TANDEM_VROOM_SECONDS` says.")
    l: Annotated[float, Field(gt=0)] | None = Field(  # noqa: E741  # VROOM's name
        None, description="How long to search in seconds.")
    t: Annotated[int, Field(ge=1, le=MAX_THREADS)] | None = Field(
        None, description="Threads of the search. Null: as `TANDEM_SEARCH_THREADS` says.")


class VroomRequest(_Input):
    """Jobs and vehicles as VROOM describes them."""

    jobs: list[VroomJobInput] = Field([], description="Places to visit.")
    shipments: list[VroomShipmentInput] = Field(
        [], description="What is fetched at one place and brought to another.")
    vehicles: list[VroomVehicleInput] = Field(description="Vehicles.")
    matrices: Annotated[dict[Text, VroomMatricesInput], Field(max_length=100)] | None = Field(
        None, description="Legs by profile; profiles without an entry are great circles.")
    matrix: Table | None = Field(
        None, json_schema_extra=DEPRECATED,
        description="`matrices.car.durations`, where `matrices` is absent.")
    options: VroomOptionsInput = Field(VroomOptionsInput(), description="How to search.")
