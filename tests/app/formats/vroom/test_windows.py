"""Jobs with many time windows: all that fit are served, in bounded time and memory."""

import json
import math
import random
import time
from typing import Any

import pytest

from app.formats.vroom.answering import answer
from app.formats.vroom.errors import TOO_LARGE, VroomError
from app.formats.vroom.reading import MAX_ALL_WINDOWS, read_request
from app.schemas.limits import DEFAULT_POLICY
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.planner import Planner, load_planner
from tests.app.formats.vroom.by_turns import ENOUGH, ByTurns
from tests.app.formats.vroom.judge import judge
from tests.app.formats.vroom.reference import solve

Data = dict[str, Any]

pytestmark = [pytest.mark.by_clock, pytest.mark.slow]

DAY = 43_200


TURNS = 3000
"""Of a search."""


@pytest.fixture(scope="module")
def planner() -> Planner:
    """Return the planner that the service has by default, by turns."""
    return ByTurns(load_planner(Settings().weights_dir, (DEFAULT_POLICY,)), TURNS)


def request_of(jobs: int, windows: int, vehicles: int, length: int | None = None,
               seed: int = 1) -> Data:
    """Return jobs in a town, each with windows of a length all over the day."""
    draw = random.Random(seed)
    places = [(draw.uniform(0, 8000), draw.uniform(0, 8000)) for _ in range(jobs + 1)]
    seconds = [[round(math.dist(one, other) / 10) for other in places] for one in places]
    step = DAY // windows
    length = step // 2 if length is None else length
    return {
        "vehicles": [{"id": number, "start_index": 0, "end_index": 0, "time_window": [0, DAY],
                      "capacity": [-(-jobs // vehicles) + (2 if vehicles > 1 else 0)]}
                     for number in range(vehicles)],
        "jobs": [{"id": number, "location_index": number, "service": 60, "delivery": [1],
                  "time_windows": [[begin, begin + length] for begin in (
                      place * step + draw.randrange(step - length) for place in range(windows))]}
                 for number in range(1, jobs + 1)],
        "matrices": {"car": {"durations": seconds}},
        "options": {"l": 1},
    }


def answered(planner: Planner, request: Data) -> Data:
    body = ReceivedBody(json.dumps(request).encode(), time.perf_counter())
    settings = Settings(vroom_seconds=ENOUGH)
    reply: Data = json.loads(answer(planner, body, settings, lambda: False))
    judge(request, reply)
    return reply


@pytest.mark.thorough_after(2)
@pytest.mark.parametrize(("jobs", "windows", "vehicles"), [
    (10, 10, 1), (20, 20, 2), (20, 100, 2), (20, 100, 1), (60, 100, 4), (60, 100, 1)])
def test_everyone_is_served_whom_vroom_serves(planner: Planner, jobs: int, windows: int,
                                              vehicles: int) -> None:
    request = request_of(jobs, windows, vehicles)
    theirs = solve(request, exploration=5)
    assert theirs["summary"]["unassigned"] == 0
    watched = ByTurns(planner, TURNS)
    began = time.process_time()
    reply = answered(watched, request)
    assert time.process_time() - began < 5
    assert reply["summary"]["unassigned"] == 0
    assert reply["summary"]["cost"] <= 1.02 * theirs["summary"]["cost"]
    assert watched.nodes == 1 + jobs


def test_windows_of_a_minute_are_met(planner: Planner) -> None:
    request = request_of(20, 30, 2, length=60)
    assert answered(planner, request)["summary"]["unassigned"] == 0


def test_routes_to_start_from_are_kept_or_bettered(planner: Planner) -> None:
    request = request_of(20, 50, 2)
    first = answered(planner, request)
    for vehicle in request["vehicles"]:
        vehicle["steps"] = [
            {"type": "job", "id": step["id"]} for route in first["routes"]
            if route["vehicle"] == vehicle["id"] for step in route["steps"]
            if step["type"] == "job"]
    again = answered(planner, request)
    assert again["summary"]["unassigned"] == 0
    assert again["summary"]["cost"] <= first["summary"]["cost"]


def test_whoever_cannot_be_served_is_left_out(planner: Planner) -> None:
    request = request_of(20, 50, 2)
    request["jobs"][3]["time_windows"] = [[DAY + 10, DAY + 20]]
    request["jobs"][7]["skills"] = [5]
    left_out = {job["id"] for job in answered(planner, request)["unassigned"]}
    assert left_out == {request["jobs"][3]["id"], request["jobs"][7]["id"]}


def test_more_windows_than_can_be_looked_at_are_refused_at_once() -> None:
    windows = [[10 * begin, 10 * begin + 5] for begin in range(100)]
    jobs = MAX_ALL_WINDOWS // 100 + 1
    body = json.dumps({
        "vehicles": [{"id": 1, "start": [2, 48]}],
        "jobs": [{"id": job, "location": [2, 48], "time_windows": windows} for job in range(jobs)],
    }).encode()
    with pytest.raises(VroomError, match="Too many time windows") as refused:
        read_request(body, 10_000, 10_000)
    assert refused.value.code == TOO_LARGE
