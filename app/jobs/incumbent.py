"""The best plan of a job that is planned by regions: what is merged into it, and what is refused.

Routes that were judged once are not judged again.
"""

from dataclasses import dataclass
from typing import Literal

from model.judge.check import Evaluation, JudgedRoute, check, judge_route
from model.problem import Problem
from model.search.regions.region import Region, Vehicle, in_order, put_back, vehicle_of
from model.solution import Route, Solution

Outcome = Literal["merged", "stale", "dearer", "broken"]

ROUNDING = 1e-9
"""Share of a cost by which others count as the same."""


@dataclass(frozen=True)
class _Known:
    route: Route
    judged: JudgedRoute


class Incumbent:
    """The best plan so far.

    Parameters
    ----------
    problem
        What is planned.
    plan
        A plan that breaks no rules.
    """

    def __init__(self, problem: Problem, plan: Solution) -> None:
        self.problem = problem
        self.plan = in_order(plan)
        self._known: dict[Vehicle, _Known] = {}
        self.evaluation = self._judge(self.plan)

    @property
    def cost(self) -> float:
        """What it costs."""
        return self.evaluation.cost.total

    def merge(self, region: Region, found: Solution) -> Outcome:
        """Take what was found for a region, if that still fits, is cheaper and breaks no rules.

        In place.
        """
        plan = put_back(self.plan, region, found)
        if plan is None:
            return "stale"
        evaluation = self._judge(plan)
        if evaluation.violations:
            return "broken"
        if not evaluation.cost.total < self.cost * (1 - ROUNDING):
            return "dearer"
        self.plan, self.evaluation = plan, evaluation
        return "merged"

    def _judge(self, plan: Solution) -> Evaluation:
        """Judge a plan, and remember its routes. In place."""
        judged = {index: self._judged(route, f"routes[{index}]")
                  for index, route in enumerate(plan.routes)}
        return check(self.problem, plan, known=judged)

    def _judged(self, route: Route, path: str) -> JudgedRoute:
        vehicle = vehicle_of(route)
        known = self._known.get(vehicle)
        if known is None or (known.route is not route and known.route != route):
            known = self._known[vehicle] = _Known(route, judge_route(self.problem, route, path))
        return known.judged
