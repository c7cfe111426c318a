"""Puts together what works on jobs in a process."""

import socket
from collections.abc import Callable
from dataclasses import dataclass

from app.database.connections import database_url
from app.database.durable import connect
from app.jobs.housekeeping import Warden
from app.jobs.identity import Identity, take_identity
from app.jobs.planning import PlanWork
from app.jobs.queues import Queues
from app.jobs.reading import JobReader
from app.jobs.schemas import Data
from app.jobs.service import JobService, OpenLimits
from app.jobs.store import JobStore
from app.jobs.studies import StudyWork
from app.jobs.webhook import Caller, may_call_private
from app.jobs.worker import Duties, JobEngine
from app.observe.metrics import Metrics
from app.settings import Settings
from model.planner import Planner

HOUR_MS = 3_600_000

LOCKS = "workers"
"""Folder, in that for data, with the names that processes hold."""


@dataclass(frozen=True)
class Surroundings:
    """What jobs need of the application around them."""

    settings: Settings
    planner: Planner
    is_warm: Callable[[], bool]  # whether the planner is
    metrics: Metrics
    on_plan: Callable[[Data], None]  # is told of each plan made

    @property
    def reader(self) -> JobReader:
        """What reads requests."""
        return JobReader(self.planner.policies, self.settings)


def open_limits(settings: Settings) -> OpenLimits:
    """Return how many plans may be open."""
    return OpenLimits(settings.max_open_jobs, settings.max_open_jobs_per_client)


def make_store(around: Surroundings, queues: Queues) -> JobStore:
    """Return the jobs in the database."""
    return JobStore(queues.engine, int(around.settings.job_expiry_hours * HOUR_MS),
                    queues.add_webhook, around.metrics.count_finished_job)


def make_engine(around: Surroundings) -> tuple[JobEngine, PlanWork]:
    """Return an engine and the plans that it works on.

    It has connections of its own: it refuses to make any when it has stopped.
    """
    settings, reader = around.settings, around.reader
    queues = Queues(connect(settings))
    store = make_store(around, queues)
    plans = PlanWork(around.planner, store, lambda row: reader.plan_request(store, row),
                     settings.search_threads, lambda job_id: queues.put_back(job_id, True),
                     around.on_plan)
    service = JobService(store, queues, reader, open_limits(settings), plans.cancel)
    studies = StudyWork(store, lambda row: reader.scenarios(store, row),
                        lambda jobs: store.add(jobs, queues.add_job), service.stop_jobs,
                        lambda job_id: queues.put_back(job_id, False))
    duties = Duties(store, plans, studies, Warden(store, queues), _caller(settings),
                    settings.job_slots)
    return JobEngine(queues.engine, _identity(settings), duties), plans


def _identity(settings: Settings) -> Identity:
    is_local = database_url(settings).get_backend_name() == "sqlite"
    worker = settings.worker_id or ("local" if is_local else socket.gethostname())
    return take_identity(worker, settings.data_dir / LOCKS)


def _caller(settings: Settings) -> Caller | None:
    if settings.webhook_secret is None:
        return None
    return Caller(settings.webhook_secret, may_call_private(settings))
