"""The volumes of zones, by the format in which they are written."""

from collections.abc import Callable, Iterator
from functools import partial

from app.maps.airspace.faults import Path, Reading
from app.maps.airspace.kml import KmlArea
from app.maps.airspace.masks import Piece
from app.maps.airspace.shapes import ShapeError, areas_of, circle_of
from app.maps.airspace.zone import Reference, Unit, Volume, ZoneHeight
from app.schemas.zones.ed269 import Projection, UasZone
from app.schemas.zones.geojson import (
    Ed318Feature, GeometryCollection, Layer, MultiPolygon, PlainFeature, PlainProperties, Point,
    Polygon,
)
from app.schemas.zones.parts import UNLIMITED

Made = tuple[Path, Callable[[], list[Piece]]]


def ed269_volumes(zone: UasZone, path: Path, reading: Reading) -> Iterator[Volume]:
    """Yield the volumes of a zone of ED-269; note in `reading` which can't be read."""
    for number, volume in enumerate(zone.geometry):
        place = (*path, "geometry", number, "horizontalProjection")
        for piece in reading.areas(place, partial(_projected, volume.area)):
            yield Volume(piece.area, _limit(volume.lower, volume.unit, volume.lower_reference),
                         _limit(volume.upper, volume.unit, volume.upper_reference),
                         piece.is_far)


def _projected(area: Projection) -> list[Piece]:
    if area.type == "Circle":
        if area.center is None or area.radius is None:
            raise ShapeError("A circle needs its center and its radius: add them.")
        # In metres whatever the unit of heights is: the larger circle of the two.
        return circle_of(area.center, area.radius)
    if area.coordinates is None:
        raise ShapeError("A polygon needs its coordinates: add them.")
    return areas_of(area.coordinates)


def geojson_volumes(feature: Ed318Feature | PlainFeature, path: Path,
                    reading: Reading) -> Iterator[Volume]:
    """Yield the volumes of a feature of GeoJSON; note in `reading` which can't be read."""
    geometry, stated = feature.geometry, feature.properties
    usual = stated if isinstance(stated, PlainProperties) else None
    for inner, part in _parts(geometry):
        layer = part.layer or geometry.layer or usual
        for place, make in _areas(part, (*path, "geometry", *inner)):
            for piece in reading.areas(place, make):
                yield _layered(piece, layer)


def _parts(geometry: Polygon | MultiPolygon | Point | GeometryCollection
           ) -> Iterator[tuple[Path, Polygon | MultiPolygon | Point]]:
    if not isinstance(geometry, GeometryCollection):
        yield (), geometry
        return
    for number, part in enumerate(geometry.geometries):
        yield ("geometries", number), part


def _areas(part: Polygon | MultiPolygon | Point, path: Path) -> Iterator[Made]:
    inner: Path = (*path, "coordinates")
    if isinstance(part, Point):
        yield path, partial(circle_of, part.coordinates, part.extent.radius)
    elif isinstance(part, Polygon):
        yield inner, partial(areas_of, part.coordinates)
    else:
        for number, rings in enumerate(part.coordinates):
            yield (*inner, number), partial(areas_of, rings)


def kml_volumes(mark: KmlArea, reading: Reading) -> Iterator[Volume]:
    """Yield the volumes of a place mark of KML; note in `reading` which can't be read."""
    for rings in mark.polygons:
        for area, is_far in reading.areas((), partial(_named, mark, rings)):
            yield Volume(area, is_far=is_far)


def _named(mark: KmlArea, rings: list[list[tuple[float, float]]]) -> list[Piece]:
    try:
        return areas_of(rings)
    except ShapeError as error:
        raise ShapeError(f"{mark.title}: {error}") from error


def _layered(piece: Piece, layer: Layer | PlainProperties | None) -> Volume:
    if layer is None:
        return Volume(piece.area, is_far=piece.is_far)
    return Volume(piece.area, _limit(layer.lower, layer.unit, layer.lower_reference),
                  _limit(layer.upper, layer.unit, layer.upper_reference),
                         piece.is_far)


def _limit(value: float | None, unit: Unit, reference: Reference | None) -> ZoneHeight | None:
    """Return a limit; None if none is stated, nor what it counts from."""
    if value is None or reference is None or abs(value) >= UNLIMITED:
        return None
    return ZoneHeight(value, unit, reference)
