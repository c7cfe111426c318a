"""Files of zones: their formats, their encodings, and what of them can't be read."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.maps.airspace.files import ZoneFileError, read_file, zones_in
from tests.app.maps.airspace.published import (
    SQUARE, circle, ed269, ed318, geojson, kml, volume, zone,
)

Data = dict[str, Any]
Write = Callable[..., Path]
AREA = {"type": "Polygon", "coordinates": [SQUARE]}
RING = "24.90,60.20,0 24.92,60.20,0 24.92,60.21,0 24.90,60.21,0"


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def written(stated: Data, encoding: str = "utf-8", name: str = "zones") -> Path:
        data = stated["data"]
        path = tmp_path / name
        path.write_text(data if isinstance(data, str) else json.dumps(data), encoding)
        return path
    return written


@pytest.mark.parametrize("stated", [
    ed269(zone(), zone(circle(), identifier="B")), ed318(AREA), geojson(AREA),
    {"format": "geojson", "data": AREA}])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_formats_and_encodings_are_told_apart(write: Write, stated: Data, encoding: str) -> None:
    file_format, reading = read_file(write(stated, encoding))
    assert file_format == stated["format"]
    assert reading.faults == []
    assert len(reading.zones) == len(stated["data"].get("features", [1]))


def test_kml_is_told_by_its_text(write: Write) -> None:
    pytest.importorskip("fastkml")
    file_format, reading = read_file(write(kml(RING)))
    assert (file_format, len(reading.zones)) == ("kml", 1)


def test_faults_are_told_zone_by_zone(write: Write) -> None:
    file = write(ed269(zone(), zone(volume(lowerVerticalReference="FL")), zone(circle(2e6)),
                       zone(restriction="MAYBE"), zone(identifier="E")))
    _, reading = read_file(file)
    assert [found.identifier for found in reading.zones] == ["FIN0001", "E"]
    assert [fault.path for fault in reading.faults] == [
        ("features", 1, "geometry", 0, "lowerVerticalReference"),
        ("features", 2, "geometry", 0, "horizontalProjection"),
        ("features", 3, "restriction")]
    with pytest.raises(ZoneFileError, match="3 of its zones can't be read"):
        zones_in([file])


def test_zones_of_several_files_hold_together(write: Write) -> None:
    files = [write(ed269(), name="a"), write(ed318(AREA), name="b")]
    assert [found.identifier for found in zones_in(files)] == ["FIN0001", "FIN0002"]


@pytest.mark.parametrize(("content", "said"), [
    (b"zones", "neither JSON nor KML"), (b"\xff\x00\xff", "UTF-8"), (b"[" * 10_000, "neither"),
    (b" " * 2000, "at most 0.00")])
def test_what_is_no_file_of_zones_is_told(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "zones"
    path.write_bytes(content)
    with pytest.raises(ZoneFileError, match=said):
        read_file(path, 1000 if said.startswith("at") else 2**20)


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ZoneFileError, match=r"none: it can't be opened \(No such file"):
        zones_in([tmp_path / "none"])


@pytest.mark.parametrize("data", [
    None, 3, [], {}, {"features": 3}, {"features": [3]}, {"features": [{}]},
    {"features": [{"geometry": []}]}, {"features": [{"properties": {"variant": 1, "type": 2,
                                                                    "zoneAuthority": 3}}]}])
def test_json_without_zones_is_told(write: Write, data: Any) -> None:
    _, reading = read_file(write({"data": data}))
    assert reading.zones == []
    assert len(reading.faults) > 0
