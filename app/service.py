"""One loaded planner: is it ready, and what does it answer."""

import logging
import os
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from pydantic_core import to_json

from app.errors import NotReadyError
from app.load.bounds import UNBOUNDED, Bounds
from app.reading import read_request
from app.replanning import task_of
from app.replies import Data
from app.schemas_request import OptionsInput
from model.planner import ALONE, Listener, Planner, PlanOptions

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class ReceivedBody:
    """A request's body and when its last byte came, on `time.perf_counter`."""

    content: bytes
    received_at: float


@dataclass(frozen=True)
class Readiness:
    """Whether plans can be computed now, and if not, why."""

    is_ready: bool
    detail: str


class PlanService:
    """Answers planning requests once its planner is warm."""

    def __init__(self, planner: Planner, search_threads: int = 1,
                 on_plan: Callable[[Data], None] = lambda _: None,
                 bounds: Bounds = UNBOUNDED) -> None:
        self._planner = planner
        self._search_threads = search_threads
        self._on_plan = on_plan
        self._bounds = bounds
        self._executor = ThreadPoolExecutor(1, thread_name_prefix="warm")
        self._warming: Future[None] | None = None
        self._progress = "not started"

    def start(self) -> None:
        """Warm the planner in the background. In place."""
        self._warming = self._executor.submit(self._planner.warm, self._note)

    def stop(self) -> None:
        """Let go of the background thread. In place."""
        self._executor.shutdown(wait=False, cancel_futures=True)

    def readiness(self) -> Readiness:
        """Tell whether the planner is warm."""
        if self._warming is None or not self._warming.done():
            return Readiness(False, self._progress)
        error = self._warming.exception()
        if error is not None:
            return Readiness(False, f"warming up failed: {error}")
        return Readiness(True, "ready")

    def plan(self, body: ReceivedBody,
             should_stop: Callable[[], bool] = lambda: False) -> bytes:
        """Return the reply to a planning request as JSON.

        The search ends as soon as `should_stop` says so, with the best plan so far.

        Raises
        ------
        NotReadyError
            If the planner isn't warm yet.
        RequestError
            If `body` is no valid request.
        PlanCheckError
            If the plan found breaks a rule.
        """
        return answer(self.warm_planner(), body, self._search_threads, self._on_plan,
                      Listener(should_stop), self._bounds)

    def warm_planner(self) -> Planner:
        """Return the planner.

        Raises
        ------
        NotReadyError
            If it isn't warm yet.
        """
        readiness = self.readiness()
        if not readiness.is_ready:
            raise NotReadyError(f"The planner is not ready ({readiness.detail}): try again soon.")
        return self._planner

    def _note(self, progress: str) -> None:
        logger.info("warming up: %s", progress)
        self._progress = progress


def answer(planner: Planner, body: ReceivedBody, search_threads: int = 1,
           on_plan: Callable[[Data], None] = lambda _: None, listener: Listener = ALONE,
           bounds: Bounds = UNBOUNDED) -> bytes:
    """Return the reply to a planning request as JSON; raises as `PlanService.plan` does.

    A request that states no number of threads gets `search_threads`; `on_plan` is told the reply.
    """
    request = read_request(body.content, planner.policies, bounds)
    task = task_of(request)
    validated = time.perf_counter() - body.received_at
    options = plan_options(request.options, search_threads)
    result = task.plan(planner, options, body.received_at, listener)
    reply = task.reply(options, result)
    elapsed = reply["solver"]["elapsed"]
    elapsed["validate"] = validated
    elapsed["total"] = time.perf_counter() - body.received_at
    on_plan(reply)
    return to_json(reply)


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
        threads=min(threads, os.cpu_count() or 1),
    )
