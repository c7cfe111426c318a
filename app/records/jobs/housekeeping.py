"""Jobs whose process is gone for good, jobs that were lost, and jobs that expired."""

import logging
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from sqlalchemy import Engine
from sqlalchemy.exc import DBAPIError

from app.records.clock import now_ms
from app.records.jobs.queues import Queues, queue_of
from app.records.jobs.rows import JobRow
from app.records.jobs.store import JobStore

logger = logging.getLogger(__name__)

PERIOD = 5.0
"""Seconds between two looks for jobs whose process is gone."""

PATIENCE = 30.0
"""Seconds without any sign of life, though the database answers, after which a job's process is
held to be dead."""

BATCH = 500
"""Jobs deleted or compared at a time."""

KEPT = timedelta(hours=1)
"""How long the queues remember what they have done; the jobs' own rows tell the rest."""

LOST = "The job was lost by its queue."

Mark = tuple[int, int] | None
"""What of a job changes each second while a process works on it."""


@dataclass(frozen=True)
class Sighting:
    """Since when a job looks as it does, on `time.monotonic`."""

    mark: Mark
    since: float


class Housekeeper:
    """Looks after jobs on behalf of all processes; each may have one.

    Parameters
    ----------
    store
        Where jobs are kept.
    queues
        Where they wait.
    also_expire
        What else is to be done whenever jobs are deleted that expired.
    also_forget
        What else is to be done at each look, told of its time.
    """

    def __init__(self, store: JobStore, queues: Queues,
                 also_expire: Sequence[Callable[[Engine], None]] = (),
                 also_forget: Callable[[float], None] = lambda _: None) -> None:
        self._store = store
        self._queues = queues
        self._also_expire = also_expire
        self._also_forget = also_forget
        self._sightings: Mapping[str, Sighting] = {}

    def look_until(self, stopping: threading.Event) -> None:
        """Look every few seconds until told to stop. In place."""
        while not stopping.wait(PERIOD):
            try:
                self.look(time.monotonic())
            except DBAPIError as error:
                logger.warning("the database can't be reached: %s", type(error).__name__)

    def look(self, now: float) -> None:
        """Give jobs to others whose process gave no sign of life for long. In place.

        Only this process's own clock counts. Wrongly held to be dead, a process does no harm: what
        it writes is refused from then on.

        Parameters
        ----------
        now
            The time on `time.monotonic`.
        """
        self._also_forget(now)
        sightings = {}
        for job_id, row in self._taken().items():
            mark = None if row is None else (row.attempt, row.revision)
            seen = self._sightings.get(job_id)
            if seen is None or seen.mark != mark:
                sightings[job_id] = Sighting(mark, now)
            elif now - seen.since < PATIENCE:
                sightings[job_id] = seen
            else:
                self._rescue(job_id, row)
        self._sightings = sightings

    def hand_on(self, name: str) -> None:
        """Give to others what a process of a name still holds, which takes no more. In place.

        What it put back it may have taken again itself before.
        """
        try:
            for job_id, row in self._taken(name).items():
                self._rescue(job_id, row)
        except DBAPIError as error:
            logger.warning("jobs wait until %s is held to be dead: %s", name, type(error).__name__)

    def expire(self) -> None:
        """Delete what expired, and what the queues remember of old jobs. In place."""
        for expire in self._also_expire:
            expire(self._queues.engine)
        while ids := self._store.expired(now_ms(), BATCH):
            self._store.forget(ids)
        while ids := self._queues.finished_before(datetime.now(UTC) - KEPT, BATCH):
            self._queues.forget(ids)

    def reconcile(self) -> None:
        """End jobs that no queue knows any more, which should never be. In place."""
        ids = self._store.open_ids()
        for begin in range(0, len(ids), BATCH):
            batch = ids[begin:begin + BATCH]
            for job_id in set(batch) - self._queues.alive(batch):
                if self._store.finish(job_id, None, "failed", error=LOST):
                    logger.error("job %s was lost by its queue", job_id)

    def _taken(self, by: str | None = None) -> dict[str, JobRow | None]:
        """Return the rows of jobs that some process took, or the one of a name; None: deleted."""
        taken = self._queues.taken(by)
        rows = {row.id: row for row in self._store.find_all(taken)}
        return {job_id: rows.get(job_id) for job_id in taken}

    def _rescue(self, job_id: str, row: JobRow | None) -> None:
        """Have a job begun again by any process. In place."""
        if row is None:
            self._queues.drop([job_id])
        elif row.is_over or self._store.take_over(row):
            logger.warning("job %s is taken from a process that is gone", job_id)
            self._queues.put(job_id, queue_of(row))
