"""Servers of roads as operators state them."""

import json
import time

import numpy as np
import pytest

from app.maps.roads.engine import RoadsError
from app.maps.roads.servers import ServerKind, server_engine
from tests.app.maps.roads import faults
from tests.app.maps.roads.faults import standing_in

pytestmark = pytest.mark.slow


def asked_by(kind: ServerKind, profile: str, options: str = "",
             count: int = 2) -> tuple[list[str], list[bytes], dict[str, str]]:
    """Return the paths and bodies that a table is asked for with, and the last's headers."""
    paths, bodies = [], []

    def answered(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        paths.append(path)
        bodies.append(body)
        return 400, b""

    places = np.column_stack([np.linspace(24.0, 25.0, count), np.full(count, 60.0)])
    with standing_in(answered, lambda: faults.nothing) as proxy:
        engine = server_engine(kind, f"{proxy.url}/roads/{options}", profile)
        with pytest.raises(RoadsError):
            engine.table(places, time.perf_counter() + 60)
        engine.close()
        return paths, bodies, proxy.fields


@pytest.mark.parametrize(("kind", "profile", "options", "name"), [
    ("osrm", "truck", "", "driving"),
    ("osrm", "bicycle", "?profile=cycling", "cycling"),
    ("ors", "truck", "", "driving-hgv"),
    ("ors", "bicycle", "", "cycling-regular"),
    ("ors", "night shift", "", "driving-car"),
    ("ors", "truck", "?profile=driving-car", "driving-car"),
])
def test_profiles_have_the_server_s_names(kind: ServerKind, profile: str, options: str,
                                          name: str) -> None:
    paths, _, _ = asked_by(kind, profile, options)
    assert f"/{name}" in paths[0]
    assert paths[0].startswith("/roads/")


@pytest.mark.parametrize(("profile", "costing"), [
    ("truck", "truck"), ("van", "auto"), ("bicycle", "bicycle")])
def test_valhalla_is_told_how_to_travel(profile: str, costing: str) -> None:
    _, bodies, _ = asked_by("valhalla", profile)
    assert json.loads(bodies[0])["costing"] == costing


def test_a_key_may_be_part_of_valhalla_s_addresses() -> None:
    paths, _, fields = asked_by("valhalla", "car", "?key=a%26b&key_parameter=api_key")
    assert "authorization" not in fields
    assert all(path.endswith("?api_key=a%26b") for path in paths)
    with pytest.raises(ValueError, match="key_parameter"):
        server_engine("osrm", "http://host?key=a&key_parameter=api_key", "car")


def test_options_stand_behind_the_address() -> None:
    paths, _, fields = asked_by("osrm", "truck", "?max_places=3&at_once=1&key=5b3ce3", count=6)
    assert fields["authorization"] == "5b3ce3"
    assert "sources=0;1;2&destinations=0;1;2" in paths[0]


def test_keys_are_not_shown() -> None:
    engine = server_engine("ors", "http://localhost:5000?key=5b3ce3", "truck")
    assert "5b3ce3" not in repr(vars(engine))


@pytest.mark.parametrize(("address", "words"), [
    ("http://localhost:5000?max_place=9", "no option 'max_place'"),
    ("http://localhost:5000?max_places=many", "no number"),
    ("http://localhost:5000?max_places=0", "max_places"),
    ("http://localhost:5000?max_points=1", "max_points"),
    ("http://localhost:5000?patience=nan", "patience"),
    ("http://localhost:5000#roads", "address"),
    ("file:///etc/passwd", "address"),
])
def test_address_that_can_t_be_read(address: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        server_engine("osrm", address, "truck")
