"""Comparisons and sweeps as jobs: a job for each scenario, and one that waits for them all."""

import logging
import threading
import uuid
from collections.abc import Callable, Sequence
from dataclasses import replace

from pydantic_core import from_json, to_json

from app.records.jobs.rows import SCENARIO, JobRow, NewJob, Standing
from app.records.jobs.scenarios import Comparison, Scenarios
from app.records.jobs.schemas import Data, State
from app.records.jobs.slices import MAX_CRASHES, OVER, POISONOUS, SLICE, Slice, Stopping, hold
from app.records.jobs.store import JobStore

logger = logging.getLogger(__name__)


class StudyWork:
    """The comparisons and sweeps that this process watches over.

    Parameters
    ----------
    store
        Where jobs are kept.
    read
        Returns the scenarios of a job.
    add
        Keeps and enqueues jobs, unless they are there already.
    stop_jobs
        Has jobs cancelled.
    put_back
        Has a job begun again by any process.
    """

    def __init__(self, store: JobStore, read: Callable[[JobRow], Scenarios],
                 add: Callable[[Sequence[NewJob]], bool],
                 stop_jobs: Callable[[Sequence[JobRow]], None],
                 put_back: Callable[[str], None]) -> None:
        self._store = store
        self._read = read
        self._add = add
        self._stop_jobs = stop_jobs
        self._put_back = put_back
        self._held: dict[str, JobRow] = {}
        self._stopping = threading.Event()

    def advance(self, job_id: str) -> Slice:
        """Look at a job's scenarios after a slice, beginning them first if need be. In place.

        Raises
        ------
        Stopping
            If this process ends.
        """
        row = hold(self._held, job_id, self._stopping, self._begin)
        if row is None:
            return OVER
        if self._stopping.wait(SLICE):
            self.leave(job_id)
        children = self._store.children(job_id)
        iterations = sum(child.search_iterations for child in children)
        if all(child.is_over for child in children):
            ended = self._end(row, children, iterations)
            del self._held[job_id]
            return Slice(ended, iterations, _least_cost(children))
        self._note(row, children, iterations)
        return Slice(False, iterations, _least_cost(children))

    def holds(self, job_id: str) -> bool:
        """Tell whether a job is watched over here."""
        return job_id in self._held

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

    @property
    def is_idle(self) -> bool:
        """Tell whether nothing is watched over."""
        return not self._held

    def _begin(self, job_id: str) -> JobRow | None:
        """Take a job and begin its scenarios; None if it is over. In place."""
        row = self._store.claim(job_id)
        if row is None:
            return None
        if row.crashes > MAX_CRASHES:
            self._stop_jobs(self._store.children(job_id))
            self._store.finish(job_id, row.attempt, "failed", error=POISONOUS)
            return None
        if not self._store.children(job_id):
            count = len(self._read(row))
            self._add([_child(row, position) for position in range(count)])
        return row

    def _note(self, row: JobRow, children: Sequence[JobRow], iterations: int) -> None:
        progress = sum(1.0 if child.is_over else child.progress for child in children)
        standing = Standing(progress / len(children), iterations, _searched(children),
                            _least_cost(children))
        cancel = self._store.note(row.id, row.attempt, standing)
        if cancel is None:
            # Lost to another process, or ended. DBOS lets whoever owns the workflow go on.
            del self._held[row.id]
        elif cancel:
            self._stop_jobs([child for child in children if not child.is_over])

    def _end(self, row: JobRow, children: Sequence[JobRow], iterations: int) -> bool:
        """End a job whose scenarios have ended; tell whether this call did. In place."""
        standing = Standing(1.0, iterations, _searched(children), _least_cost(children))
        cancel = self._store.note(row.id, row.attempt, standing)
        state: State = "cancelled" if cancel else "done"
        result = to_json(study_result(self._store, self._read(row), children))
        # The least cost is that of no result, so it isn't stated with this one.
        return self._store.finish(row.id, row.attempt, state,
                                  replace(standing, cost=None, result=result))

    def _hand_back(self, row: JobRow) -> None:
        """Leave a job to others. In place."""
        try:
            if self._store.release(row.id, row.attempt):
                self._put_back(row.id)
        except Exception:  # the process ends: the job is begun anew from what is written down
            logger.exception("job %s was not handed back", row.id)
        del self._held[row.id]


def study_result(store: JobStore, scenarios: Scenarios, children: Sequence[JobRow]) -> Data:
    """Return the reply to a comparison or sweep whose scenarios have ended."""
    if isinstance(scenarios, Comparison):
        return {"fleets": {name: _fleet(child, _plan(store, child)) for name, child
                           in zip(scenarios.names, children, strict=True)}}
    axes = [{"path": axis.path.text, "values": axis.values} for axis in scenarios.axes]
    cells = [_cell(scenarios.values(position), child, _plan(store, child))
             for position, child in enumerate(children)]
    return {"axes": axes, "cells": cells}


def _plan(store: JobStore, child: JobRow) -> Data | None:
    body = store.result(child.id)
    return None if body is None else from_json(body)


def _fleet(child: JobRow, plan: Data | None) -> Data:
    reply = _scenario(child, plan)
    reply["cost"] = None if plan is None else plan["cost"]
    reply["working_rate"] = None if plan is None else _working_rate(plan)
    reply["plan"] = plan
    return reply


def _cell(values: Sequence[object], child: JobRow, plan: Data | None) -> Data:
    cost = None if plan is None else plan["cost"]["total"]
    return {"values": values, "cost": cost, **_scenario(child, plan)}


def _child(parent: JobRow, position: int) -> NewJob:
    # The same id each time, so that a scenario is never begun twice.
    child = uuid.uuid5(uuid.UUID(parent.id), str(position))
    return NewJob(str(child), "plan", parent.owner, parent.fingerprint, None,
                  parent=parent.id, position=position, priority=SCENARIO)


def _searched(children: Sequence[JobRow]) -> float:
    return sum(child.searched for child in children)


def _least_cost(children: Sequence[JobRow]) -> float | None:
    return min((child.cost for child in children if child.cost is not None), default=None)


def _scenario(child: JobRow, plan: Data | None) -> Data:
    """Return what replies to all scenarios have in common."""
    status = child.state if plan is None else plan["status"]
    summary = None if plan is None else plan["summary"]
    numbers = ("load_rate", "vehicles", "trips")
    return {
        "job": child.id,
        "status": status,
        "error": child.error,
        "unassigned": None if plan is None else len(plan["unassigned"]),
        **{name: None if summary is None else summary[name] for name in numbers},
    }


def _working_rate(plan: Data) -> Data | None:
    rates = [route["working_rate"] for route in plan["routes"]
             if route["working_rate"] is not None]
    if not rates:
        return None
    return {"min": min(rates), "mean": sum(rates) / len(rates), "max": max(rates)}
