"""Where endpoints turn to about jobs: nothing here waits for the database on the event loop."""

import logging
from collections.abc import Callable, Sequence
from typing import TypeVar

from anyio import CapacityLimiter, to_thread
from sqlalchemy.exc import SQLAlchemyError

from app.maps.airspace.zone import Zone
from app.plans.pictures.scene import DrawnPlan
from app.records.jobs.errors import JobsUnavailableError
from app.records.jobs.events import Watcher
from app.records.jobs.queues import Queues
from app.records.jobs.service import JobService
from app.records.jobs.store import JobStore
from app.records.prepared import PreparedDatabase
from app.records.threads import DatabaseThreads
from app.schemas.request import PlanRequest
from app.serving.observe.metrics import JobCounts

logger = logging.getLogger(__name__)

Result = TypeVar("Result")

THREADS = 8


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
    zones
        Those that hold for all requests, for pictures.
    """

    def __init__(self, store: JobStore, queues: Queues, service: JobService,
                 zones: Sequence[Zone]) -> None:
        def make_tables() -> None:
            store.prepare()
            queues.prepare()

        threads = DatabaseThreads(queues.engine, THREADS, JobsUnavailableError)
        self.database = PreparedDatabase(threads, make_tables, store.find_misfit)
        self.queues = queues
        self._store = store
        self._service = service
        self._zones = zones
        self._drawing = CapacityLimiter(1)
        self.watcher = Watcher(lambda ids: self.ask(lambda service: service.find_all(ids)))

    async def ask(self, question: Callable[[JobService], Result]) -> Result:
        """Ask about jobs in a thread; raises as the database's `reach` does."""
        return await self.database.reach(lambda _: question(self._service))

    async def picture(self, job_id: str, owner: str) -> bytes:
        """Draw a job's best plan so far as SVG, in a thread; raises as `ask` does."""
        request, plan = await self.ask(lambda service: service.plan(job_id, owner))
        return await to_thread.run_sync(_drawn, request, plan, self._zones,
                                       limiter=self._drawing)

    def count(self) -> JobCounts:
        """Return the number of jobs by kind and state; none while they can't be counted."""
        try:
            return self._store.count_by_state() if self.database.is_prepared else {}
        except SQLAlchemyError as error:
            logger.warning("jobs can't be counted: %s", type(error).__name__)
            return {}


def _drawn(request: PlanRequest, plan: bytes, zones: Sequence[Zone]) -> bytes:
    # Imported here: the service needn't wait for matplotlib at its start.
    from app.plans.pictures.drawing import draw_svg

    return draw_svg(DrawnPlan.replied(request, plan, zones))
