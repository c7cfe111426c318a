"""Jobs on stated roads."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest
from pydantic_core import from_json, to_json

from app.database.durable import connect
from app.maps.roads.building import Build
from app.maps.roads.engine import RoadsUnavailableError
from app.maps.roads.roads import Roads
from app.maps.roads.tools import Tools
from app.records.jobs import planning
from app.records.jobs.asked import TaskMaker
from app.records.jobs.planning import PlanWork
from app.records.jobs.reading import JobReader
from app.records.jobs.rows import JobRow, NewJob
from app.records.jobs.running import Returning
from app.records.jobs.slices import Stopping
from app.records.jobs.store import JobStore
from app.serving.settings import Settings
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.roads import faults
from tests.app.maps.roads.conftest import served
from tests.app.maps.roads.fake import StatedRoads, table_of
from tests.app.maps.roads.faults import Fault, proxied
from tests.app.maps.roads.test_legs import DURATIONS, request
from tests.app.maps.roads.test_serving import helsinki_request
from tests.app.records.jobs.conftest import serving
from tests.app.records.jobs.elsewhere import planned_by
from tests.app.records.jobs.stepping import WHOLE, ended, read, submit
from tests.conftest import eventually

pytestmark = pytest.mark.slow

DOWN = RoadsUnavailableError("They are down.")


class Office:
    """A job, and a process that works on it with these roads."""

    def __init__(self, engine: StatedRoads, folder: Path) -> None:
        settings, planner = Settings(data_dir=folder), FirstFitPlanner()
        self.engine, roads = engine, Roads({"truck": engine})
        self.connections = connect(settings.database)
        self.store = JobStore(self.connections, 1000, lambda *_: None, lambda *_: None)
        self.store.prepare()
        reader = JobReader(planner.policies, settings, roads)
        self.queue: list[str] = []
        asking = TaskMaker(lambda row: reader.plan_request(self.store, row), 1, roads)
        returning = Returning(*(partial(self._queued, where) for where in ("back", "off", "out")))
        self.work = PlanWork(planned_by(planner, settings, roads).begin, self.store, asking,
                             returning, lambda _: None, WHOLE)
        stated = to_json(request(options={"time_limit": 5}))
        assert self.store.add([NewJob("j", "plan", "me", "f", stated)], lambda *_: None)

    def _queued(self, where: str, _: str) -> None:
        self.queue.append(where)

    @property
    def row(self) -> JobRow:
        row = self.store.find("j")
        assert row is not None
        return row

    def advance(self) -> bool:
        """Work on the job for a slice, if it doesn't wait; tell whether it is over."""
        try:
            return self.work.advance("j").over
        except Stopping:
            return False


@pytest.fixture
def office(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Office]:
    monkeypatch.setattr(planning, "ROADS_RETRY", 0.0)
    office = Office(StatedRoads(table_of(DURATIONS)), tmp_path)
    yield office
    office.connections.dispose()


def test_jobs_are_planned_on_roads(office: Office) -> None:
    eventually(office.advance)
    assert office.row.state == "done"
    assert from_json(office.store.result("j") or b"")["legs"][0]["engine"] == "stated"


def test_a_job_waits_for_its_roads_and_goes_on_when_they_are_back(office: Office) -> None:
    answer, office.engine.answer = office.engine.answer, DOWN
    assert not office.advance()
    waiting = office.row
    assert (waiting.state, waiting.error, office.queue) == ("queued", None, ["off"])
    assert "They are down." in (waiting.waiting_for or "")
    assert not office.advance()
    assert office.row.waiting_since == waiting.waiting_since
    assert office.row.revision > waiting.revision
    office.engine.answer = answer
    # Where it waited it only sees that its legs are there: it is planned where the plans are.
    assert not office.advance()
    assert office.queue == ["off", "off", "back"]
    eventually(office.advance)
    done = office.row
    assert (done.state, done.waiting_for, done.waiting_since) == ("done", None, None)
    assert done.searched <= 5.5


def test_a_job_whose_roads_stay_away_fails_and_says_why(
        office: Office, monkeypatch: pytest.MonkeyPatch) -> None:
    office.engine.answer = DOWN
    assert not office.advance()
    monkeypatch.setattr(planning, "MOST_WAITING", 0.0)
    eventually(office.advance)
    assert office.row.state == "failed"
    assert "They are down." in (office.row.error or "")


def test_a_job_that_waits_is_left_to_others_by_a_process_that_ends(
        office: Office, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "ROADS_RETRY", 1000.0)
    office.engine.answer = DOWN
    assert not office.advance()
    office.work.stop()
    with pytest.raises(Stopping):
        office.work.advance("j")
    assert office.work.is_idle
    assert office.row.state == "queued"


def test_a_job_cancelled_while_its_roads_fail_is_over(office: Office) -> None:
    office.engine.answer = DOWN
    office.store.request_cancel(["j"])
    eventually(office.advance)
    assert office.row.state == "cancelled"


@pytest.mark.thorough
def test_jobs_that_wait_for_roads_leave_the_only_place_to_others(
        tmp_path: Path, tools: Tools, prepared_build: Build,
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planning, "ROADS_RETRY", 0.5)
    fault: list[Fault] = [faults.status(401)]
    waiting_jobs = 3
    with (served(tools.folder.parent, prepared_build.data) as url,
          proxied(url, lambda: fault[0]) as proxy):
        settings = Settings(data_dir=tmp_path, role="all", job_slots=1, drain_seconds=0,
                            roads=f"car=osrm:{proxy.url}?rest=0.1")
        with serving(settings) as client:
            options = {"time_limit": 0.2}
            jobs = [submit(client, helsinki_request(3, options=options | {"seed": seed}))
                    for seed in range(waiting_jobs)]
            eventually(lambda: all(read(client, job)["waiting_for"] for job in jobs))
            straight = submit(client, helsinki_request(3, options=options, roads="none"))
            assert ended(client, straight)["state"] == "done"
            cancelled = client.delete(f"/jobs/{jobs[0]}").json()
            assert (cancelled["state"], cancelled["waiting_for"]) == ("cancelled", None)
            fault[0] = faults.nothing
            for job in jobs[1:]:
                done = ended(client, job)
                assert (done["state"], done["error"], done["waiting_for"]) == ("done", None, None)
                assert done["result"]["legs"][0]["by"] == "roads"
