"""The seed paper's experiments: `python -m benchmarks.table1`.

First its Table 1 (`examples/table1.json`), planned within several times. Then fleets as in its
Tables 3 to 5: trucks of one capacity against trucks of all, by working hours. What the paper
doesn't give is chosen here: the customers are drawn like those of Table 1, trucks drive 40 km/h
and up to three trips, and larger ones cost more per use and per kilometre.
"""

import math
import statistics
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.convert import to_problem
from app.reading import read_request
from app.settings import DEFAULT_POLICY, Settings
from model.planner import Planner, PlanOptions, Start, load_planner
from model.problem import MS_PER_HOUR, DroneType, Problem, VehicleType
from training.fleets import assemble
from training.ground import lay_ground
from training.orders import DRONE, EITHER, TRUCK, open_orders
from training.variants import LEAST_DEMAND, MOST_DEMAND

EXAMPLE = Path(__file__).parents[1] / "examples" / "table1.json"

REFERENCE = 710.53
"""Cost of the best plan known for Table 1, from a long search by other means."""

SIDE_KM, SPEED_KMH = 75.0, 40.0

DEPOT = (32 / SIDE_KM, 38 / SIDE_KM)
"""Table 1's, in sides."""

RESERVED = 0.1
"""Share of the customers for drones only, and of those for trucks only."""

SIZES = (25, 50, 100)

HOURS = (4.0, 6.5, 8.0, 11.0)

TRUCKS = {100: (10.0, 0.9), 150: (15.0, 1.0), 200: (20.0, 1.1)}
"""Cost per use and per kilometre of a truck, by its capacity."""

MAX_TRIPS = 3

FLEETS = {**{f"{capacity}": (capacity,) for capacity in TRUCKS}, "all three": tuple(TRUCKS)}

FLEETS_SEED = 20_251_120


@dataclass(frozen=True)
class Timed:
    """A plan of Table 1."""

    seconds: float  # allowed
    threads: int
    start: Start
    wall_s: float
    cost: float


@dataclass(frozen=True)
class FleetPlan:
    """A plan of one of the random problems."""

    size: int  # customers
    fleet: str  # key of `FLEETS`
    hours: float
    wall_s: float
    cost: float
    unassigned: int
    load_rates: tuple[float, ...]  # of all trips


def example() -> Problem:
    """Return Table 1."""
    return to_problem(read_request(EXAMPLE.read_bytes(), [DEFAULT_POLICY]))


def plan_example(planner: Planner, seconds: float, threads: int, seed: int) -> Timed:
    """Plan Table 1."""
    problem = example()
    began = time.perf_counter()
    result = planner.plan(problem, PlanOptions(DEFAULT_POLICY, seed=seed, time_limit=seconds,
                                               threads=threads))
    return Timed(seconds, threads, result.start, time.perf_counter() - began, result.final_cost)


def fleet_problem(rng: np.random.Generator, size: int) -> Problem:
    """Draw customers like those of Table 1, and all trucks without limits to their hours."""
    kinds = np.full(size, EITHER)
    reserved = round(RESERVED * size)
    kinds[:reserved], kinds[size - reserved:] = DRONE, TRUCK
    demand = rng.integers(LEAST_DEMAND[kinds], MOST_DEMAND[kinds] + 1)[:, None] * 1000
    ground = lay_ground(rng, np.vstack([DEPOT, rng.random((size, 2))]), 1, SIDE_KM, SPEED_KMH)
    orders = replace(open_orders(demand, np.zeros(size, dtype=np.int64)), served_by=kinds)
    drones = DroneType(1, (10_000,), travel=1, cost_per_km=1.0)
    trucks = tuple(
        VehicleType(f"{capacity}", math.ceil(size / 4), (capacity * 1000,), 0, fixed_cost=fixed,
                    cost_per_km=per_km, max_trips=MAX_TRIPS, drones=drones)
        for capacity, (fixed, per_km) in TRUCKS.items())
    return assemble(ground, orders, trucks, (ground.road(), ground.flight(1.0)))


def with_fleet(problem: Problem, fleet: str, hours: float) -> Problem:
    """Return the problem with the trucks of a fleet only, and their working hours."""
    trucks = dict(zip(TRUCKS, problem.vehicle_types, strict=True))
    limit = round(hours * MS_PER_HOUR)
    return replace(problem, vehicle_types=tuple(
        replace(trucks[capacity], max_working_duration=limit) for capacity in FLEETS[fleet]))


def plan_fleets(planner: Planner, sizes: Iterable[int], instances: int, hours: Sequence[float],
                seconds: float) -> Iterator[FleetPlan]:
    """Plan the same customers by each fleet."""
    for size in sizes:
        for index in range(instances):
            drawn = fleet_problem(np.random.default_rng((FLEETS_SEED, size, index)), size)
            for fleet in FLEETS:
                for limit in hours:
                    problem = with_fleet(drawn, fleet, limit)
                    began = time.perf_counter()
                    result = planner.plan(problem, PlanOptions(DEFAULT_POLICY, time_limit=seconds))
                    wall = time.perf_counter() - began
                    rates = [trip.load_rate for route in result.evaluation.routes
                             for trip in route.trips]
                    yield FleetPlan(size, fleet, limit, wall, result.final_cost,
                                    len(result.solution.unassigned), tuple(rates))


def table_of_times(plans: Sequence[Timed]) -> list[str]:
    """Return the Markdown table of Table 1, a line for each time and number of threads."""
    header = ["s", "threads", "start", "plans", "least", "median", "most",
              f"median to {REFERENCE}, %", "longest, s"]
    rows = []
    for seconds, threads in sorted({(plan.seconds, plan.threads) for plan in plans}):
        group = [plan for plan in plans if (plan.seconds, plan.threads) == (seconds, threads)]
        costs = [plan.cost for plan in group]
        median = statistics.median(costs)
        rows.append([f"{seconds:g}", str(threads), "/".join(sorted({plan.start for plan in group})),
                     str(len(group)), f"{min(costs):.2f}", f"{median:.2f}", f"{max(costs):.2f}",
                     f"{100 * (median / REFERENCE - 1):z.2f}",
                     f"{max(plan.wall_s for plan in group):.3f}"])
    return _markdown(header, rows)


def table_of_fleets(plans: Sequence[FleetPlan]) -> list[str]:
    """Return the Markdown table of mean costs, a line for each number of customers and fleet."""
    hours = sorted({plan.hours for plan in plans})
    header = ["customers", "capacity", *(f"{limit:g} h" for limit in hours), "left out",
              "load, %", "longest, s"]
    rows = []
    for size, fleet in dict.fromkeys((plan.size, plan.fleet) for plan in plans):
        group = [plan for plan in plans if (plan.size, plan.fleet) == (size, fleet)]
        means = [statistics.fmean(plan.cost for plan in group if plan.hours == limit)
                 for limit in hours]
        loads = [rate for plan in group for rate in plan.load_rates]
        rows.append([str(size), fleet, *(f"{mean:.1f}" for mean in means),
                     str(sum(plan.unassigned for plan in group)),
                     f"{100 * statistics.fmean(loads):.1f}",
                     f"{max(plan.wall_s for plan in group):.3f}"])
    return _markdown(header, rows)


def _markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    lines = [header, ["---:"] * len(header), *rows]
    return [f"| {' | '.join(cells)} |" for cells in lines]


def main(
    limits: Annotated[str, typer.Option(help="seconds, comma-separated")] = "0.1,0.3,1,2,10",
    seeds: Annotated[int, typer.Option(help="plans for each limit", min=1)] = 3,
    threads: Annotated[str, typer.Option(help="of the search, comma-separated")] = "1,2",
    instances: Annotated[int, typer.Option(help="of each size, for the fleets", min=1)] = 2,
    fleet_seconds: Annotated[float, typer.Option(help="for each plan of a fleet")] = 0.9,
) -> None:
    """Print both tables in Markdown."""
    planner = load_planner(Settings().weights_dir, [DEFAULT_POLICY])
    planner.warm()
    typer.echo("\n".join(table_of_times([
        plan_example(planner, float(limit), int(count), seed)
        for limit in limits.split(",") for count in threads.split(",")
        for seed in range(1, seeds + 1)])))
    fleets = list(plan_fleets(planner, SIZES, instances, HOURS, fleet_seconds))
    typer.echo("\n".join(["", *table_of_fleets(fleets)]))


if __name__ == "__main__":
    typer.run(main)
