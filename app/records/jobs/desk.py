"""Where endpoints turn to about jobs: nothing here waits for the database on the event loop."""

import logging
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from anyio import CapacityLimiter, to_thread
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import is_misfit, is_outage
from app.database.files import GONE, Identity, file_of, why_unreachable
from app.database.migrations.running import SchemaError
from app.plans.pictures.scene import Scene
from app.records.jobs.errors import JobsUnavailableError
from app.records.jobs.events import Watcher
from app.records.jobs.queues import Queues
from app.records.jobs.service import JobService
from app.records.jobs.store import JobStore
from app.schemas.request import PlanRequest
from app.serving.observe.metrics import JobCounts

logger = logging.getLogger(__name__)

Result = TypeVar("Result")

THREADS = 8
"""Threads for endpoints of jobs, apart from those that plan."""


class JobDesk:
    """Asks about jobs in threads, once the database is prepared.

    Parameters
    ----------
    store
        Where jobs are kept.
    queues
        Where they wait.
    service
        What answers.
    """

    def __init__(self, store: JobStore, queues: Queues, service: JobService) -> None:
        self._store = store
        self._queues = queues
        self._service = service
        self._is_prepared = False
        self._misfit: str | None = None
        self._file: Identity = None
        self._has_tried = threading.Event()
        self._threads = CapacityLimiter(THREADS)
        self._drawing = CapacityLimiter(1)
        self.watcher = Watcher(lambda ids: self.ask(lambda service: service.find_all(ids)))

    def prepare(self) -> bool:
        """Make the tables, or bring them to this version; tell whether that went well. In place."""
        try:
            self._store.prepare()
            self._queues.prepare()
        except SchemaError as error:
            self._note_misfit(str(error))
        except SQLAlchemyError as error:
            logger.warning("the database can't be prepared: %s", type(error).__name__)
        else:
            self._note_misfit(None)
            self._file = file_of(self._queues.engine)
            self._is_prepared = True
        self._has_tried.set()
        return self._is_prepared

    @property
    def is_preparing(self) -> bool:
        """Tell whether the database is being prepared for the first time.

        It is over, too, once the database could not be reached: plans need none.
        """
        return not self._has_tried.is_set()

    async def misfit(self) -> str | None:
        """Return why the tables can't be used, if they were found not to fit, and still don't."""
        if not self._is_prepared:
            return self._misfit
        file = file_of(self._queues.engine)
        if file is None:
            return GONE
        if self._misfit is not None or file != self._file:
            await to_thread.run_sync(self._look_at_tables, limiter=self._threads)
            self._file = file
        return self._misfit

    async def ask(self, question: Callable[[JobService], Result]) -> Result:
        """Ask about jobs in a thread; raises as `reach` does."""
        return await self.reach(lambda _: question(self._service))

    async def reach(self, work: Callable[[Engine], Result]) -> Result:
        """Do `work` in a thread, as the database has to be waited for.

        Raises
        ------
        JobsUnavailableError
            If it can't be reached.
        RequestError
            If the work can't be done.
        """
        if not self._is_prepared:
            raise JobsUnavailableError(self._misfit or "The database is being prepared: try again "
                                       "soon.")
        try:
            return await to_thread.run_sync(work, self._queues.engine, limiter=self._threads)
        except SQLAlchemyError as error:
            if is_misfit(error):
                await to_thread.run_sync(self._look_at_tables, limiter=self._threads)
                raise JobsUnavailableError(self._misfit or "The database's tables have changed: "
                                           "try again.") from error
            if not is_outage(error):
                raise
            logger.warning("the database can't be reached: %s", type(error).__name__)
            raise JobsUnavailableError(why_unreachable(self._queues.engine)) from error

    async def picture(self, job_id: str, owner: str) -> bytes:
        """Draw a job's best plan so far as SVG, in a thread; raises as `ask` does."""
        request, plan = await self.ask(lambda service: service.plan(job_id, owner))
        return await to_thread.run_sync(_drawn, request, plan, limiter=self._drawing)

    def count(self) -> JobCounts:
        """Return the number of jobs by kind and state; none while they can't be counted."""
        try:
            return self._store.count_by_state() if self._is_prepared else {}
        except SQLAlchemyError as error:
            logger.warning("jobs can't be counted: %s", type(error).__name__)
            return {}

    def _look_at_tables(self) -> None:
        """See whether the tables fit, as far as the database can be reached. In place."""
        with suppress(SQLAlchemyError):
            self._note_misfit(self._store.find_misfit())

    def _note_misfit(self, misfit: str | None) -> None:
        if misfit is not None and misfit != self._misfit:
            logger.error("%s", misfit)
        self._misfit = misfit


def _drawn(request: PlanRequest, plan: bytes) -> bytes:
    # Imported here: the service needn't wait for matplotlib at its start.
    from app.plans.pictures.drawing import draw_svg

    return draw_svg(Scene.replied(request, plan))
