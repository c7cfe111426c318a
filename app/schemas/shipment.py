"""A parcel of a request that is fetched at one place, or several, and brought to another."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from app.schemas.customer import CustomerInput, TimeWindowInput, VehiclesInput, Windows
from app.schemas.fields import (
    APPROACH_TEXT, LAUNCH_TEXT, LOCATION_INDEX_TEXT, LOCATION_TEXT, MAX_AMOUNT, Approach, Demand,
    Duration, DurationsByType, Goods, Info, Input, LocationIndex, Money, Name, PlaceLocation,
    Skills, VehicleCosts,
)
from model.problem import MOST_PICKUPS

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
    approach: Approach | None = Field(None, description=APPROACH_TEXT)
    info: Info = Field(
        default_factory=dict, json_schema_extra={"default": {}},
        description="What drivers are to know there, in words.",
    )
    served_by: Literal["truck", "either"] = Field(
        "truck",
        description="Who comes: the truck itself, or either it or a drone of it. What a drone "
        "fetches is aboard the truck from where that recovers it; what one delivers is launched "
        "at a stop behind, or, if it has one `pickup`, fetched on the same sortie.",
    )


class ShipmentPickupInput(ShipmentEndInput):
    """One of several places where a shipment is picked up."""

    id: Name = Field(description="Name of the pickup, unique among those of the shipment.")
    amount: Demand = Field(description="What is aboard from there to the delivery, per dimension.")


class ShipmentInput(Input):
    """A parcel that one vehicle fetches and brings on the same trip, aboard between.

    In parts, if from several places: all of them, or none, before the delivery.
    """

    id: Name = Field(description="Name of the shipment, unique among them.")
    amount: Demand | None = Field(
        None, description="What is aboard between, per dimension, as `demand`. Null with `pickups`."
    )
    pickup: ShipmentEndInput | None = Field(
        None, description="Where it is fetched. Null with `pickups`."
    )
    pickups: Annotated[list[ShipmentPickupInput], Field(max_length=MOST_PICKUPS)] = Field(
        default_factory=list, json_schema_extra={"default": []}, validate_default=True,
        description="Where it is fetched in parts instead, in any order, each with an amount.",
    )
    delivery: ShipmentEndInput = Field(description="Where it is brought.")
    max_time_between: Duration | None = Field(
        None,
        description="Longest time in seconds from the end of service at the pickup, or the first, "
        "to the start of service at the delivery. Null: no limit.",
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

    @field_validator("pickups")
    @classmethod
    def _require_pickups(cls, pickups: list[ShipmentPickupInput],
                         info: ValidationInfo) -> list[ShipmentPickupInput]:
        """Refuse both ways of stating pickups at once, and neither."""
        others = [info.data[name] for name in ("amount", "pickup") if name in info.data]
        if any((other is None) != bool(pickups) for other in others):
            raise PydanticCustomError(
                "PICKUP_OR_PICKUPS", "Where it is fetched is stated by `pickup` and `amount`, or "
                "by `pickups`, each with an amount of its own: state one of these.")
        sums = [sum(amounts) for amounts in zip(*[part.amount for part in pickups], strict=False)]
        if max(sums, default=0.0) > MAX_AMOUNT:
            raise PydanticCustomError(
                "OUT_OF_RANGE", f"What is delivered must not exceed {MAX_AMOUNT:g} in all: state "
                "smaller amounts, or another unit.")
        return pickups

    def named_ends(self) -> list[tuple[str, str]]:
        """Return the names of its ends among customers, and where it states them."""
        pickups = [(end_name(self.id, "pickup", part.id), f"pickups[{number}]")
                   for number, part in enumerate(self.pickups)]
        return [*(pickups or [(end_name(self.id, "pickup"), "pickup")]),
                (end_name(self.id, "delivery"), "delivery")]

    def ends(self) -> Iterator[CustomerInput]:
        """Yield its ends as customers; only leaving out the first has a cost."""
        for number, (name, end, amount) in enumerate(self._stated_ends()):
            own = {**dict(end), "id": name, "demand": amount}
            own.pop("amount", None)
            yield CustomerInput.model_construct(
                None, **own, pickup=None, skills=self.skills, max_time_aboard=None, alternatives=[],
                goods=self.goods, release_time=0.0, vehicles=self.vehicles,
                vehicle_costs={} if number else self.vehicle_costs,
                unassigned_cost=0.0 if number else self.unassigned_cost)

    def _stated_ends(self) -> Iterator[tuple[str, ShipmentEndInput, list[float]]]:
        """Yield its ends with their names among customers, and what is fetched or brought there."""
        whole = self.amount or [sum(amounts) for amounts in zip(
            *[part.amount for part in self.pickups], strict=False)]
        if self.pickup is not None:
            yield end_name(self.id, "pickup"), self.pickup, whole
        for part in self.pickups:
            yield end_name(self.id, "pickup", part.id), part, part.amount
        yield end_name(self.id, "delivery"), self.delivery, whole


def end_name(shipment: str, kind: EndKind, part: str | None = None) -> str:
    """Return the name of a shipment's end among customers, of one of several pickups by its id."""
    return f"{shipment}/{kind}" if part is None else f"{shipment}/{kind}/{part}"
