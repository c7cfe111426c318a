"""What customers ask for, over HTTP and back: prices, windows and vehicles."""

from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply

Request = dict[str, Any]


def test_single_vehicles_serve_whom_they_may(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0] |= {"count": 3, "drones": {"count": 1, "capacity": [1]}}
    first, second = smallest["customers"]
    first["vehicles"] = {"allowed": ["truck-3"]}
    second["vehicles"] = {"forbidden": ["truck-1", "truck-3"]}
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    served = {route["vehicle"]: [stop["id"] for stop in route["trips"][0]["stops"][1:-1]]
              for route in plan["routes"]}
    assert served == {"truck-3": ["A"], "truck-2": ["B"]}
    assert {route["type"] for route in plan["routes"]} == {"truck"}
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert checked["feasible"], checked
    assert checked["summary"] == plan["summary"]
    plan["routes"][0]["vehicle"] = "truck-1"
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert [violation["code"] for violation in checked["violations"]] == ["VEHICLE"]
    plan["routes"][0]["vehicle"] = "truck-9"
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert "COUNT" in {violation["code"] for violation in checked["violations"]}


def test_each_type_has_one_reason_though_its_vehicles_differ(client: httpx.Client,
                                                             smallest: Request) -> None:
    smallest["fleet"][0]["count"] = 3
    first, second = smallest["customers"]
    first |= {"vehicles": {"allowed": ["truck-2"]}, "skills": ["crane"]}
    second["vehicles"] = {"forbidden": ["truck"]}
    plan = client.post("/plan", json=smallest).json()
    reasons = {left["id"]: left["reasons"] for left in plan["unassigned"]}
    told = {name: [(reason["vehicle_type"], reason["code"], reason["message"], [
        (remedy["code"], remedy["who"], remedy["text"]) for remedy in reason["remedies"]])
        for reason in each] for name, each in reasons.items()}
    assert told == {
        "A": [("truck", "SKILLS", "truck-2 lacks crane.",
               [("SKILLS", "truck", "fits if truck-2 had crane")])],
        "B": [("truck", "VEHICLE", "truck may not serve it.",
               [("VEHICLES", "truck", "fits if truck may serve it")])]}
    assert [reason["changes"] for each in reasons.values() for reason in each] == [
        [{"path": "$.fleet[0].skills", "to": ["crane"]}],
        [{"path": "$.customers[1].vehicles", "to": None}]]


@pytest.mark.parametrize(("count", "forbidden", "changed"), [
    (1, ["truck", "truck-1"], ["truck", "truck-1"]), (2, ["truck", "truck-1"], ["truck"]),
    (2, ["truck-1", "truck", "truck-2"], ["truck", "truck-1"]), (1, ["truck"], ["truck"]),
    (2, ["truck-2", "truck-1"], ["truck-2"])])
def test_remedy_names_all_that_must_be_forbidden_no_more(
        client: httpx.Client, smallest: Request, count: int, forbidden: list[str],
        changed: list[str]) -> None:
    smallest["fleet"][0]["count"] = count
    # Another customer tells the vehicles of the type apart.
    first, second = smallest["customers"]
    first["vehicles"] = {"allowed": ["truck-1"]}
    second["vehicles"] = {"forbidden": forbidden}
    left, = client.post("/plan", json=smallest).json()["unassigned"]
    reason, = left["reasons"]
    assert reason["remedy"] == f"fits if {' and '.join(changed)} may serve it"
    rest = [name for name in forbidden if name not in changed]
    second["vehicles"] = {"forbidden": rest} if rest else None
    assert client.post("/plan", json=smallest).json()["unassigned"] == []


def test_names_of_several_lines_are_named_in_remedies(client: httpx.Client,
                                                      smallest: Request) -> None:
    smallest["fleet"][0]["id"] = "big\ntruck"
    smallest["customers"][1]["vehicles"] = {"forbidden": ["big\ntruck"]}
    left, = client.post("/plan", json=smallest).json()["unassigned"]
    assert left["reasons"][0]["remedy"] == "fits if big\ntruck may serve it"


def test_explained_customer_has_the_same_remedy(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0]["count"] = 1
    smallest["customers"][1]["vehicles"] = {"forbidden": ["truck-1", "truck"]}
    plan = client.post("/plan", json=smallest).json()
    reply = client.post("/explain", json={"problem": smallest, "plan": plan, "customer": "B"})
    (reason,), (planned,) = reply.json()["reasons"], plan["unassigned"][0]["reasons"]
    changes = [{"path": "$.problem.customers[1].vehicles", "to": None}]
    (remedy,) = planned["remedies"]
    assert reason == planned | {"changes": changes, "remedies": [remedy | {"changes": changes}]}


def test_a_named_vehicle_is_replanned_by_its_name(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0]["count"] = 3
    first, second = smallest["customers"]
    first["vehicles"] = {"allowed": ["truck-3"]}
    second["vehicles"] = {"allowed": ["truck-3", "truck-1"]}
    plan = client.post("/plan", json=smallest).json()
    assert [route["vehicle"] for route in plan["routes"]] == ["truck-3"]
    third = {"id": "C", "location": [1, 1], "demand": [1], "unassigned_cost": 1,
             "vehicles": {"forbidden": ["truck-3"]}}
    days = smallest | {"customers": [first, second, third], "replan": {
        "plan": plan, "freeze_before": 100}}
    on = client.post("/plan", json=days)
    assert on.status_code == 200, on.text
    assert on.json()["replan"]["settled"][0]["vehicle"] == "truck-3"
    served = {stop["id"]: route["vehicle"] for route in on.json()["routes"]
              for trip in route["trips"] for stop in trip["stops"][1:-1]}
    assert served["A"] == served["B"] == "truck-3"
    assert served.get("C") != "truck-3"
    days["replan"] |= {"unavailable": ["truck-3"]}
    out = client.post("/plan", json=days).json()
    assert {stop["id"]: route["vehicle"] for route in out["routes"]
            for trip in route["trips"] for stop in trip["stops"][1:-1]}.get("B") != "truck-2"


def test_nothing_is_rounded_on_the_globe(client: httpx.Client, smallest: Request) -> None:
    smallest |= {"planar_rounding": "round", "planar_unit": 1}
    plan = client.post("/plan", json=smallest).json()
    assert plan["summary"]["distance"] % 1 == 0
    (error,) = client.post("/plan", json=smallest | {
        "coordinate_system": "geographic"}).json()["errors"]
    assert (error["code"], error["path"]) == ("ROUNDED_ON_GLOBE", "$.planar_rounding")


def test_leaving_out_costs_what_each_customer_says(client: httpx.Client,
                                                   smallest: Request) -> None:
    for customer, price in zip(smallest["customers"], (7, None), strict=True):
        customer |= {"skills": ["crane"], "unassigned_cost": price}
    plan = client.post("/plan", json=smallest | {"unassigned_cost": 5}).json()
    assert (plan["cost"]["unassigned"], plan["summary"]["must_unserved"]) == (12, 0)
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    assert plan["cost"]["unassigned"] > 14
    assert plan["summary"]["must_unserved"] == 1
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert checked["feasible"]
    assert checked["cost"] == plan["cost"]
    assert checked["summary"] == plan["summary"]


def test_one_customer_has_one_kind_of_window(client: httpx.Client, smallest: Request) -> None:
    smallest["customers"][0] |= {"time_window": {}, "time_windows": [{"latest": 900}]}
    assert client.post("/plan", json=smallest).status_code == 200
    smallest["customers"][0]["time_window"] = {"latest": 900}
    (error,) = client.post("/plan", json=smallest).json()["errors"]
    assert (error["code"], error["path"]) == (
        "TWO_KINDS_OF_WINDOWS", "$.customers[0].time_windows")


def test_who_is_preferred_serves_unless_it_costs_more(
        client: httpx.Client, searching: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0] |= {"count": 2, "max_stops": 1}
    first, second = smallest["customers"]
    first["vehicle_costs"] = {"truck": 5, "truck-2": 1}
    smallest["customers"].append(second | {"id": "C", "vehicle_costs": {"truck-1": 2}})
    second |= {"vehicles": {"forbidden": ["truck"]}, "unassigned_cost": 1}
    smallest["options"] = {"search_iterations": 300, "time_limit": 60}
    plan = client.post("/plan", json=smallest).json()
    assert plan["cost"]["stops"] == 5
    plan = searching.post("/plan", json=smallest | {"replan": {"plan": plan}}).json()
    served = {route["vehicle"]: [stop["id"] for stop in route["trips"][0]["stops"][1:-1]]
              for route in plan["routes"]}
    assert (served, plan["cost"]["stops"]) == ({"truck-2": ["A"], "truck-1": ["C"]}, 3)
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert checked["feasible"]
    assert checked["cost"] == plan["cost"]
    told = client.post("/explain", json={"problem": smallest, "plan": plan, "customer": "A"}).json()
    (other,) = [each for each in told["alternatives"] if each["kind"] == "vehicle"]
    assert other["cost"]["stops"] == 5 - 1
    again = client.post("/plan", json=smallest | {
        "replan": {"plan": plan, "freeze_before": 60}}).json()
    assert again["cost"]["stops"] == 3
    first["vehicle_costs"] = {"lorry": 5}
    (error,) = client.post("/plan", json=smallest).json()["errors"]
    assert (error["code"], error["path"]) == (
        "UNKNOWN_VEHICLE", "$.customers[0].vehicle_costs.lorry")


def test_whoever_comes_between_two_windows_waits(client: httpx.Client, smallest: Request) -> None:
    # 5 km at 40 km/h: from 600 on it is reached at 1050, after the first window.
    smallest["fleet"][0]["shift"] = {"earliest": 600}
    smallest["customers"] = [smallest["customers"][0] | {"time_windows": [
        {"earliest": 0, "latest": 1000, "early_cost_per_hour": 6},
        {"earliest": 1650, "latest": 1700, "early_cost_per_hour": 6, "late_cost_per_hour": 5}]}]
    plan = client.post("/plan", json=smallest).json()
    (late,) = [stop for stop in plan["routes"][0]["trips"][0]["stops"] if stop["id"] == "A"]
    assert (late["service_start"], late["lateness"]) == (1650, 0)
    assert plan["cost"]["earliness"] == pytest.approx(late["waiting"] / 600)
    plan["routes"][0]["trips"][0]["stops"][1]["service_start"] = late["arrival"] + 1
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert not checked["feasible"]


def test_what_is_aboard_is_told_at_each_stop(client: httpx.Client, smallest: Request) -> None:
    first, second = smallest["customers"]
    first |= {"demand": [8], "pickup": [3]}
    second |= {"demand": [0], "pickup": [10]}
    smallest["fleet"][0] |= {"capacity": [13], "pickups": "last",
                             "costs": {"per_km": 1, "per_load_km": 0.5}}
    plan = client.post("/plan", json=smallest).json()
    PlanReply.model_validate(plan)
    trip, = plan["routes"][0]["trips"]
    assert [(stop["id"], stop["load"]) for stop in trip["stops"]][1:] == [
        (first["id"], [3.0]), (second["id"], [13.0]), (trip["stops"][-1]["id"], [13.0])]
    assert (trip["load"], trip["load_rate"]) == ([8.0], 1.0)
    # 16 km around; 5 km with 8, 5 km with 3, 6 km with 13
    assert plan["cost"]["distance"] == pytest.approx(16 + 0.5 * (40 + 15 + 78))
    checked = client.post("/check", json={"problem": smallest, "plan": plan}).json()
    assert checked["feasible"]
    assert checked["cost"] == plan["cost"]
    smallest["fleet"][0]["capacity"] = [12]
    left_out, = client.post("/plan", json=smallest).json()["unassigned"]
    assert left_out["reasons"][0]["code"] == "PICKUP_ORDER"
