"""What is answered where plans are made: one function for each question, told whether to stop."""

from collections.abc import Callable, Sequence

from app.plans.checking import answer_check
from app.plans.explaining import Subject, answer_explain, explain_job
from app.plans.fitting import answer_fit
from app.plans.quoting import answer_quote
from app.plans.workplace import Workplace
from app.schemas.explain import ExplainOptions
from app.schemas.request import PlanRequest
from app.serving.load.received import ReceivedBody

ShouldStop = Callable[[], bool]


def plan(place: Workplace, body: ReceivedBody, should_stop: ShouldStop) -> bytes:
    """Answer `POST /plan`."""
    return place.service.plan(body, should_stop)


def check(place: Workplace, body: ReceivedBody, should_stop: ShouldStop) -> bytes:
    """Answer `POST /check`."""
    return answer_check(body.content, place.bounds, should_stop, place.service.roads)


def explain(place: Workplace, body: ReceivedBody, should_stop: ShouldStop) -> bytes:
    """Answer `POST /explain`."""
    return answer_explain(body, place.bounds, place.service.planner, should_stop,
                          place.service.roads)


def fit(place: Workplace, body: ReceivedBody, should_stop: ShouldStop) -> bytes:
    """Answer `POST /fit`."""
    return answer_fit(body, place.bounds, should_stop, place.service.roads)


def quote_day(place: Workplace, body: ReceivedBody, first: Sequence[str],
              should_stop: ShouldStop) -> bytes:
    """Answer quotes of days, whose plan lacks some orders yet."""
    return answer_quote(body, place.bounds, should_stop, place.service.roads, place.quoted, first)


def quote(place: Workplace, body: ReceivedBody, should_stop: ShouldStop) -> bytes:
    """Answer `POST /quote`."""
    return answer_quote(body, place.bounds, should_stop, place.service.roads, place.quoted)


def explain_planned(place: Workplace, request: PlanRequest, reply: bytes, subject: Subject,
                    drones: bool, options: ExplainOptions, should_stop: ShouldStop) -> bytes:
    """Answer what `POST /explain` is asked of a job's plan."""
    return explain_job(request, reply, subject, drones, options, place.bounds,
                       place.service.planner, should_stop, place.service.roads)
