"""Plans by regions: a job for each region, and one that keeps the best plan of the whole.

Rounds follow each other, each with other borders. Whoever watches over them writes down nothing but
the best plan: regions are jobs in the database, with the routes that they began with, so that
another process goes on from there. What comes back is merged only if all its region had is
unchanged, whoever asked for it and when.
"""

import logging
import threading
import time
import uuid
from collections.abc import Callable, Sequence

import numpy as np
from pydantic_core import from_json

from app.plans.replies import Data
from app.records.jobs.asked import TaskMaker
from app.records.jobs.incumbent import Incumbent
from app.records.jobs.region_task import ERRANDS, Errand, found_by
from app.records.jobs.rounds import Rounds, num_regions
from app.records.jobs.rows import SCENARIO, SINGLE, JobRow, NewJob
from app.records.jobs.running import RegionTerms, Returning, sign_of_life
from app.records.jobs.schemas import State
from app.records.jobs.slices import (
    MAX_CRASHES, NOT_COMPUTED, OVER, POISONOUS, SLICE, Slice, Stopping, hold,
)
from app.records.jobs.store import JobStore
from app.requests.conversion.preparing import StoppedError
from model.search.regions.dividing import divide

logger = logging.getLogger(__name__)

LOOKING = 0.2
"""Seconds between two looks whether a region has come back."""

LAST_PATIENCE = 5.0
"""Seconds that regions may take to come back at the end."""


class DividedWork:
    """The plans by regions that this process watches over.

    Parameters
    ----------
    store
        Where jobs are kept.
    asking
        What makes tasks of their requests.
    terms
        How large and long regions are.
    add
        Keeps and enqueues jobs.
    stop_jobs
        Has jobs cancelled.
    returning
        How jobs get back to their queue.
    is_aside
        Tells whether a job is taken from a queue where it takes no place of a plan.
    on_plan
        Is told the reply of each job that is done.
    clock
        Tells the time in seconds.
    """

    def __init__(self, store: JobStore, asking: TaskMaker, terms: RegionTerms,
                 add: Callable[[Sequence[NewJob]], bool],
                 stop_jobs: Callable[[Sequence[JobRow]], None], returning: Returning,
                 is_aside: Callable[[str], bool], on_plan: Callable[[Data], None],
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._store = store
        self._asking = asking
        self._terms = terms
        self._add = add
        self._stop_jobs = stop_jobs
        self._returning = returning
        self._is_aside = is_aside
        self._on_plan = on_plan
        self._clock = clock
        self._held: dict[str, Rounds] = {}
        self._stopping = threading.Event()

    def holds(self, job_id: str) -> bool:
        """Tell whether a job is watched over here."""
        return job_id in self._held

    def advance(self, job_id: str) -> Slice:
        """Look at a job's regions for a slice, taking the job first if need be. In place.

        Raises
        ------
        Stopping
            If this process ends, or leaves the job to others.
        """
        rounds = hold(self._held, job_id, self._stopping, self._begin)
        if rounds is None:
            return OVER
        self._wait(rounds)
        if self._stopping.is_set():
            self.leave(job_id)
        regions = self._store.children(job_id)
        rounds.look(regions, self._clock())
        self._merge(rounds, [region for region in regions if region.is_over])
        return self._go_on(rounds, [region for region in regions if not region.is_over])

    def cancel(self, job_id: str) -> None:
        """Stop a job if it is watched over here. In place."""
        rounds = self._held.get(job_id)
        if rounds is not None:
            rounds.is_cancelled = True
            rounds.news.set()

    def leave(self, job_id: str) -> None:
        """Leave a job to others. In place.

        Raises
        ------
        Stopping
            Always.
        """
        self._hand_back(self._held[job_id])
        raise Stopping

    def drop(self, job_id: str) -> None:
        """Let go of a job that failed. In place."""
        self._held.pop(job_id, None)

    def stop(self) -> None:
        """Have all jobs handed back. In place."""
        self._stopping.set()
        for rounds in list(self._held.values()):
            rounds.news.set()

    @property
    def is_idle(self) -> bool:
        """Tell whether nothing is watched over."""
        return not self._held

    def _begin(self, job_id: str) -> Rounds | None:
        """Take a job; None if it is over. In place."""
        if not self._is_aside(job_id):
            self._returning.share_out(job_id)
            raise Stopping
        row = self._store.claim(job_id)
        if row is None:
            return None
        kept = self._store.result(job_id)
        if row.crashes > MAX_CRASHES or kept is None:
            error = POISONOUS if row.crashes > MAX_CRASHES else NOT_COMPUTED
            self._store.finish(job_id, row.attempt, "failed", error=error)
            return None
        should_stop = sign_of_life(self._store, row, threading.Event(), self._stopping)
        try:
            asked = self._asking.shared(row, should_stop, self._clock())
        except StoppedError:
            if self._stopping.is_set() and self._store.release(job_id, row.attempt):
                self._returning.share_out(job_id)
            elif not self._stopping.is_set():
                self._store.finish(job_id, row.attempt, "cancelled")
            raise Stopping from None
        reply = from_json(kept)
        best = Incumbent(asked.task.problem, asked.task.read(reply))
        return Rounds(row, asked, best, reply, self._store.children(job_id), self._clock())

    def _wait(self, rounds: Rounds) -> None:
        """Wait for a slice, or until there is something to do. In place."""
        until = self._clock() + SLICE
        while self._clock() < until and not self._stopping.is_set():
            regions = self._store.children(rounds.row.id)
            if not regions or any(region.is_over for region in regions):
                return
            if rounds.news.wait(LOOKING):
                rounds.news.clear()
                return

    def _merge(self, rounds: Rounds, come_back: Sequence[JobRow]) -> None:
        """Merge what has come back. In place."""
        for region in come_back:
            rounds.note_outcome(region)
            result = self._store.result(region.id)
            if result is None:
                continue
            errand = ERRANDS.validate_json(self._store.request(region.id))
            outcome = rounds.best.merge(errand.region, found_by(from_json(result)))
            logger.debug("region %s of job %s: %s", region.id, rounds.row.id, outcome)
            if outcome == "broken":
                logger.error("plan of region %s of job %s withheld", region.id, rounds.row.id)

    def _go_on(self, rounds: Rounds, is_open: Sequence[JobRow]) -> Slice:
        """Begin another round, or end the job, if it is time; else note where it stands. In place.
        """
        now = self._clock()
        if rounds.has_failed:
            return self._end(rounds, "failed")
        if not rounds.is_last:
            if not rounds.waits_for(is_open, now):
                self._stop(is_open)
                self._draw(rounds)
            return self._note(rounds)
        if rounds.closing_since is None:
            rounds.closing_since = now
            self._stop(is_open)
        if is_open and now - rounds.closing_since < LAST_PATIENCE:
            return self._note(rounds)
        return self._end(rounds, "cancelled" if rounds.is_cancelled else "done")

    def _stop(self, regions: Sequence[JobRow]) -> None:
        if regions:
            self._stop_jobs(regions)

    def _draw(self, rounds: Rounds) -> None:
        """Have regions with other borders planned. In place."""
        row, problem = rounds.row, rounds.best.problem
        count = num_regions(problem.num_customers, self._terms.customers, rounds.at_once)
        seed = int(rounds.rng.integers(2**31))
        regions = divide(problem, rounds.best.plan, count, np.random.default_rng(seed))
        seconds = min(self._terms.seconds, rounds.remaining)
        self._add([
            NewJob(str(uuid.uuid4()), "region", row.owner, row.fingerprint,
                   ERRANDS.dump_json(Errand(region, seconds, seed + number, rounds.share)),
                   parent=row.id,
                   position=number, priority=SINGLE if row.parent is None else SCENARIO)
            for number, region in enumerate(regions)])
        rounds.begin(len(regions), seconds)

    def _note(self, rounds: Rounds) -> Slice:
        """Write down the best plan if it is new, and how far the job has come. In place."""
        row = rounds.row
        self._asking.keep(row.id, rounds.asked, self._clock())
        cancel = self._store.note(row.id, row.attempt, rounds.standing())
        if cancel is None:
            # Lost to another process, or ended.
            del self._held[row.id]
            return rounds.slice(False)
        rounds.is_cancelled = rounds.is_cancelled or cancel
        self._forget(rounds)
        return rounds.slice(False)

    def _forget(self, rounds: Rounds) -> None:
        """Delete regions that came back: what was merged of them is written down. In place."""
        if rounds.come_back:
            self._store.forget(rounds.come_back)
            rounds.come_back.clear()

    def _end(self, rounds: Rounds, state: State) -> Slice:
        """End a job. In place."""
        row = rounds.row
        if state == "failed":
            ended = self._store.finish(row.id, row.attempt, state, error=NOT_COMPUTED)
        else:
            ended = self._store.finish(row.id, row.attempt, state, rounds.last_standing())
            self._on_plan(rounds.reply)
        self._forget(rounds)
        del self._held[row.id]
        return rounds.slice(ended)

    def _hand_back(self, rounds: Rounds) -> None:
        """Leave a job to others. In place."""
        row = rounds.row
        try:
            self._store.note(row.id, row.attempt, rounds.standing())
            if self._store.release(row.id, row.attempt):
                self._returning.share_out(row.id)
        except Exception:  # the process ends: the job is begun anew from what is written down
            logger.exception("job %s was not handed back", row.id)
        del self._held[row.id]
