"""Tandem on pickup and delivery with windows: fewest vehicles first, then the shortest way.

`python -m benchmarks.quality.shipments data --seconds 10`: instances of Li and Lim, and of Sartori
and Buriol, against the best known plans beside them. A vehicle costs more than any plan is long.

References
----------
Li and Lim (2001), a metaheuristic for the pickup and delivery problem with time windows, ICTAI.
Sartori and Buriol (2020), a study on the pickup and delivery problem with time windows,
Computers & Operations Research 124:105065.
"""

import csv
import math
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from benchmarks.results import gap_percent
from benchmarks.rows import appended
from model.judge.check import check
from model.engine.instance import pack
from model.problem import (
    Customer, Depot, FloatArray, IntArray, Problem, Shipment, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.solution import Solution

SETS = "pdptw_lilim", "pdptw_sartori_buriol"
UNIT = 1000  # of length, time and load in the file's
MM_A_KM = 1_000_000
FIXED = 1e6  # of a vehicle, in units of length
LEFT_OUT = 1e8


@dataclass(frozen=True, eq=False)
class Instance:
    """A file, as it states its nodes; the first is the depot."""

    name: str
    capacity: int
    vehicles: int
    places: FloatArray  # (node, 2)
    stops: IntArray  # (node, 6) demand, ready, due, service, its pickup, its delivery
    legs: IntArray  # (node, node) in thousandths
    best_vehicles: int
    best_known: float

    @property
    def num_customers(self) -> int:
        """Ends of shipments."""
        return len(self.stops) - 1


@dataclass(frozen=True)
class Run:
    """A judged plan."""

    instance: str
    n: int
    seconds: float
    seed: int
    vehicles: int
    length: float
    left_out: int
    best_vehicles: int
    best_known: float
    gap_percent: float  # of the length; nan with other vehicles than the best known plan
    turns: int
    wall_s: float


def read(path: Path) -> Instance:
    """Return an instance of either set, with its best known plan's vehicles and length."""
    text = path.read_text()
    stated = _read_headed(text) if "NODES" in text else _read_plain(text)
    with path.with_name("best_known.csv").open(encoding="utf-8", newline="") as file:
        best = {row["instance"]: row for row in csv.DictReader(file)}[path.stem]
    return Instance(path.stem, *stated, int(best["vehicles"]), float(best["best_known"]))


def _read_plain(text: str) -> tuple[int, int, FloatArray, IntArray, IntArray]:
    """Return capacity, vehicles, places, stops and legs of a file by Li and Lim."""
    first, *rows = [line.split() for line in text.splitlines() if line.strip()]
    table = np.array(rows, np.float64)
    places = table[:, 1:3]
    legs = np.linalg.norm(places[:, None] - places, axis=2)
    return (int(first[1]), int(first[0]), places, table[:, 3:9].astype(np.int64),
            np.rint(legs * UNIT).astype(np.int64))


def _read_headed(text: str) -> tuple[int, int, FloatArray, IntArray, IntArray]:
    """Return the same of a file by Sartori and Buriol."""
    head, rest = text.split("NODES\n")
    nodes, edges = rest.split("EDGES\n")
    stated = dict(line.split(":", 1) for line in head.splitlines())
    table = np.array([line.split() for line in nodes.splitlines()], np.float64)
    legs = np.array([line.split() for line in edges.splitlines() if line[:1].isdigit()], np.int64)
    return (int(stated["CAPACITY"]), len(table) // 2, table[:, 1:3],
            table[:, 3:9].astype(np.int64), legs * UNIT)


def to_problem(instance: Instance) -> Problem:
    """Return an instance as a problem in which a vehicle costs more than any way."""
    stops = instance.stops * UNIT
    customers = tuple(
        Customer(str(node), (0,), service_duration=int(stops[node, 3]),
                 earliest=int(stops[node, 1]), latest=int(stops[node, 2]), served_by="truck",
                 unassigned_cost=None if stops[node, 0] > 0 else 0.0)
        for node in range(1, len(stops)))
    shipments = tuple(
        Shipment(str(node), node, int(instance.stops[node, 5]), (int(stops[node, 0]),))
        for node in range(1, len(stops)) if stops[node, 0] > 0)
    truck = VehicleType("truck", instance.vehicles, (instance.capacity * UNIT,), 0,
                        fixed_cost=FIXED, cost_per_km=MM_A_KM / UNIT, latest=int(stops[0, 2]))
    return Problem((Depot("depot"),), customers, (truck,), (Travel(instance.legs, instance.legs),),
                   instance.places, LEFT_OUT, shipments=shipments)


def run(instance: Instance, seconds: float, seed: int) -> Run:
    """Plan an instance and judge the plan."""
    problem, began = to_problem(instance), time.perf_counter()
    nobody = Solution((), tuple(range(1, problem.num_nodes)))
    found = improve(problem, pack([problem], False), nobody, SearchConfig(seed),
                    began + seconds)
    wall = time.perf_counter() - began
    evaluation = check(problem, found.solution)
    if evaluation.violations:
        raise RuntimeError(f"{instance.name}: {evaluation.violations[0].message}")
    vehicles, length = len(found.solution.routes), evaluation.cost.distance
    gap = gap_percent(length, instance.best_known)
    return Run(instance.name, instance.num_customers, seconds, seed, vehicles, length,
               len(found.solution.unassigned) // 2, instance.best_vehicles, instance.best_known,
               gap if vehicles == instance.best_vehicles else math.nan, found.turns, wall)


def main(
    data: Path,
    out: Annotated[Path | None, typer.Option(help="CSV to add rows to.")] = None,
    seconds: Annotated[float, typer.Option(help="Time for each plan.")] = 10.0,
    seeds: Annotated[int, typer.Option(help="Plans of each instance.")] = 1,
    least: Annotated[int, typer.Option(help="Fewest ends of shipments.")] = 0,
    most: Annotated[int, typer.Option(help="Most ends of shipments.")] = 10**9,
    names: Annotated[list[str] | None, typer.Option("--set", help="Sets, if not both.")] = None,
) -> None:
    """Plan the instances of some sets."""
    instances = [read(path) for name in names or SETS
                 for path in sorted((data / name).glob("*.txt"))]
    runs = (run(instance, seconds, seed) for instance in instances
            if least <= instance.num_customers <= most for seed in range(seeds))
    for row in runs if out is None else appended(out, Run, runs):
        print(f"{row.instance:14} {row.n:5} {row.vehicles:4} of {row.best_vehicles:4} "
              f"{row.length:10.1f} of {row.best_known:10.1f} {row.gap_percent:7.2f} % "
              f"{row.turns:9} turns" + f", {row.left_out} left out" * (row.left_out > 0),
              flush=True)


if __name__ == "__main__":
    typer.run(main)
