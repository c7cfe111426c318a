"""Tables and plots of `benchmarks.peers.versus`: `python -m benchmarks.peers.report`.

Writes `docs/develop/benchmarks.md`, in it only what lies between two markers; of the part `versus`
two plots beside it, too.
"""

import math
import statistics
from collections.abc import Iterable, Sequence
from itertools import groupby
from pathlib import Path
from typing import Annotated

import typer

from benchmarks.peers.plots import draw_anytime, draw_by_size
from benchmarks.peers.workers import SOLVERS
from benchmarks.results import Result
from benchmarks.rows import read_rows

OVERRUN = 1.2
"""Calls longer than this share of the budget are noted."""

OWN = "tandem"
"""The solver whose gaps are held against others', and told with their spread."""

TITLE = "# Benchmarks\n\nTandem beside other solvers on public instances."

NOTES = """\
Mean gap to the best known cost in %, the best bold.
± is the standard deviation of the means of Tandem's seeds.
In brackets: how many plans were infeasible, left customers out or never came; the mean is without.
Also how long the call took, where it was well over the budget.
Blank: the solver can't plan such instances or keep to such a budget.
The last column divides Tandem's gap on one thread by that of the best other solver.

Budgets are the wall-clock of the solver's call, code loaded before.
Conventions and best known costs are those of the sets.
VROOM is the better of exploration levels 0 and 5.
OR-Tools (guided local search) is the better of two first plans, each given the whole budget.
HGS counts processor time."""

RULE_NOTES = """\
Mean gap to the best known cost in %, as above.
Costs are the sets' own, counted once by the judge and once from the instance's numbers.
The best known plans, judged, cost exactly what is stated.
Of `vrpmtw` none are known: the gap is to plans that PyVRP found in 80 s, and may be negative.
PyVRP takes several windows as clients of whom one is served.
It takes tables of who may serve whom, and backhauls, as legs far too long.
It takes open ends as a depot that all legs to have no length."""

PARTS = {"versus": NOTES, "rule-sets": RULE_NOTES}
"""Parts of the page, by the names in their markers, and what is said below their tables."""

Group = tuple[str, float, str]
"""Set, budget, solver."""


def by_group(results: Iterable[Result]) -> dict[Group, list[Result]]:
    """Return results by set, budget and solver."""
    groups: dict[Group, list[Result]] = {}
    for row in results:
        groups.setdefault((row.set, row.budget_s, row.solver), []).append(row)
    return groups


def mean_gap(rows: Iterable[Result]) -> float:
    """Return the mean gap of the plans that count, in percent; nan if none does."""
    gaps = [row.gap_percent for row in rows if row.counts]
    return statistics.fmean(gaps) if gaps else math.nan


def spread(rows: Iterable[Result]) -> float:
    """Return the standard deviation of the mean gaps of each seed; nan of fewer than two."""
    ordered = sorted((row for row in rows if row.counts), key=lambda row: row.seed)
    means = [mean_gap(group) for _, group in groupby(ordered, key=lambda row: row.seed)]
    return statistics.stdev(means) if len(means) > 1 else math.nan


def _cell(rows: Sequence[Result], is_best: bool) -> str:
    """Return what a table says of one solver on one set within one budget."""
    if not rows:
        return ""
    gap = mean_gap(rows)
    text = "none" if math.isnan(gap) else f"**{gap:.2f}**" if is_best else f"{gap:.2f}"
    if rows[0].solver == OWN and not math.isnan(deviation := spread(rows)):
        text += f" ± {deviation:.2f}"
    notes = []
    if failed := sum(not row.counts for row in rows):
        notes.append(f"{failed} of {len(rows)} failed")
    walls = [row.wall_s for row in rows if not math.isnan(row.wall_s)]
    if walls and statistics.fmean(walls) > OVERRUN * rows[0].budget_s:
        notes.append(f"took {statistics.fmean(walls):.2g} s")
    return f"{text} ({', '.join(notes)})" if notes else text


def table(results: Sequence[Result]) -> list[str]:
    """Return the Markdown table, a row for each set and budget."""
    groups = by_group(results)
    solvers = [name for name in SOLVERS if any(row.solver == name for row in results)]
    lines = ["| " + " | ".join(["set (instances)", "s", *solvers, "Tandem / best"]) + " |",
             "| --- | ---: |" + " --- |" * len(solvers) + " ---: |"]
    for set_name in dict.fromkeys(row.set for row in results):
        count = len({row.instance for row in results if row.set == set_name})
        for budget in sorted({row.budget_s for row in results if row.set == set_name}):
            rows = {name: groups.get((set_name, budget, name), []) for name in solvers}
            gaps = {name: mean_gap(found) for name, found in rows.items()}
            lowest = min((gap for gap in gaps.values() if not math.isnan(gap)), default=math.nan)
            cells = [_cell(rows[name], gaps[name] == lowest) for name in solvers]
            lines.append("| " + " | ".join(
                [f"{set_name} ({count})", f"{budget:g}", *cells, _ratio(gaps)]) + " |")
    return lines


def _ratio(gaps: dict[str, float]) -> str:
    """Return Tandem's gap on one thread as a share of the best peer's."""
    others = [gap for name, gap in gaps.items()
              if not name.startswith(OWN) and not math.isnan(gap)]
    own = gaps.get(OWN, math.nan)
    return "" if math.isnan(own) or not others or min(others) <= 0 else f"{own / min(others):.2f}"


def _circumstances(results: Sequence[Result]) -> str:
    dates = sorted({row.date for row in results})
    when = f"on {dates[0]}" if len(dates) == 1 else f"from {dates[0]} to {dates[-1]}"
    versions = []
    for name, solver in SOLVERS.items():
        found = sorted({row.version for row in results if row.solver == name and row.version})
        if found:
            threads = "1 thread" if solver.threads == 1 else f"{solver.threads} threads"
            versions.append(f"{name} {', '.join(found)} ({threads})")
    machines = "; ".join(sorted({row.machine for row in results}))
    seeds = ", ".join(str(seed) for seed in sorted({row.seed for row in results}))
    return (f"Measured {when}, {machines}, with the seeds {seeds} where a solver has any.\n"
            f"Versions: {'; '.join(versions)}.")


def markers(part: str) -> tuple[str, str]:
    """Return what stands before and after a part of the page."""
    return f"<!-- {part}: begin -->", f"<!-- {part}: end -->"


def write(results: Sequence[Result], page: Path, part: str = "versus") -> None:
    """Write a part of the page between its markers, keeping what is around it, and plots.

    Raises
    ------
    ValueError
        If the page is there and has no markers.
    """
    begin, end = markers(part)
    text = page.read_text(encoding="utf-8") if page.exists() else f"{TITLE}\n\n{begin}\n{end}\n"
    before, begun, rest = text.partition(begin)
    _, ended, after = rest.partition(end)
    if not (begun and ended):
        raise ValueError(f"{page}: has no part between {begin} and {end}")
    plots = ["![Mean gap over time for each set](anytime.svg)", "",
             "![Gap over the number of customers](by_size.svg)", ""] if part == "versus" else []
    written = "\n".join([
        begin, "", _circumstances(results), "", *table(results), "", PARTS[part], "", *plots, end])
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(before + written + after, encoding="utf-8")
    if plots:
        draw_anytime(by_group(results), page.with_name("anytime.svg"))
        draw_by_size(results, page.with_name("by_size.svg"))


def main(
    results: Annotated[Path, typer.Option(help="CSV of benchmarks.peers.versus", exists=True)]
    = Path("runs/bench/versus.csv"),
    output: Annotated[Path, typer.Option(help="Markdown page")] = Path(
        "docs/develop/benchmarks.md"),
    part: Annotated[str, typer.Option(help=" or ".join(PARTS))] = "versus",
) -> None:
    """Write the page and its plots."""
    try:
        if part not in PARTS:
            raise ValueError(f"part: {part!r} is none of {', '.join(PARTS)}")
        write(read_rows(results, Result), output, part)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from error


if __name__ == "__main__":
    typer.run(main)
