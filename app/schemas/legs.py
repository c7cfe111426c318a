"""What a plan's legs are made of, as a client gets it back."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.fields import Avoided


class LegsReply(BaseModel):
    """What the legs of a profile are made of."""

    model_config = ConfigDict(extra="forbid")

    profile: str = Field(description="`profile` of vehicle types, or of drones.")
    by: Literal["matrix", "roads", "great_circle", "straight", "flight"] = Field(
        description="The request's `matrix`, the service's `roads`, the `great_circle` between "
        "geographic locations, the `straight` line between planar ones, or a drone's `flight`."
    )
    avoid: list[Avoided] = Field(
        description="What vehicle types with these legs keep off, in order of the alphabet.")
    engine: str | None = Field(description="What the roads were asked of, such as `osrm`.")
    estimated: int = Field(
        description="Legs that no road tells, and so are great circles times `detour`."
    )
    detour: float | None = Field(description="As the request states it, if any are estimated.")
    farthest_from_road_m: float | None = Field(
        description="Most metres between a place on the roads and the road."
    )
    note: str | None = Field(description="What to know of these legs, in words.")
