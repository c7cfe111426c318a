"""A planner whose plans get better while time passes, and what is asked of it."""

import threading
import time
from collections.abc import Mapping
from functools import partial
from typing import Any

import httpx

from app.records.jobs.running import RegionTerms
from app.schemas.limits import DEFAULT_POLICY
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.planner import ALONE, Elapsed, Listener, PlanCheckError, PlanOptions, PlanResult
from model.problem import Problem
from model.search.improve import Progress
from model.solution import Solution
from tests.conftest import eventually

PAUSE = 0.02
"""Seconds between two improvements at least."""

BROKEN_SEED, RAISING_SEED = 666, 667

NUM_CUSTOMERS = 10

WHOLE = RegionTerms(10 * NUM_CUSTOMERS, NUM_CUSTOMERS, 1.0)
"""By which no job is planned by regions."""


def request_of(seconds: float, seed: int = 0, **options: Any) -> dict[str, Any]:
    """Return a request for one truck and customers along a street, 2 km each there and back."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": f"c{number}", "location": [number, 0], "demand": [1]}
                      for number in range(1, NUM_CUSTOMERS + 1)],
        "fleet": [{"id": "truck", "count": 1, "capacity": [NUM_CUSTOMERS]}],
        "unassigned_cost": 100,
        "options": {"time_limit": seconds, "seed": seed, **options},
    }


class SteppingPlanner:
    """Serves the more customers, from the nearest on, the more of its time is over.

    Parameters
    ----------
    comes_to
        Share of its work after which it gets no further; below 1 it ends only when it is stopped.
    """

    policies = (DEFAULT_POLICY,)

    def __init__(self, comes_to: float = 1.0) -> None:
        self._comes_to = comes_to
        self.cooled = 0.0  # how far the last search was cooled down when it began

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        self.cooled = options.cooled
        if options.seed == RAISING_SEED:
            raise ZeroDivisionError
        began = time.perf_counter() if received_at is None else received_at
        fewest = 0 if start is None else problem.num_customers - len(start.unassigned)
        plan = partial_plan(problem, fewest) if start is None else start
        first_cost, turns, reached = cost_of(problem, plan), 0, -1.0
        listener.on_progress(Progress(first_cost, 0, lambda: plan))
        while not listener.should_stop() and (share := self._share(options, began, turns)) < 1:
            threading.Event().wait(PAUSE)
            if share != reached:
                turns, reached = turns + 1, share
                served = round(fewest + share * (problem.num_customers - fewest))
                plan = partial_plan(problem, served)
            # Again, as whoever read a plan for long hears of none for a while.
            listener.on_progress(Progress(cost_of(problem, plan), turns, partial(self._same, plan)))
        if self._share(options, began, turns) >= 1:
            plan = partial_plan(problem, problem.num_customers)
        if options.seed == BROKEN_SEED:
            raise PlanCheckError("routes[0]: too late")
        evaluation = check(problem, plan)
        return PlanResult(plan, evaluation, "given" if start else "policy", first_cost,
                          evaluation.cost.total, turns, options.threads, False,
                          Elapsed(0.0, time.perf_counter() - began, 0.0))

    def _share(self, options: PlanOptions, began: float, turns: int) -> float:
        return min(self._comes_to, share_over(options, began, turns))

    @staticmethod
    def _same(plan: Solution) -> Solution:
        return plan


def share_over(options: PlanOptions, began: float, turns: int) -> float:
    """Return how much of the time or the iterations is over."""
    if options.time_limit <= 0:
        return 1.0
    share = (time.perf_counter() - began) / options.time_limit
    if options.search_iterations is not None:
        share = max(share, turns / max(1, options.search_iterations))
    return share


def partial_plan(problem: Problem, served: int) -> Solution:
    """Return a plan for the first customers, as many as fit, by one truck."""
    capacity = problem.vehicle_types[0].capacity[0]
    served = min(served, capacity // problem.customers[0].demand[0])
    nodes = range(problem.num_depots, problem.num_nodes)
    if not served:
        return Solution((), tuple(nodes))
    trip = TripDecision((0, *nodes[:served], 0))
    return Solution((schedule(problem, RouteDecision(0, 0, (trip,))),), tuple(nodes[served:]))


def cost_of(problem: Problem, plan: Solution) -> float:
    """Return what a plan costs."""
    return check(problem, plan).cost.total


def submit(client: httpx.Client, request: Mapping[str, Any], path: str = "/jobs",
           **more: Any) -> str:
    """Submit a job and return its id."""
    reply = client.post(path, json=request, **more)
    assert reply.status_code == 202, reply.text
    return str(reply.json()["id"])


def read(client: httpx.Client, job: str) -> dict[str, Any]:
    """Return a job."""
    reply = client.get(f"/jobs/{job}")
    assert reply.status_code == 200, reply.text
    return dict(reply.json())


def ended(client: httpx.Client, job: str) -> dict[str, Any]:
    """Wait for a job's end and return it."""
    return dict(eventually(lambda: (seen := read(client, job))["state"]
                           not in ("queued", "running") and seen))
