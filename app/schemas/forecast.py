"""Orders that may come: with them a plan knows what must go now, and what may wait."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.customer import CustomerInput
from app.schemas.fields import Duration, Input, Instant
from app.schemas.times import InstantReply, WordsReply

MAX_PAST_ORDERS = 2_000
"""Orders of all past days, and those that rates are like."""


class PastOrderInput(CustomerInput):
    """An order of a past day, in times since that day's start; `id`, `alternatives`,
    `vehicles` and `vehicle_costs` count not.
    """

    placed_at: Instant = Field(0.0, description="When it was placed, in seconds since its day's "
                               "plan start.")


class RateInput(Input):
    """How often orders come, in an area and part of the day."""

    since: Instant = Field(description="From when on, in seconds since plan start.")
    until: Instant = Field(description="Until when.")
    per_hour: Annotated[float, Field(gt=0, le=10_000)] = Field(
        description="Orders placed in an hour, on the mean.")
    like: Annotated[list[PastOrderInput], Field(min_length=1, max_length=MAX_PAST_ORDERS)] = Field(
        description="Each is like one of these, whose windows and `release_time` are in seconds "
        "since it is placed.")


class ComingInput(Input):
    """What may come, and when vehicles leave."""

    every: Annotated[Duration, Field(ge=60)] = Field(
        3600.0, description="Seconds between departures, counted from plan start. Who waits does "
        "so until the next.")
    look_ahead: int = Field(
        2, ge=1, le=8, description="Departures after now that are looked ahead at.")
    past_days: Annotated[list[Annotated[list[PastOrderInput], Field(
        max_length=MAX_PAST_ORDERS)]], Field(max_length=366)] = Field(
        [], description="Orders of past days, one of which may come again.")
    rates: Annotated[list[RateInput], Field(max_length=1000)] = Field(
        [], description="How often orders come. Counts where there are no past days; without both, "
        "orders leave as late as is safe.")

    def orders(self) -> list[PastOrderInput]:
        """Return all orders: of past days, then those that rates are like."""
        return [order for orders in (*self.past_days, *(rate.like for rate in self.rates))
                for order in orders]


class OutlookReply(BaseModel):
    """Whether an order leaves now, and why."""

    model_config = ConfigDict(extra="forbid")

    id: str = Field(description="Id of the customer.")
    leaves: bool = Field(description="Whether its trip begins before the next departure.")
    must: bool = Field(description="Whether no later departure serves it in time.")
    futures: int = Field(description="Futures that were looked at; 0: none is forecast.")
    later_in: int = Field(description="In how many of them it leaves later.")
    departure: InstantReply | None = Field(
        description="With which departure it leaves in most of these. Null: in none.")
    saved: float | None = Field(
        description="What is saved by what is decided, on the mean. Null: not known.")
    text: WordsReply = Field(description="The same in words.")
