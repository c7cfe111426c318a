"""What came of days with disturbances, as a table and as a picture."""

import statistics
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

Found = Mapping[str, Sequence[Mapping[str, Any]]]
"""What came of each day, by how it was lived."""

PANELS = {"cost of an order served": "cost", "promises kept, %": "kept",
          "changes a driver sees": "changes"}


def table(found: Found) -> str:
    """Return means of all days in Markdown."""
    lines = ["| planned anew | cost | cost an order served | served, % | promises kept, % "
             "| changes a driver |", "| --- | ---: | ---: | ---: | ---: | ---: |"]
    for name, days in found.items():
        wanted, served = (sum(each[what] for each in days) for what in ("wanted", "served"))
        lines.append(
            f"| {name} | {statistics.fmean(each['cost'] for each in days):.0f} "
            f"| {sum(each['cost'] for each in days) / served:.2f} "
            f"| {100 * served / wanted:.1f} "
            f"| {100 * sum(each['kept'] for each in days) / wanted:.1f} "
            f"| {statistics.fmean(each['changes'] for each in days):.1f} |")
    return "\n".join(lines)


def draw(found: Found, path: Path) -> None:
    """Draw each day as a dot, and medians as strokes, as an SVG that is always the same."""
    names = list(found)[::-1]
    figure = Figure(figsize=(9, 0.8 + 0.4 * len(names)), layout="constrained")
    panels = figure.subplots(1, len(PANELS), sharey=True)
    for panel, (title, what) in zip(panels, PANELS.items(), strict=True):
        for row, name in enumerate(names):
            values = [_value(day, what) for day in found[name]]
            panel.plot(values, [row] * len(values), "o", color="C0", alpha=0.35, markersize=5,
                       markeredgewidth=0)
            panel.plot([statistics.median(values)] * 2, [row - 0.3, row + 0.3], color="C3")
        panel.set(title=title, yticks=range(len(names)), yticklabels=names)
        panel.set_xlim(left=0)
    with mpl.rc_context({"svg.hashsalt": "disturbed", "svg.fonttype": "none"}):
        figure.savefig(path, metadata={"Date": None})


def _value(day: Mapping[str, Any], what: str) -> float:
    by = {"cost": day["served"] or 1, "kept": day["wanted"] / 100, "changes": 1}[what]
    return float(day[what] / by)
