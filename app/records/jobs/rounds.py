"""The rounds of a plan by regions, as the process sees them that watches over them."""

import threading
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from pydantic_core import to_json

from app.plans.replies import Data
from app.records.clock import now_ms
from app.records.jobs.asked import JobTask
from app.records.jobs.incumbent import Incumbent
from app.records.jobs.rows import JobRow, Standing
from app.records.jobs.search import NEARLY_OVER
from app.records.jobs.slices import Slice
from model.planner import Elapsed, PlanResult

LATE = 10.0
"""Seconds after its time when a region that hasn't come back is no longer waited for."""

SHORTEST = 0.05
"""Seconds of search that are worth another round."""

REASONS_FOR = 10.0
"""Longest time limit, in seconds, by which reasons are looked for why customers are left out."""


class Rounds:
    """A plan by regions under way.

    Parameters
    ----------
    row
        The job.
    asked
        What it asks for.
    best
        The best plan so far.
    reply
        What was written down of it.
    regions
        Those that an earlier process began.
    now
        The time on `time.monotonic`.
    """

    def __init__(self, row: JobRow, asked: JobTask, best: Incumbent, reply: Data,
                 regions: Sequence[JobRow], now: float) -> None:
        self.row = row
        self.asked = asked
        self.best = best
        self.reply = reply
        self.rng = np.random.default_rng([asked.options.seed, row.search_iterations])
        self.news = threading.Event()  # something is to be looked at
        self.come_back: set[str] = set()  # regions that were looked at, and are there still
        self.is_cancelled = row.cancel_requested
        self.closing_since: float | None = None
        self.at_once = 1  # regions that ran together in this round
        self._failures = 0
        self._size = len(regions)
        self._seconds = asked.options.time_limit  # of a region
        self._began: dict[str, float] = {}  # when regions were first seen to run
        self._first = reply["solver"]
        self._told = best.cost
        self._searched = row.searched
        self._looked_at = now
        self._ran = False
        self._iterations = row.search_iterations

    @property
    def remaining(self) -> float:
        """Seconds that are left."""
        return self.asked.options.time_limit - self._searched

    @property
    def share(self) -> float:
        """Share of the time that is over."""
        return min(1.0, self._searched / self.asked.options.time_limit)

    @property
    def is_last(self) -> bool:
        """Tell whether nothing more is to be begun."""
        return self.is_cancelled or self.remaining < SHORTEST

    @property
    def has_failed(self) -> bool:
        """Tell whether as many regions in a row failed as were begun together."""
        return 0 < self._size <= self._failures

    def begin(self, count: int, seconds: float) -> None:
        """Count anew for another round. In place."""
        self._size, self._seconds, self.at_once = count, seconds, 1
        self._began = {}

    def look(self, regions: Sequence[JobRow], now: float) -> None:
        """Count the time since the last look, unless all regions wait for their turn. In place."""
        running = [region.id for region in regions if region.state == "running"]
        if running or self._ran or any(region.is_over for region in regions):
            self._searched += now - self._looked_at
        self._ran, self._looked_at = bool(running), now
        self.at_once = max(self.at_once, len(running))
        for region in running:
            self._began.setdefault(region, now)

    def waits_for(self, regions: Sequence[JobRow], now: float) -> bool:
        """Tell whether to wait for regions that haven't come back."""
        latest = now - self._seconds - LATE
        return any(self._began.get(region.id, now) >= latest for region in regions)

    def note_outcome(self, region: JobRow) -> None:
        """Count a region that has come back. In place."""
        self.come_back.add(region.id)
        self._iterations += region.search_iterations
        self._failures = self._failures + 1 if region.state == "failed" else 0

    def standing(self) -> Standing:
        """Return how far the job has come, with its plan if that is new. In place."""
        progress = min(self.share, NEARLY_OVER)
        if not self.best.cost < self._told:
            return Standing(progress, self._iterations, self._searched)
        return self._told_of(progress)

    def last_standing(self) -> Standing:
        """Return what the job came to. In place."""
        is_whole = not self.is_cancelled
        return self._told_of(1.0 if is_whole else min(self.share, NEARLY_OVER))

    def slice(self, over: bool) -> Slice:
        """Return what a slice came to."""
        return Slice(over, self._iterations, float(self.reply["cost"]["total"]))

    def _told_of(self, progress: float) -> Standing:
        """Tell of the best plan. In place."""
        self._told = self.best.cost
        self.reply = self._reply()
        return Standing(progress, self._iterations, self._searched,
                        float(self.reply["cost"]["total"]), to_json(self.reply))

    def _reply(self) -> Data:
        first, best, options = self._first, self.best, self.asked.options
        elapsed = first["elapsed"]
        result = PlanResult(best.plan, best.evaluation, first["start"], first["decoded_cost"],
                            best.cost, self._iterations, options.threads, False,
                            Elapsed(elapsed["decode"], self._searched, elapsed["check"]))
        reply = self.asked.task.reply(
            replace(options, time_limit=min(options.time_limit, REASONS_FOR)), result)
        reply["solver"]["decoded_cost"] = first["decoded_cost"]
        reply["solver"]["elapsed"] |= {
            "validate": elapsed["validate"],
            "total": (now_ms() - self.row.created_at) / 1000}
        return reply


def num_regions(customers: int, usual: int, at_once: int) -> int:
    """Return into how many regions to divide a plan.

    As many as leave nobody idle at the end, if regions of about the usual size allow that.

    Parameters
    ----------
    customers
        In all.
    usual
        In a region.
    at_once
        Regions that ran together in the last round.
    """
    count = max(1, round(customers / usual))
    even = at_once * max(1, round(count / at_once))
    return even if count <= 2 * even <= 4 * count else count
