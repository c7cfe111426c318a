"""How many areas, and corners of them, a request may hold: all are looked at before all else."""

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import msgspec
from msgspec import Raw, Struct

from app.requests.draft import Errors, error_at
from app.schemas.errors import InputError
from app.schemas.airspace import AirspaceInput, Ed269Zones, KmlZones, Zones
from app.schemas.zones.geojson import GeometryCollection, MultiPolygon, Point
from app.schemas.zones.parts import MAX_STATED

MOST_AREAS, MOST_KML_AREAS = 4000, 2000
"""Areas of a request, and polygons of KML among them, which take twice as long to read."""

MOST_CORNERS, MOST_CORNERS_OF_ONE = 50_000, 20_000
"""Corners of all areas of a request, and of one: whether a boundary crosses itself may take the
square of them."""

_COORDINATES = re.compile(r"<(?:\w+:)?coordinates[^<>]*>([^<]*)")



class _Zones(Struct):
    """A file of zones, of which nothing but its features is read."""

    data: Raw = Raw(b"")


class _Airspace(Struct):
    zones: list[_Zones] = []


class _Problem(Struct):
    airspace: _Airspace | None = None


class _Body(_Problem):
    problem: _Problem | None = None


class _Feature(Struct):
    geometry: Raw = Raw(b"")


class _Features(Struct):
    features: list[_Feature] = []


class _Parts(Struct):
    geometries: list[Raw] = []


def early_errors(body: bytes) -> Errors:
    """Say which file of zones in a body has too many areas, before anything is made of it.

    KML is a text until then. What is no JSON, or no such body, is for others to refuse.
    """
    if b'"features"' not in body:
        return
    try:
        read = msgspec.json.decode(body, type=_Body)
        problem, at = (read, ()) if read.problem is None else (read.problem, ("problem",))
        stated = [] if problem.airspace is None else problem.airspace.zones
        areas = 0
        for index, zones in enumerate(stated):
            features = _features(bytes(zones.data))
            if len(features) > MAX_STATED:
                path = (*at, "airspace", "zones", index, "data", "features")
                yield error_at("WRONG_LENGTH", path,
                               f"There are more than {MAX_STATED} entries: remove some.")
                return
            areas += sum(map(_num_areas, features))
            if areas > MOST_AREAS:
                size = _Size((*at, "airspace", "zones", index), [])
                yield _error(size, f"There are {areas} areas of the airspace", MOST_AREAS)
                return
    except (msgspec.DecodeError, RecursionError):
        return


def _features(data: bytes) -> list[_Feature]:
    return msgspec.json.decode(data, type=_Features).features if data.startswith(b"{") else []


def _num_areas(feature: _Feature) -> int:
    """Return how many areas a feature has: volumes of ED-269, or parts of one of GeoJSON."""
    geometry = bytes(feature.geometry)
    if geometry.startswith(b"["):
        return len(msgspec.json.decode(geometry, type=list[Raw]))
    if geometry.startswith(b"{"):
        return max(1, len(msgspec.json.decode(geometry, type=_Parts).geometries))
    return 0


class _Size(NamedTuple):
    """How many corners each area has; of circles one."""

    path: tuple[str | int, ...]
    corners: Sequence[int]


def size_errors(airspace: AirspaceInput) -> Errors:
    """Say which areas are too many, or have too many corners; the first that is found."""
    sizes = [_Size(("airspace", "no_fly"), [*map(len, airspace.no_fly)])]
    for index, zones in enumerate(airspace.zones):
        size = _Size(("airspace", "zones", index), [*_corners(zones)])
        sizes.append(size)
        if isinstance(zones, KmlZones) and len(size.corners) > MOST_KML_AREAS:
            yield _error(size, f"There are {len(size.corners)} shapes of KML", MOST_KML_AREAS)
            return
    areas = corners = 0
    for size in sizes:
        areas, corners = areas + len(size.corners), corners + sum(size.corners)
        if areas > MOST_AREAS:
            yield _error(size, f"There are {areas} areas of the airspace", MOST_AREAS)
        elif max(size.corners, default=0) > MOST_CORNERS_OF_ONE:
            yield _error(size, f"An area has {max(size.corners)} corners", MOST_CORNERS_OF_ONE)
        elif corners > MOST_CORNERS:
            yield _error(size, f"Areas of the airspace have {corners} corners", MOST_CORNERS)
        else:
            continue
        return


def _error(size: _Size, found: str, most: int) -> InputError:
    return error_at("WRONG_LENGTH", size.path, f"{found}, and a request may have {most}: send "
                    "those near its places, or have the service load a file for all requests "
                    "(TANDEM_AIRSPACE).")


def _corners(zones: Zones) -> Iterator[int]:
    """Yield how many corners each area has, holes included."""
    if isinstance(zones, KmlZones):
        for text in _COORDINATES.finditer(zones.data):
            # Blanks may set commas apart that stand between a corner's numbers.
            yield len(",".join(map(str.strip, text[1].split(","))).split())
    elif isinstance(zones, Ed269Zones):
        for zone in zones.data.features:
            for volume in zone.geometry:
                rings = volume.area.coordinates
                yield 1 if rings is None else sum(map(len, rings))
    else:
        for feature in zones.data.features:
            geometry = feature.geometry
            for part in (geometry.geometries if isinstance(geometry, GeometryCollection)
                         else [geometry]):
                if isinstance(part, Point):
                    yield 1
                elif isinstance(part, MultiPolygon):
                    for rings in part.coordinates:
                        yield sum(map(len, rings))
                else:
                    yield sum(map(len, part.coordinates))
