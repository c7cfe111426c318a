"""Customers with several places, over HTTP and back."""

from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply

Request = dict[str, Any]


@pytest.fixture
def lockers(smallest: Request) -> Request:
    """Return a request with a customer who may be served near the depot instead, for two a time."""
    return {
        **smallest, "options": {"search_iterations": 300, "time_limit": 60},
        "customers": [
            {"id": "A", "location": [9, 0], "demand": [1], "info": {"phone": "1"}, "alternatives": [
                {"id": "locker", "location": [1, 0], "cost": 2, "service_duration": 30},
                {"id": "shop", "location": [3, 0], "time_window": {"earliest": 60}}]},
            {"id": "B", "location": [0, 3], "demand": [1]}],
        "fleet": [{"id": "van", "count": 1, "capacity": [2], "speed_kmh": 36,
                   "costs": {"per_km": 1}}],
        "planar_unit": 1000}


def halts(plan: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {stop["id"]: stop for route in plan["routes"] for trip in route["trips"]
            for stop in [*trip["stops"], *(visit for sortie in trip["sorties"]
                                           for visit in sortie["customers"])]}


def test_the_place_that_is_used_is_named_and_paid_for(searching: httpx.Client,
                                                      lockers: Request) -> None:
    lockers["customers"][0]["alternatives"][0]["cost"] = 0.5
    plan = searching.post("/plan", json=lockers).json()
    PlanReply.model_validate(plan)
    served = halts(plan)
    assert served["A"]["alternative"] == "locker"
    assert served["A"]["departure"] - served["A"]["service_start"] == 30
    assert served["A"]["info"] == {"phone": "1"}
    assert "alternative" not in served["B"]
    assert plan["cost"]["stops"] == 0.5
    assert plan["summary"]["customers"] == plan["summary"]["served"] == 2
    checked = searching.post("/check", json={"problem": lockers, "plan": plan}).json()
    assert checked["feasible"], checked
    assert checked["cost"] == plan["cost"]


@pytest.mark.parametrize(("at_locker", "takes"), [(45, 45), (None, 30)])
def test_a_drone_serves_as_long_as_the_place_says(searching: httpx.Client, lockers: Request,
                                                  at_locker: int | None, takes: int) -> None:
    customer = lockers["customers"][0] | {"served_by": "drone", "service_duration": 60}
    customer["location"] = [300, 0]
    customer["alternatives"] = [{"id": "locker", "location": [1, 0],
                                 "service_duration": at_locker}]
    lockers["customers"] = [customer]
    lockers["fleet"][0]["drones"] = [
        {"id": "large", "count": 1, "capacity": [0], "service_duration": 5},
        {"id": "small", "count": 1, "capacity": [1], "service_duration": 30}]
    plan = searching.post("/plan", json=lockers).json()
    served = halts(plan)["A"]
    assert served["alternative"] == "locker"
    assert served["departure"] - served["service_start"] == takes
    assert searching.post("/check", json={"problem": lockers, "plan": plan}).json()["feasible"]


def test_of_two_places_the_cheaper_is_used(searching: httpx.Client, lockers: Request) -> None:
    # The shop is farther by two km there and back less than the locker's price, and opens late.
    lockers["customers"][0]["alternatives"][0]["cost"] = 9
    plan = searching.post("/plan", json=lockers).json()
    assert halts(plan)["A"]["alternative"] == "shop"
    lockers["customers"][0]["alternatives"][1]["cost"] = 90
    lockers["customers"][0]["alternatives"][0]["cost"] = 90
    assert "alternative" not in halts(searching.post("/plan", json=lockers).json())["A"]


def test_nobody_is_served_at_two_places(searching: httpx.Client, lockers: Request) -> None:
    plan = searching.post("/plan", json=lockers).json()
    stops = plan["routes"][0]["trips"][0]["stops"]
    stops.insert(1, {**next(stop for stop in stops if stop["id"] == "A"), "alternative": "locker"})
    checked = searching.post("/check", json={"problem": lockers, "plan": plan}).json()
    assert "DUPLICATE" in {violation["code"] for violation in checked["violations"]}


def test_who_is_out_of_reach_at_all_places_is_left_out_once(searching: httpx.Client,
                                                            lockers: Request) -> None:
    for place in (lockers["customers"][0], *lockers["customers"][0]["alternatives"]):
        place["time_window"] = {"latest": 10}
    plan = searching.post("/plan", json=lockers).json()
    PlanReply.model_validate(plan)
    assert [each["id"] for each in plan["unassigned"]] == ["A"]
    assert plan["summary"]["must_unserved"] == 1
    checked = searching.post("/check", json={"problem": lockers, "plan": plan}).json()
    assert checked["feasible"], checked


def test_who_could_be_served_at_another_place_is_told_so(searching: httpx.Client,
                                                         lockers: Request) -> None:
    lockers["customers"][0] |= {"time_window": {"latest": 10}, "unassigned_cost": 3}
    (left,) = searching.post("/plan", json=lockers).json()["unassigned"]
    (reason,) = left["reasons"]
    assert (left["id"], reason["code"]) == ("A", "COST")
    assert reason["message"].startswith("At A/locker van could serve it alone at a cost of 4.00; "
                                        "leaving it out costs 3.00")


def test_a_plan_goes_on_to_another_place(searching: httpx.Client, lockers: Request) -> None:
    lockers["customers"][1]["time_window"] = {"latest": 300}
    plan = searching.post("/plan", json=lockers).json()
    assert halts(plan)["A"]["alternative"] == "locker"
    # The van is on its way to B with both parcels as the locker turns out to be full.
    lockers["customers"][0]["alternatives"][0]["time_window"] = {"latest": 1}
    lockers["replan"] = {"plan": plan, "freeze_before": 1}
    replanned = searching.post("/plan", json=lockers).json()
    assert halts(replanned)["A"]["alternative"] == "shop"
    lockers["replan"]["pinned"] = ["A"]
    assert halts(searching.post("/plan", json=lockers).json())["A"]["alternative"] == "shop"


@pytest.mark.parametrize(("change", "code", "path"), [
    ({"id": "shop"}, "DUPLICATE_ID", "$.customers[0].alternatives[1].id"),
    ({"time_window": {"earliest": 9, "latest": 1}}, "WINDOW_ENDS_BEFORE_START",
     "$.customers[0].alternatives[0].time_window.latest"),
    ({"location": [1e9, 0]}, "LOCATION_TOO_FAR", "$.customers[0].alternatives[0].location"),
    ({"locker": 1}, "UNKNOWN_FIELD", "$.customers[0].alternatives[0].locker"),
])
def test_what_is_wrong_with_a_place_is_told(searching: httpx.Client, lockers: Request,
                                            change: Request, code: str, path: str) -> None:
    lockers["customers"][0]["alternatives"][0] |= change
    errors = searching.post("/plan", json=lockers).json()["errors"]
    assert [(error["code"], error["path"]) for error in errors] == [(code, path)]


def test_what_a_customer_says_of_all_places_is_wrong_once(searching: httpx.Client,
                                                          lockers: Request) -> None:
    lockers["customers"][0]["vehicles"] = {"allowed": ["bus"]}
    lockers["relations"] = [{"kind": "apart", "customers": ["B", "A/locker"]}]
    errors = searching.post("/plan", json=lockers).json()["errors"]
    assert [error["path"] for error in errors] == [
        "$.customers[0].vehicles.allowed[0]", "$.relations[0].customers[1]"]


def test_the_place_that_is_used_is_explained_and_drawn(searching: httpx.Client,
                                                       lockers: Request) -> None:
    lockers["options"]["geometry"] = True
    plan = searching.post("/plan", json=lockers).json()
    assert halts(plan)["A"]["geometry"]
    asked = {"problem": lockers, "plan": plan, "customer": "A"}
    told = searching.post("/explain", json=asked).json()
    assert told["customer"] == "A"
    left_out = next(each for each in told["alternatives"] if each["kind"] == "unassigned")
    assert left_out["cost"]["total"] > 100
    fit = searching.post("/fit", json=asked).json()
    assert fit["customer"] == "A"
    assert fit["here"] is not None


def test_a_name_that_may_mean_a_place_twice_is_refused(searching: httpx.Client,
                                                       lockers: Request) -> None:
    lockers["customers"][0]["id"] = "A/locker"
    errors = searching.post("/plan", json=lockers).json()["errors"]
    assert [error["path"] for error in errors] == ["$.customers[0].alternatives[0].id"]
