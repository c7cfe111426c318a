"""Roads asked of a real Valhalla, by itself and through a proxy that lies."""

import json
import time
from collections.abc import Iterator
from itertools import pairwise
from typing import Any
from urllib.request import Request, urlopen

import numpy as np
import polyline
import pytest

from app.maps.roads.engine import NoWayError, RoadsAnswerError, RoadsError
from app.maps.roads.server import RoadServer
from app.maps.roads.valhalla import MAX_PLACES, MAX_POINTS, Valhalla
from model.problem import FloatArray
from tests.app.maps.roads import faults
from tests.app.maps.roads.conftest import Places
from tests.app.maps.roads.faults import Answer, Fault, Reply, proxied
from tests.app.maps.roads.test_osrm import drivable

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

FAR = (10.0, 10.0)
"""No road of Helsinki is near."""


def soon() -> float:
    """Return a time that no answer reaches, unless the machine stalls."""
    return time.perf_counter() + 60


def engine_at(url: str, max_places: int = MAX_PLACES, costing: str = "auto") -> Valhalla:
    return Valhalla(RoadServer(url, max_places, max_points=MAX_POINTS, first_wait=0.001), costing)


@pytest.fixture(scope="session")
def valhalla(helsinki_valhalla: str) -> Iterator[Valhalla]:
    engine = engine_at(helsinki_valhalla)
    yield engine
    engine.close()


def asked_plainly(url: str, lon_lat: FloatArray, costing: str) -> list[list[dict[str, Any]]]:
    places = [{"lon": longitude, "lat": latitude} for longitude, latitude in lon_lat.tolist()]
    body = {"sources": places, "targets": places, "costing": costing}
    request = Request(f"{url}/sources_to_targets", json.dumps(body).encode())
    with urlopen(request, timeout=60) as answer:
        return json.loads(answer.read())["sources_to_targets"]


@pytest.mark.parametrize("costing", ["auto", "truck", "bicycle"])
def test_table_is_what_the_server_says(costing: str, helsinki_valhalla: str,
                                       helsinki_places: Places) -> None:
    places = helsinki_places(50, 1)
    engine = engine_at(helsinki_valhalla, costing=costing)
    table = engine.table(places, soon())
    engine.close()
    stated = asked_plainly(helsinki_valhalla, places, costing)
    others = ~np.eye(50, dtype=bool)
    for got, name, unit in ((table.durations_s, "time", 1), (table.distances_m, "distance", 1000)):
        wanted = np.array([[leg[name] for leg in row] for row in stated], float) * unit
        np.testing.assert_allclose(got[others], wanted[others])
        assert (np.diag(got) == 0).all()
    assert (table.snap_m < 250).all()


def test_blocks_make_about_the_same_table(valhalla: Valhalla, helsinki_valhalla: str,
                                          helsinki_places: Places) -> None:
    places = helsinki_places(20, 2)
    engine = engine_at(helsinki_valhalla, max_places=7)
    table, whole = engine.table(places, soon()), valhalla.table(places, soon())
    engine.close()
    np.testing.assert_array_equal(table.snapped, whole.snapped)
    # What Valhalla finds depends a little on what else is asked for.
    assert (table.durations_s != whole.durations_s)[np.isfinite(whole.durations_s)].mean() < 0.05
    np.testing.assert_allclose(table.durations_s, whole.durations_s, atol=60)


def test_more_places_than_the_server_takes_at_once(valhalla: Valhalla,
                                                   helsinki_places: Places) -> None:
    table = valhalla.table(helsinki_places(70, 1), soon())
    assert 0.05 < np.isnan(table.durations_s).mean() < 0.6
    assert (np.diag(table.durations_s) == 0).all()


def test_place_off_the_map_has_no_ways_and_the_others_have_theirs(
        valhalla: Valhalla, helsinki_places: Places) -> None:
    places = helsinki_places(8, 3)
    places[3] = FAR
    table = valhalla.table(places, soon())
    assert np.isnan(table.snap_m).tolist() == [place == 3 for place in range(8)]
    assert np.isnan(table.durations_s[3]).all()
    assert np.isnan(table.distances_m[:, 3]).all()
    others = np.delete(np.arange(8), 3)
    expected = valhalla.table(places[others], soon())
    np.testing.assert_array_equal(table.durations_s[np.ix_(others, others)], expected.durations_s)


@pytest.mark.parametrize("count", [0, 1])
def test_few_places(count: int, valhalla: Valhalla, helsinki_places: Places) -> None:
    assert valhalla.table(helsinki_places(count, 4), soon()).durations_s.shape == (count, count)


def test_no_place_on_the_map(valhalla: Valhalla) -> None:
    table = valhalla.table(np.array([FAR, (11.0, 11.0)]), soon())
    assert np.isnan(table.durations_s).all()


def test_block_without_any_way(helsinki_valhalla: str, helsinki_places: Places) -> None:
    unconnected = b'{"error_code":170,"error":"Locations are in unconnected regions."}'

    def refused(reply: Reply) -> None:
        if b"sources_to_targets" in reply.body:
            reply.status = 400
            reply.replace(unconnected)

    with proxied(helsinki_valhalla, lambda: refused) as proxy:
        engine = engine_at(proxy.url)
        table = engine.table(helsinki_places(4, 2), soon())
        engine.close()
    np.testing.assert_array_equal(table.durations_s, np.where(np.eye(4), 0.0, np.nan))
    assert np.isfinite(table.snap_m).all()


def test_route_is_made_of_the_table_s_legs(valhalla: Valhalla, helsinki_places: Places) -> None:
    places = helsinki_places(45, 5)
    table = valhalla.table(places, soon())
    tour = drivable(table, 25)
    route = valhalla.route(places[tour], soon())
    # Tables hold whole seconds and metres, and are searched for in another way.
    np.testing.assert_allclose(route.durations_s, table.durations_s[tour[:-1], tour[1:]], atol=10)
    np.testing.assert_allclose(route.distances_m, table.distances_m[tour[:-1], tour[1:]], atol=70)
    assert len(route.legs) == 24
    legs = [polyline.decode(leg, 6, geojson=True) for leg in route.legs]
    for leg, following in pairwise(legs):
        np.testing.assert_allclose(leg[-1], following[0], atol=2e-3)
    assert polyline.decode(route.geometry, 6, geojson=True)[-1] == legs[-1][-1]


def test_route_without_a_way_is_an_error(valhalla: Valhalla, helsinki_places: Places) -> None:
    with pytest.raises(NoWayError):
        valhalla.route(np.array([helsinki_places(1, 5)[0], (24.0, 60.0)]), soon())


def test_map_tells_when_it_was_made(valhalla: Valhalla) -> None:
    assert int(valhalla.build()) > 1_700_000_000


def test_limits_of_the_server_are_told(helsinki_valhalla: str, helsinki_places: Places) -> None:
    engine = engine_at(helsinki_valhalla, max_places=60)
    with pytest.raises(RoadsAnswerError, match="Exceeded max locations"):
        engine.table(helsinki_places(60, 5), soon())
    engine.close()


def of_table(change: Fault) -> Fault:
    """Spoil answers with a table alone, not those on where places lie."""
    return lambda reply: change(reply) if b"sources_to_targets" in reply.body else None


def in_table(change: Any) -> Fault:
    return of_table(faults.changed(lambda answer: change(answer["sources_to_targets"])))


def in_spots(change: Any) -> Fault:
    def fault(reply: Reply) -> None:
        if b"sources_to_targets" not in reply.body:
            faults.changed(change)(reply)
    return fault


def units(answer: Answer) -> None:
    answer["units"] = "miles"


WRONG: dict[str, Fault] = {
    "miles": of_table(faults.changed(units)),
    "a row less": in_table(lambda table: table["durations"].pop()),
    "a column less": in_table(lambda table: table["distances"][0].pop()),
    "half a way": in_table(lambda table: table["durations"][0].__setitem__(0, "1")),
    "less than nothing": in_table(lambda table: table["durations"].__setitem__(
        0, [-1] * len(table["durations"][0]))),
    "no distance": in_table(lambda table: table.update(
        distances=[[0.0] * len(row) for row in table["distances"]])),
    "other places": in_spots(lambda spots: spots.reverse()),
    "a place less": in_spots(lambda spots: spots.pop()),
    "no places": in_spots(lambda spots: spots.clear()),
    "half a spot": in_spots(lambda spots: spots[0]["edges"][0].pop("correlated_lat")),
    "other spots": in_spots(lambda spots: [
        edge.update(correlated_lon=edge["correlated_lon"] + 0.2)
        for edge in spots[0]["edges"]]),
    "a page": faults.body(b"<html>Sign in</html>"),
    "status 400": faults.status(400),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_answer_is_an_error(name: str, helsinki_valhalla: str,
                                  helsinki_places: Places) -> None:
    with proxied(helsinki_valhalla, lambda: WRONG[name]) as proxy:
        engine = engine_at(proxy.url)
        with pytest.raises(RoadsError):
            engine.table(helsinki_places(6, 2), soon())
        engine.close()
