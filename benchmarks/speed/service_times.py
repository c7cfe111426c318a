"""What planning by regions takes besides its search, as `benchmarks.speed.queueing` needs it.

    python -m benchmarks.speed.service_times --output runs/service_times.json

Processor seconds. Those of the database are PostgreSQL's own, while two workers wait and while they
plan a job by regions; a worker's and a keeper's are of what they do with problems of several sizes,
made by `examples.many` and swept, not searched.
"""

import argparse
import json
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from os import sysconf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import numpy as np
from pydantic_core import to_json

from app.plans.replies import plan_reply
from app.plans.service import plan_options
from app.records.jobs.incumbent import Incumbent
from app.records.jobs.region_task import ERRANDS, Errand
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from benchmarks.load.crashes import Service
from examples.many import many_customers, swept
from benchmarks.postgres import running_postgres
from benchmarks.quality.regions import Job, request_of
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.planner import Elapsed, PlanOptions, PlanResult
from model.problem import Problem
from model.search.regions.dividing import divide
from model.search.regions.part import part_of
from model.solution import Solution

Result = TypeVar("Result")

REGION = 2500
"""Customers of a region."""

WORKERS, WAITING = 2, 20.0
"""Workers whose database is watched, and for how many seconds while they wait."""

CUSTOMERS, SECONDS, REGION_CUSTOMERS, REGION_SECONDS = 1200, 60.0, 150, 2.0
"""Of the job and the regions that are planned while the database is watched."""

TICKS = sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class JobTimes:
    """Processor seconds for a job of some size."""

    customers: int
    convert: float  # once in each worker that takes part
    divide: float  # the keeper's, each round
    take: float  # a worker's, each region
    merge: float  # the keeper's, each region
    reply: float  # the keeper's, each time it writes down a better plan


@dataclass(frozen=True)
class DatabaseTimes:
    """Processor seconds of the database."""

    waiting: float  # for each second of a worker that waits
    region: float  # for each region of `REGION_SECONDS`, besides


def main() -> None:
    """Measure and write down."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--customers", type=int, nargs="+", default=[20_000, 100_000])
    parser.add_argument("--output", type=Path, default=Path("runs/service_times.json"))
    arguments = parser.parse_args()
    jobs = [job_times(number) for number in arguments.customers]
    database = database_times()
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    told = {"jobs": [asdict(job) for job in jobs], "database": asdict(database)}
    arguments.output.write_text(json.dumps(told, indent=1))
    print(json.dumps(told, indent=1))


def job_times(customers: int) -> JobTimes:
    """Measure what a job of some size takes."""
    request = many_customers(customers)
    body = to_json(request)
    problem, convert = _timed(lambda: to_problem(read_request(body, None)))
    plan = Solution(tuple(
        schedule(problem, RouteDecision(0, vehicle, (
            TripDecision((0, *(index + 1 for index in some), 0), (), None),)))
        for vehicle, some in enumerate(swept(request))))
    best = Incumbent(problem, plan)
    regions, dividing = _timed(lambda: divide(problem, best.plan, round(customers / REGION),
                                              np.random.default_rng(0)))
    errands, writing = _timed(lambda: [ERRANDS.dump_json(Errand(region, 10.0, 0))
                                       for region in regions])
    region, reading = _timed(lambda: ERRANDS.validate_json(errands[0]).region)
    _, cutting = _timed(lambda: part_of(problem, region))
    # As dear as before: judged whole, and not taken.
    _, merging = _timed(lambda: best.merge(region, region.plan))
    options = plan_options(read_request(body, None).options)
    _, replying = _timed(lambda: _reply(problem, best, options))
    return JobTimes(customers, convert, dividing + writing, reading + cutting, merging + reading,
                    replying)


def _reply(problem: Problem, best: Incumbent, options: PlanOptions) -> bytes:
    cost = best.evaluation.cost.total
    result = PlanResult(best.plan, best.evaluation, "policy", cost, cost, 0, 1, True,
                        Elapsed(decode=0.0, search=0.0, check=0.0))
    return to_json(plan_reply(problem, options, result))


def _timed(work: Callable[[], Result]) -> tuple[Result, float]:
    began = time.process_time()
    result = work()
    return result, time.process_time() - began


def database_times() -> DatabaseTimes:
    """Measure what workers have the database do."""
    with ExitStack() as stack:
        url = stack.enter_context(running_postgres())
        services = [_service(stack, url, number) for number in range(WORKERS)]
        before = _postgres_seconds(url)
        time.sleep(WAITING)
        waiting = (_postgres_seconds(url) - before) / WAITING / WORKERS
        job = Job(services[0], request_of(CUSTOMERS, SECONDS, 0))
        began, before = time.monotonic(), _postgres_seconds(url)
        while not job.is_over:
            time.sleep(1.0)
            job.look()
        took, used = time.monotonic() - began, _postgres_seconds(url) - before
    regions = WORKERS * took / REGION_SECONDS
    return DatabaseTimes(waiting, max(0.0, used - waiting * WORKERS * took) / regions)


def _service(stack: ExitStack, url: str, number: int) -> Service:
    settings: dict[str, Any] = {
        "TANDEM_ROLE": "worker" if number else "all", "TANDEM_WORKER_ID": f"worker-{number}",
        "TANDEM_JOB_SLOTS": "1", "TANDEM_REGION_FROM": "2",
        "TANDEM_REGION_CUSTOMERS": str(REGION_CUSTOMERS),
        "TANDEM_REGION_SECONDS": str(REGION_SECONDS), "TANDEM_DRAIN_SECONDS": "0"}
    service = Service(Path(stack.enter_context(TemporaryDirectory())), url, settings)
    stack.callback(service.kill)
    service.start()
    return service


def _postgres_seconds(url: str) -> float:
    """Return what the server on the URL's port has used so far, with all that it started."""
    port, stats = url.rsplit(":", 1)[1].split("/")[0], {}
    for process in Path("/proc").iterdir():
        if process.name.isdigit():
            try:
                words = (process / "stat").read_text().rsplit(")", 1)[1].split()
                stats[int(process.name)] = (int(words[1]), sum(map(int, words[11:15])),
                                            (process / "cmdline").read_text())
            except OSError:  # it has ended meanwhile
                continue
    server = next(number for number, (_, _, line) in stats.items()
                  if "postgres" in line and f"-p\0{port}" in line)
    return sum(ticks for number, (parent, ticks, _) in stats.items()
               if server in (number, parent)) / TICKS


if __name__ == "__main__":
    main()
