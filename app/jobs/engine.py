"""The engine that works on jobs in this process: DBOS with our workflows, queues and schedule.

DBOS is one per process, so the engine is too.
"""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from datetime import datetime
from typing import Any

from dbos import DBOS, DBOSConfig, EnqueueOptions, ScheduleInput, StepOptions
from pydantic_core import to_json
from sqlalchemy import Engine, event
from sqlalchemy.exc import DBAPIError, SQLAlchemyError

from app.database.connections import is_misfit, is_outage
from app.jobs.housekeeping import Warden
from app.jobs.identity import Identity
from app.jobs.planning import NOT_COMPUTED, PlanWork, Slice, Stopping
from app.jobs.queues import (
    APPLICATION, APPLICATION_VERSION, EXPIRY_WORKFLOW, FORMER_WEBHOOKS, PLAN_WORKFLOW, PLANS,
    SERIALIZER, STUDIES, STUDY_WORKFLOW, WEBHOOK_WORKFLOW, WEBHOOKS, webhook_options,
)
from app.jobs.replies import summary
from app.jobs.store import JobStore
from app.jobs.studies import StudyWork
from app.jobs.webhook import Caller, UnreachableError, wait_after

logger = logging.getLogger(__name__)

POLLING, FORMER_POLLING = 0.2, 5.0
"""Seconds between two looks into a queue, and into one that nothing is added to any more."""

STUDIES_AT_ONCE, WEBHOOKS_AT_ONCE = 100, 20

CALLS_OF_A_HOST = 2
"""Of all webhooks called at once: a host that is slow to answer keeps the places of no other."""

WARDEN_PERIOD = 5.0
"""Seconds between two looks for jobs whose process is gone."""

EXPIRY_TIMES = "*/5 * * * *"

STOP_PATIENCE = 5.0
"""Seconds that searches may take to end when the process does."""

RETRY = 1.0
"""Seconds between two attempts while the database can't be reached."""

OUTAGE_ATTEMPTS = 100_000

_ONE_PER_PROCESS = threading.Lock()


@dataclass(frozen=True)
class Duties:
    """What an engine does."""

    store: JobStore
    plans: PlanWork
    studies: StudyWork
    warden: Warden
    caller: Caller | None  # None: no webhooks are called
    slots: int  # plans at once


class JobEngine:
    """Works on jobs until it is stopped.

    Parameters
    ----------
    engine
        Connections to the database, for this engine alone.
    identity
        The name of this process.
    duties
        What to do.
    """

    def __init__(self, engine: Engine, identity: Identity, duties: Duties) -> None:
        self._engine = engine
        self._identity = identity
        self._duties = duties
        self._stopping = threading.Event()
        self._watch = threading.Thread(target=self._look_after_others, name="job-warden",
                                       daemon=True)
        self._step: StepOptions = {
            # An outage of the database ends no job: the search goes on meanwhile.
            "retries_allowed": True, "interval_seconds": RETRY, "backoff_rate": 1.0,
            "max_attempts": OUTAGE_ATTEMPTS, "should_retry": self._is_outage,
        }

    def start(self) -> None:
        """Take jobs from now on. In place.

        Raises
        ------
        RuntimeError
            If this process has an engine already.
        SQLAlchemyError
            If the database can't be reached; then nothing has begun.
        """
        if not _ONE_PER_PROCESS.acquire(blocking=False):
            raise RuntimeError("this process works on jobs already: give others TANDEM_ROLE=api")
        try:
            self._launch()
        except SQLAlchemyError:
            self._end()
            raise
        self._watch.start()
        logger.info("working on jobs as %s, %d at once", self._identity.name, self._duties.slots)

    def stop(self) -> None:
        """Hand back what is worked on, and end. In place."""
        self._stopping.set()
        self._duties.plans.stop()
        self._duties.studies.stop()
        deadline = time.monotonic() + STOP_PATIENCE
        while not (self._duties.plans.is_idle and self._duties.studies.is_idle):
            if time.monotonic() > deadline:
                break
            time.sleep(0.01)
        self._end()

    def _launch(self) -> None:
        DBOS(config=self._config())
        self._register()
        DBOS.launch()
        for queue, limit in ((PLANS, self._duties.slots), (STUDIES, STUDIES_AT_ONCE)):
            DBOS.register_queue(queue, worker_concurrency=limit, polling_interval_sec=POLLING)
        DBOS.register_queue(WEBHOOKS, worker_concurrency=WEBHOOKS_AT_ONCE,
                            partition_worker_concurrency=CALLS_OF_A_HOST,
                            polling_interval_sec=POLLING)
        DBOS.register_queue(FORMER_WEBHOOKS, worker_concurrency=CALLS_OF_A_HOST,
                            polling_interval_sec=FORMER_POLLING)
        DBOS.apply_schedules([self._expiry])

    def _end(self) -> None:
        DBOS.destroy(destroy_registry=True)
        # Workflows taken over by another process wait for its outcome in threads that would
        # outlive this engine.
        event.listen(self._engine, "do_connect", _refuse)
        self._engine.dispose()
        self._identity.release()
        _ONE_PER_PROCESS.release()

    def _config(self) -> DBOSConfig:
        return {
            "name": APPLICATION,
            "system_database_engine": self._engine,
            "application_version": APPLICATION_VERSION,
            "executor_id": self._identity.name,
            "serializer": SERIALIZER,
            "log_level": "ERROR",
            "enable_otlp": False,
            "notification_listener_polling_interval_sec": 1.0,
        }

    def _register(self) -> None:
        """Tell DBOS the workflows. In place."""
        # Attempts are counted in the jobs' own rows, where progress sets them back to none.
        @DBOS.workflow(name=PLAN_WORKFLOW, max_recovery_attempts=None)
        def plan_job(job_id: str) -> None:
            self._work(job_id, self._duties.plans.advance)

        @DBOS.workflow(name=STUDY_WORKFLOW, max_recovery_attempts=None)
        def study_job(job_id: str) -> None:
            self._work(job_id, self._duties.studies.advance)

        @DBOS.workflow(name=WEBHOOK_WORKFLOW)
        def call_webhook(job_id: str, failures: int) -> None:
            self._call_webhook(job_id, failures)

        @DBOS.workflow(name=EXPIRY_WORKFLOW)
        def expire_jobs(scheduled_at: datetime, context: Any) -> None:
            self._duties.warden.expire()
            self._duties.warden.reconcile()

        self._expiry: ScheduleInput = {"schedule_name": EXPIRY_WORKFLOW, "schedule": EXPIRY_TIMES,
                                       "workflow_fn": expire_jobs}

    def _work(self, job_id: str, advance: Callable[[str], Slice]) -> None:
        """Work on a job, slice by slice, each a checkpoint. In place."""
        def slice_of_work(job_id: str) -> dict[str, Any]:
            return asdict(advance(job_id))

        try:
            while not DBOS.run_step(self._step, slice_of_work, job_id)["over"]:
                pass
        except Exception as error:  # whatever was not foreseen ends this job, not the process
            if self._stopping.is_set():
                raise Stopping from error
            logger.exception("job %s failed", job_id)
            self._duties.plans.drop(job_id)
            self._duties.studies.drop(job_id)
            self._duties.store.finish(job_id, None, "failed", error=NOT_COMPUTED)

    def _call_webhook(self, job_id: str, failures: int) -> None:
        """Call a job's webhook, or enqueue a later call. In place."""
        problem = DBOS.run_step(self._step, self._call, job_id)
        if problem is None:
            return
        wait = wait_after(failures + 1)
        logger.warning("webhook of job %s: %s; %s", job_id, problem,
                       "given up" if wait is None else f"tried again after {wait:g} s")
        url = DBOS.run_step(self._step, self._webhook, job_id)
        if wait is not None and url is not None:
            options: EnqueueOptions = {**webhook_options(job_id, url, failures + 1),
                                       "delay_seconds": wait}
            DBOS.enqueue_workflow_with_options(options, job_id, failures + 1)

    def _webhook(self, job_id: str) -> str | None:
        """Return a job's webhook, if it is there and over."""
        row = self._duties.store.find(job_id)
        return row.webhook if row is not None and row.is_over else None

    def _call(self, job_id: str) -> str | None:
        """Call a job's webhook; return what went wrong."""
        row = self._duties.store.find(job_id)
        if row is None or row.webhook is None or not row.is_over:
            return None
        if self._duties.caller is None:
            return "there is no TANDEM_WEBHOOK_SECRET to sign it with"
        finished = summary(row)
        body = to_json({"type": f"job.{row.state}", "timestamp": finished["finished_at"],
                        "data": finished}).decode()
        try:
            self._duties.caller.call(row.webhook, f"msg_{job_id}", body)
        except UnreachableError as error:
            return str(error)
        return None

    def _look_after_others(self) -> None:
        while not self._stopping.wait(WARDEN_PERIOD):
            try:
                self._duties.warden.look(time.monotonic())
            except DBAPIError as error:
                logger.warning("the database can't be reached: %s", type(error).__name__)

    def _is_outage(self, error: BaseException) -> bool:
        """Tell whether a step failed only because of the database, which somebody will mend."""
        if self._stopping.is_set():
            raise Stopping from error
        return is_outage(error) or is_misfit(error)


def _refuse(*_: object) -> None:
    raise RuntimeError("the engine has stopped")
