"""The `tandem` command on files."""

import json
import socket
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
from typer.testing import CliRunner

from app.cli import commands, planning
from app.cli.file_errors import EXIT_BAD_INPUT
from app.schemas.request import PlanRequest
from model.planner import Planner
from tests.conftest import free_port

Request = dict[str, Any]


@pytest.fixture(autouse=True)
def _planner(monkeypatch: pytest.MonkeyPatch, planner: Planner) -> None:
    monkeypatch.setattr(planning, "load_planner", lambda weights_dir, names: planner)


def _write(file: Path, content: Any) -> str:
    file.write_text(json.dumps(content), "utf-8")
    return str(file)


def test_plan_is_written_and_passes_the_check(tmp_path: Path, with_drones: Request) -> None:
    problem, plan = _write(tmp_path / "problem.json", with_drones), str(tmp_path / "plan.json")
    planned = CliRunner().invoke(commands.cli, ["plan", problem, "-o", plan])
    assert planned.exit_code == 0, planned.output
    checked = CliRunner().invoke(commands.cli, ["check", problem, plan])
    assert checked.exit_code == 0, checked.output
    total = json.loads(Path(plan).read_text("utf-8"))["cost"]["total"]
    assert f"total            {total:.6f}\nfeasible\n" in checked.output


def test_a_request_is_read_once(
        tmp_path: Path, smallest: Request, monkeypatch: pytest.MonkeyPatch) -> None:
    reading = Mock(wraps=PlanRequest.model_validate_json)
    monkeypatch.setattr(PlanRequest, "model_validate_json", reading)
    planned = CliRunner().invoke(commands.cli, ["plan", _write(tmp_path / "a.json", smallest)])
    assert planned.exit_code == 0, planned.output
    assert reading.call_count == 1


def test_plan_goes_to_standard_output_by_default(tmp_path: Path, smallest: Request) -> None:
    problem = _write(tmp_path / "problem.json", smallest)
    planned = CliRunner().invoke(commands.cli, ["plan", problem])
    assert json.loads(planned.stdout)["status"] == "complete"


def test_infeasible_plan_is_told_with_its_violations(tmp_path: Path, smallest: Request) -> None:
    problem, plan = _write(tmp_path / "problem.json", smallest), tmp_path / "plan.json"
    CliRunner().invoke(commands.cli, ["plan", problem, "-o", str(plan)])
    smallest["fleet"][0]["capacity"] = [14]
    checked = CliRunner().invoke(
        commands.cli, ["check", _write(tmp_path / "smaller.json", smallest), str(plan)])
    assert checked.exit_code == planning.EXIT_INFEASIBLE
    assert "routes[0].trips[0]" in checked.output
    assert checked.output.endswith("infeasible\n")


def test_wrong_input_is_told_as_over_http(tmp_path: Path, smallest: Request) -> None:
    smallest["fleet"][0]["depot"] = "moon"
    smallest["customers"][0]["demand"] = ["x"]
    problem = _write(tmp_path / "problem.json", smallest)
    for command in (["plan", problem], ["check", problem, problem]):
        told = CliRunner().invoke(commands.cli, command)
        assert told.exit_code == EXIT_BAD_INPUT
        assert "WRONG_TYPE $.customers[0].demand[0]: " in told.stderr
        assert "UNKNOWN_DEPOT $.fleet[0].depot: " in told.stderr


def test_what_is_no_plan_is_refused(tmp_path: Path, smallest: Request) -> None:
    problem = _write(tmp_path / "problem.json", smallest)
    told = CliRunner().invoke(commands.cli, ["check", problem, problem])
    assert told.exit_code == EXIT_BAD_INPUT
    assert "MISSING_FIELD $.routes: " in told.stderr


def test_serve_runs_the_application(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[dict[str, Any]] = []
    monkeypatch.setattr("uvicorn.run", lambda app, **options: calls.append(options))
    port = free_port()
    assert CliRunner().invoke(commands.cli, ["serve", "--port", str(port)]).exit_code == 0
    (options,) = calls
    assert (options["host"], options["port"]) == ("127.0.0.1", port)
    # A proxy that keeps connections for a minute asks on none that is being closed.
    assert options["timeout_keep_alive"] > 60


def test_a_port_that_is_taken_is_told_before_anything_begins(
        monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[object] = []
    monkeypatch.setattr("uvicorn.run", lambda app, **options: calls.append(app))
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = str(other.getsockname()[1])
        told = CliRunner().invoke(commands.cli, ["serve", "--port", port])
    assert told.exit_code == EXIT_BAD_INPUT
    assert f"Something listens on port {port} of 127.0.0.1 already" in told.stderr
    assert calls == []
