"""Thousands of customers: gaps, turns and memory. `python -m benchmarks.quality.large`.

    python -m benchmarks.quality.large ../shared/data/xxl \\
        --instances Leuven2,drawn-1-4000-30-central

Plans CVRPLIB's instances of a folder with `best_known.csv`, and problems of the same kind that are
drawn: by seed, customers, what a vehicle holds, and whether the depot lies `central` or
`eccentric`. With `--types` trucks half as large and twice as large drive as well. One thread. What
legs and neighbours take is told, and comes before the budget. With `--filo2` and the path of that
program, built from its source, it plans each problem next, in as much processor time, of which all
that it does counts.
"""

import resource
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated
from unittest.mock import patch

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.formats.files.importers import read_instance_file
from benchmarks.clock import count_processor_time
from benchmarks.peers import filo2 as filo2_peer
from benchmarks.peers.answers import cost_of_all, timed_plan
from benchmarks.peers.published import MODEL_UNITS, best_known_beside
from benchmarks.results import gap_percent
from benchmarks.rows import append_rows, read_rows
from model.engine.instance import pack
from model.problem import (
    MM_PER_KM, Customer, Depot, FloatArray, IntArray, Points, Problem, StraightLegs, Travel,
    VehicleType,
)
from model.problem.distances import ROUND
from model.search import improve as search
from model.search.neighbourhood.neighbourhood import make_neighbourhood
from model.solution import Solution

AREA = 10_000
"""Side of the square of a drawn problem."""

IN_THE_COUNTRY = 0.25
"""Share of its customers who live in no town."""

PER_TOWN = 60
"""Its customers for each town, some ten times as large as others."""

DEMANDS, SHARES = (1, 2, 3), (0.5, 0.3, 0.2)

METRE_A_SECOND = 3.6
"""Kilometres an hour."""

SIZES = ((0.5, 0.5, 1.0, 1.0), (1.0, 0.9, 1.1, 0.5), (2.0, 1.7, 1.3, 0.3))
"""Types of trucks: what they hold, by the truck alone; what they cost at all, by the mean way from
the depot; what they cost a metre, and how many there are, by the truck alone."""

WARM = "drawn-0-3000-30-central"
"""What is planned first, so that all is loaded."""


@dataclass(frozen=True)
class Row:
    """A judged run."""

    solver: str
    instance: str
    n: int
    budget_s: float
    seed: int
    legs_s: float  # for legs and neighbours, before the budget
    wall_s: float
    turns: int  # 0 of others
    routes: int
    cost: float
    best_known: float
    gap_percent: float  # nan without a best known cost
    memory_mb: float  # most that the process ever held


@dataclass(frozen=True)
class Stated:
    """A problem of one depot and trucks all alike."""

    place: FloatArray  # (node, 2)
    demand: IntArray  # (node,)
    capacity: int


def drawn(name: str) -> Stated:
    """Return the problem that is named by how it is drawn.

    Raises
    ------
    ValueError
        If the name says something else.
    """
    kind, *numbers, where = name.split("-")
    if kind != "drawn" or len(numbers) != 3 or where not in ("central", "eccentric"):
        raise ValueError(f"instance: {name!r} is neither a file nor drawn-1-4000-30-central, say")
    seed, count, capacity = map(int, numbers)
    rng = np.random.default_rng(seed)
    towns = max(5, count // PER_TOWN)
    size = rng.pareto(1.2, towns) + 0.3
    town = rng.choice(towns, count, p=size / size.sum())
    spread = 0.012 * AREA * np.sqrt(size * towns / size.sum())[town]
    place = rng.uniform(0, AREA, (towns, 2))[town] + rng.normal(0, 1, (count, 2)) * spread[:, None]
    country = rng.random(count) < IN_THE_COUNTRY
    place[country] = rng.uniform(0, AREA, (int(country.sum()), 2))
    place = np.clip(np.rint(place), 0, AREA)
    depot = np.rint(place.mean(axis=0)) if where == "central" else np.array([0.02, 0.05]) * AREA
    return Stated(np.vstack([depot, place]),
                  np.append(0, rng.choice(DEMANDS, count, p=SHARES)), capacity)


def read(path: Path) -> Stated:
    """Return a problem of CVRPLIB."""
    file = read_instance_file(path)
    if file.coordinates is None or file.depots != (0,) or len(file.vehicles) != 1:
        raise ValueError(f"{path}: has coordinates, one depot, and vehicles all alike")
    return Stated(file.coordinates, np.rint(file.demand).astype(np.int64),
                  int(file.vehicles[0].capacity))


def as_problem(stated: Stated) -> Problem:
    """Return it as the planner takes it; a unit of distance costs 1, and is a metre."""
    legs = StraightLegs(Points(stated.place.astype(np.float64), rounding=ROUND), METRE_A_SECOND)
    customers = tuple(Customer(str(node), (demand * MODEL_UNITS,))
                      for node, demand in enumerate(stated.demand.tolist()) if node)
    truck = VehicleType("truck", len(customers), (stated.capacity * MODEL_UNITS,), travel=0,
                        cost_per_km=MM_PER_KM / MODEL_UNITS)
    return Problem((Depot("depot"),), customers, (truck,), (Travel.along(legs),), stated.place,
                   unassigned_cost=10.0 * legs.longest_distance())


def with_types(problem: Problem) -> Problem:
    """Return a problem with trucks of three types, which hold more the dearer they are."""
    (truck,), (travel,) = problem.vehicle_types, problem.travel
    way = float(travel.distance[0].mean()) / MM_PER_KM * truck.cost_per_km
    return replace(problem, vehicle_types=tuple(
        replace(truck, id=f"{size:g}", count=max(4, round(truck.count * share)),
                capacity=tuple(int(each * size) for each in truck.capacity),
                fixed_cost=way * fixed, cost_per_km=truck.cost_per_km * rate)
        for size, fixed, rate, share in SIZES))


def runs(folder: Path, name: str, budgets: list[float], seeds: int,
         filo2: Path | None = None, types: bool = False) -> Iterator[Row]:
    """Plan an instance by all budgets and seeds, which count from 1."""
    path = folder / f"{name}.vrp"
    stated = read(path) if path.exists() else drawn(name)
    problem, known = as_problem(stated), best_known_beside(path, "best_known")
    if types:
        problem, known = with_types(problem), float("nan")
    nobody = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    began = time.perf_counter()
    instance = pack([problem], legs=False)
    neighbourhood = make_neighbourhood(problem, instance, along=True)
    legs = time.perf_counter() - began
    for budget in budgets:
        for seed in range(1, seeds + 1):
            began = time.perf_counter()
            with patch.object(search, "make_neighbourhood", lambda *_, **__: neighbourhood):
                found = search.improve(problem, instance, nobody, search.SearchConfig(seed),
                                       began + budget)
            wall = time.perf_counter() - began
            cost = cost_of_all(name, problem, found.solution)
            yield Row("tandem", name, problem.num_customers, budget, seed, legs, wall, found.turns,
                      len(found.solution.routes), cost, known, gap_percent(cost, known),
                      resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
            if filo2 is not None:
                routes, took = filo2_peer.solve(filo2, stated.place, stated.demand,
                                                stated.capacity, budget, seed)
                plan = timed_plan(problem, [(0, [nodes]) for nodes in routes])
                cost = cost_of_all(name, problem, plan)
                yield Row("filo2", name, problem.num_customers, budget, seed, 0.0, took, 0,
                          len(routes), cost, known, gap_percent(cost, known),
                          resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024)


def table(rows: list[Row]) -> Table:
    """Return the means over seeds."""
    columns = Table("instance", "customers", "s", "solver", "took s", "gap %", "cost", "routes",
                    "turns", "legs s", "MB")
    def key_of(row: Row) -> tuple[int, str, float, str]:
        return row.n, row.instance, row.budget_s, row.solver
    for key in sorted({key_of(row) for row in rows}):
        same = [row for row in rows if key_of(row) == key]
        def mean(name: str, same: list[Row] = same) -> float:
            return float(np.mean([getattr(row, name) for row in same]))
        columns.add_row(key[1], str(key[0]), f"{key[2]:g}", key[3], f"{mean('wall_s'):.1f}",
                        f"{mean('gap_percent'):.2f}", f"{mean('cost'):.0f}",
                        f"{mean('routes'):.1f}", f"{mean('turns'):.0f}", f"{mean('legs_s'):.1f}",
                        f"{max(row.memory_mb for row in same):.0f}")
    return columns


def main(folder: Path, instances: Annotated[str, typer.Option()] = "Leuven2,Antwerp1",
         seconds: Annotated[str, typer.Option()] = "10,60",
         seeds: Annotated[int, typer.Option()] = 1,
         filo2: Annotated[Path | None, typer.Option(help="the program, to run beside")] = None,
         types: Annotated[bool, typer.Option("--types", help="trucks of three types")] = False,
         output: Annotated[Path, typer.Option()] = Path("runs/bench/large.csv"),
         processor_time: Annotated[bool, typer.Option(
             "--processor-time", help="budgets of processor time")] = False) -> None:
    """Plan, write a row for each run, and print the table of all rows.

    Raises
    ------
    ValueError
        If FILO2, whose trucks are all alike, is to plan for trucks of three types.
    """
    if types and filo2 is not None:
        raise ValueError("types, filo2: FILO2 plans for trucks all alike")
    if processor_time:
        count_processor_time()
    list(runs(folder, WARM, [1.0], 1, types=types))
    for name in instances.split(","):
        append_rows(output, Row, runs(folder, name, [float(each) for each in seconds.split(",")],
                                      seeds, filo2, types))
    Console().print(table(read_rows(output, Row)))


if __name__ == "__main__":
    typer.run(main)
