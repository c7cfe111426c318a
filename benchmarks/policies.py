"""Policies on the fixed validation set, beside the nearest neighbour.

`python -m benchmarks.policies` writes a CSV of every plan and prints a table of each class: the
geometric mean of costs relative to the nearest feasible neighbour's plan of the same problem, and
in brackets how many customers were left out. Every plan is checked.
"""

import csv
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import torch
import typer

from app.settings import DEFAULT_POLICY, Settings
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from training.export import export
from training.instances import validation_set
from training.policies import POLICIES
from training.rollout import make_batch
from training.rules import nearest_neighbour


@dataclass(frozen=True)
class Outcome:
    """One plan of one problem."""

    name: str
    method: str
    cost: float
    unassigned: int
    nearest_cost: float


def untrained(name: str) -> Planner:
    """Return a planner with the named network at its first random weights."""
    torch.manual_seed(0)
    with tempfile.TemporaryDirectory() as folder:
        export(POLICIES[name](), Path(folder) / name, {})
        return load_planner(Path(folder), [name])


def plan_all(problems: Sequence[tuple[str, Problem]], policy: str, samples: int) -> list[Outcome]:
    """Plan each problem by every method."""
    trained = load_planner(Settings().weights_dir, [policy])
    methods = {
        f"{policy}, untrained": (untrained(policy), PlanOptions(policy, time_limit=0.0)),
        f"{policy}, greedy": (trained, PlanOptions(policy, time_limit=0.0)),
        f"{policy}, {samples} samples": (
            trained, PlanOptions(policy, "sample", samples, time_limit=0.0)),
    }
    outcomes = []
    for name, problem in problems:
        nearest = float(nearest_neighbour(make_batch([problem], [name]))[0])
        for method, (planner, options) in methods.items():
            result = planner.plan(problem, options)
            outcomes.append(Outcome(name, method, result.final_cost,
                                    len(result.solution.unassigned), nearest))
    return outcomes


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


def main(policy: str = DEFAULT_POLICY, samples: int = 128, size: int = 200,
         output: Annotated[Path, typer.Option(help="CSV of every plan")]
         = Path("runs/policies.csv")) -> None:
    """Print the table in Markdown."""
    outcomes = plan_all(validation_set(size), policy, samples)
    output.parent.mkdir(parents=True, exist_ok=True)
    with output.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["problem", "method", "cost", "unassigned", "nearest_cost"])
        writer.writerows((o.name, o.method, o.cost, o.unassigned, o.nearest_cost)
                         for o in outcomes)
    header, *rows = table(outcomes)
    print("| " + " | ".join(header) + " |\n|" + " --- |" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    typer.run(main)
