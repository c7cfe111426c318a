"""The best plan of a job that is planned by regions: what is merged into it and what is refused."""

from typing import Literal

from model.judge.memory import Memory
from model.problem import Problem
from model.search.regions.region import Region, in_order, put_back
from model.solution import Solution

Outcome = Literal["merged", "stale", "dearer", "broken"]

ROUNDING = 1e-9
"""Share of a cost by which others count as the same."""


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
        self._judge = Memory(problem)
        self.evaluation = self._judge.check(self.plan)

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
        evaluation = self._judge.check(plan)
        if evaluation.violations:
            return "broken"
        if not evaluation.cost.total < self.cost * (1 - ROUNDING):
            return "dearer"
        self.plan, self.evaluation = plan, evaluation
        return "merged"
