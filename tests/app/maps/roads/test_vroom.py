"""VROOM's requests on stated roads."""

import json
from typing import Any

import numpy as np
import polyline
import pytest

from app.formats.vroom.errors import ROUTING, VroomError
from app.formats.vroom.places import StatedPlaces, find_places
from app.formats.vroom.reading import read_request
from app.formats.vroom.roads import add_lines
from app.maps.roads.engine import USUAL, Driving, RoadRoute, RoadsUnavailableError
from app.maps.roads.roads import Roads
from model.problem import FloatArray
from tests.app.maps.roads.fake import StatedRoads, table_of

pytestmark = pytest.mark.slow

NAN = float("nan")


def placed(engine: StatedRoads, **changes: Any) -> StatedPlaces:
    request = {"vehicles": [{"id": 1, "start": [24.94, 60.17]}],
               "jobs": [{"id": 1, "location": [24.95, 60.17]}], **changes}
    body = json.dumps(request).encode()
    return find_places(read_request(body, 10, 10), {"car": 40.0, "bike": 36.0},
                       roads=Roads({"car": engine}))


def test_legs_are_those_of_the_profiles_roads() -> None:
    places = placed(StatedRoads(table_of([[0, 100.4], [150.6, 0]])))
    assert places.legs["car"].durations.tolist() == [[0, 100], [151, 0]]
    assert places.legs["car"].distances.tolist() == [[0, 1004], [1506, 0]]


def test_other_profiles_and_matrices_need_no_roads() -> None:
    engine = StatedRoads(RoadsUnavailableError("down"))
    by_bike = placed(engine, vehicles=[{"id": 1, "start": [24.94, 60.17], "profile": "bike"}])
    assert by_bike.legs["bike"].durations[0, 1] > 10
    placed(engine, vehicles=[{"id": 1, "start_index": 0}], jobs=[{"id": 1, "location_index": 1}],
           matrices={"car": {"durations": [[0, 1], [1, 0]]}})
    assert engine.asked == []


def test_places_without_a_way_are_a_routing_error() -> None:
    with pytest.raises(VroomError, match=r"Unfound route\(s\).*24\.95") as raised:
        placed(StatedRoads(table_of([[0, 100], [NAN, 0]])))
    assert raised.value.code == ROUTING


def test_roads_that_do_not_answer_are_a_routing_error() -> None:
    with pytest.raises(VroomError, match=r"The roads of car: They are down\.") as raised:
        placed(StatedRoads(RoadsUnavailableError("They are down.")))
    assert raised.value.code == ROUTING


def test_lines_of_routes_are_the_drives_on_roads() -> None:
    class Winding(StatedRoads):
        def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
            around = [(lat, lon + 0.001) for lon, lat in lon_lat.tolist()]
            return RoadRoute(polyline.encode(around, 6), (), np.zeros(0), np.zeros(0))

    engine = Winding(table_of([[0, 1], [1, 0]]))
    reply = {"routes": [{"vehicle": vehicle, "geometry": "straight",
                         "steps": [{"location": [24.94, 60.17]}, {"location": [24.95, 60.18]}]}
                        for vehicle in (1, 2)]}
    roads = Roads({"car": engine})
    add_lines(reply, {2: "car"}, roads, 0.0)
    straight, driven = (route["geometry"] for route in reply["routes"])
    assert straight == "straight"
    assert polyline.decode(driven) == [(60.17, 24.941), (60.18, 24.951)]
    with pytest.raises(VroomError, match="roads of car"):
        add_lines(reply, {2: "car"}, Roads({"car": StatedRoads(engine.answer)}), 0.0)
