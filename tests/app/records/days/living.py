"""A day of three vans, told over HTTP by a clock of its own."""

import json
from typing import Any

import httpx

from app.records.days.schemas import DayEventsReply, DayPlanReply, DayReply
from tests.conftest import eventually

Data = dict[str, Any]

PROBLEM: Data = {
    "planar_unit": 1000,
    "depots": [{"id": "hub", "location": [0, 0], "time_window": {"earliest": 100}}],
    "customers": [{"id": name, "location": place, "demand": [1], "service_duration": 60}
                  for name, place in {"A": [2, 0], "B": [4, 0], "C": [0, 3], "D": [0, 6],
                                      "E": [-3, 0], "F": [-5, 0]}.items()],
    "fleet": [{"id": "van", "count": 3, "capacity": [2], "speed_kmh": 36,
               "max_trips": 2, "costs": {"fixed": 10}}],
    "options": {"search_iterations": 1000},
}
"""Planned by turns, for which `begun` leaves time: little is searched in the usual time on a busy
machine."""


def begun(client: httpx.Client, problem: Data = PROBLEM, **more: Any) -> str:
    """Begin a day whose first plan is there, and return its id.

    It is searched by turns: whoever states none has their plan after a few, not at the end of time.
    """
    problem = {**problem, "options": {"search_iterations": 100, **problem.get("options", {})}}
    reply = client.post("/days", json={
        "problem": problem, "clock": 0, "plan_within": 60, **more})
    assert reply.status_code == 201, reply.text
    day = DayReply.model_validate_json(reply.text)
    planned(client, day.id)
    return day.id


def told(client: httpx.Client, day: str, *events: Data, at: float | None = None) -> DayEventsReply:
    """Tell events, and have them planned for; names that none states are made of their kinds."""
    listed = [{"at": at, **event} for event in events]
    reply = client.post(f"/days/{day}/events", json=[
        {"event_id": f"{event['kind']}:{number}:{event['at']}", **event}
        for number, event in enumerate(listed)])
    assert reply.status_code == 202, reply.text
    planned(client, day)
    return DayEventsReply.model_validate_json(reply.text)


def standing(client: httpx.Client, day: str) -> DayReply:
    """Return how a day stands."""
    return DayReply.model_validate_json(client.get(f"/days/{day}").text)


def planned(client: httpx.Client, day: str) -> DayReply:
    """Return how a day stands once its plan counts with all that was told."""
    eventually(lambda: standing(client, day).is_planned)
    found = standing(client, day)
    assert found.failure is None, found.failure
    return found


def plan_of(client: httpx.Client, day: str) -> Data:
    """Return a day's plan."""
    reply = client.get(f"/days/{day}/plan")
    assert reply.status_code == 200, reply.text
    DayPlanReply.model_validate_json(reply.text)
    return dict(reply.json()["plan"])


def order(name: str, x: float, y: float, **more: Any) -> Data:
    """Return the event of an order that is new."""
    return {"kind": "order.placed", "customer": {
        "id": name, "location": [x, y], "demand": [1], "service_duration": 60, **more}}


def clock() -> Data:
    """Return that time goes on."""
    return {"kind": "clock"}


def served_by(plan: Data) -> dict[str, str]:
    """Return by which vehicle a plan has each customer served."""
    return {stop["id"]: route["vehicle"] for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"] if stop["kind"] == "customer"}


def followed(client: httpx.Client, day: str, count: int,
             headers: dict[str, str] | None = None) -> list[dict[str, Any]]:
    """Return so many events that a stream tells."""
    found: list[dict[str, Any]] = []
    with client.stream("GET", f"/days/{day}/events", headers=headers or {}) as reply:
        for line in reply.iter_lines():
            if line.startswith("data:"):
                found.append(json.loads(line[5:]))
            if len(found) == count:
                break
    return found
