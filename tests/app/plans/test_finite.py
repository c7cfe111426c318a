"""Replies are JSON whatever divides by nothing: no NaN, no Infinity."""

import json
from typing import Any

import httpx
import pytest

Request = dict[str, Any]

STOPS = [{"kind": kind, "id": name} for kind, name in (("depot", "hub"), ("customer", "a"),
                                                       ("depot", "hub"))]
PLAN = {"routes": [{"vehicle": "van-1", "type": "van", "trips": [{"stops": STOPS}]}]}
NEW = {"id": "b", "location": [2, 0], "demand": [1]}


@pytest.fixture
def nothing() -> Request:
    """Return a problem of vehicles that hold nothing, and may not work."""
    return {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "a", "location": [1, 0], "demand": [1]}],
        "fleet": [{"id": "van", "count": 2, "capacity": [0], "speed_kmh": 60,
                   "max_working_duration": 0,
                   "drones": {"count": 1, "capacity": [0], "endurance": 0}}],
        "options": {"time_limit": 0}}


def finite(client: httpx.Client, path: str, body: Request) -> Request:
    """Return the reply, which is JSON as its standard says."""
    reply = client.post(path, json=body)
    assert reply.status_code == 200, reply.text

    def refuse(name: str) -> None:
        pytest.fail(f"{path} is answered with {name}")

    found: Request = json.loads(reply.text, parse_constant=refuse)
    return found


def test_no_reply_holds_what_json_has_no_number_for(client: httpx.Client,
                                                    nothing: Request) -> None:
    finite(client, "/plan", nothing)
    verdict = finite(client, "/check", {"problem": nothing, "plan": PLAN})
    assert "CAPACITY" in {item["code"] for item in verdict["violations"]}
    # What was told can be sent back.
    told = {"routes": verdict["routes"]}
    again = finite(client, "/check", {"problem": nothing, "plan": told})
    assert again["violations"] == verdict["violations"]
    fits = finite(client, "/fit", {"problem": nothing, "plan": told, "new_customer": NEW})
    assert fits["places"]
    finite(client, "/fit", {"problem": nothing, "plan": told, "customer": "a"})
    nobody = {"routes": [], "unassigned": [{"id": "a"}]}
    finite(client, "/explain", {"problem": nothing, "plan": nobody, "customer": "a"})
    on = nothing | {"replan": {"plan": told, "freeze_before": 30}}
    assert finite(client, "/plan", on)["replan"]["excused"]
