"""What a client tells of a day."""

from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, RootModel, model_validator
from pydantic_core import PydanticCustomError

from app.schemas.customer import CustomerInput
from app.schemas.fields import Duration, Input, Instant, Location, Name
from app.schemas.quote import require_one
from app.schemas.shipment import ShipmentInput

MAX_EVENTS_AT_ONCE = 1_000
MAX_REASON = 500

Reason = Annotated[str, Field(max_length=MAX_REASON)]

KIND = "What happened."
VEHICLE, DRONE = "Its name in the plan, such as `van-1`.", "Its name, such as `van-1/drone-1`."
UNDONE = "Takes back what was told of the same before."


class DayEvent(Input):
    """Something that happens."""

    event_id: Annotated[str, Field(min_length=1, max_length=64)] = Field(
        description="The event's own name: sent again it counts once.")
    at: Instant = Field(description="When it happened.")


class OrderStated(DayEvent):
    """An order that is new, or another in place of the one of its id."""

    kind: Literal["order.placed", "order.changed"] = Field(description=KIND)
    customer: CustomerInput | None = Field(None, description="The order, to or from a customer.")
    shipment: ShipmentInput | None = Field(None, description="The order, from place to place.")

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        """Refuse what is no order, or two."""
        require_one(self.customer, self.shipment)
        return self

    @property
    def order(self) -> str:
        """Its name."""
        stated = self.customer or self.shipment
        assert stated is not None, "checked when it was read"
        return stated.id


class OrderCancelled(DayEvent):
    """An order that isn't wanted any more."""

    kind: Literal["order.cancelled"] = Field(description=KIND)
    order: Name = Field(description="Id of the customer or the shipment.")


class OrderPinned(DayEvent):
    """A dispatcher settles by hand who serves an order, or that nobody does.

    `undone`: planning decides again.
    """

    kind: Literal["order.pinned"] = Field(description=KIND)
    order: Name = Field(description="Id of the customer or the shipment.")
    vehicle: Name | None = Field(
        None, description="Who serves it, in all plans to come.")
    left_out: bool = Field(
        False, description="Nobody serves it; who is on the way does. Stated are this, `vehicle` "
        "or `undone`.")
    after: Name | None = Field(
        None, description="Id of a customer whom the same vehicle serves before, somewhere; of "
        "customers alone. Null: wherever it fits best.")
    undone: bool = Field(False, description="Lifts what was settled of the order.")

    @model_validator(mode="after")
    def _is_whole(self) -> Self:
        """Refuse what settles nothing."""
        if self.vehicle is None and not self.undone and not self.left_out:
            raise PydanticCustomError(
                "MISSING_FIELD", "No vehicle is stated: name one, or say `left_out` or `undone`.")
        if self.left_out and (self.vehicle, self.after) != (None, None):
            raise PydanticCustomError(
                "OUT_OF_RANGE", "Who is left out has no vehicle, and comes after nobody: leave "
                "these out.")
        if self.after == self.order:
            raise PydanticCustomError(
                "OUT_OF_RANGE", "It can't be served after itself: name another in `after`.")
        return self


class VehicleDeparted(DayEvent):
    """A vehicle left a depot, or where it begins."""

    kind: Literal["vehicle.departed"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    undone: bool = Field(False, description=UNDONE)


class VehicleArrived(DayEvent):
    """A vehicle is somewhere."""

    kind: Literal["vehicle.arrived"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    order: Name | None = Field(
        None, description="Whose door it stands at, as the plan's stop is named. Null: its trip "
        "is over.")
    undone: bool = Field(False, description=UNDONE)


class VehicleServed(DayEvent):
    """A vehicle, or a drone of it, served somebody, or could not."""

    kind: Literal["vehicle.served", "vehicle.failed"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    order: Name = Field(description="Whom, as the plan's stop is named.")
    reason: Reason | None = Field(None, description="Why not.")
    undone: bool = Field(False, description=UNDONE)


class VehicleBroken(DayEvent):
    """A vehicle has broken down; `undone`: it goes on."""

    kind: Literal["vehicle.broken"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    reason: Reason | None = Field(None, description="Why.")
    undone: bool = Field(False, description=UNDONE)


class VehicleDelayed(DayEvent):
    """A vehicle will be later at its next stop than planned."""

    kind: Literal["vehicle.delayed"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    by: Duration = Field(description="How many seconds.")


class VehiclePosition(DayEvent):
    """Where a vehicle is."""

    kind: Literal["vehicle.position"] = Field(description=KIND)
    vehicle: Name = Field(description=VEHICLE)
    location: Location = Field(description="As locations of the day's problem are.")


class DroneFlown(DayEvent):
    """A drone took off from its vehicle, or is back on it."""

    kind: Literal["drone.launched", "drone.recovered"] = Field(description=KIND)
    drone: Name = Field(description=DRONE)
    order: Name | None = Field(None, description="One of those it flies to. Null: its next flight.")
    undone: bool = Field(False, description=UNDONE)


class DroneLost(DayEvent):
    """A drone flies no more; of the flight it is on, nobody was served."""

    kind: Literal["drone.lost"] = Field(description=KIND)
    drone: Name = Field(description=DRONE)
    reason: Reason | None = Field(None, description="Why.")


class Clock(DayEvent):
    """What time it is, where a day goes by the times it is told."""

    kind: Literal["clock"] = Field(description=KIND)


AnyEvent = Annotated[
    OrderStated | OrderCancelled | OrderPinned | VehicleDeparted | VehicleArrived | VehicleServed
    | VehicleBroken | VehicleDelayed | VehiclePosition | DroneFlown | DroneLost | Clock,
    Discriminator("kind")]


class DayEventsRequest(RootModel[Annotated[
        list[AnyEvent], Field(min_length=1, max_length=MAX_EVENTS_AT_ONCE)]]):
    """What happened, in any order."""
