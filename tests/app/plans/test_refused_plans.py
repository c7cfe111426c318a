"""A plan that the judge refuses isn't answered, nor is there an error: another stands for it."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import httpx
import pytest

from app import main
from app.serving.children.starting import threads
from app.serving.settings import Settings
from model import planner as planning
from model.search import improve as searching
from model.search.improve import Improved
from tests.app.conftest import ready, serving

pytestmark = pytest.mark.plans_are_refused


@pytest.fixture
def careless(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have searches serve their first customer twice, unless they only begin."""
    improve: Callable[..., Improved] = searching.improve

    def twice(problem: Any, instance: Any, begun: Any, config: Any, *rest: Any,
              **more: Any) -> Improved:
        found = improve(problem, instance, begun, config, *rest, **more)
        routes = found.solution.routes
        if config.turns == 0 or not routes:
            return found
        again = replace(routes[0], trips=routes[0].trips * 2)
        return replace(found, solution=replace(found.solution, routes=(again, *routes[1:])))

    monkeypatch.setattr(planning, "improve", twice)
    # In this process, which alone is careless.
    monkeypatch.setattr(main, "processes", lambda open_place, logs: threads(open_place))


def refusals(client: httpx.Client) -> float:
    """Return how many refused plans metrics tell of."""
    line = next(line for line in client.get("/metrics").text.splitlines()
                if line.startswith("tandem_plans_refused_total"))
    return float(line.split()[1])


@pytest.mark.usefixtures("careless")
def test_what_is_refused_is_replaced_told_and_counted(smallest: dict[str, Any]) -> None:
    smallest["options"] = {"time_limit": 0.3}
    with serving(None, Settings()) as client:
        ready(client)
        before = refusals(client)
        reply = client.post("/plan", json=smallest)
        assert reply.status_code == 200
        plan = reply.json()
        assert plan["status"] == "complete"
        assert plan["solver"]["plans_refused"] == 1
        verdict = client.post("/check", json={"problem": smallest, "plan": plan})
        assert verdict.json()["feasible"] is True
        assert refusals(client) == before + 1
        smallest["replan"] = {"plan": plan, "freeze_before": 60}
        again = client.post("/plan", json=smallest)
        assert (again.status_code, again.json()["status"]) == (200, "complete")


@pytest.mark.thorough
def test_nothing_is_told_where_nothing_is_refused(smallest: dict[str, Any]) -> None:
    smallest["options"] = {"time_limit": 0.1}
    with serving(None, Settings()) as client:
        ready(client)
        plan = client.post("/plan", json=smallest).json()
        assert plan["solver"]["plans_refused"] == 0
