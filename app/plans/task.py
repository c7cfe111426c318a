"""What a request asks for: a plan from nothing, or one that goes on from another."""

import time
from dataclasses import dataclass

from app.conversion.names import number_in
from app.conversion.preparing import UNHURRIED, Preparing
from app.conversion.problem import to_problem
from app.conversion.travels import Ground
from app.conversion.units import optional_thousandths
from app.errors import InputError, InvalidRequestError
from app.plans.replies import Data, plan_reply, vehicle_name
from app.requests.plan_reading import read_earlier_plan
from app.schemas.request import PlanRequest, ReplanInput
from model.judge.bench import Setting
from model.judge.check import Evaluation, check
from model.judge.explain import Reason, explain
from model.judge.past import Vehicle
from model.judge.rules import Violation
from model.planner import ALONE, Elapsed, Listener, Planner, PlanOptions, PlanResult
from model.problem import Problem
from model.replanning.kept import Kept
from model.replanning.replan import Replanning, SettledPartError, Terms
from model.replanning.workers import TooManyTypesError
from model.solution import Solution


EXPLAINING, EXPLAINING_SHARE = 0.05, 0.02
"""Seconds, and besides a share of the time limit, in which reasons are looked for why customers are
left out: some hundred are found in the first of them."""


@dataclass(frozen=True)
class Task:
    """A problem to plan, and the plan to go on from if there is one."""

    problem: Problem
    replanning: Replanning | None = None

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan; arguments and errors are those of `Planner.plan`, but nobody to serve is allowed.

        `start` may be any earlier result of the same task.
        """
        if self.replanning is not None:
            return self.replanning.plan(planner, options, received_at, listener, start)
        if not self.problem.customers:
            return _no_plan(self.problem, options)
        return planner.plan(self.problem, options, received_at, listener, start)

    def check(self, solution: Solution) -> Evaluation:
        """Judge a plan, and whether it goes on from the one given."""
        if self.replanning is not None:
            return self.replanning.check(solution)
        return check(self.problem, solution)

    @property
    def judged_problem(self) -> Problem:
        """The problem that a plan is judged by: parcels that were loaded are there."""
        return self.problem if self.replanning is None else self.replanning.problem

    @property
    def setting(self) -> Setting:
        """What a plan is judged by beside the problem."""
        replanning = self.replanning
        return Setting() if replanning is None else Setting(replanning.past, replanning.excused)

    def reasons(self, solution: Solution, node: int, until: float) -> tuple[Reason, ...]:
        """Return why a plan leaves a customer out, as far as is found until an instant."""
        if self.replanning is None:
            return explain(self.problem, solution, node, until)
        return self.replanning.reasons(solution, node, until)

    def reply(self, options: PlanOptions, result: PlanResult) -> Data:
        """Return the reply to a plan, as `plan_reply` does, with reasons while there is time."""
        allowed = EXPLAINING + EXPLAINING_SHARE * options.time_limit
        until = time.perf_counter() + allowed
        if self.replanning is None:
            return plan_reply(self.problem, options, result, explain_until=until)
        reply = plan_reply(self.problem, options, result, self.replanning.reasons, until)
        return reply | {"replan": _replan_reply(self.problem, self.replanning)}


def task_of(request: PlanRequest, preparing: Preparing = UNHURRIED,
            ground: Ground | None = None) -> Task:
    """Return what a valid request asks for, unless the work on it is to end.

    `ground` is that of the request, if it is known already.

    Raises
    ------
    InvalidRequestError
        If what has happened by the plan to go on from doesn't fit the problem, or the work takes
        too long.
    StoppedError
        If it is stopped.
    """
    problem = to_problem(request, preparing, ground)
    replan = request.replan
    if replan is None:
        return Task(problem)
    terms = _terms(replan, problem)
    try:
        return Task(problem, Replanning(problem, terms))
    except SettledPartError as error:
        raise InvalidRequestError([
            InputError(code="SETTLED_PART", path=f"$.replan.plan.{on_the_wire(violation.path)}",
                       message=f"By replan.freeze_before this has happened, and can't have: "
                       f"{violation.message}. Correct the plan, or the rest of the request.")
            for violation in error.violations]) from error
    except TooManyTypesError as error:
        raise InvalidRequestError([InputError(
            code="TOO_MANY_VEHICLES", path="$.replan.plan.routes",
            message=f"By the plan, {error}: plan for fewer vehicles at a time.")]) from error


def violation_reply(violation: Violation, problem_path: str, plan_path: str) -> Data:
    """Return a broken rule and where, the problem and the plan being at these paths."""
    root = problem_path if violation.path.startswith("customers[") else plan_path
    return {"code": violation.code, "path": f"{root}.{on_the_wire(violation.path)}",
            "message": violation.message}


def on_the_wire(path: str) -> str:
    """Return the checker's path with the names of fields as requests and replies have them."""
    return path.replace(".visits[", ".customers[")


def _replan_reply(problem: Problem, replanning: Replanning) -> Data:
    """Return what a reply says of the plan that was given."""
    return {
        "settled": [{"vehicle": vehicle_name(problem, kept.route),
                     "trip": len(kept.route.trips) - 1,
                     "stop": _last_settled(problem, kept)}
                    for kept in replanning.kept],
        "excused": [violation_reply(violation, "$", "$") for violation in replanning.excused],
    }


def _last_settled(problem: Problem, kept: Kept) -> int:
    """Return the last stop of a vehicle's trip that stays, of those that a reply shows."""
    stops = kept.route.trips[-1].stops
    last = len(stops) - 1
    return last if kept.way_on is None and not problem.is_nowhere(stops[last].node) else last - 1


def _terms(replan: ReplanInput, problem: Problem) -> Terms:
    plan = read_earlier_plan(replan.plan, problem)
    names = set(replan.pinned)
    pinned = frozenset(node for node, customer in enumerate(problem.customers, problem.num_depots)
                       if replan.pin_all or customer.id in names)
    types = {kind.type_id for kind in problem.vehicle_types}
    unavailable = frozenset(
        Vehicle(*problem.find_vehicle(type_id, number)) for name in replan.unavailable
        for type_id in types if (number := number_in(f"{type_id}-", name)) is not None)
    return Terms(plan, optional_thousandths(replan.freeze_before), pinned, unavailable,
                 optional_thousandths(replan.parcels_back))


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
