"""The paper's study: `python -m benchmarks.study`, or `--quick` for a small one.

Plans what `benchmarks.study.tasks` lists, a row of a CSV as soon as each plan is there, and then
writes the report. A study that was stopped goes on where it was; one that is complete is only
reported again.
"""

import json
import os
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Annotated

import typer

from benchmarks.rows import append_rows, read_rows
from benchmarks.study.planning import plan_all
from benchmarks.study.report import PLAN, Study, write_report
from benchmarks.study.tasks import FULL, QUICK, Planned, Scale, Task, TripRow, all_tasks

TRIPS = "trips.csv"

PAGE, RUNS = Path("docs/develop/study.md"), Path("runs/study")


def run(scale: Scale, folder: Path, workers: int) -> Study:
    """Plan what isn't planned yet, and return all of it."""
    tasks = list(all_tasks(scale))
    known = {row.task for section in _sections(tasks)
             for row in read_rows(folder / f"{section}.csv", Planned)}
    typer.echo(f"{len(tasks)} plans, of which {len(known & set(tasks))} are there")
    for section in _sections(tasks):
        missing = [task for task in tasks if task.section == section and task not in known]
        _plan(missing, section, folder, workers)
    return _read(tasks, folder)


def _plan(missing: list[Task], section: str, folder: Path, workers: int) -> None:
    """Plan a section's tasks and write a row of each."""
    plans = folder / f"{section}.csv"
    for number, done in enumerate(plan_all(missing, workers), 1):
        # The row last: a study that is stopped in between plans the task again.
        append_rows(folder / TRIPS, TripRow, done.trips)
        if done.reply is not None:
            keep_cheaper(folder / PLAN, done.reply)
        append_rows(plans, Planned, [done.row])
        if number % 20 == 0 or number == len(missing):
            typer.echo(f"{section}: {number} of {len(missing)}")


def keep_cheaper(path: Path, reply: bytes) -> None:
    """Write a plan to a file unless one as cheap is in it."""
    if not path.exists() or _total(reply) < _total(path.read_bytes()):
        path.write_bytes(reply)


def _total(reply: bytes) -> float:
    cost: float = json.loads(reply)["cost"]["total"]
    return cost


def _read(tasks: Iterable[Task], folder: Path) -> Study:
    """Return the rows of these tasks, each once, in their order."""
    wanted = list(tasks)
    rows = {row.task: row for section in _sections(wanted)
            for row in read_rows(folder / f"{section}.csv", Planned)}
    trips = {(trip.customers, trip.case, trip.fleet, trip.seed, trip.vehicle, trip.trip): trip
             for trip in read_rows(folder / TRIPS, TripRow)}
    plans = {(task.customers, task.case, task.fleet, task.seed) for task in wanted
             if task.section == "fleets"}
    return Study([rows[task] for task in wanted],
                 [trip for key, trip in trips.items() if key[:4] in plans])


def _sections(tasks: Iterable[Task]) -> Collection[str]:
    return dict.fromkeys(task.section for task in tasks)


def main(
    quick: Annotated[bool, typer.Option("--quick", help="a small study, in 3 minutes")] = False,
    output: Annotated[Path | None, typer.Option(
        help="report; its pictures and CSVs are put into a folder of its name beside it "
        f"[default: {PAGE} with CSVs in {RUNS}, build/study.md with --quick]")] = None,
    workers: Annotated[int, typer.Option(help="processes that plan", min=1)]
    = min(2, os.cpu_count() or 1),
) -> None:
    """Plan the study and write its report."""
    page = output or (Path("build/study.md") if quick else PAGE)
    runs = RUNS if page == PAGE else page.with_suffix("")
    write_report(run(QUICK if quick else FULL, runs, workers), page, runs)
    typer.echo(f"The report is {page}.")


if __name__ == "__main__":
    typer.run(main)
