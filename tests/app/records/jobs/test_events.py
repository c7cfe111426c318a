"""How followers of jobs hear of changes."""

import asyncio
from collections.abc import Collection

import pytest

from app.records.jobs.errors import JobsUnavailableError
from app.records.jobs.events import Watcher, events
from app.records.jobs.rows import JobRow
from tests.conftest import PATIENCE, complete

pytestmark = pytest.mark.slow

ROW = JobRow(
    id="j", kind="plan", owner="me", state="running", parent=None, position=None, fingerprint="f",
    webhook=None, created_at=0, started_at=0, finished_at=None, expires_at=None, progress=0.0,
    cost=None, search_iterations=0, searched=0.0, error=None, cancel_requested=False, revision=5,
    improved_revision=0, attempt=1, crashes=0)


class Jobs:
    """Jobs as they are looked up; each look brings what is next."""

    def __init__(self, *looks: JobRow | Exception | None) -> None:
        self.looks = list(looks)
        self.asked: list[Collection[str]] = []

    async def find_all(self, ids: Collection[str]) -> list[JobRow]:
        """Return what is next; the last stays."""
        self.asked.append(ids)
        look = self.looks.pop(0) if len(self.looks) > 1 else self.looks[0]
        if isinstance(look, Exception):
            raise look
        return [] if look is None else [look]


def told(jobs: Jobs, row: JobRow = ROW, seen: int = 0, followers: int = 1) -> list[list[str]]:
    """Return the events that each follower gets, as number and name."""
    async def follow(watcher: Watcher) -> list[str]:
        return [f"{event.id} {event.event}" async for event in events(watcher, row, seen)]

    async def follow_all() -> list[list[str]]:
        watcher = Watcher(jobs.find_all)
        return await asyncio.gather(*(follow(watcher) for _ in range(followers)))

    return complete(follow_all())


def test_each_change_is_told_once_and_then_the_end() -> None:
    jobs = Jobs(ROW, ROW._replace(revision=6), ROW._replace(revision=6),
                ROW._replace(revision=9, state="done"))
    assert told(jobs) == [["5 progress", "6 progress", "9 progress", "9 end"]]


def test_job_is_looked_up_once_for_all_who_follow() -> None:
    jobs = Jobs(ROW._replace(revision=6), ROW._replace(revision=7, state="failed"))
    assert told(jobs, followers=20) == 20 * [["5 progress", "6 progress", "7 progress", "7 end"]]
    assert jobs.asked == [["j"], ["j"]]


def test_what_was_seen_is_not_told_again() -> None:
    assert told(Jobs(ROW._replace(revision=6, state="done")), seen=5) == [["6 progress", "6 end"]]
    over = ROW._replace(state="done")
    assert told(Jobs(over), over, seen=5) == [["5 end"]]


def test_outage_of_the_database_ends_nothing() -> None:
    jobs = Jobs(JobsUnavailableError("down"), ROW._replace(revision=6, state="done"))
    assert told(jobs) == [["5 progress", "6 progress", "6 end"]]


def test_unforeseen_error_ends_the_stream_and_the_next_one_goes_on() -> None:
    async def follow_twice() -> tuple[list[str], list[str]]:
        watcher = Watcher(Jobs(ValueError("no row"),
                               ROW._replace(revision=6, state="done")).find_all)

        async def follow(seen: int) -> list[str]:
            return [f"{event.id} {event.event}" async for event in events(watcher, ROW, seen)]

        async with asyncio.timeout(PATIENCE):
            first, = {tuple(told) for told in await asyncio.gather(follow(0), follow(0))}
            return list(first), await follow(5)

    assert complete(follow_twice()) == (["5 progress"], ["6 progress", "6 end"])


def test_deleted_job_ends_without_an_end() -> None:
    assert told(Jobs(None)) == [["5 progress"]]


def test_nobody_is_looked_up_when_all_have_left() -> None:
    async def leave() -> int:
        jobs = Jobs(ROW)
        watcher = Watcher(jobs.find_all)
        stream = watcher.follow(ROW)
        await anext(stream)
        await stream.aclose()
        tasks = asyncio.all_tasks() - {asyncio.current_task()}
        await asyncio.wait(tasks, timeout=PATIENCE)
        assert all(task.done() for task in tasks)
        return len(jobs.asked)

    assert complete(leave()) <= 1
