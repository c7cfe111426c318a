"""One large job planned by regions, by one worker and by several.

    python -m benchmarks.quality.regions --customers 10000 --seconds 120 --workers 1 2
    python -m benchmarks.quality.regions --customers 3000 --seconds 20 --workers 2 --kills 30

Workers are processes with one slot and one thread each, on a PostgreSQL server that is started for
it. Prints the cost over the time that the job has run, and how much sooner more workers have found
a plan as cheap as that which one found last. With kills a worker, the one that watches over the job
or another, is killed at random moments and started again, jobs being kept coming: whatever happens,
each job must end with everybody served once and its cost must never rise. Exits with 1 otherwise.
"""

import argparse
import random
import statistics
import sys
import tempfile
import time
from collections import Counter
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.load.crashes import Service
from benchmarks.postgres import running_postgres

POLLING = 0.25

TELLING = 5.0
"""Seconds between two costs that are printed."""

CAPACITY, PER_ROUTE = 200, 12
"""Of a truck, and how many customers fill it."""

Curve = list[tuple[float, float]]
"""Seconds since the job began, and the cost by then."""


def request_of(customers: int, seconds: float, seed: int) -> dict[str, Any]:
    """Return a request for customers in towns around one depot."""
    rng = np.random.default_rng(seed)
    side = 1000.0 * np.sqrt(customers)
    towns = rng.uniform(0, side, (max(1, customers // 200), 2))
    in_town = (towns[rng.integers(len(towns), size=customers)]
               + rng.normal(0, side / 30, (customers, 2)))
    in_country = rng.uniform(0, side, (customers, 2))
    places = np.where(rng.random((customers, 1)) < 0.5, in_town, in_country)
    demand = rng.integers(1, 2 * CAPACITY // PER_ROUTE, customers)
    return {
        "depots": [{"id": "depot", "location": [side / 2, side / 2]}],
        "customers": [{"id": str(number), "location": [round(x), round(y)], "demand": [int(amount)]}
                      for number, ((x, y), amount) in enumerate(zip(places, demand, strict=True))],
        "fleet": [{"id": "truck", "count": customers // PER_ROUTE * 2, "capacity": [CAPACITY],
                   "costs": {"per_km": 1, "per_hour": 0, "fixed": 0}}],
        "options": {"time_limit": seconds, "seed": seed},
    }


class Job:
    """A job that is followed."""

    def __init__(self, service: Service, request: dict[str, Any]) -> None:
        self._service = service
        self._customers = len(request["customers"])
        reply = service.client.post("/jobs", json=request)
        reply.raise_for_status()
        self.id = str(reply.json()["id"])
        self.began = time.monotonic()
        self.curve: Curve = []
        self.faults: Counter[str] = Counter()
        self.state = "queued"

    def look(self) -> None:
        """See how the job stands. In place."""
        jobs = self._service.client.get("/jobs", params={"limit": 100}).json()["jobs"]
        job = next(each for each in jobs if each["id"] == self.id)
        if self.state == "queued" and job["state"] != "queued" and not self.curve:
            self.began = time.monotonic()
        self.state = job["state"]
        cost = job["cost"]
        if cost is not None and (not self.curve or cost != self.curve[-1][1]):
            self.faults["cost rose"] += bool(self.curve) and cost > self.curve[-1][1]
            self.curve.append((time.monotonic() - self.began, cost))

    @property
    def is_over(self) -> bool:
        """Tell whether it has ended."""
        return self.state not in ("queued", "running")

    def finish(self) -> None:
        """Count what is wrong with the plan. In place."""
        job = self._service.client.get(f"/jobs/{self.id}").json()
        plan = job["result"]
        self.faults["not done"] += job["state"] != "done"
        served = Counter(name for route in plan["routes"] for trip in route["trips"]
                         for name in _served(trip))
        served.update(entry["id"] for entry in plan["unassigned"])
        self.faults["not served once"] += (len(served) != self._customers
                                           or set(served.values()) != {1})
        self.faults["dearer than told"] += plan["cost"]["total"] > self.curve[-1][1] + 0.01


def _served(trip: dict[str, Any]) -> list[str]:
    names = [stop["id"] for stop in trip["stops"] if stop["kind"] == "customer"]
    return names + [visit["id"] for sortie in trip["sorties"] for visit in sortie["customers"]]


def main() -> None:
    """Run jobs and print what came of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--customers", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--region-customers", type=int, default=2500)
    parser.add_argument("--region-seconds", type=float, default=10.0)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    curves, faults = {}, Counter[str]()
    for workers in arguments.workers:
        with ExitStack() as stack:
            services = _services(stack, arguments, workers)
            jobs = (_killed if arguments.kills else _planned)(services, arguments)
        for job in jobs:
            faults += job.faults
        curves[workers] = jobs[0].curve
        print(f"{workers} workers: {len(jobs)} jobs", flush=True)
        for second, cost in _thinned(jobs[0].curve):
            print(f"{second:8.1f} s {cost:14.2f}", flush=True)
    print(dict(faults))
    if not arguments.kills and len(curves) > 1:
        print(_compared(curves))
    if any(faults.values()):
        sys.exit(1)


def _services(stack: ExitStack, arguments: argparse.Namespace, workers: int) -> list[Service]:
    """Start workers, of which the first answers requests too."""
    url = stack.enter_context(running_postgres())
    services = []
    for number in range(workers):
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        service = Service(folder, url, {
            "TANDEM_ROLE": "worker" if number else "all", "TANDEM_WORKER_ID": f"worker-{number}",
            "TANDEM_JOB_SLOTS": "1", "TANDEM_REGION_FROM": "2",
            "TANDEM_REGION_CUSTOMERS": str(arguments.region_customers),
            "TANDEM_REGION_SECONDS": str(arguments.region_seconds),
            "TANDEM_DRAIN_SECONDS": "0"})
        stack.callback(service.kill)
        service.start()
        services.append(service)
    return services


def _planned(services: list[Service], arguments: argparse.Namespace) -> list[Job]:
    """Return a job after its end."""
    job = Job(services[0], request_of(arguments.customers, arguments.seconds, arguments.seed))
    while not job.is_over:
        time.sleep(POLLING)
        job.look()
    job.finish()
    return [job]


def _killed(services: list[Service], arguments: argparse.Namespace) -> list[Job]:
    """Return jobs after their end, during which workers were killed."""
    rng, jobs, kills = random.Random(arguments.seed), list[Job](), 0
    while kills < arguments.kills:
        job = Job(services[0], request_of(arguments.customers, arguments.seconds, len(jobs)))
        jobs.append(job)
        kill_at = time.monotonic() + rng.uniform(1.0, 8.0)
        while not job.is_over:
            time.sleep(POLLING)
            job.look()
            if time.monotonic() > kill_at and kills < arguments.kills and not job.is_over:
                service = rng.choice(services)
                service.kill()
                service.start()
                kills += 1
                kill_at = time.monotonic() + rng.uniform(1.0, 8.0)
        job.finish()
    return jobs


def _thinned(curve: Curve) -> Curve:
    """Return a cost each few seconds, and the last."""
    kept, latest = [], -TELLING
    for second, cost in curve[:-1]:
        if second >= latest + TELLING:
            kept.append((second, cost))
            latest = second
    return [*kept, curve[-1]]


def _compared(curves: dict[int, Curve]) -> str:
    """Return how much sooner more workers came as far as the fewest."""
    fewest = min(curves)
    lines = []
    for workers, curve in sorted(curves.items()):
        if workers == fewest:
            continue
        for since, first in (("the job began", False), ("its first plan", True)):
            factors = _factors(curves[fewest], curve, first)
            told = ", ".join(f"{factor:.2f}" for factor in factors)
            lines.append(f"{workers} workers, since {since}: {told} times as fast as {fewest} to "
                         f"equal cost (median {statistics.median(factors or [0.0]):.2f})")
    return "\n".join(lines)


def _factors(slow: Curve, fast: Curve, from_first_plan: bool) -> list[float]:
    """Return how many times sooner one of two found plans as cheap as some of the other's."""
    begun = (slow[0][0], fast[0][0]) if from_first_plan else (0.0, 0.0)
    factors = []
    for share in (0.5, 0.7, 0.85, 1.0):
        second, cost = slow[int(share * (len(slow) - 1))]
        sooner = next((each for each, found in fast if found <= cost), None)
        if sooner is not None and sooner > begun[1]:
            factors.append((second - begun[0]) / (sooner - begun[1]))
    return factors


if __name__ == "__main__":
    main()
