"""`tandem plot` on files."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from app.cli import commands
from app.cli.file_errors import EXIT_BAD_INPUT
from tests.app.plans.pictures.conftest import planned

pytestmark = pytest.mark.slow

Request = dict[str, Any]


def _files(folder: Path, request: Request, plan: Request) -> list[str]:
    problem_file, plan_file = folder / "problem.json", folder / "plan.json"
    problem_file.write_text(json.dumps(request), "utf-8")
    plan_file.write_text(json.dumps(plan), "utf-8")
    return [str(problem_file), str(plan_file)]


@pytest.mark.parametrize(("name", "start"), [
    ("plan.png", b"\x89PNG"), ("plan.svg", b"<?xml"), ("PLAN.HTML", b"<!DOCTYPE html>")])
def test_picture_is_of_the_kind_its_name_says(tmp_path: Path, with_drones: Request, name: str,
                                              start: bytes) -> None:
    output = tmp_path / name
    files = _files(tmp_path, with_drones, planned(with_drones))
    done = CliRunner().invoke(commands.cli, ["plot", *files, "-o", str(output)])
    assert done.exit_code == 0, done.output
    assert output.read_bytes().startswith(start)


def test_other_kinds_are_refused(tmp_path: Path, smallest: Request) -> None:
    files = _files(tmp_path, smallest, planned(smallest))
    told = CliRunner().invoke(commands.cli, ["plot", *files, "-o", str(tmp_path / "plan.pdf")])
    assert told.exit_code == EXIT_BAD_INPUT
    assert ".png, .svg, .html" in told.stderr
    assert not (tmp_path / "plan.pdf").exists()


def test_plan_of_another_problem_is_refused(tmp_path: Path, smallest: Request,
                                            with_drones: Request) -> None:
    files = _files(tmp_path, smallest, planned(with_drones))
    told = CliRunner().invoke(commands.cli, ["plot", *files, "-o", str(tmp_path / "plan.svg")])
    assert told.exit_code == EXIT_BAD_INPUT
    assert "UNKNOWN_CUSTOMER $.routes[0]" in told.stderr


def test_problem_that_is_none_is_refused(tmp_path: Path, smallest: Request) -> None:
    files = _files(tmp_path, {"x": 1}, planned(smallest))
    told = CliRunner().invoke(commands.cli, ["plot", *files, "-o", str(tmp_path / "plan.svg")])
    assert told.exit_code == EXIT_BAD_INPUT
    assert "problem.json: " in told.stderr
