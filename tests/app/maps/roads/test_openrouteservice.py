"""Roads of openrouteservice, which can't be started here: something stands in for it that answers
as its documentation says and as answers that others have published look.
"""

import json
import time
from typing import Any

import numpy as np
import polyline
import pytest

from app.maps.roads.engine import NoWayError, RoadsAnswerError, RoadsError, RoadsUnavailableError
from app.maps.roads.openrouteservice import OpenRouteService
from app.maps.roads.server import RoadServer
from model.problem import FloatArray
from tests.app.maps.roads import faults
from tests.app.maps.roads.faults import Answer, Fault, Proxy, standing_in

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

PLACES = np.array([[8.681495, 49.41461], [8.686507, 49.41943], [8.687872, 49.420318]])
SNAPPED = ([8.681496, 49.414601], [8.686507, 49.41943], [8.687872, 49.420318])
SNAP_M = (1.0, 0.02, 0.05)
DURATIONS = [[0.0, 139.94, 160.95], [161.79, 0.0, 21.01], [182.8, 21.01, 0.0]]
DISTANCES = [[0.0, 815.19, 961.26], [906.3, 0.0, 146.07], [1052.37, 146.07, 0.0]]

LINE = [(49.4146, 8.6815), (49.4181, 8.6829), (49.41943, 8.68651), (49.42032, 8.68787)]


def matrix(body: bytes) -> Answer:
    asked = json.loads(body)
    assert asked["metrics"] == ["duration", "distance"]
    assert asked["units"] == "m"
    places = [int(np.abs(PLACES - place).sum(axis=1).argmin()) for place in asked["locations"]]
    origins, destinations = ([places[int(index)] for index in asked[part]]
                             for part in ("sources", "destinations"))
    spots: dict[str, Any] = {
        part: [{"location": SNAPPED[place], "name": "Straße", "snapped_distance": SNAP_M[place]}
               for place in listed]
        for part, listed in (("sources", origins), ("destinations", destinations))}
    return {"durations": [[DURATIONS[i][j] for j in destinations] for i in origins],
            "distances": [[DISTANCES[i][j] for j in destinations] for i in origins], **spots,
            "metadata": {"attribution": "openrouteservice.org | OpenStreetMap contributors",
                         "service": "matrix", "timestamp": 1700000000000,
                         "engine": {"version": "9.2.0", "graph_date": "2025-05-21T13:48:51Z"}}}


def directions(body: bytes) -> Answer:
    points = len(json.loads(body)["coordinates"])
    segments: list[Answer] = [{"distance": 815.2, "duration": 139.9, "steps": []},
                              {"distance": 146.1, "duration": 21.0, "steps": []},
                              {"steps": []}]
    way_points = [0, 2, 3, 3]
    last = way_points[points - 1]
    return {"bbox": [8.68, 49.41, 8.69, 49.43],
            "routes": [{"summary": {"distance": 961.3, "duration": 160.9},
                        "segments": segments[:points - 1],
                        "bbox": [8.68, 49.41, 8.69, 49.43],
                        "geometry": polyline.encode(LINE[:last + 1], 5),
                        "way_points": way_points[:points]}],
            "metadata": {"service": "routing"}}


def answered(method: str, path: str, body: bytes) -> tuple[int, bytes]:
    answers = {"/ors/v2/matrix/driving-hgv": matrix,
               "/ors/v2/directions/driving-hgv/json": directions}
    if method != "POST" or path not in answers:
        return 404, b'{"timestamp":1700000000000,"status":404,"error":"Not Found"}'
    return 200, json.dumps(answers[path](body)).encode()


def soon() -> float:
    """Return a time that no answer reaches, unless the machine stalls."""
    return time.perf_counter() + 60


def engine_at(proxy: Proxy, max_places: int = 50, max_points: int = 50,
              profile: str = "driving-hgv") -> OpenRouteService:
    return OpenRouteService(
        RoadServer(f"{proxy.url}/ors", max_places, max_points=max_points, first_wait=0.001,
                   headers={"Authorization": "5b3ce3"}), profile)


@pytest.mark.parametrize("max_places", [50, 2, 1])
def test_table_is_what_the_server_says(max_places: int) -> None:
    with standing_in(answered, lambda: faults.nothing) as proxy:
        engine = engine_at(proxy, max_places)
        table = engine.table(PLACES, soon())
        engine.close()
    assert proxy.fields["authorization"] == "5b3ce3"
    np.testing.assert_array_equal(table.durations_s, DURATIONS)
    np.testing.assert_array_equal(table.distances_m, DISTANCES)
    np.testing.assert_array_equal(table.snapped, SNAPPED)
    np.testing.assert_allclose(table.snap_m, SNAP_M, atol=0.1)


@pytest.mark.parametrize("max_points", [50, 2])
def test_route_has_the_legs_that_the_server_says(max_points: int) -> None:
    with standing_in(answered, lambda: faults.nothing) as proxy:
        engine = engine_at(proxy, max_points=max_points)
        route = engine.route(PLACES[[0, 1, 2, 2]][: 4 if max_points > 2 else 2], soon())
        engine.close()
    legs = len(route.legs)
    np.testing.assert_array_equal(route.distances_m, [815.2, 146.1, 0.0][:legs])
    np.testing.assert_array_equal(route.durations_s, [139.9, 21.0, 0.0][:legs])
    lines = [LINE[:3], LINE[2:], LINE[3:]][:legs]
    assert [polyline.decode(leg, 6) for leg in route.legs] == lines
    assert polyline.decode(route.geometry, 6) == LINE[:4 if legs > 1 else 3]


def no_way(answer: Answer) -> None:
    answer["durations"][0][1] = answer["distances"][0][1] = None


def off_the_road(answer: Answer) -> None:
    answer["sources"][2] = answer["destinations"][2] = None
    for numbers in (answer["durations"], answer["distances"]):
        numbers[2] = [None] * 3
        for row in numbers:
            row[2] = None


def test_no_way_is_nan() -> None:
    with standing_in(answered, lambda: faults.changed(no_way)) as proxy:
        engine = engine_at(proxy)
        table = engine.table(PLACES, soon())
        engine.close()
    assert np.argwhere(np.isnan(table.durations_s)).tolist() == [[0, 1]]


def test_place_off_the_road_has_no_ways() -> None:
    with standing_in(answered, lambda: faults.changed(off_the_road)) as proxy:
        engine = engine_at(proxy)
        table = engine.table(PLACES, soon())
        engine.close()
    assert np.isnan(table.snap_m).tolist() == [False, False, True]
    assert np.isfinite(table.durations_s).sum() == 4


def refused(status: int, code: int, message: str | None) -> Fault:
    text = json.dumps({"error": {"code": code, "message": message}, "info": {}}).encode()

    def fault(reply: faults.Reply) -> None:
        reply.status = status
        reply.replace(text)
    return fault


@pytest.mark.parametrize(("fault", "error", "words"), [
    (refused(400, 6004, "Request parameters exceed the server configuration limits."),
     RoadsAnswerError, "6004 .'Request parameters exceed"),
    (refused(404, 2010, "Could not find routable point within a radius of 350.0 meters"),
     NoWayError, "No road"),
    (refused(404, 2099, None), RoadsAnswerError, "2099"),
    (faults.status(403), RoadsUnavailableError, "403"),
    (faults.status(429), RoadsUnavailableError, "429"),
    (faults.body(b'{"durations":[[0]]}'), RoadsAnswerError, "nonsense"),
])
def test_refusals(fault: Fault, error: type[RoadsError], words: str) -> None:
    with standing_in(answered, lambda: fault) as proxy:
        engine = engine_at(proxy)
        with pytest.raises(error, match=words):
            engine.table(PLACES, soon())
        engine.close()


def test_profile_that_the_server_lacks() -> None:
    with standing_in(answered, lambda: faults.nothing) as proxy:
        engine = engine_at(proxy, profile="driving-car")
        with pytest.raises(RoadsAnswerError, match="404"):
            engine.table(PLACES, soon())
        engine.close()


WRONG_ROUTES: dict[str, Any] = {
    "a segment less": lambda route: route["segments"].pop(),
    "a point less": lambda route: route["way_points"].pop(),
    "points in another order": lambda route: route.update(way_points=[0, 9, 3]),
    "a line cut": lambda route: route.update(geometry=route["geometry"][:-1]),
    "no line": lambda route: route.update(geometry=""),
    "off the globe": lambda route: route.update(geometry=polyline.encode([(99.0, 200.0)] * 4, 5)),
    "less than nothing": lambda route: route["segments"][0].update(distance=-815.2),
    "no number": lambda route: route["segments"][0].update(duration=float("nan")),
}


@pytest.mark.parametrize("name", WRONG_ROUTES)
def test_wrong_route_is_an_error(name: str) -> None:
    wrong = faults.changed(lambda answer: WRONG_ROUTES[name](answer["routes"][0]))
    with standing_in(answered, lambda: wrong) as proxy:
        engine = engine_at(proxy)
        with pytest.raises(RoadsAnswerError):
            engine.route(PLACES, soon())
        engine.close()


def spread(count: int) -> FloatArray:
    return np.column_stack([np.linspace(8.0, 9.0, count), np.full(count, 49.0)])


def test_no_more_is_asked_at_once_than_the_server_takes() -> None:
    asked: list[Answer] = []

    def counted(method: str, path: str, body: bytes) -> tuple[int, bytes]:
        asked.append(json.loads(body))
        return 500, b""

    with standing_in(counted, lambda: faults.nothing) as proxy:
        engine = engine_at(proxy)
        with pytest.raises(RoadsUnavailableError):
            engine.table(spread(120), soon())
        with pytest.raises(RoadsUnavailableError):
            engine.route(spread(120), soon())
        engine.close()
    tables = [question for question in asked if "sources" in question]
    routes = [question for question in asked if "coordinates" in question]
    assert max(len(question["sources"]) for question in tables) <= 50
    assert max(len(question["coordinates"]) for question in routes) <= 50
