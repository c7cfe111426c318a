from pathlib import Path

import pytest

from app.maps.roads.setting import Extract, RoadsServer, SettingError, read_setting

pytestmark = pytest.mark.slow


def test_nothing_set_means_no_roads() -> None:
    assert read_setting("") == read_setting("  ") == {}


def test_extracts_and_servers_are_read_by_profile() -> None:
    assert read_setting(
        "truck=berlin.osm.pbf, car=osrm:http://localhost:5000,bike=bicycle:/maps/b,c.osm.pbf,"
        "van=valhalla:https://roads.example.org/v,hgv=ors:https://api.example.org") == {
            "truck": Extract(Path("berlin.osm.pbf"), "truck"),
            "car": RoadsServer("osrm", "http://localhost:5000"),
            "bike": Extract(Path("/maps/b,c.osm.pbf"), "bicycle"),
            "van": RoadsServer("valhalla", "https://roads.example.org/v"),
            "hgv": RoadsServer("ors", "https://api.example.org")}


@pytest.mark.parametrize(("text", "remedy"), [
    ("berlin.osm.pbf", "write profile=extract"),
    ("truck=", "write profile=extract"),
    ("=berlin.osm.pbf", "write profile=extract"),
    ("truck=a.osm.pbf,truck=b.osm.pbf", "name each profile once"),
    ("car=osrm:localhost:5000", "osrm:http://localhost:5000"),
    ("car=http://localhost:5000", "write osrm: or valhalla: or ors: before it"),
    ("lorry=berlin.osm.pbf", "lorry=car:berlin.osm.pbf"),
    ("lorry=tank:berlin.osm.pbf", "car, van, truck, bicycle"),
])
def test_what_cannot_be_read_says_what_to_write(text: str, remedy: str) -> None:
    with pytest.raises(SettingError, match=r"^TANDEM_ROADS: ") as raised:
        read_setting(text)
    assert remedy in str(raised.value)
