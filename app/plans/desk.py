"""Where endpoints turn to for plans: those who make them work elsewhere."""

import threading
from collections.abc import Callable, Mapping
from typing import Any

from fastapi import Request
from pydantic_core import to_json

from app.maps.roads.roads import Roads
from app.plans.task import warning_replies
from app.plans.workplace import PLAN, REFUSED, VROOM_PLAN
from app.requests.bounds import Bounds
from app.requests.reading import read_request
from app.requests.warnings.finding import warnings_of
from app.serving.children.child import Call, Listeners
from app.serving.children.pool import Pool
from app.serving.load.abandoned import WaitingTurns
from app.serving.load.received import ReceivedBody
from app.serving.observe.metrics import Metrics


CHECKED_AT_ONCE = 2
"""How many jobs' requests are checked at once: plans never wait for those that do."""


class PlanDesk:
    """Has answers made by a pool.

    Parameters
    ----------
    pool
        Who makes them.
    policies
        Those that may be asked for.
    bounds
        Those of `POST /plan`.
    roads
        Those that the service has.
    metrics, count
        Where plans are counted, and who is told of each but those of `POST /vroom`.
    """

    def __init__(self, pool: Pool, policies: tuple[str, ...], bounds: Bounds, roads: Roads,
                 metrics: Metrics, count: Callable[[Mapping[str, Any]], None]) -> None:
        self.policies = policies
        self.roads = roads
        self._pool = pool
        self._bounds = bounds
        self._checks = threading.Semaphore(CHECKED_AT_ONCE)
        self._listeners: Listeners = {PLAN: count, VROOM_PLAN: metrics.count_vroom_plan,
                                      REFUSED: lambda _: metrics.count_refused_plan()}

    async def answer(self, planning: WaitingTurns, request: Request, function: Callable[..., Any],
                     *args: Any) -> Any:
        """Return what a function of `answers` says when its turn comes.

        Raises
        ------
        RequestError
            Whatever it finds wrong, as `WaitingTurns.run` does, or if the process died that it
            ran in.
        """
        return await planning.run(
            request, lambda should_stop: self.do(function, *args, should_stop=should_stop))

    def do(self, function: Callable[..., Any], *args: Any,
           should_stop: Callable[[], bool]) -> Any:
        """Return the same at once, in this thread."""
        return self._pool.do(function, args, should_stop, self._listeners)

    def check(self, function: Callable[..., Any], *args: Any,
              should_stop: Callable[[], bool]) -> Any:
        """Return the same of a job's request, of which few are checked at once."""
        with self._checks:
            return self.do(function, *args, should_stop=should_stop)

    def begin(self, function: Callable[..., Any], *args: Any, what: str,
              should_stop: Callable[[], bool],
              listeners: Mapping[str, Callable[[Any], None]]) -> Call:
        """Have work begin, and return it, to be listened to."""
        return self._pool.begin(function, args, should_stop, what, {**self._listeners, **listeners})

    def warnings(self, body: ReceivedBody) -> bytes:
        """Return the reply to a request of `POST /warnings` as JSON; nothing is planned.

        Raises
        ------
        RequestError
            If `body` is no valid request.
        """
        request = read_request(body.content, self.policies, self._bounds)
        return to_json({"warnings": warning_replies(warnings_of(request, self.roads.profiles))})
