"""Plans whose legs are partly estimated while they are searched, and never when they leave."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from app.maps.roads.engine import RoadsError
from app.requests.conversion.far_legs import Estimates
from app.schemas.errors import NoRoadsError
from model.judge.accepting import Completed, sound_routes
from model.judge.check import check
from model.judge.memory import Memory
from model.judge.past import Past
from model.judge.retiming import read_route, time_route
from model.planner import ALONE, Elapsed, Listener, Planner, PlanOptions, PlanResult, complete_plan
from model.problem import Problem
from model.solution import Solution

FIRST_SHARE = 0.75
"""Of the time limit, or of the iterations, that is searched with estimates."""

ASKING, ASKING_SHARE = 10.0, 0.5
"""Seconds, and besides a share of the time limit, that roads may take to tell a plan's legs: there
is no answer without them."""


@dataclass(frozen=True)
class FarPlans:
    """Plans a problem with estimates: searches, asks for the legs found, and mends by these.

    What is still estimated then is made too dear to drive, so the rest of the search keeps to legs
    that are known; if its plan drives others all the same, the one before it stands.
    """

    problem: Problem
    estimates: Estimates

    def plan(self, planner: Planner, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        """Plan; arguments and errors are those of `Planner.plan`.

        Raises
        ------
        NoRoadsError
            If the roads don't tell the legs of the plan.
        """
        began = time.perf_counter() if received_at is None else received_at
        whole = True
        if start is not None:
            start, whole = self._mended(start, options, listener)
        first = planner.plan(self.problem, _share(options, FIRST_SHARE), began, listener, start)
        safe, known = self._mended(first.solution, options, listener)
        first = replace(first, deterministic=first.deterministic and whole and known)
        left = options.time_limit - (time.perf_counter() - began)
        if 0 in (options.time_limit, options.search_iterations) or left <= 0:
            return self._result(first, None, safe)
        rest = replace(_share(options, 1.0 - FIRST_SHARE), time_limit=left)
        second = planner.plan(self.problem, rest, None, Listener(listener.should_stop), safe)
        last = second.solution
        if self._learn(last, options, listener):
            retimed = _retimed(self.problem, last)
            last = min((plan for plan in (retimed, safe)
                        if check(self.problem, plan).is_feasible),
                       key=lambda plan: check(self.problem, plan).cost.total)
        return self._result(first, second, last)

    def learn(self, plan: Solution) -> None:
        """Ask for the legs of any plan, so that it can be judged. In place.

        Raises
        ------
        NoRoadsError
            If the roads don't tell them.
        """
        self._ask(plan, time.perf_counter() + ASKING, lambda: False)

    def _mended(self, plan: Solution, options: PlanOptions, listener: Listener) -> Completed:
        """Return a plan that keeps all rules by legs that are known, as like it as can be."""
        self._learn(plan, options, listener)
        self.estimates.close()
        retimed = _retimed(self.problem, plan)
        if check(self.problem, retimed).is_feasible:
            return Completed(retimed, True)
        begun = sound_routes(Memory(self.problem), retimed)
        completed, whole = complete_plan(self.problem, begun, options.seed, lambda: False)
        if self._learn(completed, options, listener):
            completed = _retimed(self.problem, completed)
        is_feasible = check(self.problem, completed).is_feasible
        return Completed(completed if is_feasible else begun, whole)

    def _learn(self, plan: Solution, options: PlanOptions, listener: Listener) -> int:
        until = time.perf_counter() + ASKING + ASKING_SHARE * options.time_limit
        # Whoever says stop wants the best plan so far, which has no legs yet.
        return self._ask(plan, until, lambda: False)

    def _ask(self, plan: Solution, until: float, should_stop: Callable[[], bool]) -> int:
        try:
            return self.estimates.learn(self.problem, plan, until, should_stop)
        except RoadsError as error:
            raise NoRoadsError(f"The roads don't tell the legs of the plan: {error} Try again."
                               ) from error

    def _result(self, first: PlanResult, second: PlanResult | None, last: Solution) -> PlanResult:
        evaluation = check(self.problem, last)
        cost = evaluation.cost.total
        rest = second or first
        elapsed = first.elapsed if second is None else Elapsed(
            first.elapsed.decode, first.elapsed.search + rest.elapsed.decode + rest.elapsed.search,
            first.elapsed.check + rest.elapsed.check)
        more = 0 if second is None else second.search_iterations
        return replace(first, solution=last, evaluation=evaluation, final_cost=cost,
                       decoded_cost=max(first.decoded_cost, cost), elapsed=elapsed,
                       search_iterations=first.search_iterations + more,
                       deterministic=first.deterministic and rest.deterministic,
                       refused=first.refused + (0 if second is None else second.refused))


def _share(options: PlanOptions, share: float) -> PlanOptions:
    """Return options for a share of what is to be done."""
    turns = options.search_iterations
    return replace(options, time_limit=share * options.time_limit,
                   search_iterations=turns and max(1, round(share * turns)))


def _retimed(problem: Problem, plan: Solution) -> Solution:
    """Return a plan with the times that it has by the legs as they are known now."""
    return replace(plan, routes=tuple(
        [time_route(problem, read_route(problem, route), f"routes[{number}]", Past()).route
         for number, route in enumerate(plan.routes)]))
