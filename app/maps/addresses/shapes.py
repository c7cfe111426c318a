"""What answers of geocoding servers have in common."""

from typing import Annotated, Generic, Literal, TypeVar

from pydantic import BaseModel, Field

Longitude = Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)]
Latitude = Annotated[float, Field(ge=-90, le=90, allow_inf_nan=False)]

Properties = TypeVar("Properties", bound=BaseModel)


class Point(BaseModel):
    """Where a place is, in GeoJSON."""

    type: Literal["Point"]
    coordinates: tuple[Longitude, Latitude]


class Feature(BaseModel, Generic[Properties]):
    """A place in GeoJSON."""

    geometry: Point
    properties: Properties


class Features(BaseModel, Generic[Properties]):
    """Places in GeoJSON."""

    type: Literal["FeatureCollection"]
    features: list[Feature[Properties]]
