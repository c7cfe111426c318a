"""Jobs whose process is gone, that were lost, or that expired."""

import uuid
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import pytest

from app.database.durable import connect
from app.database.settings import DatabaseSettings
from app.records.jobs.housekeeping import LOST, PATIENCE, Housekeeper
from app.records.jobs.queues import Queues
from app.records.jobs.reading import JobReader
from app.records.jobs.rows import JobRow, NewJob, Standing
from app.records.jobs.service import JobService, OpenLimits, Submission
from app.records.jobs.store import JobStore
from app.serving.settings import Settings

pytestmark = pytest.mark.slow


@dataclass(frozen=True)
class Office:
    """A database with jobs and queues."""

    store: JobStore
    queues: Queues

    def housekeeper(self) -> Housekeeper:
        """Return a housekeeper."""
        return Housekeeper(self.store, self.queues)

    def job(self) -> str:
        """Add a job and return its id."""
        job = NewJob(str(uuid.uuid4()), "plan", "me", "f", b"{}")
        assert self.store.add([job], self.queues.add_job)
        return job.id

    def row(self, job: str) -> JobRow:
        """Return a job."""
        row = self.store.find(job)
        assert row is not None
        return row

    def begin(self, job: str) -> JobRow:
        """Take a job as an engine does."""
        with self.queues.engine.begin() as connection:
            connection.exec_driver_sql(
                "UPDATE workflow_status SET status = 'PENDING', executor_id = 'gone' "
                f"WHERE workflow_uuid = '{job}'")
        row = self.store.claim(job)
        assert row is not None
        return row


@pytest.fixture
def office(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Office]:
    """Return an empty database."""
    engine = connect(DatabaseSettings(None, tmp_path_factory.mktemp("office")))
    queues = Queues(engine)
    store = JobStore(engine, 1000, queues.add_webhook, lambda *_: None)
    store.prepare()
    queues.prepare()
    yield Office(store, queues)
    engine.dispose()


def test_what_an_ending_process_still_holds_goes_to_others_at_once(office: Office) -> None:
    ours, theirs = office.job(), office.job()
    office.begin(ours)
    office.store.release(ours, office.row(ours).attempt)
    office.begin(theirs)
    with office.queues.engine.begin() as connection:
        connection.exec_driver_sql("UPDATE workflow_status SET executor_id = 'other' "
                                   f"WHERE workflow_uuid = '{theirs}'")
    office.housekeeper().hand_on("gone")
    assert office.queues.taken() == [theirs]
    assert office.queues.alive([ours, theirs]) == {ours, theirs}
    assert office.row(ours).state == "queued"
    assert office.row(theirs).state == "running"


def test_job_without_sign_of_life_is_given_to_others(office: Office) -> None:
    job = office.job()
    taken = office.begin(job)
    housekeeper = office.housekeeper()
    housekeeper.look(100.0)
    housekeeper.look(100.0 + PATIENCE - 1)
    assert office.queues.taken() == [job]
    housekeeper.look(100.0 + PATIENCE)
    assert office.queues.taken() == []
    assert office.queues.alive([job]) == {job}
    assert office.row(job).state == "queued"
    assert office.store.note(job, taken.attempt, Standing(0.5, 1, 1.0)) is None


def test_job_that_goes_on_is_left_alone(office: Office) -> None:
    job = office.job()
    taken = office.begin(job)
    housekeeper = office.housekeeper()
    for now in range(0, 300, 20):
        housekeeper.look(float(now))
        assert office.store.note(job, taken.attempt, Standing(0.5, 1, 1.0)) is False
    assert office.queues.taken() == [job]


def test_two_housekeepers_rescue_a_job_once(office: Office) -> None:
    job = office.job()
    office.begin(job)
    housekeepers = [office.housekeeper(), office.housekeeper()]
    for housekeeper in housekeepers:
        housekeeper.look(0.0)
    before = office.row(job).attempt
    for housekeeper in housekeepers:
        housekeeper.look(PATIENCE)
    assert office.row(job).attempt == before + 1


def test_waiting_jobs_are_never_held_to_be_dead(office: Office) -> None:
    job = office.job()
    housekeeper = office.housekeeper()
    housekeeper.look(0.0)
    housekeeper.look(10 * PATIENCE)
    assert office.row(job).attempt == 0


def test_job_that_no_queue_knows_fails(office: Office) -> None:
    lost, kept = office.job(), office.job()
    office.queues.forget([lost])
    office.housekeeper().reconcile()
    assert (office.row(lost).state, office.row(lost).error) == ("failed", LOST)
    assert office.row(kept).state == "queued"


def test_expired_jobs_are_deleted(office: Office, monkeypatch: pytest.MonkeyPatch) -> None:
    old, young = office.job(), office.job()
    office.store.finish(old, None, "cancelled")
    later = office.row(old).expires_at
    assert later is not None
    monkeypatch.setattr("app.records.jobs.housekeeping.now_ms", lambda: later + 1)
    office.housekeeper().expire()
    assert office.store.find(old) is None
    assert office.store.find(young) is not None


def test_key_may_be_used_again_once_its_job_expired(
        office: Office, monkeypatch: pytest.MonkeyPatch) -> None:
    def submit() -> tuple[JobRow, bool]:
        return service.submit(Submission("plan", b"{}", "me", "me", "key", None))

    service = JobService(office.store, office.queues, JobReader((), Settings()), OpenLimits(10, 10),
                         lambda _: None, lambda *_: 1)
    job, is_new = submit()
    assert is_new
    assert submit() == (job, False)
    office.store.finish(job.id, None, "cancelled")
    office.queues.drop([job.id])
    later = office.row(job.id).expires_at
    assert later is not None
    monkeypatch.setattr("app.records.jobs.housekeeping.now_ms", lambda: later + 1)
    housekeeper = office.housekeeper()
    housekeeper.expire()
    assert office.store.find(job.id) is None
    again, is_new = submit()
    assert is_new
    housekeeper.reconcile()
    assert office.row(again.id).state == "queued"
    assert office.queues.alive([again.id]) == {again.id}


def test_queues_forget_what_ended_long_ago(office: Office) -> None:
    job = office.job()
    office.queues.drop([job])
    soon = datetime.now(UTC) + timedelta(minutes=1)
    assert office.queues.finished_before(soon - timedelta(hours=1), 10) == []
    assert office.queues.finished_before(soon, 10) == [job]
    office.queues.forget([job])
    assert office.queues.finished_before(soon, 10) == []
