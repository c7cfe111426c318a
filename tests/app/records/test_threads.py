"""Threads in which endpoints wait for the database."""

import asyncio
import threading
from functools import partial

from sqlalchemy import create_engine

from app.records.jobs.errors import JobsUnavailableError
from app.records.threads import DatabaseThreads
from tests.conftest import complete

ASKED = 50


def test_whoever_asks_first_is_answered_first() -> None:
    answered: list[int] = []
    may_begin = threading.Event()

    def answer(number: int) -> None:
        may_begin.wait()
        answered.append(number)

    async def ask() -> None:
        threads = DatabaseThreads(create_engine("sqlite://"), 1, JobsUnavailableError)
        async with asyncio.TaskGroup() as group:
            for number in range(ASKED):
                group.create_task(threads.run(partial(answer, number), str))
            await asyncio.sleep(0)
            may_begin.set()

    complete(ask())
    assert answered == list(range(ASKED))
