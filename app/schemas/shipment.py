"""A parcel of a request that is fetched at one place and brought to another."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from app.schemas.customer import CustomerInput, TimeWindowInput, VehiclesInput, Windows
from app.schemas.fields import (
    LAUNCH_TEXT, LOCATION_INDEX_TEXT, LOCATION_TEXT, Demand, Duration, DurationsByType, Goods, Info,
    Input, LocationIndex, Money, Name, PlaceLocation, Skills, VehicleCosts,
)

EndKind = Literal["pickup", "delivery"]
ENDS: tuple[EndKind, EndKind] = ("pickup", "delivery")


class ShipmentEndInput(Input):
    """Where a shipment is picked up, or delivered."""

    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    service_duration: Duration = Field(0.0, description="Time spent there in seconds.")
    service_duration_by_type: DurationsByType = Field(
        default_factory=dict, json_schema_extra={"default": {}},
        description="Seconds instead of `service_duration` by vehicle type, such as `van`.",
    )
    setup_duration: Duration = Field(0.0, description="As a customer's.")
    time_window: TimeWindowInput = Field(
        TimeWindowInput(), description="When service may start. Default: at any time."
    )
    time_windows: Windows | None = Field(
        None, description="Several windows instead of `time_window`, as a customer's."
    )
    launch: bool = Field(True, description=LAUNCH_TEXT)
    info: Info = Field(
        default_factory=dict, json_schema_extra={"default": {}},
        description="What drivers are to know there, in words.",
    )
    served_by: Literal["truck", "either"] = Field(
        "truck",
        description="Who comes: the truck itself, or either it or a drone of it. What a drone "
        "fetches is aboard the truck from where that recovers it; what one delivers is launched "
        "at a stop behind.",
    )


class ShipmentInput(Input):
    """A parcel that one vehicle fetches and brings on the same trip, aboard between."""

    id: Name = Field(description="Name of the shipment, unique among them.")
    amount: Demand = Field(description="What is aboard between, per dimension, as `demand`.")
    pickup: ShipmentEndInput = Field(description="Where it is fetched.")
    delivery: ShipmentEndInput = Field(description="Where it is brought.")
    max_time_between: Duration | None = Field(
        None,
        description="Longest time in seconds from the end of service at the pickup to the start "
        "of service at the delivery. Null: no limit.",
    )
    max_detour: Annotated[float, Field(ge=1, le=1_000_000)] | None = Field(
        None,
        description="The same as a multiple of the direct leg's duration by the vehicle's table, "
        "in thousandths; the tighter of both holds. Null: no limit.",
    )
    skills: Skills = Field(
        default_factory=list, json_schema_extra={"default": []},
        description="Skills that the serving vehicle type must have, all.",
    )
    vehicles: VehiclesInput | None = Field(
        None, description="Vehicles that may serve it, as a customer's. Null: all."
    )
    vehicle_costs: VehicleCosts = Field(
        default_factory=dict, json_schema_extra={"default": {}},
        description="Cost of being brought by vehicles of a type, or a single one, once, as a "
        "customer's.",
    )
    goods: Goods = Field(
        default_factory=list, json_schema_extra={"default": []},
        description="What it is, by the names that `incompatible_goods` uses.",
    )
    unassigned_cost: Money | None = Field(
        None, description="Cost of leaving it out, as a customer's."
    )

    def ends(self) -> Iterator[CustomerInput]:
        """Yield its ends as customers; only leaving out the first has a cost."""
        for kind, end in zip(ENDS, (self.pickup, self.delivery), strict=True):
            yield CustomerInput.model_construct(
                None, **dict(end), id=end_name(self.id, kind), demand=self.amount, pickup=None,
                skills=self.skills, max_time_aboard=None, goods=self.goods,
                release_time=0.0, vehicles=self.vehicles,
                vehicle_costs=self.vehicle_costs if kind == "pickup" else {},
                unassigned_cost=self.unassigned_cost if kind == "pickup" else 0.0)


def end_name(shipment: str, kind: EndKind) -> str:
    """Return the name of a shipment's end among customers."""
    return f"{shipment}/{kind}"
