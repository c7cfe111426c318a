"""What a client may ask at `POST /fit`, and what it gets back."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.check import CheckRequest
from app.schemas.customer import CustomerInput
from app.schemas.explain import ExplainOptions, HereReply, PlacedReply, RuleReply
from app.schemas.request import PlanRequest
from app.schemas.response import WARNINGS_TEXT, CostReply, RouteReply, WarningReply
from app.schemas.shipment import ShipmentInput

MAX_PLACES = 20


class FitRequest(CheckRequest):
    """A problem, a plan for it, and a customer or shipment for whom places are sought."""

    customer: str | None = Field(
        None, description="Id of a customer of the problem, whether the plan serves him or not, or "
        "of one end of a shipment (`s1/pickup`), which then moves alone. Null: another of the four "
        "is stated.")
    new_customer: CustomerInput | None = Field(
        None, description="A customer whom the problem doesn't have, as one of its `customers`. "
        "Null: another is stated.")
    shipment: str | None = Field(
        None, description="Id of a shipment of the problem, all ends of which move as one. "
        "Null: another is stated.")
    new_shipment: ShipmentInput | None = Field(
        None, description="A shipment that the problem doesn't have, as one of its `shipments`. "
        "Null: another is stated.")
    count: Annotated[int, Field(ge=1, le=MAX_PLACES)] = Field(
        3, description="How many places are asked for.")
    one_per_vehicle: bool = Field(
        False, description="Whether only the best place of each vehicle is told.")
    options: ExplainOptions = Field(ExplainOptions(), description="How much is tried.")

    @property
    def whole_problem(self) -> PlanRequest:
        """The problem, the new customer or shipment being its last."""
        customers, added = self.problem.customers, self.new_shipment
        if self.new_customer is not None:
            return self.problem.with_customer(self.new_customer)
        if added is not None:
            return self.problem.model_copy(update={
                "customers": [*customers, *added.ends()],
                "shipments": [*self.problem.shipments, added]})
        return self.problem

    def path_of(self, path: str) -> str:
        """Return where in the request something of `whole_problem` is stated."""
        if self.new_shipment is not None:
            return path.replace(f"$.problem.shipments[{len(self.problem.shipments)}]",
                                "$.new_shipment")
        return path.replace(f"$.problem.customers[{self.problem.num_stated}]", "$.new_customer")


class FitPlaceReply(PlacedReply):
    """A place for the customer or shipment."""

    cost: CostReply = Field(
        description="What the plan costs more than without him, by term; nothing is counted for "
        "leaving him or his `companions` out. All others stay with their vehicles, in their order. "
        "Where it is not feasible: the cost with the rule broken.")
    feasible: bool = Field(
        description="Whether no rule is broken but those that the plan breaks without him.")
    reasons: list[RuleReply] = Field(description="Rules that forbid it.")


class BestPlaceReply(FitPlaceReply):
    """One of the best places, and the vehicle's route with him."""

    route: RouteReply | None = Field(
        description="The vehicle's work with it there, as `POST /plan` tells it: in "
        "place of its route, or beside the others, it makes the plan. Null: no way leads there.")


class FitReply(BaseModel):
    """The best places for a customer or shipment."""

    model_config = ConfigDict(extra="forbid")

    customer: str | None = Field(description="Id of the customer. Null: it is a shipment.")
    shipment: str | None = Field(description="Id of the shipment. Null: it is a customer.")
    cost: CostReply = Field(description="What the plan given costs, by term.")
    here: HereReply | None = Field(description="Where the plan serves him. Null: nowhere.")
    places: list[BestPlaceReply] = Field(
        description="The best places that break no rule, the cheapest first; if there is none, "
        "those that break fewest. Of several stops where a drone may be recovered, the best.")
    others: list[FitPlaceReply] = Field(
        description="The best place of each vehicle that has none of those, with what forbids it; "
        "of vehicles that stay at home, one of each type.")
    complete: bool = Field(
        description="Whether there was time to try all that is tried with time enough.")
    warnings: list[WarningReply] = Field([], description=WARNINGS_TEXT)
