"""`tandem flights` on files."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli import commands
from app.cli.file_errors import EXIT_BAD_INPUT
from app.schemas.openapi import EXAMPLES_DIR

pytestmark = pytest.mark.slow

Data = dict[str, Any]


def files(folder: Path, plan: Data | None = None) -> list[str]:
    """Write the example's problem and plan, or another plan, and return their names."""
    example = json.loads((EXAMPLES_DIR / "flights.json").read_text("utf-8"))
    problem_file, plan_file = folder / "problem.json", folder / "plan.json"
    problem_file.write_text(json.dumps(example["problem"]), "utf-8")
    plan_file.write_text(json.dumps(plan or example["plan"]), "utf-8")
    return [str(problem_file), str(plan_file)]


def test_flights_are_written_to_the_file_named(tmp_path: Path) -> None:
    output = tmp_path / "mine.plan"
    done = CliRunner().invoke(commands.cli, [
        "flights", *files(tmp_path), "--format", "qgc-plan", "--per", "vehicle", "-o",
        str(output)])
    assert (done.exit_code, done.stdout) == (0, f"{output}\n")
    assert json.loads(output.read_text("utf-8"))["fileType"] == "Plan"


def test_flights_have_a_name_of_their_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(commands.cli, ["flights", *files(tmp_path), "--format", "kml"])
    assert (done.exit_code, done.stdout) == (0, "flights-kml.zip\n")
    assert (tmp_path / "flights-kml.zip").read_bytes().startswith(b"PK")


def test_plan_without_flights_and_unknown_formats_are_refused(tmp_path: Path) -> None:
    named = files(tmp_path, {"routes": [], "unassigned": []})
    told = CliRunner().invoke(commands.cli, ["flights", *named, "--format", "kml"])
    assert told.exit_code == EXIT_BAD_INPUT
    assert "plan.json: " in told.stderr
    told = CliRunner().invoke(commands.cli, ["flights", *named, "--format", "gpx"])
    assert told.exit_code == 2
    assert "qgc-plan" in told.stderr
