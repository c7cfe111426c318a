"""Any plan against any problem, over HTTP."""

import json
from typing import Any

import httpx
import pytest
from typer.testing import CliRunner

from app.cli import commands, planning
from tests.app.plans.asking import judged, planned, refused

Request = dict[str, Any]


@pytest.mark.parametrize("name", ["smallest", "with_drones"])
def test_a_reply_passed_back_unchanged_is_feasible_at_the_same_cost(
        client: httpx.Client, request: pytest.FixtureRequest, name: str) -> None:
    problem = request.getfixturevalue(name)
    plan = planned(client, problem)
    verdict = judged(client, problem, plan)
    assert (verdict["feasible"], verdict["violations"]) == (True, [])
    assert verdict["cost"] == plan["cost"]
    assert verdict["summary"] == plan["summary"]


def test_ways_of_a_plan_that_states_its_times_are_told_where_asked_for(
        client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, smallest)
    assert "routes" not in judged(client, smallest, plan)
    smallest["options"] = {**smallest.get("options", {}), "geometry": True}
    (route,) = judged(client, smallest, plan)["routes"]
    assert all(stop["geometry"] for stop in route["trips"][0]["stops"][1:])
    assert route["working_duration"] == plan["routes"][0]["working_duration"]


def test_overtime_stops_and_co2_are_told_and_judged(client: httpx.Client,
                                                    smallest: Request) -> None:
    # A round of 16 km at 40 km/h takes 24 minutes.
    smallest["fleet"][0] |= {
        "costs": {"per_km": 0, "per_stop": 1.5}, "max_working_duration": 1200, "max_stops": 2,
        "overtime": {"max_duration": 300, "cost_per_hour": 30}, "co2_kg_per_km": 0.25}
    plan = planned(client, smallest)
    assert plan["status"] == "complete"
    assert plan["routes"][0]["overtime"] == 240
    assert {term: cost for term, cost in plan["cost"].items() if cost} == {
        "total": 5.0, "stops": 3.0, "overtime": 2.0}
    assert plan["summary"]["co2_kg"] == 4.0
    assert judged(client, smallest, plan)["summary"] == plan["summary"]
    for change in ({"overtime": None}, {"max_stops": 1}):
        stricter = smallest | {"fleet": [smallest["fleet"][0] | change]}
        verdict = judged(client, stricter, plan)
        assert [broken["code"] for broken in verdict["violations"]] == [
            "WORKING_DURATION" if "overtime" in change else "MAX_STOPS"]


def test_all_work_may_be_overtime(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0] |= {"max_working_duration": 0, "overtime": {"cost_per_hour": 30}}
    plan = planned(client, smallest)
    assert [route["working_rate"] for route in plan["routes"]] == [1e9]
    assert judged(client, smallest, plan)["feasible"]


@pytest.mark.parametrize(("change", "path"), [
    ({"overtime": {}}, "overtime.cost_per_hour"), ({"max_stops": -1}, "max_stops"),
    ({"max_sorties": 1.5}, "max_sorties"), ({"co2_kg_per_km": -1}, "co2_kg_per_km"),
    ({"overtime": {"cost_per_hour": 1, "max_duration": -1}}, "overtime.max_duration")])
def test_wrong_limits_of_work_are_refused(client: httpx.Client, smallest: Request,
                                          change: Request, path: str) -> None:
    smallest["fleet"][0] |= change
    reply = client.post("/plan", json=smallest)
    assert [error["path"] for error in reply.json()["errors"]] == [f"$.fleet[0].{path}"]


def test_a_plan_of_routes_alone_is_enough(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, smallest)
    stops = [{key: stop[key] for key in ("kind", "id", "arrival", "service_start", "departure")}
             for stop in plan["routes"][0]["trips"][0]["stops"]]
    bare = {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [{"stops": stops}]}]}
    assert judged(client, smallest, bare)["feasible"]


def test_every_broken_rule_is_told_with_its_place(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, smallest)
    smallest["customers"][0]["time_window"] = {"latest": 1}
    smallest["fleet"][0]["capacity"] = [0]
    stop = plan["routes"][0]["trips"][0]["stops"][2]
    stop["arrival"] += 1
    smallest["customers"].append({"id": "forgotten", "location": [1, 1], "demand": [1]})
    verdict = judged(client, smallest, plan)
    assert not verdict["feasible"]
    trip = "$.plan.routes[0].trips[0]"
    assert {(item["code"], item["path"]) for item in verdict["violations"]} == {
        ("MISSING", "$.problem.customers[2]"), ("CAPACITY", trip),
        ("TIME_WINDOW", f"{trip}.stops[1]"), ("TIME_MISMATCH", f"{trip}.stops[2]")}
    assert (verdict["summary"]["customers"], verdict["summary"]["served"]) == (3, 2)


def test_flights_are_judged_under_the_names_of_the_wire(client: httpx.Client,
                                                        smallest: Request) -> None:
    smallest["customers"][0]["served_by"] = "drone"
    smallest["fleet"][0]["drones"] = {"count": 1, "capacity": [100]}
    plan = planned(client, smallest)
    smallest["customers"][0]["time_window"] = {"latest": 0}
    (violation,) = judged(client, smallest, plan)["violations"]
    assert violation["path"] == "$.plan.routes[0].trips[0].sorties[0].customers[0]"


@pytest.mark.parametrize("plan", [
    {"routes": []},
    {"routes": [{"vehicle": "truck-99", "type": "truck", "trips": []}]},
    {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [{"stops": []}]}]},
])
def test_a_plan_that_makes_no_sense_is_judged_not_refused(client: httpx.Client, smallest: Request,
                                                          plan: Request) -> None:
    verdict = judged(client, smallest, plan)
    assert not verdict["feasible"]
    assert verdict["cost"]["total"] == 0


def test_all_errors_of_problem_and_plan_come_at_once(client: httpx.Client,
                                                     smallest: Request) -> None:
    plan = planned(client, smallest)
    smallest["fleet"][0]["depot"] = "moon"
    plan["routes"][0]["trips"][0]["stops"][1]["id"] = "nobody"
    assert refused(client, {"problem": smallest, "plan": plan}) == [
        ("UNKNOWN_DEPOT", "$.problem.fleet[0].depot"),
        ("UNKNOWN_CUSTOMER", "$.plan.routes[0].trips[0].stops[1].id")]
    # With an error of the schema too, what is known of the rest is still compared.
    smallest["fleet"][0]["count"] = "two"
    smallest["planar_unit"] = 0
    plan["routes"][0]["trips"][0]["stops"][0]["id"] = "mars"
    assert set(refused(client, {"problem": smallest, "plan": plan, "more": 1})) == {
        ("UNKNOWN_FIELD", "$.more"),
        ("OUT_OF_RANGE", "$.problem.planar_unit"), ("WRONG_TYPE", "$.problem.fleet[0].count"),
        ("UNKNOWN_CUSTOMER", "$.plan.routes[0].trips[0].stops[1].id"),
        ("UNKNOWN_DEPOT", "$.plan.routes[0].trips[0].stops[0].id")}


def test_unknown_fields_and_missing_parts_are_refused(client: httpx.Client,
                                                      smallest: Request) -> None:
    plan = planned(client, smallest)
    plan["routes"][0]["colour"] = "red"
    assert refused(client, {"problem": smallest, "plan": plan}) == [
        ("UNKNOWN_FIELD", "$.plan.routes[0].colour")]
    assert refused(client, {}) == [("MISSING_FIELD", "$.plan"), ("MISSING_FIELD", "$.problem")]
    assert refused(client, []) == [("WRONG_TYPE", "$")]


@pytest.mark.parametrize("body", [b"", b"{", b"\xff", b'{"problem": NaN}'])
def test_what_is_not_json_is_refused(client: httpx.Client, body: bytes) -> None:
    assert client.post("/check", content=body).status_code == 400


def test_loads_without_capacity_stay_numbers(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, smallest)
    smallest["fleet"][0]["capacity"] = [0]
    reply = client.post("/check", json={"problem": smallest, "plan": plan})
    verdict = json.loads(reply.content, parse_constant=pytest.fail)
    assert verdict["summary"]["load_rate"]["max"] == 1e9


def test_a_replanned_plan_is_held_against_the_past(client: httpx.Client,
                                                   smallest: Request) -> None:
    plan = planned(client, smallest)
    smallest["replan"] = {"plan": plan, "freeze_before": 450}
    assert judged(client, smallest, plan)["feasible"]
    changed = json.loads(json.dumps(plan))
    changed["routes"][0]["trips"][0]["stops"][1]["departure"] += 1
    codes = {item["code"] for item in judged(client, smallest, changed)["violations"]}
    assert "FROZEN" in codes


def test_the_command_holds_a_plan_against_the_past_too(
        client: httpx.Client, smallest: Request, tmp_path: Any) -> None:
    plan = planned(client, smallest)
    smallest["replan"] = {"plan": plan, "freeze_before": 450}
    changed = json.loads(json.dumps(plan))
    changed["routes"][0]["trips"][0]["stops"][1]["departure"] += 1
    (tmp_path / "problem.json").write_text(json.dumps(smallest))
    for name, content in (("plan", plan), ("changed", changed)):
        (tmp_path / f"{name}.json").write_text(json.dumps(content))

    def run(name: str) -> Any:
        return CliRunner().invoke(commands.cli, ["check", str(tmp_path / "problem.json"),
                                            str(tmp_path / f"{name}.json")])

    assert run("plan").exit_code == 0
    assert run("changed").exit_code == planning.EXIT_INFEASIBLE
    assert "FROZEN" in run("changed").output


def test_the_documented_example_runs_as_it_stands(client: httpx.Client) -> None:
    operation = client.get("/openapi.json").json()["paths"]["/check"]["post"]
    example = operation["requestBody"]["content"]["application/json"]["examples"]["check"]
    verdict = client.post("/check", json=example["value"]).json()
    assert {item["code"] for item in verdict["violations"]} == {"CAPACITY", "TIME_WINDOW"}


def test_a_plan_that_takes_decades_can_be_judged_too(client: httpx.Client,
                                                     smallest: Request) -> None:
    for customer in smallest["customers"]:
        customer["service_duration"] = 1e9
    plan = planned(client, smallest)
    assert plan["summary"]["makespan"] > 2e9
    assert judged(client, smallest, plan)["cost"] == plan["cost"]
