"""Breaks of drivers, over HTTP."""

from typing import Any

import httpx
import pytest

from app.plans.pictures.drawing import draw_svg
from tests.app.plans.asking import judged, planned
from tests.app.plans.pictures.conftest import scene_of
from tests.app.plans.test_hubs import is_feasible

Request = dict[str, Any]

NOON = {"id": "lunch", "duration": 1800, "start": {"earliest": 600, "latest": 1200},
        "after_departure": True}


@pytest.fixture
def resting(smallest: Request) -> Request:
    """Return a request whose only vehicle has a break while it serves."""
    smallest["options"] = {"time_limit": 60, "search_iterations": 300}
    smallest["fleet"][0] |= {"count": 1, "breaks": [NOON], "costs": {"per_km": 1, "per_hour": 10},
}
    for customer in smallest["customers"]:
        customer["service_duration"] = 900
    return smallest


def breaks_of(plan: Request) -> list[Request]:
    """Return all breaks."""
    return [stop for route in plan["routes"] for trip in route["trips"] for stop in trip["stops"]
            if stop["kind"] == "break"]


def test_a_break_is_a_stop_and_passes_the_check(service: httpx.Client, resting: Request) -> None:
    plan = planned(service, resting)
    assert plan["status"] == "complete"
    lunch, = breaks_of(plan)
    assert lunch["id"] == "lunch"
    assert 600 <= lunch["service_start"] <= 1200
    assert lunch["departure"] - lunch["service_start"] == 1800
    assert is_feasible(service, resting, plan)
    for trip in (trip for route in plan["routes"] for trip in route["trips"]):
        trip["stops"] = [stop for stop in trip["stops"] if stop["kind"] != "break"]
    assert not is_feasible(service, resting, plan)


def test_a_break_is_taken_once_little_is_aboard(service: httpx.Client, resting: Request) -> None:
    most = min(customer["demand"][0] for customer in resting["customers"])
    start = {"earliest": 0, "latest": 1800}
    resting["fleet"][0]["breaks"] = [NOON | {"start": start, "max_load": [most]}]
    light = planned(service, resting)
    assert light["status"] == "complete"
    stops = [stop for route in light["routes"] for trip in route["trips"] for stop in trip["stops"]]
    place = [stop["kind"] for stop in stops].index("break")
    assert stops[place - 1]["load"] == [most]
    assert is_feasible(service, resting, light)
    resting["fleet"][0]["breaks"][0]["max_load"] = [most - 1]
    assert not is_feasible(service, resting, light)


def test_a_break_counts_in_working_duration_if_it_is_paid(service: httpx.Client,
                                                          resting: Request) -> None:
    paid = planned(service, resting)
    resting["fleet"][0]["breaks"] = [NOON | {"paid": False}]
    unpaid = planned(service, resting)
    route, = unpaid["routes"]
    stops = [stop for trip in route["trips"] for stop in trip["stops"]]
    assert route["working_duration"] == pytest.approx(
        stops[-1]["departure"] - stops[0]["departure"] - 1800)
    assert unpaid["cost"]["total"] < paid["cost"]["total"]


def test_a_break_is_left_out_that_begins_once_the_route_has_ended(service: httpx.Client,
                                                                  resting: Request) -> None:
    resting["fleet"][0]["breaks"] = [NOON | {"start": {"earliest": 600}}]
    assert breaks_of(planned(service, resting)) == []


def test_pictures_and_lines_show_plans_with_breaks(service: httpx.Client, resting: Request) -> None:
    resting["options"] |= {"geometry": True}
    plan = planned(service, resting)
    assert all("geometry" in stop for route in plan["routes"] for trip in route["trips"]
               for stop in trip["stops"][1:] if stop["kind"] != "break")
    assert b"Break" in draw_svg(scene_of(resting, plan))


@pytest.mark.parametrize(("changes", "code", "path"), [
    ({"start": {"earliest": 9, "latest": 8}}, "WINDOW_ENDS_BEFORE_START",
     "$.fleet[0].breaks[0].start.latest"),
    ({"duration": -1}, "OUT_OF_RANGE", "$.fleet[0].breaks[0].duration"),
    ({"max_load": [1, 2]}, "DIMENSION_MISMATCH", "$.fleet[0].breaks[0].max_load"),
    ({"at": "home"}, "UNKNOWN_VALUE", "$.fleet[0].breaks[0].at")])
def test_wrong_breaks_are_told(service: httpx.Client, resting: Request, changes: Request, code: str,
                               path: str) -> None:
    resting["fleet"][0]["breaks"] = [NOON | changes]
    error, = service.post("/plan", json=resting).json()["errors"]
    assert (error["code"], error["path"]) == (code, path)


def test_a_trip_with_breaks_that_has_begun_is_made_to_its_end(service: httpx.Client,
                                                              resting: Request) -> None:
    resting["fleet"][0]["max_trips"] = 2
    plan = planned(service, resting)
    assert breaks_of(planned(service, resting | {"replan": {"plan": plan}})) == breaks_of(plan)
    trip, = (trip for route in plan["routes"] for trip in route["trips"])
    begun = resting | {"replan": {"plan": plan, "freeze_before": trip["stops"][0]["departure"] + 1}}
    new = {"id": "new", "location": [1, 1], "demand": [1]}
    later = planned(service, begun | {"customers": [*resting["customers"], new]})
    assert (later["status"], later["routes"][0]["trips"][0]) == ("complete", trip)
    assert breaks_of(later) == breaks_of(plan)
    gone = service.post("/plan", json=begun | {"customers": resting["customers"][1:]}).json()
    assert {error["code"] for error in gone["errors"]} == {"UNKNOWN_CUSTOMER"}


def test_a_driver_at_the_depot_has_a_break_while_the_only_drone_flies(
        service: httpx.Client) -> None:
    request = {
        "coordinate_system": "planar", "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "a", "location": [30, 0], "demand": [1], "served_by": "drone"}],
        "fleet": [{"id": "van", "count": 1, "capacity": [3], "speed_kmh": 60,
                   "breaks": [{"id": "nap", "duration": 900, "after_departure": True,
                               "start": {"earliest": 600, "latest": 1200}}],
                   "drones": {"count": 1, "capacity": [1], "speed_kmh": 60, "endurance": 7200}}],
        "options": {"time_limit": 60, "search_iterations": 50}}
    plan = planned(service, request)
    assert plan["status"] == "complete"
    assert [each["id"] for each in breaks_of(plan)] == ["nap"]
    assert is_feasible(service, request, plan)


@pytest.fixture
def short(smallest: Request) -> Request:
    """Return two customers some twenty minutes away, whose truck's breaks are of its own."""
    return smallest | {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [
            {"id": "0", "location": [10, -20], "demand": [1], "time_window": {"earliest": 7200}},
            {"id": "1", "location": [8, -22], "demand": [1]}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9], "speed_kmh": 60,
                   "costs": {"per_km": 1}}]}


def test_a_plan_without_times_begins_when_a_break_is_over_that_nobody_could_take(
        client: httpx.Client, short: Request) -> None:
    """The judge's own three ways to begin break it: the search is asked for another."""
    short["fleet"][0]["breaks"] = [{
        "id": "lunch", "duration": 1800, "at": "anywhere", "max_load": [1],
        "start": {"earliest": 4800, "latest": 6600}}]
    stops = [{"kind": "depot", "id": "hub"}, {"kind": "customer", "id": "0"},
             {"kind": "customer", "id": "1"}, {"kind": "depot", "id": "hub"}]
    plan = {"routes": [{"vehicle": "truck-1", "type": "truck",
                        "trips": [{"stops": stops, "sorties": []}]}], "unassigned": []}
    verdict = judged(client, short, plan)
    assert verdict["feasible"], verdict["violations"]
    told = verdict["routes"][0]["trips"][0]["stops"]
    assert [stop["id"] for stop in told] == ["hub", "0", "1", "hub"]
    assert told[0]["departure"] >= 6600


def test_who_fits_if_the_driver_rests_on_the_way_is_put_there(client: httpx.Client,
                                                              short: Request) -> None:
    short["fleet"][0]["breaks"] = [{"id": "coffee", "duration": 600, "at": "anywhere",
                                    "paid": False, "start": {"earliest": 900, "latest": 1000}}]
    new, _ = short["customers"]
    new["time_window"] = {"latest": 2000}
    short["customers"] = [short["customers"][1] | {"time_window": {"earliest": 9000}}]
    told = client.post("/fit", json={"problem": short, "new_customer": new, "plan": {
        "routes": [], "unassigned": []}}).json()
    assert [each["feasible"] for each in told["places"]] == [True]
    kinds = [stop["kind"] for stop in told["places"][0]["route"]["trips"][0]["stops"]]
    assert kinds == ["depot", "break", "customer", "depot"]


@pytest.mark.parametrize("iterations", [0, 300])
def test_who_has_rested_on_the_way_rests_at_no_stop_before_the_next(
        service: httpx.Client, resting: Request, iterations: int) -> None:
    resting["customers"] = [{"id": "A", "location": [0, 3], "demand": [1]}]
    resting["fleet"][0] |= {"speed_kmh": 1, "breaks": [
        {"id": "call", "duration": 0, "start": {"earliest": 7200, "latest": 9000},
         "at": "anywhere"},
        {"id": "nap", "duration": 60, "at": "stop", "start": {"earliest": 3600, "latest": 7200}}]}
    resting["options"]["search_iterations"] = iterations
    plan = planned(service, resting)
    assert is_feasible(service, resting, plan)
    if iterations:
        assert plan["status"] == "complete"
        assert plan["routes"][0]["trips"][0]["stops"][-2]["arrival"] >= 7200
