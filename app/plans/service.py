"""One loaded planner: is it ready, and what does it answer."""

import logging
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from pydantic_core import to_json

from app.conversion.preparing import Preparing, StoppedError, patience
from app.conversion.travels import COMPUTED_FROM
from app.errors import NotReadyError
from app.load.bodies import ReceivedBody
from app.plans.large import LargeSearch
from app.plans.replies import Data
from app.plans.task import Task, task_of, warning_replies
from app.plans.warming import showing, words
from app.requests.bounds import UNBOUNDED, Bounds
from app.requests.reading import read_request
from app.requests.refusal import compile_scan
from app.roads.roads import NO_ROADS, Roads
from app.schemas.request import OptionsInput, PlanRequest
from app.warnings.finding import warnings_of
from model.kernel.cores import num_cores
from model.kernel.warming import Warmth
from model.planner import ALONE, Listener, Planner, PlanOptions
from model.problem import Problem

logger = logging.getLogger(__name__)

LOOKING = 0.2
"""Seconds between two looks whether the search for many customers is compiled."""


@dataclass(frozen=True)
class Readiness:
    """Whether all plans can be computed now, and if not, why."""

    is_ready: bool
    detail: str
    progress: float = 0.0  # of warming up, from 0 to 1
    decodes: bool = False  # plans that nothing improves can be computed


class PlanService:
    """Answers planning requests once its planner is warm."""

    def __init__(self, planner: Planner, search_threads: int = 1,
                 on_plan: Callable[[Data], None] = lambda _: None,
                 bounds: Bounds = UNBOUNDED, roads: Roads = NO_ROADS) -> None:
        self._planner = planner
        self.roads = roads
        self._search_threads = search_threads
        self._on_plan = on_plan
        self._bounds = bounds
        self._large = LargeSearch()
        self._executor = ThreadPoolExecutor(1, thread_name_prefix="warm")
        self._warming: Future[None] | None = None
        self._warmth: Warmth | None = None

    def start(self) -> None:
        """Warm the planner in the background. In place."""
        self._warming = self._executor.submit(self._warm)

    def stop(self) -> None:
        """Let go of what goes on in the background. In place."""
        self._large.stop()
        self._executor.shutdown(wait=False, cancel_futures=True)

    def readiness(self) -> Readiness:
        """Tell whether the planner is warm, or how far it is."""
        if self._warming is not None and self._warming.done():
            error = self._warming.exception()
            if error is not None:
                return Readiness(False, f"warming up failed: {error}")
            return Readiness(True, "ready", 1.0, True)
        warmth = self._warmth
        if warmth is None:
            return Readiness(False, "not started")
        return Readiness(False, words(warmth), warmth.share, warmth.decodes)

    def plan(self, body: ReceivedBody,
             should_stop: Callable[[], bool] = lambda: False) -> bytes:
        """Return the reply to a planning request as JSON.

        The search ends as soon as `should_stop` says so, with the best plan so far.

        Raises
        ------
        NotReadyError
            If the planner isn't warm enough yet.
        RequestError
            If `body` is no valid request.
        PlanCheckError
            If the plan found breaks a rule.
        """
        readiness = self.readiness()
        if not readiness.decodes:
            raise _not_ready(readiness)
        request = read_request(body.content, self._planner.policies, self._bounds)
        if not readiness.is_ready and not _only_decodes(request):
            raise _not_ready(readiness)
        return reply_to(self._planner, request, body.received_at, self._search_threads,
                        self._on_plan, Listener(should_stop), self._bounds, self.roads,
                        self._require_search)

    def warnings(self, body: ReceivedBody) -> bytes:
        """Return the reply to a request of `POST /warnings` as JSON; nothing is planned.

        Raises
        ------
        RequestError
            If `body` is no valid request.
        """
        request = read_request(body.content, self._planner.policies, self._bounds)
        return to_json({"warnings": warning_replies(warnings_of(request, self.roads.profiles))})

    def warm_planner(self) -> Planner:
        """Return the planner.

        Raises
        ------
        NotReadyError
            If it isn't warm yet.
        """
        readiness = self.readiness()
        if not readiness.is_ready:
            raise _not_ready(readiness)
        return self._planner

    def planner_for(self, problem: Problem) -> Planner:
        """Return the planner for a problem; raises as `plan` does."""
        planner = self.warm_planner()
        self._require_search(problem)
        return planner

    def await_search(self, problem: Problem, work: Preparing) -> None:
        """Wait until a problem can be searched, or the work is to end; raises as `plan` does."""
        while not self._large.serves(problem):
            if work.should_stop():
                raise StoppedError("The work was stopped before there was a plan: try again.")
            time.sleep(LOOKING)

    def _require_search(self, problem: Problem) -> None:
        """Refuse a problem that can't be searched yet; raises as `plan` does."""
        if not self._large.serves(problem):
            raise NotReadyError(
                f"The search for more than {COMPUTED_FROM} places, or legs of more than 2,147 km "
                "or 24 days, is being compiled, which takes some minutes once: try again then, or "
                "submit a job, which waits for it.")

    def _warm(self) -> None:
        """Warm the planner. In place."""
        compile_scan()
        with showing(lambda line: logger.info("warming up: %s", line)) as show:
            def note(warmth: Warmth) -> None:
                self._warmth = warmth
                show(warmth)

            self._planner.warm(note)
        if self._bounds.customers > COMPUTED_FROM:
            self._large.compile()


def _not_ready(readiness: Readiness) -> NotReadyError:
    return NotReadyError(f"The planner is not ready ({readiness.detail}): try again soon.")


def _only_decodes(request: PlanRequest) -> bool:
    """Tell whether a request is planned without any part of the search."""
    options = request.options
    return request.replan is None and 0 in (options.time_limit, options.search_iterations)


def reply_to(planner: Planner, request: PlanRequest, received_at: float, search_threads: int = 1,
             on_plan: Callable[[Data], None] = lambda _: None, listener: Listener = ALONE,
             bounds: Bounds = UNBOUNDED, roads: Roads = NO_ROADS,
             require: Callable[[Problem], None] = lambda _: None) -> bytes:
    """Return the reply to a planning request that was read as JSON; raises as `PlanService.plan`.

    A request that states no number of threads gets `search_threads`; `on_plan` is told the reply;
    `require` refuses what can't be searched.
    """
    work = preparing(request.options, bounds, listener.should_stop)
    task = task_of(request, work, roads=roads)
    require(task.problem)
    return reply_of(planner, task, plan_options(request.options, search_threads), received_at,
                    on_plan, listener, work.waited)


def reply_of(planner: Planner, task: Task, options: PlanOptions, received_at: float,
             on_plan: Callable[[Data], None] = lambda _: None, listener: Listener = ALONE,
             waited: float = 0.0) -> bytes:
    """Return the reply to a planning request that was converted as JSON, as `reply_to` does.

    `waited` are seconds since `received_at` that are no part of the time limit.
    """
    validated = time.perf_counter() - received_at
    result = task.plan(planner, options, received_at + waited, listener)
    reply = task.reply(options, result)
    elapsed = reply["solver"]["elapsed"]
    elapsed["validate"] = validated
    elapsed["total"] = time.perf_counter() - received_at
    on_plan(reply)
    return to_json(reply)


def preparing(stated: OptionsInput, bounds: Bounds,
              should_stop: Callable[[], bool]) -> Preparing:
    """Return the work before the search, which is a part of the time limit."""
    if 0 in (stated.time_limit, stated.search_iterations):
        return Preparing(should_stop, bounds.time_limit, f"the {bounds.time_limit:g} s of "
                         f"{bounds.time_setting}")
    is_stated = "time_limit" in stated.model_fields_set
    limit = f"the time_limit of {stated.time_limit:g} s"
    return Preparing(should_stop, stated.time_limit,
                     limit if is_stated else f"{limit}, which holds where none is stated",
                     most=bounds.time_limit, most_setting=bounds.time_setting,
                     patience=0.0 if is_stated else patience(bounds.time_limit))


def plan_options(stated: OptionsInput, search_threads: int = 1) -> PlanOptions:
    """Return the planner's options; `search_threads` stands where the request states none."""
    threads = search_threads if stated.threads is None else stated.threads
    return PlanOptions(
        policy=stated.policy,
        decoding=stated.decoding,
        num_samples=stated.num_samples,
        temperature=stated.temperature,
        seed=stated.seed,
        time_limit=stated.time_limit,
        search_iterations=stated.search_iterations,
        threads=min(threads, num_cores()),
    )
