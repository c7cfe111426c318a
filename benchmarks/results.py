"""One row for each run of a solver on a published instance, in a CSV that grows."""

import csv
import math
from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Result:
    """A judged run; what a run without a plan doesn't have is nan or empty."""

    set: str
    instance: str
    n: int  # customers
    solver: str
    threads: int
    budget_s: float
    seed: int
    wall_s: float  # of the solver's call
    cost: float  # in the unit of the published cost, without customers left out
    best_known: float
    gap_percent: float  # to `best_known`; nan unless the plan counts
    feasible: bool
    complete: bool  # everybody is served
    version: str
    date: str
    machine: str

    @property
    def counts(self) -> bool:
        """The plan serves everybody and breaks no rule."""
        return self.feasible and self.complete

    @property
    def key(self) -> tuple[str, str, str, float, int]:
        """What was run: set, instance, solver, budget, seed."""
        return self.set, self.instance, self.solver, self.budget_s, self.seed


COLUMNS = tuple(field.name for field in fields(Result))


def _result(row: list[str], place: str) -> Result:
    values: list[Any] = []
    try:
        for field, text in zip(fields(Result), row, strict=True):
            kind: Any = field.type
            values.append(text == "True" if kind is bool else kind(text))
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from error
    return Result(*values)


def read_results(path: Path) -> list[Result]:
    """Return the rows of a CSV.

    Raises
    ------
    ValueError
        If its columns are others, or a row holds no result.
    """
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    if tuple(header) != COLUMNS:
        raise ValueError(f"{path}: columns {header} are not {list(COLUMNS)}")
    return [_result(row, f"{path}, line {line}") for line, row in enumerate(rows, start=2)]


def append_results(path: Path, results: Iterable[Result]) -> None:
    """Write each result to a CSV as soon as it is there, after those that it has."""
    path.parent.mkdir(parents=True, exist_ok=True)
    is_new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if is_new:
            writer.writerow(COLUMNS)
        for result in results:
            writer.writerow(astuple(result))
            file.flush()


def gap_percent(cost: float, best_known: float) -> float:
    """Return how much more than the best known a cost is; nan without one."""
    return 100 * (cost / best_known - 1) if best_known else math.nan
