"""Plan jobs: slices of about a second that write down what a search in another thread found."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from pydantic_core import from_json, to_json

from app.conversion.preparing import StoppedError
from app.errors import NoRoadsError, RequestError
from app.jobs.rows import JobRow, Standing
from app.jobs.running import Returning, Running
from app.jobs.schemas import State
from app.jobs.search import EarlierWork, Search
from app.jobs.store import JobStore, now_ms
from app.plans.replies import Data
from app.plans.service import plan_options, preparing
from app.plans.task import task_of
from app.requests.bounds import Bounds
from app.roads.roads import NO_ROADS, Roads
from app.schemas.request import PlanRequest
from model.planner import PlanCheckError, Planner

logger = logging.getLogger(__name__)

SLICE = 1.0
"""Seconds after which a search's finds are written down."""

MAX_CRASHES = 5
"""Attempts in a row that may end without any progress before a job is given up."""

WITHHELD = "The plan found breaks a rule, so it is withheld."
NOT_COMPUTED = "The plan could not be computed."
POISONOUS = f"The process that planned ended unexpectedly, {MAX_CRASHES} times in a row."


LEAST_PREPARING = 300.0
"""Seconds that may pass before the search of any job: nobody waits for it, and it would be lost.
Roads take minutes for ten thousand places."""

ROADS_RETRY = 10.0
"""Seconds until roads that didn't answer are asked again for a job."""

REST_POLLING = 0.1
"""Seconds between two looks whether a job that waits is to go on waiting."""

MOST_WAITING = 6 * 3600.0
"""Seconds after which a job whose roads don't answer is given up."""

JOB_BOUNDS = Bounds(time_setting="TANDEM_MAX_JOB_SECONDS")
"""What a job may take; it was within the settings when it came."""


class Stopping(BaseException):
    """This process ends: what it works on stays open, for another to go on with.

    No `Exception`, which DBOS would write down as the outcome of the workflow.
    """


@dataclass(frozen=True)
class Slice:
    """What a slice came to."""

    over: bool
    iterations: int = 0
    cost: float | None = None


OVER = Slice(True)


class PlanWork:
    """The plan jobs that this process works on.

    Parameters
    ----------
    planner
        A warm one.
    store
        Where jobs are kept.
    read
        Returns the request of a job.
    search_threads
        Threads where a request states none.
    returning
        How jobs get back to their queue.
    on_plan
        Is told the reply of each job that is done.
    roads
        Those to plan on.
    """

    def __init__(self, planner: Planner, store: JobStore, read: Callable[[JobRow], PlanRequest],
                 search_threads: int, returning: Returning,
                 on_plan: Callable[[Data], None], roads: Roads = NO_ROADS) -> None:
        self._planner = planner
        self._store = store
        self._read = read
        self._search_threads = search_threads
        self._returning = returning
        self._on_plan = on_plan
        self._roads = roads
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
        running = self._running.get(job_id)
        if running is None:
            if self._stopping.is_set():
                raise Stopping
            running = self._begin(job_id)
        if running is None:
            return OVER
        self._running[job_id] = running
        has_ended = running.search.wait(SLICE)
        if self._stopping.is_set():
            self._hand_back(running)
            raise Stopping
        return self._end(running) if has_ended else self._note(running)

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
        has_waited = self._has_waited(job_id)
        row = self._taken(job_id, has_waited)
        if row is None:
            return None
        began = time.perf_counter()
        self._beginning[job_id] = threading.Event()
        try:
            request = self._read(row)
            work = preparing(request.options, JOB_BOUNDS, self._stopper(row))
            task = task_of(request, replace(work, least_time=LEAST_PREPARING), roads=self._roads)
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
        options = plan_options(request.options, self._search_threads)
        kept = self._store.result(job_id)
        earlier = EarlierWork(row.searched, row.search_iterations,
                              None if kept is None else from_json(kept))
        validated = time.perf_counter() - began
        return Running(row, Search(self._planner, task, options, earlier), validated,
                       best=earlier.reply)

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

    def _stopper(self, row: JobRow) -> Callable[[], bool]:
        """Return what tells whether a job that begins is to end, by this process or another.

        It gives signs of life, too.
        """
        cancelled, looked_at = self._beginning[row.id], time.monotonic()

        def should_stop() -> bool:
            nonlocal looked_at
            if time.monotonic() - looked_at > SLICE:
                looked_at = time.monotonic()
                if self._store.keep_alive(row.id, row.attempt) is not False:
                    cancelled.set()
            return cancelled.is_set() or self._stopping.is_set()

        return should_stop

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
            ended = self._store.finish(row.id, row.attempt, state,
                                       self._standing(running, progress, reply))
            self._on_plan(reply)
        del self._running[row.id]
        return self._slice(running, is_over=ended)

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
