"""What plans are made of: legs by stated roads, computed by hand."""

import json
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from app.maps.remote.asking import ShouldStop
from app.maps.roads.engine import (
    USUAL, Block, Driving, RoadEngine, RoadTable, RoadsAnswerError, RoadsStoppedError,
    RoadsUnavailableError,
)
from app.maps.roads.openrouteservice import OpenRouteService
from app.maps.roads.roads import Roads
from app.maps.roads.server import RoadServer
from app.maps.roads.valhalla import Valhalla
from app.plans.task import Task, task_of
from app.requests.bounds import Bounds, leg_errors
from app.requests.conversion.preparing import Preparing, StoppedError
from app.requests.ends import stated_path
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError, NoRoadsError
from model.problem import UNREACHABLE, FloatArray
from tests.app.maps.roads.fake import StatedRoads, table_of

pytestmark = pytest.mark.slow

NAN = float("nan")
DURATIONS = [[0, 100, 200], [150, 0, 300], [250, 350, 0]]
DEGREE_M = 111_195  # of latitude


def request(*, customers: int = 2, **changes: Any) -> dict[str, Any]:
    """Return a depot and customers, a thousandth of a degree of latitude from each to the next."""
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "d", "location": [25.0, 60.0]}],
        "customers": [{"id": str(number), "location": [25.0, 60.0 + number / 1000], "demand": [1]}
                      for number in range(1, customers + 1)],
        "fleet": [{"id": "t", "count": 1, "capacity": [10]}],
        **changes,
    }


def planned(stated: dict[str, Any], engine: StatedRoads | None, profile: str = "truck",
            preparing: Preparing | None = None) -> Task:
    roads = Roads({} if engine is None else {profile: engine})
    return task_of(read_request(json.dumps(stated).encode(), None), preparing or Preparing(),
                   roads=roads)


def durations(task: Task, vehicle_type: int = 0) -> list[list[float]]:
    kind = task.problem.vehicle_types[vehicle_type]
    return (task.problem.travel[kind.travel].duration[:] / 1000).tolist()


def distances(task: Task) -> list[list[float]]:
    return (task.problem.travel[task.problem.vehicle_types[0].travel].distance[:] / 1000).tolist()


def told(task: Task) -> tuple[Any, ...]:
    legs = task.legs[0]
    return legs.profile, legs.by, legs.engine, legs.estimated


def test_trucks_drive_on_roads_whatever_their_speed() -> None:
    stated = request(fleet=[{"id": "t", "count": 1, "capacity": [10], "speed_kmh": 7},
                            {"id": "u", "count": 1, "capacity": [10], "speed_kmh": 90}])
    engine = StatedRoads(table_of(DURATIONS))
    task = planned(stated, engine)
    assert durations(task) == durations(task, 1) == DURATIONS
    assert distances(task) == [[10 * leg for leg in row] for row in DURATIONS]
    assert len(task.problem.travel) == len(engine.asked) == len(task.legs) == 1
    assert told(task) == ("truck", "roads", "stated", 0)


def test_ways_between_places_and_roads_are_walked() -> None:
    engine = StatedRoads(table_of(DURATIONS, [0, 50, 100]))
    task = planned(request(roads={"walking_kmh": 3.6}), engine)
    assert durations(task) == [[0, 150, 300], [200, 0, 450], [350, 500, 0]]
    assert distances(task)[0] == [0, 1000, 2000]
    assert task.legs[0].farthest_from_road_m == 100
    usual = durations(planned(request(), engine))
    assert usual[0][1:] == [136, 272]  # at 5 km/h


def test_speeds_by_time_of_day_scale_the_roads() -> None:
    slow = [{"from": 0, "factor": 0.5}, {"from": 3600, "factor": 1.0}]
    stated = request(fleet=[{"id": "t", "count": 1, "capacity": [10], "speed_profile": slow}])
    with_roads = planned(stated, StatedRoads(table_of(DURATIONS)))
    matrices = {"truck": {"durations": DURATIONS,
                          "distances": [[10 * leg for leg in row] for row in DURATIONS]}}
    places = [dict(place, location_index=number) for number, place
              in enumerate([*stated["depots"], *stated["customers"]])]
    stated |= {"matrices": matrices, "depots": places[:1], "customers": places[1:]}
    with_matrix = planned(stated, None)
    assert durations(with_roads) == durations(with_matrix)
    kinds = [task.problem.vehicle_types[0] for task in (with_roads, with_matrix)]
    assert kinds[0].speed_profile == kinds[1].speed_profile
    assert kinds[0].speed_profile is not None
    assert told(with_matrix) == ("truck", "matrix", None, 0)


def test_profiles_with_roads_count_as_ways_to_travel_of_their_own() -> None:
    fleet = [{"id": profile, "profile": profile, "count": 1, "capacity": [10]}
             for profile in ("car", "van", "truck")]
    for on_roads, most in ((False, 9), (True, 27)):
        for stated, legs in ((request(fleet=fleet), most),
                             (request(fleet=fleet, roads="none"), 9)):
            read = read_request(json.dumps(stated).encode(), None)
            assert list(leg_errors(read, Bounds(legs=legs, on_roads=on_roads))) == []
            assert list(leg_errors(read, Bounds(legs=legs - 1, on_roads=on_roads))) != []


def test_drones_fly_straight() -> None:
    drones = {"count": 1, "capacity": [5], "speed_kmh": 36, "endurance": 1000}
    stated = request(fleet=[{"id": "t", "count": 1, "capacity": [10], "drones": drones}])
    task = planned(stated, StatedRoads(table_of(DURATIONS)))
    kind = task.problem.vehicle_types[0]
    assert kind.drones is not None
    flights = task.problem.travel[kind.drones.travel].duration
    assert flights[0, 1] == pytest.approx(DEGREE_M / 1000 / 10 * 1000, rel=1e-3)
    assert [(legs.profile, legs.by) for legs in task.legs] == [("truck", "roads"),
                                                              ("drone", "flight")]


def test_all_that_counts_as_customers_has_a_side_of_the_street() -> None:
    stated = request(roads={"approach": "curb"}, shipments=[{
        "id": "s", "amount": [1], "pickup": {"location": [25.0, 60.0], "approach": "any"},
        "delivery": {"location": [25.0, 60.0]}}])
    stated["customers"][0] |= {"approach": "any", "alternatives": [
        {"id": "a", "location": [25.0, 60.0]},
        {"id": "b", "location": [25.0, 60.0], "approach": "curb"}]}
    engine = StatedRoads(table_of(np.zeros((7, 7)).tolist()))
    planned(stated, engine)
    curb = engine.driving[0].curb
    assert curb is not None
    # Depot, both customers, the first one's other places, and both ends.
    assert curb.tolist() == [False, False, True, False, True, False, True]


@pytest.mark.parametrize("make", [Valhalla, OpenRouteService])
@pytest.mark.parametrize(("changes", "path"), [
    ({"roads": {"approach": "curb"}}, "$.roads.approach"),
    ({"shipments": [{"id": "s", "amount": [1], "pickup": {"location": [25.0, 60.0]},
                     "delivery": {"location": [25.0, 60.0], "approach": "curb"}}]},
     "$.shipments[0].delivery.approach"),
    ({"fleet": [{"id": "t", "count": 1, "capacity": [10]},
                {"id": "u", "count": 1, "capacity": [10], "avoid": ["tolls"]}]},
     "$.fleet[1].avoid"),
])
def test_servers_that_know_neither_are_not_asked(
        make: Callable[[RoadServer], RoadEngine], changes: dict[str, Any], path: str) -> None:
    engine = make(RoadServer("http://127.0.0.1:9"))
    roads = Roads({"truck": engine})
    if "fleet" in changes:
        changes["fleet"][0]["profile"] = "van"
    stated = read_request(json.dumps(request(**changes)).encode(), None)
    with pytest.raises(InvalidRequestError) as raised:
        task_of(stated, Preparing(), roads=roads)
    error, = raised.value.errors
    assert (error.code, stated_path(stated, error.path)) == ("ROADS_WITHOUT_THAT", path)
    engine.close()


@pytest.mark.parametrize(("changes", "by", "words"), [
    ({"roads": "none"}, "great_circle", "as the request's roads ask"),
    ({"fleet": [{"id": "t", "count": 1, "capacity": [1], "profile": "van"}]}, "great_circle",
     "TANDEM_ROADS"),
    ({"coordinate_system": "planar"}, "straight", None),
])
def test_without_roads_for_it_driving_is_as_the_crow_flies(changes: dict[str, Any], by: str,
                                                           words: str | None) -> None:
    engine = StatedRoads(table_of(DURATIONS))
    task = planned(request(**changes), engine)
    assert engine.asked == []
    assert task.legs[0].by == by
    assert words is None or words in (task.legs[0].note or "")
    assert durations(task) == durations(planned(request(**changes), None))


def test_places_off_the_roads_are_named_all_at_once() -> None:
    table = [[0, 1, NAN, 1, 1], [1, 0, NAN, 1, 1], [1, 1, 0, 1, 1], [1, 1, 1, 0, 1],
             [1, 1, 1, 1, 0]]
    engine = StatedRoads(table_of(table, [0, 2001, 12, NAN, 2000]))
    with pytest.raises(InvalidRequestError) as raised:
        planned(request(customers=4), engine)
    assert [(error.code, error.path) for error in raised.value.errors] == [
        ("PLACE_OFF_ROADS", f"$.customers[{number}].location") for number in (0, 1, 2)]
    far, island, nowhere = [error.message for error in raised.value.errors]
    assert "2001 m away" in far
    assert "12 m away, has no way to or from the first depot" in island
    assert "No road for 'truck' is near" in nowhere
    assert all("served_by" in message and "roads.fallback" in message
               for message in (far, island, nowhere))


def test_depots_and_ends_off_the_roads_are_named_too() -> None:
    stated = request(customers=1)
    stated["depots"].append({"id": "e", "location": [25.0, 60.01]})
    stated["fleet"][0] |= {"start_location": [25.0, 60.02],
                           "end": {"location": [25.0, 60.03]}}
    table = np.ones((5, 5))
    engine = StatedRoads(table_of(table.tolist(), [0, 9999, 9999, 9999, 0]))
    with pytest.raises(InvalidRequestError) as raised:
        planned(stated, engine)
    assert [error.path for error in raised.value.errors] == [
        "$.depots[1].location", "$.fleet[0].start_location", "$.fleet[0].end.location"]


def test_a_first_depot_off_the_roads_is_why_nothing_is_reached() -> None:
    engine = StatedRoads(table_of(DURATIONS, [5000, 0, 0]))
    with pytest.raises(InvalidRequestError) as raised:
        planned(request(), engine)
    assert "5000 m away" in raised.value.errors[0].message
    assert "first depot is off the roads" in raised.value.errors[1].message


def test_whom_only_drones_serve_needs_no_road() -> None:
    stated = request()
    stated["customers"][1]["served_by"] = "drone"
    task = planned(stated, StatedRoads(table_of([[0, 100, NAN], [150, 0, NAN], [NAN, NAN, 0]],
                                                [0, 0, NAN])))
    assert [row[:2] for row in durations(task)[:2]] == [[0, 100], [150, 0]]
    assert told(task) == ("truck", "roads", "stated", 0)
    assert np.array(durations(task)).max() < UNREACHABLE / 1000


def test_between_places_without_a_way_there_is_that_by_the_first_depot() -> None:
    table = [[0, 100, 200], [150, 0, NAN], [250, 350, 0]]
    task = planned(request(), StatedRoads(table_of(table, [10, 0, 50])))
    assert durations(task)[1][2] == 150 + 200 + 50 * 0.72
    assert distances(task)[1][2] == 1500 + 2000


def test_legs_may_be_estimated_where_the_request_says_so() -> None:
    table = [[0, 100, NAN], [150, 0, NAN], [250, 350, 0]]
    stated = request(roads={"fallback": "great_circle", "detour": 1.5})
    stated["fleet"][0]["speed_kmh"] = 36
    task = planned(stated, StatedRoads(table_of(table, [0, 0, 77])))
    seconds = np.array(durations(task))
    assert seconds[:2, :2].tolist() == [[0, 100], [150, 0]]
    away = DEGREE_M / 1000 * 1.5
    assert seconds[0, 2] == seconds[2, 0] == pytest.approx(2 * away / 10, rel=1e-3)
    assert seconds[1, 2] == pytest.approx(away / 10, rel=1e-3)
    assert distances(task)[2][1] == pytest.approx(away, rel=1e-3)
    assert told(task) == ("truck", "roads", "stated", 4)
    assert task.legs[0].detour == 1.5
    assert task.legs[0].farthest_from_road_m == 0
    assert "1 place off the roads" in (task.legs[0].note or "")


@pytest.mark.parametrize("error", [RoadsUnavailableError("They are down."),
                                   RoadsAnswerError("They lie.")])
def test_roads_that_fail_are_an_error_or_estimated(error: Exception) -> None:
    with pytest.raises(NoRoadsError, match=r"They (are down|lie)") as raised:
        planned(request(), StatedRoads(error))
    assert raised.value.status == 503
    task = planned(request(roads={"fallback": "great_circle"}), StatedRoads(error))
    assert durations(task)[0][1] == pytest.approx(DEGREE_M / 1000 * 1.3 / 40 * 3.6, rel=1e-3)
    assert told(task) == ("truck", "roads", "stated", 6)
    assert str(error) in (task.legs[0].note or "")


def late() -> RoadsUnavailableError:
    """Return what roads fail with that have too little time."""
    error = RoadsUnavailableError("They are late.")
    error.is_late = True
    return error


def test_roads_are_part_of_the_time_limit() -> None:
    hurried = Preparing(began=-1e9, seconds=1.0)
    with pytest.raises(InvalidRequestError, match="1 error") as raised:
        planned(request(), StatedRoads(late()), preparing=hurried)
    assert raised.value.errors[0].code == "TOO_MUCH_WORK"


def test_who_has_too_little_time_for_roads_is_told_what_to_do() -> None:
    class Slow(StatedRoads):
        def table(self, lon_lat: FloatArray, until: float,
                  should_stop: ShouldStop = lambda: False,
                  wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
            while time.perf_counter() < until:
                pass
            raise late()

    hurried = Preparing(seconds=0.05, limit="the time_limit of 0.05 s", least_time=0.2)
    with pytest.raises(InvalidRequestError) as raised:
        planned(request(), Slow(table_of(DURATIONS)), preparing=hurried)
    (error,) = raised.value.errors
    assert (error.code, error.path) == ("TOO_MUCH_WORK", "$.options.time_limit")
    assert "between 3 places within 0.2 s" in error.message
    assert "submit a job" in error.message


def test_nobody_waits_for_roads_in_vain() -> None:
    with pytest.raises(StoppedError):
        planned(request(), StatedRoads(RoadsStoppedError("stopped")))
