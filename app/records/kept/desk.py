"""Where endpoints turn to about kept plans: the database is waited for in threads of their own."""

import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from anyio import CapacityLimiter, to_thread
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import close_for_good, is_misfit, is_outage
from app.database.durable import connect
from app.database.files import why_unreachable
from app.database.migrations.running import SchemaError
from app.records.kept.errors import KeptUnavailableError
from app.records.kept.rows import Room
from app.records.kept.store import KeptStore
from app.serving.settings import Settings

logger = logging.getLogger(__name__)

Result = TypeVar("Result")

THREADS = 4

DAY_MS = 86_400_000


class KeptDesk:
    """Asks about kept plans; the tables are prepared at the first question."""

    def __init__(self, store: KeptStore) -> None:
        self._store = store
        self._threads = CapacityLimiter(THREADS)
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
        try:
            return await to_thread.run_sync(self._answer, question, limiter=self._threads)
        except SchemaError as error:
            raise KeptUnavailableError(str(error)) from error
        except SQLAlchemyError as error:
            if is_misfit(error):
                raise KeptUnavailableError("The database's tables don't fit: see 'tandem database "
                                           "show'.") from error
            if not is_outage(error):
                raise
            # The class alone: messages may repeat the URL, and so its password.
            logger.warning("the database can't be reached: %s", type(error).__name__)
            raise KeptUnavailableError(why_unreachable(self._store.engine)) from error

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
    room = Room(settings.max_kept_plans, settings.max_kept_bytes,
                None if days is None else int(days * DAY_MS))
    engine = connect(settings.database)
    try:
        yield KeptDesk(KeptStore(engine, room))
    finally:
        close_for_good(engine)
