"""Where one more customer fits a plan best, or one whom it serves elsewhere."""

import time
from collections.abc import Callable
from dataclasses import replace

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN, PROBLEM, illegal_plan, read_about_plan
from app.plans.explain_replies import here_reply, more_than_without, placed_reply, rules_reply
from app.plans.explaining import LEAST_TRYING, preparing_within, require_known, require_within
from app.plans.replies import Data, cost_reply
from app.plans.task import Task, task_of, warning_replies
from app.plans.timing import timed_plan
from app.requests.bounds import Bounds
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.fit import FitReply, FitRequest
from app.serving.load.bodies import ReceivedBody
from model.judge.bench import Bench, Trial
from model.judge.check import Evaluation
from model.judge.fitting import find_fits, new_violations, spot_of, vehicle_of
from model.judge.places import find_place, used_place
from model.solution import Solution

TRYING_SHARE = 0.9
"""Share of the time limit after which no more places are tried."""


def answer_fit(body: ReceivedBody, bounds: Bounds,
               should_stop: Callable[[], bool] = lambda: False,
               roads: Roads = NO_ROADS) -> bytes:
    """Return the reply to a request of `POST /fit` as JSON, unless the work is to end.

    Raises
    ------
    RequestError
        If `body` is no valid request, the plan has routes that can't be read, or the work is to
        end.
    """
    request = read_fit(body.content, bounds)
    task = task_of(request.whole_problem, preparing_within(bounds, should_stop),
                   roads=roads.with_all_legs())
    solution = timed_plan(task, request.plan, (PLAN,))
    problem, judged = task.judged_problem, task.judge_routes(solution)
    evaluation = task.setting.judge(problem, solution, judged)
    _require_readable(evaluation)
    now, limit = time.perf_counter(), request.options.time_limit
    until = max(body.received_at + TRYING_SHARE * limit, now + LEAST_TRYING * limit)
    node = used_place(problem, solution, _node_of(task, request))
    bench = Bench(problem, _with_customer(solution, node), node, task.setting, judged)
    fits = find_fits(bench, request.count, until,
                     vehicle_of if request.one_per_vehicle else spot_of)
    reply: Data = {
        "customer": problem.customer_at(problem.first_place(node)).id,
        "cost": cost_reply(evaluation.cost),
        "here": here_reply(bench),
        "places": [_place_reply(bench, trial) | {"route": _route(task, bench, trial)}
                   for trial in fits.places],
        "others": [_place_reply(bench, trial) for trial in fits.others],
        "complete": fits.is_complete,
        "warnings": warning_replies(
            warning._replace(path=request.path_of(warning.path))
            for warning in (each.within(PROBLEM) for each in task.warnings)),
    }
    task.telling.tell(FitReply, reply)
    return to_json(reply)


def read_fit(body: bytes, bounds: Bounds) -> FitRequest:
    """Return the request that `body` holds; raises as `read_about_plan` does."""
    request = read_about_plan(body, bounds, FitRequest)
    require_within(request.options, bounds, "$.options.time_limit")
    require_known(request.problem, request.customer, "$.customer")
    if (request.customer is None) == (request.new_customer is None):
        raise InvalidRequestError([InputError(
            code="MISSING_FIELD" if request.customer is None else "UNKNOWN_FIELD",
            path="$.customer", message="Either customer or new_customer says for whom a place is "
            "sought: state one of the two.")])
    return request


def _require_readable(evaluation: Evaluation) -> None:
    """Refuse a plan with routes whose times can't be told; raises `InvalidRequestError`."""
    if all(metrics.trips for metrics in evaluation.routes):
        return
    raise illegal_plan(evaluation.violations, "Nobody can be added to a plan that can't be read: "
                       "correct it.")


def _node_of(task: Task, request: FitRequest) -> int:
    """Return the customer's node."""
    customer = request.new_customer
    name = request.customer if customer is None else customer.id
    return next(node for node, each
                in enumerate(task.problem.customers, task.problem.num_depots) if each.id == name)


def _with_customer(solution: Solution, node: int) -> Solution:
    """Return a plan that leaves a customer out, if it doesn't have him at all."""
    if node in solution.unassigned or find_place(solution, node) is not None:
        return solution
    return replace(solution, unassigned=(*solution.unassigned, node))


def _place_reply(bench: Bench, trial: Trial) -> Data:
    broken = new_violations(bench, trial)
    return {
        **placed_reply(bench, trial, find_place(trial.solution, bench.node)),
        "cost": more_than_without(bench, trial),
        "feasible": not broken,
        "reasons": rules_reply(broken),
    }


def _route(task: Task, bench: Bench, trial: Trial) -> Data | None:
    """Return the route that serves the customer."""
    found = find_place(trial.solution, bench.node)
    if found is None:
        return None
    only = replace(trial.solution, routes=(trial.solution.routes[found.route],))
    metrics = (trial.evaluation.routes[found.route],)
    return task.routes_reply(only, replace(trial.evaluation, routes=metrics))[0]
