"""Requests with more areas of the airspace than are looked at."""

import json
import time
from typing import Any

import pytest

from app.requests.airspace_size import (
    MOST_AREAS, MOST_CORNERS_OF_ONE, MOST_KML_AREAS, size_errors,
)
from app.requests.reading import read_request
from app.schemas.airspace import AirspaceInput
from app.schemas.errors import InvalidRequestError
from app.schemas.zones.parts import MAX_STATED

Data = dict[str, Any]
Ring = list[list[float]]
RING: Ring = [[9.0, 48.0], [9.001, 48.0], [9.0, 48.001], [9.0, 48.0]]


def long_ring(corners: int) -> Ring:
    """Return a comb, whose every second corner is far from the others."""
    return [[9 + 1e-6 * index, 48 + 0.01 * (index % 2)] for index in range(corners)]


def polygons(rings: list[Ring]) -> list[Data]:
    """Return areas of GeoJSON."""
    return [{"type": "Polygon", "coordinates": [ring]} for ring in rings]


def of_geojson(shapes: list[Data]) -> Data:
    """Return zones as GeoJSON."""
    return {"format": "geojson", "data": {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": shape} for shape in shapes]}}


def of_ed318(shapes: list[Data]) -> Data:
    """Return zones as ED-318, a hundred areas each."""
    return {"format": "ed318", "data": {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"identifier": str(begin), "type": "PROHIBITED"},
         "geometry": {"type": "GeometryCollection", "geometries": shapes[begin:begin + 100]}}
        for begin in range(0, len(shapes), 100)]}}


def of_ed269(projections: list[Data]) -> Data:
    """Return zones as ED-269."""
    return {"format": "ed269", "data": {"features": [
        {"identifier": str(number), "restriction": "PROHIBITED", "geometry": [
            {"horizontalProjection": each}]} for number, each in enumerate(projections)]}}


def of_kml(rings: list[Ring]) -> Data:
    """Return zones as KML."""
    marks = "".join("<Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>"
                    f"{' '.join(f'{x},{y}' for x, y in ring)}</coordinates></LinearRing>"
                    "</outerBoundaryIs></Polygon></Placemark>" for ring in rings)
    return {"format": "kml", "data": '<kml xmlns="http://www.opengis.net/kml/2.2"><Document>'
            f"{marks}</Document></kml>"}


CIRCLE = {"type": "Circle", "center": [9.0, 48.0], "radius": 50}
POINT = {"type": "Point", "coordinates": [9.0, 48.0],
         "extent": {"subType": "Circle", "radius": 50}}
LONG = long_ring(MOST_CORNERS_OF_ONE + 1)

TOO_LARGE = {
    "no_fly, corners": ({"no_fly": [LONG]}, "no_fly"),
    "no_fly, corners of all": ({"no_fly": [long_ring(15_000)] * 4}, "no_fly"),
    "no_fly, areas": ({"no_fly": [RING] * (MOST_AREAS + 1)}, "no_fly"),
    "geojson, areas": ({"zones": [of_geojson(polygons([RING] * (MOST_AREAS + 1)))]}, "zones[0]"),
    "geojson, corners": ({"zones": [of_geojson(polygons([LONG]))]}, "zones[0]"),
    "ed318, circles": ({"zones": [of_ed318([POINT] * (MOST_AREAS + 1))]}, "zones[0]"),
    "ed269, circles": ({"zones": [of_ed269([CIRCLE] * (MOST_AREAS + 1))]}, "zones[0]"),
    "ed269, circles of files": ({"zones": [of_ed269([CIRCLE] * MAX_STATED)] * 10}, "zones[0]"),
    "ed318, circles of files": ({"zones": [of_ed318([POINT] * 3000)] * 10}, "zones[1]"),
    "ed269, corners": ({"zones": [of_ed269(polygons([LONG]))]}, "zones[0]"),
    "kml, areas": ({"zones": [of_kml([RING] * (MOST_KML_AREAS + 1))]}, "zones[0]"),
    "kml, corners": ({"zones": [of_kml([LONG])]}, "zones[0]"),
    "several": ({"zones": [of_ed269([CIRCLE] * 3000), of_geojson(polygons([RING] * 3000))]},
                "zones[1]"),
    "features": ({"zones": [of_ed269([CIRCLE] * (MAX_STATED + 1))]}, "zones[0].data.features"),
}


def refused(airspace: Data) -> list[tuple[str, str]]:
    """Return codes and paths of what is wrong with a request with an airspace."""
    body = {"coordinate_system": "geographic", "depots": [{"id": "d", "location": [9, 48]}],
            "customers": [{"id": "c", "location": [9.1, 48], "demand": [1]}],
            "fleet": [{"id": "t", "count": 1, "capacity": [1]}], "airspace": airspace}
    with pytest.raises(InvalidRequestError) as error:
        read_request(json.dumps(body).encode(), None)
    return [(each.code, each.path) for each in error.value.errors]


@pytest.mark.parametrize("kind", TOO_LARGE)
def test_too_many_areas_or_corners_are_refused_before_they_are_made(kind: str) -> None:
    airspace, where = TOO_LARGE[kind]
    began = time.process_time()
    assert refused(airspace) == [("WRONG_LENGTH", f"$.airspace.{where}")]
    assert time.process_time() - began < 2


def test_zones_are_counted_before_anything_is_made_of_them(
        monkeypatch: pytest.MonkeyPatch) -> None:
    def read(*_: Any) -> None:
        raise AssertionError("it was read")

    monkeypatch.setattr("app.requests.refusal.read_shape", read)
    monkeypatch.setattr("app.requests.reading.read_body", read)
    for kind in ("ed269, circles of files", "ed318, circles of files", "geojson, areas",
                 "features"):
        airspace, where = TOO_LARGE[kind]
        assert refused(airspace) == [("WRONG_LENGTH", f"$.airspace.{where}")]


def test_corners_of_kml_are_counted_whatever_sets_their_numbers_apart() -> None:
    pytest.importorskip("fastkml")
    ring = [[9 + 1e-6 * index, 48 + 0.01 * (index % 2)] for index in range(9_000)]
    text = of_kml([ring])["data"]
    zones = {"format": "kml", "data": text.replace(",", " ,\n ")}
    assert [*size_errors(AirspaceInput.model_validate({"zones": [zones]}))] == []


WILD = {
    "tags without an end": "<coordinates " * 20_000,
    "roots without an end": "<kml " * 20_000 + " xmlns=",
    "blanks": f"<kml><coordinates>9{' ' * 200_000}</coordinates></kml>",
    "blanks beside commas": f"<kml><coordinates>9{' , ' * 10_000}</coordinates></kml>",
    "digits": f"<kml><coordinates>{'1' * 100_000}</coordinates></kml>",
}


@pytest.mark.parametrize("kind", WILD)
def test_wild_kml_takes_no_longer_than_its_length(kind: str) -> None:
    pytest.importorskip("fastkml")
    began = time.process_time()
    refused({"zones": [{"format": "kml", "data": WILD[kind]}]})
    assert time.process_time() - began < 2
