"""Remedies as changes of the request: where, and in its own notation."""

import json
from typing import Any

import httpx
import pytest

from app.plans.changes import Changing, Stated
from app.schemas.request import PlanRequest
from examples.remedy import applied
from model.counsel.remedy import remedy_of
from tests.app.plans.asking import planned

Request = dict[str, Any]

START = "2026-03-02T06:00:00+01:00"


def request_of(customer: Request, van: Request, **parts: Any) -> Request:
    """Return a day of one van that drives a kilometre a minute to one customer six away."""
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": [{"id": "A", "location": [6, 0], "demand": [1], **customer}],
            "fleet": [{"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60, **van}],
            "options": {"time_limit": 60, "search_iterations": 200}, **parts}


def changes_of(client: httpx.Client, request: Request) -> list[Request]:
    """Return the changes of the first remedy, once they have the customer served."""
    left, = planned(client, request)["unassigned"]
    changes: list[Request] = left["reasons"][0]["changes"]
    assert planned(client, applied(request, changes))["unassigned"] == []
    return changes


@pytest.mark.parametrize(("customer", "van", "changes"), [
    ({"time_window": {"latest": 300}}, {},
     [{"path": "$.customers[0].time_window.latest", "by": 60}]),
    ({"time_windows": [{"latest": 330}]}, {},
     [{"path": "$.customers[0].time_windows[0].latest", "by": 30}]),
    ({"time_windows": [{"latest": 60}, {"earliest": 100, "latest": 330}]}, {},
     [{"path": "$.customers[0].time_windows[1].latest", "by": 30}]),
    ({"time_windows": [{"latest": 355}, {"earliest": 357, "latest": 9000}]},
     {"shift": {"latest": 716}},
     [{"path": "$.fleet[0].shift.latest", "by": 6}]),
    ({"demand": [9.5]}, {}, [{"path": "$.fleet[0].capacity", "to": [9.5]}]),
    ({"skills": ["lift", "cool"]}, {"skills": ["cool"]},
     [{"path": "$.fleet[0].skills", "to": ["cool", "lift"]}]),
    ({}, {"max_working_duration": 600}, [{"path": "$.fleet[0].max_working_duration", "by": 120}]),
    ({}, {"max_trip_distance": 10_000}, [{"path": "$.fleet[0].max_trip_distance", "by": 2000}]),
    ({}, {"shift": {"latest": 600}, "max_trip_distance": 10_000},
     [{"path": "$.fleet[0].max_trip_distance", "by": 2000},
      {"path": "$.fleet[0].shift.latest", "by": 120}]),
    ({"vehicles": {"forbidden": ["van"]}}, {}, [{"path": "$.customers[0].vehicles", "to": None}]),
    ({"served_by": "drone"}, {}, [{"path": "$.customers[0].served_by", "to": "either"}]),
    ({"location": [0, 6], "served_by": "drone"}, {"drones": {
        "count": 1, "capacity": [5], "endurance": 3600, "preset": "eu-pdra-g01"}},
     [{"path": "$.fleet[0].drones.max_range", "to": 6000}]),
])
def test_changes_are_by_so_much_where_a_number_stands(
        client: httpx.Client, customer: Request, van: Request, changes: list[Request]) -> None:
    assert changes_of(client, request_of(customer, van)) == changes


@pytest.mark.parametrize(("customer", "van", "changes"), [
    ({"time_window": {"latest": "06:05"}}, {},
     [{"path": "$.customers[0].time_window.latest", "to": "06:06:00"}]),
    ({}, {"shift": {"earliest": "07:00", "latest": "2026-03-02T07:10:00+01:00"}},
     [{"path": "$.fleet[0].shift.latest", "to": "2026-03-02T07:12:00+01:00"}]),
    ({}, {"max_working_duration": "0:10"},
     [{"path": "$.fleet[0].max_working_duration", "to": "0:12"}]),
    ({}, {"max_travel_duration": "PT10M30S"},
     [{"path": "$.fleet[0].max_travel_duration", "to": "PT12M"}]),
    ({}, {"shift": {"latest": 1772427900}},
     [{"path": "$.fleet[0].shift.latest", "by": 420}]),
    ({"time_window": {"earliest": "01:00", "latest": "02:00"}},
     {"shift": {"earliest": "22:00", "latest": "+1 09:00"}, "speed_kmh": 1.25},
     [{"path": "$.customers[0].time_window.latest", "to": "+1 02:48:00"},
      {"path": "$.customers[0].time_window.earliest", "to": "+1 01:00:00"}]),
])
def test_changes_are_to_times_where_the_request_writes_them(
        client: httpx.Client, customer: Request, van: Request, changes: list[Request]) -> None:
    request = request_of(customer, van, plan_start=START, time_zone="Europe/Berlin")
    assert changes_of(client, request) == changes


def test_changes_of_a_problem_beside_a_plan_are_of_that_problem(client: httpx.Client) -> None:
    problem = request_of({"time_window": {"latest": 300}}, {})
    plan = planned(client, problem)
    reply = client.post("/explain", json={"problem": problem, "plan": plan, "customer": "A"})
    (reason,) = reply.json()["reasons"]
    assert reason["changes"] == [{"path": "$.problem.customers[0].time_window.latest", "by": 60}]


def test_a_buffer_is_told_as_a_change(client: httpx.Client) -> None:
    area = {"type": "Polygon", "coordinates": [[[5, 1], [7, 1], [7, 2], [5, 2], [5, 1]]]}
    request = request_of(
        {"served_by": "drone"},
        {"drones": {"count": 1, "capacity": [5], "endurance": 3600}},
        airspace={"no_fly": [area["coordinates"][0]], "buffer": 1500})
    left, = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    (change,) = reason["other_changes"] if "other_changes" in reason else reason["changes"]
    assert change["path"] == "$.airspace.buffer"
    assert 990 <= change["to"] < 1000


@pytest.mark.parametrize(("limit", "change"), [
    ("window", {"path": "$.shipments[0].delivery.time_window.latest", "by": 60}),
    ("by_truck", {"path": "$.shipments[0].delivery.served_by", "to": "either"}),
    ("time_aboard", {"path": "$.shipments[0].max_time_between", "by": 60})])
def test_what_is_back_at_the_depot_is_changed_at_its_delivery(limit: str, change: Request) -> None:
    shipment = {"id": "s", "amount": [1], "pickup": {"location": [2, 0]}, "max_time_between": 300,
                "delivery": {"location": [6, 0], "time_window": {"latest": 1200}}}
    request = PlanRequest.model_validate_json(json.dumps(request_of({}, {}, shipments=[shipment])))
    changing = Changing.of(Stated(request), "van", "s", is_shipment=True)
    assert changing.changes(remedy_of(limit, quantity=60_000)) == [change]


@pytest.mark.parametrize(("limit", "van"), [
    ("overtime", {"overtime": {"max_duration": 10**9, "cost_per_hour": 1}}), ("shift", {}),
    ("work", {"max_working_duration": 10**9 - 59})])
def test_nothing_is_changed_to_what_a_request_can_not_state(limit: str, van: Request) -> None:
    request = PlanRequest.model_validate_json(json.dumps(request_of({}, van)))
    changing = Changing.of(Stated(request), "van", "A", is_shipment=False)
    assert changing.changes(remedy_of(limit, quantity=60_000)) == []


def test_nothing_is_changed_where_the_request_has_no_place_for_it() -> None:
    shipment = {"id": "s", "delivery": {"location": [6, 0]}, "pickups": [
        {"id": "farm", "amount": [1], "location": [2, 0]},
        {"id": "mill", "amount": [1], "location": [3, 0], "time_window": {"latest": 60}}]}
    request = PlanRequest.model_validate_json(json.dumps(request_of({}, {}, shipments=[shipment])))
    changing = Changing.of(Stated(request), "van", "s", is_shipment=True)
    assert changing.changes(remedy_of("end_window", "pickup", 60_000)) == []
    assert changing.changes(remedy_of("vehicles", "van")) == []
    (change,) = changing.changes(remedy_of("end_window", "pickup mill", 60_000))
    assert change["path"] == "$.shipments[0].pickups[1].time_window.latest"


def test_what_is_left_of_a_shipment_is_changed_where_it_is_stated() -> None:
    shipment = {"id": "s", "amount": [1], "pickup": {"location": [2, 0]},
                "delivery": {"location": [6, 0], "time_window": {"latest": 1200}}}
    request = PlanRequest.model_validate_json(json.dumps(request_of({}, {}, shipments=[shipment])))
    changing = Changing.of(Stated(request), "van", "s/delivery", is_shipment=False)
    remedy = remedy_of("window", quantity=60_000)
    assert changing.changes(remedy) == [
        {"path": "$.shipments[0].delivery.time_window.latest", "by": 60}]
    assert changing.who(remedy.changes[0]) == "s/delivery"


@pytest.mark.parametrize(("related", "left"), [(500, [499]), (501, [])])
def test_relations_are_repeated_while_few_are_in_them(related: int, left: list[int]) -> None:
    names = [f"C{number}" for number in range(related)]
    request = PlanRequest.model_validate_json(json.dumps(request_of(
        {}, {}, customers=[{"id": name, "location": [1, 0], "demand": [1]} for name in names],
        relations=[{"kind": "together", "customers": names}])))
    changes = Changing.of(Stated(request), "van", "C0", is_shipment=False).changes(
        remedy_of("relations"))
    assert [len(change["to"][0]["customers"]) for change in changes] == left
