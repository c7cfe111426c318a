"""What is left of what a depot has for vehicles that fly."""

from pydantic import BaseModel, ConfigDict, Field


class HubReply(BaseModel):
    """What vehicles that fly leave of what a depot has for them."""

    model_config = ConfigDict(extra="forbid")

    depot: str = Field(description="Id of the depot.")
    batteries_left: int | None = Field(description="Charged batteries. Null: enough.")
    chargers_left: int | None = Field(description="Places to charge. Null: enough.")
