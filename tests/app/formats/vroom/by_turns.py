"""The planner by turns instead of by the clock: a busy machine comes as far as an idle one."""

from dataclasses import replace
from typing import Any

from model.planner import Planner, PlanOptions, PlanResult
from model.problem import Problem

ENOUGH = 60.0
"""Seconds of a request that nothing is left out for."""


class ByTurns(Planner):
    """A planner whose every search takes some turns, and the largest problem that it was given.

    Parameters
    ----------
    planner
        Who plans.
    turns
        Of each search.
    """

    def __init__(self, planner: Planner, turns: int) -> None:
        self._planner = planner
        self._turns = turns
        self.nodes = 0

    @property
    def policies(self) -> tuple[str, ...]:
        return self._planner.policies

    def plan(self, problem: Problem, options: PlanOptions, *args: Any, **named: Any) -> PlanResult:
        self.nodes = max(self.nodes, problem.num_nodes)
        options = replace(options, search_iterations=self._turns)
        return self._planner.plan(problem, options, *args, **named)
