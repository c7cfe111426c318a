"""Puts together what an application needs for jobs, and starts and stops it."""

import logging
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.database.connections import close_for_good
from app.database.durable import connect
from app.plans.desk import PlanDesk
from app.records.jobs.asked import TaskMaker
from app.records.jobs.desk import JobDesk
from app.records.jobs.divided import DividedWork
from app.records.jobs.housekeeping import Housekeeper
from app.records.jobs.order import validate
from app.records.jobs.planning import PlanWork
from app.records.jobs.queues import DIVIDED, PLANS, STUDIES, SUSPECTS, WAITING, Queues
from app.records.jobs.reading import JobReader
from app.records.jobs.rows import NewJob
from app.records.jobs.running import RegionTerms, Returning
from app.records.jobs.service import JobService, OpenLimits
from app.records.jobs.store import JobStore
from app.records.jobs.studies import StudyWork
from app.records.jobs.webhook import Caller, Message, may_call_private
from app.records.jobs.worker import Worker
from app.serving.observe.metrics import Metrics, countable
from app.serving.settings import Settings

logger = logging.getLogger(__name__)

HOUR_MS = 3_600_000

RETRY = 1.0
"""Seconds between two attempts to reach the database."""


def nothing_elsewhere(_: Engine, __: str) -> None:
    """Return no message."""


@contextmanager
def running_jobs(settings: Settings, planning: PlanDesk, metrics: Metrics,
                 on_plan: Callable[[Mapping[str, Any]], None],
                 also_expire: Sequence[Callable[[Engine], None]] = (),
                 elsewhere: Callable[[Engine, str], Message | None] = nothing_elsewhere,
                 ) -> Iterator[JobDesk]:
    """Yield where endpoints turn to; jobs are worked on until the block ends.

    Parameters
    ----------
    settings
        How to run.
    planning
        Who has plans made.
    metrics
        Where jobs are counted.
    on_plan
        Is told of each plan made.
    also_expire
        What else deletes what has expired, besides jobs.
    elsewhere
        Returns messages to webhooks that aren't about jobs, by their names.
    """
    roads = planning.roads
    queues = Queues(connect(settings.database))
    store = JobStore(queues.engine, int(settings.job_expiry_hours * HOUR_MS), queues.add_webhook,
                     metrics.count_finished_job)
    reader = JobReader(planning.policies, settings, roads)
    asking = TaskMaker(partial(reader.plan_request, store), settings.search_threads, roads)
    returning = Returning(*(partial(queues.put, queue=queue)
                            for queue in (PLANS, WAITING, DIVIDED)))
    terms = RegionTerms(settings.region_from, settings.region_customers, settings.region_seconds)
    plans = PlanWork(planning.begin, store, asking, returning, on_plan, terms)
    limits = OpenLimits(settings.max_open_jobs, settings.max_open_jobs_per_client)
    service = JobService(store, queues, reader, limits, lambda job_id: stop_here(job_id),
                         lambda kind, body, should_stop: planning.check(
                             validate, kind, body, should_stop=should_stop))

    def add(jobs: Sequence[NewJob]) -> bool:
        return store.add(jobs, queues.add_job)

    divided = DividedWork(store, asking, terms, add, service.stop_jobs, returning,
                          lambda job_id: queues.is_in(job_id, DIVIDED)
                          or queues.is_in(job_id, SUSPECTS),
                          lambda reply: on_plan(countable(reply)))
    studies = StudyWork(store, lambda row: reader.scenarios(store, row), add, service.stop_jobs,
                        lambda job_id: queues.put(job_id, STUDIES))

    def stop_here(job_id: str) -> None:
        plans.cancel(job_id)
        divided.cancel(job_id)

    housekeeper = Housekeeper(store, queues, also_expire, asking.forget_unused)
    worker = Worker(settings, store, queues, plans, divided, studies, housekeeper,
                    _caller(settings), partial(elsewhere, queues.engine))
    desk = JobDesk(store, queues, service, roads.zones)
    metrics.watch_jobs(desk.count)
    with _started(desk, worker, queues.engine, is_working=settings.role != "api"):
        yield desk


@contextmanager
def _started(desk: JobDesk, worker: Worker, engine: Engine, is_working: bool) -> Iterator[None]:
    """Have the database prepared, and jobs worked on if so wanted, until the block ends."""
    stopping = threading.Event()
    starter = threading.Thread(target=_start, name="job-starter", daemon=True, args=(
        desk, worker if is_working else None, stopping))
    starter.start()
    try:
        yield
    finally:
        stopping.set()
        starter.join()
        worker.stop()
        close_for_good(engine)


def _start(desk: JobDesk, worker: Worker | None, stopping: threading.Event) -> None:
    """Prepare the database, then work on jobs. In place."""
    while not stopping.is_set() and not desk.database.prepare():
        stopping.wait(RETRY)
    if worker is None:
        return
    while not stopping.is_set() and not _has_started(worker):
        stopping.wait(RETRY)


def _has_started(worker: Worker) -> bool:
    """Have jobs worked on; tell whether that went well. In place."""
    try:
        worker.start()
    except SQLAlchemyError as error:
        logger.warning("jobs can't be worked on: %s", type(error).__name__)
        return False
    return True


def _caller(settings: Settings) -> Caller | None:
    if settings.webhook_secret is None:
        return None
    return Caller(settings.webhook_secret, may_call_private(settings))
