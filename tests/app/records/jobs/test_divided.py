"""Plans by regions: the job that keeps the best plan, and those that plan a region each."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.database.durable import connect
from app.records.jobs import divided, order, planning, rounds
from app.records.jobs.asked import TaskMaker
from app.records.jobs.errors import UnknownJobError
from app.records.jobs.incumbent import Incumbent
from app.records.jobs.queues import Queues
from app.records.jobs.reading import JobReader
from app.records.jobs.region_task import ERRANDS
from app.records.jobs.rounds import num_regions
from app.records.jobs.service import JobService, OpenLimits
from app.records.jobs.slices import Stopping
from app.records.jobs.store import JobStore
from app.serving.settings import Settings
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import Problem
from model.search.regions.region import Region
from model.solution import Solution
from tests.app.records.jobs.regional import NUM_CUSTOMERS, Office, served_by, until

pytestmark = pytest.mark.slow


@pytest.fixture
def office(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Office]:
    """Return an empty office, in which slices are short and time passes with each look."""
    for module in (planning, order):
        monkeypatch.setattr(module, "SLICE", 0.1)
    monkeypatch.setattr(divided, "SLICE", 0.02)
    monkeypatch.setattr(divided, "LOOKING", 0.01)
    monkeypatch.setattr(divided, "LAST_PATIENCE", 0.0)
    settings = Settings(data_dir=tmp_path)
    engine = connect(settings.database)
    store = JobStore(engine, 1000, lambda *_: None, lambda *_: None)
    store.prepare()
    yield Office(engine, store, settings)
    engine.dispose()


EVERYBODY = Counter(f"c{number}" for number in range(1, NUM_CUSTOMERS + 1))
FIRST_COST = sum(2.0 * number for number in range(1, NUM_CUSTOMERS + 1))


@pytest.mark.by_clock
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
    # Nothing is heated anew: each round begins as cool as the whole would be by then.
    first, *cooled = office.planner.cooled
    assert first == 0.0
    assert 0.0 < cooled[0] < cooled[-1] < 1.0
    assert cooled == sorted(cooled)
    # One plan was told, and nothing is left of the regions.
    assert office.told == [done.cost]
    assert office.store.children("job") == []
    assert plans.is_idle
    assert watching.is_idle


@pytest.mark.thorough_after(1)
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
    asked = TaskMaker(lambda row: reader.plan_request(office.store, row), 1).make(
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


def test_regions_are_seen_by_no_client(office: Office) -> None:
    office.job()
    _, watching = office.begin()
    watching.advance("job")
    reader = JobReader(office.planner.policies, office.settings)
    service = JobService(office.store, Queues(office.engine), reader, OpenLimits(1, 1),
                         lambda _: None, lambda *_: 1)
    with pytest.raises(UnknownJobError):
        service.find(office.queue[0], "me")
    assert [row.id for row in service.page("me", 10, None, None)] == ["job"]


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
    (30.0, NUM_CUSTOMERS, {"search_iterations": 5}), (30.0, NUM_CUSTOMERS, {"relations": [
        {"kind": "before", "customers": ["c1", "c2"], "same_vehicle": False}]})])
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
