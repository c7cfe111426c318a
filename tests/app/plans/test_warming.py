"""Plans before anybody waits for one."""

from multiprocessing import Pipe

import pytest

from app.maps.roads.asked import KnownRoads
from app.maps.roads.roads import NO_ROADS
from app.plans import workplace
from app.requests.shapes import shape_of
from app.schemas.limits import DEFAULT_POLICY
from app.serving.children.line import Line
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


def test_who_plans_has_planned_by_each_policy_before(monkeypatch: pytest.MonkeyPatch) -> None:
    planner, (ours, theirs) = NotingPlanner(), Pipe()
    shape_of.cache_clear()
    monkeypatch.setattr(workplace, "load_planner", lambda *_: planner)
    place = workplace.opened(Settings(), KnownRoads.of(NO_ROADS), Line(theirs))
    assert place.service.planner is planner
    assert planner.asked == [*planner.policies]
    assert shape_of.cache_info().currsize == 1
    # Nobody asked for them, so they are not counted.
    assert not ours.poll()
