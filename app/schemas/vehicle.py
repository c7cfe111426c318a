"""A vehicle type of a request."""

from typing import Annotated, Literal, Self, get_args

from pydantic import Discriminator, Field, Tag, model_validator

from app.schemas.drones import (
    DEFAULT_ALTITUDE_M,
    DEFAULT_DRONE_SPEED_KMH,
    Drones,
    DronesInput,
    Flyer,
    TurnaroundInput,
)
from app.schemas.driving import LAWS, DrivingRulesInput
from app.schemas.energy import EnergyInput
from app.schemas.errors import IN_PLACE, IN_WORDS
from app.schemas.fields import (
    LOCATION_INDEX_TEXT,
    LOCATION_TEXT,
    MAX_AMOUNT,
    MAX_DEPOTS,
    Avoided,
    Count,
    Demand,
    Duration,
    Input,
    Instant,
    LocationIndex,
    Metres,
    Money,
    Name,
    Opening,
    PlaceLocation,
    Skills,
    Speed,
)
from app.schemas.limits import MAX_VEHICLES
from app.schemas.rulebook import RULES, RuleName, fill_in
from app.schemas.written import READ_BREAK_EARLIEST, READ_BREAK_LATEST, on_the_day_after
from model.problem import MAX_BREAKS

DEFAULT_TRUCK_SPEED_KMH = 40.0

FLIGHTS = "drone"
"""The usual profile of what flies."""

Kilograms = Annotated[float, Field(ge=0, le=1_000_000)]


class PlaceInput(Input):
    """A place of its own."""

    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)


def _tag_of_end(value: object) -> str:
    return IN_WORDS if isinstance(value, str) else IN_PLACE


End = Annotated[
    Annotated[Literal["depot", "open"], Tag(IN_WORDS)] | Annotated[PlaceInput, Tag(IN_PLACE)],
    Discriminator(_tag_of_end),
]


class CostsInput(Input):
    """What a vehicle costs, in one currency."""

    fixed: Money = Field(0.0, description="Cost per vehicle that is used at all.")
    per_km: Money = Field(1.0, description="Cost per kilometre driven by the truck.")
    per_hour: Money = Field(
        0.0, description="Cost per hour from first departure to last return, waiting included."
    )
    per_stop: Money = Field(
        0.0, description="Cost per customer whom the truck itself serves, not a drone."
    )
    per_load_km: Money = Field(
        0.0,
        description="Cost per kilometre that the truck drives, and unit of the first dimension "
        "that it has aboard.",
    )


class SpeedChangeInput(Input):
    """Speed from an instant on, until the next entry. State `speed_kmh` or `factor`, not both."""

    from_time: Instant = Field(
        alias="from", description="When this speed begins, in seconds since plan start."
    )
    speed_kmh: Speed | None = Field(None, description="Speed in km/h from then on.")
    factor: Annotated[float, Field(ge=0.05, le=20)] | None = Field(
        None, description="Speed from then on as a multiple of the vehicle type's usual speed."
    )


class ShiftInput(Input):
    """When vehicles of a type work."""

    earliest: Opening = Field(
        0.0, description="Earliest begin of the first trip in seconds since plan start."
    )
    latest: Instant | None = Field(
        None, description="Latest return in seconds since plan start. Null: no limit."
    )


class OvertimeInput(Input):
    """How far vehicles of a type may work past their shift and their longest working duration."""

    max_duration: Duration | None = Field(
        None, description="Longest overtime in seconds. Null: no limit."
    )
    cost_per_hour: Money = Field(
        description="Cost per hour of overtime, on top of `per_hour`. Past both limits, the longer "
        "time counts, once."
    )


Earliest = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_BREAK_EARLIEST]
Latest = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_BREAK_LATEST]


class BreakStartInput(Input):
    """When a break may begin."""

    earliest: Earliest = Field(
        0.0, description="Earliest begin in seconds since plan start, or since the departure."
    )
    latest: Latest | None = Field(
        None, description="Latest begin in seconds since plan start, or since the departure. Null: "
        "any time, so that the break is due on no route."
    )

    @model_validator(mode="after")
    def _of_its_day(self) -> Self:
        return on_the_day_after(self)


class BreakInput(Input):
    """A break of each vehicle's driver."""

    id: Name = Field(description="Name of the break, unique for the vehicle type.")
    duration: Duration = Field(description="Length in seconds.")
    start: BreakStartInput = Field(
        BreakStartInput(), description="When it may begin. A break is left out if it could be over "
        "before the route begins, or begin once it has ended."
    )
    after_departure: bool = Field(
        False, description="Whether `start` counts from when the vehicle's first trip begins: then "
        "it is seconds or a length of time, such as `PT5H30M`."
    )
    at: Literal["stop", "anywhere"] = Field(
        "stop", description="Where it is taken: at a `stop`, before or after its service, or "
        "`anywhere`, on the way too."
    )
    paid: bool = Field(True, description="Whether it counts in the working duration.")
    max_load: Demand | None = Field(
        None, description="What may be aboard the truck at most while it is taken. Null: anything.")


class VehicleTypeInput(Input):
    """A number of equal trucks, with or without drones."""

    id: Name = Field(description="Name of the type, unique in the fleet; vehicles are `<id>-1`, …")
    flies: bool = Field(
        False,
        description="Whether the vehicles are drones that fly from their depot by themselves: legs "
        "are flights, and whom they serve is served by drone.",
    )
    depot: Name | None = Field(
        None, description="Depot where trips begin and end. Null: the first depot.")
    start_location: PlaceLocation | None = Field(
        None,
        description="Where the vehicles begin, loaded, in the coordinates of `location`; further "
        "trips begin at the depot. Null: at the depot.",
    )
    start_location_index: LocationIndex | None = Field(
        None, description="Row and column of that place in `matrices`. Needed with them.")
    end: End = Field(
        "depot",
        description="Where the last trip ends: `depot`, `open` (at its last stop, drones aboard), "
        "or at a place of its own.",
    )
    reload_depots: Annotated[list[Name], Field(max_length=MAX_DEPOTS)] = Field(
        [],
        description="Depots where a trip may end and the next begin, besides `depot`. Which one "
        "it is between two trips is the plan's choice.",
    )
    count: int = Field(ge=1, le=MAX_VEHICLES, description="Vehicles of this type.")
    names: Annotated[list[Name], Field(max_length=MAX_VEHICLES)] = Field(
        [], description="What people call its vehicles, in order, at most `count`: ids stay.")
    capacity: Demand = Field(
        description="Largest load at any point of a trip, drones' included, per dimension.")
    pickups: Literal["any", "last"] = Field(
        "any",
        description="When a trip picks up: at any time, or only `last`, after all its deliveries, "
        "of which it has at least one.",
    )
    lifo: bool = Field(
        False,
        description="Whether only what was loaded last can be unloaded: the load is one stack.",
    )
    costs: CostsInput = Field(CostsInput(), description="What the vehicles cost.")
    speed_kmh: Speed | None = Field(
        None,
        description=f"Speed in km/h, {DEFAULT_TRUCK_SPEED_KMH:g} by default, and "
        f"{DEFAULT_DRONE_SPEED_KMH:g} where it flies. Without meaning where "
        "the profile has a matrix, except as the base of a speed profile in km/h.",
    )
    profile: Name = Field(
        "truck",
        description="Entry of `matrices` that holds the legs. Where it flies, `drone` by default.",
    )
    avoid: Annotated[list[Avoided], Field(max_length=len(get_args(Avoided)))] = Field(
        [],
        description="What the vehicles never drive on, where their legs are on roads: any of "
        "`tolls`, `motorways` and `ferries`.",
    )
    speed_profile: Annotated[list[SpeedChangeInput], Field(max_length=1000)] = Field(
        [],
        description="Speeds by time of day, in order of `from`. Before the first entry the usual "
        "speed holds. A leg that crosses a change is driven partly at each speed.",
    )
    shift: ShiftInput = Field(ShiftInput(), description="When the vehicles work.")
    max_working_duration: Duration | None = Field(
        None,
        description="Longest time from first departure to last return in seconds. Null: no limit.",
    )
    overtime: OvertimeInput | None = Field(
        None,
        description="Work past `shift.latest` or `max_working_duration`, at a price. Null: none is "
        "allowed.",
    )
    breaks: Annotated[list[BreakInput], Field(max_length=MAX_BREAKS)] = Field(
        [], description="Breaks of each vehicle's driver, in the order in which they are taken."
    )
    driving_rules: DrivingRulesInput | None = Field(
        None, description="Rests that each driver has to take, beside `breaks`. Null: none."
    )
    max_travel_duration: Duration | None = Field(
        None,
        description="Longest time on legs in seconds, of all trips of a vehicle: without service, "
        "waiting, setups and breaks. Null: no limit.",
    )
    max_distance: Metres | None = Field(
        None, description="Longest drive of all trips of a vehicle together, in metres. Null: no "
        "limit.",
    )
    max_trip_distance: Metres | None = Field(
        None, description="Longest drive of one trip in metres. Null: no limit."
    )
    max_trips: int = Field(1, ge=1, le=1000, description="Most trips of one vehicle.")
    max_stops: Count | None = Field(
        None,
        description="Most customers whom the truck itself serves on one trip; whom drones serve "
        "doesn't count. Null: no limit.",
    )
    max_sorties: Count | None = Field(
        None, description="Most sorties of one trip, of all its drones. Null: no limit."
    )
    max_airborne: Annotated[int, Field(ge=1)] | None = Field(
        None,
        description="Most drones of one truck in the air at once, from take-off to the beginning "
        "of recovery. Null: as many as it has.",
    )
    truck_waits: bool = Field(
        False,
        description="Whether the truck stands still while any of its drones is out: each is "
        "launched and recovered at the same stop.",
    )
    revisits: bool = Field(
        False,
        description="Whether the truck may stop again at a depot, or at a place whose customer it "
        "or its drones have served before, for its drones alone: each is a launch site then.",
    )
    reload_duration: Duration = Field(
        0.0, description="Time at the depot between two trips in seconds."
    )
    skills: Skills = Field([], description="Skills of the vehicles, and of their drones.")
    drones: Drones | None = Field(
        None,
        description="Drones on every truck, or a list of them by type, which are numbered from "
        "the first type on. Null: none.",
    )
    altitude: Annotated[float, Field(ge=0, le=10_000)] = Field(
        DEFAULT_ALTITUDE_M,
        description="Metres above ground at which it flies. Zones that don't reach it are no "
        "obstacle.",
    )
    endurance: Duration | None = Field(
        None,
        description="Longest trip of a vehicle that flies, from take-off to landing, in seconds. "
        "Null: no limit.",
    )
    max_range: Metres | None = Field(
        None,
        description="How far a customer of a vehicle that flies lies at most from where trips "
        "begin and end: straight, in metres. Null: no limit.",
    )
    max_wind_kmh: Annotated[float, Field(ge=0, le=500)] | None = Field(
        None,
        description="Strongest wind and strongest gusts in km/h in which a vehicle that "
        "flies may be in the air: trips wait until it is calm enough. Null: any.",
    )
    preset: RuleName | None = Field(
        None,
        description="A published rule whose `max_range` and `altitude` count for a vehicle that "
        "flies, unless they are stated; the reply has its numbers. It is no permission to fly. "
        "Null: none.",
    )
    launch_duration: Duration = Field(
        0.0, description="Time of the launch as each trip begins, where it flies, in seconds."
    )
    recovery_duration: Duration = Field(
        0.0, description="Time of the recovery as each trip ends, where it flies, in seconds."
    )
    energy: EnergyInput | None = Field(
        None,
        description="What trips of a vehicle that flies take of the battery, beside `endurance`. "
        "Null: nothing is known.",
    )
    turnaround: TurnaroundInput | None = Field(
        None, description="What a vehicle that flies needs between two trips. Null: nothing."
    )
    co2_kg_per_km: Kilograms | None = Field(
        None, description="CO2 of the truck per kilometre, for `summary.co2_kg` alone, in kg."
    )
    co2_kg_per_kwh: Kilograms | None = Field(
        None,
        description="CO2 of its drones' energy per kWh, for `summary.co2_kg` alone, in kg.",
    )

    @model_validator(mode="after")
    def _name_no_more_than_there_are(self) -> Self:
        if len(self.names) > self.count:
            raise ValueError(f"{len(self.names)} names for {self.count} vehicles")
        return self

    @model_validator(mode="after")
    def _keep_rules(self) -> Self:
        """Fill in what the rules that drones name have and the request doesn't state."""
        rules = [RULES[drones.preset] for drones in self.drone_types
                 if drones.preset is not None and drones.count > 0]
        if rules and "max_airborne" not in self.model_fields_set:
            object.__setattr__(self, "max_airborne", min(rule.max_airborne for rule in rules))
        if rules and "truck_waits" not in self.model_fields_set:
            object.__setattr__(self, "truck_waits", any(rule.truck_waits for rule in rules))
        return self

    @model_validator(mode="after")
    def _keep_own_rule(self) -> Self:
        """Fill in what the rule of who flies has and the request doesn't state."""
        fill_in(self, self.preset)
        return self

    @model_validator(mode="after")
    def _keep_driving_rules(self) -> Self:
        """Fill in how long the rule that drivers keep lets them work."""
        rules = self.driving_rules
        if (rules is not None and rules.preset is not None
                and "max_working_duration" not in self.model_fields_set):
            limit = LAWS[rules.preset].max_working_duration
            object.__setattr__(self, "max_working_duration", limit)
        return self

    @model_validator(mode="after")
    def _flies_by_flights(self) -> Self:
        """Let the legs of who flies be flights unless another profile is stated."""
        if self.flies and "profile" not in self.model_fields_set:
            object.__setattr__(self, "profile", FLIGHTS)
        return self

    @property
    def flyers(self) -> list[Flyer]:
        """What flies: the drones of each type that there are, or the vehicle itself."""
        if self.flies:
            return [self]
        return [drones for drones in self.drone_types if drones.count > 0]

    @property
    def drones_by_path(self) -> list[tuple[tuple[str | int, ...], DronesInput]]:
        """The drones of each type, and the path of where they are stated."""
        if self.drones is None:
            return []
        if isinstance(self.drones, DronesInput):
            return [(("drones",), self.drones)]
        return [(("drones", index), drones) for index, drones in enumerate(self.drones)]

    @property
    def flyers_by_path(self) -> list[tuple[tuple[str | int, ...], Flyer]]:
        """What flies, if there were any of it, and the path of where it is stated."""
        own: list[tuple[tuple[str | int, ...], Flyer]] = [((), self)] if self.flies else []
        return [*own, *self.drones_by_path]

    @property
    def drone_types(self) -> list[DronesInput]:
        """The drones of each type."""
        return [drones for _, drones in self.drones_by_path]
