"""Work on plan jobs, slice by slice, as an engine does."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import pytest
from pydantic_core import from_json, to_json

from app.database.durable import connect
from app.maps.roads.roads import Roads
from app.plans.task import Task, task_of
from app.records.jobs import asked, order, planning
from app.records.jobs.asked import TaskMaker
from app.records.jobs.planning import PlanWork
from app.records.jobs.reading import JobReader
from app.records.jobs.rows import JobRow, NewJob, Standing
from app.records.jobs.running import Returning
from app.records.jobs.search import NEARLY_OVER
from app.records.jobs.slices import (
    DEADLY, MAX_CRASHES, MAX_DEATHS, POISONOUS, Slice, Stopping,
)
from app.records.jobs.store import JobStore
from app.requests.conversion import travels
from app.requests.conversion.preparing import Preparing
from app.schemas.request import PlanRequest
from app.serving.settings import Settings
from tests.app.records.jobs.elsewhere import planned_by
from tests.app.records.jobs.stepping import NUM_CUSTOMERS, WHOLE, SteppingPlanner, request_of
from tests.conftest import eventually

pytestmark = pytest.mark.slow

FULL_COST = 2.0 * NUM_CUSTOMERS

PLANNER = SteppingPlanner()


@dataclass
class Desk:
    """A store and processes that work on its jobs."""

    store: JobStore
    settings: Settings
    put_back: list[str] = field(default_factory=list)
    put_off: list[str] = field(default_factory=list)
    shared_out: list[str] = field(default_factory=list)
    count: int = 0

    def job(self, seconds: float, replan: object = None, **options: object) -> str:
        """Add a job and return its id."""
        self.count += 1
        request = request_of(seconds, **options) | {"replan": replan}
        job = NewJob(f"job-{self.count}", "plan", "me", "f", to_json(request))
        assert self.store.add([job], lambda *_: None)
        return job.id

    def process(self, planner: SteppingPlanner = PLANNER) -> PlanWork:
        """Return the work of a process."""
        reader = JobReader(planner.policies, self.settings)
        asking = TaskMaker(lambda row: reader.plan_request(self.store, row), 1)
        returning = Returning(self.put_back.append, self.put_off.append, self.shared_out.append)
        begin = planned_by(planner, self.settings).begin
        return PlanWork(begin, self.store, asking, returning, lambda _: None, WHOLE)

    def row(self, job: str) -> JobRow:
        """Return a job."""
        row = self.store.find(job)
        assert row is not None
        return row


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Desk]:
    """Return an empty store, and have slices be short."""
    for module in (planning, order):
        monkeypatch.setattr(module, "SLICE", 0.1)
    settings = Settings(data_dir=tmp_path)
    engine = connect(settings.database)
    store = JobStore(engine, 1000, lambda *_: None, lambda *_: None)
    store.prepare()
    yield Desk(store, settings)
    engine.dispose()


def until(advance: Callable[[], Slice], is_enough: Callable[[Slice], bool]) -> list[Slice]:
    """Advance until a slice is enough; return all of them."""
    slices = [advance()]
    while not is_enough(slices[-1]):
        assert len(slices) < 500
        slices.append(advance())
    return slices


def test_slices_tell_how_far_a_job_has_come(desk: Desk) -> None:
    job, work = desk.job(0.8), desk.process()
    slices = until(lambda: work.advance(job), lambda now: now.over)
    assert len(slices) >= 3
    costs = [now.cost for now in slices if now.cost is not None]
    assert costs == sorted(costs, reverse=True)
    assert slices[-1] == Slice(True, desk.row(job).search_iterations, FULL_COST)
    assert desk.row(job).state == "done"
    assert work.is_idle
    assert work.advance(job).over


def test_a_job_whose_legs_take_longer_than_its_search_is_planned(
        desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "COMPUTED_FROM", 0)
    monkeypatch.setattr(travels, "COMPUTED", 4.0 / NUM_CUSTOMERS)  # of 1 s, as for 25,000
    job, work = desk.job(0.2), desk.process()
    until(lambda: work.advance(job), lambda now: now.over)
    assert desk.row(job).state == "done"


@pytest.mark.by_clock
def test_another_process_goes_on_from_the_best_plan(desk: Desk) -> None:
    limit, crashed = 2.5, desk.process(SteppingPlanner(comes_to=0.5))
    job = desk.job(limit)
    until(lambda: crashed.advance(job), lambda now: now.cost is not None and now.cost < 700)
    before = desk.row(job)
    assert before.state == "running"
    planner = SteppingPlanner()
    work = desk.process(planner)
    slices = until(lambda: work.advance(job), lambda now: now.over)
    # What is stopped late, on a busy machine, has searched longer than asked.
    assert planner.cooled == pytest.approx(min(before.searched / limit, NEARLY_OVER))
    assert before.cost is not None
    assert all(now.cost is not None and now.cost <= before.cost for now in slices)
    done = desk.row(job)
    # It takes what is left of the time, not all of it once more.
    assert done.searched > 0.9 * limit
    assert done.searched - before.searched < limit
    assert done.search_iterations > before.search_iterations
    result = desk.store.result(job)
    assert result is not None
    solver = from_json(result)["solver"]
    # As if one process had done it all.
    assert (solver["start"], solver["decoded_cost"]) == ("policy", 100.0 * NUM_CUSTOMERS)
    assert solver["search_iterations"] == done.search_iterations
    assert solver["deterministic"] is False
    assert 0.9 * limit < solver["elapsed"]["search"] <= done.searched
    crashed.stop()


def test_iterations_asked_for_are_those_of_all_processes(desk: Desk) -> None:
    job, crashed = desk.job(60, search_iterations=30), desk.process()
    until(lambda: crashed.advance(job), lambda now: now.iterations > 5)
    work = desk.process()
    until(lambda: work.advance(job), lambda now: now.over)
    assert desk.row(job).search_iterations == 30


def test_process_that_lost_a_job_does_not_end_it(desk: Desk) -> None:
    job, frozen = desk.job(0.4), desk.process(SteppingPlanner(comes_to=0.5))
    frozen.advance(job)
    work = desk.process()
    until(lambda: work.advance(job), lambda now: now.over)
    before = desk.row(job)
    # What it finds on waking is written by nobody; it then finds the job over.
    assert not frozen.advance(job).over
    assert frozen.advance(job).over
    assert desk.row(job) == before


def test_job_that_ends_its_process_again_and_again_fails(desk: Desk) -> None:
    job = desk.job(1.0)
    for _ in range(MAX_CRASHES):
        assert desk.store.claim(job)
    assert desk.process().advance(job).over
    assert (desk.row(job).state, desk.row(job).error) == ("failed", POISONOUS)


def test_crashes_with_progress_between_them_are_forgiven(desk: Desk) -> None:
    job = desk.job(2.0)
    for _ in range(2 * MAX_CRASHES):
        work = desk.process()
        until(partial(work.advance, job), lambda now: now.over or desk.row(job).crashes == 0)
        if desk.row(job).state != "running":
            break
    assert desk.row(job).error is None


def test_job_whose_processes_die_after_some_progress_each_fails(desk: Desk) -> None:
    job = desk.job(1.0)
    for _ in range(MAX_DEATHS):
        row = desk.store.claim(job)
        assert row is not None
        assert desk.store.note(job, row.attempt, Standing(0.1, 1, 0.1)) is False
        assert desk.store.lose(job, row.attempt)
    assert desk.process().advance(job).over
    assert (desk.row(job).state, desk.row(job).error) == ("failed", DEADLY)


def test_process_that_ends_hands_its_jobs_back(desk: Desk) -> None:
    job, work = desk.job(60), desk.process()
    until(lambda: work.advance(job), lambda now: now.cost is not None)
    before = desk.row(job)
    work.stop()
    with pytest.raises(Stopping):
        work.advance(job)
    after = desk.row(job)
    assert (after.state, work.is_idle, desk.put_back) == ("queued", True, [job])
    assert before.cost is not None
    assert after.cost is not None
    assert after.cost <= before.cost
    with pytest.raises(Stopping):
        work.advance(desk.job(1.0))


def test_job_is_cancelled_by_whoever_can_reach_the_database(desk: Desk) -> None:
    job, work = desk.job(60), desk.process()
    until(lambda: work.advance(job), lambda now: now.cost is not None)
    desk.store.request_cancel([job])
    until(lambda: work.advance(job), lambda now: now.over)
    assert desk.row(job).state == "cancelled"
    assert desk.store.result(job) is not None


def test_job_whose_policy_was_removed_fails(desk: Desk) -> None:
    class Newer(SteppingPlanner):
        policies = ("newer",)

    job = desk.job(1.0)
    assert desk.process(Newer()).advance(job).over
    assert desk.row(job).state == "failed"
    assert "can't be planned any more" in str(desk.row(job).error)


def test_time_that_was_used_up_before_a_crash_is_not_given_again(desk: Desk) -> None:
    job = desk.job(5.0)
    row = desk.store.claim(job)
    assert row is not None
    desk.store.note(job, row.attempt, Standing(0.99, 7, 5.0))
    work = desk.process()
    (last,) = until(lambda: work.advance(job), lambda now: now.over)
    assert last.iterations == 7
    assert desk.row(job).state == "done"


def test_job_may_go_on_from_a_plan(desk: Desk) -> None:
    first, stopped = desk.job(4), desk.process()
    until(lambda: stopped.advance(first), lambda now: now.cost is not None and now.cost < 800)
    earlier = from_json(desk.store.result(first) or b"")
    job, work = desk.job(0.5, replan={"plan": earlier}), desk.process()
    until(lambda: work.advance(job), lambda now: now.over)
    result = from_json(desk.store.result(job) or b"")
    assert result["solver"]["start"] == "given"
    assert result["solver"]["decoded_cost"] <= earlier["cost"]["total"]
    assert result["cost"]["total"] == FULL_COST


@pytest.mark.parametrize("where", ["here", "elsewhere"])
def test_job_cancelled_before_its_search_ends(desk: Desk, monkeypatch: pytest.MonkeyPatch,
                                              where: str) -> None:
    process, job = desk.process(), desk.job(seconds=60.0)

    def cancel_meanwhile(request: PlanRequest, preparing: Preparing, roads: Roads) -> None:
        assert not preparing.should_stop()
        if where == "here":
            process.cancel(job)
        else:
            desk.store.request_cancel([job])
        eventually(preparing.should_stop)
        replace(preparing, began=-1e9).pause()

    monkeypatch.setattr(asked, "task_of", cancel_meanwhile)
    until(lambda: process.advance(job), lambda now: now.over)
    assert process.is_idle
    assert desk.row(job).state == "cancelled"


def test_short_job_is_planned_though_the_machine_was_busy(
        desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    process, job = desk.process(), desk.job(seconds=0.1)

    def begin_late(request: PlanRequest, preparing: Preparing, roads: Roads) -> Task:
        return task_of(request, replace(preparing, began=preparing.began - 5.0), roads=roads)

    monkeypatch.setattr(asked, "task_of", begin_late)
    until(lambda: process.advance(job), lambda now: now.over)
    assert desk.row(job).state == "done"


def test_job_that_has_not_begun_to_search_is_left_to_others(
        desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    process, job = desk.process(), desk.job(seconds=60.0)

    def stop_meanwhile(request: PlanRequest, preparing: Preparing, roads: Roads) -> None:
        process.stop()
        eventually(preparing.should_stop)
        replace(preparing, began=-1e9).pause()

    monkeypatch.setattr(asked, "task_of", stop_meanwhile)
    with pytest.raises(Stopping):
        process.advance(job)
    assert process.is_idle
    assert desk.row(job).state == "queued"
    assert desk.put_back == [job]
