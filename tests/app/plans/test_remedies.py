"""Remedies as replies have them: code, whom about, changes, whether they suffice, words."""

import json
from typing import Any

import httpx
import pytest

from app.plans.changes import CHANGES, WHOSE, Changing, Stated
from app.schemas.request import PlanRequest
from model.counsel.remedy import CLAUSES, Change
from tests.app.plans.asking import planned
from tests.app.plans.test_changes import request_of

Request = dict[str, Any]


def remedies_of(client: httpx.Client, request: Request) -> list[Request]:
    """Return the remedies of the only reason why the only one is left out."""
    left, = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    remedies: list[Request] = reason["remedies"]
    assert (reason["remedy"], reason["changes"]) == (remedies[0]["text"], remedies[0]["changes"])
    return remedies


def test_a_remedy_of_one_limit_has_its_code_and_whose_it_is(client: httpx.Client) -> None:
    assert remedies_of(client, request_of({"time_window": {"latest": 300}}, {})) == [{
        "code": "WINDOW", "who": "A", "suffices": True,
        "changes": [{"path": "$.customers[0].time_window.latest", "by": 60}],
        "text": "fits if its window closed 1 minute later"}]


def test_a_remedy_of_several_limits_tells_them_one_by_one(client: httpx.Client) -> None:
    request = request_of({}, {"shift": {"latest": 600}, "max_trip_distance": 10_000})
    trip = {"path": "$.fleet[0].max_trip_distance", "by": 2000}
    shift = {"path": "$.fleet[0].shift.latest", "by": 120}
    assert remedies_of(client, request) == [{
        "code": "SEVERAL", "who": None, "suffices": True, "changes": [trip, shift],
        "text": "fits if trips could be 2 km longer and if van's shift ended 2 minutes later",
        "parts": [{"code": "TRIP_DISTANCE", "who": "van", "suffices": False, "changes": [trip],
                   "text": "fits if trips could be 2 km longer"},
                  {"code": "SHIFT", "who": "van", "suffices": False, "changes": [shift],
                   "text": "fits if van's shift ended 2 minutes later"}]}]


def test_a_buffer_is_not_said_to_suffice(client: httpx.Client) -> None:
    area = [[5, 1], [7, 1], [7, 2], [5, 2], [5, 1]]
    drones = {"count": 1, "capacity": [5], "endurance": 3600}
    *_, buffer = remedies_of(client, request_of({"served_by": "drone"}, {"drones": drones},
                                                airspace={"no_fly": [area], "buffer": 1500}))
    enough = buffer["changes"][0]["to"]
    assert buffer == {
        "code": "BUFFER", "who": None, "suffices": False,
        "changes": [{"path": "$.airspace.buffer", "to": enough}],
        "text": f"lies far enough away with airspace.buffer {enough}"}


def test_remedies_of_a_plan_are_of_the_problem_beside_it(client: httpx.Client) -> None:
    problem = request_of({}, {"shift": {"latest": 600}, "max_trip_distance": 10_000})
    plan = planned(client, problem)
    reply = client.post("/explain", json={"problem": problem, "plan": plan, "customer": "A"})
    (remedy,) = reply.json()["reasons"][0]["remedies"]
    changes = [change for part in (remedy, *remedy["parts"]) for change in part["changes"]]
    assert [change["path"] for change in changes] == [
        "$.problem.fleet[0].max_trip_distance", "$.problem.fleet[0].shift.latest"] * 2


def test_every_limit_has_words_and_changes() -> None:
    assert CLAUSES.keys() == CHANGES.keys() >= WHOSE.keys()


@pytest.mark.parametrize(("subject", "change", "who"), [
    ("A", Change("window"), "A"), ("A", Change("window", "A/kiosk"), "A/kiosk"),
    ("S", Change("end_window", "pickup mill"), "S/pickup/mill"),
    ("S", Change("end_window", "delivery"), "S/delivery"),
    ("S", Change("detour"), "S"), ("A", Change("lag"), "A"),
    ("A", Change("capacity"), "van"), ("A", Change("vehicles", "van", names=("van-1",)), "van"),
    ("A", Change("count"), "van"), ("A", Change("endurance"), "van"),
    ("A", Change("endurance", "small"), "small"),
    ("A", Change("batteries_aboard", "van", names=("small",)), "small"),
    ("A", Change("batteries_aboard", "van"), "van"),
    ("A", Change("hub_chargers", "hub"), "hub"), ("A", Change("break", "lunch"), "lunch"),
    ("A", Change("unassigned_cost"), None)])
def test_a_remedy_says_whom_it_is_about(subject: str, change: Change, who: str | None) -> None:
    shipment = {"id": "S", "delivery": {"location": [6, 0]}, "pickups": [
        {"id": "mill", "amount": [1], "location": [3, 0]}]}
    request = PlanRequest.model_validate_json(json.dumps(request_of({}, {}, shipments=[shipment])))
    assert Changing.of(Stated(request), "van", subject, subject == "S").who(change) == who
