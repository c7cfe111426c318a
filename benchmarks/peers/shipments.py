"""Pickup and delivery with windows beside other solvers: vehicles first, then length.

`python -m benchmarks.peers.shipments data --seconds 1`: the sets of `benchmarks.quality.shipments`,
one thread and the processor's time for each; vrp-cli counts whole seconds of the clock on the wall,
so it isn't asked for less. All plans are timed and judged by Tandem's checker. A vehicle costs
twice what the best known plan is long, so that one fewer is worth any detour. What plans cost so is
compared where all solvers serve everybody; ways, where a solver needs no more vehicles than are
best known.
"""

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from statistics import fmean
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks.clock import count_processor_time
from benchmarks.peers.answers import timed_plan
from benchmarks.peers.vrpcli import plan_shipments
from benchmarks.quality import shipments
from benchmarks.quality.shipments import SETS, UNIT, Instance, read, to_problem
from benchmarks.results import gap_percent
from benchmarks.rows import appended
from model.judge.check import check

Plan = list[list[int]]
"""Routes as nodes in order, without the depot."""


@dataclass(frozen=True)
class Run:
    """What a solver made of an instance; no number where it has no plan for everybody."""

    solver: str
    instance: str
    n: int
    seconds: float
    vehicles_above: float  # the best known plan's
    gap_percent: float  # of the length, where the number of vehicles is the best known
    cost_gap_percent: float  # of vehicles and length together


def by_pyvrp(instance: Instance, seconds: float) -> Plan:
    """Plan by PyVRP's shipments."""
    pyvrp: Any = import_module("pyvrp")
    stop: Any = import_module("pyvrp.stop")
    times = instance.stops * UNIT
    pairs = [(node, int(instance.stops[node, 5])) for node in range(1, len(times))
             if instance.stops[node, 0] > 0]
    parcels = [pyvrp.Shipment(first, last, *times[first, 1:4].tolist(), *times[last, 1:4].tolist(),
                              [int(instance.stops[first, 0])]) for first, last in pairs]
    vehicle = pyvrp.VehicleType(
        instance.vehicles, [instance.capacity], start_depot=0, end_depot=0,
        fixed_cost=_fixed(instance), tw_early=0, tw_late=int(times[0, 2]))
    locations = [pyvrp.Location(float(x), float(y)) for x, y in instance.places]
    data = pyvrp.ProblemData(locations, [], [pyvrp.Depot(0)], [vehicle], [instance.legs],
                             [instance.legs], [], parcels)
    found = pyvrp.solve(data, stop.MaxRuntime(seconds), seed=0, collect_stats=False, display=False)
    if not found.is_feasible():
        return []
    return [[pairs[visit.idx][0 if visit.is_pickup() else 1] for visit in route
             if visit.is_shipment()] for route in found.best.routes()]


def by_ortools(instance: Instance, seconds: float) -> Plan:
    """Plan by OR-Tools' guided local search from parallel insertion."""
    pywrapcp: Any = import_module("ortools.constraint_solver.pywrapcp")
    enums: Any = import_module("ortools.constraint_solver.routing_enums_pb2")
    began = time.perf_counter()
    manager = pywrapcp.RoutingIndexManager(len(instance.stops), instance.vehicles, 0)
    routing = pywrapcp.RoutingModel(manager)
    _add_rules(routing, manager, instance)
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = enums.FirstSolutionStrategy.PARALLEL_CHEAPEST_INSERTION
    parameters.local_search_metaheuristic = enums.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    # Its own limit is of the clock on the wall.
    parameters.time_limit.FromMilliseconds(round(60_000 * seconds))
    routing.AddSearchMonitor(routing.solver().CustomLimit(
        lambda: time.perf_counter() > began + seconds))
    found = routing.SolveWithParameters(parameters)
    if found is None:
        return []
    return [_read_route(routing, manager, found, number) for number in range(instance.vehicles)]


def _add_rules(routing: Any, manager: Any, instance: Instance) -> None:
    """Add costs, loads, windows and pairs to a model. In place."""
    times, last = instance.stops * UNIT, int(instance.stops[0, 2]) * UNIT
    routing.SetArcCostEvaluatorOfAllVehicles(routing.RegisterTransitMatrix(instance.legs.tolist()))
    routing.SetFixedCostOfAllVehicles(_fixed(instance))
    load = routing.RegisterUnaryTransitVector(instance.stops[:, 0].tolist())
    routing.AddDimension(load, 0, instance.capacity, True, "load")
    takes = routing.RegisterTransitMatrix((instance.legs + times[:, 3:4]).tolist())
    routing.AddDimension(takes, last, last, False, "time")
    clock, solver = routing.GetDimensionOrDie("time"), routing.solver()
    for node in range(1, len(times)):
        start = clock.CumulVar(manager.NodeToIndex(node))
        start.SetRange(*times[node, 1:3].tolist())
        if instance.stops[node, 0] > 0:
            pickup, delivery = map(manager.NodeToIndex, (node, int(instance.stops[node, 5])))
            routing.AddPickupAndDelivery(pickup, delivery)
            solver.Add(routing.VehicleVar(pickup) == routing.VehicleVar(delivery))
            solver.Add(start <= clock.CumulVar(delivery))


def _read_route(routing: Any, manager: Any, found: Any, number: int) -> list[int]:
    route, index = [], found.Value(routing.NextVar(routing.Start(number)))
    while not routing.IsEnd(index):
        route.append(manager.IndexToNode(index))
        index = found.Value(routing.NextVar(index))
    return route


def by_vrpcli(instance: Instance, seconds: float) -> Plan:
    """Plan by vrp-cli, whose limit is whole seconds of the clock on the wall."""
    times = instance.stops * np.array([1, UNIT, UNIT, UNIT, 1, 1])
    return plan_shipments(times, instance.legs, instance.capacity, instance.vehicles,
                          _fixed(instance), round(seconds))


def _fixed(instance: Instance) -> int:
    return 2 * round(instance.best_known) * UNIT


PEERS: dict[str, Callable[[Instance, float], Plan]] = {
    "pyvrp": by_pyvrp, "ortools": by_ortools, "vrp-cli": by_vrpcli}


def by_peer(name: str, instance: Instance, seconds: float) -> Run:
    """Plan by a peer and judge the plan.

    Raises
    ------
    RuntimeError
        If it breaks a rule.
    """
    problem = to_problem(instance)
    plan = timed_plan(problem, [(0, [route]) for route in PEERS[name](instance, seconds)])
    found = check(problem, plan)
    if found.violations:
        raise RuntimeError(f"{name}, {instance.name}: {found.violations[0].message}")
    return _run(name, instance, seconds, len(plan.routes), found.cost.distance,
                left_out=len(plan.unassigned))


def by_tandem(instance: Instance, seconds: float) -> Run:
    """Plan by Tandem; its plan is judged."""
    found = shipments.run(instance, seconds, 0)
    return _run("tandem", instance, seconds, found.vehicles, found.length, found.left_out)


def _run(solver: str, instance: Instance, seconds: float, vehicles: int, length: float,
         left_out: int) -> Run:
    above = math.nan if left_out else vehicles - instance.best_vehicles
    gap = gap_percent(length, instance.best_known) if above == 0 else math.nan
    best = instance.best_known + instance.best_vehicles * _fixed(instance) / UNIT
    cost = math.nan if left_out else length + vehicles * _fixed(instance) / UNIT
    return Run(solver, instance.name, instance.num_customers, seconds, above, gap,
               gap_percent(cost, best))


def summary(runs: list[Run]) -> Iterator[str]:
    """Yield a row of a table for each time and solver: plans, vehicles above, best numbers, gaps.

    Gaps of the way are where the solver has the best number, those of the cost where all solvers
    have plans.
    """
    for seconds, solver in dict.fromkeys((run.seconds, run.solver) for run in runs):
        own = [run for run in runs if (run.seconds, run.solver) == (seconds, solver)]
        lacking = {run.instance for run in runs
                   if run.seconds == seconds and math.isnan(run.vehicles_above)}
        whole = [run.vehicles_above for run in own if not math.isnan(run.vehicles_above)]
        gaps = [run.gap_percent for run in own if not math.isnan(run.gap_percent)]
        costs = [run.cost_gap_percent for run in own if run.instance not in lacking]
        yield (f"| {seconds:g} | {solver} | {len(whole)} of {len(own)} | {_mean(whole)} | "
               f"{len(gaps)} | {_mean(gaps)} | {_mean(costs)} of {len(costs)} |")


def _mean(values: list[float]) -> str:
    return f"{fmean(values) if values else math.nan:.2f}"


def main(
    data: Path,
    out: Annotated[Path | None, typer.Option(help="CSV to add rows to.")] = None,
    seconds: Annotated[float, typer.Option(help="Processor time for each plan.")] = 1.0,
    least: Annotated[int, typer.Option(help="Fewest ends of shipments.")] = 0,
    most: Annotated[int, typer.Option(help="Most ends of shipments.")] = 10**9,
    every: Annotated[int, typer.Option(help="Take one of so many instances.")] = 1,
) -> None:
    """Plan the instances of both sets by all solvers."""
    count_processor_time()
    instances = [read(path) for name in SETS for path in sorted((data / name).glob("*.txt"))]
    fitting = [each for each in instances if least <= each.num_customers <= most]
    runs = (run for instance in fitting[::every]
            for run in (by_tandem(instance, seconds),
                        *(by_peer(name, instance, seconds) for name in PEERS
                          if name != "vrp-cli" or seconds >= 1)))
    done = []
    for run in runs if out is None else appended(out, Run, runs):
        print(run, flush=True)
        done.append(run)
    print("\n".join(summary(done)))


if __name__ == "__main__":
    typer.run(main)
