"""Why somebody is left out, as replies say it, and what would change that."""

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.hindrances import StormReply, ZoneReply
from app.schemas.times import WordsReply


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class ChangeReply(_Reply):
    """A change of the request, in its own notation: `by` so much, or `to` a value."""

    path: str = Field(description="Where it is in the request, such as `$.fleet[0].count`.")
    by: float | None = Field(
        None, description="What is added to the number that stands there; left out beside `to`.")
    to: Any = Field(
        None, description="What is to stand there instead; left out beside `by`.")


class RemedyPartReply(_Reply):
    """What one limit would have to be."""

    code: str = Field(description="Stable name of the limit, as `SHIFT`.")
    who: str | None = Field(description="Id of whom it is about: customer, shipment or an end of "
                            "it, vehicle type, drones, depot, break. Null: the whole request.")
    changes: list[ChangeReply] = Field(
        description="As changes of the request; none where it has no place for them.")
    suffices: bool = Field(
        description="Whether a vehicle of the type keeps all rules then, as was tried.")
    text: WordsReply = Field(description="The same in words.")


class RemedyReply(RemedyPartReply):
    """What would change that somebody is left out; `SEVERAL` is the code of several limits."""

    parts: list[RemedyPartReply] = Field(
        [], description="Of `SEVERAL`: one by one. Left out of others.")


class ReasonReply(_Reply):
    """Why vehicles of one type don't serve a customer."""

    vehicle_type: str = Field(description="Id of the vehicle type.")
    code: str = Field(description="Stable name of the reason.")
    message: WordsReply = Field(description="The reason in words.")
    remedy: WordsReply | None = Field(
        description="A change that would suffice. Null: none is known.")
    changes: list[ChangeReply] = Field(
        description="The same as changes of the request, which together suffice.")
    other_remedy: str | None = Field(
        None, description="Another change that would suffice; left out where none is known.")
    other_changes: list[ChangeReply] | None = Field(
        None, description="The same as changes; left out where none is known.")
    remedies: list[RemedyReply] = Field(
        description="All that is known to help, each by itself; these two are the first of it.")
    zone: ZoneReply | None = Field(
        None, description="Of `AIRSPACE`: the zone; left out for other reasons.")
    wind: list[StormReply] | None = Field(
        None, description="When it blows too much; left out for reasons that it doesn't matter to.")
