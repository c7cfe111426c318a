"""Routes that are given: timed no worse than by VROOM, and what they violate."""

import json
import random
from collections import Counter
from typing import Any

import httpx
import pytest

from app.formats.vroom.answering import timed
from app.formats.vroom.errors import VroomError
from app.formats.vroom.places import find_places
from app.formats.vroom.reading import read_request
from app.formats.vroom.translate import translate
from app.serving.load.received import ReceivedBody
from tests.app.formats.vroom.judge import tasks_of
from tests.app.formats.vroom.reference import check
from tests.app.formats.vroom.sampling import sample_request
from tests.seeds import seeds

Data = dict[str, Any]


def with_steps(draw: random.Random, request: Data) -> Data:
    """State some tasks, breaks and forced times of each vehicle. In place."""
    tasks = list(tasks_of(request))
    draw.shuffle(tasks)
    for vehicle in request["vehicles"]:
        taken = [tasks.pop() for _ in range(min(len(tasks), draw.randint(1, 4)))]
        if not taken:
            continue
        for each in vehicle.get("breaks", ()):
            if draw.random() < 0.8:
                taken.insert(draw.randint(0, len(taken)), ("break", each["id"]))
        steps: list[Data] = [{"type": kind, "id": number} for kind, number in taken]
        if draw.random() < 0.2:
            steps[-1]["service_after"] = draw.randint(0, 800)
        vehicle["steps"] = [{"type": "start"}, *steps, {"type": "end"}]
    return request


def ours(request: Data) -> Data:
    """Return our reply that times the routes of a request."""
    body = ReceivedBody(json.dumps(request).encode(), 0.0)
    stated = read_request(body.content, 100, 100)
    return dict(timed(stated, translate(stated), find_places(stated, {}), body))


def causes(reply: Data) -> Counter[str]:
    """Return how often rules are broken that have nothing to do with times."""
    return Counter(violation["cause"] for route in reply["routes"] for step in route["steps"]
                   for violation in step["violations"] if "duration" not in violation)


def missed(route: Data) -> int:
    """Return by how many seconds windows of a route are missed."""
    return sum(violation.get("duration", 0) for violation in route["violations"])


def span(route: Data) -> int:
    """Return how long a route takes."""
    return int(route["steps"][-1]["arrival"] - route["steps"][0]["arrival"])


@pytest.mark.parametrize("seed", seeds(60))
def test_times_violate_no_more_than_vrooms(seed: int) -> None:
    draw = random.Random(seed)
    request = with_steps(draw, sample_request(draw))
    theirs = check(request)
    if theirs is None:
        return
    mine = ours(request)
    assert causes(mine) == causes(theirs)
    for ours_, others in zip(mine["routes"], theirs["routes"], strict=True):
        assert (missed(ours_), span(ours_)) <= (missed(others), span(others))
        for name in ("cost", "setup", "service", "duration"):
            assert ours_[name] == others[name]


@pytest.fixture
def street() -> Data:
    """Return three jobs and a vehicle on a street, 100 s from place to place, with its route."""
    durations = [[100 * abs(i - j) for j in range(4)] for i in range(4)]
    return {"vehicles": [{"id": 1, "start_index": 0, "end_index": 0, "capacity": [1],
                          "steps": [{"type": "job", "id": 2}, {"type": "job", "id": 1}]}],
            "jobs": [{"id": number, "location_index": number, "delivery": [1]}
                     for number in (1, 2, 3)],
            "matrices": {"car": {"durations": durations}}}


def test_what_is_violated_is_told_by_step_by_route_and_of_all(street: Data) -> None:
    street["jobs"][0]["time_windows"] = [[0, 50]]
    street["jobs"][1]["time_windows"] = [[150, 220]]
    reply = ours(street)
    (route,) = reply["routes"]
    assert [step["arrival"] for step in route["steps"]] == [0, 200, 300, 400]
    late, full = {"duration": 250, "cause": "delay"}, {"cause": "load"}
    assert [step["violations"] for step in route["steps"]] == [[full], [], [late], []]
    assert route["violations"] == reply["summary"]["violations"] == [full, late]
    assert [each["id"] for each in reply["unassigned"]] == [3]


def test_forced_times_are_kept_or_refused(street: Data) -> None:
    first, second = street["vehicles"][0]["steps"]
    second["service_at"] = 1000
    (route,) = ours(street)["routes"]
    assert [step["arrival"] for step in route["steps"]] == [700, 900, 1000, 1100]
    first["service_after"] = 950
    with pytest.raises(VroomError, match="Infeasible route for vehicle 1"):
        ours(street)


def test_routes_are_timed_over_http(client: httpx.Client, street: Data) -> None:
    reply = client.post("/vroom", json=street | {"options": {"c": True}})
    assert reply.status_code == 200
    assert [step["type"] for step in reply.json()["routes"][0]["steps"]] == [
        "start", "job", "job", "end"]
