"""Thousands of customers are planned and judged, for trucks all alike or of three types."""

from itertools import pairwise
from math import isnan
from pathlib import Path

import pytest
from typer import Typer
from typer.testing import CliRunner

from benchmarks.quality.large import as_problem, drawn, main, runs, with_types

pytestmark = pytest.mark.slow

NAME = "drawn-1-60-30-central"


def test_large_trucks_cost_more_but_less_for_what_they_hold() -> None:
    kinds = with_types(as_problem(drawn(NAME))).vehicle_types
    assert [kind.capacity[0] for kind in kinds] == sorted(kind.capacity[0] for kind in kinds)
    assert [kind.count for kind in kinds] == [60, 30, 18]
    for cheap, dear in pairwise(kinds):
        assert cheap.fixed_cost < dear.fixed_cost < 2 * cheap.fixed_cost
        assert cheap.cost_per_km < dear.cost_per_km


@pytest.mark.parametrize("types", [False, True])
def test_what_is_drawn_is_planned_and_judged(tmp_path: Path, types: bool) -> None:
    row, = runs(tmp_path, NAME, [0.2], 1, types=types)
    assert (row.n, row.budget_s, row.routes > 0) == (60, 0.2, True)
    assert row.cost > 0
    assert isnan(row.gap_percent)


def test_filo2_plans_for_no_trucks_of_several_types(tmp_path: Path) -> None:
    app = Typer()
    app.command()(main)
    done = CliRunner().invoke(app, [str(tmp_path), "--types", "--filo2", "filo2"])
    assert isinstance(done.exception, ValueError)
