"""Recordings of plans are the same for the same code, and a difference is told."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from benchmarks.quality.same_plans import app, differences, mixed_problems, problems, read

pytestmark = pytest.mark.slow

RUN = CliRunner()


def write(path: Path, **plans: float) -> Path:
    """Write a recording of plans, each of its own and of some cost."""
    lines = [{"name": name, "cost": cost, "plan": f"plan of {cost}", "left_out": 1}
             for name, cost in plans.items()]
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def test_problems_repeat() -> None:
    first, second = (list(problems(16)) for _ in range(2))
    assert [name for name, _ in first] == [name for name, _ in second]
    assert all(one.customers == other.customers
               for (_, one), (_, other) in zip(first, second, strict=True))
    assert len({name.split("-")[0] for name, _ in first}) == 16


def test_requests_that_mix_rules_repeat() -> None:
    first, second = (dict(mixed_problems(3)) for _ in range(2))
    assert len(first) == 3
    assert {name: problem.customers for name, problem in first.items()} == {
        name: problem.customers for name, problem in second.items()}


def test_same_code_makes_the_same_recording(tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("first", "second")]
    for path in paths:
        done = RUN.invoke(app, ["record", str(path), "--number", "2", "--rules", "1",
                                "--turns", "40"])
        assert done.exit_code == 0, done.output
    recordings: list[dict[str, Any]] = [read(path) for path in paths]
    assert len(recordings[0]) == 27
    assert differences(*recordings) == []


def test_differences_are_told(tmp_path: Path) -> None:
    before = write(tmp_path / "before", a=10.0, b=20.0, c=5.0)
    after = write(tmp_path / "after", a=10.0, b=22.0, d=1.0)
    done = RUN.invoke(app, ["compare", str(before), str(after)])
    assert done.exit_code == 1
    assert "b: 20.000000, 1 left out before, 22.000000, 1 left out after" in done.output
    assert "d: no plan before, 1.000000, 1 left out after" in done.output
    assert "+10.00 %" in done.output
    assert "4 plans, 3 differ" in done.output


def test_insertions_that_cost_otherwise_are_told(tmp_path: Path) -> None:
    before, after = (write(tmp_path / name, a=10.0) for name in ("before", "after"))
    for path, trace in ((before, 1), (after, 2)):
        path.write_text(json.dumps({**json.loads(path.read_text()), "trace": trace}) + "\n")
    assert differences(read(before), read(after)) == ["a"]


def test_equal_recordings_pass(tmp_path: Path) -> None:
    before, after = (write(tmp_path / name, a=10.0) for name in ("before", "after"))
    done = RUN.invoke(app, ["compare", str(before), str(after)])
    assert (done.exit_code, done.output) == (0, "1 plans, 0 differ\n")
