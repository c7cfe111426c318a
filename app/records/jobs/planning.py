"""Plan jobs: slices of about a second that write down what a search in another thread found."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import replace

from pydantic_core import from_json, to_json

from app.plans.replies import Data
from app.records.clock import now_ms
from app.records.jobs.asked import Asking
from app.records.jobs.region_task import ERRANDS, RegionTask
from app.records.jobs.rows import JobRow, Standing
from app.records.jobs.running import Begun, RegionTerms, Returning, Running, sign_of_life
from app.records.jobs.schemas import State
from app.records.jobs.search import EarlierWork, Search
from app.records.jobs.slices import (
    MAX_CRASHES, NOT_COMPUTED, OVER, POISONOUS, SLICE, WITHHELD, Slice, Stopping, hold,
)
from app.records.jobs.store import JobStore
from app.requests.conversion.preparing import StoppedError
from app.schemas.errors import NoRoadsError, RequestError
from app.serving.load.courtesy import NOBODY_WAITS, Courtesy
from model.planner import PlanCheckError, Planner

logger = logging.getLogger(__name__)

ROADS_RETRY = 10.0
"""Seconds until roads that didn't answer are asked again for a job."""

REST_POLLING = 0.1
"""Seconds between two looks whether a job that waits is to go on waiting."""

MOST_WAITING = 6 * 3600.0
"""Seconds after which a job whose roads don't answer is given up."""


class PlanWork:
    """The plan jobs that this process works on.

    Parameters
    ----------
    planner
        The one that this process has loaded.
    store
        Where jobs are kept.
    asking
        What makes tasks of their requests.
    returning
        How jobs get back to their queue.
    on_plan
        Is told the reply of each job that is done.
    terms
        Which jobs are planned by regions, after their first plan.
    courtesy
        Whom jobs make way for.
    """

    def __init__(self, planner: Planner, store: JobStore, asking: Asking, returning: Returning,
                 on_plan: Callable[[Data], None], terms: RegionTerms,
                 courtesy: Courtesy = NOBODY_WAITS) -> None:
        self._courtesy = courtesy
        self._planner = planner
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
            If this process ends.
        """
        running = hold(self._running, job_id, self._stopping, self._begin)
        if running is None:
            return OVER
        has_ended = running.search.wait(SLICE)
        self._courtesy.give_way(self._stopping.is_set)
        if self._stopping.is_set():
            self._hand_back(running)
            raise Stopping
        return self._end(running) if has_ended else self._note(running)

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
            running.is_cancelled = True
            running.search.stop()

    def drop(self, job_id: str) -> None:
        """Let go of a job that failed. In place."""
        running = self._running.pop(job_id, None)
        if running is not None:
            running.search.stop()

    def stop(self) -> None:
        """Have all jobs handed back. In place."""
        self._stopping.set()
        for running in list(self._running.values()):
            running.search.stop()

    @property
    def is_idle(self) -> bool:
        """Tell whether nothing runs."""
        return not self._running and not self._beginning

    def _begin(self, job_id: str) -> Running | None:
        """Take a job and start its search; None if there is nothing to search. In place."""
        self._courtesy.give_way(self._stopping.is_set)
        has_waited = self._has_waited(job_id)
        row = self._taken(job_id, has_waited)
        if row is None:
            return None
        began = time.perf_counter()
        self._beginning[job_id] = threading.Event()
        try:
            begun = self._begun(row)
        except StoppedError:
            self._give_up(row)
            return None
        except NoRoadsError as error:
            self._put_off(row, error)
            return None
        except (RequestError, KeyError) as error:
            # It was valid when it came: a policy may have been removed since.
            reasons = " ".join(item.message for item in getattr(error, "errors", ())[:1])
            self._fail(row, f"The request can't be planned any more: {error} {reasons}".rstrip())
            return None
        finally:
            del self._beginning[job_id]
        if has_waited:
            # Its legs are there, and known the next time: it is planned where the plans are.
            self._release(row)
        kept = self._store.result(job_id)
        earlier = EarlierWork(row.searched, row.search_iterations,
                              None if kept is None else from_json(kept))
        validated = time.perf_counter() - began
        return Running(row, Search(self._planner, begun.task, begun.options, earlier), validated,
                       begun.share, best=earlier.reply)

    def _begun(self, row: JobRow) -> Begun:
        """Return what is to be done for a job; raises as `Asking.make` does."""
        should_stop = sign_of_life(self._store, row, self._beginning[row.id], self._stopping)
        if row.kind != "region":
            asked = self._asking.make(row, should_stop)
            if not self._terms.divides(asked):
                return Begun(asked.task, asked.options)
            self._asking.keep(row.id, asked, time.monotonic())
            limit = asked.options.time_limit
            first = replace(asked.options, time_limit=self._terms.seconds)
            return Begun(asked.task, first, self._terms.seconds / limit)
        whole = None if row.parent is None else self._store.find(row.parent)
        if whole is None or whole.is_over:
            raise StoppedError("The job whose region this is has ended.")
        asked = self._asking.shared(whole, should_stop, time.monotonic())
        errand = ERRANDS.validate_json(self._store.request(row.id))
        return Begun(RegionTask.of(asked.task.problem, errand.region),
                     replace(asked.options, time_limit=errand.seconds, seed=errand.seed,
                             cooled=errand.cooled))

    def _taken(self, job_id: str, has_waited: bool) -> JobRow | None:
        """Take a job, and return it unless it is over then. In place."""
        row = self._store.claim(job_id)
        if row is None:
            if has_waited:
                # Cancelled meanwhile, and with it the workflow, which so has no outcome.
                raise Stopping
            return None
        if row.crashes > MAX_CRASHES:
            self._fail(row, POISONOUS)
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
        search = running.search
        find, reply = search.find(), None
        if find is not None and find is not running.noted:
            reply = search.reply_so_far(find)
        cancel = self._store.note(running.row.id, running.row.attempt,
                                  self._standing(running, search.progress, reply))
        running.noted = find
        if reply is not None and (running.best is None or cost_of(reply) < cost_of(running.best)):
            running.best = reply
        if cancel is None:
            # Lost to another process, or ended. DBOS lets whoever owns the workflow go on.
            search.stop()
            del self._running[running.row.id]
        if cancel:
            self.cancel(running.row.id)
        return self._slice(running, is_over=False)

    def _end(self, running: Running) -> Slice:
        """End a job whose search has ended. In place."""
        row = running.row
        try:
            reply = self._better(running, running.search.reply())
        except PlanCheckError as error:
            logger.error("plan of job %s withheld: %s", row.id, error)
            ended = self._fail(row, WITHHELD)
        except NoRoadsError as error:
            del self._running[row.id]
            self._put_off(row, error)
            return OVER
        except Exception:  # whatever planning raised is this job's end, not the process's
            logger.exception("job %s failed", row.id)
            ended = self._fail(row, NOT_COMPUTED)
        else:
            state: State = "cancelled" if running.is_cancelled else "done"
            progress = running.search.progress if running.is_cancelled else 1.0
            running.best = reply
            if running.share < 1.0 and not running.is_cancelled:
                self._share_out(running, reply)
            ended = self._store.finish(row.id, row.attempt, state,
                                       self._standing(running, progress, reply))
            if row.kind == "plan":
                self._on_plan(reply)
        del self._running[row.id]
        return self._slice(running, is_over=ended)

    def _share_out(self, running: Running, reply: Data) -> None:
        """Write down a job's first plan, and have it go on by regions. In place.

        Raises
        ------
        Stopping
            Always.
        """
        row = running.row
        self._store.note(row.id, row.attempt, self._standing(running, 1.0, reply))
        del self._running[row.id]
        if self._store.divide(row.id, row.attempt):
            self._returning.share_out(row.id)
        raise Stopping

    def _better(self, running: Running, reply: Data) -> Data:
        """Return a reply, with the best plan written down if that is cheaper by a hair."""
        best = running.best
        if best is None or cost_of(reply) <= cost_of(best):
            return reply
        return best | {"solver": reply["solver"] | {"final_cost": cost_of(best)}}

    def _hand_back(self, running: Running) -> None:
        """Write down what a stopped search found, and leave the job to others. In place."""
        row, search = running.row, running.search
        try:
            reply = self._better(running, search.reply()) if search.wait(SLICE) else None
            self._store.note(row.id, row.attempt,
                             self._standing(running, search.progress, reply))
            if self._store.release(row.id, row.attempt):
                self._returning.put_back(row.id)
        except Exception:  # the process ends: the job is begun anew from what is written down
            logger.exception("job %s was not handed back", row.id)
        del self._running[row.id]

    def _fail(self, row: JobRow, error: str) -> bool:
        return self._store.finish(row.id, row.attempt, "failed", error=error)

    def _standing(self, running: Running, progress: float, reply: Data | None) -> Standing:
        search = running.search
        progress *= running.share
        if reply is None:
            return Standing(progress, search.iterations, search.searched)
        elapsed = reply["solver"]["elapsed"]
        elapsed["validate"] = running.validated
        elapsed["total"] = (now_ms() - running.row.created_at) / 1000
        return Standing(progress, search.iterations, search.searched, cost_of(reply),
                        to_json(reply))

    @staticmethod
    def _slice(running: Running, is_over: bool) -> Slice:
        cost = None if running.best is None else cost_of(running.best)
        return Slice(is_over, running.search.iterations, cost)


def cost_of(reply: Data) -> float:
    """Return the cost of a plan by its reply."""
    return float(reply["cost"]["total"])
