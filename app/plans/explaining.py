"""Any legal plan: why a customer or shipment is served where it is, and what drones save."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

from pydantic_core import to_json

from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.checking import PLAN, PROBLEM, illegal_plan, read_about_plan
from app.plans.explain_replies import customer_reply, drones_reply, idle_reply, nobody_reply
from app.plans.replies import Data
from app.plans.task import Task, task_of, warning_replies
from app.requests.bounds import Bounds
from app.requests.conversion.preparing import Preparing
from app.requests.ends import named_otherwise
from app.requests.plan_reading import parse_plan, read_plan
from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.explain import ExplainOptions, ExplainReply, ExplainRequest
from app.schemas.request import PlanRequest
from app.schemas.shipment import end_name
from app.serving.load.received import ReceivedBody
from model.counsel.alternatives import find_alternatives
from model.counsel.bench import Bench, Setting
from model.counsel.binding import find_binding
from model.counsel.idle_drones import idle_drones
from model.counsel.worth import sorties_worth
from model.judge.launch_sites import without_idle_stops
from model.judge.places import used_place
from model.judge.retiming import read_route, time_route
from model.planner import Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem, Shipment
from model.solution import Route, Solution

ALTERNATIVES_SHARE = 0.7
"""Share of the time limit after which no more places are tried, so that limits are."""

REASONS_SECONDS = 0.05
"""For which reasons are looked for why a customer is left out."""

SORTIES_SHARE = 0.3
"""Share of the time left in which single sorties are judged, where two searches follow."""

LEAST_TRYING = 0.2
"""Share of the time limit that is spent on trying even if reading has taken all of it."""

LEAST_SEARCH = 0.05
"""Seconds without which a search is not worth the name."""


class Subject(NamedTuple):
    """Of whom it is asked: the id of a customer, of a shipment, or neither."""

    customer: str | None
    shipment: str | None


@dataclass(frozen=True)
class PlanQuestion:
    """What is asked of a plan, and until when it is to be answered, on `time.perf_counter`."""

    customer: str | None
    shipment: str | None
    drones: bool
    idle_drones: bool
    began: float
    until: float

    def after(self, share: float) -> float:
        """Return the instant at which a share of the time is over."""
        return self.began + share * (self.until - self.began)


def answer_explain(body: ReceivedBody, bounds: Bounds, planner: Planner,
                   should_stop: Callable[[], bool] = lambda: False,
                   roads: Roads = NO_ROADS) -> bytes:
    """Return the reply to a request of `POST /explain` as JSON, unless the work is to end.

    Raises
    ------
    RequestError
        If `body` is no valid request, the plan breaks a rule, or the work is to end.
    """
    request = read_explain(body.content, bounds)
    task = task_of(request.problem, preparing_within(bounds, should_stop),
                   roads=roads.with_all_legs())
    solution = read_plan(request.plan, task.problem, (PLAN,))
    question = _question(Subject(request.customer, request.shipment), request.drones,
                         request.options, body.received_at, request.idle_drones)
    reply = _Explainer(task, solution, planner, should_stop).answer(question)
    for name in ("reasons", "binding"):
        reply[name] = [_of_problem(each) for each in reply[name]]
    return to_json(reply)


def _of_problem(told: Data) -> Data:
    """Return a reason, a remedy or a limit whose changes are of the problem beside the plan."""
    return told | {
        name: [change | {"path": change["path"].replace("$", f"$.{PROBLEM}", 1)}
               for change in told[name]]
        for name in ("changes", "other_changes") if name in told
    } | {name: list(map(_of_problem, told[name]))
         for name in ("remedies", "parts") if name in told}


def explain_job(request: PlanRequest, plan: bytes, subject: Subject, drones: bool,
                options: ExplainOptions, bounds: Bounds, planner: Planner,
                should_stop: Callable[[], bool], roads: Roads = NO_ROADS) -> bytes:
    """Return the same of a job's plan, as JSON; raises as `answer_explain` does."""
    began = time.perf_counter()
    require_within(options, bounds, "query.time_limit")
    _require_subject(request, subject, "query.")
    task = task_of(request, preparing_within(bounds, should_stop),
                   roads=roads.with_all_legs())
    solution = read_plan(parse_plan(plan), task.problem)
    question = _question(subject, drones, options, began)
    return to_json(_Explainer(task, solution, planner, should_stop).answer(question))


def read_explain(body: bytes, bounds: Bounds) -> ExplainRequest:
    """Return the request that `body` holds; raises as `read_about_plan` does."""
    request = read_about_plan(body, bounds, ExplainRequest)
    require_within(request.options, bounds, "$.options.time_limit")
    _require_subject(request.problem, Subject(request.customer, request.shipment), "$.")
    return request


def _require_subject(request: PlanRequest, subject: Subject, where: str) -> None:
    require_known(request, subject.customer, f"{where}customer")
    require_shipment(request, subject.shipment, f"{where}shipment")
    if None not in subject:
        raise InvalidRequestError([InputError(
            code="UNKNOWN_FIELD", path=f"{where}shipment",
            message="A customer is asked about already: ask of one, and of the other then.")])


def require_within(options: ExplainOptions, bounds: Bounds, path: str) -> None:
    """Refuse more time than a service takes; raises `InvalidRequestError`."""
    if options.time_limit > bounds.time_limit:
        raise InvalidRequestError([InputError(
            code="OUT_OF_RANGE", path=path,
            message=f"This service takes {bounds.time_limit:g} s at most ({bounds.time_setting}): "
            "lower it.")])


def require_known(request: PlanRequest, customer: str | None, path: str) -> None:
    """Refuse a customer whom a problem doesn't have; raises `InvalidRequestError`."""
    if customer is not None and all(each.id != customer for each in request.customers):
        raise InvalidRequestError([InputError(
            code="UNKNOWN_CUSTOMER", path=path,
            message=named_otherwise(customer, [name for each in request.shipments
                                               for name, _ in each.named_ends()],
                                    " For all of it state shipment.")
            or f"The problem has no customer {customer[:200]!r}: use the id of one it has.")])


def require_shipment(request: PlanRequest, shipment: str | None, path: str) -> None:
    """Refuse a shipment that a problem doesn't have; raises `InvalidRequestError`."""
    if shipment is not None and all(each.id != shipment for each in request.shipments):
        raise InvalidRequestError([InputError(
            code="UNKNOWN_SHIPMENT", path=path,
            message=f"The problem has no shipment {shipment[:200]!r}: use the id of one it has.")])


def node_named(problem: Problem, customer: str | None) -> int:
    """Return the node of a customer that there is."""
    return next(node for node, each in enumerate(problem.customers, problem.num_depots)
                if each.id == customer)


def unit_named(problem: Problem, shipment: str | None) -> tuple[int, Shipment | None]:
    """Return the first node of a shipment that there is, and itself, which is to move as one.

    Of one that was aboard a vehicle which broke down the delivery alone is left.
    """
    whole = next((each for each in problem.shipments if each.id == shipment), None)
    if whole is None:
        return node_named(problem, end_name(str(shipment), "delivery")), None
    return whole.pickup, whole


def preparing_within(bounds: Bounds, should_stop: Callable[[], bool]) -> Preparing:
    """Return the work before plans are judged, which may take as long as a plan."""
    return Preparing(should_stop, bounds.time_limit,
                     f"the {bounds.time_limit:g} s of {bounds.time_setting}")


def _question(subject: Subject, drones: bool, options: ExplainOptions,
              received_at: float, idle_drones: bool = False) -> PlanQuestion:
    """Return what is asked, now that all that it is asked of is read."""
    now, limit = time.perf_counter(), options.time_limit
    return PlanQuestion(*subject, drones, idle_drones, now,
                        max(received_at + limit, now + LEAST_TRYING * limit))


class _Explainer:
    """Answers questions about one plan."""

    def __init__(self, task: Task, solution: Solution, planner: Planner,
                 should_stop: Callable[[], bool]) -> None:
        """Judge the plan.

        Raises
        ------
        InvalidRequestError
            If it breaks a rule.
        """
        self._judged = task.judge_routes(solution)
        evaluation = task.setting.judge(task.judged_problem, solution, self._judged)
        if evaluation.violations:
            raise illegal_plan(evaluation.violations, "Only a plan without broken rules is "
                               "explained: correct it, or plan anew.")
        self._task = task
        self._problem, self._setting = task.judged_problem, task.setting
        self._solution = solution
        self._cost = evaluation.cost
        self._planner = planner
        self._should_stop = should_stop

    def answer(self, question: PlanQuestion) -> Data:
        """Return the reply to a question."""
        reply, complete = nobody_reply(self._cost), True
        bench = self._bench(question)
        if bench is not None:
            reply, complete = self._of(question, bench)
            names = [self._problem.customer_at(node).id for node in bench.nodes]
            if question.customer is not None:
                names = [question.customer]
            self._task.name_hindrances(names, reply["reasons"])
            if self._task.closures is not None:
                reply["zones"] = [zone for name in names
                                  for zone in self._task.closures.around(name)]
        drones = None
        if question.drones:
            drones, in_time = self._of_drones(question)
            complete = complete and in_time
        reply["wind"], reply["idle_drones"] = self._task.storms.all, None
        if question.idle_drones:
            reply["idle_drones"] = [
                idle_reply(self._problem, self._solution, each)
                for each in idle_drones(self._problem, self._solution, self._setting,
                                        question.until, self._judged)]
        self._task.telling.tell(ExplainReply, reply)
        warnings = warning_replies(warning.within(PROBLEM) for warning in self._task.warnings)
        return reply | {"drones": drones, "complete": complete, "warnings": warnings}

    def _bench(self, question: PlanQuestion) -> Bench | None:
        """Return what tries whom is asked about elsewhere; None: nobody is."""
        if question.shipment is not None:
            node, whole = unit_named(self._problem, question.shipment)
            return Bench(self._problem, self._solution, node, self._setting, self._judged, whole)
        if question.customer is None:
            return None
        node = used_place(self._problem, self._solution,
                          node_named(self._problem, question.customer))
        return Bench(self._problem, self._solution, node, self._setting, self._judged)

    def _of(self, question: PlanQuestion, bench: Bench) -> tuple[Data, bool]:
        share = ALTERNATIVES_SHARE * (0.3 if question.drones else 1.0)
        found = find_alternatives(bench, question.after(share))
        binding, in_time = find_binding(bench, found,
                                        question.after(0.3 if question.drones else 1.0))
        reasons = (() if bench.found is not None else self._task.reasons(
            self._solution, bench.node, time.perf_counter() + REASONS_SECONDS))
        return (customer_reply(bench, found.alternatives, binding, reasons,
                               self._task.remedy, self._task.step),
                found.is_complete and in_time)

    def _of_drones(self, question: PlanQuestion) -> tuple[Data, bool]:
        now = time.perf_counter()
        until = now + SORTIES_SHARE * (question.until - now)
        worth = list(sorties_worth(self._problem, self._solution, self._setting, until,
                                   self._judged))
        each = (question.until - time.perf_counter()) / 2
        searched = None
        if worth and self._task.replanning is None and each >= LEAST_SEARCH:
            searched = self._searched(each)
        reply = drones_reply(self._problem, self._solution, self._cost, worth, searched,
                             max(0.0, each) if searched else 0.0)
        return reply, all(sortie.is_tried for sortie in worth)

    def _searched(self, seconds: float) -> tuple[PlanResult, PlanResult] | None:
        """Return plans with drones and of trucks alone, found from the same plan as long."""
        begun = _without_sorties(self._problem, self._solution, self._setting)
        if not self._task.check(begun).is_feasible:
            return None
        alone = replace(self._problem, vehicle_types=tuple(
            [replace(kind, drones=None, more_drones=()) for kind in self._problem.vehicle_types]))
        options = PlanOptions(self._planner.policies[0], time_limit=seconds)
        listener = Listener(self._should_stop)
        flown, driven = [self._planner.plan(problem, options, None, listener, begun)
                         for problem in (self._problem, alone)]
        return flown, driven


def _without_sorties(problem: Problem, solution: Solution, setting: Setting) -> Solution:
    """Return a plan in which nobody is served by drones any more; they are left out."""
    routes: list[Route] = []
    left_out = [*solution.unassigned]
    for route in solution.routes:
        decision = read_route(problem, route)
        left_out += [node for trip in decision.trips for sortie in trip.sorties
                     for node in sortie.nodes]
        trips = tuple([replace(trip, sorties=(), operations=None) for trip in decision.trips
                       if len(trip.nodes) > 2])
        driven = without_idle_stops(problem, replace(decision, trips=trips))
        if driven.trips:
            timed = time_route(problem, driven, f"routes[{len(routes)}]", setting.past)
            routes.append(timed.route)
    return Solution(tuple(routes), tuple(left_out))
