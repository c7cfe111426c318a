"""A unit more of what binds, as changes of the request, which save what is said."""

from typing import Any

import httpx
import pytest

from examples.remedy import applied
from tests.app.plans.asking import planned
from tests.app.plans.test_changes import START, request_of

Request = dict[str, Any]

LUNCH = {"id": "lunch", "duration": 600, "start": {"latest": 0}}
SMALL = {"count": 1, "capacity": [5], "endurance": 690}
FARM = {"location": [6, 0], "demand": [1]}


def bound(client: httpx.Client, request: Request, rule: str) -> Request:
    """Return what is told of a limit that keeps A out of the plan, of which a unit more saves."""
    plan = planned(client, request)
    assert [left["id"] for left in plan["unassigned"]] in (["A"], ["S"])
    subject = {"customer": "A"} if plan["unassigned"][0]["id"] == "A" else {"shipment": "S"}
    reply = client.post("/explain", json={"problem": request, "plan": plan, **subject,
                                          "options": {"time_limit": 30}})
    told = {each["rule"]: each for each in reply.json()["binding"]}
    assert rule in told, told
    found: Request = told[rule]
    assert found["saves_per_unit"] > 0
    return found


@pytest.mark.parametrize(("customer", "van", "rule", "changes"), [
    ({"time_window": {"latest": 330}}, {}, "time_window.latest",
     [{"path": "customers[0].time_window.latest", "by": 60}]),
    ({"time_windows": [{"latest": 330}]}, {}, "time_window.latest",
     [{"path": "customers[0].time_windows[0].latest", "by": 60}]),
    ({"time_windows": [{"latest": 60}, {"earliest": 90, "latest": 330}]}, {},
     "time_windows[-1].latest", [{"path": "customers[0].time_windows[1].latest", "by": 60}]),
    ({"release_time": 30}, {"shift": {"latest": 720}}, "release_time",
     [{"path": "customers[0].release_time", "by": -30}]),
    ({}, {"shift": {"latest": 690}}, "shift.latest",
     [{"path": "fleet[0].shift.latest", "by": 60}]),
    ({}, {"max_working_duration": 690}, "max_working_duration",
     [{"path": "fleet[0].max_working_duration", "by": 60}]),
    ({}, {"max_distance": 11_500}, "max_distance",
     [{"path": "fleet[0].max_distance", "by": 1000}]),
    ({}, {"max_trip_distance": 11_500}, "max_trip_distance",
     [{"path": "fleet[0].max_trip_distance", "by": 1000}]),
    ({"demand": [6]}, {}, "capacity", [{"path": "fleet[0].capacity[0]", "by": 1}]),
    ({}, {"max_stops": 0}, "max_stops", [{"path": "fleet[0].max_stops", "by": 1}]),
    ({"skills": ["lift"]}, {}, "skills", [{"path": "customers[0].skills", "to": []}]),
    ({"vehicles": {"forbidden": ["van"]}}, {}, "vehicles",
     [{"path": "customers[0].vehicles", "to": None}]),
    ({"served_by": "drone"}, {}, "served_by", [{"path": "customers[0].served_by", "to": "either"}]),
    ({"served_by": "drone"}, {"drones": SMALL}, "drones.endurance",
     [{"path": "fleet[0].drones.endurance", "by": 60}]),
    ({"served_by": "drone"}, {"drones": [SMALL | {"id": "a.b"}]}, "drones[a.b].endurance",
     [{"path": "fleet[0].drones[0].endurance", "by": 60}]),
    ({"time_window": {"latest": 360}}, {"breaks": [LUNCH]}, "breaks[lunch]",
     [{"path": "fleet[0].breaks", "to": []}]),
])
def test_a_unit_more_of_what_binds_has_the_customer_served(
        client: httpx.Client, customer: Request, van: Request, rule: str,
        changes: list[Request]) -> None:
    request = request_of(customer, van)
    told = bound(client, request, rule)["changes"]
    assert told == [each | {"path": f"$.problem.{each['path']}"} for each in changes]
    assert planned(client, applied({"problem": request}, told)["problem"])["unassigned"] == []


@pytest.mark.parametrize(("customer", "van", "rule", "changes"), [
    ({"time_window": {"latest": "06:05:30"}}, {}, "time_window.latest",
     [{"path": "$.problem.customers[0].time_window.latest", "to": "06:06:30"}]),
    ({}, {"max_travel_duration": "0:11:30"}, "max_travel_duration",
     [{"path": "$.problem.fleet[0].max_travel_duration", "to": "0:12:30"}]),
])
def test_a_unit_more_is_told_as_the_request_writes_times(
        client: httpx.Client, customer: Request, van: Request, rule: str,
        changes: list[Request]) -> None:
    request = request_of(customer, van, plan_start=START)
    assert bound(client, request, rule)["changes"] == changes


@pytest.mark.parametrize(("shipment", "rule", "changes"), [
    ({"max_time_between": 450}, "max_time_between", [
        {"path": "$.problem.shipments[0].max_time_between", "by": 60}]),
    ({"skills": ["lift"]}, "skills", [{"path": "$.problem.shipments[0].skills", "to": []}]),
    ({"pickup": {"location": [6, 0], "time_window": {"latest": 330}}}, "time_window.latest", [
        {"path": "$.problem.shipments[0].pickup.time_window.latest", "by": 60}]),
])
def test_a_unit_more_of_shipments_is_stated_where_they_are(
        client: httpx.Client, shipment: Request, rule: str, changes: list[Request]) -> None:
    whole = {"id": "S", "amount": [1], "pickup": {"location": [6, 0]},
             "delivery": {"location": [6, 8]}, **shipment}
    request = request_of({}, {}, customers=[], shipments=[whole])
    assert bound(client, request, rule)["changes"] == changes


def test_a_unit_more_than_a_request_can_state_changes_nothing(client: httpx.Client) -> None:
    request = request_of({"demand": [10**9]}, {"capacity": [10**9]})
    plan = planned(client, request)
    reply = client.post("/explain", json={"problem": request, "plan": plan, "customer": "A",
                                          "options": {"time_limit": 30}})
    assert [each["changes"] for each in reply.json()["binding"]
            if each["rule"] == "capacity"] == [[]]
