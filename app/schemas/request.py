"""What a client may send: the request of `POST /plan`, units in every field.

Numbers must be JSON numbers, unknown fields are refused. What one field alone can't tell, such as
an unknown depot, is checked in `app.requests.validation`.
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.plan import PlanInput
from app.settings import DEFAULT_POLICY, MAX_CUSTOMERS, MAX_NUM_SAMPLES, MAX_THREADS, MAX_TIME_LIMIT
from model.problem import MAX_MONEY, MAX_QUANTITY

MAX_AMOUNT = MAX_QUANTITY // 1000
"""Largest amount, duration in seconds or distance in metres: all are held as thousandths."""

MAX_DEPOTS = 100
MAX_VEHICLE_TYPES = 100
MAX_POLYGON_POINTS = 500

DEFAULT_TRUCK_SPEED_KMH = 40.0
DEFAULT_DRONE_SPEED_KMH = 60.0

Name = Annotated[str, Field(min_length=1, max_length=200)]
Amount = Annotated[float, Field(ge=0, le=MAX_AMOUNT)]
Seconds = Annotated[float, Field(ge=0, le=MAX_AMOUNT)]
Metres = Annotated[float, Field(ge=0, le=MAX_AMOUNT)]
Money = Annotated[float, Field(ge=0, le=MAX_MONEY)]
# Speed and factor together keep every share of the fastest speed above a millionth.
Speed = Annotated[float, Field(ge=1, le=1000)]
Demand = Annotated[list[Amount], Field(min_length=1, max_length=3)]
Location = tuple[float, float]
LocationIndex = Annotated[int, Field(ge=0, le=MAX_CUSTOMERS + MAX_DEPOTS)]
Skills = Annotated[list[Name], Field(max_length=100)]
MAX_PLACES = MAX_CUSTOMERS + MAX_DEPOTS + 1
"""Most rows of a matrix, and columns: what `location_index` can name."""

Table = Annotated[
    list[Annotated[list[Annotated[float, Field(le=MAX_AMOUNT)]],
                   Field(fail_fast=True, max_length=MAX_PLACES)]],
    Field(fail_fast=True, max_length=MAX_PLACES),
]
Polygon = Annotated[list[Location], Field(min_length=3, max_length=MAX_POLYGON_POINTS)]

LOCATION_TEXT = (
    "`[x, y]` in units of `planar_unit` metres, or `[longitude, latitude]` in degrees when "
    "`coordinate_system` is `geographic`. May be left out where `matrices` cover every vehicle."
)
LOCATION_INDEX_TEXT = "Row and column of this place in `matrices`, from 0. Needed with `matrices`."


class _Input(BaseModel):
    """Strict on types, names and finiteness."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


class DepotInput(_Input):
    """A place where trips start and end."""

    id: Name = Field(description="Name of the depot, unique among depots.")
    location: Location | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)


class TimeWindowInput(_Input):
    """When service at a customer may start; both ends belong to the window."""

    earliest: Seconds = Field(
        0.0, description="Earliest start of service in seconds since plan start; earlier waits."
    )
    latest: Seconds | None = Field(
        None, description="Latest arrival in seconds since plan start. Null: no limit."
    )
    late_cost_per_hour: Money | None = Field(
        None,
        description="Cost per hour of arriving after `latest`. Null: arriving later isn't allowed.",
    )
    early_cost_per_hour: Money = Field(
        0.0, description="Cost per hour of waiting for `earliest` at the customer."
    )


class CustomerInput(_Input):
    """A place with a demand, served once by a truck or a drone."""

    id: Name = Field(description="Name of the customer, unique among customers.")
    location: Location | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    demand: Demand = Field(
        description="Amount to deliver in 1 to 3 dimensions (such as kg and litres), in your "
        "units; as many as every `capacity`. Counted exactly, with up to nine decimals."
    )
    service_duration: Seconds = Field(0.0, description="Time spent at the customer in seconds.")
    time_window: TimeWindowInput = Field(
        TimeWindowInput(), description="When service may start. Default: at any time."
    )
    served_by: Literal["truck", "drone", "either"] = Field(
        "either", description="Kind of vehicle that may serve the customer."
    )
    skills: Skills = Field([], description="Skills that the serving vehicle type must have, all.")
    release_time: Seconds = Field(
        0.0,
        description="When the parcel is at the depot, in seconds since plan start: a trip that "
        "carries it begins no earlier.",
    )


class CostsInput(_Input):
    """What a vehicle costs, in one currency."""

    fixed: Money = Field(0.0, description="Cost per vehicle that is used at all.")
    per_km: Money = Field(1.0, description="Cost per kilometre driven by the truck.")
    per_hour: Money = Field(
        0.0, description="Cost per hour from first departure to last return, waiting included."
    )


class DroneCostsInput(_Input):
    """What a drone costs, in one currency."""

    per_km: Money = Field(0.25, description="Cost per kilometre flown.")
    per_hour: Money = Field(0.0, description="Cost per hour from take-off to the end of recovery.")


class SpeedChangeInput(_Input):
    """Speed from an instant on, until the next entry. State `speed_kmh` or `factor`, not both."""

    from_time: Seconds = Field(
        alias="from", description="When this speed begins, in seconds since plan start."
    )
    speed_kmh: Speed | None = Field(None, description="Speed in km/h from then on.")
    factor: Annotated[float, Field(ge=0.05, le=20)] | None = Field(
        None, description="Speed from then on as a multiple of the vehicle type's usual speed."
    )


class ShiftInput(_Input):
    """When vehicles of a type work."""

    earliest: Seconds = Field(
        0.0, description="Earliest begin of the first trip in seconds since plan start."
    )
    latest: Seconds | None = Field(
        None, description="Latest return in seconds since plan start. Null: no limit."
    )


class DronesInput(_Input):
    """The drones that ride on every truck of a type."""

    count: int = Field(ge=0, le=32, description="Drones per truck.")
    capacity: Demand = Field(
        description="Largest payload of one sortie, per dimension, in the unit of `demand`."
    )
    speed_kmh: Speed | None = Field(
        None,
        description=f"Airspeed in km/h, {DEFAULT_DRONE_SPEED_KMH:g} by default. Without meaning "
        "where the profile has a matrix.",
    )
    profile: Name = Field("drone", description="Entry of `matrices` that holds the flights.")
    endurance: Seconds | None = Field(
        None, description="Longest flight from take-off to recovery in seconds. Null: no limit."
    )
    endurance_includes_waiting: bool = Field(
        True, description="Whether waiting for the truck at the recovery stop uses endurance."
    )
    launch_duration: Seconds = Field(
        0.0, description="Time to launch in seconds; the truck stands still meanwhile."
    )
    recovery_duration: Seconds = Field(
        0.0, description="Time to recover in seconds; the truck stands still meanwhile."
    )
    service_duration: Seconds | None = Field(
        None, description="Time at a customer in seconds. Null: the customer's `service_duration`."
    )
    max_customers_per_sortie: int = Field(
        1, ge=1, le=100, description="Most customers on one flight."
    )
    costs: DroneCostsInput = Field(DroneCostsInput(), description="What flying costs.")


class VehicleTypeInput(_Input):
    """A number of equal trucks, with or without drones."""

    id: Name = Field(description="Name of the type, unique in the fleet; vehicles are `<id>-1`, …")
    depot: Name | None = Field(
        None, description="Depot where the vehicles start and end. Null: the first depot."
    )
    count: int = Field(ge=1, le=10_000, description="Vehicles of this type.")
    capacity: Demand = Field(
        description="Largest load of one trip, per dimension, drones' parcels included."
    )
    costs: CostsInput = Field(CostsInput(), description="What the vehicles cost.")
    speed_kmh: Speed | None = Field(
        None,
        description=f"Speed in km/h, {DEFAULT_TRUCK_SPEED_KMH:g} by default. Without meaning where "
        "the profile has a matrix, except as the base of a speed profile in km/h.",
    )
    profile: Name = Field("truck", description="Entry of `matrices` that holds the legs.")
    speed_profile: Annotated[list[SpeedChangeInput], Field(max_length=1000)] = Field(
        [],
        description="Speeds by time of day, in order of `from`. Before the first entry the usual "
        "speed holds. A leg that crosses a change is driven partly at each speed.",
    )
    shift: ShiftInput = Field(ShiftInput(), description="When the vehicles work.")
    max_working_duration: Seconds | None = Field(
        None,
        description="Longest time from first departure to last return in seconds. Null: no limit.",
    )
    max_trip_distance: Metres | None = Field(
        None, description="Longest drive of one trip in metres. Null: no limit."
    )
    max_trips: int = Field(1, ge=1, le=1000, description="Most trips of one vehicle.")
    reload_duration: Seconds = Field(
        0.0, description="Time at the depot between two trips in seconds."
    )
    skills: Skills = Field([], description="Skills of the vehicles, and of their drones.")
    drones: DronesInput | None = Field(None, description="Drones on every truck. Null: none.")


class MatrixInput(_Input):
    """Legs between all places by one kind of vehicle; rows are origins."""

    durations: Table = Field(
        description="Travel durations in seconds, `durations[from][to]`. The diagonal counts only "
        "between two places that share a row."
    )
    distances: Table | None = Field(
        None,
        description="Distances in metres, `distances[from][to]`. Null: computed from locations.",
    )


class WindInput(_Input):
    """A steady wind, felt by drones alone."""

    speed_kmh: Annotated[float, Field(ge=0, le=500)] = Field(0.0, description="Speed in km/h.")
    direction_deg: Annotated[float, Field(ge=0, le=360)] = Field(
        0.0,
        description="Where the wind comes from in degrees clockwise from north (the y axis): "
        "0 blows southwards, 90 westwards.",
    )


class AirspaceInput(_Input):
    """What changes flights that are computed from locations."""

    no_fly: Annotated[list[Polygon], Field(max_length=200)] = Field(
        [],
        description="Polygons that drones fly around, each a list of at least three corners in the "
        "coordinates of `location`.",
    )
    wind: WindInput = Field(WindInput(), description="Wind, the same everywhere and always.")


class OptionsInput(_Input):
    """How to plan."""

    policy: Name = Field(DEFAULT_POLICY, description="Policy that builds the plan.")
    decoding: Literal["greedy", "sample"] = Field(
        "greedy",
        description="`greedy` takes the likeliest decision each time, `sample` draws "
        "`num_samples` plans and keeps the best. Most of those that `attention` draws keep a part "
        "of the best so far.",
    )
    num_samples: int = Field(64, ge=1, le=MAX_NUM_SAMPLES, description="Plans drawn when sampling.")
    temperature: Annotated[float, Field(ge=0.01, le=100)] = Field(
        1.0,
        description="Above 1 samples more widely, below 1 more narrowly. Samples that keep a part "
        "of the best are drawn at 1.3 times this.",
    )
    seed: int = Field(
        0,
        ge=0,
        le=2**63 - 1,
        description="Seed of all random draws. See `search_iterations` for when plans repeat.",
    )
    time_limit: Annotated[float, Field(ge=0, le=MAX_TIME_LIMIT)] = Field(
        1.0,
        description="Seconds until the reply, validation included. 0: the policy's plan as it is.",
    )
    search_iterations: Annotated[int, Field(ge=0, le=10**12)] | None = Field(
        None,
        description="Iterations of the search, of all its threads together. Null: until "
        "`time_limit`. 0: the policy's plan as it is. If stated, the same request with the same "
        "`seed` and number of threads gets the same plan, unless `time_limit` ends the search "
        "first; the reply's `solver.deterministic` tells.",
    )
    threads: Annotated[int, Field(ge=1, le=MAX_THREADS)] | None = Field(
        None,
        description="Threads of the search. Null: as the service's setting "
        "`TANDEM_SEARCH_THREADS` says, usually one. No more are used than the machine has cores; "
        "the reply's `solver.threads` tells how many.",
    )


class ReplanInput(_Input):
    """A plan to go on from, and what of it stays."""

    plan: PlanInput = Field(
        description="A plan that `POST /plan` replied, unchanged or cut down. Customers whom it "
        "lacks are new orders; customers whom the request lacks are cancelled."
    )
    freeze_before: Seconds | None = Field(
        None,
        description="Now, in seconds since plan start: what has departed by then stays as the plan "
        "says, and vehicles go on from where they are with what they carry. Null: nothing has "
        "happened yet; the plan is where the search begins.",
    )
    pinned: Annotated[list[Name], Field(max_length=MAX_CUSTOMERS)] = Field(
        [], description="Customers who stay with their vehicles; if need be, they are left out."
    )
    pin_all: bool = Field(
        False, description="Whether all customers of the plan stay with their vehicles."
    )
    unavailable: Annotated[list[Name], Field(max_length=10_000)] = Field(
        [],
        description="Vehicles, such as `truck-2`, that do nothing more from `freeze_before` on; "
        "whom they haven't begun to serve by then others serve.",
    )
    parcels_back: Seconds | None = Field(
        None,
        description="When the parcels aboard unavailable vehicles are at the depots again, in "
        "seconds since plan start. Null: at `freeze_before`.",
    )


class PlanRequest(_Input):
    """Customers and a fleet."""

    coordinate_system: Literal["planar", "geographic"] = Field(
        "planar", description="What `location` means: planar `[x, y]` or `[longitude, latitude]`."
    )
    planar_unit: Annotated[float, Field(ge=1e-3, le=1e6)] = Field(
        1.0, description="Metres per planar unit."
    )
    depots: Annotated[list[DepotInput], Field(max_length=MAX_DEPOTS)] = Field(
        description="Depots, at least one."
    )
    customers: Annotated[list[CustomerInput], Field(max_length=MAX_CUSTOMERS)] = Field(
        description="Customers to serve; none is allowed and gives an empty plan."
    )
    fleet: Annotated[list[VehicleTypeInput], Field(max_length=MAX_VEHICLE_TYPES)] = Field(
        description="Vehicle types, at least one."
    )
    matrices: Annotated[dict[Name, MatrixInput], Field(max_length=100)] | None = Field(
        None,
        description="Travel durations and distances by profile, used in place of locations and "
        "speeds.",
    )
    airspace: AirspaceInput = Field(AirspaceInput(), description="No-fly areas and wind.")
    unassigned_cost: Money | None = Field(
        None,
        description="Cost of each customer left out. Null: larger than the detour to any customer.",
    )
    replan: ReplanInput | None = Field(
        None, description="A plan to go on from. Null: plan from nothing."
    )
    options: OptionsInput = Field(OptionsInput(), description="How to plan.")
