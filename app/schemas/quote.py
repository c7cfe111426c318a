"""What a client may ask at `POST /quote`, and what it gets back."""

from datetime import datetime
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from app.schemas.check import CheckRequest
from app.schemas.customer import CustomerInput
from app.schemas.explain import RuleReply
from app.schemas.fields import Input, Instant
from app.schemas.fit import FitRequest
from app.schemas.request import PlanRequest
from app.schemas.shipment import ShipmentInput
from app.schemas.times import InstantReply

MAX_SLOTS = 50

By = Literal["truck", "drone", "either"]


class SlotInput(Input):
    """When an order might be served, and by what."""

    earliest: Instant = Field(0.0, description="First start of service.")
    latest: Instant | None = Field(None, description="Last start of service. Null: any.")
    by: By = Field("either", description="`truck`, `drone`, or `either`.")

    @model_validator(mode="after")
    def _is_ordered(self) -> Self:
        """Refuse a slot that ends before it begins."""
        if self.latest is not None and self.latest < self.earliest:
            raise PydanticCustomError(
                "OUT_OF_RANGE", "The slot ends before it begins: correct one of its ends.")
        return self


Slots = Annotated[list[SlotInput], Field(min_length=1, max_length=MAX_SLOTS)]


class OrderAsked(Input):
    """An order that isn't accepted yet, and when it might be served."""

    order: CustomerInput | None = Field(
        None, description="A customer whom the problem doesn't have; windows are the slots'.")
    shipment: ShipmentInput | None = Field(
        None, description="A shipment instead; slots are of its delivery.")
    slots: Slots = Field(description="Of which each is priced.")
    search: bool = Field(
        True, description="Whether others may make room, as a search of some milliseconds finds. "
        "Else each slot costs what its cheapest place does, told in a third of the time.")

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        """Refuse what is no order, or two."""
        require_one(self.order, self.shipment)
        return self


class QuoteRequest(OrderAsked, CheckRequest):
    """A problem, its plan, and an order that isn't accepted yet."""

    @property
    def asked(self) -> FitRequest:
        """The same as what `POST /fit` is asked, the order at any time."""
        return FitRequest.model_construct(
            problem=self.problem, plan=self.plan, new_customer=self.order,
            new_shipment=self.shipment)

    @property
    def whole_problem(self) -> PlanRequest:
        """The problem, the order being its last."""
        return self.asked.whole_problem

    def path_of(self, path: str) -> str:
        """Return where in the request something of `whole_problem` is stated."""
        return (self.asked.path_of(path).replace("$.new_customer", "$.order")
                .replace("$.new_shipment", "$.shipment"))


def require_one(order: CustomerInput | None, shipment: ShipmentInput | None) -> None:
    """Refuse what is no order, or two; raises `PydanticCustomError`."""
    if (order is None) == (shipment is None):
        raise PydanticCustomError(
            "MISSING_FIELD", "An order is a customer or a shipment: state one of them.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class SlotReply(_Reply):
    """What a slot would cost."""

    earliest: InstantReply = Field(description="As it was asked.")
    latest: InstantReply | None = Field(description="As it was asked.")
    by: By = Field(description="As it was asked.")
    feasible: bool = Field(description="Whether it can be kept.")
    cost: float | None = Field(
        description="What the plan costs more, by the best plan that was found with it, "
        "and `of_which_future`. Null: it can't be kept.")
    of_which_future: float | None = Field(
        None, description="What it takes from orders to come, by the problem's `forecast`; "
        "negative where it rides along with them. Null: nothing is known of them.")
    vehicle: str | None = Field(None, description="Who would serve it.")
    arrival: InstantReply | None = Field(None, description="When.")
    after: str | None = Field(None, description="Behind which stop of its trip.")
    why: list[RuleReply] = Field([], description="Rules that forbid it.")


class QuoteReply(_Reply):
    """What an order would cost, slot by slot."""

    slots: list[SlotReply] = Field(description="As they were asked.")
    best: int | None = Field(description="The cheapest that can be kept, from 0. Null: none.")
    token: str | None = Field(None, description="By which a day accepts one of them.")
    lapses_at: datetime | None = Field(None, description="Until when.")
