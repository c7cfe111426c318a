"""What answers of geocoding servers have in common."""

from collections.abc import Callable
from typing import Annotated, Generic, Literal, TypeVar

from pydantic import BaseModel, Field

from app.maps.addresses.places import AddressPlace

Longitude = Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)]
Latitude = Annotated[float, Field(ge=-90, le=90, allow_inf_nan=False)]


class Address(BaseModel):
    """What is told of a place by all."""

    housenumber: str = ""
    street: str = ""
    county: str = ""
    country: str = ""


Properties = TypeVar("Properties", bound=Address)


class AddressPoint(BaseModel):
    """Where a place is, in GeoJSON."""

    type: Literal["Point"]
    coordinates: tuple[Longitude, Latitude]


class Feature(BaseModel, Generic[Properties]):
    """A place in GeoJSON."""

    geometry: AddressPoint
    properties: Properties


class Features(BaseModel, Generic[Properties]):
    """Places in GeoJSON."""

    type: Literal["FeatureCollection"]
    features: list[Feature[Properties]]


def read_features(body: bytes, kind: type[Properties],
                  place: Callable[[float, float, Properties], AddressPlace]) -> list[AddressPlace]:
    """Return the places of an answer in GeoJSON; raises pydantic's `ValidationError`."""
    answer = Features[kind].model_validate_json(body)  # type: ignore[valid-type]
    return [place(*feature.geometry.coordinates, feature.properties)
            for feature in answer.features]
