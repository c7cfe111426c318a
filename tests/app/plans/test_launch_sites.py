"""Stops of trucks for their drones alone, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import documented, planned, planned_and_judged


Request = dict[str, Any]

SEARCHED = {"search_iterations": 300, "time_limit": 60}


@pytest.fixture
def far_off(smallest: Request) -> Request:
    """Return a request with a customer whom only a drone from a car park reaches."""
    return smallest | {
        "planar_unit": 1, "options": SEARCHED,
        "customers": [{"id": "A", "location": [1000, 0], "demand": [1], "served_by": "truck"},
                      {"id": "isle", "location": [0, 9000], "demand": [1], "served_by": "drone"}],
        "launch_sites": [{"id": "car park", "location": [0, 8000], "cost": 2.5,
                          "time_window": {"earliest": 1200}}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [10], "speed_kmh": 36, "drones": {
            "count": 1, "capacity": [2], "speed_kmh": 72, "endurance": 300}}]}


def site_stops(plan: Request) -> list[Request]:
    """Return the stops of a plan at launch sites."""
    return [stop for route in plan["routes"] for trip in route["trips"] for stop in trip["stops"]
            if stop["kind"] == "launch_site"]


def test_a_truck_stops_where_nobody_ordered(service: httpx.Client, far_off: Request) -> None:
    plan = planned(service, far_off)
    assert plan["unassigned"] == []
    (stop,) = site_stops(plan)
    assert (stop["id"], stop["service_start"], stop["lateness"]) == ("car park", 1200, 0)
    assert stop["waiting"] == stop["service_start"] - stop["arrival"]
    assert plan["cost"]["stops"] == 2.5
    verdict = service.post("/check", json={"problem": far_off, "plan": plan}).json()
    assert (verdict["feasible"], verdict["violations"]) == (True, [])


@pytest.mark.parametrize(("change", "code"), [
    ({"vehicles": {"forbidden": ["truck-1"]}}, "LAUNCH_SITE"),
    ({"time_window": {"latest": 1}}, "TIME_WINDOW")])
def test_launch_sites_are_for_some_vehicles_at_some_time(
        service: httpx.Client, far_off: Request, change: Request, code: str) -> None:
    plan = planned(service, far_off)
    far_off["launch_sites"][0] |= change
    verdict = service.post("/check", json={"problem": far_off, "plan": plan}).json()
    assert code in {broken["code"] for broken in verdict["violations"]}
    assert [left_out["id"] for left_out in planned(service, far_off)["unassigned"]] == ["isle"]


@pytest.mark.thorough
def test_crowds_who_stay_out_leave_the_service_as_it_was(service: httpx.Client) -> None:
    """Two hundred for six places, each of whom might be flown to from a launch site."""
    crowd = {"coordinate_system": "planar", "depots": [{"id": "d", "location": [0, 0]}],
             "customers": [{"id": f"c{number}", "location": [0, 0], "demand": [1]}
                           for number in range(210)],
             "launch_sites": [{"id": "l", "location": [0, 0], "cost": 1}],
             "fleet": [{"id": "truck", "count": 2, "capacity": [3], "speed_kmh": 30,
                        "costs": {"fixed": 5, "per_km": 1, "per_hour": 10, "per_load_km": 0.1},
                        "drones": {"count": 2, "capacity": [3], "speed_kmh": 50,
                                   "endurance": 1800}}]}
    for seed in range(3):
        plan = planned(service, crowd | {"options": SEARCHED | {"seed": seed}})
        assert plan["summary"]["served"] == 6


def test_lines_and_reasons_know_launch_sites(service: httpx.Client,
                                             far_off: Request) -> None:
    far_off["options"] = SEARCHED | {"geometry": True}
    plan = planned(service, far_off)
    (stop,) = site_stops(plan)
    assert stop["geometry"] is not None
    asked = {"problem": far_off, "plan": plan}
    told = service.post("/explain", json=asked | {"customer": "isle"}).json()
    assert told["here"]["position"]["recovered_at"] == "car park"
    assert service.post("/explain", json=asked | {"drones": True}).status_code == 200
    fits = service.post("/fit", json=asked | {"customer": "A"})
    assert fits.status_code == 200, fits.text


def test_a_truck_comes_back_to_whom_it_has_served(service: httpx.Client,
                                                  smallest: Request) -> None:
    """A truck at the end of a road flies to one side, drives on, and comes back for the other."""
    request = smallest | {
        "planar_unit": 1,
        "customers": [
            {"id": "hut", "location": [0, 5000], "demand": [1], "served_by": "truck"},
            {"id": "tip", "location": [0, 6000], "demand": [1], "served_by": "truck"},
            {"id": "west", "location": [-1000, 5000], "demand": [1], "served_by": "drone"},
            {"id": "east", "location": [1000, 5000], "demand": [1], "served_by": "drone"}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [10], "speed_kmh": 36, "revisits": True,
                   "costs": {"per_km": 0, "per_hour": 10}, "max_sorties": 2, "drones": {
                       "count": 1, "capacity": [1], "speed_kmh": 36, "endurance": 210}}],
        "options": SEARCHED | {"search_iterations": 2000}}
    plan = planned(service, request)
    assert plan["unassigned"] == []
    assert service.post("/check", json={"problem": request, "plan": plan}).json()["feasible"]
    for stop in site_stops(plan):
        assert stop["id"] in {"depot", "hut", "tip"}
    alone = planned(service, request | {"fleet": [request["fleet"][0] | {"revisits": False}]})
    assert plan["cost"]["total"] <= alone["cost"]["total"]


def test_further_trips_go_to_launch_sites_too(service: httpx.Client, far_off: Request) -> None:
    isle = far_off["customers"][1]
    far_off["customers"] = [isle, isle | {"id": "rock", "location": [100, 9000]}]
    far_off["fleet"][0] |= {"capacity": [1], "max_trips": 2}
    plan = planned(service, far_off)
    assert plan["unassigned"] == []
    assert [stop["id"] for stop in site_stops(plan)] == ["car park", "car park"]


def test_the_documented_example_stops_at_a_pier(service: httpx.Client) -> None:
    plan = planned_and_judged(service, documented("launch_sites"))
    assert plan["unassigned"] == []
    assert "pier" in {stop["id"] for stop in site_stops(plan)}


@pytest.mark.parametrize(("change", "code", "path"), [
    ({"launch_sites": [{"id": "a", "location": [0, 0]}] * 2}, "DUPLICATE_ID",
     "$.launch_sites[1].id"),
    ({"launch_sites": [{"id": "a"}]}, "MISSING_LOCATION", "$.launch_sites[0].location"),
    ({"launch_sites": [{"id": "a", "location": [0, 0],
                        "time_window": {"earliest": 2, "latest": 1}}]},
     "WINDOW_ENDS_BEFORE_START", "$.launch_sites[0].time_window"),
    ({"launch_sites": [{"id": "a", "location": [0, 0], "vehicles": {"allowed": ["bus"]}}]},
     "UNKNOWN_VEHICLE", "$.launch_sites[0].vehicles.allowed[0]")])
def test_what_makes_no_sense_is_refused(service: httpx.Client, far_off: Request, change: Request,
                                        code: str, path: str) -> None:
    reply = service.post("/plan", json=far_off | change)
    assert reply.status_code == 422
    assert (code, path) in {(error["code"], error["path"]) for error in reply.json()["errors"]}


def test_what_is_revisited_has_names_of_its_own(service: httpx.Client, far_off: Request) -> None:
    far_off["fleet"][0]["revisits"] = True
    far_off["launch_sites"][0]["id"] = "A"
    (error,) = service.post("/plan", json=far_off).json()["errors"]
    assert (error["code"], error["path"]) == ("DUPLICATE_ID", "$.launch_sites[0].id")


def test_a_truck_goes_on_to_a_launch_site(service: httpx.Client, far_off: Request) -> None:
    plan = planned(service, far_off)
    (stop,) = site_stops(plan)
    for now in (1, stop["arrival"] + 1, stop["service_start"] + 1):
        again = planned(service, far_off | {"replan": {"plan": plan, "freeze_before": now}})
        assert again["unassigned"] == []
        assert site_stops(again) == [stop]


def test_plans_with_launch_sites_are_sent_out(service: httpx.Client, far_off: Request) -> None:
    plan = planned(service, far_off)
    reply = service.post("/dispatches", json={"problem": far_off, "plan": plan})
    assert reply.status_code == 201, reply.text


def test_rows_of_matrices_are_asked_for(service: httpx.Client, far_off: Request) -> None:
    for index, place in enumerate((*far_off["depots"], *far_off["customers"],
                                   *far_off["launch_sites"])):
        place["location_index"] = index
    table = [[0 if i == j else 60 for j in range(4)] for i in range(4)]
    far_off["matrices"] = {name: {"durations": table, "distances": table}
                           for name in ("truck", "drone")}
    assert site_stops(planned(service, far_off)) == []
    del far_off["launch_sites"][0]["location_index"]
    (error,) = service.post("/plan", json=far_off).json()["errors"]
    assert (error["code"], error["path"]) == ("MISSING_LOCATION_INDEX",
                                              "$.launch_sites[0].location_index")
