"""One loaded planner, and what it answers."""

import time
from collections.abc import Callable

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.replies import Data
from app.plans.task import Task, task_of
from app.requests.bounds import UNBOUNDED, Bounds
from app.requests.conversion.preparing import Preparing, patience
from app.requests.reading import read_request
from app.schemas.request import OptionsInput, PlanRequest
from app.serving.load.received import ReceivedBody
from model.engine.cores import num_cores
from model.planner import ALONE, Listener, Planner, PlanOptions


class PlanService:
    """Answers planning requests."""

    def __init__(self, planner: Planner, search_threads: int = 1,
                 on_plan: Callable[[Data], None] = lambda _: None,
                 bounds: Bounds = UNBOUNDED, roads: Roads = NO_ROADS) -> None:
        self.planner = planner
        self.roads = roads
        self._search_threads = search_threads
        self._on_plan = on_plan
        self._bounds = bounds

    def plan(self, body: ReceivedBody,
             should_stop: Callable[[], bool] = lambda: False) -> bytes:
        """Return the reply to a planning request as JSON.

        The search ends as soon as `should_stop` says so, with the best plan so far.

        Raises
        ------
        RequestError
            If `body` is no valid request.
        PlanCheckError
            If the plan found breaks a rule.
        """
        request = read_request(body.content, self.planner.policies, self._bounds)
        return self.reply_to(request, body.received_at, Listener(should_stop))

    def reply_to(self, request: PlanRequest, received_at: float,
                 listener: Listener = ALONE) -> bytes:
        """Return the reply to a planning request that was read; raises as `plan`."""
        work = preparing(request.options, self._bounds, listener.should_stop)
        task = task_of(request, work, roads=self.roads)
        reply = reply_of(self.planner, task, plan_options(request.options, self._search_threads),
                         received_at, listener, work.waited)
        self._on_plan(reply)
        return to_json(reply)


def reply_of(planner: Planner, task: Task, options: PlanOptions, received_at: float,
             listener: Listener = ALONE, waited: float = 0.0) -> Data:
    """Return the reply to a planning request that was converted; raises as `PlanService.plan`.

    `waited` are seconds since `received_at` that are no part of the time limit.
    """
    validated = time.perf_counter() - received_at
    result = task.plan(planner, options, received_at + waited, listener)
    reply = task.reply(options, result)
    elapsed = reply["solver"]["elapsed"]
    elapsed["validate"] = validated
    elapsed["total"] = time.perf_counter() - received_at
    return reply


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
