"""Wild requests of VROOM's are planned soundly or refused.

The study of seven thousand is `python -m benchmarks.fuzz.vroom`.
"""

import json
import random
from typing import Any

import httpx
import pytest

from app.formats.vroom.schemas import VroomRequest
from benchmarks.fuzz.problems import Fault
from benchmarks.fuzz.vroom import Study, judge
from benchmarks.fuzz.wild_vroom import wild_vroom

pytestmark = pytest.mark.slow

REQUESTS = 40

REQUEST: dict[str, Any] = {
    "jobs": [{"id": 1, "time_windows": [[10, 20]], "skills": [7]}, {"id": 2}],
    "vehicles": [{"id": 5, "skills": [7], "capacity": [4], "max_tasks": 2,
                  "time_window": [0, 100]}]}


def solution(**changes: Any) -> dict[str, Any]:
    """Return a solution, right but for the changes to the step at job 1."""
    steps = [{"type": "start", "arrival": 0, "load": [4]},
             {"type": "job", "id": 1, "arrival": 5, "waiting_time": 5, "load": [2]} | changes,
             {"type": "end", "arrival": 30, "load": [0]}]
    return {"routes": [{"vehicle": 5, "steps": steps}], "unassigned": [{"type": "job", "id": 2}]}


def test_wild_requests_are_planned_soundly_or_refused(client: httpx.Client) -> None:
    study = Study(client)
    for seed in range(REQUESTS):
        study.try_request(wild_vroom(random.Random(seed)))
    assert study.statuses[200] > REQUESTS / 3
    assert 0 < study.left_out < study.statuses[200]


def test_wild_requests_fit_the_schema() -> None:
    for seed in range(100):
        VroomRequest.model_validate_json(json.dumps(wild_vroom(random.Random(seed))))


def test_right_solution_passes() -> None:
    judge(REQUEST, solution())


@pytest.mark.parametrize(("changes", "fault"), [
    ({"id": 2}, "left out"), ({"waiting_time": 4}, "windows"), ({"arrival": 16}, "windows"),
    ({"load": [5]}, "too full")])
def test_broken_rules_are_faults(changes: dict[str, Any], fault: str) -> None:
    with pytest.raises(Fault, match=fault):
        judge(REQUEST, solution(**changes))


@pytest.mark.parametrize(("changes", "fault"), [
    ({"skills": []}, "skill"), ({"max_tasks": 0}, "too many tasks"),
    ({"time_window": [0, 29]}, "outside its window")])
def test_what_a_vehicle_says_counts(changes: dict[str, Any], fault: str) -> None:
    request = REQUEST | {"vehicles": [REQUEST["vehicles"][0] | changes]}
    with pytest.raises(Fault, match=fault):
        judge(request, solution())


@pytest.mark.parametrize(("status", "text", "fault"), [
    (500, "{}", "answered with 500"), (400, "{}", "without words"), (200, '{"a": NaN}', "NaN")])
def test_replies_that_should_not_be_are_faults(status: int, text: str, fault: str) -> None:
    transport = httpx.MockTransport(lambda _: httpx.Response(status, text=text))
    with httpx.Client(transport=transport, base_url="http://service") as client:
        study = Study(client)
        with pytest.raises(Fault, match=fault):
            study.try_request(REQUEST)
