"""One job's search, in a thread of its own: annealing runs on while its finds are written down."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from app.plans.replies import Data
from app.serving.load.courtesy import stand_back
from model.judge.check import Evaluation
from model.planner import Elapsed, Listener, Planner, PlanOptions, PlanResult, Start
from model.search.improve import Progress
from model.solution import Solution

READING_SHARE = 0.05
"""Most of the time that reading and checking plans on the way may take."""

SHORTEST_REST = 0.05
"""Seconds of search that are worth beginning anew for."""

NEARLY_OVER = 0.999
"""Progress until the end."""


class Plannable(Protocol):
    """A whole task, or a region of one."""

    @property
    def far(self) -> object | None:
        """Legs that are estimated so far."""

    @property
    def replanning(self) -> object | None:
        """The plan that it goes on from."""

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ..., start: Solution | None = None) -> PlanResult:
        """Plan."""

    def check(self, solution: Solution) -> Evaluation:
        """Judge a plan."""

    def reply(self, options: PlanOptions, result: PlanResult) -> Data:
        """Return what is written down of a plan."""

    def read(self, reply: Data) -> Solution:
        """Return the plan that was written down."""


@dataclass(frozen=True)
class EarlierWork:
    """What earlier processes did for a job."""

    searched: float = 0.0  # seconds
    iterations: int = 0
    reply: Data | None = None  # to the best plan they found


@dataclass(frozen=True)
class Find:
    """A plan on the way."""

    solution: Solution
    cost: float  # as the search counts it


class Search:
    """Plans in a thread.

    Parameters
    ----------
    planner
        What plans.
    task
        What to plan.
    options
        How, `time_limit` being the time for all processes together.
    earlier
        What was done already.
    should_stop
        Tells whether to end within milliseconds, or once the first plan is made.
    """

    def __init__(self, planner: Planner, task: Plannable, options: PlanOptions,
                 earlier: EarlierWork, should_stop: Callable[[], bool]) -> None:
        self._task = task
        self._options = options
        self._earlier = earlier
        self._began = time.perf_counter()
        self._should_stop = should_stop
        self._done = threading.Event()
        self._find: Find | None = None
        self._first: Progress | None = None
        self._turns = 0
        self._next_reading = 0.0
        self._result: PlanResult | None = None
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, args=(planner,), name="job-search",
                                        daemon=True)
        self._thread.start()

    def wait(self, seconds: float) -> bool:
        """Wait for the end of the search; tell whether it has come."""
        return self._done.wait(seconds)

    @property
    def searched(self) -> float:
        """Seconds that all processes planned."""
        return self._earlier.searched + time.perf_counter() - self._began

    @property
    def iterations(self) -> int:
        """Iterations of all processes."""
        return self._earlier.iterations + self._turns

    @property
    def progress(self) -> float:
        """Share of the time or the iterations that is over."""
        return self._share(self.searched, self.iterations)

    def find(self) -> Find | None:
        """Return the best plan heard of so far."""
        return self._find

    def reply_so_far(self, find: Find) -> Data | None:
        """Return the reply to a plan on the way; None if it breaks a rule, which the end tells.

        None, too, if some of its legs are estimated so far.
        """
        if self._task.far is not None:
            return None
        began = time.perf_counter()
        evaluation = self._task.check(find.solution)
        if evaluation.violations or self._first is None:
            return None
        now = time.perf_counter()
        start: Start = "given" if self._task.replanning is not None else "insertion"
        if start == "insertion" and self._first.turns == 0:
            # Nothing but the policy's plan is there before the first turn.
            start = "policy"
        result = PlanResult(find.solution, evaluation, start, self._first.cost,
                            evaluation.cost.total, self._turns, self._options.threads, False,
                            Elapsed(0.0, now - self._began, now - began))
        reply = self._reply(result)
        self._rest_after(began)
        return reply

    def reply(self) -> Data:
        """Return the reply to the plan that the search ended with.

        Raises
        ------
        Exception
            Whatever ended the search.
        """
        if self._error is not None:
            raise self._error
        if self._result is None:
            raise RuntimeError("the search has not ended")
        return self._reply(self._result)

    def _run(self, planner: Planner) -> None:
        stand_back()
        try:
            self._result = self._task.plan(planner, self._remaining(), self._began,
                                           Listener(self._should_stop, self._hear), self._start())
        except Exception as error:  # for `reply` to raise: nobody waits for this thread
            self._error = error
        finally:
            self._done.set()

    def _share(self, searched: float, iterations: int) -> float:
        """Return the share of all that is to be done that so much is."""
        share = 0.0
        if self._options.time_limit > 0:
            share = searched / self._options.time_limit
        if self._options.search_iterations:
            share = max(share, iterations / self._options.search_iterations)
        return min(share, NEARLY_OVER)

    def _remaining(self) -> PlanOptions:
        """Return the options for what is left to do."""
        options, cooled = self._options, self._options.cooled
        limit, turns = options.time_limit, options.search_iterations
        if self._earlier.reply is not None:
            cooled += (1 - cooled) * self._share(self._earlier.searched, self._earlier.iterations)
        if limit > 0 and self._earlier.searched > 0:
            limit -= self._earlier.searched
            limit = limit if limit >= SHORTEST_REST else 0.0
        if turns:
            turns = max(0, turns - self._earlier.iterations)
        return replace(options, time_limit=limit, search_iterations=turns, cooled=cooled)

    def _start(self) -> Solution | None:
        if self._earlier.reply is None:
            return None
        return self._task.read(self._earlier.reply)

    def _hear(self, progress: Progress) -> None:
        if self._first is None:
            self._first = progress
        self._turns = progress.turns
        find = self._find
        began = time.perf_counter()
        if began >= self._next_reading and (find is None or progress.cost < find.cost):
            self._find = Find(progress.plan(), progress.cost)
            self._rest_after(began)

    def _rest_after(self, began: float) -> None:
        """Read no plan for a while, by how long that took since `began`. In place."""
        now = time.perf_counter()
        self._next_reading = max(self._next_reading, now + (now - began) / READING_SHARE)

    def _reply(self, result: PlanResult) -> Data:
        """Return the reply to a plan, earlier processes' work included."""
        reply = self._task.reply(self._options, result)
        earlier = self._earlier
        if earlier.searched > 0:
            solver = reply["solver"]
            solver["deterministic"] = False
            solver["search_iterations"] += earlier.iterations
            solver["elapsed"]["search"] += earlier.searched
        if earlier.reply is not None:
            before = earlier.reply["solver"]
            reply["solver"] |= {key: before[key] for key in ("start", "decoded_cost")}
        return reply
