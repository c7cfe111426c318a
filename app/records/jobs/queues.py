"""How jobs reach the processes that work on them: DBOS's queues, in the jobs' own database."""

import logging
from collections.abc import Collection
from datetime import datetime

from dbos import DBOS, DBOSClient, DBOSPortableJSONSerializer, EnqueueOptions
from sqlalchemy import Connection, Engine

from app.records.jobs.rows import JobRow, NewJob
from app.records.jobs.webhook import host_of

APPLICATION = "tandem"

APPLICATION_VERSION = "1"
"""Jobs are taken by processes of this version only: raise it when the steps of workflows change."""

PLANS, STUDIES, WEBHOOKS, WAITING = "plans", "studies", "webhooks-by-host", "waiting"
DIVIDED, SUSPECTS = "divided", "suspects"
"""Queues. Comparisons and sweeps wait for their scenarios, divided plans for their regions and some
for what they need before they can begin, so they must not take the plans' slots. What may have
ended a process begins alone, wherever there are processes, until it has come further."""

FORMER_WEBHOOKS = "webhooks"
"""Where earlier versions enqueued calls, which may wait for hours until they are repeated."""

PLAN_WORKFLOW, STUDY_WORKFLOW = "plan_job", "study_job"
WEBHOOK_WORKFLOW, EXPIRY_WORKFLOW = "call_webhook", "expire_jobs"

SERIALIZER = DBOSPortableJSONSerializer()
"""Of what DBOS stores: JSON, not pickled objects."""


class Queues:
    """Puts work into the queues.

    Parameters
    ----------
    engine
        Connections to the database.
    """

    def __init__(self, engine: Engine) -> None:
        keep_quiet()
        self.engine = engine
        self.client = DBOSClient(system_database_engine=engine, application_name=APPLICATION,
                                 serializer=SERIALIZER, lazy=True, retry_connection_errors=False)

    def prepare(self) -> None:
        """Make DBOS's tables, or bring them to this version. In place."""
        DBOS.migrate(self.engine.url.render_as_string(hide_password=False))

    def add_job(self, connection: Connection, job: NewJob) -> None:
        """Enqueue a job when the transaction of `connection` commits. In place."""
        options: EnqueueOptions = {
            "workflow_name": PLAN_WORKFLOW, "queue_name": PLANS, "workflow_id": job.id,
            "app_version": APPLICATION_VERSION,
            "priority": job.priority,
        }
        if job.kind in ("compare", "sweep"):
            options |= {"workflow_name": STUDY_WORKFLOW, "queue_name": STUDIES}
        self.client.enqueue_in_transaction(connection, options, job.id)

    def add_webhook(self, connection: Connection, job_id: str, url: str) -> None:
        """Enqueue the call of a job's webhook when the transaction commits. In place."""
        self.client.enqueue_in_transaction(connection, webhook_options(job_id, url, 0), job_id, 0)

    def put(self, job_id: str, queue: str) -> None:
        """Have a job that some process took begun again by any that looks into a queue. In place.
        """
        self.client.resume_workflow(job_id, queue_name=queue)

    def is_in(self, job_id: str, queue: str) -> bool:
        """Tell whether a job waits in a queue, or was taken from it."""
        found = self.client.list_workflows(workflow_ids=[job_id], queue_name=queue,
                                           load_input=False, load_output=False)
        return bool(found)

    def drop(self, ids: Collection[str]) -> None:
        """Take jobs out of their queues. In place."""
        self.client.cancel_workflows(list(ids))

    def taken(self, by: str | None = None) -> list[str]:
        """Return the jobs that some process took, or the one of a name."""
        found = self.client.list_workflows(
            status="PENDING", name=[PLAN_WORKFLOW, STUDY_WORKFLOW], load_input=False,
            load_output=False, application_name=APPLICATION, executor_id=by)
        return [workflow.workflow_id for workflow in found]

    def alive(self, ids: Collection[str]) -> set[str]:
        """Return those jobs that wait or were taken."""
        found = self.client.list_workflows(
            workflow_ids=list(ids), status=["ENQUEUED", "DELAYED", "PENDING"], load_input=False,
            load_output=False)
        return {workflow.workflow_id for workflow in found}

    def finished_before(self, instant: datetime, limit: int) -> list[str]:
        """Return workflows of any kind that ended before an instant."""
        found = self.client.list_workflows(
            completed_before=instant.isoformat(), limit=limit, load_input=False, load_output=False,
            application_name=APPLICATION)
        return [workflow.workflow_id for workflow in found]

    def forget(self, ids: Collection[str]) -> None:
        """Delete all that is known of workflows. In place."""
        self.client.delete_workflows(list(ids))


def queue_of(row: JobRow) -> str:
    """Return where a job waits."""
    if row.kind in ("compare", "sweep"):
        return STUDIES
    return DIVIDED if row.divided else PLANS


def webhook_options(job_id: str, url: str, failures: int) -> EnqueueOptions:
    """Return how a webhook is enqueued that failed some times already: beside its host's others."""
    return {"workflow_name": WEBHOOK_WORKFLOW, "queue_name": WEBHOOKS,
            "queue_partition_key": host_of(url),
            "workflow_id": f"{job_id}:webhook:{failures}", "app_version": APPLICATION_VERSION}


def keep_quiet() -> None:
    """Have libraries log like everybody else, and only what matters. In place."""
    dbos = logging.getLogger("dbos")
    if not dbos.handlers:
        # Where there is a handler DBOS adds none of its own.
        dbos.addHandler(logging.NullHandler())
    dbos.setLevel(logging.ERROR)
    # It names the addresses of webhooks, which are nobody else's business.
    logging.getLogger("httpx").setLevel(logging.WARNING)
