"""Plans the study's tasks, in several processes, each with a planner of its own."""

import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from datetime import UTC, datetime
from functools import cache
from multiprocessing import get_context
from typing import NamedTuple

from pydantic_core import to_json

from app.plans.replies import plan_reply
from app.requests.conversion.problem import to_problem
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.peers.versus import machine
from benchmarks.study.cases import request_of
from benchmarks.study.tasks import GREEDY, NOBODY, NUM_SAMPLES, POLICIES, Planned, Task, TripRow
from model.planner import Planner, PlanOptions, PlanResult, load_planner
from model.problem import MM_PER_KM, MS_PER_HOUR, Problem
from model.solution import Solution

PATIENCE = 3600.0
"""Time limit of a plan that ends after its turns."""


class Done(NamedTuple):
    """A planned task."""

    row: Planned
    trips: list[TripRow]
    reply: bytes | None  # of `POST /plan`, for plans of Table 1 that can be made again


def plan_all(tasks: Sequence[Task], workers: int) -> Iterator[Done]:
    """Yield the plan of each task, in order.

    Raises
    ------
    PlanCheckError
        If a plan breaks a rule.
    """
    if workers == 1:
        yield from map(plan_one, tasks)
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        yield from pool.map(plan_one, tasks)


@cache
def planner() -> Planner:
    """Return this process's planner."""
    return load_planner(Settings().weights_dir, POLICIES)


def plan_one(task: Task) -> Done:
    """Plan a task; one thread searches."""
    ready = planner()
    problem = to_problem(request_of(task))
    began, began_cpu = time.perf_counter(), time.process_time()
    result = _planned(ready, problem, task)
    wall, cpu = time.perf_counter() - began, time.process_time() - began_cpu
    reply = None
    if task.section == "table1":
        options = PlanOptions(DEFAULT_POLICY, seed=task.seed)
        reply = to_json(plan_reply(problem, options, result))
    return Done(_row(task, result, wall, cpu), _trips(task, problem, result), reply)


def _planned(ready: Planner, problem: Problem, task: Task) -> PlanResult:
    options = PlanOptions(
        task.policy if task.policy in POLICIES else DEFAULT_POLICY,
        "greedy" if task.decoding == GREEDY else "sample", NUM_SAMPLES, seed=task.seed,
        time_limit=PATIENCE, search_iterations=task.turns)
    if not task.policy:
        return ready.plan(problem, options)
    if task.policy == NOBODY:
        everybody = tuple(range(problem.num_depots, problem.num_nodes))
        return ready.plan(problem, options, start=Solution((), everybody))
    # A search of problems with single drones would begin without the policy.
    alone = PlanOptions(options.policy, options.decoding, NUM_SAMPLES, seed=task.seed,
                        time_limit=0.0)
    decoded = ready.plan(problem, alone)
    return ready.plan(problem, options, start=decoded.solution) if task.turns else decoded


def _row(task: Task, result: PlanResult, wall: float, cpu: float) -> Planned:
    evaluation = result.evaluation
    trips = [trip for route in evaluation.routes for trip in route.trips]
    sorties = [sortie for trip in trips for sortie in trip.sorties]
    rates = [trip.load_rate for trip in trips] or [0.0]
    cost = evaluation.cost
    return Planned(
        **vars(task), cost=round(cost.total, 4), fixed=cost.fixed,
        transport=round(cost.distance + cost.time, 4), lateness=round(cost.lateness, 4),
        unassigned=len(result.solution.unassigned), vehicles=len(evaluation.routes),
        trips=len(trips), sorties=len(sorties),
        driven=sum(trip.distance for trip in trips) / MM_PER_KM,
        flown=sum(sortie.distance for sortie in sorties) / MM_PER_KM,
        working_hours=round(sum(route.working_duration for route in evaluation.routes)
                            / MS_PER_HOUR, 4),
        least_load_rate=round(min(rates), 5), mean_load_rate=round(sum(rates) / len(rates), 5),
        wall_s=round(wall, 3), cpu_s=round(cpu, 3),
        date=datetime.now(UTC).date().isoformat(), machine=machine())


def _trips(task: Task, problem: Problem, result: PlanResult) -> list[TripRow]:
    """Return the trips of a plan for Tables 3 to 5, those of large trucks first."""
    if task.section != "fleets":
        return []
    pairs = zip(result.solution.routes, result.evaluation.routes, strict=True)
    ordered = sorted(pairs, key=lambda pair: (
        -problem.vehicle_types[pair[0].vehicle_type].capacity[0], -(pair[1].working_rate or 0.0)))
    return [
        TripRow(task.customers, task.case, task.fleet, task.seed, vehicle, number,
                problem.vehicle_types[route.vehicle_type].capacity[0] / 1000,
                trip.load[0] / 1000, round(trip.load_rate, 5), trip.distance / MM_PER_KM,
                sum(other.distance for other in metrics.trips) / MM_PER_KM,
                round(metrics.working_rate or 0.0, 5))
        for vehicle, (route, metrics) in enumerate(ordered, 1)
        for number, trip in enumerate(metrics.trips, 1)]
