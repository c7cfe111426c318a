"""Jobs in the database: every change is one conditional statement, so that none happens twice.

A process that takes a job raises its `attempt` and states it with each later change. One that was
frozen, cut off or given up for dead meanwhile so changes nothing any more.
"""

import zlib
from collections.abc import Callable, Collection, Sequence

from sqlalchemy import (
    ColumnElement, Connection, Engine, Select, Table, and_, case, delete, func, insert, or_, select,
    tuple_, update,
)
from sqlalchemy.exc import IntegrityError

from app.database.connections import Purpose, alone
from app.database.migrations.running import find_misfit, upgrade
from app.database.tables import JOBS, REQUESTS, RESULTS
from app.records.clock import now_ms
from app.records.jobs.rows import OPEN, JobRow, NewJob, OpenPlans, Standing
from app.records.jobs.schemas import State

_WAITING_NO_MORE: dict[str, None] = dict.fromkeys(("waiting_for", "waiting_since", "retry_at"))

_RELEASED: dict[str, object] = {
    "state": "queued", "attempt": JOBS.c.attempt + 1, "crashes": 0,
    "revision": JOBS.c.revision + 1, **_WAITING_NO_MORE}

_COLUMNS = tuple(JOBS.c[name] for name in JobRow._fields)

FAST = 1
"""zlib's level: plans are written each second."""


class JobStore:
    """The jobs of all processes that share a database.

    Parameters
    ----------
    engine
        Connections to the database.
    expiry
        How long jobs are kept after their end in milliseconds.
    announce
        Called in the transaction that ends a job with a webhook, with the job's id and the webhook.
    count
        Called after a job ended, with its kind, its state and how many seconds it ran, if it did.
    """

    def __init__(self, engine: Engine, expiry: int,
                 announce: Callable[[Connection, str, str], None],
                 count: Callable[[str, State, float | None], None]) -> None:
        self._engine = engine
        self._expiry = expiry
        self._announce = announce
        self._count = count

    def prepare(self) -> None:
        """Make the tables, or bring them to this version; raises as `upgrade` does. In place."""
        upgrade(self._engine)

    def find_misfit(self) -> str | None:
        """Return how the tables differ from what this version needs; None: they fit."""
        return find_misfit(self._engine)

    def add(self, jobs: Sequence[NewJob],
            enqueue: Callable[[Connection, NewJob], None]) -> bool:
        """Keep and enqueue jobs, all or none; False if the first is there already. In place."""
        try:
            with self._engine.begin() as connection:
                _insert(connection, jobs, enqueue)
        except IntegrityError:
            if self.find(jobs[0].id) is None:
                raise
            return False
        return True

    def admit(self, job: NewJob, enqueue: Callable[[Connection, NewJob], None],
              refuse: Callable[[OpenPlans], None]) -> bool:
        """Keep and enqueue a job unless `refuse` raises; False if its key is taken. In place.

        `refuse` is told of the plans that are open, while no other process admits any.
        """
        with alone(self._engine, Purpose.ADMITTING_JOBS) as connection:
            taken = select(JOBS.c.id).where(JOBS.c.key == job.key)
            if job.key is not None and connection.scalar(taken) is not None:
                return False
            refuse(_open_plans(connection, job.client))
            _insert(connection, [job], enqueue)
        return True

    def find(self, job_id: str) -> JobRow | None:
        """Return a job."""
        rows = self._rows(select(*_COLUMNS).where(JOBS.c.id == job_id))
        return rows[0] if rows else None

    def find_by_key(self, key: str) -> JobRow | None:
        """Return the job of a key; before there were keys, they were the jobs' ids."""
        rows = self._rows(select(*_COLUMNS).where(or_(JOBS.c.key == key, JOBS.c.id == key)))
        return rows[0] if rows else None

    def find_all(self, ids: Collection[str]) -> list[JobRow]:
        """Return those jobs that exist."""
        return self._rows(select(*_COLUMNS).where(JOBS.c.id.in_(ids)))

    def children(self, parent: str) -> list[JobRow]:
        """Return the scenarios of a comparison or sweep, or a plan's regions, in order."""
        return self._rows(select(*_COLUMNS).where(JOBS.c.parent == parent)
                          .order_by(JOBS.c.position))

    def page(self, owner: str, limit: int, before: tuple[int, str] | None,
             state: State | None) -> list[JobRow]:
        """Return jobs of one owner, the youngest first, without scenarios.

        Parameters
        ----------
        owner
            Whose jobs.
        limit
            How many at most.
        before
            `created_at` and id of the job after which to begin; None: the youngest.
        state
            Only jobs in that state; None: all.
        """
        query = select(*_COLUMNS).where(JOBS.c.owner == owner, JOBS.c.parent.is_(None))
        if before is not None:
            query = query.where(tuple_(JOBS.c.created_at, JOBS.c.id) < tuple_(*before))
        if state is not None:
            query = query.where(JOBS.c.state == state)
        return self._rows(query.order_by(JOBS.c.created_at.desc(), JOBS.c.id.desc()).limit(limit))

    def count_by_state(self) -> dict[tuple[str, str], int]:
        """Return how many jobs there are by kind and state, without scenarios."""
        query = (select(JOBS.c.kind, JOBS.c.state, func.count()).where(JOBS.c.parent.is_(None))
                 .group_by(JOBS.c.kind, JOBS.c.state))
        with self._engine.connect() as connection:
            return {(kind, state): number for kind, state, number in connection.execute(query)}

    def open_ids(self) -> list[str]:
        """Return the jobs that wait or run, scenarios included."""
        with self._engine.connect() as connection:
            return list(connection.scalars(select(JOBS.c.id).where(JOBS.c.state.in_(OPEN))))

    def request(self, job_id: str) -> bytes:
        """Return the body of a job's request.

        Raises
        ------
        KeyError
            If the job is not there.
        """
        body = self._body(REQUESTS, job_id)
        if body is None:
            raise KeyError(job_id)
        return body

    def result(self, job_id: str) -> bytes | None:
        """Return what a job has found so far as JSON, or None."""
        return self._body(RESULTS, job_id)

    def claim(self, job_id: str) -> JobRow | None:
        """Take a job, away from any other process, and return it; None if it is over. In place."""
        change = (
            update(JOBS).where(JOBS.c.id == job_id, JOBS.c.state.in_(OPEN))
            .values(state="running", attempt=JOBS.c.attempt + 1, crashes=JOBS.c.crashes + 1,
                    revision=JOBS.c.revision + 1,
                    started_at=func.coalesce(JOBS.c.started_at, now_ms()))
            .returning(*_COLUMNS))
        with self._engine.begin() as connection:
            row = connection.execute(change).first()
        return None if row is None else JobRow._make(row)

    def note(self, job_id: str, attempt: int, standing: Standing) -> bool | None:
        """Write down how far a job has come; its cost never rises. In place.

        Returns
        -------
        Whether it shall be cancelled; None if it is no longer this attempt's.
        """
        with self._engine.begin() as connection:
            row = connection.execute(
                update(JOBS).where(_held(job_id, attempt))
                .values(progress=standing.progress, searched=standing.searched, crashes=0,
                        search_iterations=standing.search_iterations,
                        revision=JOBS.c.revision + 1, **_WAITING_NO_MORE)
                .returning(JOBS.c.cancel_requested)).first()
            if row is None:
                return None
            self._keep(connection, job_id, standing)
        return bool(row[0])

    def keep_alive(self, job_id: str, attempt: int) -> bool | None:
        """Give a sign of life of a job that isn't searched yet; returns as `note` does. In place.
        """
        return self._changed(_held(job_id, attempt), revision=JOBS.c.revision + 1)

    def put_off(self, job_id: str, attempt: int, why: str, retry_at: int) -> bool | None:
        """Have a job wait that can't begin; returns as `note` does. In place."""
        return self._changed(
            _held(job_id, attempt), state="queued", attempt=JOBS.c.attempt + 1, crashes=0,
            revision=JOBS.c.revision + 1, waiting_for=why, retry_at=retry_at,
            waiting_since=func.coalesce(JOBS.c.waiting_since, now_ms()))

    def finish(self, job_id: str, attempt: int | None, state: State,
               standing: Standing | None = None, error: str | None = None) -> bool:
        """End a job unless it has ended; its cost never rises. In place.

        Parameters
        ----------
        job_id
            Which job.
        attempt
            The attempt that ends it; None: whoever has it.
        state
            How it ends. One that failed has no result.
        standing
            How far it has come; None: as far as is known.
        error
            Why it failed.

        Returns
        -------
        Whether this call ended it.
        """
        at = now_ms()
        values: dict[str, object] = {
            "state": state, "finished_at": at, "expires_at": at + self._expiry, "error": error,
            "revision": JOBS.c.revision + 1, **_WAITING_NO_MORE}
        if standing is not None:
            values |= {"progress": standing.progress, "searched": standing.searched,
                       "search_iterations": standing.search_iterations}
        held = (and_(JOBS.c.id == job_id, JOBS.c.state.in_(OPEN)) if attempt is None
                else _held(job_id, attempt))
        with self._engine.begin() as connection:
            row = connection.execute(
                update(JOBS).where(held).values(values)
                .returning(JOBS.c.webhook, JOBS.c.kind, JOBS.c.started_at, JOBS.c.divided)).first()
            if row is None:
                return False
            if standing is not None:
                # An equal cost too: the last reply tells how the whole plan came about.
                self._keep(connection, job_id, standing, or_equal=True)
            if state == "failed":
                connection.execute(delete(RESULTS).where(RESULTS.c.job == job_id))
            if row.webhook is not None:
                self._announce(connection, job_id, row.webhook)
            if row.divided:
                connection.execute(update(JOBS).where(JOBS.c.parent == job_id)
                                   .values(cancel_requested=True))
        seconds = None if row.started_at is None else (at - row.started_at) / 1000
        if row.kind != "region":
            self._count(row.kind, state, seconds)
        return True

    def release(self, job_id: str, attempt: int) -> bool:
        """Give a job back to its queue; False if it is no longer this attempt's. In place."""
        return self._changed(_held(job_id, attempt), **_RELEASED) is not None

    def lose(self, job_id: str, attempt: int) -> bool:
        """Have a job wait again whose planning died, which counts; returns as `release` does.

        In place.
        """
        return self._changed(_held(job_id, attempt), state="queued", deaths=JOBS.c.deaths + 1,
                             attempt=JOBS.c.attempt + 1, revision=JOBS.c.revision + 1) is not None

    def divide(self, job_id: str, attempt: int) -> bool:
        """Give a job back that goes on by regions; returns as `release` does. In place."""
        return self._changed(_held(job_id, attempt), divided=True, **_RELEASED) is not None

    def request_cancel(self, ids: Collection[str]) -> None:
        """Have jobs stopped by whoever runs them. In place."""
        change = (update(JOBS).where(JOBS.c.id.in_(ids), JOBS.c.state.in_(OPEN))
                  .values(cancel_requested=True))
        with self._engine.begin() as connection:
            connection.execute(change)

    def take_over(self, seen: JobRow) -> bool:
        """Take a job from a process that is held to be dead, if nothing changed. In place."""
        change = (update(JOBS)
                  .where(JOBS.c.id == seen.id, JOBS.c.attempt == seen.attempt,
                         JOBS.c.revision == seen.revision)
                  .values(attempt=JOBS.c.attempt + 1,
                          state=case((JOBS.c.state == "running", "queued"), else_=JOBS.c.state)))
        with self._engine.begin() as connection:
            return connection.execute(change).rowcount == 1

    def expired(self, at: int, limit: int) -> list[str]:
        """Return jobs that expired before `at`, and those of their scenarios and regions."""
        query = (select(JOBS.c.id).where(JOBS.c.expires_at < at, JOBS.c.parent.is_(None))
                 .limit(limit))
        with self._engine.connect() as connection:
            ids = list(connection.scalars(query))
            below = ids
            while below:
                below = list(connection.scalars(select(JOBS.c.id).where(JOBS.c.parent.in_(below))))
                ids += below
        return ids

    def forget(self, ids: Collection[str]) -> None:
        """Delete jobs with all that belongs to them. In place."""
        with self._engine.begin() as connection:
            for table in (RESULTS, REQUESTS):
                connection.execute(delete(table).where(table.c.job.in_(ids)))
            connection.execute(delete(JOBS).where(JOBS.c.id.in_(ids)))

    def _changed(self, condition: ColumnElement[bool], **values: object) -> bool | None:
        """Change a job, and return whether it shall be cancelled; None if there is none."""
        change = update(JOBS).where(condition).values(**values).returning(JOBS.c.cancel_requested)
        with self._engine.begin() as connection:
            cancel = connection.scalar(change)
        return None if cancel is None else bool(cancel)

    def _rows(self, query: Select[tuple[object, ...]]) -> list[JobRow]:
        with self._engine.connect() as connection:
            return [JobRow._make(row) for row in connection.execute(query).all()]

    def _body(self, table: Table, job_id: str) -> bytes | None:
        with self._engine.connect() as connection:
            body = connection.scalar(select(table.c.body).where(table.c.job == job_id))
        return None if body is None else zlib.decompress(body)

    @staticmethod
    def _keep(connection: Connection, job_id: str, standing: Standing,
              or_equal: bool = False) -> None:
        """Keep a lower cost with its result, or a result that has no cost. In place."""
        if standing.cost is not None:
            is_lower = or_(JOBS.c.cost.is_(None), JOBS.c.cost > standing.cost)
            is_kept = or_(is_lower, JOBS.c.cost == standing.cost) if or_equal else is_lower
            changed = connection.execute(
                update(JOBS).where(JOBS.c.id == job_id, is_kept)
                .values(cost=standing.cost, improved_revision=case(
                    (is_lower, JOBS.c.revision), else_=JOBS.c.improved_revision)))
            if changed.rowcount != 1:
                return
        if standing.result is not None:
            body = {"job": job_id, "body": zlib.compress(standing.result, FAST)}
            connection.execute(delete(RESULTS).where(RESULTS.c.job == job_id))
            connection.execute(insert(RESULTS).values(body))


def _insert(connection: Connection, jobs: Sequence[NewJob],
            enqueue: Callable[[Connection, NewJob], None]) -> None:
    """Keep and enqueue jobs. In place."""
    at = now_ms()
    bodies = [{"job": job.id, "body": zlib.compress(job.body)} for job in jobs
              if job.body is not None]
    connection.execute(insert(JOBS), [_first_values(job, at) for job in jobs])
    if bodies:
        connection.execute(insert(REQUESTS), bodies)
    for job in jobs:
        enqueue(connection, job)


def _open_plans(connection: Connection, client: str | None) -> OpenPlans:
    """Return how many plans wait or run; comparisons and sweeps count whole until they end."""
    of_client = case((JOBS.c.client == client, JOBS.c.plans), else_=0)
    query = (select(func.coalesce(func.sum(JOBS.c.plans), 0),
                    func.coalesce(func.sum(of_client), 0))
             .where(JOBS.c.state.in_(OPEN), JOBS.c.parent.is_(None)))
    total, own = connection.execute(query).one()
    return OpenPlans(int(total), int(own))


def _held(job_id: str, attempt: int) -> ColumnElement[bool]:
    """Return the condition that a job still is an attempt's."""
    return and_(JOBS.c.id == job_id, JOBS.c.attempt == attempt, JOBS.c.state == "running")


def _first_values(job: NewJob, at: int) -> dict[str, object]:
    return {"id": job.id, "kind": job.kind, "owner": job.owner, "state": "queued",
            "parent": job.parent, "position": job.position, "fingerprint": job.fingerprint,
            "webhook": job.webhook, "created_at": at, "progress": 0.0, "search_iterations": 0,
            "searched": 0.0, "cancel_requested": False, "revision": 1, "improved_revision": 0,
            "attempt": 0, "crashes": 0, "client": job.client, "plans": job.plans,
            "key": job.key}
