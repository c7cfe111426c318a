"""The airspace of a request: areas, zones in the formats in which they are published, and wind."""

from typing import Annotated, Any, Literal, get_args

from pydantic import Discriminator, Field, Tag

from app.schemas.fields import Input, Location, Name
from app.schemas.wind import Wind, WindInput
from app.schemas.zones.ed269 import Ed269Collection
from app.schemas.zones.geojson import Ed318Collection, GeoJson

ZoneFormat = Literal["ed269", "ed318", "geojson", "kml"]

FORMATS: tuple[ZoneFormat, ...] = get_args(ZoneFormat)

MAX_NO_FLY = 10_000
MAX_POLYGON_POINTS = 100_000
MAX_BUFFER_M = 10_000.0

MAX_ZONE_FILES = 100
MAX_CLEARED = 10_000

Height = Annotated[float, Field(ge=-500, le=9000)]

Polygon = Annotated[list[Location], Field(min_length=3, max_length=MAX_POLYGON_POINTS)]

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


class GroundHeightInput(Input):
    """Between which heights the ground lies."""

    lowest: Height = Field(description="Metres above the sea of the lowest ground.")
    highest: Height = Field(description="Metres above the sea of the highest ground.")


class AirspaceInput(Input):
    """What changes flights that are computed from locations."""

    no_fly: Annotated[list[Polygon], Field(max_length=MAX_NO_FLY)] = Field(
        [],
        description="Polygons that drones fly around, each a list of at least three corners in the "
        "coordinates of `location`.",
    )
    buffer: Annotated[float, Field(ge=0, le=MAX_BUFFER_M)] = Field(
        0.0,
        description="Distance in metres that flights keep from `no_fly` areas and from zones that "
        "block, take-offs and landings among them.",
    )
    zones: Annotated[list[Zones], Field(max_length=MAX_ZONE_FILES)] = Field(
        [],
        description="Zones as authorities publish them, beside `no_fly`, for geographic locations. "
        "One that is in force during the plan and reaches the drones' `altitude` is flown around, "
        "if it is prohibited or asks for an authorisation, or is conditional.",
    )
    cleared: Annotated[list[Name], Field(max_length=MAX_CLEARED)] = Field(
        [], description="Identifiers of zones that don't block, such as those one has leave for."
    )
    conditional: Literal["block", "allow"] = Field(
        "block", description="Whether zones that are conditional block flights."
    )
    ground: GroundHeightInput | None = Field(
        None,
        description="Between which heights above the sea the ground lies that drones fly over, so "
        "that limits above the sea can be compared with `altitude`. Null: unknown, and such a zone "
        "blocks unless it lies above any ground there is.",
    )
    wind: Wind = Field(
        WindInput(),
        description="Wind, the same everywhere: always, or by the hour in a list, or as "
        "`open_meteo` tells it.",
    )
