"""Plans of which quotes were asked last: what doesn't hang on the order asked is made once."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec
from pydantic import ValidationError
from pydantic_core import to_json

from app.plans.checking import PLAN, PROBLEM, read_about_plan, unplanned
from app.plans.task import Task
from app.requests.bounds import Bounds
from app.requests.reading import request_errors
from app.schemas.day import DayOfBody
from app.schemas.plan import PlanInput
from app.schemas.quote import OrderAsked, QuoteRequest
from app.schemas.times import read_body
from app.schemas.untimed import UntimedPlanInput
from app.serving.remembered import Remembered
from model.judge.check import JudgedRoute
from model.problem.altered import differ_in_last
from model.solution import Solution

MOST_BYTES = 2**21
"""Of problems and plans, as they were sent, that are remembered: what is made of them takes some
dozen times as much."""

Key = tuple[bytes, bytes, tuple[str, ...]]
"""A problem and a plan as they were sent, and who is put into it first."""


class LastQuote(NamedTuple):
    """What was made for the order asked last."""

    task: Task
    solution: Solution
    judged: Mapping[int, JudgedRoute]
    handed: Solution | None = None  # what is left of it, where some has happened

    def fits(self, task: Task) -> bool:
        """Tell whether it is the same for an order of another task about the same plan."""
        if task.terms is not None:
            return task.terms is self.task.terms
        return differ_in_last(self.task.problem, task.problem)


class QuotedPlan:
    """A problem and a plan, and what was made of them for an order."""

    def __init__(self, request: QuoteRequest, size: int) -> None:
        self.request = request
        self.size = size
        self._last: LastQuote | None = None
        replan = request.problem.replan
        plans = [request.plan, *([] if replan is None else [replan.plan])]
        self._named = {name for plan in plans for name in _named(plan)} | (
            set() if replan is None else {*replan.pinned, *replan.promised, *replan.doubtful})

    def last_beside(self, request: QuoteRequest) -> LastQuote | None:
        """Return what was made for another order that may hold for this one, too."""
        return self._last if self._is_new(request) else None

    def keep(self, request: QuoteRequest, last: LastQuote) -> None:
        """Keep what was made for an order. In place."""
        if self._is_new(request):
            self._last = last

    def _is_new(self, request: QuoteRequest) -> bool:
        """Tell whether no plan names the order."""
        return request.order is not None and request.order.id not in self._named


QuotedPlans = Remembered[Key, QuotedPlan]


def quoted_plans() -> QuotedPlans:
    """Return room for plans."""
    return Remembered(MOST_BYTES, lambda plan: plan.size)


def read_quote(body: bytes, bounds: Bounds, plans: QuotedPlans,
               first: Sequence[str] = ()) -> tuple[QuoteRequest, QuotedPlan]:
    """Return the request of `POST /quote` that a body holds, and its plan, if known not read again.

    Raises as `read_about_plan` does. `first` are orders that are put into the plan before.
    """
    key, rest = _parts(body, tuple(first))
    known = None if key is None else plans.get(key)
    request = None if known is None else _of_known(known, rest, body, bounds)
    if known is not None and request is not None:
        return request, known
    request = read_about_plan(body, bounds, QuoteRequest)
    quoted = QuotedPlan(request, len(body))
    return request, quoted if key is None else plans.put(key, quoted)


def _parts(body: bytes, first: tuple[str, ...]) -> tuple[Key | None, bytes]:
    """Return the problem and the plan that a body states, if it does, and the rest of it."""
    try:
        parts = msgspec.json.decode(body, type=dict[str, msgspec.Raw])
        key = bytes(parts.pop(PROBLEM)), bytes(parts.pop(PLAN)), first
    except (msgspec.DecodeError, RecursionError, KeyError):
        return None, b""
    return key, b"{%b}" % b",".join([
        b"%b:%b" % (to_json(name), bytes(part)) for name, part in parts.items()])


def _of_known(known: QuotedPlan, rest: bytes, body: bytes, bounds: Bounds) -> QuoteRequest | None:
    """Return a request about a plan that is known; None: it isn't valid."""
    try:
        asked = read_body(OrderAsked, rest, DayOfBody(body))
    except ValidationError:
        return None
    request = known.request.model_copy(update={
        name: getattr(asked, name) for name in OrderAsked.model_fields})
    return None if request_errors(request.whole_problem, None, unplanned(bounds)) else request


def _named(plan: PlanInput | UntimedPlanInput) -> Iterator[str]:
    """Yield the ids of whom a plan names."""
    for route in plan.routes:
        for trip in route.trips:
            yield from [stop.id for stop in trip.stops]
            yield from [visit.id for sortie in trip.sorties for visit in sortie.customers]
    yield from [left.id for left in plan.unassigned]
