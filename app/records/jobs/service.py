"""Jobs as endpoints see them: submit, read, stop."""

import hashlib
import re
import time
import uuid
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from pydantic_core import to_json

from app.records.jobs.errors import (
    JobShareError, KeyReusedError, NoPlanError, TooManyJobsError, UnknownJobError,
)
from app.records.jobs.queues import Queues
from app.records.jobs.reading import JobReader
from app.records.jobs.replies import summary
from app.records.jobs.rows import JobRow, NewJob, OpenPlans, Standing
from app.records.jobs.schemas import Kind, State
from app.records.jobs.store import JobStore
from app.records.jobs.studies import study_result
from app.schemas.request import PlanRequest

CANCEL_PATIENCE = 5.0
"""Seconds for whoever runs a job to stop it, before it is ended with what is written down."""

CANCEL_POLLING = 0.05


@dataclass(frozen=True)
class Submission:
    """What a client sends to start a job."""

    kind: Kind
    body: bytes
    owner: str
    client: str  # whose share of the open jobs it takes
    key: str | None  # of idempotency
    webhook: str | None

    @property
    def fingerprint(self) -> str:
        """Hash of what must be the same for the same job."""
        told = f"{self.kind}\n{self.webhook or ''}\n".encode()
        return hashlib.sha256(told + self.body).hexdigest()

    @property
    def key_id(self) -> str | None:
        """Name of the owner and the key together, if there is one."""
        return None if self.key is None else str(uuid.uuid5(_KEYS, f"{self.owner}\n{self.key}"))


_KEYS = uuid.UUID("6f1d5c1e-9d0b-4f57-8f0e-0c5d6a1b2c3d")
"""Namespace of keys' names; any, but always the same."""


@dataclass(frozen=True)
class OpenLimits:
    """How many plans may wait or run at once, in all processes."""

    total: int
    of_client: int

    def check(self, there: OpenPlans, plans: int) -> None:
        """Refuse so many more plans of a client.

        Raises
        ------
        JobShareError
            If the client would have more than its share.
        TooManyJobsError
            If there would be too many altogether.
        """
        if there.of_client + plans > self.of_client:
            raise JobShareError(self.of_client, there.of_client)
        if there.total + plans > self.total:
            raise TooManyJobsError("As many jobs wait as may (TANDEM_MAX_OPEN_JOBS): try again "
                                   "when some have ended.")


_JOB_ID = re.compile("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")


class JobService:
    """Takes and tells of jobs; its methods wait for the database.

    Parameters
    ----------
    store
        Where jobs are kept.
    queues
        Where they wait.
    reader
        What reads requests.
    limits
        How many plans may wait or run at once.
    stop_here
        Stops a plan job at once if this process works on it.
    validate
        Checks a request and returns how many plans it asks for; raises as `submit` does.
    """

    def __init__(self, store: JobStore, queues: Queues, reader: JobReader, limits: OpenLimits,
                 stop_here: Callable[[str], None],
                 validate: Callable[[Kind, bytes, Callable[[], bool]], int]) -> None:
        self._store = store
        self._queues = queues
        self._reader = reader
        self._limits = limits
        self._stop_here = stop_here
        self._validate = validate

    def submit(self, submission: Submission,
               should_stop: Callable[[], bool] = lambda: False) -> tuple[JobRow, bool]:
        """Keep and enqueue a job, unless the same was submitted before by its key. In place.

        Returns
        -------
        The job and whether it is new.

        Raises
        ------
        RequestError
            If the request is not valid, its key belongs to another, too many jobs wait or the
            work on it is to end.
        """
        key_id = submission.key_id
        if key_id is not None and (row := self._store.find_by_key(key_id)) is not None:
            return _same(row, submission), False
        plans = self._validate(submission.kind, submission.body, should_stop)
        # Never an id of before, under which queues and processes may know an earlier job still.
        job = NewJob(str(uuid.uuid4()), submission.kind, submission.owner, submission.fingerprint,
                     submission.body, submission.webhook, client=submission.client, plans=plans,
                     key=key_id)
        is_new = self._store.admit(job, self._queues.add_job,
                                   lambda there: self._limits.check(there, plans))
        row = self._store.find_by_key(key_id) if key_id is not None else self._store.find(job.id)
        if row is None:
            raise UnknownJobError(job.id)
        return _same(row, submission), is_new

    def find(self, job_id: str, owner: str) -> JobRow:
        """Return a job.

        Raises
        ------
        UnknownJobError
            If `owner` has none with that id.
        """
        # Not every text is one that a database takes.
        row = self._store.find(job_id) if is_job_id(job_id) else None
        if row is None or row.owner != owner or row.kind == "region":
            raise UnknownJobError(job_id)
        return row

    def find_all(self, ids: Collection[str]) -> list[JobRow]:
        """Return those jobs that exist, whoever has them."""
        return self._store.find_all(ids)

    def page(self, owner: str, limit: int, before: tuple[int, str] | None,
             state: State | None) -> list[JobRow]:
        """Return jobs of an owner, the youngest first, from the one after `before` on."""
        return self._store.page(owner, limit, before, state)

    def reply(self, row: JobRow) -> bytes:
        """Return a job with what it has found so far as JSON."""
        # It was written as JSON: the largest plans aren't read to be written again.
        result = self._store.result(row.id) or b"null"
        return to_json(summary(row))[:-1] + b',"result":' + result + b"}"

    def plan(self, job_id: str, owner: str) -> tuple[PlanRequest, bytes]:
        """Return a job's request and its best plan so far as JSON.

        Raises
        ------
        UnknownJobError
            If `owner` has none with that id.
        NoPlanError
            If it has no plan, or none yet.
        """
        row = self.find(job_id, owner)
        if row.kind != "plan":
            raise NoPlanError(f"The job is a {row.kind}, which has several plans: ask for its "
                              "result instead.")
        result = self._store.result(row.id)
        if result is None:
            raise NoPlanError(f"The job is {row.state} and has no plan"
                              f"{'.' if row.is_over else ' yet: try again soon.'}")
        return self._reader.plan_request(self._store, row), result

    def cancel(self, job_id: str, owner: str) -> JobRow:
        """Stop a job with what it has found so far, unless it is over, and return it. In place.

        Raises
        ------
        UnknownJobError
            If `owner` has none with that id.
        """
        row = self.find(job_id, owner)
        if row.is_over:
            return row
        self.stop_jobs([*self._open_children(row), row])
        deadline = time.monotonic() + CANCEL_PATIENCE
        while not (row := self._existing(job_id)).is_over and time.monotonic() < deadline:
            time.sleep(CANCEL_POLLING)
        if not row.is_over:
            self._end(row)
        return self._existing(job_id)

    def stop_jobs(self, rows: Sequence[JobRow]) -> None:
        """Have jobs stopped; those that nobody works on are over at once. In place."""
        self._store.request_cancel([row.id for row in rows])
        waiting = [row.id for row in rows if row.state == "queued"]
        for job_id in waiting:
            self._store.finish(job_id, None, "cancelled")
        if waiting:
            self._queues.drop(waiting)
        for row in rows:
            self._stop_here(row.id)

    def _end(self, row: JobRow) -> None:
        """End a job whose process doesn't answer. In place."""
        standing = None
        for child in self._open_children(row):
            self._store.finish(child.id, None, "cancelled")
        if row.kind != "plan":
            children = self._store.children(row.id)
            if children:
                result = study_result(self._store, self._reader.scenarios(self._store, row),
                                      children)
                standing = Standing(row.progress, row.search_iterations, row.searched,
                                    result=to_json(result))
        self._store.finish(row.id, None, "cancelled", standing)

    def _open_children(self, row: JobRow) -> list[JobRow]:
        return [child for child in self._store.children(row.id) if not child.is_over]

    def _existing(self, job_id: str) -> JobRow:
        row = self._store.find(job_id)
        if row is None:
            raise UnknownJobError(job_id)
        return row


def is_job_id(text: str) -> bool:
    """Tell whether a text looks like the id of a job."""
    return _JOB_ID.fullmatch(text) is not None


def _same(row: JobRow, submission: Submission) -> JobRow:
    """Return the job if a submission is the one that made it."""
    if row.fingerprint != submission.fingerprint:
        raise KeyReusedError
    return row
