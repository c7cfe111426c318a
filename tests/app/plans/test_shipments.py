"""Shipments over HTTP and back."""

from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply

Request = dict[str, Any]


@pytest.fixture
def paired(smallest: Request) -> Request:
    """Return the smallest request with a shipment between its last customer and the depot."""
    smallest["options"] = {"search_iterations": 500, "time_limit": 60}
    smallest["shipments"] = [{
        "id": "s1", "amount": [1], "pickup": {"location": [3, 0], "info": {"notes": "ring"}},
        "delivery": {"location": [1, 0], "service_duration": 60}}]
    return smallest


def stops_of(plan: dict[str, Any]) -> list[tuple[str, str]]:
    return [(stop["kind"], stop["id"]) for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"]]


def test_a_shipment_is_fetched_before_it_is_brought(searching: httpx.Client,
                                                    paired: Request) -> None:
    plan = searching.post("/plan", json=paired).json()
    PlanReply.model_validate(plan)
    stops = stops_of(plan)
    assert ("customer", "A") in stops
    assert stops.index(("pickup", "s1")) < stops.index(("delivery", "s1"))
    told = {(stop["kind"], stop["id"]): stop for route in plan["routes"]
            for trip in route["trips"] for stop in trip["stops"]}
    assert told["pickup", "s1"]["info"] == {"notes": "ring"}
    assert told["pickup", "s1"]["load"][0] >= 1
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert checked["feasible"], checked
    assert checked["summary"] == plan["summary"]


def test_an_end_fits_on_the_trip_of_the_other_alone(searching: httpx.Client,
                                                    paired: Request) -> None:
    paired["fleet"][0]["count"] = 2
    plan = searching.post("/plan", json=paired).json()
    ask = {"problem": paired, "plan": plan, "customer": "s1/pickup"}
    fits = searching.post("/fit", json=ask).json()
    (vehicle,) = {each["vehicle"] for each in fits["places"]}
    assert ("pickup", "s1") in [(stop["kind"], stop["id"]) for route in plan["routes"]
                                if route["vehicle"] == vehicle
                                for trip in route["trips"] for stop in trip["stops"]]
    assert all({"PAIR"} <= {reason["code"] for reason in each["reasons"]}
               for each in fits["others"])


def test_ways_to_both_ends_are_told(searching: httpx.Client, paired: Request) -> None:
    paired["options"]["geometry"] = True
    plan = searching.post("/plan", json=paired).json()
    [[_, *stops]] = [trip["stops"] for route in plan["routes"] for trip in route["trips"]]
    assert {"pickup", "delivery"} < {stop["kind"] for stop in stops}
    assert all(stop["geometry"] for stop in stops)


def test_a_plan_that_brings_before_it_fetches_is_refused(searching: httpx.Client,
                                                         paired: Request) -> None:
    plan = searching.post("/plan", json=paired).json()
    for route in plan["routes"]:
        for trip in route["trips"]:
            for stop in trip["stops"]:
                other = {"pickup": "delivery", "delivery": "pickup"}
                stop["kind"] = other.get(stop["kind"], stop["kind"])
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert "PAIR" in {violation["code"] for violation in checked["violations"]}


def test_a_shipment_too_heavy_is_left_out_as_one(searching: httpx.Client,
                                                 paired: Request) -> None:
    paired["shipments"][0]["amount"] = [1e6]
    plan = searching.post("/plan", json=paired).json()
    PlanReply.model_validate(plan)
    left_out, = plan["unassigned"]
    assert (left_out["kind"], left_out["id"]) == ("shipment", "s1")
    assert left_out["reasons"][0]["code"] == "CAPACITY"
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert checked["feasible"], checked


def test_how_long_a_shipment_is_under_way_is_limited(searching: httpx.Client,
                                                     paired: Request) -> None:
    paired["shipments"][0]["max_time_between"] = 0
    plan = searching.post("/plan", json=paired).json()
    left_out, = plan["unassigned"]
    assert left_out["reasons"][0]["code"] == "TIME_BETWEEN"
    paired["shipments"][0] |= {"max_time_between": None, "max_detour": 1}
    # Whoever lies on the direct way takes time to be served.
    paired["customers"] = [
        {"id": "C", "location": [2, 0], "demand": [1], "service_duration": 60}]
    stops = stops_of(searching.post("/plan", json=paired).json())
    assert stops[stops.index(("pickup", "s1")) + 1] == ("delivery", "s1")


def test_a_drone_delivers_what_its_truck_has_picked_up(searching: httpx.Client,
                                                       paired: Request) -> None:
    paired["customers"] = [{"id": "A", "location": [4, 0], "demand": [1], "served_by": "truck"}]
    paired["shipments"] = [{
        "id": "s1", "amount": [1], "pickup": {"location": [2, 0]},
        "delivery": {"location": [4, 9], "served_by": "either", "info": {"notes": "roof"}}}]
    paired["fleet"][0] |= {"capacity": [9], "count": 1, "max_trips": 1, "drones": {
        "count": 1, "capacity": [1], "endurance": 36000, "costs": {"per_km": 0.01}}}
    plan = searching.post("/plan", json=paired).json()
    PlanReply.model_validate(plan)
    [trip] = plan["routes"][0]["trips"]
    [[visit]] = [sortie["customers"] for sortie in trip["sorties"]]
    assert (visit["kind"], visit["id"], visit["info"]) == ("delivery", "s1", {"notes": "roof"})
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert checked["feasible"]
    assert checked["summary"] == plan["summary"]
    for terms in {"plan": plan}, {"plan": plan, "freeze_before": trip["sorties"][0]["launch_time"]}:
        again = searching.post("/plan", json=paired | {"replan": terms}).json()
        assert again["cost"]["total"] == pytest.approx(plan["cost"]["total"]), again
    for name in ("A", "s1/pickup", "s1/delivery"):
        reply = searching.post("/explain", json={"problem": paired, "plan": plan, "customer": name})
        assert reply.status_code == 200, reply.text
    paired["shipments"][0]["pickup"]["served_by"] = "drone"  # alone, it isn't built
    refused = searching.post("/plan", json=paired)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["path"] == "$.shipments[0].pickup.served_by"


def test_a_drone_fetches_what_its_truck_delivers(searching: httpx.Client, paired: Request) -> None:
    paired["customers"] = [{"id": "A", "location": [4, 0], "demand": [1], "served_by": "truck"}]
    paired["shipments"] = [{
        "id": "s1", "amount": [1], "delivery": {"location": [2, 0]},
        "pickup": {"location": [4, 9], "served_by": "either", "info": {"notes": "roof"}}}]
    paired["fleet"][0] |= {"capacity": [9], "count": 1, "max_trips": 1, "drones": {
        "count": 1, "capacity": [1], "endurance": 36000, "costs": {"per_km": 0.01}}}
    plan = searching.post("/plan", json=paired).json()
    PlanReply.model_validate(plan)
    [trip] = plan["routes"][0]["trips"]
    [sortie] = trip["sorties"]
    [visit] = sortie["customers"]
    assert (visit["kind"], visit["id"], visit["info"]) == ("pickup", "s1", {"notes": "roof"})
    assert trip["stops"][sortie["recovery_stop"]]["load"] == [1]
    assert sortie["recovery_stop"] < stops_of(plan).index(("delivery", "s1"))
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert checked["feasible"]
    assert checked["summary"] == plan["summary"]
    for terms in {"plan": plan}, {"plan": plan, "freeze_before": sortie["launch_time"]}:
        again = searching.post("/plan", json=paired | {"replan": terms}).json()
        assert again["cost"]["total"] == pytest.approx(plan["cost"]["total"]), again
    for name in ("A", "s1/pickup", "s1/delivery"):
        for path in ("/explain", "/fit"):
            reply = searching.post(path, json={"problem": paired, "plan": plan, "customer": name})
            assert reply.status_code == 200, reply.text


def test_a_sortie_serves_both_ends(searching: httpx.Client, paired: Request) -> None:
    paired["customers"] = [{"id": "A", "location": [4, 0], "demand": [1], "served_by": "truck"}]
    paired["shipments"] = [{
        "id": "s1", "amount": [1], "pickup": {"location": [4, 9], "served_by": "either"},
        "delivery": {"location": [5, 9], "served_by": "either"}}]
    paired["fleet"][0] |= {"capacity": [1], "count": 1, "max_trips": 1, "drones": {
        "count": 1, "capacity": [1], "endurance": 36000, "costs": {"per_km": 0.01},
        "max_customers_per_sortie": 2, "energy": {
            "battery_wh": 4000, "kg_per_unit": 2,
            "power": {"cruise_w": 400, "cruise_w_per_kg": 50}}}}
    plan = searching.post("/plan", json=paired).json()
    PlanReply.model_validate(plan)
    [trip] = plan["routes"][0]["trips"]
    [sortie] = trip["sorties"]
    assert [(visit["kind"], visit["id"]) for visit in sortie["customers"]] == [
        ("pickup", "s1"), ("delivery", "s1")]
    assert {tuple(stop["load"]) for stop in trip["stops"][1:]} == {(0,)}
    checked = searching.post("/check", json={"problem": paired, "plan": plan}).json()
    assert checked["feasible"]
    again = searching.post("/plan", json=paired | {
        "replan": {"plan": plan, "freeze_before": sortie["launch_time"]}}).json()
    assert again["routes"] == plan["routes"]


def test_a_shipment_left_out_is_told_that_drones_could_fetch_it(searching: httpx.Client,
                                                                paired: Request) -> None:
    paired["customers"] = []
    paired["shipments"] = [{
        "id": "s1", "amount": [1], "delivery": {"location": [2, 0]}, "unassigned_cost": 0.01,
        "pickup": {"location": [20, 0], "served_by": "either", "time_window": {"latest": 900}}}]
    paired["fleet"][0] |= {"capacity": [9], "count": 1, "drones": {
        "count": 1, "capacity": [1], "endurance": 36000, "speed_kmh": 300}}
    plan = searching.post("/plan", json=paired).json()
    [[reason]] = [left_out["reasons"] for left_out in plan["unassigned"]]
    assert reason["code"] == "COST", reason


def test_flights_bring_shipments(searching: httpx.Client, paired: Request) -> None:
    paired |= {"coordinate_system": "geographic", "customers": [
        {"id": "A", "location": [0.004, 0], "demand": [1], "served_by": "truck"}]}
    paired.pop("planar_unit", None)
    paired["depots"][0]["location"] = [0, 0]
    paired["shipments"] = [{
        "id": "s1", "amount": [1], "pickup": {"location": [0.002, 0]},
        "delivery": {"location": [0.004, 0.009], "served_by": "either"}}]
    paired["fleet"][0] |= {"capacity": [9], "count": 1, "max_trips": 1, "drones": {
        "count": 1, "capacity": [1], "endurance": 36000, "costs": {"per_km": 0.01}}}
    plan = searching.post("/plan", json=paired).json()
    assert any(trip["sorties"] for route in plan["routes"] for trip in route["trips"]), plan
    reply = searching.post("/flights", json={
        "problem": paired, "plan": plan, "format": "geojson", "per": "sortie"})
    assert reply.status_code == 200, reply.text


def test_a_stack_is_unloaded_from_its_top(searching: httpx.Client, paired: Request) -> None:
    paired["customers"] = []
    paired["shipments"] = [{"id": name, "amount": [1], "pickup": {"location": [place, 1]},
                            "delivery": {"location": [3 - place, -1]}}
                           for name, place in (("s1", 1), ("s2", 2))]
    van = paired["fleet"][0]
    van |= {"capacity": [9], "max_trips": 1, "count": 1}
    crossed = searching.post("/plan", json=paired).json()
    van["lifo"] = True
    checked = searching.post("/check", json={"problem": paired, "plan": crossed}).json()
    assert [violation["code"] for violation in checked["violations"]] == ["LIFO"]
    nested = searching.post("/plan", json=paired).json()
    assert nested["unassigned"] == []
    checked = searching.post("/check", json={"problem": paired, "plan": nested}).json()
    assert checked["feasible"]
    assert nested["cost"]["total"] > crossed["cost"]["total"]


@pytest.fixture
def gathered(paired: Request) -> Request:
    """Return the same with a shipment that is fetched in two parts."""
    paired["shipments"] = [{
        "id": "s1", "pickups": [
            {"id": "farm", "location": [3, 0], "amount": [1], "info": {"notes": "ring"}},
            {"id": "mill", "location": [0, 2], "amount": [2], "service_duration": 60}],
        "delivery": {"location": [1, 0]}}]
    paired["customers"] = [{"id": "A", "location": [3, 4], "demand": [1]}]
    paired["fleet"][0] |= {"capacity": [9], "max_trips": 1, "count": 1}
    return paired


def test_a_shipment_is_fetched_in_parts(searching: httpx.Client, gathered: Request) -> None:
    plan = searching.post("/plan", json=gathered).json()
    PlanReply.model_validate(plan)
    [trip] = plan["routes"][0]["trips"]
    told = [(stop["kind"], stop["id"], stop.get("part")) for stop in trip["stops"]]
    last = told.index(("delivery", "s1", None))
    parts = {part: trip["stops"][told.index(("pickup", "s1", part))] for part in ("farm", "mill")}
    assert parts["farm"]["info"] == {"notes": "ring"}
    assert all(told.index(("pickup", "s1", part)) < last for part in parts)
    assert trip["stops"][last]["load"][0] <= trip["stops"][last - 1]["load"][0] - 3
    checked = searching.post("/check", json={"problem": gathered, "plan": plan}).json()
    assert checked["feasible"], checked
    assert checked["summary"] == plan["summary"]
    again = searching.post("/plan", json=gathered | {"replan": {"plan": plan}}).json()
    assert again["cost"]["total"] == pytest.approx(plan["cost"]["total"])
    for name in ("s1/pickup/farm", "s1/pickup/mill", "s1/delivery"):
        for question in "/explain", "/fit":
            reply = searching.post(question, json={
                "problem": gathered, "plan": plan, "customer": name})
            assert reply.status_code == 200, reply.text
    # On the way, it is brought to its end.
    terms = {"plan": plan, "freeze_before": parts["mill"]["departure"]}
    later = searching.post("/plan", json=gathered | {"replan": terms}).json()
    assert stops_of(later) == stops_of(plan)
    lacking = [stop for stop in trip["stops"] if stop.get("part") != "mill"]
    judged = searching.post("/check", json={"problem": gathered, "plan": plan | {
        "routes": [plan["routes"][0] | {"trips": [trip | {"stops": lacking}]}]}}).json()
    assert {"PAIR"} <= {violation["code"] for violation in judged["violations"]}


def test_drones_fetch_parts_of_a_shipment_and_deliver_it(searching: httpx.Client,
                                                         gathered: Request) -> None:
    gathered["fleet"][0] |= {"costs": {"per_km": 10}, "drones": {
        "count": 2, "capacity": [9], "speed_kmh": 60, "endurance": 3600,
        "costs": {"per_km": 0.01}}}
    shipment = gathered["shipments"][0]
    for end in (*shipment["pickups"], shipment["delivery"]):
        end["served_by"] = "either"
    plan = searching.post("/plan", json=gathered).json()
    PlanReply.model_validate(plan)
    flown = {(visit["kind"], visit.get("part")) for route in plan["routes"]
             for trip in route["trips"] for sortie in trip["sorties"]
             for visit in sortie["customers"] if "kind" in visit}
    assert len(flown) >= 2, plan["routes"]
    judged = {"problem": gathered, "plan": plan}
    checked = searching.post("/check", json=judged).json()
    assert checked["feasible"], checked
    for question in "/explain", "/fit":
        reply = searching.post(question, json=judged | {"shipment": "s1"})
        assert reply.status_code == 200, reply.text
    again = searching.post("/plan", json=gathered | {"replan": {"plan": plan}}).json()
    assert again["cost"]["total"] == pytest.approx(plan["cost"]["total"])


def test_a_shipment_in_parts_is_left_out_as_one(searching: httpx.Client,
                                                gathered: Request) -> None:
    gathered["shipments"][0]["pickups"][1]["amount"] = [9]
    plan = searching.post("/plan", json=gathered).json()
    PlanReply.model_validate(plan)
    left_out, = plan["unassigned"]
    assert (left_out["id"], left_out["parts"]) == ("s1", ["farm", "mill"])
    assert left_out["reasons"][0]["code"] == "CAPACITY"
    checked = searching.post("/check", json={"problem": gathered, "plan": plan}).json()
    assert checked["feasible"], checked
    gathered["shipments"][0]["pickups"][1]["amount"] = [1]
    # Its parts are under way from the first on.
    gathered["shipments"][0]["max_time_between"] = 30
    left_out, = searching.post("/plan", json=gathered).json()["unassigned"]
    assert left_out["reasons"][0]["code"] == "TIME_BETWEEN"
    assert "max_time_between were at least" in left_out["reasons"][0]["remedy"]
    del gathered["shipments"][0]["max_time_between"]
    gathered["fleet"][0]["max_stops"] = 2
    left_out, = searching.post("/plan", json=gathered).json()["unassigned"]
    assert left_out["reasons"][0]["remedy"] == "fits if truck could make 3 stops"


@pytest.mark.parametrize(("wrong", "code", "path"), [
    ({"pickup": {"location": [0, 0]}}, "PICKUP_OR_PICKUPS", "$.shipments[0].pickups"),
    ({"amount": [1]}, "PICKUP_OR_PICKUPS", "$.shipments[0].pickups"),
    ({"pickups": []}, "PICKUP_OR_PICKUPS", "$.shipments[0].pickups"),
    ({"pickups": [{"id": "farm", "location": [0, 0], "amount": [1, 1]}]},
     "DIMENSION_MISMATCH", "$.shipments[0].pickups[0].amount"),
    ({"pickups": [{"id": name, "location": [0, 0], "amount": [9e8]} for name in "ab"]},
     "OUT_OF_RANGE", "$.shipments[0].pickups"),
    ({"pickups": 2 * [{"id": "farm", "location": [0, 0], "amount": [1]}]},
     "DUPLICATE_ID", "$.shipments[0].pickups[1].id"),
])
def test_what_is_wrong_with_parts_is_told(searching: httpx.Client, gathered: Request,
                                          wrong: Request, code: str, path: str) -> None:
    gathered["shipments"][0] |= wrong
    errors = searching.post("/plan", json=gathered).json()["errors"]
    assert (code, path) in [(error["code"], error["path"]) for error in errors], errors


def test_errors_of_ends_are_told_where_the_request_states_them(searching: httpx.Client,
                                                               paired: Request) -> None:
    paired["shipments"][0]["delivery"]["time_window"] = {"earliest": 20, "latest": 10}
    paired["shipments"][0]["amount"] = [1, 1]
    refused = searching.post("/plan", json=paired)
    assert refused.status_code == 422
    paths = {error["path"] for error in refused.json()["errors"]}
    assert paths == {"$.shipments[0].delivery.time_window.latest", "$.shipments[0].amount"}


def test_a_plan_with_shipments_is_explained_and_gone_on_from(searching: httpx.Client,
                                                             paired: Request) -> None:
    plan = searching.post("/plan", json=paired).json()
    explained = searching.post("/explain", json={"problem": paired, "plan": plan,
                                              "customer": "A"})
    assert explained.status_code == 200, explained.text
    again = searching.post("/plan", json=paired | {"replan": {"plan": plan}}).json()
    assert again["cost"]["total"] == pytest.approx(plan["cost"]["total"])


def test_a_trip_with_shipments_is_made_to_its_end(searching: httpx.Client,
                                                  paired: Request) -> None:
    plan = searching.post("/plan", json=paired).json()
    (route,), vehicle = plan["routes"], plan["routes"][0]["vehicle"]
    now = max(trip["stops"][0]["departure"] for trip in route["trips"])
    paired["fleet"][0] |= {"count": 2, "max_trips": 2}
    paired["customers"].append({"id": "new", "location": [2, 1], "demand": [1]})
    terms = {"plan": plan, "freeze_before": now}
    later = searching.post("/plan", json=paired | {"replan": terms}).json()
    assert later["unassigned"] == []
    same, = [each for each in later["routes"] if each["vehicle"] == vehicle]
    made = len(route["trips"])
    assert [stops_of({"routes": [{"trips": each["trips"][:made]}]}) for each in (same, route)] == (
        2 * [stops_of({"routes": [route]})])
    checked = searching.post("/check", json={
        "problem": paired | {"replan": terms}, "plan": later}).json()
    assert checked["feasible"], checked
    # A shipment that is on its way can't be cancelled.
    cancelled = searching.post("/plan", json=paired | {"replan": terms, "customers": []})
    assert {error["code"] for error in cancelled.json()["errors"]} == {"UNKNOWN_CUSTOMER"}
    # What is wrong elsewhere doesn't make it one that was.
    fetched = max(stop["departure"] for trip in route["trips"] for stop in trip["stops"]
                  if stop["kind"] == "pickup")
    broken = searching.post("/plan", json=paired | {
        "replan": terms | {"freeze_before": fetched}, "options": {"time_limit": "soon"}})
    assert [error["path"] for error in broken.json()["errors"]] == ["$.options.time_limit"]


def test_two_shipments_of_one_name_are_told_once(searching: httpx.Client,
                                                 paired: Request) -> None:
    paired["shipments"].append(paired["shipments"][0])
    errors = searching.post("/plan", json=paired).json()["errors"]
    assert [(error["code"], error["path"], error["message"]) for error in errors] == [
        ("DUPLICATE_ID", "$.shipments[1].id", "shipments[0] has the same id: give each its own.")]
