"""Tables of OSRM in JSON and in numbers of 32 bits: the same."""

import time
from collections.abc import Iterator, Sequence
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest

from app.maps.remote.asking import RemoteServer
from app.maps.roads import osrm_tables
from app.maps.roads.answers import BlockAnswer
from app.maps.roads.engine import RoadsAnswerError, RoadTable
from app.maps.roads.osrm import Osrm
from app.maps.roads.osrm_tables import AskedBlock, TableForm, floats, in_floats, in_json, quickest
from app.maps.roads.server import RoadServer
from model.problem import FloatArray
from tests.app.maps.roads.conftest import Places

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def table_of(url: str, form: TableForm, places: FloatArray, max_places: int = 100) -> RoadTable:
    engine = Osrm(RoadServer(url, max_places), form=form)
    table = engine.table(places, time.perf_counter() + 60)
    engine.close()
    return table


def assert_same(one: RoadTable, other: RoadTable) -> None:
    for mine, others in zip(vars(one).values(), vars(other).values(), strict=True):
        np.testing.assert_array_equal(mine, others)


@pytest.mark.parametrize("max_places", [100, 33])
def test_floats_tell_the_same_as_json(max_places: int, helsinki_osrm: str,
                                      helsinki_places: Places) -> None:
    scattered = helsinki_places(90, 7)
    # Some lie together: ways of no length, beside those that there are not.
    places = np.concatenate([scattered, scattered[:5], scattered[5:10] + 2e-6])
    table = table_of(helsinki_osrm, in_json, places)
    assert np.isnan(table.durations_s).any()
    assert (table.durations_s == 0).sum() > len(places)
    assert_same(table_of(helsinki_osrm, in_floats, places, max_places), table)


def test_only_large_tables_are_asked_for_in_floats(
        helsinki_osrm: str, helsinki_places: Places, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def noting(asking: RemoteServer, some: Sequence[AskedBlock], *times: Any) -> list[BlockAnswer]:
        asked.extend(len(one.places) for one in some)
        return in_floats(asking, some, *times)

    monkeypatch.setattr(osrm_tables, "in_floats", noting)
    monkeypatch.setattr(osrm_tables, "LEGS_PER_PLACE", 50)
    places = helsinki_places(90, 7)
    table = table_of(helsinki_osrm, in_json, places)
    assert_same(table_of(helsinki_osrm, quickest, places), table)
    assert asked == [90]
    assert_same(table_of(helsinki_osrm, quickest, places, 45), table)
    assert asked == [90]


def test_long_legs_are_asked_for_in_json(helsinki_osrm: str, helsinki_places: Places,
                                         monkeypatch: pytest.MonkeyPatch) -> None:
    def tell_little(rows: int, columns: int, body: bytes) -> tuple[FloatArray, FloatArray]:
        durations, distances = floats(rows, columns, body)
        return np.where(distances > 1000, durations + 1, durations), distances

    monkeypatch.setattr(osrm_tables, "EXACT_UP_TO", 1000.0)
    monkeypatch.setattr(osrm_tables, "floats", tell_little)
    places = helsinki_places(40, 8)
    assert_same(table_of(helsinki_osrm, in_floats, places),
                table_of(helsinki_osrm, in_json, places))


@pytest.fixture(scope="module")
def answer(helsinki_osrm: str, helsinki_places: Places) -> Iterator[bytes]:
    line = ";".join(f"{lon:.6f},{lat:.6f}" for lon, lat in helsinki_places(3, 9))
    with urlopen(f"{helsinki_osrm}/table/v1/driving/{line}.flatbuffers"
                 "?annotations=duration,distance&skip_waypoints=true", timeout=60) as reply:
        yield reply.read()


def test_answer_of_another_size_is_none(answer: bytes) -> None:
    assert floats(3, 3, answer)[0].shape == (3, 3)
    with pytest.raises(RoadsAnswerError):
        floats(3, 2, answer)


def test_answer_that_is_cut_is_none(answer: bytes) -> None:
    for length in range(len(answer)):
        with pytest.raises(RoadsAnswerError):
            floats(3, 3, answer[:length])


def test_answer_that_is_spoilt_is_none_or_of_its_size(answer: bytes) -> None:
    rng = np.random.default_rng(1)
    refused = 0
    for place in range(len(answer)):
        for byte in (0, 255, *rng.integers(256, size=4).tolist()):
            spoilt = answer[:place] + bytes([byte]) + answer[place + 1:]
            try:
                numbers = floats(3, 3, spoilt)
            except RoadsAnswerError:
                refused += 1
            else:
                assert all(np.isfinite(part).all() and part.shape == (3, 3) for part in numbers)
    assert refused > len(answer)
