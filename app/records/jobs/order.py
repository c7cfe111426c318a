"""A job as the process sees it that plans it: what it gets, and what it tells meanwhile."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from pydantic_core import from_json, to_json

from app.plans.replies import Data
from app.plans.workplace import Workplace
from app.records.clock import now_ms
from app.records.jobs.asked import asked_of
from app.records.jobs.reading import JobReader, request_of
from app.records.jobs.region_task import RegionTask
from app.records.jobs.rows import Standing
from app.records.jobs.running import RegionTerms, RunningJob
from app.records.jobs.schemas import Kind
from app.records.jobs.search import EarlierWork, Find, Search
from app.records.jobs.slices import SLICE
from app.serving.observe.metrics import countable
from model.planner import PlanOptions

BEGUN, STANDING = "begun", "standing"
"""What is told: the share of the job's time that is searched now, then how far that has come."""

ShouldStop = Callable[[], bool]


@dataclass(frozen=True)
class WholeJob:
    """A request to plan, or one of a study's."""

    body: bytes
    study: str | None  # None: `body` is the request itself
    position: int  # among the study's scenarios
    terms: RegionTerms

    def begun(self, place: Workplace, should_stop: ShouldStop) -> RunningJob:
        """Return what is to be done; raises as `asked_of` and `request_of` do."""
        service = place.service
        request = request_of(self.body, self.study, self.position, service.planner.policies)
        asked = asked_of(request, place.settings.search_threads, service.roads, should_stop)
        if not self.terms.divides(asked):
            return RunningJob(asked.task, asked.options)
        first = replace(asked.options, time_limit=self.terms.seconds)
        return RunningJob(asked.task, first, self.terms.seconds / asked.options.time_limit)


@dataclass(frozen=True)
class RegionOfJob:
    """A region that was cut out already."""

    task: RegionTask
    options: PlanOptions

    def begun(self, place: Workplace, should_stop: ShouldStop) -> RunningJob:
        """Return what is to be done."""
        return RunningJob(self.task, self.options)


@dataclass(frozen=True)
class Order:
    """What to plan, and what was done already."""

    subject: WholeJob | RegionOfJob
    created_at: int  # milliseconds since 1970
    searched: float  # seconds
    iterations: int
    reply: bytes | None  # to the best plan so far, as JSON


@dataclass(frozen=True)
class SearchOutcome:
    """What a search came to."""

    standing: Standing
    plan: dict[str, Any] | None  # as it is counted; None: it is a region's


def validate(place: Workplace, kind: Kind, body: bytes, should_stop: ShouldStop) -> int:
    """Check a job's request; returns and raises as `JobReader.validate` does."""
    service = place.service
    return JobReader(service.planner.policies, place.settings, service.roads).validate(
        kind, body, should_stop)


def work_on(place: Workplace, order: Order, should_stop: ShouldStop) -> SearchOutcome:
    """Plan a job until its end, or until told to stop, and tell meanwhile how far it has come.

    Raises
    ------
    StoppedError
        If it is stopped before its search.
    RequestError, KeyError
        If it can't be planned any more, or its roads don't answer.
    PlanCheckError
        If the plan found breaks a rule.
    """
    began = time.perf_counter()
    begun = order.subject.begun(place, should_stop)
    work = _Work(place, order, begun, time.perf_counter() - began, should_stop)
    place.line.tell(BEGUN, begun.share)
    while not work.search.wait(SLICE):
        place.line.tell(STANDING, work.standing())
    return work.outcome()


class _Work:
    """A search, and what is told of it."""

    def __init__(self, place: Workplace, order: Order, begun: RunningJob, validated: float,
                 should_stop: ShouldStop) -> None:
        self._order = order
        self._share = begun.share
        self._validated = validated
        self._noted: Find | None = None
        self._best = None if order.reply is None else from_json(order.reply)
        self.search = Search(place.service.planner, begun.task, begun.options, EarlierWork(
            order.searched, order.iterations, self._best), should_stop)

    def standing(self) -> Standing:
        """Return how far the search has come, with its plan if that is new. In place."""
        search = self.search
        find, reply = search.find(), None
        if find is not None and find is not self._noted:
            reply = search.reply_so_far(find)
        self._noted = find
        if reply is not None and (self._best is None or cost_of(reply) < cost_of(self._best)):
            self._best = reply
        return self._standing(reply)

    def outcome(self) -> SearchOutcome:
        """Return what the search came to; raises what ended it."""
        reply = self._better(self.search.reply())
        is_whole = isinstance(self._order.subject, WholeJob)
        return SearchOutcome(self._standing(reply), countable(reply) if is_whole else None)

    def _better(self, reply: Data) -> Data:
        """Return a reply, with the best plan told if that is cheaper by a hair."""
        best = self._best
        if best is None or cost_of(reply) <= cost_of(best):
            return reply
        return best | {"solver": reply["solver"] | {"final_cost": cost_of(best)}}

    def _standing(self, reply: Data | None) -> Standing:
        search = self.search
        progress = self._share * search.progress
        if reply is None:
            return Standing(progress, search.iterations, search.searched)
        elapsed = reply["solver"]["elapsed"]
        elapsed["validate"] = self._validated
        elapsed["total"] = (now_ms() - self._order.created_at) / 1000
        return Standing(progress, search.iterations, search.searched, cost_of(reply),
                        to_json(reply))


def cost_of(reply: Data) -> float:
    """Return the cost of a plan by its reply."""
    return float(reply["cost"]["total"])
