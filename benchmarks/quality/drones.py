"""Tandem on the public truck-and-drone sets: `python -m benchmarks.quality.drones`.

The search plans from nothing, each set under its own rules. Each run is a row of a CSV, written as
soon as it is there; runs that have a row are not repeated. A table of all rows follows.
"""

import math
import statistics
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from benchmarks.clock import count_processor_time
from benchmarks.peers.versus import machine
from benchmarks.quality.truck_drone import LOADERS
from benchmarks.quality.truck_drone_rules import TruckDroneInstance, broken_rules
from benchmarks.results import gap_percent
from benchmarks.rows import append_rows, read_rows
from model.judge.check import check
from model.engine.instance import pack
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.search.strategy import Moves
from model.solution import Solution

EQUAL = 1e-6
"""Largest relative excess over a reference of a plan that reaches it."""

SAMPLE_SEED = 0

HEADER = ("set", "customers", "reference", "s", "threads", "plans", "mean gap %", "worst %",
          "reached", "to heuristic %", "forbidden", "failed")


@dataclass(frozen=True)
class DroneResult:
    """A judged run; a gap is nan unless the plan counts and there is such a reference."""

    set: str
    instance: str
    n: int  # customers
    kind: str  # of the reference
    threads: int
    budget_s: float
    seed: int
    wall_s: float
    cost: float
    reference: float
    gap_percent: float
    heuristic_gap_percent: float  # to the value of a published heuristic
    feasible: bool
    complete: bool  # everybody is served
    broken: int  # times that the plan breaks a rule of its set which `Problem` lacks
    date: str
    machine: str

    @property
    def failed(self) -> bool:
        """The plan breaks a rule of `Problem` or leaves customers out."""
        return not (self.feasible and self.complete)

    @property
    def counts(self) -> bool:
        """The plan can be compared with the reference."""
        return not self.failed and self.broken == 0

    @property
    def key(self) -> tuple[str, str, int, float, int]:
        """What was run: set, instance, threads, budget, seed."""
        return self.set, self.instance, self.threads, self.budget_s, self.seed


@dataclass(frozen=True)
class Run:
    """What is to be measured once."""

    instance: TruckDroneInstance
    threads: int
    budget: float  # seconds
    seed: int

    @property
    def key(self) -> tuple[str, str, int, float, int]:
        """As in `DroneResult`."""
        return (self.instance.set_name, self.instance.name, self.threads, self.budget, self.seed)


@dataclass(frozen=True, order=True)
class Verdict:
    """What is said of a plan, the better the smaller."""

    failed: bool
    broken: int
    cost: float
    feasible: bool
    complete: bool


def plan(instance: TruckDroneInstance, seconds: float, seed: int, threads: int) -> list[Solution]:
    """Plan each variant of an instance from nothing, in equal shares of the time."""
    moves = Moves("loops" not in instance.forbids, "crossings" not in instance.forbids)
    config = SearchConfig(seed, threads, moves=moves)
    return [_search(problem, config, seconds / len(instance.variants))
            for problem in instance.variants]


def _search(problem: Problem, config: SearchConfig, seconds: float) -> Solution:
    deadline = time.perf_counter() + seconds
    nothing = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    return improve(problem, pack([problem]), nothing, config, deadline).solution


def judge(instance: TruckDroneInstance, plans: Iterable[Solution]) -> Verdict:
    """Judge the best of the plans, one for each variant of an instance."""
    return min(_verdict(problem, solution, instance.forbids)
               for problem, solution in zip(instance.variants, plans, strict=True))


def _verdict(problem: Problem, solution: Solution, forbids: Iterable[str]) -> Verdict:
    evaluation = check(problem, solution)
    feasible, complete = evaluation.is_feasible, not solution.unassigned
    return Verdict(not (feasible and complete), len(broken_rules(problem, solution, forbids)),
                   evaluation.cost.total, feasible, complete)


def result(run: Run, verdict: Verdict, seconds: float) -> DroneResult:
    """Return the row of a run."""
    instance = run.instance
    counts = not verdict.failed and verdict.broken == 0
    gap, heuristic_gap = [
        round(gap_percent(verdict.cost, value), 6) if counts and value else math.nan
        for value in (instance.reference, instance.heuristic)]
    return DroneResult(
        instance.set_name, instance.name, instance.size, instance.kind, run.threads, run.budget,
        run.seed, round(seconds, 4), round(verdict.cost, 8),
        math.nan if instance.reference is None else instance.reference, gap, heuristic_gap,
        verdict.feasible, verdict.complete, verdict.broken, datetime.now(UTC).date().isoformat(),
        machine())


def measure(planned: Sequence[Run]) -> Iterator[DroneResult]:
    """Yield the result of each run."""
    for number, run in enumerate(planned, start=1):
        instance = run.instance
        began = time.perf_counter()
        plans = plan(instance, run.budget, run.seed, run.threads)
        seconds = time.perf_counter() - began
        row = result(run, judge(instance, plans), seconds)
        found = ("infeasible" if not row.feasible else "incomplete" if not row.complete
                 else "forbidden" if row.broken else f"{row.cost:.6g}, {row.gap_percent:.4f} %")
        typer.echo(f"{number}/{len(planned)} {row.set} {row.instance} {run.budget:g} s: {found}")
        yield row


def table(rows: Iterable[DroneResult]) -> list[str]:
    """Return the Markdown table, a line for each set, size, kind of reference and budget."""
    groups: dict[tuple[str, int, str, float, int], list[DroneResult]] = {}
    for row in rows:
        key = row.set, row.n, row.kind, row.budget_s, row.threads
        groups.setdefault(key, []).append(row)
    lines = [HEADER, ("---", "---:", "---") + ("---:",) * (len(HEADER) - 3)]
    lines += [(set_name, str(size), kind, f"{budget:g}", str(threads), *_cells(group))
              for (set_name, size, kind, budget, threads), group in sorted(groups.items())]
    return [f"| {' | '.join(cells)} |" for cells in lines]


def _cells(group: Sequence[DroneResult]) -> list[str]:
    """Return number, mean, worst, share that reached the reference, and what is left out."""
    gaps = [row.gap_percent for row in group if not math.isnan(row.gap_percent)]
    heuristic = [row.heuristic_gap_percent for row in group
                 if not math.isnan(row.heuristic_gap_percent)]
    reached = sum(gap <= 100 * EQUAL for gap in gaps)
    return [
        str(len(group)),
        f"{statistics.fmean(gaps):z.3f}" if gaps else "",
        f"{max(gaps):z.2f}" if gaps else "",
        f"{reached}/{len(gaps)}" if gaps else "",
        f"{statistics.fmean(heuristic):z.3f}" if heuristic else "",
        str(sum(not row.failed and row.broken > 0 for row in group)),
        str(sum(row.failed for row in group)),
    ]


def sample(instances: Iterable[TruckDroneInstance], most: int | None) -> list[TruckDroneInstance]:
    """Return at most so many instances of each set and size, the same ones every time."""
    groups: dict[tuple[str, int], list[TruckDroneInstance]] = {}
    for instance in instances:
        groups.setdefault((instance.set_name, instance.size), []).append(instance)
    chosen = []
    for group in groups.values():
        order = np.random.default_rng(SAMPLE_SEED).permutation(len(group))
        chosen += [group[index] for index in sorted(order[:most])]
    return chosen


def _folder(data: Path, name: str) -> Path:
    """Return where a set lies: beside `truck_drone` if not in it."""
    folder = data / "truck_drone" / name
    return folder if folder.is_dir() else data / name


def main(
    data: Annotated[Path, typer.Option(help="folder that holds `truck_drone`")]
    = Path("../shared/data"),
    output: Annotated[Path, typer.Option(help="CSV to write to, or to go on with")]
    = Path("runs/bench/drones.csv"),
    sets: Annotated[str, typer.Option(help="comma-separated")] = ",".join(LOADERS),
    seconds: Annotated[str, typer.Option(help="budgets, comma-separated")] = "1,10",
    seeds: Annotated[int, typer.Option(help="runs of each instance", min=1)] = 1,
    threads: Annotated[int, typer.Option(help="of the search", min=1)] = 1,
    largest: Annotated[int | None, typer.Option(help="most customers")] = None,
    most: Annotated[int | None, typer.Option(help="instances of each set and size")] = None,
    markdown: Annotated[Path | None, typer.Option(help="where to write the table")] = None,
) -> None:
    """Measure what isn't measured yet and print a table of all rows.

    Budgets on one thread are of the processor's time.
    """
    folders = sets.split(",")
    if unknown := set(folders) - set(LOADERS):
        raise typer.BadParameter(f"sets: no {', '.join(sorted(unknown))}")
    if threads == 1:
        count_processor_time()
    read = [instance for name in folders for instance in LOADERS[name](_folder(data, name))
            if largest is None or instance.size <= largest]
    known = {row.key for row in read_rows(output, DroneResult)}
    planned = [Run(instance, threads, float(budget), seed)
               for budget in seconds.split(",") for seed in range(1, seeds + 1)
               for instance in sample(read, most)]
    append_rows(output, DroneResult, measure([run for run in planned if run.key not in known]))
    text = "\n".join(table(read_rows(output, DroneResult)))
    typer.echo(text)
    if markdown is not None:
        markdown.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    typer.run(main)
