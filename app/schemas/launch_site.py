"""A place where trucks stop for their drones alone."""

from pydantic import Field

from app.schemas.customer import VehiclesInput
from app.schemas.fields import (
    LOCATION_INDEX_TEXT, LOCATION_TEXT, Input, Instant, LocationIndex, Money, Name, Opening,
    PlaceLocation,
)


class SiteWindowInput(Input):
    """When a truck may come to a launch site; both ends belong to the window."""

    earliest: Opening = Field(
        0.0,
        description="In seconds since plan start: whoever comes before waits, and no drone takes "
        "off or is recovered there until then.",
    )
    latest: Instant | None = Field(
        None, description="Latest arrival in seconds since plan start. Null: no limit."
    )


class HoursInput(Input):
    """When a depot is open; both ends belong to it."""

    earliest: Opening = Field(
        0.0, description="First departure and return in seconds since plan start."
    )
    latest: Instant | None = Field(
        None, description="Last departure and return in seconds since plan start. Null: no limit."
    )


class LaunchSiteInput(Input):
    """A place nobody ordered to, where a truck may stop for its drones alone."""

    id: Name = Field(description="Name of the launch site, unique among them.")
    location: PlaceLocation | None = Field(None, description=LOCATION_TEXT)
    location_index: LocationIndex | None = Field(None, description=LOCATION_INDEX_TEXT)
    time_window: SiteWindowInput = Field(
        SiteWindowInput(), description="When trucks may come. Default: at any time."
    )
    vehicles: VehiclesInput | None = Field(
        None, description="Vehicles that may stop there. Null: all that carry drones."
    )
    cost: Money = Field(0.0, description="Cost of each stop there, among those of `stops`.")
