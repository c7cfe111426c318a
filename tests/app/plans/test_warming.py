"""Plans before anybody waits for one."""

from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

import app.main
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from model.planner import ALONE, Listener, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution
from tests.app.conftest import FirstFitPlanner


class NotingPlanner(FirstFitPlanner):
    """Notes by which policies it planned."""

    def __init__(self) -> None:
        self.policies = (DEFAULT_POLICY, "pointer")
        self.asked: list[str] = []

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        self.asked.append(options.policy)
        return super().plan(problem, options, received_at, listener, start)


def test_service_has_planned_by_each_policy_when_it_is_ready(
        serve: Callable[..., httpx.Client], monkeypatch: pytest.MonkeyPatch,
        tmp_path: Path) -> None:
    planner = NotingPlanner()
    monkeypatch.setattr(app.main, "load_planner", lambda weights, names: planner)
    client = serve(None, Settings(data_dir=tmp_path))
    assert client.get("/health/live").status_code == 200
    assert planner.asked == [*planner.policies]
    # Nobody asked for them.
    assert "tandem_plans_total{" not in client.get("/metrics").text
