"""Plan jobs: slices of about a second that write down what a search elsewhere found."""

import logging
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any, Protocol

from app.records.clock import now_ms
from app.records.jobs.asked import TaskMaker
from app.records.jobs.order import (
    BEGUN, STANDING, Order, RegionOfJob, SearchOutcome, WholeJob, work_on,
)
from app.records.jobs.reading import stated
from app.records.jobs.region_task import ERRANDS, RegionTask
from app.records.jobs.rows import JobRow, Standing
from app.records.jobs.running import JobNews, RegionTerms, Returning, Running, sign_of_life
from app.records.jobs.schemas import State
from app.records.jobs.slices import (
    DEADLY, MAX_CRASHES, MAX_DEATHS, NOT_COMPUTED, OVER, POISONOUS, SLICE, WITHHELD, Slice,
    Stopping, hold,
)
from app.records.jobs.store import JobStore
from app.requests.conversion.preparing import StoppedError
from app.schemas.errors import NoRoadsError, RequestError
from app.serving.children.child import Call
from app.serving.children.errors import EndedUnexpectedlyError
from model.planner import PlanCheckError

logger = logging.getLogger(__name__)

ROADS_RETRY = 10.0
"""Seconds until roads that didn't answer are asked again for a job."""

REST_POLLING = 0.1
"""Seconds between two looks whether a job that waits is to go on waiting."""

MOST_WAITING = 6 * 3600.0
"""Seconds after which a job whose roads don't answer is given up."""

PATIENCE = 2.0
"""Slices without any news of a search after which a sign of life is given without."""


class Begin(Protocol):
    """Has work begin in a process that plans."""

    def __call__(self, function: Callable[..., Any], *args: Any, what: str,
                 should_stop: Callable[[], bool],
                 listeners: Mapping[str, Callable[[Any], None]]) -> Call:
        """Return the work under way."""


class PlanWork:
    """The plan jobs that are planned for this process.

    Parameters
    ----------
    begin
        Has them planned.
    store
        Where jobs are kept.
    asking
        What makes tasks of the requests of those planned by regions.
    returning
        How jobs get back to their queue.
    on_plan
        Is told of each plan that is done, as it is counted.
    terms
        Which jobs are planned by regions, after their first plan.
    """

    def __init__(self, begin: Begin, store: JobStore, asking: TaskMaker, returning: Returning,
                 on_plan: Callable[[Mapping[str, Any]], None], terms: RegionTerms) -> None:
        self._begin_call = begin
        self._store = store
        self._asking = asking
        self._returning = returning
        self._on_plan = on_plan
        self._terms = terms
        self._running: dict[str, Running] = {}
        self._beginning: dict[str, threading.Event] = {}  # set: cancelled
        self._stopping = threading.Event()

    def advance(self, job_id: str) -> Slice:
        """Work on a job for a slice, taking it first if need be. In place.

        Raises
        ------
        Stopping
            If this process ends, or leaves the job to others.
        """
        running = hold(self._running, job_id, self._stopping, self._begin)
        if running is None:
            return OVER
        if running.cancelled.is_set() or self._stopping.is_set():
            running.call.stop()
        has_ended = running.call.wait(PATIENCE * SLICE, running.should_stop,
                                      lambda: running.has_news)
        if self._stopping.is_set():
            self.leave(job_id)
        if has_ended:
            return self._end(running)
        if running.is_to_wait_its_turn:
            # Its legs are there, and known the next time: it is planned where the plans are.
            self.leave(job_id)
        return self._note(running)

    def holds(self, job_id: str) -> bool:
        """Tell whether a job is worked on here."""
        return job_id in self._running

    def cancel(self, job_id: str) -> None:
        """Stop a job at once if it runs here. In place."""
        beginning = self._beginning.get(job_id)
        if beginning is not None:
            beginning.set()
        running = self._running.get(job_id)
        if running is not None:
            running.cancelled.set()
            running.call.stop()

    def drop(self, job_id: str) -> None:
        """Let go of a job that failed. In place."""
        running = self._running.pop(job_id, None)
        if running is not None:
            running.call.drop()

    def leave(self, job_id: str) -> None:
        """Write down what was found for a job, and leave it to others. In place.

        Raises
        ------
        Stopping
            Always.
        """
        self._hand_back(self._running.pop(job_id))
        raise Stopping

    def stop(self) -> None:
        """Have all jobs handed back. In place."""
        self._stopping.set()
        for running in list(self._running.values()):
            running.call.stop()

    @property
    def is_idle(self) -> bool:
        """Tell whether nothing runs."""
        return not self._running and not self._beginning

    def _begin(self, job_id: str) -> Running | None:
        """Take a job and have it planned; None if there is nothing to plan. In place."""
        has_waited = self._has_waited(job_id)
        row = self._taken(job_id, has_waited)
        if row is None:
            return None
        cancelled = self._beginning[job_id] = threading.Event()
        should_stop, told = sign_of_life(self._store, row, cancelled, self._stopping), JobNews()

        def hear_standing(standing: Standing) -> None:
            told.standing = standing

        def hear_share(share: float) -> None:
            told.share = share

        try:
            call = self._begin_call(work_on, self._order(row, should_stop), what="job",
                                    should_stop=should_stop,
                                    listeners={BEGUN: hear_share, STANDING: hear_standing})
        except StoppedError:
            self._give_up(row)
            return None
        except EndedUnexpectedlyError:
            # None is free that plans, or there is no memory for one.
            self._release(row)
        except (RequestError, KeyError) as error:
            self._fail_invalid(row, error)
            return None
        finally:
            del self._beginning[job_id]
        return Running(row, call, cancelled, should_stop, told, has_waited, row.cost,
                       row.search_iterations)

    def _order(self, row: JobRow, should_stop: Callable[[], bool]) -> Order:
        """Return what is to be done for a job; raises as `TaskMaker.make` does."""
        kept = (row.created_at, row.searched, row.search_iterations, self._store.result(row.id))
        if row.kind != "region":
            return Order(WholeJob(*stated(self._store, row), self._terms), *kept)
        whole = None if row.parent is None else self._store.find(row.parent)
        if whole is None or whole.is_over:
            raise StoppedError("The job whose region this is has ended.")
        asked = self._asking.shared(whole, should_stop, time.monotonic())
        errand = ERRANDS.validate_json(self._store.request(row.id))
        options = replace(asked.options, time_limit=errand.seconds, seed=errand.seed,
                          cooled=errand.cooled)
        return Order(RegionOfJob(RegionTask.of(asked.task.problem, errand.region), options), *kept)

    def _taken(self, job_id: str, has_waited: bool) -> JobRow | None:
        """Take a job, and return it unless it is over then. In place."""
        row = self._store.claim(job_id)
        if row is None:
            if has_waited:
                # Cancelled meanwhile, and with it the workflow, which so has no outcome.
                raise Stopping
            return None
        if row.crashes > MAX_CRASHES or row.deaths >= MAX_DEATHS:
            self._fail(row, POISONOUS if row.crashes > MAX_CRASHES else DEADLY)
            return None
        if row.cancel_requested:
            self._store.finish(job_id, row.attempt, "cancelled")
            return None
        return row

    def _give_up(self, row: JobRow) -> None:
        """End a job that was cancelled before its search, or leave it to others. In place.

        Raises
        ------
        Stopping
            If this process ends.
        """
        if not self._stopping.is_set():
            self._store.finish(row.id, row.attempt, "cancelled")
            return
        self._release(row)

    def _release(self, row: JobRow) -> None:
        """Leave a job to others, or to this process at its turn. In place.

        Raises
        ------
        Stopping
            Always.
        """
        if self._store.release(row.id, row.attempt):
            self._returning.put_back(row.id)
        raise Stopping

    def _put_off(self, row: JobRow, error: NoRoadsError) -> None:
        """Have a job wait for its roads, or fail if it did for too long. In place.

        Raises
        ------
        Stopping
            If it waits, which others may do as well.
        """
        now = now_ms()
        waited = 0 if row.waiting_since is None else now - row.waiting_since
        if waited >= 1000 * MOST_WAITING:
            self._fail(row, f"{error} They were asked for {MOST_WAITING / 3600:.0f} hours.")
            return
        logger.warning("job %s waits: %s", row.id, error)
        cancel = self._store.put_off(row.id, row.attempt, str(error),
                                     now + int(1000 * ROADS_RETRY))
        if cancel is None:
            return
        if cancel:
            self._store.finish(row.id, None, "cancelled")
        self._returning.put_off(row.id)
        raise Stopping

    def _has_waited(self, job_id: str) -> bool:
        """Let time pass if a job was put off, and tell whether it was. In place.

        Raises
        ------
        Stopping
            If this process ends, or the job is cancelled meanwhile.
        """
        row = self._store.find(job_id)
        if row is None or row.retry_at is None:
            return False
        cancelled = self._beginning[job_id] = threading.Event()
        try:
            while now_ms() < row.retry_at and not self._stopping.is_set():
                if cancelled.wait(REST_POLLING):
                    raise Stopping
        finally:
            del self._beginning[job_id]
        if self._stopping.is_set():
            self._returning.put_off(job_id)
            raise Stopping
        return True

    def _note(self, running: Running) -> Slice:
        """Write down what a search found. In place."""
        row, standing = running.row, running.told.standing
        if standing is None:
            cancel = self._store.keep_alive(row.id, row.attempt)
        else:
            cancel = self._store.note(row.id, row.attempt, standing)
            running.told.standing = None
            running.take(standing)
        if cancel is None:
            # Lost to another process, or ended. DBOS lets whoever owns the workflow go on.
            self.drop(row.id)
        if cancel:
            self.cancel(row.id)
        return Slice(False, running.iterations, running.cost)

    def _end(self, running: Running) -> Slice:
        """End a job that is planned. In place."""
        # Held until that is written down: the database may be away.
        try:
            ended = self._ended(running)
        except Stopping:
            del self._running[running.row.id]
            raise
        del self._running[running.row.id]
        return Slice(ended, running.iterations, running.cost)

    def _ended(self, running: Running) -> bool:
        """Write down what came of a job, or leave it to others; tell whether it is over. In place.
        """
        row = running.row
        try:
            outcome: SearchOutcome = running.call.result()
        except EndedUnexpectedlyError:
            self._bear_death(row)
        except StoppedError:
            self._give_up(row)
        except NoRoadsError as error:
            self._put_off(row, error)
        except PlanCheckError as error:
            logger.error("plan of job %s withheld: %s", row.id, error)
            return self._fail(row, WITHHELD)
        except (RequestError, KeyError) as error:
            self._fail_invalid(row, error)
        except Exception:  # whatever planning raised is this job's end, not the process's
            logger.exception("job %s failed", row.id)
            return self._fail(row, NOT_COMPUTED)
        else:
            running.take(outcome.standing)
            return self._finish(running, outcome)
        return True

    def _finish(self, running: Running, outcome: SearchOutcome) -> bool:
        """Write down what a job came to; tell whether this ended it. In place.

        Raises
        ------
        Stopping
            If it goes on by regions.
        """
        row, standing, share = running.row, outcome.standing, running.told.share
        is_cancelled = running.cancelled.is_set()
        if share is not None and share < 1.0 and not is_cancelled:
            self._store.note(row.id, row.attempt, replace(standing, progress=share))
            if self._store.divide(row.id, row.attempt):
                self._returning.share_out(row.id)
            raise Stopping
        state: State = "cancelled" if is_cancelled else "done"
        if not is_cancelled:
            standing = replace(standing, progress=1.0)
        ended = self._store.finish(row.id, row.attempt, state, standing)
        if outcome.plan is not None:
            self._on_plan(outcome.plan)
        return ended

    def _bear_death(self, row: JobRow) -> None:
        """Have a job begun anew, alone, in whose process's death it may have had a hand. In place.

        Raises
        ------
        Stopping
            Always.
        """
        logger.error("job %s: the process that planned it ended unexpectedly", row.id)
        if self._store.lose(row.id, row.attempt):
            self._returning.put_back(row.id)
        raise Stopping

    def _hand_back(self, running: Running) -> None:
        """Write down what a stopped search found, and leave the job to others. In place."""
        row, call = running.row, running.call
        try:
            call.stop()
            if call.wait(SLICE, running.should_stop):
                with suppress(RequestError, PlanCheckError):
                    self._store.note(row.id, row.attempt, call.result().standing)
            if self._store.release(row.id, row.attempt):
                self._returning.put_back(row.id)
        except Exception:  # the process ends: the job is begun anew from what is written down
            logger.exception("job %s was not handed back", row.id)
        call.drop()

    def _fail(self, row: JobRow, error: str) -> bool:
        return self._store.finish(row.id, row.attempt, "failed", error=error)

    def _fail_invalid(self, row: JobRow, error: Exception) -> None:
        # It was valid when it came: a policy may have been removed since.
        reasons = " ".join(item.message for item in getattr(error, "errors", ())[:1])
        self._fail(row, f"The request can't be planned any more: {error} {reasons}".rstrip())
