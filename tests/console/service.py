"""Serves as `tandem serve` does, but what may be searched for a second is searched for a moment.

Nearly all tests ask for such plans, few look at how good they are, and a search goes on when
whoever asked is gone.
"""

from dataclasses import replace
from typing import Any
from unittest.mock import patch

from app.cli.commands import main
from model.planner import Planner, PlanOptions, PlanResult
from model.problem import Problem

SECOND, MOMENT = 1.0, 0.05

plan_in_time = Planner.plan


def plan_hurriedly(planner: Planner, problem: Problem, options: PlanOptions, *given: Any,
                   **named: Any) -> PlanResult:
    """Plan a problem as `Planner.plan` does, or sooner."""
    if options.time_limit <= SECOND and options.search_iterations is None:
        options = replace(options, time_limit=min(options.time_limit, MOMENT))
    return plan_in_time(planner, problem, options, *given, **named)


if __name__ == "__main__":
    with patch.object(Planner, "plan", plan_hurriedly):
        main()
