"""How times spread around what is planned, and what that means for promises."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.fields import Input, Money
from app.schemas.times import InstantReply

MAX_SPREAD = 3.0
TRAVEL, SERVICE = 0.2, 0.3
"""Spreads where nobody states or has seen others: of a town, and of parcels handed over at doors.
"""

Share = Annotated[float, Field(ge=0, le=MAX_SPREAD)]


class SpreadInput(Input):
    """How far times are off the planned ones: their standard deviation, divided by these."""

    travel: Share = Field(TRAVEL, description="Of the duration of each leg, driven or flown.")
    service: Share = Field(SERVICE, description="Of each service.")


class LatenessRiskInput(Input):
    """That promises may be broken though the plan keeps them."""

    spread: SpreadInput = Field(
        default_factory=SpreadInput, description="How far times are off the planned ones. Each is "
        "drawn by itself, log-normally, with the planned one as mean.")
    cost_per_expected_late_hour: Money = Field(
        0.0, description="Money for each hour by which service is to be expected to begin after "
        "windows' ends, over all customers. Plans are chosen by it.")


class LatenessReply(BaseModel):
    """How late somebody is by the plan, and may be."""

    model_config = ConfigDict(extra="forbid")

    seconds: float = Field(
        description="Arrival, setup included, after the time window's end by the plan.")
    chance: float | None = Field(
        description="On which share of the days drawn service begins after the end of its window, "
        "the one of several that is planned. Null: it has no end.")
    earliest: InstantReply = Field(
        description="On a tenth of these days who comes has come by then.")
    latest: InstantReply = Field(description="On nine tenths of them.")


class LatenessRiskReply(BaseModel):
    """What is to be expected of all promises together."""

    model_config = ConfigDict(extra="forbid")

    spread: SpreadInput = Field(description="That of the request.")
    expected_hours: float = Field(
        description="Hours by which service begins late in the mean, over all customers.")


LATENESS_TEXT = ("Arrival, setup included, after the time window's end in seconds; with "
                 "`options.lateness_risk`, that and its chance.")
RISK_TEXT = "Left out unless `options.lateness_risk` asks for it."
