"""Tandem beside other solvers on published instances: `python -m benchmarks.peers.versus`.

Each run is a row of a CSV, written as soon as it is there; runs that have a row are not repeated,
so a broken-off measurement goes on where it stopped. One solver runs at a time. Neighbouring runs
are of one instance and budget by all solvers in turn, so that what else the machine does hits all
alike. `python -m benchmarks.peers.report` makes tables and plots of the CSV.
"""

import math
import os
import platform
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import zip_longest
from pathlib import Path
from typing import Annotated

import typer

from benchmarks.peers.answers import PeerAnswer, Verdict, judge, stated_cost
from benchmarks.peers.instances import uniform_set
from benchmarks.peers.published import BY_NAME, CONVENTIONS, Published, published_set, to_problem
from benchmarks.peers.rule_sets import RULE_SETS, rule_set
from benchmarks.peers.workers import SOLVERS, NoPlanError, Worker, require_installed
from benchmarks.results import Result, gap_percent
from benchmarks.rows import append_rows, read_rows

QUICK = ("R101", "RC207", "R1_2_6", "X157-HD", "R205R0.25", "X-n200-k36")
"""Instances of a quick look."""

QUICK_BUDGETS = (0.1, 1.0)

UNIFORM = {"uniform_50": 50, "uniform_100": 100}
"""Sets of `vrptw_uniform.jsonl` by their number of customers."""

USUAL = tuple(name for name in CONVENTIONS if name not in BY_NAME)
"""Sets that are measured unless others are asked for."""

COMPARED = tuple(name for name in SOLVERS if name not in ("attention", "pointer"))
"""Solvers that are measured unless others are asked for."""


@dataclass(frozen=True)
class Run:
    """What is to be measured once."""

    instance: Published
    solver: str
    budget: float  # seconds
    seed: int

    @property
    def key(self) -> tuple[str, str, str, float, int]:
        """As in `Result`."""
        return self.instance.set_name, self.instance.name, self.solver, self.budget, self.seed


def in_turn(sets: Sequence[Sequence[Published]]) -> list[Published]:
    """Return the first instance of each set, then the second of each, and so on."""
    return [instance for row in zip_longest(*sets) for instance in row if instance is not None]


def runs(instances: Sequence[Published], solvers: Sequence[str], budgets: Sequence[float],
         num_seeds: int) -> Iterator[Run]:
    """Yield all runs; the solvers take turns at being first. Seeds count from 1."""
    turn = 0
    for seed in range(1, num_seeds + 1):
        asked = [name for name in solvers if seed == 1 or SOLVERS[name].has_seed]
        for instance in instances:
            for budget in budgets:
                for place in range(len(asked)):
                    yield Run(instance, asked[(turn + place) % len(asked)], budget, seed)
                turn += 1


def machine() -> str:
    """Return the processor's name and how many cores there are."""
    name = platform.processor() or platform.machine()
    table = Path("/proc/cpuinfo")
    if table.exists():
        for line in table.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                name = line.partition(":")[2].strip()
                break
    return f"{name}, {os.cpu_count()} cores"


def result(run: Run, answer: PeerAnswer | None, clock: str = "") -> Result:
    """Return the row of a run; without an answer there is no plan."""
    instance = run.instance
    seconds = cost = gap = math.nan
    feasible = complete = False
    if answer is not None:
        verdict = judge(to_problem(instance), answer.routes)
        _require_stated_cost(instance, answer, verdict)
        feasible, complete = verdict.is_feasible, verdict.num_missing == 0
        seconds, cost = answer.seconds, verdict.cost
        gap = gap_percent(cost, instance.best_known) if verdict.counts else math.nan
    return Result(
        instance.set_name, instance.name, instance.num_customers, run.solver,
        SOLVERS[run.solver].threads, run.budget, run.seed, round(seconds, 4), round(cost, 6),
        instance.best_known, round(gap, 4), feasible, complete,
        "" if answer is None else answer.version, datetime.now(UTC).date().isoformat(),
        machine() + clock)


def _require_stated_cost(instance: Published, answer: PeerAnswer, verdict: Verdict) -> None:
    """Raise `ArithmeticError` if the judge's cost isn't what the instance's own numbers say."""
    stated = stated_cost(instance, answer.routes)
    if not math.isclose(verdict.cost, stated, rel_tol=1e-9, abs_tol=1e-9):
        raise ArithmeticError(f"{instance.name}: {verdict.cost} is judged, {stated} is stated")


def measure(planned: Sequence[Run], by_processor_time: bool = False) -> Iterator[Result]:
    """Yield the result of each run that its solver can make at all."""
    workers: dict[str, Worker] = {}
    clock = ", processor time" if by_processor_time else ""
    try:
        for number, run in enumerate(planned, start=1):
            worker = workers.setdefault(run.solver, Worker(
                SOLVERS[run.solver], by_processor_time=by_processor_time))
            title = f"{number}/{len(planned)} {run.instance.name} {run.solver} {run.budget:g} s"
            try:
                answer = worker.run(run.instance, run.budget, run.seed)
            except NoPlanError as error:
                typer.echo(f"{title}: no plan, {error}", err=True)
                yield result(run, None, clock)
                continue
            if answer is not None:
                row = result(run, answer, clock)
                found = (f"{row.gap_percent:.2f} %" if row.counts
                         else "incomplete" if row.feasible else "infeasible")
                typer.echo(f"{title}: {found} in {row.wall_s:.2f} s")
                yield row
    finally:
        for worker in workers.values():
            worker.close()


def _instances(data: Path, sets: Sequence[str], names: Sequence[str]) -> list[Published]:
    """Return the instances of sets in turn, those named or, if none are, all."""
    read = [uniform_set(data / "vrptw_uniform.jsonl", UNIFORM[name]) if name in UNIFORM
            else rule_set(data, name) if name in RULE_SETS
            else published_set(data, name, names) for name in sets]
    return in_turn([[instance for instance in group if not names or instance.name in names]
                    for group in read])


def main(
    data: Annotated[Path, typer.Option(help="folder of the published sets")]
    = Path("../shared/data"),
    sets: Annotated[str, typer.Option(help="comma-separated; also "
                                     + ", ".join((*UNIFORM, *RULE_SETS)))]
    = ",".join(USUAL),
    instances: Annotated[str, typer.Option(help="comma-separated; all if none are named, but of "
                                                + ", ".join(BY_NAME))] = "",
    budgets: Annotated[str, typer.Option(help="seconds, comma-separated")] = "0.1,1,10",
    seeds: Annotated[int, typer.Option(help="runs of each solver that has seeds", min=1)] = 3,
    solvers: Annotated[str, typer.Option(help="comma-separated, of " + ", ".join(SOLVERS))]
    = ",".join(COMPARED),
    output: Annotated[Path, typer.Option(help="CSV to write to, or to go on with")]
    = Path("runs/bench/versus.csv"),
    quick: Annotated[bool, typer.Option(
        "--quick", help="six instances, budgets of 0.1 and 1 s, one seed: a few minutes")] = False,
    processor_time: Annotated[bool, typer.Option(
        "--processor-time", help="budgets of processor time, for a machine that does other things; "
                                 "Tandem on one thread, and PyVRP")] = False,
) -> None:
    """Measure what isn't measured yet."""
    names = solvers.split(",")
    try:
        require_installed(names)
        limits = QUICK_BUDGETS if quick else tuple(float(text) for text in budgets.split(","))
        chosen = _instances(data, sets.split(","), QUICK if quick else
                            tuple(filter(None, instances.split(","))))
        known = {row.key for row in read_rows(output, Result)}
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error
    planned = [run for run in runs(chosen, names, limits, 1 if quick else seeds)
               if run.key not in known]
    typer.echo(f"{len(known)} runs are in {output}, up to {len(planned)} are to come")
    append_rows(output, Result, measure(planned, processor_time))


if __name__ == "__main__":
    typer.run(main)
