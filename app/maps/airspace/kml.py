"""Areas of KML, read by fastkml, an optional package."""

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

Corners = list[tuple[float, float]]

NAMESPACE = "http://www.opengis.net/kml/2.2"

_OLDER = re.compile(r"http://(?:earth\.google\.com|www\.opengis\.net)/kml/2\.\d")
_ROOT = re.compile(r"<kml(?=[\s>])(?![^<>]*\sxmlns=)")
_POLYGON = re.compile(r"<(?:\w+:)?Polygon[\s>]")
_COORDINATES = re.compile(r"(<(?:\w+:)?coordinates(?:\s[^<>]*)?>)([^<]*)")
_NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
_CORNER = re.compile(rf"({_NUMBER},{_NUMBER})(?:,{_NUMBER})?")

HOW_TO_INSTALL = ("KML is read by fastkml, which is not installed: install tandem-planner[geo], or "
                  "send GeoJSON")


class KmlError(ValueError):
    """KML can't be read."""


class KmlArea(NamedTuple):
    """A place mark with polygons, each a ring and those of its holes."""

    name: str | None
    identifier: str | None
    polygons: list[list[Corners]]

    @property
    def title(self) -> str:
        """What it is called."""
        return self.name or self.identifier or "A place mark without a name"


def kml_areas(text: str) -> list[KmlArea]:
    """Return the place marks that have polygons.

    Raises
    ------
    KmlError
        If the text is no KML, or nothing is installed to read it.
    """
    try:
        from fastkml import KML
        from fastkml.features import Placemark
        from fastkml.utils import find_all
    except ImportError as error:
        raise KmlError(f"{HOW_TO_INSTALL}.") from error
    # Entities make gigabytes of little text.
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise KmlError("KML has no DOCTYPE and no entities: leave them out.")
    try:
        document = KML.from_string(_COORDINATES.sub(_plain, _in_today_s_words(text)), strict=False)
        marks: list[Any] = list(find_all(document, of_type=Placemark))
    except SyntaxError as error:
        raise KmlError(f"It is no KML that can be read ({error}).") from error
    except (ValueError, TypeError, AttributeError) as error:
        if isinstance(error, KmlError):
            raise
        raise KmlError("It is no KML that can be read: it has fields with values that KML doesn't "
                       "know.") from error
    areas = [KmlArea(mark.name, mark.id or None, polygons) for mark in marks
             if (polygons := list(_polygons(mark.geometry)))]
    stated, found = len(_POLYGON.findall(text)), sum(len(area.polygons) for area in areas)
    # What the reader passes over would be flown through.
    if found < stated:
        raise KmlError(f"Of {stated} polygons {stated - found} can't be read: coordinates are "
                       "longitude,latitude with spaces between them, and each polygon is in a "
                       "Placemark.")
    if not areas:
        raise KmlError("There is no polygon in it: is it KML, with Placemarks that have polygons?")
    return areas


def _plain(coordinates: re.Match[str]) -> str:
    """Return coordinates without heights, which the reader wants of all corners or none."""
    corners = []
    for stated in ",".join(map(str.strip, coordinates[2].split(","))).split():
        corner = _CORNER.fullmatch(stated)
        if corner is None:
            raise KmlError(f"{stated[:60]!r} is no corner: write longitude,latitude with a comma "
                           "between the two, and spaces between corners.")
        corners.append(corner[1])
    return coordinates[1] + " ".join(corners)


def _in_today_s_words(text: str) -> str:
    """Return KML in the namespace of version 2.2, without byte order mark and XML declaration."""
    stripped = text.lstrip("\ufeff \t\r\n")
    if stripped.startswith("<?xml"):
        stripped = stripped.partition("?>")[2]
    return _ROOT.sub(f'<kml xmlns="{NAMESPACE}"', _OLDER.sub(NAMESPACE, stripped), count=1)


def _polygons(geometry: Any) -> Iterator[list[Corners]]:
    if geometry is None:
        return
    if geometry.geom_type == "Polygon":
        rings = (geometry.exterior, *geometry.interiors)
        yield [[(float(corner[0]), float(corner[1])) for corner in ring.coords] for ring in rings]
    elif hasattr(geometry, "geoms"):
        for part in geometry.geoms:
            yield from _polygons(part)
