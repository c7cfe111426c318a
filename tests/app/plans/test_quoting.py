"""Quotes of a plan that is known, beside those of one that is read."""

import time
from random import Random
from typing import Any

import httpx
import pytest
from pydantic_core import from_json, to_json

from app.plans import quoted_plans
from app.plans.checking import read_about_plan
from app.plans.quoting import answer_quote
from app.requests.bounds import UNBOUNDED
from app.schemas.errors import InvalidRequestError
from app.serving.load.received import ReceivedBody
from app.serving.remembered import Remembered
from tests.app.plans.asking import planned
from tests.seeds import seeds

Request = dict[str, Any]

DRONES = {"count": 1, "capacity": [2], "endurance": 1200, "speed_kmh": 60}


def customer(draw: Random, name: str) -> Request:
    """Return an order somewhere, that may ask for more than others."""
    more: list[Request] = [{}, {"skills": ["lift"]}, {"setup_duration": 30}, {"demand": [1.25]},
                           {"service_duration_by_type": {"van": 20}}, {"unassigned_cost": 7}]
    return {"id": name, "location": [draw.randint(-5, 5), draw.randint(-5, 5)], "demand": [1],
            "service_duration": 60} | draw.choice([{}, {}, {}, *more])


def problem_of(draw: Random) -> Request:
    """Return a problem with some of the rules on which an order may bear."""
    van = {"id": "van", "count": 2, "capacity": [4], "speed_kmh": 36, "max_trips": 2,
           "costs": {"fixed": 5, "per_hour": 9}, "skills": ["lift"]}
    customers = [customer(draw, name) for name in "ABCDE"]
    for each in customers:
        each["time_window"] = {"earliest": (begin := draw.randint(0, 900)), "latest": begin + 3000}
    rules: list[Request] = [
        {}, {}, {"unassigned_cost": 40}, {"fleet": [{**van, "drones": DRONES}]},
        {"relations": [{"kind": "together", "customers": ["A", "B"]}]},
        {"shipments": [{"id": "S", "amount": [1], "pickup": {"location": [1, 1]},
                        "delivery": {"location": [2, 2]}}]},
        {"options": {"change_costs": {"vehicle": 2, "position": 1}}}]
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": customers, "fleet": [van]} | draw.choice(rules)


def asked_for(draw: Random, problem: Request, plan: Request, name: str) -> bytes:
    """Return a request for slots of an order."""
    starts = [draw.randint(0, 3000) for _ in range(4)]
    slots = [{"earliest": start, "latest": start + draw.choice([60, 600, 3000])}
             for start in starts]
    return to_json({"problem": problem, "plan": plan, "order": customer(draw, name),
                    "slots": slots})


def quoted(body: bytes, plans: quoted_plans.QuotedPlans | None = None) -> Request:
    """Return the reply, or the errors."""
    try:
        return dict(from_json(answer_quote(
            ReceivedBody(body, time.perf_counter()), UNBOUNDED, plans=plans)))
    except InvalidRequestError as error:
        return {"errors": [each.model_dump() for each in error.errors]}


@pytest.mark.thorough_after(4)
@pytest.mark.parametrize("now", [None, 0, 700])
@pytest.mark.parametrize("seed", seeds(12))
def test_plan_that_is_known_is_quoted_as_one_that_is_read(
        client: httpx.Client, seed: int, now: float | None) -> None:
    draw = Random(seed)
    problem = problem_of(draw)
    plan = planned(client, problem | {"options": {
        **problem.get("options", {}), "search_iterations": 200, "time_limit": 60},
        "replan": {"plan": {"routes": []}}})
    given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
    if now is not None:
        gone = draw.choice(["", "A"])
        problem = problem | {"replan": {"plan": given, "freeze_before": now}}
        if gone and "relations" not in problem and now == 0:
            # Whom the plan given has, and who is asked for anew.
            problem["customers"] = problem["customers"][1:]
            given = {"routes": [], "unassigned": [
                {"id": each["id"]} for each in problem["customers"]]}
    plans = quoted_plans.quoted_plans()
    for name in ("N", "M", "A", "N", "B"):
        body = asked_for(draw, problem, given, name)
        assert quoted(body, plans) == quoted(body)


def test_plan_is_read_once(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    draw = Random(3)
    problem = {**problem_of(Random(0)), "relations": [], "shipments": []}
    plan = planned(client, problem | {"options": {"search_iterations": 50, "time_limit": 60}})
    given, plans = {"routes": plan["routes"]}, quoted_plans.quoted_plans()
    bodies = [asked_for(draw, problem, given, name) for name in "MNO"]
    alone = [quoted(body) for body in bodies]
    read = list[bytes]()

    def reading(body: bytes, *args: Any) -> Any:
        read.append(body)
        return read_about_plan(body, *args)

    monkeypatch.setattr(quoted_plans, "read_about_plan", reading)
    assert [quoted(body, plans) for body in bodies] == alone
    assert read == bodies[:1]
    # What is wrong with a request is told as if nothing were known.
    wrong = {**dict(from_json(bodies[1])), "order": {"id": "A", "location": [1]}}
    assert quoted(to_json(wrong), plans) == quoted(to_json(wrong))
    assert "errors" in quoted(to_json(wrong), plans)


def test_what_was_used_last_is_remembered() -> None:
    remembered: Remembered[str, bytes] = Remembered(10, len)
    for name in "abc":
        remembered.put(name, bytes(4))
    assert [remembered.get(name) for name in "abc"] == [None, bytes(4), bytes(4)]
    remembered.get("b")
    remembered.put("d", bytes(5))
    assert [remembered.get(name) for name in "bcd"] == [bytes(4), None, bytes(5)]
    remembered.put("e", bytes(11))
    assert [remembered.get(name) for name in "bcde"] == [None] * 4


@pytest.mark.parametrize("first", [{"customers": ["E"]}, {"shipments": ["S"]}])
def test_who_waits_for_a_plan_has_a_place_before_others(
        client: httpx.Client, first: dict[str, list[str]]) -> None:
    van = {"id": "van", "count": 1, "capacity": [9], "speed_kmh": 36, "max_trips": 1,
           "max_stops": 3 if "customers" in first else 4}
    places = {"A": [2, 0], "B": [0, 2], "E": [2, 2]}
    customers = [{"id": name, "location": place, "demand": [1]} for name, place in places.items()]
    problem: Request = {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
                        "customers": customers[:2], "fleet": [van]}
    plan = planned(client, problem | {"options": {"search_iterations": 50, "time_limit": 60}})
    shipment = {"id": "S", "amount": [1], "pickup": {"location": [1, 2]},
                "delivery": {"location": [2, 2]}}
    more = {"customers": customers} if "customers" in first else {"shipments": [shipment]}
    body = to_json({"problem": problem | more, "plan": {"routes": plan["routes"]},
                    "order": {"id": "N", "location": [1, 1], "demand": [1]}, "slots": [{}]})
    waiting, plans = [name for names in first.values() for name in names], (
        quoted_plans.quoted_plans())
    for names, best in (([], 0), (waiting, None), (waiting, None), ([], 0)):
        reply = from_json(answer_quote(ReceivedBody(body, time.perf_counter()), UNBOUNDED,
                                       plans=plans, first=names))
        assert reply["best"] == best


FLOWN = {"drones": DRONES}
PAUSED = {"breaks": [{"id": "L", "duration": 300, "start": {"earliest": 600, "latest": 1800}}]}


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize("rules", [FLOWN, PAUSED])
@pytest.mark.parametrize("seed", seeds(8))
def test_room_is_made_where_drones_fly_and_drivers_rest(
        client: httpx.Client, seed: int, rules: Request) -> None:
    draw = Random(seed)
    problem = problem_of(draw)
    for name in ("relations", "shipments"):
        problem.pop(name, None)
    problem["fleet"] = [problem["fleet"][0] | rules]
    plan = planned(client, problem | {"options": {"search_iterations": 200, "time_limit": 60}})
    body = from_json(asked_for(draw, problem, {
        "routes": plan["routes"], "unassigned": plan["unassigned"]}, "N"))
    searched = quoted(to_json(body))["slots"]
    between = quoted(to_json(body | {"search": False}))["slots"]
    assert [each["feasible"] for each in searched] == [each["feasible"] for each in between]
    # The search may overlook a place at which nobody else moves, but hardly ever a much better one.
    assert sum(each["cost"] or 0 for each in searched) <= 1.01 * sum(
        each["cost"] or 0 for each in between)
