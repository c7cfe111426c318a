"""One loaded planner: is it ready, and what does it answer."""

import logging
import os
import time
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from pydantic_core import to_json

from app.convert import to_problem
from app.errors import NotReadyError
from app.reading import read_request
from app.replies import plan_reply
from app.schemas_request import OptionsInput
from model.check import check
from model.planner import Elapsed, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution

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

    def __init__(self, planner: Planner, search_threads: int = 1) -> None:
        self._planner = planner
        self._search_threads = search_threads
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

    def plan(self, body: ReceivedBody) -> bytes:
        """Return the reply to a planning request as JSON.

        Raises
        ------
        NotReadyError
            If the planner isn't warm yet.
        RequestError
            If `body` is no valid request.
        PlanCheckError
            If the plan found breaks a rule.
        """
        readiness = self.readiness()
        if not readiness.is_ready:
            raise NotReadyError(f"The planner is not ready ({readiness.detail}): try again soon.")
        return answer(self._planner, body, self._search_threads)

    def _note(self, progress: str) -> None:
        logger.info("warming up: %s", progress)
        self._progress = progress


def answer(planner: Planner, body: ReceivedBody, search_threads: int = 1) -> bytes:
    """Return the reply to a planning request as JSON; raises as `PlanService.plan` does.

    A request that states no number of threads gets `search_threads`.
    """
    request = read_request(body.content, planner.policies)
    problem = to_problem(request)
    validated = time.perf_counter() - body.received_at
    options = plan_options(request.options, search_threads)
    result = (planner.plan(problem, options, body.received_at) if problem.customers
              else _no_plan(problem, options))
    reply = plan_reply(problem, options, result)
    elapsed = reply["solver"]["elapsed"]
    elapsed["validate"] = validated
    elapsed["total"] = time.perf_counter() - body.received_at
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


def _no_plan(problem: Problem, options: PlanOptions) -> PlanResult:
    """Return the empty plan of a problem without customers."""
    solution = Solution(())
    return PlanResult(
        solution=solution,
        evaluation=check(problem, solution),
        start="policy",
        decoded_cost=0.0,
        final_cost=0.0,
        search_iterations=0,
        threads=options.threads,
        deterministic=True,
        elapsed=Elapsed(decode=0.0, search=0.0, check=0.0),
    )
