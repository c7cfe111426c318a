"""`POST /vroom` over HTTP."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.formats.vroom.answering import search_seconds
from app.formats.vroom.schemas import VroomOptionsInput
from app.formats.vroom.schemas_response import VroomReply
from app.serving.settings import Settings
from model.planner import PlanCheckError, PlanResult
from tests.app.conftest import FirstFitPlanner, ready

Data = dict[str, Any]

EXAMPLES = sorted((Path(__file__).parents[4] / "app" / "schemas" / "examples").glob("vroom_*.json"))


@pytest.fixture
def matrix_request() -> Data:
    """Return the example by matrices."""
    request: Data = json.loads(EXAMPLES[1].read_text("utf-8"))
    return request


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_solved(client: httpx.Client, path: Path) -> None:
    reply = client.post("/vroom", content=path.read_bytes())
    assert reply.status_code == 200, reply.text
    assert reply.headers["content-type"] == "application/json"
    VroomReply.model_validate_json(reply.content)
    request = json.loads(path.read_text("utf-8"))
    served = [step["id"] for route in reply.json()["routes"] for step in route["steps"]
              if step["type"] == "job"]
    left_out = [job["id"] for job in reply.json()["unassigned"]]
    assert sorted(served + left_out) == sorted(job["id"] for job in request["jobs"])


def test_request_without_matrices_reports_distances_and_geometry_on_demand(
        client: httpx.Client) -> None:
    request: Data = {
        "vehicles": [{"id": 0, "start": [2.35, 48.86], "end": [2.35, 48.86]}],
        "jobs": [{"id": 0, "location": [2.37, 48.85]}, {"id": 1, "location": [2.29, 48.86]}]}
    plain = client.post("/vroom", json=request).json()
    assert "distance" not in plain["summary"]
    detailed = client.post("/vroom", json=request | {"options": {"g": True}}).json()
    (route,) = detailed["routes"]
    assert route["distance"] == detailed["summary"]["distance"] == route["steps"][-1]["distance"]
    assert route["geometry"]
    assert "location_index" not in route["steps"][1]


def test_input_errors_are_code_2_and_status_400(client: httpx.Client, matrix_request: Data) -> None:
    matrix_request["vehicles"][0]["steps"] = [{"type": "pickup", "id": 7}]
    reply = client.post("/vroom", json=matrix_request)
    assert reply.status_code == 400
    assert reply.json()["code"] == 2
    assert reply.json()["error"].startswith("Invalid pickup id 7")


def test_too_many_jobs_are_code_4_and_status_413(serve: Callable[..., httpx.Client],
                                                 matrix_request: Data) -> None:
    client = serve(FirstFitPlanner(), Settings(max_customers=3))
    ready(client)
    reply = client.post("/vroom", json=matrix_request)
    assert (reply.status_code, reply.json()["code"]) == (413, 4)


def test_withheld_solutions_are_code_1_and_status_500(
        monkeypatch: pytest.MonkeyPatch, serve: Callable[..., httpx.Client],
        matrix_request: Data) -> None:
    # Few jobs need no planner.
    monkeypatch.setattr("model.dialects.vroom.planning.is_few", lambda *_: False)

    class WrongPlanner(FirstFitPlanner):
        """Finds plans that break a rule."""

        def plan(self, *args: Any, **kwargs: Any) -> PlanResult:
            raise PlanCheckError("a rule is broken")

    client = serve(WrongPlanner())
    ready(client)
    reply = client.post("/vroom", json=matrix_request)
    assert (reply.status_code, reply.json()["code"]) == (500, 1)


def test_documentation_has_request_reply_and_errors(client: httpx.Client) -> None:
    description = client.get("/openapi.json").json()
    operation = description["paths"]["/vroom"]["post"]
    content = operation["requestBody"]["content"]["application/json"]
    assert content["schema"]["$ref"].endswith("/VroomRequest")
    assert set(content["examples"]) == {path.stem for path in EXAMPLES}
    for status, model in (("200", "VroomReply"), ("400", "VroomErrorReply"),
                          ("413", "VroomErrorReply"), ("500", "VroomErrorReply")):
        schema = operation["responses"][status]["content"]["application/json"]["schema"]
        assert schema["$ref"].endswith(f"/{model}")
    amount = description["components"]["schemas"]["VroomJobInput"]["properties"]["amount"]
    assert amount["deprecated"]


@pytest.mark.parametrize(("options", "seconds"), [
    ({}, 1.0), ({"x": 0}, 0.1), ({"x": 5}, 5.0), ({"l": 3.5}, 3.5), ({"x": 5, "l": 2}, 2.0),
    ({"x": 1, "l": 9}, 0.25), ({"l": 1000}, 60.0)])
def test_time_is_set_by_exploration_or_limit(options: Data, seconds: float) -> None:
    assert search_seconds(VroomOptionsInput(**options), Settings()) == seconds
