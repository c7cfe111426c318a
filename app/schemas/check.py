"""What a client may send to `POST /check`, and what it gets back."""

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest
from app.schemas.response import CostReply, SummaryReply, ViolationReply


class CheckRequest(BaseModel):
    """A problem and a plan for it."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)

    problem: PlanRequest = Field(
        description="A request of `POST /plan`; its options don't matter. With `replan`, the plan "
        "is judged as one that goes on from that given there."
    )
    plan: PlanInput = Field(description="Any plan, such as a reply of `POST /plan`, unchanged.")


class CheckReply(BaseModel):
    """A judged plan."""

    model_config = ConfigDict(extra="forbid")

    feasible: bool = Field(description="Whether no rule is broken.")
    violations: list[ViolationReply] = Field(description="Every broken rule.")
    cost: CostReply = Field(
        description="True cost by term, computed anew; routes that can't be read cost nothing."
    )
    summary: SummaryReply = Field(description="The plan in numbers, computed anew.")
