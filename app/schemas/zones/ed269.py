"""Zones after EUROCAE ED-269 (2020), minimum operational performance standard for geofencing."""

from typing import Annotated, Literal

from pydantic import Field

from app.schemas.zones.parts import (
    LISTED, MAX_PARTS, Authorities, Corner, Limits, Number, Periods, Published, Restriction,
    Rings, Words,
)


class Projection(Published):
    """The area of a volume."""

    type: Literal["Polygon", "Circle"] = Field(description="Its kind.")
    coordinates: Rings | None = Field(None, description="Corners, longitude first, ring by ring.")
    center: Corner | None = Field(None, description="Longitude and latitude of a circle.")
    radius: Annotated[Number, Field(gt=0)] | None = Field(None, description="Metres.")


class AirspaceVolume(Limits):
    """An area from one height to another."""

    area: Projection = Field(alias="horizontalProjection", description="Its area.")


class UasZone(Published):
    """A zone: one or several volumes."""

    identifier: Words = Field(None, description="What the authority calls it.")
    country: Words = Field(None, description="Its country.")
    name: Words = Field(None, description="Its name, in one language or several.")
    restriction: Restriction = Field(description="What it asks for.")
    message: Words = Field(None, description="What the authority says of it.")
    applicability: Periods = Field((), description="When it applies. None: always.")
    authorities: Authorities = Field((), alias="zoneAuthority", description="Who decides.")
    geometry: Annotated[
        list[AirspaceVolume], Field(min_length=1, max_length=MAX_PARTS, fail_fast=True)
    ] = Field(description="Its volumes.")


class Ed269Collection(Published):
    """A file of zones."""

    features: Annotated[list[UasZone], LISTED] = Field(
        description="The zones."
    )
