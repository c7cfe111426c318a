"""Plans by regions: the job that keeps the best plan, and those that plan a region each."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import pytest
from pydantic_core import from_json, to_json

from app.database.durable import connect
from app.jobs import divided, planning, rounds
from app.jobs.asked import Asking
from app.jobs.divided import DividedWork
from app.jobs.incumbent import Incumbent
from app.jobs.planning import PlanWork
from app.jobs.reading import JobReader
from app.jobs.region_task import ERRANDS
from app.jobs.rounds import num_regions
from app.jobs.rows import JobRow, NewJob
from app.jobs.running import RegionTerms, Returning
from app.jobs.slices import Slice, Stopping
from app.jobs.store import JobStore
from app.settings import DEFAULT_POLICY, Settings
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.kernel.warming import Tell, Warmth
from model.planner import ALONE, Elapsed, Listener, PlanOptions, PlanResult
from model.problem import Problem
from model.regions.region import Region
from model.search.improve import Progress
from model.solution import Solution
from tests.app.jobs.stepping import request_of

NUM_CUSTOMERS = 12
TERMS = RegionTerms(NUM_CUSTOMERS, 4, 0.5)


class PoolingPlanner:
    """Sends a truck to each customer at first, then fewer by one each time."""

    policies = (DEFAULT_POLICY,)

    def __init__(self) -> None:
        self.sizes: list[int] = []  # of the regions planned
        self.fails = False

    def warm(self, tell: Tell) -> None:
        tell(Warmth("compiling nothing", 1.0))

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        nodes = list(range(problem.num_depots, problem.num_nodes))
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

    store: JobStore
    settings: Settings
    planner: PoolingPlanner = field(default_factory=PoolingPlanner)
    queue: list[str] = field(default_factory=list)
    aside: list[str] = field(default_factory=list)
    told: list[float] = field(default_factory=list)
    now: float = 0.0

    def job(self, seconds: float = 3.0, customers: int = NUM_CUSTOMERS, **options: Any) -> str:
        """Add a job and return its id."""
        request = request_of(seconds, **options)
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
        asking = Asking(lambda row: reader.plan_request(self.store, row), 1)
        returning = Returning(self.queue.append, self.queue.append, self.aside.append)
        plans = PlanWork(self.planner, self.store, asking, returning, self.tell, TERMS)
        watching = DividedWork(self.store, asking, TERMS, self.add, self.stop_jobs, returning,
                               lambda job: job in self.aside, self.tell, self.clock)
        return plans, watching

    def clock(self) -> float:
        """Return the time, which passes with each look at it."""
        self.now += 0.1
        return self.now

    def tell(self, reply: dict[str, Any]) -> None:
        """Hear of a plan."""
        self.told.append(reply["cost"]["total"])

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


@pytest.fixture
def office(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Office]:
    """Return an empty office, in which slices are short and time passes with each look."""
    monkeypatch.setattr(planning, "SLICE", 0.1)
    monkeypatch.setattr(divided, "SLICE", 0.02)
    monkeypatch.setattr(divided, "LOOKING", 0.01)
    monkeypatch.setattr(divided, "LAST_PATIENCE", 0.0)
    settings = Settings(data_dir=tmp_path)
    engine = connect(settings)
    store = JobStore(engine, 1000, lambda *_: None, lambda *_: None)
    store.prepare()
    yield Office(store, settings)
    engine.dispose()


def served_by(reply: dict[str, Any]) -> Counter[str]:
    """Return how often a plan serves whom."""
    return Counter(stop["id"] for route in reply["routes"] for trip in route["trips"]
                   for stop in trip["stops"] if stop["kind"] == "customer")


EVERYBODY = Counter(f"c{number}" for number in range(1, NUM_CUSTOMERS + 1))
FIRST_COST = sum(2.0 * number for number in range(1, NUM_CUSTOMERS + 1))


def test_job_is_planned_by_regions_round_after_round(office: Office) -> None:
    office.job()
    plans, watching = office.begin()
    assert office.row().cost == FIRST_COST
    costs = office.finish(plans, watching)
    done, result = office.row(), office.result()
    assert (done.state, done.progress) == ("done", 1.0)
    assert costs == sorted(costs, reverse=True)
    assert costs[-1] < FIRST_COST
    assert len(set(costs)) > 2
    assert served_by(result) == EVERYBODY
    assert result["cost"]["total"] == done.cost == costs[-1]
    solver = result["solver"]
    assert (solver["start"], solver["decoded_cost"]) == ("insertion", FIRST_COST)
    # The first plan took one, and each region another.
    assert solver["search_iterations"] == done.search_iterations == 1 + len(office.planner.sizes)
    assert max(office.planner.sizes) < NUM_CUSTOMERS
    # One plan was told, and nothing is left of the regions.
    assert office.told == [done.cost]
    assert office.store.children("job") == []
    assert plans.is_idle
    assert watching.is_idle


@pytest.mark.parametrize("come_back", [True, False])
def test_job_goes_on_when_its_keeper_is_killed(office: Office, come_back: bool) -> None:
    office.job()
    plans, killed = office.begin()
    killed.advance("job")
    assert len(office.queue) == 3
    if come_back:
        office.plan_regions(plans)
    before = office.row()
    plans, watching = office.process()
    office.plan_regions(plans)
    # All that came back meanwhile is merged.
    while watching.advance("job").cost == before.cost:
        pass
    assert office.row().search_iterations > before.search_iterations
    costs = office.finish(plans, watching)
    assert costs == sorted(costs, reverse=True)
    assert (office.row().state, served_by(office.result())) == ("done", EVERYBODY)
    # Whoever was killed and wakes writes nothing any more.
    done = office.row()
    killed.advance("job")
    assert office.row() == done


def test_region_is_planned_though_its_process_is_killed(office: Office) -> None:
    office.job()
    _, watching = office.begin()
    watching.advance("job")
    for job in office.queue:
        assert office.store.claim(job)
    plans, _ = office.process()
    costs = office.finish(plans, watching)
    assert costs[-1] < FIRST_COST
    assert (office.row().state, served_by(office.result())) == ("done", EVERYBODY)


def test_region_that_comes_back_late_is_refused(office: Office,
                                                monkeypatch: pytest.MonkeyPatch) -> None:
    office.job()
    plans, watching = office.begin()
    watching.advance("job")
    late = office.queue.pop()
    frozen = office.store.claim(late)
    assert frozen is not None
    monkeypatch.setattr(rounds, "LATE", -1000.0)
    # The others are planned, and regions drawn that overlap with the late one.
    office.plan_regions(plans)
    while late not in office.queue and office.row(late).cancel_requested is False:
        watching.advance("job")
    errand = ERRANDS.validate_json(office.store.request(late))
    office.plan_regions(plans)
    watching.advance("job")
    kept = Incumbent(*_problem_and_plan(office))
    outcome = kept.merge(errand.region, errand.region.plan)
    assert outcome in ("stale", "dearer")
    until(plans.advance, late)
    costs = office.finish(plans, watching)
    assert costs == sorted(costs, reverse=True)
    assert served_by(office.result()) == EVERYBODY


def _problem_and_plan(office: Office) -> tuple[Problem, Solution]:
    reader = JobReader(office.planner.policies, office.settings)
    asked = Asking(lambda row: reader.plan_request(office.store, row), 1).make(
        office.row(), lambda: False)
    return asked.task.problem, asked.task.read(office.result())


def test_what_is_stale_dearer_or_broken_is_not_merged(office: Office) -> None:
    office.job()
    office.begin()
    problem, plan = _problem_and_plan(office)
    best = Incumbent(problem, plan)
    region = Region(Solution(plan.routes[:2]))
    pooled = schedule(problem, RouteDecision(0, 0, (TripDecision((0, 1, 2, 0)),)))
    late = replace(pooled, trips=(replace(pooled.trips[0], stops=tuple(
        replace(stop, arrival=stop.arrival + 1000) for stop in pooled.trips[0].stops)),))
    assert best.merge(region, Solution((late,))) == "broken"
    assert best.merge(region, Solution((), (1, 2))) == "dearer"
    assert best.merge(region, Solution(plan.routes[:1])) == "broken"
    assert best.cost == FIRST_COST
    assert best.merge(region, Solution((pooled,))) == "merged"
    assert best.cost == FIRST_COST - 2
    assert check(problem, best.plan) == best.evaluation
    assert best.merge(region, Solution((pooled,))) == "stale"


def test_job_by_regions_is_cancelled_with_its_best_plan(office: Office) -> None:
    office.job(seconds=600.0)
    plans, watching = office.begin()
    watching.advance("job")
    office.plan_regions(plans)
    watching.advance("job")
    office.store.request_cancel(["job"])
    while not watching.advance("job").over:
        pass
    stopped = office.row()
    assert stopped.state == "cancelled"
    assert stopped.cost is not None
    assert stopped.cost < FIRST_COST
    assert served_by(office.result()) == EVERYBODY
    assert all(region.is_over for region in office.store.children("job"))


def test_regions_end_with_their_job(office: Office) -> None:
    office.job()
    plans, watching = office.begin()
    watching.advance("job")
    (one, *others) = office.queue
    assert office.store.claim(one)
    assert office.store.finish("job", None, "cancelled")
    assert all(region.cancel_requested for region in office.store.children("job"))
    for region in (one, *others):
        until(plans.advance, region)
        assert office.row(region).state == "cancelled"
    assert office.planner.sizes == []
    assert watching.advance("job").over in (True, False)
    until(watching.advance)


def test_job_fails_if_no_region_can_be_planned(office: Office) -> None:
    office.job()
    plans, watching = office.begin()
    office.planner.fails = True
    office.finish(plans, watching)
    assert office.row().state == "failed"
    assert office.row().error == "The plan could not be computed."


def test_process_that_ends_leaves_the_job_to_others(office: Office) -> None:
    office.job()
    plans, watching = office.begin()
    watching.advance("job")
    office.aside.clear()
    watching.stop()
    with pytest.raises(Stopping):
        watching.advance("job")
    assert (office.row().state, office.aside) == ("queued", ["job"])
    plans, watching = office.process()
    office.finish(plans, watching)
    assert office.row().state == "done"


def test_keeper_takes_no_place_of_a_plan(office: Office) -> None:
    office.job()
    _, watching = office.begin()
    office.aside.clear()
    # As after a crash between writing the first plan down and leaving the plans' queue.
    with pytest.raises(Stopping):
        watching.advance("job")
    assert office.aside == ["job"]
    assert office.row().state == "queued"


@pytest.mark.parametrize(("seconds", "customers", "options"), [
    (1.0, NUM_CUSTOMERS, {}), (30.0, NUM_CUSTOMERS - 1, {}),
    (30.0, NUM_CUSTOMERS, {"search_iterations": 5})])
def test_other_jobs_are_planned_whole(office: Office, seconds: float, customers: int,
                                      options: dict[str, Any]) -> None:
    job = office.job(seconds, customers, **options)
    plans, _ = office.process()
    until(plans.advance, job)
    assert (office.row().state, office.row().divided) == ("done", False)


@pytest.mark.parametrize(("customers", "usual", "at_once", "count"), [
    (10_000, 2500, 1, 4), (10_000, 2500, 2, 4), (10_000, 2500, 3, 3), (12_000, 2500, 2, 4),
    (10_000, 2500, 100, 4), (100_000, 2500, 16, 32), (10, 2500, 4, 1)])
def test_regions_leave_nobody_idle(customers: int, usual: int, at_once: int, count: int) -> None:
    assert num_regions(customers, usual, at_once) == count
