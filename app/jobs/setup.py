"""Starts and stops what an application needs for jobs."""

import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TypeVar

from anyio import CapacityLimiter, to_thread
from dbos import DBOS
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import is_misfit, is_outage
from app.database.durable import connect
from app.database.migrations.running import SchemaError
from app.jobs.errors import JobsUnavailableError
from app.jobs.events import Watcher
from app.jobs.planning import PlanWork
from app.jobs.queues import Queues
from app.jobs.service import JobService
from app.jobs.worker import JobEngine
from app.jobs.working import Surroundings, make_engine, make_store, open_limits
from app.observe.metrics import JobCounts
from app.pictures.scene import Scene
from app.schemas.request import PlanRequest

logger = logging.getLogger(__name__)

Result = TypeVar("Result")

THREADS = 8
"""Threads for endpoints of jobs, apart from those that plan."""

RETRY = 1.0
"""Seconds between two attempts to reach the database."""

WARMTH_POLLING = 0.1
"""Seconds between two looks whether the planner is warm."""


class JobDesk:
    """Where endpoints turn to about jobs.

    Parameters
    ----------
    around
        What jobs need of the application.
    """

    def __init__(self, around: Surroundings) -> None:
        self._around = around
        self._queues = Queues(connect(around.settings))
        self._store = make_store(around, self._queues)
        self._service = JobService(self._store, self._queues, around.reader,
                                   open_limits(around.settings), self._stop_here)
        self._engine: JobEngine | None = None
        self._plans: PlanWork | None = None
        self._is_prepared = False
        self._misfit: str | None = None
        self._has_tried = threading.Event()
        self._threads = CapacityLimiter(THREADS)
        self._drawing = CapacityLimiter(1)
        self._stopping = threading.Event()
        self._starter = threading.Thread(target=self._begin, name="job-starter", daemon=True)
        self.watcher = Watcher(lambda ids: self.ask(lambda service: service.find_all(ids)))

    def start(self) -> None:
        """Prepare the database and begin to work on jobs, in the background. In place."""
        self._around.metrics.watch_jobs(self._count)
        self._starter.start()

    def stop(self) -> None:
        """Hand back what is worked on, and end. In place."""
        self._stopping.set()
        self._starter.join()
        if self._engine is not None:
            self._engine.stop()
        self._queues.engine.dispose()

    @property
    def is_preparing(self) -> bool:
        """Tell whether the database is being prepared for the first time.

        It is over, too, once the database could not be reached: plans need none.
        """
        return not self._has_tried.is_set()

    async def misfit(self) -> str | None:
        """Return why the tables can't be used, if they were found not to fit, and still don't."""
        if self._misfit is not None and self._is_prepared:
            await to_thread.run_sync(self._look_at_tables, limiter=self._threads)
        return self._misfit

    async def ask(self, question: Callable[[JobService], Result]) -> Result:
        """Ask in a thread, as the database has to be waited for.

        Raises
        ------
        JobsUnavailableError
            If it can't be reached.
        RequestError
            If the question has no answer.
        """
        if not self._is_prepared:
            raise JobsUnavailableError(self._misfit or "The database is being prepared: try again "
                                       "soon.")
        try:
            return await to_thread.run_sync(question, self._service, limiter=self._threads)
        except SQLAlchemyError as error:
            if is_misfit(error):
                await to_thread.run_sync(self._look_at_tables, limiter=self._threads)
                raise JobsUnavailableError(self._misfit or "The database's tables have changed: "
                                           "try again.") from error
            if not is_outage(error):
                raise
            logger.warning("the database can't be reached: %s", type(error).__name__)
            raise JobsUnavailableError("The database can't be reached: try again soon.") from error

    async def picture(self, job_id: str, owner: str) -> bytes:
        """Draw a job's best plan so far as SVG, in a thread; raises as `ask` does."""
        request, plan = await self.ask(lambda service: service.plan(job_id, owner))
        return await to_thread.run_sync(_drawn, request, plan, limiter=self._drawing)

    def _begin(self) -> None:
        """Prepare the database, wait for the planner, work on jobs. In place."""
        while not self._stopping.is_set() and not self._prepare():
            self._has_tried.set()
            self._stopping.wait(RETRY)
        self._has_tried.set()
        if self._around.settings.role == "api":
            return
        while not self._around.is_warm():
            if self._stopping.wait(WARMTH_POLLING):
                return
        while not self._stopping.is_set() and not self._work():
            self._stopping.wait(RETRY)

    def _work(self) -> bool:
        """Begin to work on jobs; tell whether that went well. In place."""
        engine, plans = make_engine(self._around)
        try:
            engine.start()
        except SQLAlchemyError as error:
            logger.warning("jobs can't be worked on: %s", type(error).__name__)
            return False
        self._engine, self._plans = engine, plans
        return True

    def _prepare(self) -> bool:
        """Make the tables; tell whether that went well. In place."""
        try:
            self._store.prepare()
            DBOS.migrate(self._queues.engine.url.render_as_string(hide_password=False))
        except SchemaError as error:
            self._note_misfit(str(error))
            return False
        except SQLAlchemyError as error:
            logger.warning("the database can't be prepared: %s", type(error).__name__)
            return False
        self._note_misfit(None)
        self._is_prepared = True
        return True

    def _look_at_tables(self) -> None:
        """See whether the tables fit, as far as the database can be reached. In place."""
        with suppress(SQLAlchemyError):
            self._note_misfit(self._store.find_misfit())

    def _note_misfit(self, misfit: str | None) -> None:
        if misfit is not None and misfit != self._misfit:
            logger.error("%s", misfit)
        self._misfit = misfit

    def _stop_here(self, job_id: str) -> None:
        if self._plans is not None:
            self._plans.cancel(job_id)

    def _count(self) -> JobCounts:
        """Return the number of jobs by kind and state; none while they can't be counted."""
        try:
            return self._store.count_by_state() if self._is_prepared else {}
        except SQLAlchemyError as error:
            logger.warning("jobs can't be counted: %s", type(error).__name__)
            return {}


@contextmanager
def running_jobs(around: Surroundings) -> Iterator[JobDesk]:
    """Yield where endpoints turn to; jobs are worked on until the block ends."""
    desk = JobDesk(around)
    desk.start()
    try:
        yield desk
    finally:
        desk.stop()


def _drawn(request: PlanRequest, plan: bytes) -> bytes:
    # Imported here: the service needn't wait for matplotlib at its start.
    from app.pictures.drawing import draw_svg

    return draw_svg(Scene.replied(request, plan))
