"""Requests that go on from a plan, over HTTP."""

import copy
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply

pytestmark = pytest.mark.slow

Request = dict[str, Any]


@pytest.fixture
def street() -> Request:
    """Four customers along a street, a kilometre apart, and two trucks at a kilometre a minute."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": name, "location": [place, 0], "demand": [1], "service_duration": 60}
                      for place, name in enumerate("abcd", 1)],
        "fleet": [{"id": "truck", "count": 2, "capacity": [10], "speed_kmh": 60}],
        "options": {"time_limit": 60, "search_iterations": 60},
    }


def visit(kind: str, name: str, arrival: float, departure: float) -> dict[str, Any]:
    """Return a stop."""
    return {"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
            "departure": departure}


@pytest.fixture
def tour() -> dict[str, Any]:
    """Return the plan in which truck-1 serves a, b and c; it is home at 540 s."""
    stops = [visit("depot", "hub", 0, 0), visit("customer", "a", 60, 120),
             visit("customer", "b", 180, 240), visit("customer", "c", 300, 360),
             visit("depot", "hub", 540, 540)]
    return {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [{"stops": stops}]}],
            "unassigned": [{"id": "d"}]}


def replanned(client: httpx.Client, request: Request, **replan: Any) -> dict[str, Any]:
    """Return the plan that goes on, once it has been judged to do so."""
    body = request | {"replan": replan}
    reply = client.post("/plan", json=body)
    assert reply.status_code == 200, reply.text
    plan = reply.json()
    PlanReply.model_validate(plan)
    assert plan["solver"]["start"] == "given"
    verdict = client.post("/check", json={"problem": body, "plan": plan}).json()
    assert (verdict["feasible"], verdict["cost"]) == (
        True, pytest.approx(plan["cost"])), verdict
    return plan


def refused(client: httpx.Client, request: Request, **replan: Any) -> list[tuple[str, str]]:
    """Return the code and path of every error of a refused request."""
    reply = client.post("/plan", json=request | {"replan": replan})
    assert reply.status_code == 422, reply.text
    return [(error["code"], error["path"].removeprefix("$.replan"))
            for error in reply.json()["errors"]]


def halts(plan: dict[str, Any], vehicle: str) -> list[list[tuple[str, float]]]:
    """Return where a vehicle halts and when it leaves, trip by trip."""
    return [[(stop["id"], stop["departure"]) for stop in trip["stops"]]
            for route in plan["routes"] if route["vehicle"] == vehicle for trip in route["trips"]]


def test_plan_is_the_start_of_the_search(searching: httpx.Client, street: Request,
                                         tour: dict[str, Any]) -> None:
    plan = replanned(searching, street, plan=tour)
    # d was left out and is served now; one truck suffices.
    assert (plan["status"], plan["cost"]["total"]) == ("complete", 8.0)
    assert plan["replan"] == {"settled": [], "excused": []}


def test_what_has_departed_stays_and_others_serve_what_is_new(
        searching: httpx.Client, street: Request, tour: dict[str, Any]) -> None:
    plan = replanned(searching, street, plan=tour, freeze_before=200)
    assert halts(plan, "truck-1") == [
        [("hub", 0), ("a", 120), ("b", 240), ("c", 360), ("hub", 540)]]
    ((start, *_),) = halts(plan, "truck-2")
    assert start[1] >= 200
    assert plan["replan"]["settled"] == [{"vehicle": "truck-1", "trip": 0, "stop": 2}]


def test_customers_whom_the_request_lacks_are_cancelled(
        searching: httpx.Client, street: Request, tour: dict[str, Any]) -> None:
    street["customers"] = [one for one in street["customers"] if one["id"] in "ab"]
    plan = replanned(searching, street, plan=tour, freeze_before=100)
    assert halts(plan, "truck-1") == [[("hub", 0), ("a", 120), ("b", 240), ("hub", 360)]]


def test_broken_vehicle_does_nothing_more(searching: httpx.Client, street: Request,
                                          tour: dict[str, Any]) -> None:
    plan = replanned(searching, street, plan=tour, freeze_before=150, unavailable=["truck-1"],
                     parcels_back=500)
    assert halts(plan, "truck-1") == [[("hub", 0), ("a", 120), ("hub", 180)]]
    ((start, *served, _),) = halts(plan, "truck-2")
    assert start[1] >= 500
    assert {name for name, _ in served} == {"b", "c", "d"}


def test_vehicle_that_breaks_down_on_its_way_out_brings_its_parcels_back(
        searching: httpx.Client, street: Request, tour: dict[str, Any]) -> None:
    plan = replanned(searching, street, plan=tour, freeze_before=30, unavailable=["truck-1"],
                     parcels_back=500)
    assert [route["vehicle"] for route in plan["routes"]] == ["truck-2"]
    assert plan["summary"]["served"] == 4
    for trip in halts(plan, "truck-2"):
        assert {name for name, _ in trip} <= {"hub", "d"} or trip[0][1] >= 500


def test_closed_window_leaves_a_parcel_aboard(searching: httpx.Client, street: Request,
                                              tour: dict[str, Any]) -> None:
    street["customers"][2]["time_window"] = {"latest": 250}
    plan = replanned(searching, street, plan=tour, freeze_before=200)
    (left_out,) = plan["unassigned"]
    assert left_out["id"] == "c"
    assert left_out["reasons"][0]["code"] == "ABOARD"


def test_what_happened_before_a_window_was_closed_is_excused(
        searching: httpx.Client, street: Request, tour: dict[str, Any]) -> None:
    street["customers"][0]["time_window"] = {"latest": 10}
    plan = replanned(searching, street, plan=tour, freeze_before=200)
    assert [(item["code"], item["path"]) for item in plan["replan"]["excused"]] == [
        ("TIME_WINDOW", "$.routes[0].trips[0].stops[1]")]


def test_pinned_customers_stay_with_their_vehicles(searching: httpx.Client, street: Request,
                                                   tour: dict[str, Any]) -> None:
    stops = [visit("depot", "hub", 0, 0), visit("customer", "d", 240, 300),
             visit("depot", "hub", 540, 540)]
    tour["routes"].append({"vehicle": "truck-2", "type": "truck", "trips": [{"stops": stops}]})
    tour["unassigned"] = []
    assert len(replanned(searching, street, plan=tour)["routes"]) == 1
    for pins in ({"pinned": ["c", "d"]}, {"pin_all": True}):
        plan = replanned(searching, street, plan=tour, **pins)
        assert "d" in dict(halts(plan, "truck-2")[0])
        assert "c" in dict(halts(plan, "truck-1")[0])


def test_replies_can_be_replanned_again_and_again(searching: httpx.Client, street: Request,
                                                  tour: dict[str, Any]) -> None:
    street["fleet"][0]["count"] = 3
    first = replanned(searching, street, plan=tour, freeze_before=100)
    street["customers"].append({"id": "e", "location": [2, 1], "demand": [1]})
    second = replanned(searching, street, plan=first, freeze_before=250)
    assert halts(second, "truck-1") == halts(first, "truck-1")
    assert second["status"] == "complete"


def test_nothing_left_to_plan_is_an_answer(searching: httpx.Client, street: Request,
                                           tour: dict[str, Any]) -> None:
    street["customers"].pop()
    plan = replanned(searching, street, plan=tour | {"unassigned": []}, freeze_before=1000)
    assert halts(plan, "truck-1")[0][-1] == ("hub", 540)
    assert (plan["solver"]["search_iterations"], plan["solver"]["deterministic"]) == (0, True)


def _route(tour: dict[str, Any]) -> dict[str, Any]:
    route: dict[str, Any] = tour["routes"][0]
    return route


def _stop(tour: dict[str, Any], index: int) -> dict[str, Any]:
    stop: dict[str, Any] = _route(tour)["trips"][0]["stops"][index]
    return stop


SORTIE = {"drone": "truck-1/drone-1", "launch_stop": 1, "recovery_stop": 1, "launch_time": 60,
          "recovery_time": 120, "customers": [{"id": "d", "arrival": 70, "service_start": 70,
                                               "departure": 80}]}


@pytest.mark.parametrize(("change", "code", "path"), [
    (lambda tour: _route(tour).update(type="boat"), "UNKNOWN_VEHICLE_TYPE",
     ".plan.routes[0].type"),
    (lambda tour: _route(tour).update(vehicle="truck-0"), "WRONG_NAME",
     ".plan.routes[0].vehicle"),
    (lambda tour: _route(tour).update(vehicle="truck-3"), "UNKNOWN_VEHICLE",
     ".plan.routes[0].vehicle"),
    (lambda tour: tour["routes"].append(copy.deepcopy(_route(tour)) | {"trips": []}),
     "DUPLICATE_VEHICLE", ".plan.routes[1].vehicle"),
    (lambda tour: _stop(tour, 1).update(id="z"), "UNKNOWN_CUSTOMER",
     ".plan.routes[0].trips[0].stops[1].id"),
    (lambda tour: _stop(tour, 0).update(id="z"), "UNKNOWN_DEPOT",
     ".plan.routes[0].trips[0].stops[0].id"),
    (lambda tour: _stop(tour, 0).update(id="far"), "WRONG_DEPOT",
     ".plan.routes[0].trips[0].stops[0].id"),
    (lambda tour: _stop(tour, 0).update(kind="customer"), "TRIP_SHAPE",
     ".plan.routes[0].trips[0].stops"),
    (lambda tour: _stop(tour, 3).update(id="b"), "PLANNED_TWICE",
     ".plan.routes[0].trips[0].stops[3].id"),
    (lambda tour: tour["unassigned"].append({"id": "a"}), "PLANNED_TWICE",
     ".plan.unassigned[1].id"),
    (lambda tour: _stop(tour, 1).update(departure=50), "TIMES_DISORDERED",
     ".plan.routes[0].trips[0].stops[1].departure"),
    (lambda tour: _stop(tour, 2).update(arrival=100), "TIMES_DISORDERED",
     ".plan.routes[0].trips[0].stops[2].arrival"),
    (lambda tour: _route(tour)["trips"][0].update(sorties=[SORTIE | {"launch_stop": 9}]),
     "SORTIE_STOPS", ".plan.routes[0].trips[0].sorties[0]"),
    (lambda tour: (_route(tour)["trips"][0].update(sorties=[SORTIE]),
                   _stop(tour, 1).update(kind="break")),
     "SORTIE_STOPS", ".plan.routes[0].trips[0].sorties[0]"),
    (lambda tour: _route(tour)["trips"][0].update(stops=[], sorties=[SORTIE]), "TRIP_SHAPE",
     ".plan.routes[0].trips[0].stops"),
    (lambda tour: _route(tour)["trips"][0].update(sorties=[SORTIE]), "UNKNOWN_DRONE",
     ".plan.routes[0].trips[0].sorties[0].drone"),
    (lambda tour: _route(tour)["trips"][0].update(sorties=[SORTIE | {"launch_time": 10}]),
     "TIMES_DISORDERED", ".plan.routes[0].trips[0].sorties[0].launch_time"),
    (lambda tour: _route(tour)["trips"][0].update(sorties=[SORTIE | {"recovery_time": 75}]),
     "TIMES_DISORDERED", ".plan.routes[0].trips[0].sorties[0].recovery_time"),
])
def test_plans_that_do_not_fit_are_refused(searching: httpx.Client, street: Request,
                                           tour: dict[str, Any], change: Callable[[Any], object],
                                           code: str, path: str) -> None:
    street["depots"].append({"id": "far", "location": [9, 9]})
    change(tour)
    assert (code, path) in refused(searching, street, plan=tour, freeze_before=150)


@pytest.mark.parametrize(("replan", "code", "path"), [
    ({"unavailable": ["truck-3"]}, "UNKNOWN_VEHICLE", ".unavailable[0]"),
    ({"unavailable": ["truck-1/drone-1"]}, "UNKNOWN_DRONE", ".unavailable[0]"),
    ({"unavailable": ["truck-3/drone-1"]}, "UNKNOWN_VEHICLE", ".unavailable[0]"),
    ({"unavailable": ["truck-1", "truck-1"]}, "DUPLICATE_VEHICLE", ".unavailable[1]"),
    ({"pinned": ["z"]}, "UNKNOWN_CUSTOMER", ".pinned[0]"),
    ({"doubtful": ["z"]}, "UNKNOWN_CUSTOMER", ".doubtful[0]"),
    ({"pinned": ["d"]}, "NOT_PLANNED", ".pinned[0]"),
    ({"pinned": ["a"], "unavailable": ["truck-1"]}, "PINNED_TO_UNAVAILABLE", ".pinned[0]"),
    ({"parcels_back": 10}, "MISSING_FIELD", ".freeze_before"),
    ({"parcels_back": 10, "freeze_before": 20}, "OUT_OF_RANGE", ".parcels_back"),
    ({"freeze": 20}, "UNKNOWN_FIELD", ".freeze"),
    ({"plan": None}, "WRONG_TYPE", ".plan"),
])
def test_terms_that_make_no_sense_are_refused(searching: httpx.Client, street: Request,
                                              tour: dict[str, Any], replan: dict[str, Any],
                                              code: str, path: str) -> None:
    assert (code, path) in refused(searching, street, **({"plan": tour} | replan))


def test_all_errors_come_at_once(searching: httpx.Client, street: Request,
                                 tour: dict[str, Any]) -> None:
    street["fleet"][0]["depot"] = "moon"
    street["customers"][0]["demand"] = ["heavy"]
    _route(tour)["vehicle"] = "van-1"
    assert set(refused(searching, street, plan=tour, unavailable=["truck-9"])) >= {
        ("WRONG_TYPE", "$.customers[0].demand[0]"), ("UNKNOWN_DEPOT", "$.fleet[0].depot"),
        ("WRONG_NAME", ".plan.routes[0].vehicle"), ("UNKNOWN_VEHICLE", ".unavailable[0]")}


def test_a_flight_that_can_not_have_been_is_refused(searching: httpx.Client, street: Request,
                                                    tour: dict[str, Any]) -> None:
    street["fleet"][0]["drones"] = {"count": 1, "capacity": [9]}
    street["airspace"] = {"no_fly": [[[3.9, -0.1], [4.1, -0.1], [4.1, 0.1], [3.9, 0.1]]]}
    _route(tour)["trips"][0]["sorties"] = [SORTIE]
    tour["unassigned"] = []
    assert set(refused(searching, street, plan=tour, freeze_before=100)) == {
        ("SETTLED_PART", ".plan.routes[0].trips[0].sorties[0]")}
