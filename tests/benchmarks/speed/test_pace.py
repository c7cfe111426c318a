"""Paces are measured with the same turns, and compared round by round.

The measurement is `python -m benchmarks.speed.pace`.
"""

import io

import pytest
from rich.console import Console

from benchmarks.speed.pace import kinds, paces, table

pytestmark = pytest.mark.slow


def test_there_are_nineteen_kinds_of_problems() -> None:
    drawn = list(kinds())
    assert len({name for name, _ in drawn}) == len(drawn) == 19
    assert max(problem.num_customers for _, problem in drawn) == 10_000


def test_turns_given_are_made() -> None:
    turns = {"hubs 200": 5, "resting 100": 5}
    found, made = paces(turns, 1.0)
    assert made == turns
    assert found.keys() == turns.keys()
    assert min(found.values()) > 0


def test_ratios_are_of_each_round() -> None:
    console = Console(file=io.StringIO(), width=80)
    console.print(table({"cvrp": [(100.0, 50.0), (300.0, 100.0), (80.0, 100.0)]}))
    row = console.file.getvalue().splitlines()[3]  # type: ignore[attr-defined]
    assert [cell.strip() for cell in row.split("│")[1:-1]] == ["cvrp", "100", "100", "2.000"]
