"""Jobs in both databases: nothing happens twice, and late writers change nothing."""

import uuid
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import Connection

from app.database.durable import connect
from app.records.clock import now_ms
from app.records.jobs.rows import NewJob, OpenPlans, Standing
from app.records.jobs.store import JobStore
from app.serving.settings import Settings

pytestmark = pytest.mark.slow


class Books:
    """What a store told others."""

    def __init__(self) -> None:
        self.enqueued: list[str] = []
        self.announced: list[tuple[str, str]] = []
        self.ended: list[tuple[str, str]] = []

    def enqueue(self, connection: Connection, job: NewJob) -> None:
        """Note a job that is enqueued."""
        self.enqueued.append(job.id)


@pytest.fixture
def books() -> Books:
    """Return empty books."""
    return Books()


@pytest.fixture
def store(settings: Settings, books: Books) -> Iterator[JobStore]:
    """Return an empty store."""
    engine = connect(settings.database)
    store = JobStore(engine, 1000, lambda _, job, url: books.announced.append((job, url)),
                     lambda kind, state, _: books.ended.append((kind, state)))
    store.prepare()
    yield store
    engine.dispose()


def new_job(**more: object) -> NewJob:
    """Return a job."""
    values = {"id": str(uuid.uuid4()), "kind": "plan", "owner": "me", "fingerprint": "f",
              "body": b"{}", **more}
    return NewJob(**values)


def added(store: JobStore, books: Books, **more: object) -> str:
    """Add a job and return its id."""
    job = new_job(**more)
    assert store.add([job], books.enqueue)
    return job.id


def test_job_is_kept_once(store: JobStore, books: Books) -> None:
    job = new_job(body=b'{"a": 1}')
    assert store.add([job], books.enqueue)
    assert not store.add([job], books.enqueue)
    assert books.enqueued == [job.id]
    row = store.find(job.id)
    assert row is not None
    assert (row.state, row.cost, row.attempt) == ("queued", None, 0)
    assert store.request(job.id) == b'{"a": 1}'


def test_job_that_can_not_be_enqueued_is_not_kept(store: JobStore) -> None:
    job = new_job()

    def fail(connection: Connection, job: NewJob) -> None:
        raise OSError("no queue")

    with pytest.raises(OSError, match="no queue"):
        store.add([job], fail)
    assert store.find(job.id) is None


def test_cost_never_rises_and_its_plan_goes_with_it(store: JobStore, books: Books) -> None:
    job = added(store, books)
    row = store.claim(job)
    assert row is not None
    for cost, kept, result in ((5.0, 5.0, b"5"), (7.0, 5.0, b"5"), (4.0, 4.0, b"4")):
        standing = Standing(0.5, 10, 1.0, cost, str(int(cost)).encode())
        assert store.note(job, row.attempt, standing) is False
        seen = store.find(job)
        assert seen is not None
        assert (seen.cost, store.result(job)) == (kept, result)
    assert store.finish(job, row.attempt, "done", Standing(1.0, 20, 2.0, 6.0, b"6"))
    seen = store.find(job)
    assert seen is not None
    assert (seen.cost, store.result(job), seen.search_iterations) == (4.0, b"4", 20)


def test_last_reply_replaces_one_of_equal_cost(store: JobStore, books: Books) -> None:
    job = added(store, books)
    row = store.claim(job)
    assert row is not None
    store.note(job, row.attempt, Standing(0.5, 1, 1.0, 5.0, b"on the way"))
    before = store.find(job)
    store.finish(job, row.attempt, "done", Standing(1.0, 2, 1.0, 5.0, b"end"))
    after = store.find(job)
    assert before is not None
    assert after is not None
    assert store.result(job) == b"end"
    assert after.improved_revision == before.improved_revision < after.revision


def test_earlier_attempt_changes_nothing(store: JobStore, books: Books) -> None:
    job = added(store, books)
    frozen = store.claim(job)
    taken = store.claim(job)
    assert frozen is not None
    assert taken is not None
    assert taken.attempt > frozen.attempt
    standing = Standing(0.5, 1, 1.0, 1.0, b"1")
    assert store.note(job, frozen.attempt, standing) is None
    assert not store.finish(job, frozen.attempt, "done", standing)
    assert not store.release(job, frozen.attempt)
    assert store.result(job) is None
    assert store.finish(job, taken.attempt, "done", standing)


def test_job_ends_once(store: JobStore, books: Books) -> None:
    job = added(store, books, webhook="https://example.org")
    row = store.claim(job)
    assert row is not None
    assert store.finish(job, None, "cancelled")
    assert not store.finish(job, row.attempt, "done", Standing(1.0, 1, 1.0, 1.0, b"1"))
    assert not store.finish(job, None, "failed")
    assert store.claim(job) is None
    seen = store.find(job)
    assert seen is not None
    assert seen.state == "cancelled"
    assert seen.finished_at is not None
    assert seen.expires_at == seen.finished_at + 1000
    assert books.announced == [(job, "https://example.org")]
    assert books.ended == [("plan", "cancelled")]


def test_failed_job_has_no_result(store: JobStore, books: Books) -> None:
    job = added(store, books)
    row = store.claim(job)
    assert row is not None
    store.note(job, row.attempt, Standing(0.5, 1, 1.0, 1.0, b"1"))
    store.finish(job, row.attempt, "failed", error="so")
    assert store.result(job) is None


def test_attempts_without_progress_are_counted(store: JobStore, books: Books) -> None:
    job = added(store, books)
    assert [row.crashes for _ in range(3) if (row := store.claim(job))] == [1, 2, 3]
    row = store.claim(job)
    assert row is not None
    store.note(job, row.attempt, Standing(0.1, 1, 1.0))
    row = store.claim(job)
    assert row is not None
    assert row.crashes == 1


def test_deaths_are_counted_whatever_progress_was_made(store: JobStore, books: Books) -> None:
    job = added(store, books)
    for deaths in range(3):
        row = store.claim(job)
        assert row is not None
        assert row.deaths == deaths
        store.note(job, row.attempt, Standing(0.1 * deaths, 1, 1.0))
        assert store.lose(job, row.attempt)
        assert not store.lose(job, row.attempt)


def test_cancelling_is_told_to_whoever_writes_next(store: JobStore, books: Books) -> None:
    job = added(store, books)
    row = store.claim(job)
    assert row is not None
    store.request_cancel([job])
    assert store.note(job, row.attempt, Standing(0.1, 1, 1.0)) is True


def test_job_is_taken_over_only_if_nothing_changed(store: JobStore, books: Books) -> None:
    job = added(store, books)
    row = store.claim(job)
    assert row is not None
    store.note(job, row.attempt, Standing(0.1, 1, 1.0))
    assert not store.take_over(row)
    seen = store.find(job)
    assert seen is not None
    assert store.take_over(seen)
    assert not store.take_over(seen)
    assert store.note(job, row.attempt, Standing(0.1, 1, 1.0)) is None


def test_scenarios_belong_to_their_parent(store: JobStore, books: Books) -> None:
    parent = added(store, books, kind="sweep")
    scenarios = [new_job(parent=parent, position=position, body=None) for position in (0, 1, 2)]
    assert store.add(scenarios, books.enqueue)
    assert not store.add(scenarios, books.enqueue)
    assert [row.id for row in store.children(parent)] == [job.id for job in scenarios]
    assert [row.id for row in store.page("me", 10, None, None)] == [parent]
    assert store.count_by_state() == {("sweep", "queued"): 1}


def test_open_plans_are_told_before_one_is_admitted(store: JobStore, books: Books) -> None:
    parent = added(store, books, kind="sweep", client="ann", plans=3)
    store.add([new_job(parent=parent, position=0, body=None)], books.enqueue)
    added(store, books, client="bob")
    over = added(store, books, client="ann")
    store.finish(over, None, "done")
    told: list[OpenPlans] = []
    assert store.admit(new_job(client="ann"), books.enqueue, told.append)
    assert store.admit(new_job(client="ann"), books.enqueue, told.append)
    assert told == [OpenPlans(4, 3), OpenPlans(5, 4)]


def test_plan_that_is_refused_is_not_kept(store: JobStore, books: Books) -> None:
    job = new_job()

    def refuse(_: OpenPlans) -> None:
        raise OSError("no")

    with pytest.raises(OSError, match="no"):
        store.admit(job, books.enqueue, refuse)
    assert store.find(job.id) is None
    assert store.admit(job, books.enqueue, lambda _: None)


def test_a_key_has_one_job(store: JobStore, books: Books) -> None:
    first, second = new_job(key="k"), new_job(key="k")
    assert store.admit(first, books.enqueue, lambda _: None)
    assert not store.admit(second, books.enqueue, lambda _: pytest.fail("it is there already"))
    assert store.find(second.id) is None
    row = store.find_by_key("k")
    assert row is not None
    assert row.id == first.id
    assert store.find_by_key("other") is None


def test_as_many_are_admitted_at_once_as_may(store: JobStore, books: Books) -> None:
    def submit(_: int) -> bool:
        def refuse(there: OpenPlans) -> None:
            if there.of_client >= 5:
                raise OSError

        try:
            return store.admit(new_job(client="ann"), books.enqueue, refuse)
        except OSError:
            return False

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(submit, range(16))) == 5


def test_pages_have_the_owners_jobs_the_youngest_first(store: JobStore, books: Books) -> None:
    mine = [added(store, books) for _ in range(5)]
    added(store, books, owner="other")
    rows = store.page("me", 3, None, None)
    rest = store.page("me", 3, (rows[-1].created_at, rows[-1].id), None)
    assert {row.id for row in rows + rest} == set(mine)
    stamps = [(row.created_at, row.id) for row in rows + rest]
    assert stamps == sorted(stamps, reverse=True)
    assert store.page("me", 3, None, "done") == []


def test_expired_jobs_are_forgotten_with_all_they_have(store: JobStore, books: Books) -> None:
    parent = added(store, books, kind="sweep")
    child = new_job(parent=parent, position=0, body=None)
    store.add([child], books.enqueue)
    store.finish(child.id, None, "done", Standing(1.0, 1, 1.0, 1.0, b"1"))
    assert store.expired(now_ms() + 2000, 10) == []
    store.finish(parent, None, "done", Standing(1.0, 1, 1.0, result=b"2"))
    kept = added(store, books)
    over = store.find(parent)
    assert over is not None
    assert over.expires_at is not None
    assert store.expired(over.expires_at, 10) == []
    ids = store.expired(over.expires_at + 1, 10)
    assert set(ids) == {parent, child.id}
    store.forget(ids)
    assert store.find(parent) is store.find(child.id) is None
    assert store.result(parent) is store.result(child.id) is None
    with pytest.raises(KeyError):
        store.request(parent)
    assert store.request(kept) == b"{}"
