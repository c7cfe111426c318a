"""Server-sent events of jobs, whichever process works on them."""

import asyncio
import logging
from collections import Counter
from collections.abc import AsyncGenerator, Awaitable, Callable, Collection, Iterable
from contextlib import aclosing, suppress

from pydantic_core import to_json
from sse_starlette import ServerSentEvent

from app.records.jobs.replies import progress, summary
from app.records.jobs.rows import JobRow
from app.schemas.errors import RequestError

logger = logging.getLogger(__name__)

PERIOD = 0.2
"""Seconds between two looks at the jobs that are followed."""

ADMISSION_PERIOD = 1.0
"""Seconds between two looks whether whoever follows a job still may."""


class Watcher:
    """Looks at the rows of all jobs that are followed, once for all who follow.

    Parameters
    ----------
    find_all
        Returns the jobs with the given ids; a `RequestError` means that they can't be read now.
    """

    def __init__(self, find_all: Callable[[Collection[str]], Awaitable[list[JobRow]]]) -> None:
        self._find_all = find_all
        self._followers: Counter[str] = Counter()
        self._latest: dict[str, JobRow | None] = {}  # None: no telling
        self._news = asyncio.Condition()
        self._looking: asyncio.Task[None] | None = None

    async def follow(self, row: JobRow) -> AsyncGenerator[JobRow]:
        """Yield a job now and after each change, until it is over, deleted or can't be read."""
        self._followers[row.id] += 1
        if self._looking is None:
            self._looking = asyncio.create_task(self._look())
        current: JobRow | None = row
        try:
            while current is not None:
                yield current
                if current.is_over:
                    return
                current = await self._changed(current)
        finally:
            self._followers[row.id] -= 1
            if not self._followers[row.id]:
                del self._followers[row.id]
                self._latest.pop(row.id, None)

    async def _changed(self, row: JobRow) -> JobRow | None:
        """Return a job once it differs from what is known of it; None if there is no telling."""
        async with self._news:
            while True:
                latest = self._latest.get(row.id, row)
                if latest is None or latest.revision > row.revision:
                    return latest
                await self._news.wait()

    async def _look(self) -> None:
        try:
            while self._followers:
                ids = list(self._followers)
                with suppress(RequestError):
                    await self._tell(ids, await self._find_all(ids))
                await asyncio.sleep(PERIOD)
        except Exception:  # whatever it was, nobody may wait for news that don't come
            logger.exception("jobs can't be followed")
            self._looking = None  # whoever comes from now on has them looked at anew
            await self._tell(list(self._followers), [])
        else:
            self._looking = None

    async def _tell(self, ids: Collection[str], rows: Iterable[JobRow]) -> None:
        """Let followers know which of the jobs there are, and how they stand. In place."""
        found = {row.id: row for row in rows}
        async with self._news:
            self._latest = {job_id: found.get(job_id) for job_id in ids
                            if job_id in self._followers}
            self._news.notify_all()


async def while_admitted(stream: AsyncGenerator[ServerSentEvent],
                         is_admitted: Callable[[], Awaitable[bool]]
                         ) -> AsyncGenerator[ServerSentEvent]:
    """Yield what `stream` does, until whoever reads it may not any more."""
    async with aclosing(stream):
        while await is_admitted():
            coming = asyncio.ensure_future(anext(stream, None))
            try:
                while not (await asyncio.wait({coming}, timeout=ADMISSION_PERIOD))[0]:
                    if not await is_admitted():
                        return
            finally:
                await _given_up(coming)
            event = coming.result()
            if event is None:
                return
            yield event


async def _given_up(coming: asyncio.Future[ServerSentEvent | None]) -> None:
    """Wait no longer for an event, so that its stream can be closed. In place."""
    if not coming.done():
        coming.cancel()
        with suppress(asyncio.CancelledError):
            await coming


async def events(watcher: Watcher, row: JobRow, seen: int) -> AsyncGenerator[ServerSentEvent]:
    """Yield the events of a job.

    Their numbers are the job's revisions, the same in every process: what has changed while nobody
    followed is told by the first event. Without an `end`, the client is to come again.

    Parameters
    ----------
    watcher
        Where to hear of changes.
    row
        The job.
    seen
        Number of the last event that the client knows; 0: none.
    """
    last = row
    async with aclosing(watcher.follow(row)) as rows:
        async for last in rows:
            if last.revision > seen:
                yield ServerSentEvent(to_json(progress(last, seen)).decode(), event="progress",
                                      id=str(last.revision))
                seen = last.revision
    if last.is_over:
        yield ServerSentEvent(to_json(summary(last)).decode(), event="end", id=str(last.revision))
