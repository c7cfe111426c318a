"""Jobs that may have ended their process begin alone, and are failed only if they did."""

import threading

import httpx
import pytest
from sqlalchemy import text

from app.database.durable import connect
from app.records.jobs.slices import MAX_CRASHES, POISONOUS
from app.serving.settings import Settings
from model.planner import ALONE, Listener, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.stepping import SteppingPlanner, ended, read, request_of, submit
from tests.conftest import eventually

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


class CountingPlanner(SteppingPlanner):
    """Counts how many plans are made at once."""

    def __init__(self) -> None:
        super().__init__()
        self._lock = threading.Lock()
        self._now = self.most = 0

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        with self._lock:
            self._now += 1
            self.most = max(self.most, self._now)
        try:
            return super().plan(problem, options, received_at, listener, start)
        finally:
            with self._lock:
                self._now -= 1


def submitted(settings: Settings, seconds: float, number: int) -> list[str]:
    """Submit jobs that nobody works on yet."""
    with serving(settings.model_copy(update={"role": "api"})) as client:
        return [submit(client, request_of(seconds)) for _ in range(number)]


def accuse(settings: Settings, jobs: list[str], crashes: int) -> None:
    """Have jobs have been begun so often, without any progress, when the service was killed."""
    engine = connect(settings.database)
    with engine.begin() as connection:
        for job in jobs:
            connection.execute(text("UPDATE jobs SET crashes = :crashes WHERE id = :id"),
                               {"crashes": crashes, "id": job})
    engine.dispose()


def test_suspects_begin_one_at_a_time_and_none_is_failed(settings: Settings) -> None:
    jobs = submitted(settings, 0.3, 4)
    accuse(settings, jobs, 1)
    planner = CountingPlanner()
    with serving(settings, planner) as client:
        assert [ended(client, job)["state"] for job in jobs] == 4 * ["done"]
    assert planner.most == 1


def test_others_begin_beside_a_suspect(settings: Settings) -> None:
    jobs = submitted(settings, 60.0, 2)
    accuse(settings, jobs[:1], 1)
    planner = CountingPlanner()
    with serving(settings, planner):
        eventually(lambda: planner.most == 2)


def test_whoever_comes_further_is_no_suspect_any_more(settings: Settings) -> None:
    jobs = submitted(settings, 600.0, 2)
    accuse(settings, jobs, MAX_CRASHES - 1)

    def both_come_further(client: httpx.Client) -> bool:
        return all(read(client, job)["cost"] is not None for job in jobs)

    with serving(settings) as client:
        # Neither waits for the other's end.
        eventually(lambda: both_come_further(client))
        states = [read(client, job)["state"] for job in jobs]
        assert set(states) <= {"queued", "running"}
    engine = connect(settings.database)
    with engine.connect() as connection:
        assert connection.scalars(text("SELECT crashes FROM jobs")).all() == [0, 0]
    engine.dispose()


def test_study_that_was_begun_when_its_process_was_killed_is_not_failed(
        settings: Settings) -> None:
    body = {"base": request_of(0.1), "grid": {"unassigned_cost": [50, 60]}}
    with serving(settings.model_copy(update={"role": "api"})) as client:
        job = submit(client, body, "/sweep")
    accuse(settings, [job], MAX_CRASHES - 1)
    with serving(settings) as client:
        assert ended(client, job)["state"] == "done"


def test_whoever_ends_its_process_though_it_is_alone_is_failed(settings: Settings) -> None:
    job, other = submitted(settings, 0.2, 2)
    accuse(settings, [job], MAX_CRASHES)
    with serving(settings) as client:
        assert ended(client, job)["error"] == POISONOUS
        assert ended(client, other)["state"] == "done"
