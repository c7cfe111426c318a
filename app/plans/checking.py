"""Any plan against any problem: every rule that it breaks and its true cost."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails, to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.replan_replies import violation_reply
from app.plans.replies import Data, cost_reply, summary_reply
from app.plans.task import task_of, telling, warning_replies
from app.plans.timing import timed_plan
from app.requests.bounds import Bounds, bound_errors
from app.requests.conversion.preparing import Preparing
from app.requests.draft import Draft
from app.requests.plan_names import Known
from app.requests.plan_reading import plan_errors
from app.requests.reading import partial_draft, read_json, request_errors, tells_day
from app.requests.refusal import MAX_COUNTED_ERRORS, MAX_SEARCHED_BYTES, require_readable
from app.requests.validation import semantic_errors
from app.schemas.check import CheckReply, CheckRequest, PlannedProblem
from app.schemas.day import DayOfBody
from app.schemas.errors import (
    InputError, InvalidRequestError, NotJsonError, RequestError, schema_errors,
)
from app.schemas.hints import with_hints
from app.schemas.limits import MAX_NUM_SAMPLES, MAX_TIME_LIMIT
from app.schemas.times import read_body
from app.schemas.untimed import UntimedPlanInput
from model.judge.rules import Violation

PROBLEM, PLAN = "problem", "plan"

Kind = TypeVar("Kind", bound=PlannedProblem)


def answer_check(body: bytes, bounds: Bounds,
                 should_stop: Callable[[], bool] = lambda: False,
                 roads: Roads = NO_ROADS) -> bytes:
    """Return the reply to a request of `POST /check` as JSON, unless the work is to end.

    Raises
    ------
    RequestError
        If `body` is no valid request, or the work is to end.
    """
    request = read_check(body, bounds)
    task = task_of(request.problem, Preparing(
        should_stop, bounds.time_limit, f"the {bounds.time_limit:g} s of {bounds.time_setting}"),
        roads=roads)
    solution = timed_plan(task, request.plan, (PLAN,))
    evaluation = task.check(solution)
    is_untimed = any(route.is_untimed for route in request.plan.routes)
    violations = evaluation.violations
    reply: Data = {
        "feasible": evaluation.is_feasible,
        "violations": [violation_reply(violation, f"$.{PROBLEM}", f"$.{PLAN}") for violation
                       in (telling(violations) if is_untimed else violations)],
        "cost": cost_reply(evaluation.cost),
        "summary": summary_reply(task.problem, solution, evaluation),
        "warnings": warning_replies(warning.within(PROBLEM) for warning in task.warnings),
    }
    if is_untimed or task.risk is not None or task.geometry is not None:
        reply["routes"] = task.routes_reply(solution, evaluation)
        task.tell_lateness(solution, reply["routes"], reply)
    task.telling.tell(CheckReply, reply)
    return to_json(reply)


def read_check(body: bytes, bounds: Bounds) -> CheckRequest:
    """Return the request of `POST /check` that `body` holds; raises as `read_about_plan` does."""
    return read_about_plan(body, bounds, CheckRequest)


def unplanned(bounds: Bounds) -> Bounds:
    """Return bounds for what isn't planned: its options aren't bounded."""
    return replace(bounds, num_samples=MAX_NUM_SAMPLES, time_limit=MAX_TIME_LIMIT)


def read_about_plan(body: bytes, bounds: Bounds, kind: type[Kind]) -> Kind:
    """Return the request that `body` holds; nothing is planned, so its options aren't bounded.

    `kind` is what it has to be.

    Raises
    ------
    NotJsonError
        If `body` is not JSON.
    InvalidRequestError
        With every error found, if it is not a valid request.
    """
    bounds = unplanned(bounds)
    require_readable(body, kind)
    try:
        request = read_body(kind, body)
    except ValidationError as error:
        raise _refusal(error, body, bounds, kind) from error
    problem = request.whole_problem
    errors = [*_within(PROBLEM, request_errors(problem, None, bounds)),
              *plan_errors(request.plan, Known.of(
                  problem.depots, problem.customers, problem.fleet, problem.launch_sites),
                  (PLAN,))]
    if errors:
        raise InvalidRequestError([
            error.model_copy(update={"path": request.path_of(error.path)}) for error in errors])
    return request


def illegal_plan(violations: Iterable[Violation], what_then: str) -> InvalidRequestError:
    """Return the refusal of a plan, within a request, that breaks rules; `what_then` ends it."""
    broken = [violation_reply(each, f"$.{PROBLEM}", f"$.{PLAN}") for each in violations]
    return InvalidRequestError([InputError(
        code="ILLEGAL_PLAN", path=each["path"],
        message=f"The plan breaks {each['code']}: {each['message']}. {what_then}")
        for each in broken])


def _refusal(error: ValidationError, body: bytes, bounds: Bounds,
             kind: type[BaseModel]) -> RequestError:
    """Return the refusal of a body that doesn't fit the schema, other errors included."""
    if error.error_count() > MAX_COUNTED_ERRORS:
        message = f"The request has {error.error_count()} errors: compare it with the schema."
        return InvalidRequestError([InputError(code="TOO_MANY_ERRORS", path="$", message=message)])
    details = error.errors(include_url=False)
    of_problem = [_inner(item) for item in details if item["loc"][:1] == (PROBLEM,)]
    others = [item for item in details if item["loc"][:1] != (PROBLEM,)]
    errors = [*schema_errors(others), *_within(PROBLEM, schema_errors(of_problem))]
    if len(body) <= MAX_SEARCHED_BYTES or details[0]["type"] == "json_invalid":
        try:
            raw = read_json(body)
        except NotJsonError as not_json:
            return not_json
        if isinstance(raw, dict) and isinstance(raw.get(PROBLEM), dict) and tells_day(of_problem):
            draft = partial_draft(raw[PROBLEM], of_problem, DayOfBody(body))
            errors += _within(PROBLEM, [*semantic_errors(draft, None),
                                        *bound_errors(draft, bounds)])
            errors += _plan_errors(raw, others, draft, DayOfBody(body))
    return InvalidRequestError(with_hints(errors, kind))


def _inner(item: ErrorDetails) -> ErrorDetails:
    """Return what is wrong with a part, as seen from there."""
    inner = item.copy()
    inner["loc"] = item["loc"][1:]
    return inner


def _within(part: str, errors: Iterable[InputError]) -> list[InputError]:
    """Return a part's errors as seen from the whole."""
    return [error.model_copy(update={"path": f"$.{part}{error.path[1:]}"}) for error in errors]


def _plan_errors(raw: dict[str, Any], details: Sequence[ErrorDetails],
                 draft: Draft, day: DayOfBody) -> list[InputError]:
    """Return what a plan names that a partly broken problem surely doesn't have."""
    if PLAN not in raw or any(item["loc"][:1] == (PLAN,) for item in details):
        return []
    plan = read_body(UntimedPlanInput, to_json(raw[PLAN]), day)
    return plan_errors(plan, Known.of(draft.depots, draft.customers, draft.fleet,
                                      draft.launch_sites), (PLAN,))
