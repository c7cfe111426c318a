"""What jobs ask for, made once in each process where several of them share a request."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.service import plan_options, preparing
from app.plans.task import Task, task_of
from app.records.jobs.rows import JobRow
from app.requests.bounds import Bounds
from app.requests.conversion.preparing import StoppedError
from app.schemas.request import PlanRequest
from model.planner import PlanOptions

JOB_BOUNDS = Bounds(time_setting="TANDEM_MAX_JOB_SECONDS")
"""What a job may take; it was within the settings when it came."""

LEAST_PREPARING = 300.0
"""Seconds that may pass before the search of any job: nobody waits for it, and it would be lost.
Roads take minutes for ten thousand places."""


KEPT = 60.0
"""Seconds after which what nobody has used any more is forgotten."""

LOOKING = 0.5
"""Seconds between two signs of life of a job that waits for another to make the same."""


@dataclass(frozen=True)
class JobTask:
    """A job's task, and how to plan it."""

    task: Task
    options: PlanOptions


def asked_of(request: PlanRequest, search_threads: int, roads: Roads,
             should_stop: Callable[[], bool]) -> JobTask:
    """Return what a job's request asks for; raises as `TaskMaker.make` does."""
    work = preparing(request.options, JOB_BOUNDS, should_stop).beside_search(
        LEAST_PREPARING, "a job's search")
    task = task_of(request, work, roads=roads)
    return JobTask(task, plan_options(request.options, search_threads))


@dataclass
class _Kept:
    """What is made once, by whoever comes first."""

    lock: threading.Lock
    used_at: float
    asked: JobTask | None = None


class TaskMaker:
    """Makes tasks of the requests of jobs.

    Parameters
    ----------
    read
        Returns the request of a job.
    search_threads
        Threads where a request states none.
    roads
        Those to plan on.
    """

    def __init__(self, read: Callable[[JobRow], PlanRequest], search_threads: int,
                 roads: Roads = NO_ROADS) -> None:
        self._read = read
        self._search_threads = search_threads
        self._roads = roads
        self._kept: dict[str, _Kept] = {}
        self._lock = threading.Lock()

    def make(self, row: JobRow, should_stop: Callable[[], bool]) -> JobTask:
        """Return what a job asks for.

        Raises
        ------
        StoppedError
            If the work is to end.
        NoRoadsError
            If its roads don't answer.
        RequestError, KeyError
            If it can't be planned any more.
        """
        return asked_of(self._read(row), self._search_threads, self._roads, should_stop)

    def keep(self, job_id: str, asked: JobTask, now: float) -> None:
        """Keep what a job asks for, as others will need it. In place."""
        with self._lock:
            self._kept.setdefault(job_id, _Kept(threading.Lock(), now, asked)).used_at = now

    def shared(self, row: JobRow, should_stop: Callable[[], bool], now: float) -> JobTask:
        """Return what a job asks for, made before if it was; raises as `make` does. In place."""
        with self._lock:
            kept = self._kept.setdefault(row.id, _Kept(threading.Lock(), now))
            kept.used_at = now
        with _held(kept.lock, should_stop):
            if kept.asked is None:
                kept.asked = self.make(row, should_stop)
            return kept.asked

    def forget_unused(self, now: float) -> None:
        """Let go of what nobody used for long. In place.

        Parameters
        ----------
        now
            The time on `time.monotonic`, as ever here.
        """
        with self._lock:
            for job_id, kept in list(self._kept.items()):
                if now - kept.used_at > KEPT and not kept.lock.locked():
                    del self._kept[job_id]


@contextmanager
def _held(lock: threading.Lock, should_stop: Callable[[], bool]) -> Iterator[None]:
    """Hold a lock, asking while waiting for it whether to stop; raises `StoppedError` if so."""
    while not lock.acquire(timeout=LOOKING):
        if should_stop():
            raise StoppedError("The work was stopped before there was a plan: try again.")
    try:
        yield
    finally:
        lock.release()
