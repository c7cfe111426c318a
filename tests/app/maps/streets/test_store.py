"""An extract becomes one file of tiles, made once, whole or not at all."""

import gzip
import json
import re
from pathlib import Path
from tempfile import mkstemp
from typing import Any

import numpy as np
import pytest

from app.maps.streets import filing, store
from app.maps.streets.filing import folder_beside
from app.maps.streets.mercator import on_map
from app.maps.streets.reading import StreetsError, read_drawing
from app.maps.streets.store import Streets, build_streets
from tests.app.maps.streets.conftest import HELSINKI, WAYS, osm_xml

Content = dict[str, list[list[Any]]]


def tile_at(streets: Streets, lon: float, lat: float, zoom: int) -> Content:
    """Return what the tile around a place shows."""
    x, y = (on_map(np.array([[lon, lat]]))[0] * (1 << zoom)).astype(int)
    content = streets.tile(zoom, int(x), int(y))
    return {} if content is None else json.loads(gzip.decompress(content))


def test_island_is_read(island: Path) -> None:
    drawing = read_drawing(island)
    assert drawing.bounds == (0, 0, 0.01, 0.01)
    assert {kind: len(shapes) for kind, shapes in drawing.shapes.items()} == {
        "sea": 1, "green": 1, "building": 1, "street": 1}
    (park,) = drawing.shapes["green"]
    assert len(park.geoms[0].interiors) == 1


def test_extract_that_does_not_state_its_bounds_has_those_of_its_places(island: Path) -> None:
    island.write_text(re.sub("<bounds.*?/>", "", island.read_text()))
    assert read_drawing(island).bounds == (0, 0.001, 0.01, 0.009)


def test_tile_shows_street_house_and_park(island: Path, tmp_path: Path) -> None:
    streets = build_streets(island, [tmp_path / "made"])
    content = tile_at(streets, 0.005, 0.005, 14)
    assert set(content) == {"sea", "green", "building", "street"}
    assert len(content["green"]) == 2
    assert tile_at(streets, 1, 1, 14) == {}


def test_ways_of_one_name_are_joined_to_one_line(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tags = {"highway": "residential", "name": "Main Street"}
    monkeypatch.setitem(WAYS, 21, ((1, 3), tags))
    monkeypatch.setitem(WAYS, 28, ((3, 2), tags))
    extract = tmp_path / "named.osm"
    extract.write_text(osm_xml())
    drawing = read_drawing(extract)
    assert len(drawing.shapes["street"]) == 2
    assert list(drawing.named["street"].names) == ["Main Street"]
    content = tile_at(build_streets(extract, [tmp_path / "made"]), 0.002, 0.002, 14)
    assert [each[:2] for each in content["names"]] == [["street", "Main Street"]]


def test_tiles_of_the_same_extract_are_made_once(
        island: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = build_streets(island, [tmp_path / "made"])
    monkeypatch.delattr(store, "read_drawing")
    assert build_streets(island, [tmp_path / "spare", tmp_path / "made"]) == made
    copy = tmp_path / "other" / island.name
    copy.parent.mkdir()
    copy.write_bytes(island.read_bytes())
    assert build_streets(copy, [tmp_path / "made"]) == made


def test_tiles_of_a_changed_extract_are_made_anew(island: Path, tmp_path: Path) -> None:
    before = build_streets(island, [tmp_path])
    island.write_text(island.read_text().replace("residential", "primary"))
    after = build_streets(island, [tmp_path])
    assert after.name != before.name
    assert "primary" in tile_at(after, 0.005, 0.005, 14)


def test_spare_folder_takes_what_the_first_refuses(
        island: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refusing(prefix: str, dir: Path) -> tuple[int, str]:
        if dir == tmp_path / "locked":
            raise PermissionError
        return mkstemp(prefix=prefix, dir=dir)

    monkeypatch.setattr(filing, "mkstemp", refusing)
    streets = build_streets(island, [tmp_path / "locked", tmp_path / "spare"])
    assert streets.file.parent == tmp_path / "spare"


@pytest.mark.parametrize("content", [b"", b"nothing of the kind", HELSINKI.read_bytes()[:100_000]])
def test_what_is_no_whole_extract_is_refused_and_leaves_nothing(
        content: bytes, tmp_path: Path) -> None:
    extract = tmp_path / "broken.osm.pbf"
    extract.write_bytes(content)
    folder = folder_beside(extract)
    with pytest.raises(StreetsError, match=r"broken\.osm\.pbf"):
        build_streets(extract, [folder])
    assert list(folder.iterdir()) == []


def test_helsinki_has_what_a_city_has(tmp_path: Path) -> None:
    streets = build_streets(HELSINKI, [tmp_path])
    west, south, east, north = streets.bounds
    assert (24.93 < west < east < 24.96, 60.16 < south < north < 60.18) == (True, True)
    content = tile_at(streets, 24.945, 60.17, 14)
    assert {"sea", "green", "water", "building", "street", "primary", "rail"} <= set(content)
    assert len(content["building"]) > 200
    names = {name for _, name, *_ in content["names"]}
    assert {"Aleksanterinkatu", "Mannerheimintie", "Keskuskatu"} <= names
    assert streets.file.stat().st_size < 500_000
