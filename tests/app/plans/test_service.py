"""Readiness, and what happens when planning fails."""

import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.load.bodies import ReceivedBody
from app.main import create_app
from app.plans.service import PlanService, plan_options, reply_to
from app.requests.bounds import Bounds
from app.requests.reading import read_request
from app.schemas.request import OptionsInput
from app.settings import DEFAULT_POLICY, Settings
from model.kernel.warming import Tell, Warmth
from model.planner import ALONE, Listener, PlanCheckError, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution
from tests.app.conftest import FirstFitPlanner, ready
from tests.conftest import complete, eventually

Serve = Callable[[Planner], httpx.Client]


class SlowPlanner:
    """Warms up until told to stop."""

    policies = (DEFAULT_POLICY,)

    def __init__(self) -> None:
        self.started = threading.Event()
        self.finish = threading.Event()

    def warm(self, tell: Tell) -> None:
        tell(Warmth("compiling this", 0.25))
        self.started.set()
        self.finish.wait()


class BrokenPlanner:
    """Can't be warmed up."""

    def warm(self, tell: Tell) -> None:
        raise ValueError("no weights")


class WrongPlanner:
    """Makes plans that break rules, or crashes."""

    policies = (DEFAULT_POLICY,)

    def __init__(self, error: Exception) -> None:
        self._error = error

    def warm(self, tell: Tell) -> None:
        pass

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE) -> PlanResult:
        raise self._error


@pytest.fixture
def slow() -> Iterator[SlowPlanner]:
    """Return a planner that is warm at the end of the test at the latest."""
    planner = SlowPlanner()
    yield planner
    planner.finish.set()


def test_service_is_ready_once_warm(serve: Serve, smallest: dict[str, Any],
                                    slow: SlowPlanner) -> None:
    client = serve(slow)
    slow.started.wait()
    response = client.get("/health/ready")
    assert response.status_code == 503
    assert response.json() == {"status": "starting", "progress": 0.25,
                               "detail": "compiling this, about 25% done"}
    assert client.get("/health/live").status_code == 200
    refusal = client.post("/plan", json=smallest)
    assert refusal.status_code == 503
    assert refusal.headers["content-type"] == "application/problem+json"
    assert int(refusal.headers["retry-after"]) > 0
    slow.finish.set()
    ready(client)
    assert client.get("/health/ready").json()["status"] == "ready"


class HalfWarmPlanner(FirstFitPlanner):
    """Decodes, while its search is compiled until told to stop."""

    def __init__(self) -> None:
        self.decodes = threading.Event()
        self.finish = threading.Event()

    def warm(self, tell: Tell, problem: Problem | None = None) -> None:
        tell(Warmth("compiling the search", 0.5, decodes=True))
        self.decodes.set()
        self.finish.wait()


@pytest.fixture
def half_warm(serve: Serve) -> Iterator[httpx.Client]:
    """Return a client of a service whose planner decodes and doesn't search yet."""
    planner = HalfWarmPlanner()
    client = serve(planner)
    planner.decodes.wait()
    yield client
    planner.finish.set()


@pytest.mark.parametrize("options", [
    {"time_limit": 0}, {"search_iterations": 0}, {"time_limit": 0, "decoding": "sample"}])
def test_plans_without_a_search_are_made_before_it_is_compiled(
        half_warm: httpx.Client, smallest: dict[str, Any], options: dict[str, Any]) -> None:
    response = half_warm.post("/plan", json=smallest | {"options": options})
    assert response.status_code == 200, response.text


def test_plans_with_a_search_wait_until_it_is_compiled(
        half_warm: httpx.Client, smallest: dict[str, Any]) -> None:
    plan = half_warm.post("/plan", json=smallest | {"options": {"time_limit": 0}}).json()
    for request in (smallest, smallest | {"options": {"time_limit": 0}, "replan": {"plan": plan}}):
        refusal = half_warm.post("/plan", json=request)
        assert refusal.status_code == 503, refusal.text
        assert int(refusal.headers["retry-after"]) > 0
        assert "50%" in refusal.json()["detail"]
        assert "plans with time_limit 0 are made already" in refusal.json()["detail"]


def test_pages_are_served_while_the_planner_warms_up(half_warm: httpx.Client) -> None:
    for path in ("/", "/docs", "/openapi.json", "/health/live", "/console/config.json"):
        assert half_warm.get(path).status_code == 200, path
    readiness = half_warm.get("/health/ready")
    assert readiness.status_code == 503
    assert readiness.json() == {
        "status": "starting", "progress": 0.5, "detail": "compiling the search, about 50% done; "
        "plans with time_limit 0 are made already"}


def test_service_that_cannot_be_warmed_is_never_ready() -> None:
    service = PlanService(BrokenPlanner())
    assert not service.readiness().is_ready
    service.start()
    service.stop()
    eventually(lambda: "failed" in service.readiness().detail)
    assert service.readiness().detail == "warming up failed: no weights"


@pytest.mark.parametrize("error", [PlanCheckError("truck overloaded"), ZeroDivisionError()])
def test_failures_are_internal_errors_without_details(
        serve: Serve, smallest: dict[str, Any], error: Exception) -> None:
    client = serve(WrongPlanner(error))
    ready(client)
    response = client.post("/plan", json=smallest)
    assert response.status_code == 500
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["title"] == "Internal error"
    assert "overloaded" not in response.text


def test_missing_policy_stops_startup(tmp_path: Path) -> None:
    app = create_app(Settings(weights_dir=tmp_path))

    async def start() -> None:
        async with app.router.lifespan_context(app):
            pass

    with pytest.raises((ValueError, OSError)):
        complete(start())


def test_time_limit_runs_from_the_end_of_the_request(
        planner: Planner, smallest: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[float | None] = []
    plan = planner.plan

    def listening(problem: Problem, options: PlanOptions, received_at: float | None = None,
                  listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        told.append(received_at)
        return plan(problem, options, received_at)

    monkeypatch.setattr(planner, "plan", listening)
    reply_to(planner, read_request(json.dumps(smallest).encode(), None), 12.5)
    assert told == [12.5]


def test_settings_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Settings().search_threads == 1
    monkeypatch.setenv("TANDEM_MAX_BODY_BYTES", "77")
    monkeypatch.setenv("TANDEM_POLICIES", '["pointer", "attention"]')
    monkeypatch.setenv("TANDEM_SEARCH_THREADS", "3")
    settings = Settings()
    assert settings.max_body_bytes == 77
    assert settings.policies == ("pointer", "attention")
    assert settings.search_threads == 3


@pytest.mark.parametrize(("stated", "cores", "used"), [
    (None, 8, 3), (None, 2, 2), (5, 8, 5), (64, 8, 8), (1, 8, 1), (4, 1, 1)])
def test_threads_are_the_requests_then_the_settings_and_no_more_than_cores(
        monkeypatch: pytest.MonkeyPatch, stated: int | None, cores: int, used: int) -> None:
    monkeypatch.setattr("app.plans.service.num_cores", lambda: cores)
    options = plan_options(OptionsInput(threads=stated), search_threads=3)
    assert options.threads == used


def test_service_searches_with_the_threads_of_its_settings(
        monkeypatch: pytest.MonkeyPatch, smallest: dict[str, Any], planner: Planner) -> None:
    monkeypatch.setattr("app.plans.service.num_cores", lambda: 8)
    service = PlanService(planner, search_threads=3, bounds=Bounds(customers=10))
    service.start()
    eventually(lambda: service.readiness().is_ready)
    body = ReceivedBody(json.dumps(smallest).encode(), 0.0)
    assert json.loads(service.plan(body))["solver"]["threads"] == 3
    service.stop()
