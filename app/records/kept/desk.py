"""Where endpoints turn to about kept plans: the database is waited for in threads of their own."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TypeVar

from app.database.connections import close_for_good
from app.database.durable import connect
from app.records.kept.errors import KeptUnavailableError
from app.records.kept.rows import KeptRoom
from app.records.kept.store import KeptStore
from app.records.threads import DatabaseThreads
from app.serving.settings import Settings

Result = TypeVar("Result")

THREADS = 4

MISFIT = "The database's tables don't fit: see 'tandem database show'."

DAY_MS = 86_400_000


class KeptDesk:
    """Asks about kept plans; the tables are prepared at the first question."""

    def __init__(self, store: KeptStore) -> None:
        self._store = store
        self._threads = DatabaseThreads(store.engine, THREADS, KeptUnavailableError)
        self._preparing = threading.Lock()
        self._is_prepared = False

    async def ask(self, question: Callable[[KeptStore], Result]) -> Result:
        """Ask in a thread.

        Raises
        ------
        KeptUnavailableError
            If the database can't be used.
        RequestError
            If the question has no answer.
        """
        return await self._threads.run(partial(self._answer, question), lambda: MISFIT)

    def _answer(self, question: Callable[[KeptStore], Result]) -> Result:
        with self._preparing:
            if not self._is_prepared:
                self._store.prepare()
                self._is_prepared = True
        return question(self._store)


@contextmanager
def keeping_plans(settings: Settings) -> Iterator[KeptDesk]:
    """Yield where endpoints turn to; the database is open until the block ends."""
    days = settings.kept_plan_days
    room = KeptRoom(settings.max_kept_plans, settings.max_kept_bytes,
                    None if days is None else int(days * DAY_MS))
    engine = connect(settings.database)
    try:
        yield KeptDesk(KeptStore(engine, room))
    finally:
        close_for_good(engine)
