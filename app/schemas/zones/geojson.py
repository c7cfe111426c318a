"""GeoJSON (RFC 7946): plain, and with the layers of EUROCAE ED-318 (2023)."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag

from app.schemas.zones.parts import (
    LISTED, MAX_PARTS, Authorities, Corner, Limits, Number, Periods, Published, Restriction,
    Rings, Unit, VerticalReference, Words,
)


class Layer(Published):
    """From which height to which an area reaches."""

    unit: Unit = Field("M", alias="uom", description="What heights are in: metres or feet.")
    lower: Number | None = Field(
        None, description="From which height. Left out or 99999: unknown or none."
    )
    lower_reference: VerticalReference | None = Field(
        None, alias="lowerReference", description="What that counts from."
    )
    upper: Number | None = Field(
        None, description="To which height. Left out or 99999: unknown or none."
    )
    upper_reference: VerticalReference | None = Field(
        None, alias="upperReference", description="What that counts from."
    )


class Extent(Published):
    """A circle around a point."""

    sub_type: Literal["Circle"] = Field(alias="subType", description="Its kind.")
    radius: Annotated[Number, Field(gt=0)] = Field(description="Metres.")


class Polygon(Published):
    """An area: a ring around it, and rings around its holes."""

    type: Literal["Polygon"] = Field(description="Its kind.")
    coordinates: Rings = Field(description="Corners, longitude first, ring by ring.")
    layer: Layer | None = Field(None, description="From which height to which. Null: unknown.")


class MultiPolygon(Published):
    """Several areas."""

    type: Literal["MultiPolygon"] = Field(description="Its kind.")
    coordinates: Annotated[list[Rings], Field(max_length=MAX_PARTS, fail_fast=True)] = Field(
        description="Corners, longitude first, ring by ring."
    )
    layer: Layer | None = Field(None, description="From which height to which. Null: unknown.")


class Point(Published):
    """The centre of a circle."""

    type: Literal["Point"] = Field(description="Its kind.")
    coordinates: Corner = Field(description="Corners, longitude first, ring by ring.")
    extent: Extent = Field(description="How large the circle is.")
    layer: Layer | None = Field(None, description="From which height to which. Null: unknown.")


def _type_of(value: Any) -> str:
    stated = value.get("type") if isinstance(value, dict) else getattr(value, "type", None)
    return f"({stated})" if stated in ("MultiPolygon", "Point", "GeometryCollection") else (
        "(Polygon)")


Area = Annotated[
    Annotated[Polygon, Tag("(Polygon)")] | Annotated[MultiPolygon, Tag("(MultiPolygon)")]
    | Annotated[Point, Tag("(Point)")],
    Discriminator(_type_of),
]


class GeometryCollection(Published):
    """Areas, each with a layer of its own."""

    type: Literal["GeometryCollection"] = Field(description="Its kind.")
    geometries: Annotated[list[Area], Field(max_length=MAX_PARTS, fail_fast=True)] = Field(
        description="Areas."
    )
    layer: Layer | None = Field(None, description="From which height to which. Null: unknown.")


Geometry = Annotated[
    Annotated[Polygon, Tag("(Polygon)")] | Annotated[MultiPolygon, Tag("(MultiPolygon)")]
    | Annotated[Point, Tag("(Point)")]
    | Annotated[GeometryCollection, Tag("(GeometryCollection)")],
    Discriminator(_type_of),
]


class Ed318Properties(Published):
    """What is known of a zone."""

    identifier: Words = Field(None, description="What the authority calls it.")
    country: Words = Field(None, description="Its country.")
    name: Words = Field(None, description="Its name, in one language or several.")
    restriction: Restriction = Field(alias="type", description="What it asks for.")
    message: Words = Field(None, description="What the authority says of it.")
    applicability: Periods = Field(
        (), alias="limitedApplicability", description="When it applies. None: always."
    )
    authorities: Authorities = Field((), alias="zoneAuthority", description="Who decides.")


class Ed318Feature(Published):
    """A zone: one or several layers."""

    properties: Ed318Properties = Field(description="What is known of it.")
    geometry: Geometry = Field(description="Its volumes.")


class Ed318Collection(Published):
    """A file of zones."""

    features: Annotated[list[Ed318Feature], LISTED] = Field(
        description="The zones."
    )


class PlainProperties(Limits):
    """What an area may state; fields are called as in ED-269."""

    identifier: Words = Field(None, description="What the authority calls it.")
    country: Words = Field(None, description="Its country.")
    name: Words = Field(None, description="Its name, in one language or several.")
    restriction: Restriction = Field("PROHIBITED", description="What it asks for.")
    message: Words = Field(None, description="What the authority says of it.")
    applicability: Periods = Field((), description="When it applies. None: always.")
    authorities: Authorities = Field((), alias="zoneAuthority", description="Who decides.")


class PlainFeature(Published):
    """An area and what is known of it."""

    type: Literal["Feature"] = Field(description="Its kind.")
    id: Words = Field(None, description="What it is called.")
    properties: PlainProperties | None = Field(None, description="What is known of it.")
    geometry: Geometry = Field(description="Its volumes.")


def _as_features(value: Any) -> Any:
    """Return a collection also of an area, or a feature, that stands alone."""
    if not isinstance(value, dict) or value.get("type") == "FeatureCollection":
        return value
    feature = value if value.get("type") == "Feature" else {"type": "Feature", "geometry": value}
    return {"type": "FeatureCollection", "features": [feature]}


class PlainCollection(Published):
    """Areas."""

    type: Literal["FeatureCollection"] = Field(description="Its kind.")
    features: Annotated[list[PlainFeature], LISTED] = Field(
        description="The zones."
    )


class GeoJsonObject(Published):
    """A collection, a feature or an area."""

    type: str = Field(description="Its kind.")
    features: Annotated[list[PlainFeature], LISTED] | None = Field(
        None, description="The areas of a collection."
    )
    properties: PlainProperties | None = Field(None, description="Those of a feature.")
    geometry: Geometry | None = Field(None, description="That of a feature.")
    coordinates: Any = Field(None, description="The corners of an area.")
    geometries: Any = Field(None, description="The areas of a collection of geometries.")


GeoJson = Annotated[PlainCollection, BeforeValidator(
    _as_features, json_schema_input_type=GeoJsonObject)]
"""A collection, a feature or an area."""
