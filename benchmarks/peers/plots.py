"""Plots of measured runs."""

import math
import statistics
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from benchmarks.peers.workers import SOLVERS
from benchmarks.results import Result

COLOURS = {name: f"C{index}" for index, name in enumerate(SOLVERS)}

LINEAR_BELOW = 0.1
"""Gaps are drawn on a logarithmic scale down to this; below, where 0 is, on a linear one."""

MARKERS = "osD^vP*"

SIZES = (100, 200, 400, 1000)
"""Customers that the sets are about."""


def draw_anytime(groups: Mapping[tuple[str, float, str], Sequence[Result]], path: Path) -> None:
    """Draw mean gap over mean wall-clock, a panel for each set. Groups as of `report.by_group`."""
    sets = list(dict.fromkeys(set_name for set_name, _, _ in groups))
    budgets = sorted({budget for _, budget, _ in groups})
    columns = min(4, len(sets) + 1)
    rows = math.ceil((len(sets) + 1) / columns)
    figure = Figure(figsize=(3.2 * columns, 2.9 * rows), layout="constrained")
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for panel, set_name in zip(panels, sets, strict=False):
        for name in SOLVERS:
            points = sorted(_means(found) for (group, _, solver), found in groups.items()
                            if (group, solver) == (set_name, name)
                            and any(row.counts for row in found))
            if points:
                panel.plot(*zip(*points, strict=True), marker="o", markersize=3, label=name,
                           color=COLOURS[name])
        panel.set(title=set_name, xlabel="seconds", ylabel="gap, %")
        _scale(panel, budgets)
    _save(figure, panels, path)


def draw_by_size(results: Sequence[Result], path: Path) -> None:
    """Draw the gap of each instance, mean over seeds, over its customers; a panel per budget."""
    budgets = sorted({row.budget_s for row in results})
    sets = list(dict.fromkeys(row.set for row in results))
    figure = Figure(figsize=(3.6 * (len(budgets) + 1), 3.4), layout="constrained")
    panels = list(figure.subplots(1, len(budgets) + 1, squeeze=False).flat)
    for panel, budget in zip(panels, budgets, strict=False):
        for (name, set_name), points in _sizes(results, budget).items():
            panel.scatter(*zip(*points, strict=True), s=12, alpha=0.7, color=COLOURS[name],
                          marker=MARKERS[sets.index(set_name) % len(MARKERS)])
        for name in SOLVERS:
            if any(row.solver == name for row in results):
                panel.plot([], [], "-", color=COLOURS[name], label=name)
        for index, set_name in enumerate(sets):
            panel.plot([], [], MARKERS[index % len(MARKERS)], color="grey", label=set_name)
        panel.set(title=f"{budget:g} s", xlabel="customers", ylabel="gap, %")
        _scale(panel, SIZES)
    _save(figure, panels, path)


def _means(rows: Iterable[Result]) -> tuple[float, float]:
    """Return mean seconds and mean gap of the plans that count."""
    good = [row for row in rows if row.counts]
    return (statistics.fmean(row.wall_s for row in good),
            statistics.fmean(row.gap_percent for row in good))


def _sizes(
    results: Iterable[Result], budget: float
) -> dict[tuple[str, str], list[tuple[float, float]]]:
    """Return size and mean gap of each instance, by solver and set."""
    gaps: dict[tuple[str, str, str, int], list[float]] = {}
    for row in results:
        if row.counts and row.budget_s == budget:
            gaps.setdefault((row.solver, row.set, row.instance, row.n), []).append(row.gap_percent)
    points: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for (name, set_name, _, size), values in gaps.items():
        points.setdefault((name, set_name), []).append((size, statistics.fmean(values)))
    return points


def _scale(panel: Axes, places: Sequence[float]) -> None:
    """Make both axes logarithmic, with ticks at places of the x axis. In place."""
    panel.set_xscale("log")
    panel.set_xticks(places, [f"{place:g}" for place in places])
    panel.set_yscale("symlog", linthresh=LINEAR_BELOW)
    panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.set_ylim(bottom=min(0.0, float(panel.dataLim.y0)))
    panel.minorticks_off()
    panel.grid(alpha=0.3)


def _save(figure: Figure, panels: Sequence[Axes], path: Path) -> None:
    """Put the legend into the last panel, hide empty ones and write an SVG, always the same."""
    entries: dict[str, Artist] = {}
    for panel in panels:
        handles, labels = panel.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
        if not panel.has_data():
            panel.axis("off")
    ordered = [name for name in SOLVERS if name in entries]
    ordered += [name for name in entries if name not in SOLVERS]
    panels[-1].legend([entries[name] for name in ordered], ordered, loc="center", frameon=False,
                      fontsize="small")
    with mpl.rc_context({"svg.hashsalt": "versus", "svg.fonttype": "none"}):
        figure.savefig(path, metadata={"Date": None})
