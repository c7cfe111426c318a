"""Roads asked of a real `osrm-routed`, and of places for which it has none."""

import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import polyline
import pytest

from app.maps.roads.engine import (
    Block, Driving, NoWayError, RoadsAnswerError, RoadsUnavailableError, RoadTable,
    UnknownDrivingError,
)
from app.maps.roads.osrm import Osrm
from app.maps.roads.osrm_tables import TableForm, in_floats, in_json
from app.maps.roads.server import RoadServer
from model.problem import FloatArray
from tests.app.maps.roads.conftest import Places, served
from tests.conftest import free_port

pytestmark = pytest.mark.slow


def soon() -> float:
    """Return a time that no answer reaches, unless the machine stalls."""
    return time.perf_counter() + 60


@pytest.fixture(scope="session")
def osrm(helsinki_osrm: str) -> Iterator[Osrm]:
    engine = Osrm(RoadServer(helsinki_osrm))
    yield engine
    engine.close()


def asked_plainly(url: str, lon_lat: FloatArray) -> dict[str, Any]:
    places = ";".join(f"{longitude:.6f},{latitude:.6f}" for longitude, latitude in lon_lat)
    address = f"{url}/table/v1/driving/{places}?annotations=duration,distance"
    with urlopen(address, timeout=60) as answer:
        return json.loads(answer.read())


def assert_is(table: RoadTable, stated: dict[str, Any]) -> None:
    np.testing.assert_array_equal(table.durations_s, np.array(stated["durations"], float))
    distances = np.maximum(np.array(stated["distances"], float), 0.0)
    np.testing.assert_array_equal(table.distances_m, distances)
    np.testing.assert_array_equal(table.snapped, [s["location"] for s in stated["sources"]])
    np.testing.assert_allclose(table.snap_m, [s["distance"] for s in stated["sources"]],
                               rtol=0.01, atol=0.5)


def test_table_is_what_the_server_says(osrm: Osrm, helsinki_osrm: str,
                                       helsinki_places: Places) -> None:
    places = helsinki_places(100, 0)
    table = osrm.table(places, soon())
    assert_is(table, asked_plainly(helsinki_osrm, places))
    assert 0.1 < np.isnan(table.durations_s).mean() < 0.6
    both = np.isfinite(table.durations_s) & np.isfinite(table.durations_s.T)
    assert (table.durations_s != table.durations_s.T)[both].mean() > 0.5


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("max_places", [2, 7, 24])
def test_blocks_make_the_same_table(max_places: int, osrm: Osrm, helsinki_osrm: str,
                                    helsinki_places: Places) -> None:
    places = helsinki_places(24, 1)
    engine = Osrm(RoadServer(helsinki_osrm, max_places=max_places))
    table, whole = engine.table(places, soon()), osrm.table(places, soon())
    engine.close()
    for got, wanted in zip(vars(table).values(), vars(whole).values(), strict=True):
        np.testing.assert_array_equal(got, wanted)


@pytest.mark.thorough
def test_more_places_than_the_server_takes_at_once(
        osrm: Osrm, osrm_folder: Path, helsinki_graph: Path, helsinki_places: Places) -> None:
    places = helsinki_places(230, 2)
    with served(osrm_folder, helsinki_graph, "--max-table-size", "230") as url:
        stated = asked_plainly(url, places)
    assert_is(osrm.table(places, soon()), stated)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_places(count: int, osrm: Osrm, helsinki_places: Places) -> None:
    table = osrm.table(helsinki_places(count, 3), soon())
    assert table.durations_s.shape == (count, count)
    assert (np.diag(table.durations_s) == 0).all()


def test_a_server_with_a_lower_limit_is_told(osrm_folder: Path, helsinki_graph: Path,
                                             helsinki_places: Places) -> None:
    with served(osrm_folder, helsinki_graph, "--max-table-size", "5") as url:
        engine = Osrm(RoadServer(url))
        with pytest.raises(RoadsAnswerError, match="TooBig"):
            engine.table(helsinki_places(12, 4), soon())
        engine.close()


def drivable(table: RoadTable, count: int) -> list[int]:
    """Return so many places, each with a way to the next."""
    tour = [int(np.isfinite(table.durations_s).sum(axis=1).argmax())]
    while len(tour) < count:
        left = np.setdiff1d(np.flatnonzero(np.isfinite(table.durations_s[tour[-1]])), tour)
        tour.append(int(left[np.isfinite(table.durations_s[left]).sum(axis=1).argmax()]))
    return tour


def test_route_is_made_of_the_table_s_legs(osrm: Osrm, helsinki_places: Places) -> None:
    places = helsinki_places(60, 5)
    table = osrm.table(places, soon())
    tour = drivable(table, 20)
    tour.append(tour[-1])
    route = osrm.route(places[tour], soon())
    np.testing.assert_array_equal(route.durations_s, table.durations_s[tour[:-1], tour[1:]])
    np.testing.assert_array_equal(route.distances_m, table.distances_m[tour[:-1], tour[1:]])
    legs = [polyline.decode(leg, 6, geojson=True) for leg in route.legs]
    for leg, place, following in zip(legs, tour, tour[1:], strict=False):
        np.testing.assert_allclose(leg[0], table.snapped[place], atol=2e-6)
        np.testing.assert_allclose(leg[-1], table.snapped[following], atol=2e-6)
    joined = [legs[0][0], *(point for leg in legs for point in leg[1:])]
    assert polyline.decode(route.geometry, 6, geojson=True) == joined


@pytest.mark.parametrize(("max_places", "form"), [(100, in_json), (9, in_json), (100, in_floats)])
def test_sides_of_streets_are_the_same_in_tables_and_on_routes(
        max_places: int, form: TableForm, osrm: Osrm, helsinki_osrm: str,
        helsinki_places: Places) -> None:
    places, curb = helsinki_places(40, 5), np.arange(40) % 3 > 0
    driving = Driving(("motorways",), curb)
    engine = Osrm(RoadServer(helsinki_osrm, max_places, max_points=7), form=form)
    table = engine.table(places, soon(), driving=driving)
    usual = osrm.table(places, soon())
    np.testing.assert_array_equal(table.snapped, usual.snapped)
    assert (table.durations_s != usual.durations_s).mean() > 0.2
    tour = drivable(table, 15)
    route = engine.route(places[tour], soon(), driving.among(np.array(tour)))
    engine.close()
    np.testing.assert_array_equal(route.durations_s, table.durations_s[tour[:-1], tour[1:]])
    np.testing.assert_array_equal(route.distances_m, table.distances_m[tour[:-1], tour[1:]])


def test_what_roads_were_not_prepared_to_avoid_is_refused(osrm: Osrm,
                                                          helsinki_places: Places) -> None:
    driving = Driving(("motorways", "tolls"))
    with pytest.raises(UnknownDrivingError):
        osrm.table(helsinki_places(3, 5), soon(), driving=driving)
    with pytest.raises(UnknownDrivingError):
        osrm.route(helsinki_places(3, 5), soon(), driving)


def test_route_without_a_way_is_an_error(osrm: Osrm, helsinki_places: Places) -> None:
    places = helsinki_places(60, 5)
    table = osrm.table(places, soon())
    origin, destination = np.argwhere(np.isnan(table.durations_s))[0]
    with pytest.raises(NoWayError):
        osrm.route(places[[origin, destination]], soon())


def test_server_that_is_not_there() -> None:
    engine = Osrm(RoadServer(f"http://127.0.0.1:{free_port()}"))
    with pytest.raises(RoadsUnavailableError):
        engine.table(np.array([[24.94, 60.17], [24.95, 60.17]]), soon())
    engine.close()


@pytest.mark.parametrize("url", ["localhost:5000", "ftp://localhost", "http://", "http://host/?a=1"])
def test_address_that_is_none(url: str) -> None:
    with pytest.raises(ValueError, match="roads"):
        RoadServer(url)


def test_some_legs_are_those_of_the_whole_table(osrm: Osrm, helsinki_places: Places) -> None:
    places = helsinki_places(60, 4)
    whole = osrm.table(places, soon())
    some = Block(np.array([3, 50, 7]), np.array([0, 7, 59, 21]))
    table = osrm.table(places, soon(), wanted=(some, Block(np.arange(60), np.array([0]))))
    asked = np.zeros((60, 60), bool)
    asked[np.ix_(some.origins, some.destinations)] = asked[:, 0] = True
    known = asked & np.isfinite(whole.snapped[:, :1])
    np.testing.assert_array_equal(table.durations_s[known], whole.durations_s[known])
    np.testing.assert_array_equal(table.distances_m[known], whole.distances_m[known])
    assert np.isnan(table.durations_s[~asked & ~np.eye(60, dtype=bool)]).all()


def test_a_server_that_looks_nearby_only_is_asked_to_look_farther(
        osrm: Osrm, osrm_folder: Path, helsinki_graph: Path, helsinki_places: Places) -> None:
    places = helsinki_places(20, 5)
    with served(osrm_folder, helsinki_graph, "--default-radius", "20") as url:
        strict = Osrm(RoadServer(url))
        table, route = strict.table(places, soon()), strict.route(places[:1].repeat(2, 0), soon())
        strict.close()
    np.testing.assert_array_equal(table.durations_s, osrm.table(places, soon()).durations_s)
    assert table.snap_m.max() > 20
    assert len(route.legs) == 1
