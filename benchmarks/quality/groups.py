"""Are groups served that can be served only together? `python -m benchmarks.quality.groups`.

Random problems of up to seven customers, with few roads, most of them one way, and a closing time
or another limit, are planned and compared with the best plan, found by trying all. Larger ones, all
of whose customers can just be served, are planned for `--seconds`. Fails if a small problem's plan
serves fewer or costs more than the best.
"""

from typing import Annotated

import numpy as np
import typer

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.quality.group_problems import best_plan, draw_group, draw_streets, what_comes
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem

SEED = 7

STREETS = ((20, 2), (50, 1), (50, 3), (100, 3), (200, 3), (200, 5))
"""Customers and vehicles of the larger problems."""

ROUNDING = 1e-6


def is_as_good(planner: Planner, problem: Problem, seconds: float) -> bool:
    """Tell whether a plan serves as many as the best, at its cost."""
    best = best_plan(problem)
    plan = planner.plan(problem, PlanOptions(DEFAULT_POLICY, time_limit=seconds))
    found = what_comes(problem, plan.solution)
    return found.served == best.served and found.cost <= best.cost + ROUNDING


def main(
    problems: Annotated[int, typer.Option(help="Small problems.")] = 300,
    seconds: Annotated[float, typer.Option(help="Time limit of a larger plan.")] = 2.0,
    small_seconds: Annotated[float, typer.Option(help="Time limit of a small plan.")] = 0.2,
) -> None:
    """Plan both kinds of problems."""
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    good = sum(is_as_good(planner, draw_group(np.random.default_rng((SEED, number))),
                          small_seconds) for number in range(problems))
    typer.echo(f"{good} of {problems} small problems as the best plan")
    for customers, vehicles in STREETS:
        problem = draw_streets(np.random.default_rng((SEED, customers, vehicles)), customers,
                               vehicles)
        plan = planner.plan(problem, PlanOptions(DEFAULT_POLICY, time_limit=seconds))
        found = what_comes(problem, plan.solution)
        typer.echo(f"{customers} customers, {vehicles} vehicles: {found.served} served")
    raise typer.Exit(0 if good == problems else 1)


if __name__ == "__main__":
    typer.run(main)
