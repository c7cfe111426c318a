"""Zones in a request, in one of the formats in which they are published."""

from typing import Annotated, Any, Literal, get_args

from pydantic import Discriminator, Field, Tag

from app.schemas.fields import Input
from app.schemas.zones.ed269 import Ed269Collection
from app.schemas.zones.geojson import Ed318Collection, GeoJson

ZoneFormat = Literal["ed269", "ed318", "geojson", "kml"]

FORMATS: tuple[ZoneFormat, ...] = get_args(ZoneFormat)

MAX_KML = 64 * 2**20
"""Most characters of a text of KML."""


class Ed269Zones(Input):
    """Zones as EUROCAE ED-269 has them."""

    format: Literal["ed269"] = Field(description="How they are written.")
    data: Ed269Collection = Field(description="What the file holds, as it is.")


class Ed318Zones(Input):
    """Zones as EUROCAE ED-318 has them."""

    format: Literal["ed318"] = Field(description="How they are written.")
    data: Ed318Collection = Field(description="What the file holds, as it is.")


class GeoJsonZones(Input):
    """Areas as GeoJSON."""

    format: Literal["geojson"] = Field(description="How they are written.")
    data: GeoJson = Field(
        description="A collection, a feature or an area. Each is prohibited from the ground up, "
        "unless its properties say otherwise as those of ED-269 do."
    )


class KmlZones(Input):
    """Areas as KML."""

    format: Literal["kml"] = Field(description="How they are written.")
    data: Annotated[str, Field(min_length=1, max_length=MAX_KML)] = Field(
        description="The file's text. Each polygon is prohibited from the ground up."
    )


def _format_of(value: Any) -> str | None:
    stated = value.get("format") if isinstance(value, dict) else getattr(value, "format", None)
    return f"({stated})" if stated in FORMATS else None


Zones = Annotated[
    Annotated[Ed269Zones, Tag("(ed269)")] | Annotated[Ed318Zones, Tag("(ed318)")]
    | Annotated[GeoJsonZones, Tag("(geojson)")] | Annotated[KmlZones, Tag("(kml)")],
    Discriminator(
        _format_of, custom_error_type="UNKNOWN_VALUE",
        custom_error_message="Zones are an object with data and a format, which is one of 'ed269', "
        "'ed318', 'geojson' or 'kml': state how they are written."),
]
"""Published zones."""
