"""Where one more customer or shipment fits a plan best, or one whom it serves elsewhere."""

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN, PROBLEM, illegal_plan, read_about_plan
from app.plans.explain_replies import (
    companions_reply, here_reply, more_than_without, placed_reply, rules_reply, subject_reply,
)
from app.plans.explaining import (
    LEAST_TRYING, node_named, preparing_within, require_known, require_shipment, require_within,
    unit_named,
)
from app.plans.replies import Data, cost_reply
from app.plans.task import Task, task_of, warning_replies
from app.plans.timing import timed_plan
from app.requests.bounds import Bounds
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.fit import FitReply, FitRequest
from app.serving.load.received import ReceivedBody
from model.counsel.bench import Bench, Trial
from model.counsel.fitting import Fit, find_fits, new_violations, spot_of, vehicle_of
from model.judge.check import Evaluation, JudgedRoute
from model.judge.places import find_place, used_place
from model.solution import Solution

SUBJECTS = "customer", "new_customer", "shipment", "new_shipment"
"""Fields one of which says for whom a place is sought."""

ANSWERING_SHARE = 0.9
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
    require_readable(evaluation)
    bench = bench_of(task, request, solution, judged)
    now, limit = time.perf_counter(), request.options.time_limit
    until = max(body.received_at + ANSWERING_SHARE * limit, now + LEAST_TRYING * limit)
    fits = find_fits(bench, request.count, until,
                     vehicle_of if request.one_per_vehicle else spot_of)
    reply: Data = {
        **subject_reply(bench),
        "cost": cost_reply(evaluation.cost),
        "here": here_reply(bench),
        "places": [_place_reply(bench, fit) | {"route": _route(task, fit.bench, fit.trial)}
                   for fit in fits.places],
        "others": [_place_reply(bench, fit) for fit in fits.others],
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
    require_shipment(request.problem, request.shipment, "$.shipment")
    stated = [name for name in SUBJECTS if getattr(request, name) is not None]
    if len(stated) != 1:
        raise InvalidRequestError([InputError(
            code="UNKNOWN_FIELD" if stated else "MISSING_FIELD",
            path=f"$.{stated[0] if stated else SUBJECTS[0]}",
            message="For whom a place is sought is stated by one of customer, new_customer, "
            "shipment and new_shipment: state one, and no other.")])
    return request


def require_readable(evaluation: Evaluation) -> None:
    """Refuse a plan with routes whose times can't be told; raises `InvalidRequestError`."""
    if all(metrics.trips for metrics in evaluation.routes):
        return
    raise illegal_plan(evaluation.violations, "Nobody can be added to a plan that can't be read: "
                       "correct it.")


def bench_of(task: Task, request: FitRequest, solution: Solution,
           judged: Mapping[int, JudgedRoute]) -> Bench:
    """Return what tries the customer or shipment at places of a plan."""
    problem = task.judged_problem
    if request.shipment is not None or request.new_shipment is not None:
        name = request.shipment if request.new_shipment is None else request.new_shipment.id
        node, shipment = unit_named(problem, name)
        nodes = (node,) if shipment is None else shipment.nodes
        return Bench(problem, _with_nodes(solution, nodes), node, task.setting, judged, shipment)
    customer = request.new_customer
    node = used_place(problem, solution, node_named(
        problem, request.customer if customer is None else customer.id))
    return Bench(problem, _with_nodes(solution, (node,)), node, task.setting, judged)


def _with_nodes(solution: Solution, nodes: Iterable[int]) -> Solution:
    """Return a plan that leaves customers out whom it doesn't have at all."""
    lacking = [node for node in nodes if node not in solution.unassigned
               and find_place(solution, node) is None]
    return replace(solution, unassigned=(*solution.unassigned, *lacking))


def _place_reply(bench: Bench, fit: Fit) -> Data:
    broken = new_violations(bench, fit.trial)
    return {
        **placed_reply(fit.bench, fit.trial, fit.companions),
        **companions_reply(bench.problem, fit.companions),
        "cost": more_than_without(bench, fit.trial),
        "feasible": not broken,
        "reasons": rules_reply(broken),
    }


def _route(task: Task, bench: Bench, trial: Trial) -> Data | None:
    """Return the route that serves the customer or shipment."""
    found = find_place(trial.solution, bench.node)
    if found is None:
        return None
    only = replace(trial.solution, routes=(trial.solution.routes[found.route],))
    metrics = (trial.evaluation.routes[found.route],)
    return task.routes_reply(only, replace(trial.evaluation, routes=metrics))[0]
