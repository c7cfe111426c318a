"""What depots have for vehicles that fly: what is left of it, and who is charged when."""

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.times import InstantReply


class HubReply(BaseModel):
    """What vehicles that fly leave of what a depot has for them."""

    model_config = ConfigDict(extra="forbid")

    depot: str = Field(description="Id of the depot.")
    batteries_left: int | None = Field(description="Charged batteries. Null: enough.")
    chargers_left: int | None = Field(
        description="Places to charge that are never needed. Null: enough.")


class ChargingReply(BaseModel):
    """From when until when a vehicle that flies is charged."""

    model_config = ConfigDict(extra="forbid")

    start: InstantReply = Field(description="It is plugged in.")
    end: InstantReply = Field(description="It is unplugged.")
