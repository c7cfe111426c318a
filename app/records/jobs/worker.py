"""What works on jobs in this process: DBOS with our workflows, queues and schedule."""

import logging
import socket
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import asdict
from datetime import datetime
from typing import Any, Protocol

from dbos import DBOS, DBOSConfig, EnqueueOptions, ScheduleInput, StepOptions
from pydantic_core import to_json
from sqlalchemy import Engine, event

from app.database.connections import close_for_good, database_url, is_misfit, is_outage
from app.database.durable import connect
from app.records.jobs.divided import DividedWork
from app.records.jobs.housekeeping import Housekeeper
from app.records.jobs.identity import Identity, take_identity
from app.records.jobs.planning import PlanWork
from app.records.jobs.queues import (
    APPLICATION, APPLICATION_VERSION, DIVIDED, EXPIRY_WORKFLOW, FORMER_WEBHOOKS, PLAN_WORKFLOW,
    PLANS, SERIALIZER, STUDIES, STUDY_WORKFLOW, SUSPECTS, WAITING, WEBHOOK_WORKFLOW, WEBHOOKS,
    Queues, webhook_options,
)
from app.records.jobs.replies import summary
from app.records.jobs.slices import NOT_COMPUTED, Slice, Stopping
from app.records.jobs.store import JobStore
from app.records.jobs.studies import StudyWork
from app.records.jobs.webhook import (
    ELSEWHERE, Caller, Message, UnreachableError, wait_after,
)
from app.serving.settings import Settings

logger = logging.getLogger(__name__)

POLLING, STUDY_POLLING, PATIENT_POLLING, FORMER_POLLING = 0.2, 0.5, 1.0, 30.0
"""Seconds between two looks into the plans' queue, that of comparisons and sweeps, which take many
plans' time, one whose jobs can wait, and one that nothing is added to any more. Looking is most of
what many workers ask of the database, and all that an idle one does."""

STUDIES_AT_ONCE, WEBHOOKS_AT_ONCE, WAITING_AT_ONCE, DIVIDED_AT_ONCE = 100, 20, 20, 4

CALLS_OF_A_HOST = 2
"""Of all webhooks called at once: a host that is slow to answer keeps the places of no other."""

EXPIRY_TIMES = "*/5 * * * *"

STOP_PATIENCE = 5.0
"""Seconds that searches may take to end when the process does."""

RETRY = 1.0
"""Seconds between two attempts while the database can't be reached."""

OUTAGE_ATTEMPTS = 100_000

SLICE_STEP, CALL_STEP, ADDRESS_STEP = (
    "JobEngine._work.<locals>.slice_of_work", "JobEngine._call", "JobEngine._webhook")
"""What DBOS calls the steps of our workflows in the database. It goes on with a workflow that an
earlier version began only if its steps are called as they were then."""

LOCKS = "workers"
"""Folder, in that for data, with the names that processes hold."""

_ONE_PER_PROCESS = threading.Lock()


class Work(Protocol):
    """What is done for jobs of some kind."""

    def holds(self, job_id: str) -> bool:
        """Tell whether a job is worked on here."""

    def advance(self, job_id: str) -> Slice:
        """Work on a job for a slice, taking it first if need be. In place."""

    def leave(self, job_id: str) -> None:
        """Leave a job to others, by raising `Stopping`. In place."""


class Worker:
    """Works on jobs from its start to its stop; DBOS is one per process, so workers are too.

    Parameters
    ----------
    settings
        Where the database is, what the process is called, and how many plans it makes at once.
    store, queues
        Where jobs are kept, and wait.
    plans, divided, studies
        What to do with plans, those by regions, and comparisons and sweeps.
    housekeeper
        Who looks after jobs meanwhile.
    caller
        What calls webhooks; None: none are called.
    elsewhere
        Returns messages that aren't about jobs by their names; None: they are out of date.
    """

    def __init__(self, settings: Settings, store: JobStore, queues: Queues, plans: PlanWork,
                 divided: DividedWork, studies: StudyWork, housekeeper: Housekeeper,
                 caller: Caller | None,
                 elsewhere: Callable[[str], Message | None]) -> None:
        self._settings = settings
        self._store = store
        self._queues = queues
        self._suspects: set[str] = set()  # that begin alone here
        self._plans = plans
        self._divided = divided
        self._studies = studies
        self._housekeeper = housekeeper
        self._caller = caller
        self._elsewhere = elsewhere
        self._stopping = threading.Event()
        self._held = ExitStack()  # what is to be given back at the end
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
            If this process has a worker already.
        SQLAlchemyError
            If the database can't be reached; then nothing has begun.
        """
        if not _ONE_PER_PROCESS.acquire(blocking=False):
            raise RuntimeError("this process works on jobs already: give others TANDEM_ROLE=api")
        with ExitStack() as held:
            held.callback(_ONE_PER_PROCESS.release)
            identity = _identity(self._settings)
            held.callback(identity.release)
            # Of its own, as it has to make no more of them when it has stopped.
            engine = connect(self._settings.database)
            held.callback(_end, engine)
            held.callback(self._housekeeper.hand_on, identity.name)
            held.callback(DBOS.destroy, destroy_registry=True)
            self._launch(engine, identity)
            self._held = held.pop_all()
        threading.Thread(target=self._housekeeper.look_until, args=(self._stopping,),
                         name="job-housekeeper", daemon=True).start()
        logger.info("working on jobs as %s, %d at once", identity.name, self._settings.job_slots)

    def stop(self) -> None:
        """Hand back what is worked on, and end. In place."""
        self._stopping.set()
        kinds = (self._plans, self._divided, self._studies)
        for kind in kinds:
            kind.stop()
        deadline = time.monotonic() + STOP_PATIENCE
        while not all(kind.is_idle for kind in kinds):
            if time.monotonic() > deadline:
                break
            time.sleep(0.01)
        self._held.close()

    def _launch(self, engine: Engine, identity: Identity) -> None:
        DBOS(config=_config(engine, identity))
        expiry = self._register()
        DBOS.launch()
        for queue, limit, polling in ((PLANS, self._settings.job_slots, POLLING),
                                      (STUDIES, STUDIES_AT_ONCE, STUDY_POLLING),
                                      (WAITING, WAITING_AT_ONCE, PATIENT_POLLING),
                                      (DIVIDED, DIVIDED_AT_ONCE, PATIENT_POLLING)):
            DBOS.register_queue(queue, worker_concurrency=limit, polling_interval_sec=polling)
        DBOS.register_queue(SUSPECTS, global_concurrency=1, polling_interval_sec=STUDY_POLLING)
        DBOS.register_queue(WEBHOOKS, worker_concurrency=WEBHOOKS_AT_ONCE,
                            partition_worker_concurrency=CALLS_OF_A_HOST,
                            polling_interval_sec=PATIENT_POLLING)
        DBOS.register_queue(FORMER_WEBHOOKS, worker_concurrency=CALLS_OF_A_HOST,
                            polling_interval_sec=FORMER_POLLING)
        DBOS.apply_schedules([expiry])

    def _register(self) -> ScheduleInput:
        """Tell DBOS the workflows; return when that which keeps house is due."""
        # Attempts are counted in the jobs' own rows, where progress sets them back to none.
        @DBOS.workflow(name=PLAN_WORKFLOW, max_recovery_attempts=None)
        def plan_job(job_id: str) -> None:
            self._work(job_id, self._plan_work)

        @DBOS.workflow(name=STUDY_WORKFLOW, max_recovery_attempts=None)
        def study_job(job_id: str) -> None:
            self._work(job_id, lambda _: self._studies)

        @DBOS.workflow(name=WEBHOOK_WORKFLOW)
        def call_webhook(job_id: str, failures: int) -> None:
            self._call_webhook(job_id, failures)

        @DBOS.workflow(name=EXPIRY_WORKFLOW)
        def expire_jobs(scheduled_at: datetime, context: Any) -> None:
            self._housekeeper.expire()
            self._housekeeper.reconcile()

        return {"schedule_name": EXPIRY_WORKFLOW, "schedule": EXPIRY_TIMES,
                "workflow_fn": expire_jobs}

    def _work(self, job_id: str, work_on: Callable[[str], Work]) -> None:
        """Work on a job, slice by slice, each a checkpoint. In place."""
        def slice_of_work(job_id: str) -> dict[str, Any]:
            return asdict(self._advance(job_id, work_on(job_id)))

        slicing: StepOptions = {**self._step, "name": SLICE_STEP}
        try:
            while not DBOS.run_step(slicing, slice_of_work, job_id)["over"]:
                pass
        except Exception as error:  # whatever was not foreseen ends this job, not the process
            if self._stopping.is_set():
                raise Stopping from error
            logger.exception("job %s failed", job_id)
            self._plans.drop(job_id)
            self._divided.drop(job_id)
            self._studies.drop(job_id)
            self._store.finish(job_id, None, "failed", error=NOT_COMPUTED)

    def _advance(self, job_id: str, work: Work) -> Slice:
        """Work on a job for a slice; one that may have ended a process, alone. In place.

        Raises
        ------
        Stopping
            If it is to begin elsewhere, or this process ends.
        """
        if not work.holds(job_id):
            self._suspects.discard(job_id)
            row = self._store.find(job_id)
            if row is not None and row.crashes > 0 and not row.is_over:
                if not self._queues.is_in(job_id, SUSPECTS):
                    self._queues.put(job_id, SUSPECTS)
                    raise Stopping
                self._suspects.add(job_id)
        done = work.advance(job_id)
        if job_id in self._suspects and work.holds(job_id):
            row = self._store.find(job_id)
            if row is not None and row.crashes == 0:
                # It came further than what ended the process: others may begin.
                work.leave(job_id)
        return done

    def _plan_work(self, job_id: str) -> Work:
        """Return who works on a plan job: whole, or by regions."""
        is_divided = self._divided.holds(job_id)
        if not is_divided and not self._plans.holds(job_id):
            row = self._store.find(job_id)
            is_divided = row is not None and row.divided
        return self._divided if is_divided else self._plans

    def _call_webhook(self, job_id: str, failures: int) -> None:
        """Call a job's webhook, or one of another message, or enqueue a later call. In place."""
        problem = DBOS.run_step({**self._step, "name": CALL_STEP}, self._call, job_id)
        if problem is None:
            return
        wait = wait_after(failures + 1)
        logger.warning("webhook of job %s: %s; %s", job_id, problem,
                       "given up" if wait is None else f"tried again after {wait:g} s")
        url = DBOS.run_step({**self._step, "name": ADDRESS_STEP}, self._webhook, job_id)
        if wait is not None and url is not None:
            options: EnqueueOptions = {**webhook_options(job_id, url, failures + 1),
                                       "delay_seconds": wait}
            DBOS.enqueue_workflow_with_options(options, job_id, failures + 1)

    def _webhook(self, job_id: str) -> str | None:
        """Return a job's webhook, if it is there and over."""
        message = self._message(job_id)
        return None if message is None else message.url

    def _call(self, job_id: str) -> str | None:
        """Call a job's webhook; return what went wrong."""
        message = self._message(job_id)
        if message is None:
            return None
        if self._caller is None:
            return "there is no TANDEM_WEBHOOK_SECRET to sign it with"
        try:
            self._caller.call(*message)
        except UnreachableError as error:
            return str(error)
        return None

    def _message(self, job_id: str) -> Message | None:
        """Return what is to be told of a job, or by a name of another kind; None: nothing."""
        if job_id.startswith(ELSEWHERE):
            return self._elsewhere(job_id)
        row = self._store.find(job_id)
        if row is None or row.webhook is None or not row.is_over:
            return None
        finished = summary(row)
        body = to_json({"type": f"job.{row.state}", "timestamp": finished["finished_at"],
                        "data": finished}).decode()
        return Message(row.webhook, f"msg_{job_id}", body)

    def _is_outage(self, error: BaseException) -> bool:
        """Tell whether a step failed only because of the database, which somebody will mend."""
        if self._stopping.is_set():
            raise Stopping from error
        return is_outage(error) or is_misfit(error)


def _config(engine: Engine, identity: Identity) -> DBOSConfig:
    return {
        "name": APPLICATION,
        "system_database_engine": engine,
        "application_version": APPLICATION_VERSION,
        "executor_id": identity.name,
        "serializer": SERIALIZER,
        "log_level": "ERROR",
        "enable_otlp": False,
        "notification_listener_polling_interval_sec": 1.0,
    }


def _identity(settings: Settings) -> Identity:
    is_local = database_url(settings.database).get_backend_name() == "sqlite"
    worker = settings.worker_id or ("local" if is_local else socket.gethostname())
    return take_identity(worker, settings.data_dir / LOCKS)


def _end(engine: Engine) -> None:
    """Close all connections, and refuse to make others. In place.

    Workflows taken over by another process wait for its outcome in threads that would outlive this
    worker.
    """
    event.listen(engine, "do_connect", _refuse)
    close_for_good(engine)


def _refuse(*_: object) -> None:
    raise RuntimeError("the worker has stopped")
