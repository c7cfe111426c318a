"""What happens when planning fails, and whose settings hold."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.main import create_app
from app.plans.service import PlanService, plan_options
from app.requests.bounds import Bounds
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.schemas.request import OptionsInput
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.planner import ALONE, Listener, PlanCheckError, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution
from tests.app.conftest import ready
from tests.conftest import complete

Serve = Callable[[Planner], httpx.Client]


class WrongPlanner:
    """Makes plans that break rules, or crashes."""

    policies = (DEFAULT_POLICY,)

    def __init__(self, error: Exception) -> None:
        self._error = error

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE) -> PlanResult:
        raise self._error


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
    PlanService(planner).reply_to(read_request(json.dumps(smallest).encode(), None), 12.5)
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
    body = ReceivedBody(json.dumps(smallest).encode(), 0.0)
    assert json.loads(service.plan(body))["solver"]["threads"] == 3
