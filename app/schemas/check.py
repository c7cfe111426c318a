"""What a client may send to `POST /check`, and what it gets back."""

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.lateness import RISK_TEXT, LatenessRiskReply
from app.schemas.plan import PlanInput
from app.schemas.replanned import ViolationReply
from app.schemas.request import PlanRequest
from app.schemas.response import WARNINGS_TEXT, CostReply, RouteReply, SummaryReply, WarningReply
from app.schemas.untimed import UntimedPlanInput


class PlannedProblem(BaseModel):
    """A problem and a plan for it."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)

    problem: PlanRequest = Field(
        description="A request of `POST /plan`; its options don't matter. With `replan`, the plan "
        "is judged as one that goes on from that given there."
    )
    plan: PlanInput = Field(description="Any plan, such as a reply of `POST /plan`, unchanged.")

    @property
    def whole_problem(self) -> PlanRequest:
        """The problem with all that is stated of it."""
        return self.problem

    def path_of(self, path: str) -> str:
        """Return where in the request something of `whole_problem` is stated."""
        return path


class CheckRequest(PlannedProblem):
    """A problem and a plan for it, with or without times."""

    plan: UntimedPlanInput = Field(
        description="Any plan, such as a reply of `POST /plan`, unchanged. Vehicles of which any "
        "time is left out have all of theirs made anew, from the order of their stops and flights.")


class CheckReply(BaseModel):
    """A judged plan."""

    model_config = ConfigDict(extra="forbid")

    feasible: bool = Field(description="Whether no rule is broken.")
    violations: list[ViolationReply] = Field(description="Every broken rule.")
    cost: CostReply = Field(
        description="True cost by term, computed anew; routes that can't be read cost nothing."
    )
    summary: SummaryReply = Field(description="The plan in numbers, computed anew.")
    routes: list[RouteReply | None] | None = Field(
        None, description="The plan's routes, computed anew, in its order; null for one that can't "
        "be read. Left out unless the plan leaves out times, or `options.lateness_risk` or "
        "`options.geometry` asks for them.")
    lateness: LatenessRiskReply | None = Field(
        None, description=f"What is to be expected of promises. {RISK_TEXT}")
    warnings: list[WarningReply] = Field([], description=WARNINGS_TEXT)
