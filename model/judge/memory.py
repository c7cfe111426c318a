"""The judge of many plans for one problem, most of whose routes are the same."""

from dataclasses import dataclass

from model.judge.check import Evaluation, JudgedRoute, check, judge_route
from model.judge.past import EVERYTHING_OPEN, Past
from model.problem import Problem
from model.solution import Route, Solution, Vehicle


@dataclass(frozen=True)
class _Known:
    route: Route
    judged: JudgedRoute


class Memory:
    """Judges plans as `check` does, but no route again that a vehicle had when it last judged it.

    Parameters
    ----------
    problem
        What is planned.
    past
        What has happened.
    """

    def __init__(self, problem: Problem, past: Past = EVERYTHING_OPEN) -> None:
        self.problem = problem
        self._past = past
        self._known: dict[Vehicle, _Known] = {}

    def check(self, plan: Solution) -> Evaluation:
        """Judge a plan. In place."""
        judged = {index: self._judged(route, f"routes[{index}]")
                  for index, route in enumerate(plan.routes)}
        return check(self.problem, plan, self._past, judged)

    def _judged(self, route: Route, path: str) -> JudgedRoute:
        vehicle = route.driven_by
        known = self._known.get(vehicle)
        if known is not None and (known.route is route or known.route == route):
            return known.judged
        judged = judge_route(self.problem, route, path, self._past)
        if not judged.violations:
            # Violations tell the route's place in the plan, which may be another the next time.
            self._known[vehicle] = _Known(route, judged)
        return judged
