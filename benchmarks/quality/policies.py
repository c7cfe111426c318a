"""Policies on the fixed validation set, beside rules of thumb.

`python -m benchmarks.quality.policies` writes a CSV of every plan and prints a table of each class:
the geometric mean of costs relative to the nearest feasible neighbour's plan of the same problem,
and in brackets how many customers were left out. Every plan is checked.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.serving.settings import Settings
from benchmarks.rows import append_rows, read_rows
from model.judge.check import check
from model.engine.instance import pack
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from training.heuristics import nearest_neighbour
from training.instances import validation_set
from training.rollout import make_batch

Method = Callable[[Problem], Solution]


@dataclass(frozen=True)
class Outcome:
    """One plan of one problem."""

    problem: int  # its place in the validation set
    name: str
    method: str
    cost: float
    unassigned: int
    nearest_cost: float


def cheapest_insertion(problem: Problem) -> Solution:
    """Plan as the search begins where it is given nothing."""
    return improve(problem, pack([problem], legs=False), Solution((), ()),
                   SearchConfig(turns=0)).solution


def by_policy(planner: Planner, options: PlanOptions, problem: Problem) -> Solution:
    """Plan by a policy alone."""
    return planner.plan(problem, options).solution


def methods(policies: Sequence[str], samples: int) -> dict[str, Method]:
    """Return all ways to plan by their names in the table."""
    planner = load_planner(Settings().weights_dir, policies)
    chosen: dict[str, Method] = {"cheapest insertion": cheapest_insertion}
    for name in policies:
        greedy = PlanOptions(name, time_limit=0.0)
        drawn = PlanOptions(name, "sample", samples, time_limit=0.0)
        chosen[f"{name}, greedy"] = partial(by_policy, planner, greedy)
        chosen[f"{name}, {samples} samples"] = partial(by_policy, planner, drawn)
    return chosen


def plan_all(problems: Sequence[tuple[str, Problem]],
             ways: Mapping[str, Method]) -> Iterator[Outcome]:
    """Plan each problem by every method.

    Raises
    ------
    ValueError
        If a plan breaks a rule.
    """
    for number, (name, problem) in enumerate(problems):
        nearest = float(nearest_neighbour(make_batch([problem], [name]))[0])
        for method, plan in ways.items():
            solution = plan(problem)
            evaluation = check(problem, solution)
            if evaluation.violations:
                raise ValueError(f"{name}, {method}: {evaluation.violations[0].message}")
            yield Outcome(number, name, method, evaluation.cost.total, len(solution.unassigned),
                          nearest)


def table(outcomes: Sequence[Outcome]) -> list[list[str]]:
    """Return header and rows, a row per class: geometric mean of cost ratios."""
    methods = list(dict.fromkeys(outcome.method for outcome in outcomes))
    classes = [*dict.fromkeys(outcome.name.split("-")[0] for outcome in outcomes), "all"]
    rows = [["class", "problems", *methods]]
    for name in classes:
        chosen = [o for o in outcomes if name in (o.name.split("-")[0], "all")]
        cells = []
        for method in methods:
            mine = [o for o in chosen if o.method == method]
            ratio = np.exp(np.mean([np.log(o.cost / o.nearest_cost) for o in mine]))
            cells.append(f"{ratio:.3f} ({sum(o.unassigned for o in mine)})")
        rows.append([name, str(len(chosen) // len(methods)), *cells])
    return rows


def main(policies: Annotated[str, typer.Option(help="comma-separated")] = "pointer,attention",
         samples: int = 128, size: int = 200,
         output: Annotated[Path, typer.Option(help="CSV of every plan, made anew")]
         = Path("runs/policies.csv")) -> None:
    """Print the table in Markdown."""
    output.unlink(missing_ok=True)
    ways = methods(policies.split(","), samples)
    append_rows(output, Outcome, plan_all(validation_set(size), ways))
    header, *rows = table(read_rows(output, Outcome))
    print("| " + " | ".join(header) + " |\n|" + " --- |" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    typer.run(main)
