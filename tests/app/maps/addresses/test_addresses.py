"""Several geocoders in order, and what is kept of their answers."""

import time
from pathlib import Path

import pytest

from app.maps.addresses import caching
from app.maps.addresses.addresses import Addresses
from app.maps.addresses.caching import AnswerCache
from app.maps.addresses.geocoder import GeocoderUnavailableError
from app.maps.addresses.opening import opened_addresses
from app.maps.addresses.setting import AddressServer, GeocoderSettingError, read_setting
from app.serving.settings import Settings
from tests.app.maps.addresses.stated import StatedGeocoder, place
from tests.conftest import PATIENCE

HOUSE, STREET = place("A 1"), place("A", quality="street")
DOWN = GeocoderUnavailableError("The geocoder failed.")


def later() -> float:
    return time.perf_counter() + PATIENCE


def test_second_is_asked_only_what_the_first_does_not_know_exactly() -> None:
    first = StatedGeocoder({"A 1": (HOUSE,), "B 1": (STREET,)})
    second = StatedGeocoder({"B 1": (place("B 1"),), "C 1": ()})
    found = Addresses([first, second]).look_up(["A 1", "B 1", "C 1", "B 1"], later())
    assert second.asked == ["B 1", "C 1"]
    assert {address: [each.label for each in places]
            for address, places in found.candidates.items()} == {
        "A 1": ["A 1"], "B 1": ["B 1"], "C 1": []}
    assert found.error is None


def test_better_answer_is_taken_whoever_gave_it() -> None:
    found = Addresses([StatedGeocoder({"A 1": (STREET,)}), StatedGeocoder({"A 1": ()})]).look_up(
        ["A 1"], later())
    assert found.candidates == {"A 1": (STREET,)}


def test_what_a_geocoder_that_fails_may_know_is_not_taken_for_nowhere() -> None:
    first = StatedGeocoder({"A 1": (HOUSE,), "B 1": (STREET,), "C 1": ()})
    found = Addresses([first, StatedGeocoder({}, DOWN)]).look_up(["A 1", "B 1", "C 1"], later())
    assert (found.error, sorted(found.candidates)) == (DOWN, ["A 1", "B 1"])


def test_answers_are_kept_for_all_who_share_the_file(tmp_path: Path) -> None:
    first = StatedGeocoder({"A 1": (HOUSE,)})
    one = Addresses([first], AnswerCache(tmp_path / "answers.sqlite"))
    one.look_up(["A 1", "B 1"], later())
    second = StatedGeocoder({})
    other = Addresses([second], AnswerCache(tmp_path / "answers.sqlite"))
    assert other.look_up([" a  1", "B 1"], later()).candidates == {" a  1": (HOUSE,), "B 1": ()}
    assert second.asked == []
    elsewhere = Addresses([StatedGeocoder({}, scope="other")],
                          AnswerCache(tmp_path / "answers.sqlite"))
    assert elsewhere.look_up(["A 1"], later()).candidates == {"A 1": ()}
    for each in (one, other, elsewhere):
        each.close()


def test_nothing_found_is_kept_for_a_day_and_a_place_for_longer(
        monkeypatch: pytest.MonkeyPatch) -> None:
    cache, now = AnswerCache(), time.time()
    cache.put("s", "A 1", (HOUSE,))
    cache.put("s", "B 1", ())
    assert set(cache.get("s", ["A 1", "B 1"])) == {"A 1", "B 1"}
    monkeypatch.setattr("app.maps.addresses.caching.time.time", lambda: now + 2 * caching.DAY)
    assert set(cache.get("s", ["A 1", "B 1"])) == {"A 1"}
    monkeypatch.setattr("app.maps.addresses.caching.time.time", lambda: now + 40 * caching.DAY)
    assert set(cache.get("s", ["A 1", "B 1"])) == set()
    cache.close()


def test_those_kept_for_longest_are_let_go(monkeypatch: pytest.MonkeyPatch) -> None:
    cache = AnswerCache(most=3)
    for number in range(5):
        monkeypatch.setattr("app.maps.addresses.caching.time.time",
                            lambda number=number: 1e9 + number)
        cache.put("s", str(number), (HOUSE,))
    assert set(cache.get("s", map(str, range(5)))) == {"2", "3", "4"}
    cache.close()


def test_file_that_is_none_is_done_without(tmp_path: Path) -> None:
    (tmp_path / "answers.sqlite").write_bytes(b"nothing of the kind" * 100)
    cache = AnswerCache(tmp_path / "answers.sqlite")
    cache.put("s", "A 1", (HOUSE,))
    assert cache.get("s", ["A 1"]) == {"A 1": (HOUSE,)}
    cache.close()


@pytest.mark.parametrize(("stated", "words"), [
    ("nominatim", "no such|must be as"), ("google:https://x", "can't be read"),
    ("https://user:s3cret@x", "can't be read"), ("photon:ftp://x", "must be as"),
    ("photon:http://x?colour=s3cret", "no option 'colour'"),
    ("photon:http://x?patience=s3cret", "no number"), ("photon:http://x?at_once=0", "positive"),
    ("nominatim:https://nominatim.openstreetmap.org", "email"),
    ("extract:/nowhere/s.osm.pbf", "can't be read"),
])
def test_wrong_settings_are_told_without_keys(stated: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(GeocoderSettingError, match=words) as error:
        opened_addresses(Settings(geocoder=stated, data_dir=tmp_path))
    assert "s3cret" not in str(error.value)


def test_extract_that_is_not_prepared_is_told(tmp_path: Path) -> None:
    (tmp_path / "x.osm.pbf").write_bytes(b"x")
    with pytest.raises(GeocoderSettingError, match="tandem addresses build"):
        opened_addresses(Settings(geocoder=f"extract:{tmp_path / 'x.osm.pbf'}"))


def test_several_geocoders_are_read_in_order(helsinki: Path, tmp_path: Path) -> None:
    stated = (f"extract:{helsinki}, photon:http://localhost:2322?language=fi,"
              "pelias:https://host/v1?key=a,b&at_once=2")
    assert [type(source).__name__ for source in read_setting(stated)] == [
        "AddressExtract", "AddressServer", "AddressServer"]
    geocoders = opened_addresses(Settings(geocoder=stated, data_dir=tmp_path))
    assert geocoders.names == ("extract", "photon", "pelias")
    geocoders.close()


@pytest.mark.parametrize(("stated", "gap"), [
    ("nominatim:https://nominatim.openstreetmap.org?email=a@b.example", 1.0),
    ("nominatim:https://nominatim.openstreetmap.org?email=a@b.example&per_second=9", 1.0),
    ("nominatim:https://nominatim.openstreetmap.org?email=a@b.example&per_second=0.5", 2.0),
    ("nominatim:http://localhost:8080", 0.0), ("photon:http://localhost?per_second=4", 0.25),
])
def test_public_servers_are_asked_as_seldom_as_they_want(stated: str, gap: float) -> None:
    (source,) = read_setting(stated)
    assert isinstance(source, AddressServer)
    assert source.server.gap == gap
