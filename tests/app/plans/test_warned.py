"""Warnings in replies, over HTTP and on the command line."""

import json
from pathlib import Path
from typing import Any

import httpx
import pytest
from typer.testing import CliRunner

from app.cli import commands, planning
from app.schemas.check import CheckReply
from app.schemas.explain import ExplainReply
from app.schemas.response import PlanReply, WarningsReply
from tests.app.conftest import FirstFitPlanner

Request = dict[str, Any]


@pytest.fixture
def doubtful(smallest: Request) -> Request:
    """Return a request whose kilometres are taken for metres."""
    del smallest["planar_unit"]
    return smallest


def test_every_reply_about_a_plan_has_its_warnings(client: httpx.Client,
                                                   doubtful: Request) -> None:
    told = client.post("/warnings", json=doubtful).json()
    WarningsReply.model_validate(told)
    warning, = told["warnings"]
    assert (warning["code"], warning["path"]) == ("PLACES_WITHIN_METRES", "$.planar_unit")
    plan = client.post("/plan", json=doubtful).json()
    PlanReply.model_validate(plan)
    assert plan["warnings"] == [warning]
    about = {"problem": doubtful, "plan": plan}
    within = [warning | {"path": "$.problem.planar_unit"}]
    checked = client.post("/check", json=about).json()
    CheckReply.model_validate(checked)
    assert checked["warnings"] == within
    explained = client.post("/explain", json=about | {"customer": "A"}).json()
    ExplainReply.model_validate(explained)
    assert explained["warnings"] == within
    again = client.post("/plan", json=doubtful | {"replan": {"plan": plan}}).json()
    assert again["warnings"] == [warning]


def test_what_is_meant_has_no_warnings(client: httpx.Client, smallest: Request) -> None:
    assert client.post("/warnings", json=smallest).json() == {"warnings": []}
    assert client.post("/plan", json=smallest).json()["warnings"] == []


def test_an_invalid_request_has_errors_and_no_warnings(client: httpx.Client,
                                                       doubtful: Request) -> None:
    reply = client.post("/warnings", json=doubtful | {"fleet": []})
    assert reply.status_code == 422
    assert [error["code"] for error in reply.json()["errors"]] == ["EMPTY_FLEET"]


def test_the_command_line_prints_warnings_beside_the_plan(
        tmp_path: Path, doubtful: Request, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "load_planner", lambda *_: FirstFitPlanner())
    file = tmp_path / "problem.json"
    file.write_text(json.dumps(doubtful))
    planned = CliRunner().invoke(commands.cli, ["plan", str(file)])
    assert json.loads(planned.stdout)["warnings"]
    assert "warning PLACES_WITHIN_METRES $.planar_unit: All places lie within" in planned.stderr


def test_sums_have_no_noise(client: httpx.Client, smallest: Request) -> None:
    smallest["customers"] = [
        {"id": str(number), "location": [0.1 * number, 0], "demand": [1]} for number in range(1, 8)]
    smallest["fleet"][0] |= {"count": 7, "capacity": [1], "costs": {"fixed": 0.1, "per_km": 0.7}}
    plan = client.post("/plan", json=smallest).json()
    told = [*plan["cost"].values(), *(route["cost"] for route in plan["routes"]),
            plan["solver"]["final_cost"]]
    assert plan["cost"]["total"] == 4.62
    assert [round(cost, 6) for cost in told] == told
