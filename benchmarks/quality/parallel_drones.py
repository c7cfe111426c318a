"""One truck and drones that fly from the same depot, least makespan, against the best known.

`python -m benchmarks.quality.parallel_drones ../shared/data/pdstsp`: the truck drives by Manhattan
distances, drones fly straight to one customer and back, as often as they like; nobody meets.

References
----------
Murray and Chu (2015), the flying sidekick traveling salesman problem: optimization of
drone-assisted parcel delivery, Transportation Research Part C 54:86-109. Instances: Mbiadou Saleu,
Deroussi, Feillet, Grangeon and Quilliot (2018), an iterative two-step heuristic for the parallel
drone scheduling traveling salesman problem, Networks 72:459-474.
"""

import csv
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.serving.settings import Settings
from benchmarks.results import gap_percent
from model.planner import Planner, PlanOptions, load_planner
from model.problem import (
    MS_PER_HOUR, Customer, Depot, Fairness, FloatArray, Problem, Travel, VehicleType,
)

UNIT = 1000
"""Milliseconds, and millimetres, in a unit of the instances."""

MOST_TRIPS = 1000


def problem_of(path: Path) -> Problem:
    """Read an instance."""
    lines = [line.split() for line in path.read_text("utf-8").replace(",", " ").splitlines()]
    stated = {" ".join(words[:-1]): float(words[-1]) for words in lines
              if words and words[0].isalpha()}
    places = np.array([words for words in lines if words and words[0].isdigit()], float)
    coordinates, heavy = places[:, 1:3], places[:, 3] > 0
    apart = coordinates[:, None] - coordinates
    legs = (np.abs(apart).sum(axis=2) / stated["TRUCK SPEED"],
            np.hypot(apart[..., 0], apart[..., 1]) / stated["DRONE SPEED"])
    customers = tuple(Customer(str(node), (1,), served_by="truck" if heavy[node] else "either")
                      for node in range(1, len(places)))
    fleet = (VehicleType("truck", 1, (len(customers),), 0),
             VehicleType("drone", int(stated["NUM DRONES"]), (1,), 1, flies=True,
                         max_trips=MOST_TRIPS))
    return Problem((Depot("depot"),), customers, fleet, tuple(map(_travel, legs)), coordinates,
                   1e7, fairness=Fairness(makespan_cost_per_hour=MS_PER_HOUR / UNIT))


def _travel(legs: FloatArray) -> Travel:
    rounded = np.rint(legs * UNIT).astype(np.int64)
    return Travel(rounded, rounded)


def makespan_of(planner: Planner, path: Path, seconds: float, seed: int) -> float:
    """Return when a plan's last vehicle is back."""
    options = PlanOptions("pointer", seed=seed, time_limit=seconds)
    return planner.plan(problem_of(path), options).evaluation.makespan / UNIT


def main(
    folder: Annotated[Path, typer.Argument(help="Where the instances are.")],
    seconds: Annotated[float, typer.Option(help="For each plan.")] = 10.0,
    seed: Annotated[int, typer.Option(help="Of the search.")] = 1,
) -> None:
    """Print the gap of each instance to the best known makespan, and the mean."""
    settings, gaps = Settings(), []
    planner = load_planner(settings.weights_dir, settings.policies)
    with (folder / "best_known.csv").open(encoding="utf-8") as file:
        best = {row["instance"]: float(row["best_known"]) for row in csv.DictReader(file)}
    for name, known in best.items():
        makespan = makespan_of(planner, folder / f"{name}.txt", seconds, seed)
        gaps.append(gap_percent(makespan, known))
        typer.echo(f"{name}: {makespan:.2f}, best known {known:.2f}, {gaps[-1]:.2f} %")
    typer.echo(f"mean {np.mean(gaps):.2f} %")


if __name__ == "__main__":
    typer.run(main)
