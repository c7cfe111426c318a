"""Draw a learning curve: `python -m training.plot --folder runs/pointer -o curve.png`."""

import csv
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from matplotlib.figure import Figure
from numpy.typing import NDArray

SMOOTHING = 50
"""Steps in the running mean of training costs."""

NO_CLASS = ("step", "seconds", "all")


def read(path: Path) -> dict[str, NDArray[np.float64]]:
    """Return the columns of a CSV of numbers."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def draw(folder: Path, output: Path) -> None:
    """Draw training cost and validation ratios over the minutes of training."""
    log, validation = read(folder / "log.csv"), read(folder / "validation.csv")
    figure = Figure(figsize=(11, 4.2), layout="constrained")
    costs, ratios = figure.subplots(1, 2)
    weight = np.ones(SMOOTHING) / SMOOTHING
    for low, high in ((0, 21), (21, 1000)):
        chosen = (log["customers"] >= low) & (log["customers"] < high)
        if chosen.sum() > SMOOTHING:
            minutes = log["seconds"][chosen][SMOOTHING - 1:] / 60
            # Batches differ by factors, so the mean is of their logarithms.
            smooth = np.exp(np.convolve(np.log(log["cost"][chosen]), weight, "valid"))
            name = f"up to {high - 1} customers" if low == 0 else f"more than {low - 1} customers"
            costs.plot(minutes, smooth, label=name)
    costs.set(xlabel="minutes of training", ylabel="cost of sampled plans, in units of the problem",
              yscale="log", title="training")
    costs.legend()
    for name, values in validation.items():
        if name not in NO_CLASS:
            ratios.plot(validation["seconds"] / 60, values, marker=".",
                        linestyle="--" if name.startswith("n") and name[1:].isdigit() else "-",
                        label=name)
    ratios.plot(validation["seconds"] / 60, validation["all"], color="black", linewidth=2,
                label="all")
    ratios.axhline(1.0, color="grey", linewidth=0.8)
    ratios.set(xlabel="minutes of training", ylabel="greedy cost / nearest neighbour's",
               title="validation")
    ratios.legend(fontsize="x-small", ncols=2)
    figure.savefig(output, dpi=110)


def main(folder: Annotated[Path, typer.Option(help="of training.train")],
         output: Annotated[Path, typer.Option("--output", "-o", help="a PNG or SVG")]) -> None:
    """Draw the learning curve of a run."""
    draw(folder, output)


if __name__ == "__main__":
    typer.run(main)
