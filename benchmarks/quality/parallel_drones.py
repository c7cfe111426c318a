"""Trucks and drones that fly by themselves from the same depot, against the best known plans.

`python -m benchmarks.quality.parallel_drones ../shared/data/pdstsp`: one truck drives by Manhattan
distances, drones fly straight to one customer and back, as often as they like; least makespan.
`pdsvrp`: several trucks with loads and hours, the same drones, least cost. `mmvrpd`: all drive or
fly straight, several customers a trip, several trips, least makespan.

References
----------
Murray and Chu (2015), the flying sidekick traveling salesman problem: optimization of
drone-assisted parcel delivery, Transportation Research Part C 54:86-109. Instances: Mbiadou Saleu,
Deroussi, Feillet, Grangeon and Quilliot (2018), an iterative two-step heuristic for the parallel
drone scheduling traveling salesman problem, Networks 72:459-474; Nguyen, Dang, Hà and Pham (2022),
the min-cost parallel drone scheduling vehicle routing problem, European Journal of Operational
Research 299:910-930.
"""

import csv
from math import ceil, inf
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.serving.settings import Settings
from benchmarks.clock import count_processor_time
from benchmarks.results import gap_percent
from model.planner import Planner, PlanOptions, load_planner
from model.problem import (
    MM_PER_KM, MS_PER_HOUR, Customer, Depot, Fairness, FloatArray, Problem, Travel, VehicleType,
)

UNIT = 1000
"""Milliseconds in a unit of time, and millimetres in a unit of length, of instances in seconds."""

PARTS = 10**6
"""Of a kilogram. Demands are rounded up, so that no plan is too heavy."""

MOST_TRIPS = 1000

LATEST = Fairness(makespan_cost_per_hour=MS_PER_HOUR / UNIT)
"""A unit of time costs 1."""

OUT = 1e7
"""What it costs to leave somebody out."""


def problem_of(path: Path) -> Problem:
    """Read an instance of any of the three sets."""
    lines = [line.split() for line in path.read_text("utf-8").replace(",", " ").splitlines()]
    stated = {" ".join(words[:-1]): float(words[-1]) for words in lines
              if words and words[0][0].isalpha() and words[0] not in ("Coordinate", "depot")}
    numbers = np.array([words for words in lines if words and not words[0][0].isalpha()], float)
    if "trucks_count" in stated:
        return _picked_up(stated, numbers)
    return _by_cost(stated, numbers) if "TRUCK UNIT COST" in stated else _one_truck(stated, numbers)


def _one_truck(stated: dict[str, float], places: FloatArray) -> Problem:
    around, straight = _lengths(places[:, 1:3])
    customers = tuple(Customer(f"{node:g}", (1,), served_by="truck" if heavy > 0 else "either")
                      for node, *_, heavy in places[1:])
    fleet = (VehicleType("truck", 1, (len(customers),), 0),
             VehicleType("drone", int(stated["NUM DRONES"]), (1,), 1, flies=True,
                         max_trips=MOST_TRIPS))
    travel = (_travel(around, stated["TRUCK SPEED"]), _travel(straight, stated["DRONE SPEED"]))
    return Problem((Depot("depot"),), customers, fleet, travel, places[:, 1:3], OUT,
                   fairness=LATEST)


def _by_cost(stated: dict[str, float], places: FloatArray) -> Problem:
    """Kilometres and hours; a trip of a drone has room for one customer."""
    hour = MS_PER_HOUR
    customers = tuple(Customer(f"{node:g}", (_parts(weight), 1))
                      for node, _, _, weight in places[1:])
    fleet = (VehicleType("truck", int(stated["NUM TRUCKS"]),
                         (_parts(stated["TRUCK CAP"]), len(customers)), 0,
                         cost_per_km=stated["TRUCK UNIT COST"],
                         max_working_duration=round(stated["TRUCK TIME LIMIT"] * hour)),
             VehicleType("drone", int(stated["NUM DRONES"]), (_parts(stated["DRONE CAP"]), 1), 1,
                         cost_per_km=stated["DRONE UNIT COST"], flies=True, max_trips=MOST_TRIPS,
                         max_working_duration=round(stated["DRONE TIME LIMIT"] * hour),
                         endurance=round(stated["DRONE ENDURANCE"] * hour)))
    around, straight = _lengths(places[:, 1:3])
    travel = (_travel(around, stated["TRUCK SPEED"] / hour * UNIT, MM_PER_KM),
              _travel(straight, stated["DRONE SPEED"] / hour * UNIT, MM_PER_KM))
    return Problem((Depot("depot"),), customers, fleet, travel, places[:, 1:3], OUT)


DRIVING, FLYING = 15.6464, 31.2928
"""Metres a second."""

TRUCK_HOLDS, DRONE_HOLDS = 1400.0, 2.27
"""Kilograms."""

LONGEST_FLIGHT, LONGEST_ABOARD = 700 * UNIT, 3600 * UNIT


def _picked_up(stated: dict[str, float], places: FloatArray) -> Problem:
    """Metres and seconds. What has to be back within an hour of the visit is delivered within an
    hour of the departure on the trip's way back, which takes as long.
    """
    points = np.vstack([np.zeros(2), places[:, :2]])
    customers = tuple(
        Customer(str(node), (_parts(weight),), max_time_aboard=LONGEST_ABOARD,
                 served_by="either" if dronable and weight <= DRONE_HOLDS else "truck")
        for node, (dronable, weight) in enumerate(places[:, 2:], 1))
    fleet = (VehicleType("truck", int(stated["trucks_count"]), (_parts(TRUCK_HOLDS),), 0,
                         max_trips=MOST_TRIPS),
             VehicleType("drone", int(stated["drones_count"]), (_parts(DRONE_HOLDS),), 1,
                         flies=True, max_trips=MOST_TRIPS, endurance=LONGEST_FLIGHT))
    straight = _lengths(points)[1]
    return Problem((Depot("depot"),), customers, fleet,
                   (_travel(straight, DRIVING), _travel(straight, FLYING)), points, OUT,
                   fairness=LATEST)


def _parts(kilograms: float) -> int:
    return ceil(round(kilograms * PARTS, 3))


def _lengths(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return Manhattan and Euclidean distances."""
    apart = points[:, None] - points
    return np.abs(apart).sum(axis=2), np.hypot(apart[..., 0], apart[..., 1])


def _travel(lengths: FloatArray, speed: float, unit: float = UNIT) -> Travel:
    """Return legs of a speed, in lengths a second; a length has so many millimetres."""
    duration, distance = (np.rint(legs).astype(np.int64)
                          for legs in (lengths / speed * UNIT, lengths * unit))
    return Travel(duration, distance)


def value_of(planner: Planner, problem: Problem, seconds: float, seed: int) -> float:
    """Return when a plan's last vehicle is back, or what the plan costs where that is asked."""
    options = PlanOptions("pointer", seed=seed, time_limit=seconds)
    plan = planner.plan(problem, options)
    if plan.solution.unassigned:
        return inf
    found = plan.evaluation
    return found.makespan / UNIT if problem.fairness.is_stated else found.cost.total


def main(
    folder: Annotated[Path, typer.Argument(help="Where the instances are.")],
    seconds: Annotated[float, typer.Option(help="Of the processor, for each plan.")] = 10.0,
    seed: Annotated[int, typer.Option(help="Of the search.")] = 1,
    most: Annotated[int, typer.Option(help="Customers of the largest instance.")] = 1000,
) -> None:
    """Print the gap of each instance to the best known value, and the mean."""
    count_processor_time()
    settings, gaps = Settings(), []
    planner = load_planner(settings.weights_dir, settings.policies)
    with (folder / "best_known.csv").open(encoding="utf-8") as file:
        best = {row["instance"]: float(row["best_known"]) for row in csv.DictReader(file)}
    for name, known in best.items():
        problem = problem_of(folder / f"{name}.txt")
        if problem.num_customers > most:
            continue
        value = value_of(planner, problem, seconds, seed)
        gaps.append(gap_percent(value, known))
        typer.echo(f"{name}: {value:.2f}, best known {known:.2f}, {gaps[-1]:.2f} %")
    typer.echo(f"mean {np.mean(gaps):.2f} %")


if __name__ == "__main__":
    typer.run(main)
