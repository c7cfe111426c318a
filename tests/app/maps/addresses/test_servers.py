"""Geocoding servers: what they answer, judged; and what they do when they fail."""

import gc
import json
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest

from app.maps.addresses.addresses import Addresses
from app.maps.addresses.caching import AnswerCache
from app.maps.addresses.geocoder import (
    Candidates, GeocoderAnswerError, GeocoderError, GeocoderStoppedError, GeocoderUnavailableError,
    Told,
)
from app.maps.addresses.server import GeocodingServer, ServerKind
from app.maps.addresses.serving import ServerGeocoder
from app.maps.remote.asking import ShouldStop
from tests.app.maps.roads import faults
from tests.app.maps.roads.faults import Fault, Proxy, standing_in
from tests.conftest import PATIENCE, free_port

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings(
    # asyncio leaves a socket to be collected if it is cancelled while that connects.
    "ignore:Exception ignored in:pytest.PytestUnraisableExceptionWarning")]

Data = dict[str, Any]


@pytest.fixture(scope="module", autouse=True)
def collected() -> Iterator[None]:
    """Have sockets collected before other tests."""
    yield
    gc.collect()


def nominatim(*places: Data) -> Any:
    return [{"lon": "24.945", "lat": "60.172", "place_rank": 30, "display_name": "18, Mikonkatu, "
             "Kluuvi, 00100, Suomi / Finland",
             "address": {"house_number": "18", "road": "Mikonkatu", "postcode": "00100"}, **place}
            for place in places]


def photon(*places: Data) -> Any:
    return {"type": "FeatureCollection", "features": [{
        "type": "Feature", "geometry": {"type": "Point", "coordinates": [24.945, 60.172]},
        "properties": {"type": "house", "housenumber": "18", "street": "Mikonkatu", "postcode":
                       "00100", "city": "Helsinki", "country": "Finland", **place}}
        for place in places]}


def pelias(*places: Data) -> Any:
    return {"type": "FeatureCollection", "features": [{
        "type": "Feature", "geometry": {"type": "Point", "coordinates": [24.945, 60.172]},
        "properties": {"layer": "address", "label": "Mikonkatu 18, Helsinki, Finland",
                       "housenumber": "18", "street": "Mikonkatu", "locality": "Helsinki",
                       "match_type": "exact", **place}} for place in places]}


ANSWERS = {"nominatim": nominatim, "photon": photon, "pelias": pelias}
KINDS = tuple(ANSWERS)


@contextmanager
def answering(answer: Any, fault: Fault = faults.nothing) -> Iterator[Proxy]:
    """Have a server that answers the same to all, but for a fault."""
    def fetch(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        return 200, json.dumps(answer).encode()

    with standing_in(fetch, lambda: fault) as proxy:
        yield proxy


def asked(kind: ServerKind, url: str, *addresses: str, seconds: float = PATIENCE,
          **options: Any) -> list[Candidates]:
    """Return what a server says of addresses."""
    found: dict[int, Candidates] = {}
    geocoder = ServerGeocoder(kind, GeocodingServer(url, first_wait=0.001, **options))
    try:
        geocoder.find(addresses, time.perf_counter() + seconds, lambda: False,
                      lambda place, candidates: found.update({place: candidates}))
    finally:
        geocoder.close()
    return [found[place] for place in range(len(addresses))]


@pytest.mark.parametrize("kind", KINDS)
def test_house(kind: ServerKind) -> None:
    with answering(ANSWERS[kind]({})) as proxy:
        [(found,)] = asked(kind, proxy.url, "Mikonkatu 18, Helsinki")
    assert (found.lon, found.lat, found.quality, found.by, found.unmatched) == (
        24.945, 60.172, "house", kind, ())
    assert {"Mikonkatu", "18"} <= set(found.label.replace(",", "").split())


@pytest.mark.parametrize("kind", KINDS)
def test_another_house_than_asked_for_is_the_street_alone(kind: ServerKind) -> None:
    with answering(ANSWERS[kind]({})) as proxy:
        [(found,)] = asked(kind, proxy.url, "Mikonkatu 81, Helsinki")
    assert found.quality == "street"


@pytest.mark.parametrize(("kind", "street", "town"), [
    ("nominatim", {"place_rank": 26, "address": {"road": "Mikonkatu"}}, {"place_rank": 16}),
    ("photon", {"type": "street", "housenumber": "", "name": "Mikonkatu"}, {"type": "city"}),
    ("pelias", {"layer": "street", "housenumber": ""}, {"layer": "locality"}),
])
def test_street_and_town(kind: ServerKind, street: Told, town: Told) -> None:
    for place, quality in ((street, "street"), (town, "town")):
        with answering(ANSWERS[kind](place)) as proxy:
            [(found,)] = asked(kind, proxy.url, "Mikonkatu, Helsinki")
        assert found.quality == quality


def test_stop_named_after_a_street_is_not_its_house() -> None:
    stop = {"display_name": "Mikonkatu, Helsinki, Suomi", "address": {}}
    with answering(nominatim(stop)) as proxy:
        [(found,)] = asked("nominatim", proxy.url, "Mikonkatu 18, Helsinki")
        [(named,)] = asked("nominatim", proxy.url, "Mikonkatu, Helsinki")
    assert (found.quality, named.quality) == ("street", "house")


def test_point_between_houses_is_told() -> None:
    with answering(pelias({"match_type": "interpolated"})) as proxy:
        [(found,)] = asked("pelias", proxy.url, "Mikonkatu 18")
    assert found.quality == "interpolated"


@pytest.mark.parametrize(("kind", "address", "unmatched"), [
    ("photon", "Mikonkatu 18, Tampere", ("tampere",)), ("pelias", "Mikonkatu 18, Tampere",
                                                       ("tampere",)),
    ("photon", "Aleksanterinkatu 18, Helsinki", ("aleksanterink", "helsinki")),
    ("nominatim", "Mikonkatu 18, 33100 Tampere", ("33100",)),
    ("photon", "Mikonktau 18 Helsinki Suomi", ()),
])
def test_what_does_not_fit_is_told(
        kind: ServerKind, address: str, unmatched: tuple[str, ...]) -> None:
    with answering(ANSWERS[kind]({})) as proxy:
        [(found,)] = asked(kind, proxy.url, address)
    assert found.unmatched == unmatched


def test_places_apart_are_all_told_and_doors_of_one_house_are_not() -> None:
    door, other = {"lon": "24.9451"}, {"lon": "24.2", "display_name": "18, Mikonkatu, Vihti"}
    with answering(nominatim({}, door, other)) as proxy:
        [found] = asked("nominatim", proxy.url, "Mikonkatu 18")
    assert [place.lon for place in found] == [24.945, 24.2]


def test_best_places_come_before_the_servers_first() -> None:
    with answering(photon({"type": "city", "name": "Mikonkatu"}, {})) as proxy:
        [(found,)] = asked("photon", proxy.url, "Mikonkatu 18, Helsinki")
    assert found.quality == "house"


@pytest.mark.parametrize(("kind", "path", "query"), [
    ("nominatim", "/geo/search", {"q": ["A&B 1"], "format": ["jsonv2"], "addressdetails": ["1"],
                                  "limit": ["5"], "countrycodes": ["fi"], "key": ["s3"],
                                  "accept-language": ["sv"], "email": ["a@b.example"]}),
    ("photon", "/geo/api", {"q": ["A&B 1"], "limit": ["5"], "lang": ["sv"], "key": ["s3"]}),
    ("pelias", "/geo/search", {"text": ["A&B 1"], "size": ["5"], "lang": ["sv"],
                               "boundary.country": ["FI"], "api_key": ["s3"]}),
])
def test_what_servers_are_asked(kind: ServerKind, path: str, query: dict[str, list[str]]) -> None:
    paths = []

    def fetch(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        paths.append(path)
        return 200, json.dumps(ANSWERS[kind]()).encode()

    with standing_in(fetch, lambda: faults.nothing) as proxy:
        assert asked(kind, f"{proxy.url}/geo", "A&B 1", country="fi", language="sv", key="s3",
                     email="a@b.example") == [()]
        assert proxy.fields["user-agent"] == "tandem-planner (a@b.example)"
    parts = urlsplit(paths[0])
    assert (parts.path, parse_qs(parts.query)) == (path, query)


NONSENSE = {
    "no JSON": faults.body(b"<html>Sorry</html>"), "cut": faults.cut_unseen(0.5),
    "huge": faults.body(b" " * 2**21), "other shape": faults.body(b'{"results": []}'),
    "null": faults.body(b"null"),
    "off the globe": faults.body(json.dumps(nominatim({"lat": "91"})).encode()),
    "no number": faults.body(json.dumps(nominatim({"lat": "NaN"})).encode()),
    "no rank": faults.body(b'[{"lat": "60", "lon": "24", "display_name": "x"}]'),
}


@pytest.mark.thorough_after(8)
@pytest.mark.parametrize("fault", NONSENSE.values(), ids=NONSENSE)
@pytest.mark.parametrize("kind", KINDS)
def test_nonsense_is_an_error(kind: ServerKind, fault: Fault) -> None:
    with answering(ANSWERS[kind]({}), fault) as proxy, pytest.raises(GeocoderAnswerError):
        asked(kind, proxy.url, "Mikonkatu 18")


DOWN = {
    "500": faults.status(500), "403": faults.status(403), "404": faults.status(404),
    "429": faults.status(429, Retry_After="3600"), "cut off": faults.cut(0.0),
}


@pytest.mark.parametrize("fault", DOWN.values(), ids=DOWN)
def test_server_that_is_down_is_an_error_without_its_key(fault: Fault) -> None:
    with answering(pelias({}), fault) as proxy, pytest.raises(GeocoderUnavailableError) as error:
        asked("pelias", proxy.url, "Mikonkatu 18", key="s3cret", seconds=5.0)
    assert "s3cret" not in str(error.value)
    assert "127.0.0.1" not in str(error.value)


def test_server_that_is_not_there() -> None:
    with pytest.raises(GeocoderUnavailableError, match="ConnectError"):
        asked("photon", f"http://127.0.0.1:{free_port()}", "Mikonkatu 18")


def test_slow_server_is_left_in_time() -> None:
    with answering(photon({}), faults.delay(30.0)) as proxy, \
            pytest.raises(GeocoderUnavailableError, match="in time"):
        asked("photon", proxy.url, "Mikonkatu 18", seconds=0.2)


def test_address_that_makes_no_sense_to_the_server_is_not_found() -> None:
    with answering({"error": "bad"}, faults.status(400)) as proxy:
        assert asked("nominatim", proxy.url, "?") == [()]


def test_fault_that_passes_is_asked_again() -> None:
    passing = iter([faults.status(503), faults.cut(0.5), faults.nothing])

    def fetch(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        return 200, json.dumps(photon({})).encode()

    with standing_in(fetch, lambda: next(passing)) as proxy:
        [(found,)] = asked("photon", proxy.url, "Mikonkatu 18")
    assert found.quality == "house"


def test_work_that_is_stopped_asks_no_longer() -> None:
    with answering(photon({}), faults.delay(30.0)) as proxy:
        geocoder = ServerGeocoder("photon", GeocodingServer(proxy.url))
        with pytest.raises(GeocoderStoppedError):
            geocoder.find(["x"], time.perf_counter() + PATIENCE, lambda: True, lambda *told: None)
        geocoder.close()


class Noting(ServerGeocoder):
    """Notes what it is asked for."""

    def __init__(self, server: GeocodingServer) -> None:
        super().__init__("photon", server)
        self.asked: list[list[str]] = []

    def find(self, addresses: Sequence[str], until: float, should_stop: ShouldStop,
             told: Told) -> None:
        self.asked.append(list(addresses))
        super().find(addresses, until, should_stop, told)


def test_answers_before_a_fault_are_kept() -> None:
    """A second try asks only for what lacks."""
    passing = iter([faults.nothing, faults.nothing])
    is_down = True

    def fetch(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        return 200, json.dumps(photon({})).encode()

    def fault() -> Fault:
        return next(passing, faults.status(403) if is_down else faults.nothing)

    with standing_in(fetch, fault) as proxy:
        geocoder = Noting(GeocodingServer(proxy.url, at_once=1, first_wait=0.001))
        geocoders = Addresses([geocoder], AnswerCache())
        texts = [f"Mikonkatu 18 {letter}" for letter in "abcd"]
        until = time.perf_counter() + PATIENCE
        first = geocoders.look_up(texts, until)
        assert isinstance(first.error, GeocoderError)
        is_down = False
        second = geocoders.look_up(texts, until)
        assert (second.error, len(second.candidates)) == (None, 4)
        lacking = [text for text in texts if text not in first.candidates]
        assert len(lacking) == 2
        assert geocoder.asked == [texts, lacking]
        geocoders.close()


def test_turns_come_one_after_another_for_all_who_share_them() -> None:
    cache = AnswerCache()
    waits = [cache.take_turn("host", 20.0) for _ in range(3)]
    assert waits == pytest.approx([0.0, 20.0, 40.0], abs=9.0)
    assert cache.take_turn("other", 20.0) == pytest.approx(0.0)
    cache.close()


def test_server_is_asked_when_its_turn_comes() -> None:
    waits = iter([0.0, 0.0, 0.0])
    with answering(photon({})) as proxy:
        geocoder = ServerGeocoder("photon", GeocodingServer(proxy.url), partial(next, waits))
        geocoder.find(["a", "b", "c"], time.perf_counter() + PATIENCE, lambda: False,
                      lambda *told: None)
        geocoder.close()
    assert next(waits, None) is None
