"""Days whose service is killed, on both databases."""

import random
import threading
from pathlib import Path
from typing import Any

import httpx
import pytest
import uvicorn

from app.cli.serving import IDLE_SECONDS
from app.main import create_app
from app.serving.children.errors import EndedUnexpectedlyError
from app.records.days import news, runner
from app.serving.settings import Settings
from model.planner import PlanResult
from model.problem import Problem
from tests.app.records.days.living import (
    PROBLEM, begun, clock, order, plan_of, planned, served_by, standing, told,
)
from tests.app.conftest import SearchingPlanner, ready, serving
from tests.app.records.jobs.served import Served
from tests.conftest import eventually

pytestmark = pytest.mark.slow


def searching(port: int) -> None:
    """Serve a planner that searches, in threads: it starts soon."""
    uvicorn.run(create_app(Settings(), SearchingPlanner()), port=port,
                timeout_keep_alive=IDLE_SECONDS)


@pytest.mark.thorough_after(1)
def test_killed_service_loses_no_event_and_counts_none_twice(
        settings: Settings, tmp_path: Path) -> None:
    url = settings.database_url
    served = Served(tmp_path / "log", searching, data_dir=settings.data_dir, drain_seconds=0,
                    **({} if url is None else {"database_url": url.get_secret_value()}))
    served.start()
    day = begun(served.client)
    names = [f"G{number}" for number in range(12)]
    draw = random.Random(1)
    stopping = threading.Event()

    def kill_often() -> None:
        for _ in range(2):
            if stopping.wait(draw.uniform(0.3, 1.5)):
                return
            served.kill()
            served.start()

    killer = threading.Thread(target=kill_often)
    killer.start()
    try:
        for number, name in enumerate(names):
            _tell_until_heard(served.client, day, name, number + 1.0)
    finally:
        killer.join()
        stopping.set()
    found = planned(served.client, day)
    numbers = served.client.post(f"/days/{day}/events", json=[
        {"event_id": name, "at": 1, **clock()} for name in names]).json()["accepted"]
    assert len({each["number"] for each in numbers}) == len(names)
    assert {each.id for each in found.orders} == {*"ABCDEF", *names}
    before = plan_of(served.client, day)
    assert set(served_by(before)) | {each["id"] for each in before["unassigned"]} == {
        *"ABCDEF", *names}
    served.kill()
    served.start()
    assert plan_of(served.client, day) == before
    assert standing(served.client, day).revision == found.revision
    served.terminate()
    served.client.close()


def _tell_until_heard(client: httpx.Client, day: str, name: str, at: float) -> None:
    """Tell of an order as often as the service is away meanwhile, and once more."""
    event = {"event_id": name, "at": at, **order(name, 1, 1)}

    def is_heard() -> bool:
        try:
            return client.post(f"/days/{day}/events", json=[event]).status_code == 202
        except httpx.HTTPError:
            return False

    eventually(is_heard)
    eventually(is_heard)



class DyingPlanner(SearchingPlanner):
    """Dies of one plan as often as it is told to, and plans others."""

    deaths = 0

    def plan(self, problem: Problem, *args: Any, **options: Any) -> PlanResult:
        if type(self).deaths > 0:
            type(self).deaths -= 1
            raise EndedUnexpectedlyError
        return super().plan(problem, *args, **options)


@pytest.mark.parametrize(("deaths", "fails"), [(2, False), (3, True)])
def test_day_whose_process_dies_is_planned_again_some_times(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, deaths: int, fails: bool) -> None:
    monkeypatch.setattr("app.records.days.runner.LEASE", 0.2)
    with serving(DyingPlanner(), Settings(data_dir=tmp_path, role="api")) as client:
        # Plans end by their turns: on a busy machine little is searched in the usual time.
        day = begun(ready(client), {**PROBLEM, "options": {"search_iterations": 1000}},
                    plan_within=60)
        DyingPlanner.deaths = deaths
        client.post(f"/days/{day}/events", json=[{"event_id": "e", "at": 1, **order("G", 1, 1)}])
        eventually(lambda: standing(client, day).is_planned)
        assert (standing(client, day).failure is not None) == fails
        client.post(f"/days/{day}/events", json=[{"event_id": "f", "at": 2, **clock()}])
        assert "G" in served_by(plan_of(client, planned(client, day).id))


def test_day_is_planned_once_however_long_that_takes(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Whoever renews gets no processor for a second or two on a busy machine.
    monkeypatch.setattr(runner, "LEASE", 3.0)
    monkeypatch.setattr(runner, "RENEWAL", 0.1)
    plans = list[int]()

    def slowly(number: int, *args: Any) -> Any:
        plans.append(number)
        if number > 1:
            threading.Event().wait(7.0)
        return news.news_of(number, *args)

    monkeypatch.setattr(runner, "news_of", slowly)
    with serving(SearchingPlanner(), Settings(data_dir=tmp_path, role="api")) as client:
        day = begun(ready(client))
        told(client, day, clock(), at=1)
        assert standing(client, day).plan_number == 2
        assert plans == [1, 2]
