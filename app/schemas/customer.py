"""A customer of a request."""

from collections.abc import Iterator
from operator import attrgetter
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from app.schemas.fields import (
    APPROACH_TEXT,
    LAUNCH_TEXT,
    LOCATION_INDEX_TEXT,
    LOCATION_TEXT,
    MAX_AMOUNT,
    Approach,
    Demand,
    Duration,
    DurationsByType,
    Goods,
    Info,
    Input,
    LocationIndex,
    Money,
    Name,
    Opening,
    PlaceLocation,
    Skills,
    VehicleCosts,
)
from app.schemas.written import READ_WINDOW_END, READ_WINDOW_START, moved_end, on_the_day_after
from model.problem import MAX_DIMENSIONS


Earliest = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_WINDOW_START]
Latest = Annotated[float, Field(ge=0, le=MAX_AMOUNT), READ_WINDOW_END]


class TimeWindowInput(Input):
    """When service at a customer may start; both ends belong to the window."""

    earliest: Earliest = Field(
        0.0, description="Earliest start of service in seconds since plan start; earlier waits."
    )
    latest: Latest | None = Field(
        None, description="Latest arrival in seconds since plan start. Null: no limit."
    )
    late_cost_per_hour: Money | None = Field(
        None,
        description="Cost per hour of arriving after `latest`. Null: arriving later isn't allowed.",
    )
    late_cost: Money = Field(
        0.0, description="Cost of arriving after `latest` at all, however late, where "
        "`late_cost_per_hour` is stated.",
    )
    early_cost_per_hour: Money = Field(
        0.0, description="Cost per hour of waiting for `earliest` at the customer."
    )

    @model_validator(mode="after")
    def _of_its_day(self) -> Self:
        return on_the_day_after(self)


def _in_order(windows: list[TimeWindowInput]) -> list[TimeWindowInput]:
    """Return windows, of which some may have been moved behind others."""
    if not any(map(moved_end, windows)):
        return windows
    return sorted(windows, key=attrgetter("earliest"))


Vehicles = Annotated[list[Name], Field(min_length=1, max_length=1000)]


class VehiclesInput(Input):
    """Who may serve a customer: vehicle types, or single vehicles such as `truck-2`."""

    allowed: Vehicles | None = Field(
        None, description="Ids of vehicle types or names of vehicles that may serve it, no others. "
        "Null: all but those forbidden."
    )
    forbidden: Vehicles | None = Field(
        None, description="Ids of vehicle types or names of vehicles that may not serve it. State "
        "this or `allowed`, not both."
    )

    @property
    def names(self) -> list[str]:
        """What is named, allowed or forbidden."""
        return self.allowed or self.forbidden or []


Windows = Annotated[list[TimeWindowInput], Field(min_length=1, max_length=8),
                    AfterValidator(_in_order)]


class AlternativeInput(Input):
    """A place where a customer may be served instead of at its own. All else is as it says."""

    id: Name = Field(description="Name of the place, unique among those of the customer.")
    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    service_duration: Duration | None = Field(
        None, description="Time spent there in seconds, by whatever vehicle. Null: as the "
        "customer says.")
    time_window: TimeWindowInput = Field(
        TimeWindowInput(), description="When service may start there. Default: at any time.")
    time_windows: Windows | None = Field(
        None, description="Several windows instead of `time_window`, as a customer's.")
    cost: Money = Field(0.0, description="Cost of being served there, among those of `stops`.")
    approach: Approach | None = Field(
        None, description="How roads lead there. Null: as its customer.")


class CustomerInput(Input):
    """A place with a demand, served once by a truck or a drone."""

    # Pydantic would copy lists and objects deeply for each customer: factories are quicker.

    id: Name = Field(description="Name of the customer, unique among customers.")
    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    demand: Demand = Field(
        description=f"Amount to deliver in 1 to {MAX_DIMENSIONS} dimensions (such as kg and "
        "litres), in your units; as many as every `capacity`. Counted exactly, with up to nine "
        "decimals."
    )
    pickup: Demand | None = Field(
        None,
        description="Amount taken in at this stop, after the delivery, and brought to where the "
        "trip ends; as `demand`. Null: nothing."
    )
    service_duration: Duration = Field(0.0, description="Time spent at the customer in seconds.")
    service_duration_by_type: DurationsByType = Field(
        default_factory=dict,
        json_schema_extra={"default": {}},
        description="Seconds instead of `service_duration` by vehicle type, such as `van`, and by "
        "the drones of one, such as `van/drone`, or `van/small` by the `id` of drones, before the "
        "drones' own `service_duration`.",
    )
    setup_duration: Duration = Field(
        0.0,
        description="Seconds spent on arrival, before service, by truck or drone; none if its stop "
        "before was at the same place, by coordinates or by `location_index`.",
    )
    time_window: TimeWindowInput = Field(
        TimeWindowInput(), description="When service may start. Default: at any time."
    )
    time_windows: Windows | None = Field(
        None,
        description="Several windows instead of `time_window`, one after another: service starts "
        "in one of them, and whoever comes between two waits for the next. Only the last may be "
        "soft. Null: `time_window` holds.",
    )
    served_by: Literal["truck", "drone", "either"] = Field(
        "either", description="Kind of vehicle that may serve the customer."
    )
    skills: Skills = Field(
        default_factory=list,
        json_schema_extra={"default": []},
        description="Skills that the serving vehicle type must have, all.",
    )
    max_time_aboard: Duration | None = Field(
        None,
        description="Longest time in seconds from the departure of its trip from the depot to the "
        "start of service. Null: no limit.",
    )
    goods: Goods = Field(
        default_factory=list,
        json_schema_extra={"default": []},
        description="What is delivered, by the names that `incompatible_goods` uses.",
    )
    release_time: Opening = Field(
        0.0,
        description="When the parcel is at the depot, in seconds since plan start: a trip that "
        "carries it begins no earlier.",
    )
    unassigned_cost: Money | None = Field(
        None,
        description="Cost of leaving the customer out. Null: the request's; if that is null too, "
        "the customer must be served, and is left out only if no plan found serves all who must.",
    )

    vehicles: VehiclesInput | None = Field(
        None, description="Vehicles that may serve the customer. Null: all. A name that is both a "
        "type's and a vehicle's means the type."
    )
    vehicle_costs: VehicleCosts = Field(
        default_factory=dict,
        json_schema_extra={"default": {}},
        description="Cost of being served by vehicles of a type, or a single one such as `van-3`, "
        "or their drones, on top of all else: a preference, no ban. What names a vehicle holds "
        "instead of what names its type; others cost nothing.",
    )
    alternatives: Annotated[list[AlternativeInput], Field(max_length=8)] = Field(
        default_factory=list,
        json_schema_extra={"default": []},
        description="Other places, such as a locker or a neighbour's. One place is used, its own "
        "or one of these.",
    )
    launch: bool = Field(True, description=LAUNCH_TEXT)
    approach: Approach | None = Field(None, description=APPROACH_TEXT)
    info: Info = Field(
        default_factory=dict,
        json_schema_extra={"default": {}},
        description="What drivers are to know, in words: `address`, `phone`, `notes` and the like. "
        "It stands at the customer's stop in the plan; planning doesn't look at it.",
    )

    @property
    def windows(self) -> list[TimeWindowInput]:
        """The windows, one after another."""
        return [self.time_window] if self.time_windows is None else self.time_windows

    def others(self) -> "Iterator[CustomerInput]":
        """Yield its other places as customers; leaving them out costs nothing."""
        for place in self.alternatives:
            own = place.service_duration is not None
            yield CustomerInput.model_construct(None, **{
                **dict(self), "id": place_name(self.id, place.id), "location": place.location,
                "location_index": place.location_index, "time_window": place.time_window,
                "time_windows": place.time_windows, "unassigned_cost": 0.0, "alternatives": [],
                "approach": place.approach or self.approach,
                **({"service_duration": place.service_duration, "service_duration_by_type": {}}
                   if own else {})})


def place_name(customer: str, alternative: str) -> str:
    """Return the name of a customer's other place among customers."""
    return f"{customer}/{alternative}"


def place_of(name: str, alternative: str) -> str:
    """Return the same where a plan that was read before may name the place already."""
    return name if name.endswith(place_name("", alternative)) else place_name(name, alternative)


def customer_of(place: str, alternative: str | None) -> str:
    """Return the id of the customer whose other place has a name; of his own, the name itself."""
    return place if alternative is None else place.removesuffix(place_name("", alternative))
