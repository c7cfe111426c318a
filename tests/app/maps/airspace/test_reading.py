"""Zones as they are read from each format, and what can't be read, in words."""

from typing import Any

import pytest
import shapely
from pydantic import TypeAdapter, ValidationError
from pyproj import Geod

from app.maps.airspace.applying import EVER, NEVER_ENDS
from app.maps.airspace.faults import Reading
from app.maps.airspace.reading import read_zones
from app.maps.airspace.zone import Volume, Zone
from app.schemas.airspace import Zones
from tests.app.maps.airspace.published import (
    CENTER, SQUARE, circle, ed269, ed318, geojson, kml, layer, volume, zone,
)

ZONES: TypeAdapter[Any] = TypeAdapter(Zones)
RING = "24.90,60.20,0 24.92,60.20,0 24.92,60.21,0 24.90,60.21,0"
HOLE = "24.905,60.203 24.915,60.203 24.915,60.207"


def read(stated: dict[str, Any]) -> Reading:
    return read_zones(ZONES.validate_python(stated))


def only(stated: dict[str, Any]) -> Zone:
    reading = read(stated)
    assert (reading.faults, reading.doubts) == ([], [])
    (found,) = reading.zones
    return found


def words(stated: dict[str, Any]) -> list[str]:
    return [each.words for each in only(stated).volumes]


def covers(each: Volume, longitude: float, latitude: float) -> bool:
    return bool(each.area.covers(shapely.Point(longitude, latitude)))


def test_a_zone_of_ed269_is_read_with_its_authority() -> None:
    found = only(ed269())
    assert (found.title, found.restriction) == ("Harbour (FIN0001)", "PROHIBITED")
    assert (found.country, found.message) == ("FIN", "No flights")
    assert found.authority == "Port, tower@port.example"
    assert [each.words for each in found.volumes] == ["from the ground to 120 m above the ground"]
    assert covers(found.volumes[0], 24.91, 60.205)
    assert not covers(found.volumes[0], 24.93, 60.205)


@pytest.mark.parametrize(("changed", "expected"), [
    ({"lowerLimit": 50}, "from 50 m above the ground to 120 m above the ground"),
    ({"upperLimit": 99999}, "from the ground up"),
    ({"upperLimit": None}, "from the ground up"),
    ({"lowerLimit": None}, "from an unstated height to 120 m above the ground"),
    ({"uomDimensions": "FT", "upperLimit": 2500, "upperVerticalReference": "AMSL"},
     "from the ground to 2500 ft above the sea"),
    ({"upperVerticalReference": "amsl"}, "from the ground to 120 m above the sea"),
    ({"upperVerticalReference": None}, "from the ground up"),
])
def test_limits_are_read_with_unit_and_reference(changed: dict[str, Any], expected: str) -> None:
    assert words(ed269(zone(volume(**changed)))) == [expected]


def test_what_is_left_out_of_a_volume_is_not_zero() -> None:
    bare = {"horizontalProjection": {"type": "Polygon", "coordinates": [SQUARE]}}
    assert words(ed269(zone(bare))) == ["from an unstated height up"]


def test_a_zone_has_several_volumes() -> None:
    found = only(ed269(zone(circle(500), circle(2500, lowerLimit=50))))
    assert [each.words for each in found.volumes] == [
        "from the ground to 120 m above the ground",
        "from 50 m above the ground to 120 m above the ground"]
    assert found.volumes[1].area.covers(found.volumes[0].area)


@pytest.mark.parametrize("radius", [5.0, 500.0, 40_000.0, 300_000.0])
def test_circles_are_held_by_their_polygons_and_hardly_more(radius: float) -> None:
    (found,) = only(ed269(zone(circle(radius)))).volumes
    earth = Geod(ellps="WGS84")
    for azimuth in range(360):
        inside = earth.fwd(CENTER[0], CENTER[1], azimuth, radius)[:2]
        beyond = earth.fwd(CENTER[0], CENTER[1], azimuth, radius * 1.021 + 1)[:2]
        assert covers(found, *inside)
        assert not covers(found, *beyond)


def test_polygons_have_holes() -> None:
    hole = [[24.905, 60.203], [24.915, 60.203], [24.915, 60.207], [24.905, 60.207]]
    area = {"type": "Polygon", "coordinates": [SQUARE, hole]}
    (found,) = only(ed269(zone(volume(horizontalProjection=area)))).volumes
    assert covers(found, 24.901, 60.201)
    assert not covers(found, 24.91, 60.205)


def test_rings_are_closed_and_heights_of_corners_passed_over() -> None:
    ring = [[*corner, 12.5] for corner in SQUARE[:-1]]
    (found,) = only(geojson({"type": "Polygon", "coordinates": [ring]})).volumes
    assert found.area.equals(only(ed269()).volumes[0].area)


@pytest.mark.parametrize(("stated", "meant"), [
    ("REQ_AUTHORISATION", "REQ_AUTHORISATION"), ("REQ_AUTHORIZATION", "REQ_AUTHORISATION"),
    ("req_authorisation", "REQ_AUTHORISATION"), ("USPACE", "REQ_AUTHORISATION"),
    ("CONDITIONAL", "CONDITIONAL"), ("NO_RESTRICTION", "NO_RESTRICTION")])
def test_restrictions_are_spelled_in_several_ways(stated: str, meant: str) -> None:
    assert only(ed269(zone(restriction=stated))).restriction == meant


def test_a_zone_of_ed318_has_layers_and_names_in_languages() -> None:
    found = only(ed318({"type": "GeometryCollection", "geometries": [
        {"type": "Polygon", "coordinates": [SQUARE], "layer": layer(50, 150)},
        {"type": "Point", "coordinates": CENTER, "extent": {"subType": "Circle", "radius": 300},
         "layer": layer(0, 500, "ft", "AMSL")}]}))
    assert (found.title, found.restriction) == ("Harbour (FIN0002)", "REQ_AUTHORISATION")
    assert found.authority == "Port, +358 1"
    assert [each.words for each in found.volumes] == [
        "from 50 m above the ground to 150 m above the ground",
        "from 0 ft above the sea to 500 ft above the sea"]
    assert covers(found.volumes[1], *CENTER)


def test_a_name_without_english_is_read_in_its_own_language() -> None:
    found = only(ed318({"type": "Polygon", "coordinates": [SQUARE]},
                       name=[{"text": "Satama", "lang": "fi-FI"}], zoneAuthority=[]))
    assert (found.name, found.authority) == ("Satama", None)


@pytest.mark.parametrize("data", [
    {"type": "Polygon", "coordinates": [SQUARE]},
    {"type": "MultiPolygon", "coordinates": [[SQUARE]]},
    {"type": "Feature", "properties": None, "geometry": {"type": "Polygon",
                                                         "coordinates": [SQUARE]}},
    {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "coordinates": [SQUARE]}]},
])
def test_plain_geojson_is_prohibited_from_the_ground_up(data: dict[str, Any]) -> None:
    found = only({"format": "geojson", "data": data})
    assert found.restriction == "PROHIBITED"
    assert [each.words for each in found.volumes] == ["from an unstated height up"]


def test_properties_of_plain_geojson_are_called_as_in_ed269() -> None:
    found = only(geojson({"type": "Polygon", "coordinates": [SQUARE]}, identifier="EE1",
                         restriction="CONDITIONAL", lowerLimit=10, lowerVerticalReference="AGL",
                         upperLimit=200, upperVerticalReference="AGL", uomDimensions="FT"))
    assert (found.title, found.restriction) == ("EE1", "CONDITIONAL")
    assert found.volumes[0].words == "from 10 ft above the ground to 200 ft above the ground"


def test_zones_across_180_degrees_are_whole() -> None:
    ring = [[179.9, 10], [-179.9, 10], [-179.9, 10.1], [179.9, 10.1]]
    hole = [[-179.95, 10.04], [-179.94, 10.04], [-179.94, 10.06], [-179.95, 10.06]]
    (found,) = only(geojson({"type": "Polygon", "coordinates": [ring, hole]})).volumes
    assert covers(found, 180.0, 10.05)
    assert not covers(found, 180.055, 10.05)


@pytest.mark.parametrize("namespace", [
    "http://www.opengis.net/kml/2.2", "http://earth.google.com/kml/2.1"])
def test_kml_is_read_with_holes(namespace: str) -> None:
    pytest.importorskip("fastkml")
    found = only(kml(RING, HOLE, namespace=namespace))
    assert (found.title, found.restriction) == ("Old town (p1)", "PROHIBITED")
    (only_volume,) = found.volumes
    assert covers(only_volume, 24.901, 60.201)
    assert not covers(only_volume, 24.913, 60.204)


@pytest.mark.parametrize("ring", [
    "24.90, 60.20, 0 24.92, 60.20, 0 24.92, 60.21, 0 24.90, 60.21, 0",
    "24.90 ,60.20 24.92 ,60.20 24.92 ,60.21 24.90 , 60.21",
    "\n 24.90,60.20,5\t24.92,60.20\n24.92,60.21 24.90,6.021e1 "])
def test_coordinates_of_kml_may_be_set_apart_in_any_way(ring: str) -> None:
    pytest.importorskip("fastkml")
    (found,) = only(kml(ring)).volumes
    assert covers(found, 24.91, 60.205)
    assert not covers(found, 24.93, 60.205)


@pytest.mark.parametrize(("ring", "corner"), [
    ("24.90 60.20 24.92 60.20 24.92 60.21", "'24.90'"),
    ("24.90,60.20, 24.92,60.20, 24.92,60.21", "'24.90,60.20,24.92,60.20,24.92,60.21'"),
    ("24.90;60.20 24.92;60.20 24.92;60.21", "'24.90;60.20'"),
    ("nan,60.20 24.92,60.20 24.92,60.21 24.90,60.21", "'nan,60.20'"),
    ("24.90,60.20,x 24.92,60.20 24.92,60.21", "'24.90,60.20,x'")])
def test_coordinates_that_are_none_are_told_in_words(ring: str, corner: str) -> None:
    pytest.importorskip("fastkml")
    (fault,) = read(kml(ring)).faults
    assert fault.message == (f"{corner} is no corner: write longitude,latitude with a comma "
                             "between the two, and spaces between corners.")


COUNTRY = [[20, 57], [28, 57], [28, 60], [20, 60], [20, 57]]
MAPS_EDGES = [
    [[-180, -90], [180, -90], [180, 90], [-180, 90], [-180, -90]],
    [[-180, 85.0511], [-180, -85.0511], [180, -85.0511], [180, 85.0511]],
    [[-180, 90], [-90, 90], [0, 90], [90, 90], [180, 90], [180, 0], [180, -90], [0, -90],
     [-180, -90], [-180, 0]],
    [[-179.9, -89.9], [179.9, -89.9], [179.9, 89.9], [-179.9, 89.9]]]


def closes(found: Zone, longitude: float, latitude: float) -> bool:
    return any(covers(each, longitude, latitude) for each in found.volumes)


@pytest.mark.parametrize("edge", MAPS_EDGES)
@pytest.mark.parametrize("form", ["ed269", "ed318", "geojson", "MultiPolygon", "kml"])
def test_a_mask_of_the_world_closes_all_but_its_holes(edge: list[list[float]], form: str) -> None:
    far = [[-3.5, 40], [-3.5, 41], [-3, 40.5]]
    area: dict[str, Any] = {"type": "Polygon", "coordinates": [edge, COUNTRY, far]}
    if form == "kml":
        pytest.importorskip("fastkml")
        stated = kml(*(" ".join(f"{x},{y}" for x, y in ring) for ring in area["coordinates"]))
    else:
        stated = {
            "ed269": ed269(zone(volume(horizontalProjection=area))), "ed318": ed318(area),
            "geojson": geojson(area),
            "MultiPolygon": geojson({"type": form, "coordinates": [area["coordinates"]]})}[form]
    found = only(stated)
    for open_to_all in ([24, 58], [20.01, 57.01], [-3.4, 40.5]):
        assert not closes(found, *open_to_all)
    for closed in ([19.99, 58], [24, 60.01], [-3.6, 40.5], [10, 50], [-100, 30], [175, -41],
                   [-179, 66], [30, 0], [0, 0]):
        assert closes(found, *closed)
    assert all(each.area.is_valid and each.area.bounds[2] - each.area.bounds[0] < 180
               for each in found.volumes)


def test_a_hole_across_180_degrees_is_open_on_both_sides() -> None:
    hole = [[175, -45], [-175, -45], [-175, -35], [175, -35]]
    found = only(geojson({"type": "Polygon", "coordinates": [MAPS_EDGES[0], hole]}))
    assert not closes(found, 176, -40)
    assert not closes(found, -176, -40)
    assert closes(found, 174, -40)
    assert closes(found, -174, -40)


BOWTIE = [[24.90, 60.20], [24.92, 60.21], [24.92, 60.20], [24.90, 60.21]]
WORLD = [[-170, 10], [-60, 10], [60, 10], [170, 10], [170, 20], [-170, 20]]


@pytest.mark.parametrize(("area", "said"), [
    ({"type": "Polygon", "coordinates": [BOWTIE]}, "crosses itself"),
    ({"type": "Polygon", "coordinates": [[[24, 60], [25, 61], [26, 62]]]}, "no size"),
    ({"type": "Polygon", "coordinates": [[[24, 60], [24, 60], [24, 60]]]}, "3 corners"),
    ({"type": "Polygon", "coordinates": [WORLD]}, "around the world"),
    ({"type": "Polygon", "coordinates": [MAPS_EDGES[0], BOWTIE]}, "crosses itself"),
    ({"type": "Polygon", "coordinates": [[[24, 60], [25, 91], [26, 60]]]}, "[25, 91] is no"),
    ({"type": "Circle", "center": [190, 60], "radius": 9}, "[190, 60] is no longitude"),
    ({"type": "Polygon"}, "needs its coordinates"),
    ({"type": "Circle", "center": CENTER}, "its radius"),
    ({"type": "Circle", "center": CENTER, "radius": 2e6}, "around the world"),
])
def test_what_is_no_area_is_told_with_its_place(area: dict[str, Any], said: str) -> None:
    reading = read(ed269(zone(), zone(volume(horizontalProjection=area))))
    (fault,) = reading.faults
    assert said in fault.message
    assert fault.path == ("features", 1, "geometry", 0, "horizontalProjection")
    assert len(reading.zones) == 1


@pytest.mark.parametrize("stated", [
    ed269(zone(volume(lowerVerticalReference="FL"))),
    ed269(zone(volume(uomDimensions="KM"))),
    ed269(zone(restriction="MAYBE")),
    ed269(zone(circle(-5))),
    ed318({"type": "Polygon", "coordinates": [SQUARE], "layer": layer(0, 5, reference="STD")}),
    geojson({"type": "LineString", "coordinates": SQUARE}),
    {"format": "openair", "data": {}},
])
def test_what_the_standards_lack_is_refused(stated: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        ZONES.validate_python(stated)


@pytest.mark.parametrize(("stated", "said"), [
    ({"format": "kml", "data": "hello"}, "no KML"),
    ({"format": "kml", "data": "<!DOCTYPE a [<!ENTITY b 'c'>]><kml/>"}, "entities"),
    ({"format": "kml", "data": "<kml></kml>"}, "no polygon"),
    (kml("24.90,60.20 24,x 24.92,60.21"), "'24,x' is no corner"),
    (kml(""), "can't be read"),
    (kml("24.90,160.20 24.92,60.20 24.92,60.21"), "Old town: [24.9, 160.2] is no longitude"),
    (kml("24.90,60.20 24.92,60.21 24.92,60.20 24.90,60.21"), "Old town: The boundary crosses"),
])
def test_bad_kml_is_told_in_words(stated: dict[str, Any], said: str) -> None:
    pytest.importorskip("fastkml")
    reading = read(stated)
    assert [said in fault.message for fault in reading.faults] == [True]
    assert reading.zones == []


def test_kml_is_refused_in_words_where_nothing_reads_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "fastkml", None)
    (fault,) = read(kml(RING)).faults
    assert "tandem-planner[geo]" in fault.message


def test_times_that_cannot_be_read_count_as_always() -> None:
    reading = read(ed269(zone(applicability=[{"permanent": "NO", "startDateTime": "tomorrow"}])))
    assert [doubt.path for doubt in reading.doubts] == [("features", 0)]
    (period,) = reading.zones[0].periods
    assert (period.begin, period.end, period.hours) == (EVER, NEVER_ENDS, ())
