"""An office in which jobs are planned by regions, step by step, and a planner for it."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import pytest
from pydantic_core import from_json, to_json
from sqlalchemy import Engine

from app.records.jobs.asked import TaskMaker
from app.records.jobs.divided import DividedWork
from app.records.jobs.planning import PlanWork
from app.records.jobs.reading import JobReader
from app.records.jobs.rows import JobRow, NewJob
from app.records.jobs.running import RegionTerms, Returning
from app.records.jobs.slices import Slice, Stopping
from app.records.jobs.store import JobStore
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.planner import ALONE, Elapsed, Listener, PlanOptions, PlanResult
from model.problem import Problem
from model.search.improve import Progress
from model.solution import Solution
from tests.app.records.jobs.elsewhere import planned_by
from tests.app.records.jobs.stepping import request_of

NUM_CUSTOMERS = 12
TERMS = RegionTerms(NUM_CUSTOMERS, 4, 0.5)


class PoolingPlanner:
    """Sends a truck to each customer at first, then fewer by one each time."""

    policies = (DEFAULT_POLICY,)

    def __init__(self) -> None:
        self.sizes: list[int] = []  # of the regions planned
        self.cooled: list[float] = []  # how far each search was cooled down when it began
        self.fails = False

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        nodes = list(range(problem.num_depots, problem.num_nodes))
        self.cooled.append(options.cooled)
        groups = [[node] for node in nodes]
        if start is not None:
            if self.fails:
                raise ZeroDivisionError
            self.sizes.append(len(nodes))
            groups = [[stop.node for stop in route.trips[0].stops[1:-1]] for route in start.routes]
            groups[:2] = [sorted(node for group in groups[:2] for node in group)]
        plan = Solution(tuple(
            schedule(problem, RouteDecision(0, number, (TripDecision((0, *group, 0)),)))
            for number, group in enumerate(groups)))
        evaluation = check(problem, plan)
        listener.on_progress(Progress(evaluation.cost.total, 1, lambda: plan))
        return PlanResult(plan, evaluation, "given" if start else "insertion",
                          evaluation.cost.total, evaluation.cost.total, 1, options.threads, False,
                          Elapsed(0.0, 0.0, 0.0))


@dataclass
class Office:
    """A store, the queue of plans, and processes that work on both."""

    engine: Engine
    store: JobStore
    settings: Settings
    planner: PoolingPlanner = field(default_factory=PoolingPlanner)
    queue: list[str] = field(default_factory=list)
    aside: list[str] = field(default_factory=list)
    told: list[float] = field(default_factory=list)
    now: float = 0.0

    def job(self, seconds: float = 3.0, customers: int = NUM_CUSTOMERS,
            relations: Sequence[Any] = (), **options: Any) -> str:
        """Add a job and return its id."""
        request = request_of(seconds, **options) | {"relations": relations}
        request["customers"] = [{"id": f"c{number}", "location": [number, 0], "demand": [1]}
                                for number in range(1, customers + 1)]
        request["fleet"] = [{"id": "truck", "count": customers, "capacity": [customers]}]
        self.add([NewJob("job", "plan", "me", "f", to_json(request))])
        return "job"

    def add(self, jobs: Sequence[NewJob]) -> bool:
        """Keep and enqueue jobs."""
        return self.store.add(jobs, lambda _, job: self.queue.append(job.id))

    def process(self) -> tuple[PlanWork, DividedWork]:
        """Return the work of a process."""
        reader = JobReader(self.planner.policies, self.settings)
        asking = TaskMaker(lambda row: reader.plan_request(self.store, row), 1)
        returning = Returning(self.queue.append, self.queue.append, self.aside.append)
        begin = planned_by(self.planner, self.settings).begin
        plans = PlanWork(begin, self.store, asking, returning, self.tell, TERMS)
        watching = DividedWork(self.store, asking, TERMS, self.add, self.stop_jobs, returning,
                               lambda job: job in self.aside, self.tell, self.clock)
        return plans, watching

    def clock(self) -> float:
        """Return the time, which passes with each look at it."""
        self.now += 0.1
        return self.now

    def tell(self, reply: dict[str, Any]) -> None:
        """Hear of a plan."""
        self.told.append(reply["solver"]["final_cost"])

    def stop_jobs(self, rows: Sequence[JobRow]) -> None:
        """Stop jobs as the service does."""
        self.store.request_cancel([row.id for row in rows])
        for row in rows:
            if row.state == "queued":
                self.store.finish(row.id, None, "cancelled")

    def row(self, job: str = "job") -> JobRow:
        """Return a job."""
        row = self.store.find(job)
        assert row is not None
        return row

    def result(self) -> dict[str, Any]:
        """Return what the job has found."""
        return dict(from_json(self.store.result("job") or b""))

    def begin(self) -> tuple[PlanWork, DividedWork]:
        """Plan the whole once, until regions are to follow, and return the process."""
        plans, watching = self.process()
        assert self.queue == ["job"]
        self.queue.clear()
        with pytest.raises(Stopping):
            until(plans.advance)
        assert (self.row().state, self.row().divided) == ("queued", True)
        assert self.aside == ["job"]
        return plans, watching

    def plan_regions(self, plans: PlanWork) -> None:
        """Plan all regions that wait."""
        while self.queue:
            until(plans.advance, self.queue.pop())

    def finish(self, plans: PlanWork, watching: DividedWork) -> list[float]:
        """Work on the job until it is over; return its costs."""
        costs = []
        while not (slice_of_work := watching.advance("job")).over:
            costs.append(slice_of_work.cost or 0.0)
            self.plan_regions(plans)
        return [*costs, slice_of_work.cost or 0.0]


def until(advance: Callable[[str], Slice], job: str = "job") -> None:
    """Advance a job until it is over."""
    for _ in range(500):
        if advance(job).over:
            return
    raise AssertionError("it has no end")


def served_by(reply: dict[str, Any]) -> Counter[str]:
    """Return how often a plan serves whom."""
    return Counter(stop["id"] for route in reply["routes"] for trip in route["trips"]
                   for stop in trip["stops"] if stop["kind"] == "customer")
