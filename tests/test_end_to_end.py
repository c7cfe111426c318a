"""The service as users run it: the real command, the committed weights, real HTTP."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from typer.testing import CliRunner

from app.cli.commands import cli as command_line
from tests.conftest import PATIENCE
from tests.console.serving import shared

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parent.parent
EXAMPLES = sorted((ROOT / "examples").glob("*.json"))


@pytest.fixture(scope="module")
def client(shared_folder: Path) -> Iterator[httpx.Client]:
    with (shared(shared_folder / "end-to-end") as address,
          httpx.Client(base_url=address, timeout=PATIENCE, trust_env=False) as http):
        yield http


def shows(told: Any, replied: Any) -> bool:
    """Tell whether a reply has all that is told of it, in shortened lists too."""
    if isinstance(told, dict):
        return all(name in replied and shows(value, replied[name])
                   for name, value in told.items() if name != "search_iterations")
    if isinstance(told, list):
        return bool(told) == bool(replied) and all(
            any(shows(value, each) for each in replied) for value in told)
    return bool(told == replied)


def test_readme_shows_what_is_replied_to_its_request(client: httpx.Client) -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    request = re.search(r"/plan -d '(.*?)'", readme, re.DOTALL)
    told = re.search(r"^```json\n(.*?)^```", readme, re.DOTALL | re.MULTILINE)
    assert request is not None
    assert told is not None
    reply = client.post("/plan", json=json.loads(request[1])).json()
    assert shows(json.loads(told[1]), reply), reply


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
@pytest.mark.parametrize("decoding", ["greedy", "sample"])
def test_examples_are_planned_and_the_plans_pass_the_check(
        client: httpx.Client, example: Path, decoding: str, tmp_path: Path) -> None:
    request = json.loads(example.read_text())
    request["options"] = {"decoding": decoding, "num_samples": 16, "time_limit": 0}
    reply = client.post("/plan", json=request)
    assert reply.status_code == 200, reply.text
    plan = reply.json()
    assert plan["summary"]["served"] + len(plan["unassigned"]) == len(request["customers"])
    (tmp_path / "request.json").write_text(json.dumps(request))
    (tmp_path / "plan.json").write_text(reply.text)
    result = CliRunner().invoke(
        command_line, ["check", str(tmp_path / "request.json"), str(tmp_path / "plan.json")])
    assert result.exit_code == 0, result.output


def test_table1_is_served_whole_at_a_fair_cost(client: httpx.Client) -> None:
    request: dict[str, Any] = json.loads((ROOT / "examples" / "table1.json").read_text())
    request["options"] = {"decoding": "sample", "num_samples": 128, "time_limit": 0}
    plan = client.post("/plan", json=request).json()
    assert plan["status"] == "complete"
    assert plan["cost"]["total"] < 950
    assert plan["summary"]["sorties"] >= 10


def test_same_request_gets_the_same_plan(client: httpx.Client) -> None:
    request: dict[str, Any] = json.loads((ROOT / "examples" / "table1.json").read_text())
    request["options"] = {"decoding": "sample", "num_samples": 8, "seed": 3, "time_limit": 0}
    plans = [client.post("/plan", json=request).json() for _ in range(2)]
    for plan in plans:
        del plan["solver"]["elapsed"]
    assert plans[0] == plans[1]


def test_whoever_must_be_served_comes_before_the_dearest_others(client: httpx.Client) -> None:
    others: list[dict[str, Any]] = [
        {"id": name, "location": [1, number], "demand": [5], "unassigned_cost": 1e6}
        for number, name in enumerate("AB")]
    request = {"depots": [{"id": "hub", "location": [0, 0]}],
               "customers": [*others, {"id": "must", "location": [30, 40], "demand": [10]}],
               "fleet": [{"id": "van", "count": 1, "capacity": [10]}],
               "options": {"time_limit": 5, "search_iterations": 200}}
    plan = client.post("/plan", json=request).json()
    assert [left_out["id"] for left_out in plan["unassigned"]] == ["A", "B"]
    assert plan["summary"]["must_unserved"] == 0
    assert plan["cost"]["unassigned"] == 2e6


def test_documents_examples_run_as_they_stand(client: httpx.Client) -> None:
    document = client.get("/openapi.json").json()
    body = document["paths"]["/plan"]["post"]["requestBody"]["content"]["application/json"]
    assert len(body["examples"]) >= 3
    for name, example in body["examples"].items():
        reply = client.post("/plan", json=example["value"])
        assert reply.status_code == 200, (name, reply.text)


def test_documentation_needs_no_other_host(client: httpx.Client) -> None:
    page = client.get("/docs").text
    assert "swagger" in page.lower()
    assert "https://" not in page
    assert "http://" not in page


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("policy", ["attention", "pointer"])
@pytest.mark.parametrize("options", [
    {"decoding": "greedy", "time_limit": 0}, {"decoding": "sample", "time_limit": 0},
    {"search_iterations": 20, "time_limit": 60}], ids=str)
@pytest.mark.parametrize("served_by", ["drone", "either"])
def test_a_launch_waits_for_a_window_that_opens_late(
        client: httpx.Client, policy: str, options: dict[str, Any], served_by: str) -> None:
    request = {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": "late", "location": [1, 0], "demand": [1], "served_by": served_by,
                       "time_window": {"earliest": 7200}}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [5], "max_trip_distance": 1000,
                   "drones": {"count": 1, "capacity": [5], "speed_kmh": 60, "endurance": 600}}],
        "options": options | {"policy": policy}}
    reply = client.post("/plan", json=request)
    assert reply.status_code == 200, reply.text
    plan = reply.json()
    assert plan["unassigned"] == []
    verdict = client.post("/check", json={"problem": request, "plan": plan}).json()
    assert verdict["feasible"]
    given = {"routes": plan["routes"], "unassigned": plan["unassigned"]}
    for freeze_before in (None, 3600, 7199):
        replan = {"plan": given, "freeze_before": freeze_before}
        later = client.post("/plan", json=request | {"replan": replan}).json()
        assert later["unassigned"] == [], freeze_before
