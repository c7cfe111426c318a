"""What a reply says of what keeps drones from a customer: published zones, and the wind."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.schemas.times import InstantReply


class _Reply(BaseModel):
    model_config = ConfigDict(extra="forbid")


class AirspaceReply(_Reply):
    """What flights keep to."""

    buffer: float = Field(description="Metres that they keep from areas and zones.")


class HeightReply(_Reply):
    """A height, as it was published."""

    value: float = Field(description="The number.")
    unit: Literal["M", "FT"] = Field(description="Metres or feet.")
    reference: Literal["AGL", "AMSL", "WGS84"] = Field(
        description="Above the ground, the sea or the ellipsoid.")


class ClosedReply(_Reply):
    """When a zone is closed to flights."""

    begin: InstantReply = Field(description="From when.")
    end: InstantReply | None = Field(description="Until when. Null: ever after.")


class ZoneReply(_Reply):
    """A volume of a published zone, which keeps drones from a customer."""

    holds: Literal["customer", "depot", "way"] = Field(
        description="What lies in it: the customer, the depot, or all ways between them.")
    name: str | None = Field(description="Its name. Null: none is published.")
    identifier: str | None = Field(description="What its authority calls it. Null: nothing.")
    restriction: Literal["PROHIBITED", "REQ_AUTHORISATION", "CONDITIONAL"] = Field(
        description="What it asks for.")
    lower: HeightReply | None = Field(description="From which height. Null: none is stated.")
    upper: HeightReply | None = Field(description="To which height. Null: none, or all.")
    authority: str | None = Field(description="Who decides, and where to ask. Null: not stated.")
    metres: float | None = Field(
        None, description="How far it lies from the zone, where `buffer` alone holds it; left out "
        "in the zone, so the next.")
    buffer: float | None = Field(None, description="`airspace.buffer`, which flights keep.")
    times: list[ClosedReply] | None = Field(
        None, description="When it is closed to flights; left out where it always is.")
    message: str = Field(description="All of it in words.")


class StormReply(_Reply):
    """When it blows too much for drones to fly, on the shift of a vehicle type."""

    vehicle_type: str = Field(description="Id of the vehicle type.")
    drone_type: str | None = Field(description="Id of its drones' type. Null: it has none.")
    max_wind_kmh: float = Field(description="Strongest wind or gusts to fly in.")
    strongest_kmh: float = Field(description="Strongest of that time.")
    begin: InstantReply = Field(description="From when.")
    end: InstantReply | None = Field(description="Until when. Null: ever after.")
