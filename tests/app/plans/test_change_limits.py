"""Plans gone on from of which little may change, over HTTP."""

import random
from itertools import pairwise
from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply
from tests.app.plans.asking import judged
from tests.seeds import seeds

Data = dict[str, Any]

BEHIND: Data = {"new_orders": "behind"}
CONCERNED: Data = {"vehicles": "concerned"}


def customer(name: str, place: float, **more: Any) -> Data:
    """Return a customer on a street, a kilometre and a minute apart."""
    return {"id": name, "location": [place, 0], "demand": [1], "service_duration": 60, **more}


@pytest.fixture
def street() -> Data:
    """Return five customers along a street, and two vans."""
    return {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [customer(name, place) for place, name in enumerate("abcde", 1)],
        "fleet": [{"id": "van", "count": 2, "capacity": [10], "speed_kmh": 60, "max_trips": 3,
                   "costs": {"fixed": 500}}],
        "options": {"time_limit": 60, "search_iterations": 60}}


def planned(client: httpx.Client, request: Data, limits: Data, before: Data | None = None,
            **replan: Any) -> Data:
    """Return a plan that the service finds legal."""
    options = {**request["options"], "change_limits": limits}
    given = {"routes": [], "unassigned": []} if before is None else {
        name: before[name] for name in ("routes", "unassigned")}
    body = {**request, "options": options, "replan": {"plan": given, **replan}}
    reply = client.post("/plan", json=body)
    assert reply.status_code == 200, reply.text
    found: Data = reply.json()
    PlanReply.model_validate(found)
    verdict = judged(client, body, found)
    assert (verdict["violations"], verdict["cost"]) == ([], pytest.approx(found["cost"]))
    return found


def tours(plan: Data) -> dict[str, list[str]]:
    """Return whom each vehicle serves, in order."""
    return {route["vehicle"]: [stop["id"] for trip in route["trips"] for stop in trip["stops"]
                               if stop["kind"] == "customer"] for route in plan["routes"]}


def test_new_order_comes_behind_all_that_its_vehicle_had(searching: httpx.Client,
                                                         street: Data) -> None:
    before = planned(searching, street, {})
    (vehicle, was), = tours(before).items()
    street["customers"].append(customer("n", 2.5))
    assert tours(planned(searching, street, {}, before))[vehicle][-1] != "n"
    plan = planned(searching, street, BEHIND, before)
    assert tours(plan)[vehicle][-1] == "n"
    assert set(tours(plan)[vehicle][:-1]) == set(was)
    # Between others it breaks a rule that is named.
    body = {**street, "options": {**street["options"], "change_limits": BEHIND},
            "replan": {"plan": before}}
    free = planned(searching, street, {}, before)
    assert [each["code"] for each in judged(searching, body, free)["violations"]] == ["ORDER"]


def test_new_order_that_nobody_reaches_behind_the_others_is_left_out(
        searching: httpx.Client, street: Data) -> None:
    street["fleet"][0]["count"] = 1
    before = planned(searching, street, {})
    street["customers"].append(customer("n", 0.5, time_window={"latest": 300}))
    assert not planned(searching, street, {}, before)["unassigned"]
    plan = planned(searching, street, BEHIND, before)
    assert [each["id"] for each in plan["unassigned"]] == ["n"]


def test_only_routes_of_vehicles_that_are_concerned_change(searching: httpx.Client,
                                                           street: Data) -> None:
    street["customers"].append(customer("f", 6))
    street["fleet"][0] |= {"capacity": [3], "max_trips": 1}
    before = planned(searching, street, {})
    (one, own), (other, _) = tours(before).items()
    # Each now drives to and fro, and less by another order.
    places = dict(zip([name for names in tours(before).values() for name in names],
                      [2, 1, 3, 2, 1, 3], strict=True))
    street["customers"] = [customer(name, place) for name, place in places.items()]
    plan = planned(searching, street, CONCERNED, before, concerned=[one])
    assert tours(plan)[other] == tours(before)[other]
    assert tours(plan)[one] != own
    assert sorted(tours(plan)[one]) == sorted(own)
    street["customers"].append(customer("n", 3))
    street["fleet"][0]["capacity"] = [4]
    plan = planned(searching, street, CONCERNED, before)
    assert {name: [each for each in names if each != "n"]
            for name, names in tours(plan).items()} == tours(before)
    assert not plan["unassigned"]


def test_whoever_is_concerned_has_to_be_of_the_fleet(searching: httpx.Client,
                                                     street: Data) -> None:
    before = planned(searching, street, {})
    reply = searching.post("/plan", json=street | {"replan": {
        "plan": before, "concerned": ["van-1", "van-3", "van-1/drone-1"]}})
    assert [(each["path"], each["code"]) for each in reply.json()["errors"]] == [
        ("$.replan.concerned[1]", "UNKNOWN_VEHICLE"), ("$.replan.concerned[2]", "UNKNOWN_VEHICLE")]


@pytest.mark.parametrize("seed", seeds(3))
@pytest.mark.parametrize("limits", [BEHIND, BEHIND | CONCERNED])
def test_days_lived_with_new_orders_behind_keep_who_was_told_in_front(
        searching: httpx.Client, street: Data, seed: int, limits: Data) -> None:
    draw = random.Random(seed)
    street["customers"] = [customer(f"c{number}", draw.uniform(-6, 6)) for number in range(6)]
    plan, now = planned(searching, street, limits), 0.0
    for number in range(4):
        now += draw.uniform(0, 500)
        street["customers"] += [customer(f"n{number}.{each}", draw.uniform(-6, 6))
                                for each in range(draw.randint(1, 2))]
        was = tours(plan)
        plan = planned(searching, street, limits, plan, freeze_before=now)
        for vehicle, names in tours(plan).items():
            is_new = [name not in {each for some in was.values() for each in some}
                      for name in names]
            assert all(one <= other for one, other in pairwise(is_new)), (was, names)
            if limits != BEHIND:
                assert names[:len(was.get(vehicle, []))] == was.get(vehicle, [])
