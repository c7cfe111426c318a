"""Matrices that would take too much memory are refused on every way in."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner
from tests.conftest import soon

pytestmark = pytest.mark.slow

Request = dict[str, Any]

MOST = 18
"""Legs that two customers, a depot and two ways to travel take."""


@pytest.fixture
def client(serve: Callable[..., httpx.Client], tmp_path: Path) -> httpx.Client:
    """Return a client of a service that holds few legs."""
    client = serve(FirstFitPlanner(), Settings(max_legs=MOST, data_dir=tmp_path, role="api"))
    soon(lambda: client.get("/health/ready").status_code == 200)
    return client


def fleet(*speeds: float) -> list[Request]:
    """Return a truck of each speed."""
    return [{"id": f"truck at {speed}", "count": 1, "capacity": [9], "speed_kmh": speed}
            for speed in speeds]


def refused(reply: httpx.Response) -> list[tuple[str, str]]:
    """Return the code and path of every error."""
    return [(error["code"], error["path"]) for error in reply.json().get("errors", [])]


def test_every_request_of_a_plan_is_bounded(client: httpx.Client, smallest: Request) -> None:
    fits, large = ({**smallest, "fleet": fleet(*speeds)} for speeds in ((30, 50), (30, 40, 50)))
    plan: Request = {"routes": []}
    grid = {"fleet[0].speed_kmh": [30, 40]}
    for path, low, high, status, where in (
            ("/plan", fits, large, 200, "$.fleet"),
            ("/check", {"problem": fits, "plan": plan}, {"problem": large, "plan": plan}, 200,
             "$.problem.fleet"),
            ("/jobs", fits, large, 202, "$.fleet"),
            ("/compare", {"base": fits, "fleets": {"a": fleet(40)}},
             {"base": large, "fleets": {"a": fleet(40)}}, 202, "$.base.fleet"),
            ("/compare", {"base": fits, "fleets": {"a": fleet(40)}},
             {"base": fits, "fleets": {"a": fleet(40), "b": fleet(30, 40, 50)}}, 202,
             "$.fleets.b"),
            ("/sweep", {"base": fits, "grid": grid},
             {"base": fits, "grid": {"fleet": [fleet(30), fleet(30, 40, 50)]}}, 202, "$.grid")):
        assert client.post(path, json=low).status_code == status, path
        assert refused(client.post(path, json=high)) == [("TOO_MANY_LEGS", where)], path


def test_requests_of_vroom_are_bounded(client: httpx.Client) -> None:
    vehicle = {"id": 1, "start": [2.0, 48.0], "end": [2.0, 48.0]}
    jobs = [{"id": number, "location": [2.0 + 0.01 * number, 48.0]} for number in range(1, 5)]
    assert client.post("/vroom", json={"vehicles": [vehicle], "jobs": jobs[:2]}).status_code == 200
    reply = client.post("/vroom", json={"vehicles": [vehicle], "jobs": jobs})
    assert (reply.status_code, reply.json()["code"]) == (413, 4)
    assert "TANDEM_MAX_LEGS" in reply.json()["error"]


@pytest.mark.parametrize(("freeze_before", "ways", "legs"), [
    (None, 1, 9 + 9),  # the same places once more
    (0, 1, 9 + 16),  # and where a vehicle goes on with its trip
    (None, 2, 18 + 18)])
def test_what_replanning_adds_is_counted(client: httpx.Client, smallest: Request,
                                         freeze_before: float | None, ways: int,
                                         legs: int) -> None:
    stops = [{"kind": kind, "id": name, "arrival": time, "service_start": time, "departure": time}
             for kind, name, time in (("depot", "hub", 0), ("customer", "A", 600),
                                      ("depot", "hub", 1200))]
    routes = [{"vehicle": "truck at 30-1", "type": "truck at 30", "trips": [{"stops": stops}]}]
    reply = client.post("/plan", json={
        **smallest, "fleet": fleet(30, 50)[:ways],
        "replan": {"plan": {"routes": routes}, "freeze_before": freeze_before}})
    if legs <= MOST:
        assert reply.status_code == 200, reply.text
    else:
        assert refused(reply) == [("TOO_MANY_LEGS", "$.fleet")]
        assert f"{legs} legs" in reply.text
