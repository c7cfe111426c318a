"""What is sent to keep a plan, and what is told of kept ones."""

from datetime import datetime
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from app.schemas.fields import Input
from app.schemas.limits import MAX_CUSTOMERS

MAX_NOTE = 10_000

TEXT = r"^[^\x00]*$"
"""Without the one character that PostgreSQL can't keep."""

PlanName = Annotated[str, Field(min_length=1, max_length=200, pattern=TEXT,
                                description="What people know the plan by; needn't be unique.")]
Note = Annotated[str, Field(max_length=MAX_NOTE, pattern=TEXT,
                            description="Whatever is to be remembered with it.")]


class _Loose(BaseModel):
    """The least by which a part is known; the rest is kept as it is."""

    model_config = ConfigDict(extra="allow", strict=True, allow_inf_nan=False)


class KeptRequest(_Loose):
    """A request of `POST /plan`, kept as it is."""

    depots: list[Any] = Field(description="As in `PlanRequest`.")
    customers: list[Any] = Field(max_length=MAX_CUSTOMERS, description="As in `PlanRequest`.")
    fleet: list[Any] = Field(description="As in `PlanRequest`.")


class KeptCost(_Loose):
    """What a kept plan costs."""

    total: float = Field(description="As in `CostReply`.")


class KeptPlan(_Loose):
    """A reply of `POST /plan`, kept as it is."""

    cost: KeptCost = Field(description="As in `PlanReply`.")
    routes: list[Any] = Field(description="As in `PlanReply`.")


class KeptPlanInput(Input):
    """A plan to be kept."""

    name: PlanName
    note: Note = ""
    request: KeptRequest | None = Field(
        None, description="A request of `POST /plan`. It is kept as it is, also with errors that "
        "its planning would be refused for: what is half done can be kept too."
    )
    plan: KeptPlan | None = Field(
        None, description="The reply that goes with it, kept as it is. Null: not planned yet."
    )
    day: Annotated[str, Field(min_length=1, max_length=64)] | None = Field(
        None, description="Id of a day, in place of `request` and `plan`: whoever reads the plan, "
        "also by a link, gets the day's problem and plan as they are then. Once the day is "
        "deleted: as they were when this was kept.")

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        """Refuse what has no content, or that of two."""
        if (self.day is None) == (self.request is None) or (self.day and self.plan):
            raise PydanticCustomError(
                "MISSING_FIELD", "What is kept is a request, with its plan if it has one, or a "
                "day: state one of them.")
        return self


class KeptPlanChange(Input):
    """A new name or note of a kept plan."""

    name: PlanName | None = Field(None, description="Null: as it is.")
    note: Note | None = Field(None, description="Null: as it is.")


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class KeptPlanSummary(_Reply):
    """A kept plan without its content. Times are UTC."""

    id: str = Field(description="Id of the plan, as its owner chose it.")
    name: str = Field(description="What people know it by.")
    note: str = Field(description="What is to be remembered with it.")
    version: str = Field(description="Another after each change; in quotes it is the `ETag`.")
    created_at: datetime = Field(description="When it was kept first.")
    changed_at: datetime = Field(description="When it was changed last.")
    expires_at: datetime | None = Field(
        description="When it is deleted unless it is changed before. Null: never."
    )
    bytes: int = Field(description="How much of the room for its owner it takes.")
    customers: int = Field(description="Customers of its request.")
    cost: float | None = Field(description="Total cost of its plan. Null: not planned yet.")
    links: int = Field(description="Links by which it is shared.")
    day: str | None = Field(description="Id of the day whose problem and plan it is as they are "
                            "now; bytes, customers and cost are those when it was kept. Null: it "
                            "is as it was kept.")


class KeptPlanReply(KeptPlanSummary):
    """A kept plan. Times are UTC."""

    request: dict[str, Any] = Field(description="The request, as it was sent.")
    plan: dict[str, Any] | None = Field(description="The plan, as it was sent.")


class KeptPlanListReply(_Reply):
    """A page of kept plans, those changed last first."""

    plans: list[KeptPlanSummary] = Field(description="Plans without their content.")
    next: str | None = Field(description="`cursor` of the next page. Null: this is the last.")


class LinkReply(_Reply):
    """A link that shows a plan to anybody who has it."""

    id: str = Field(description="Id of the link, by which it is ended; shows nothing to anybody.")
    created_at: datetime = Field(description="When it was made.")


class NewLinkReply(LinkReply):
    """A link that was just made."""

    token: str = Field(description="What shows the plan, as the header `X-Share-Token` of "
                       "`GET /shared-plan`. It can't be read again.")
    path: str = Field(description="Where the console shows the plan. The token is behind the `#`, "
                      "which browsers send to nobody.")


class LinkListReply(_Reply):
    """All links of a plan."""

    links: list[LinkReply] = Field(description="The oldest first.")


class SharedPlanReply(_Reply):
    """A plan as a link shows it."""

    name: str = Field(description="What its owner calls it.")
    note: str = Field(description="What its owner noted with it.")
    changed_at: datetime = Field(description="When it was changed last.")
    is_live: bool = Field(description="Whether it is a day's, which goes on.")
    request: dict[str, Any] = Field(description="The request, as it was sent.")
    plan: dict[str, Any] | None = Field(description="The plan, as it was sent.")
