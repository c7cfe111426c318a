"""Jobs of real processes that are killed, on both databases; and databases that go away."""

import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import create_engine, text

from app.serving.settings import Settings
from tests.app.postgres import Postgres
from tests.app.records.jobs.served import Served, halfway, stepping, truly
from tests.app.records.jobs.stepping import NUM_CUSTOMERS, ended, read, request_of, submit
from tests.conftest import eventually

pytestmark = pytest.mark.slow

FULL_COST = 2.0 * NUM_CUSTOMERS

NUM_JOBS = 20
"""Jobs that two workers are given at once, to share."""


def stated(settings: Settings) -> dict[str, Any]:
    """Return settings as a process gets them."""
    values: dict[str, Any] = {"data_dir": settings.data_dir, "drain_seconds": 0, "job_slots": 2}
    if settings.database_url is not None:
        values["database_url"] = settings.database_url.get_secret_value()
    return values


@contextmanager
def served(folder: Path, name: str = "all", **settings: Any) -> Iterator[Served]:
    """Run a process until the block ends."""
    process = Served(folder / f"{name}.log", **settings)
    try:
        process.start()
        yield process
    finally:
        process.kill()
        process.client.close()


def progressing(client: httpx.Client, job: str, below: float = 1000.0) -> dict[str, Any]:
    """Wait until a job has a plan cheaper than that, and return it."""
    return dict(eventually(lambda: (seen := read(client, job))["cost"] is not None
                           and seen["cost"] < below and seen))


def workers_of(url: str) -> dict[str, int]:
    """Return how many jobs of a database each worker has done."""
    engine = create_engine(url)
    with engine.connect() as connection:
        workers = connection.execute(text(
            "SELECT executor_id, count(*) FROM dbos.workflow_status WHERE name = 'plan_job' "
            "AND status = 'SUCCESS' GROUP BY executor_id")).all()
    engine.dispose()
    return {str(name): int(number) for name, number in workers}


def attempts_of(url: str) -> list[int]:
    """Return how often each job of a database was taken."""
    engine = create_engine(url)
    with engine.connect() as connection:
        attempts = list(connection.scalars(text("SELECT attempt FROM jobs")))
    engine.dispose()
    return attempts


@pytest.mark.thorough_after(1)
def test_killed_jobs_go_on_from_their_best_plans(settings: Settings, tmp_path: Path) -> None:
    with served(tmp_path, serve=halfway, **stated(settings)) as process:
        jobs = [submit(process.client, request_of(600, search_iterations=50)) for _ in range(2)]
        grid = {"unassigned_cost": [50, 60, 70, 80]}
        sweep = submit(process.client, {"base": request_of(0.5), "grid": grid}, "/sweep")
        key = {"Idempotency-Key": "k"}
        jobs.append(submit(process.client, request_of(0.5), headers=key))
        before = [progressing(process.client, job) for job in jobs[:2]]
        process.kill()
        process.serve = stepping
        process.start()
        for name, seen in zip(jobs, before, strict=False):
            assert read(process.client, name)["cost"] <= seen["cost"]
        done = [ended(process.client, job) for job in jobs]
        assert [(job["state"], job["cost"]) for job in done] == 3 * [("done", FULL_COST)]
        for last, seen in zip(done, before, strict=False):
            assert last["search_iterations"] > seen["search_iterations"]
            assert last["started_at"] == seen["started_at"]
        again = process.client.post("/jobs", json=request_of(0.5), headers=key)
        assert (again.status_code, again.json()) == (200, done[-1])
        cells = ended(process.client, sweep)["result"]["cells"]
        assert [cell["cost"] for cell in cells] == 4 * [FULL_COST]
        assert len({cell["job"] for cell in cells}) == 4


@pytest.mark.thorough
def test_job_by_regions_goes_on_after_kills(settings: Settings, tmp_path: Path) -> None:
    regions = {"region_from": 2, "region_customers": 5, "region_seconds": 0.5}
    with served(tmp_path, **stated(settings), **regions) as process:
        job = submit(process.client, request_of(3.0))
        before = progressing(process.client, job, below=900.0)
        process.kill()
        process.start()
        assert read(process.client, job)["cost"] <= before["cost"]
        done = ended(process.client, job)
        assert (done["state"], done["progress"]) == ("done", 1)
        assert done["cost"] <= before["cost"]
        stops = [stop["id"] for stop in done["result"]["routes"][0]["trips"][0]["stops"][1:-1]]
        left_out = [entry["id"] for entry in done["result"]["unassigned"]]
        assert sorted(stops + left_out) == sorted(f"c{number}" for number
                                                  in range(1, NUM_CUSTOMERS + 1))


@pytest.mark.thorough
def test_process_that_is_asked_to_end_hands_its_jobs_to_another(
        postgres: Postgres, tmp_path: Path) -> None:
    url = postgres.create("handover")
    common = {"database_url": url, "data_dir": tmp_path, "drain_seconds": 0}
    with served(tmp_path, "a", worker_id="a", **common) as first:
        job = submit(first.client, request_of(600))
        before = progressing(first.client, job, below=math.inf)
        with (served(tmp_path, "b", worker_id="b", **common) as second,
              first.client.stream("GET", f"/jobs/{job}/events") as events):
            lines = events.iter_lines()
            next(lines)
            # It does not wait for those who follow jobs: they go on elsewhere, at once.
            first.terminate()
            with suppress(httpx.RemoteProtocolError):
                list(lines)
            # Nobody had to hold the first to be dead: it gave the job back.
            assert attempts_of(url)[0] > 1
            handed_over = read(second.client, job)["search_iterations"]
            assert handed_over >= before["search_iterations"]
            after = eventually(lambda: (seen := read(second.client, job))["search_iterations"]
                               > handed_over and seen)
            assert (after["state"], after["cost"] <= before["cost"]) == ("running", True)


@pytest.mark.thorough
def test_outage_of_postgresql_loses_nothing(fragile_postgres: Postgres, tmp_path: Path) -> None:
    url = fragile_postgres.create("outage")
    with served(tmp_path, database_url=url, data_dir=tmp_path, drain_seconds=0) as process:
        jobs = [submit(process.client, request_of(seconds)) for seconds in (3.0, 8.0, 0.5)]
        before = progressing(process.client, jobs[0])
        fragile_postgres.stop()
        try:
            refused = process.client.post("/jobs", json=request_of(1.0))
            assert refused.status_code == 503
            assert refused.headers["retry-after"]
            plan = process.client.post("/plan", json=request_of(0))
            assert plan.status_code == 200
        finally:
            fragile_postgres.start()
        eventually(lambda: process.client.get("/jobs").status_code == 200)
        assert read(process.client, jobs[0])["cost"] <= before["cost"]
        for job in jobs:
            done = ended(process.client, job)
            assert (done["state"], done["cost"]) == ("done", FULL_COST)


@pytest.mark.thorough
def test_two_workers_share_a_queue_each_job_done_once(postgres: Postgres, tmp_path: Path) -> None:
    url = postgres.create("shared")
    common = {"database_url": url, "data_dir": tmp_path, "drain_seconds": 0, "job_slots": 8}
    with (served(tmp_path, "api", role="api", **common) as api,
          served(tmp_path, "one", role="worker", worker_id="one", **common) as worker,
          served(tmp_path, "two", role="worker", worker_id="two", **common)):
        assert worker.client.post("/plan", json=request_of(0)).status_code == 404
        jobs: list[str] = []

        def both_do_some() -> bool:
            more = [submit(api.client, request_of(0.2)) for _ in range(NUM_JOBS)]
            assert {ended(api.client, job)["state"] for job in more} == {"done"}
            jobs.extend(more)
            return len(workers_of(url)) > 1

        # One may have done all before the other, on a busy machine, looks for any.
        eventually(both_do_some)
    assert attempts_of(url) == len(jobs) * [1]
    workers = workers_of(url)
    assert workers.keys() == {"one-0", "two-0"}
    assert sum(workers.values()) == len(jobs)


@pytest.mark.thorough
@pytest.mark.by_clock
def test_true_planner_goes_on_after_a_kill(tmp_path: Path, with_drones: dict[str, Any]) -> None:
    limit = 4.0
    request = with_drones | {"options": {"time_limit": limit}}
    with served(tmp_path, serve=truly, data_dir=tmp_path, drain_seconds=0) as process:
        job = submit(process.client, request)
        before = eventually(lambda: (seen := read(process.client, job))["progress"] > 0.4
                            and seen["cost"] is not None and seen)
        process.kill()
        process.start()
        done = ended(process.client, job)
        assert (done["state"], done["progress"]) == ("done", 1)
        assert done["cost"] <= before["cost"]
        assert done["search_iterations"] > before["search_iterations"]
        solver = done["result"]["solver"]
        assert solver["start"] == before["result"]["solver"]["start"]
        # What was left of the time, not all of it once more.
        assert 0.9 * limit < solver["elapsed"]["search"] < limit * (1 + before["progress"])
