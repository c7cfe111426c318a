"""What drones save: `python -m benchmarks.quality.without_drones`.

Random problems with drones are planned with them and without, where trucks then serve whom drones
alone would: by the policy alone and by a search of some seconds. A policy that flies where that
pays saves nearly as much as the search does. Every plan is checked and a row of a CSV.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.rows import append_rows, read_rows
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from training.instances import generate

VARIANTS = ("drone", "table1")
SEED = 20_261_120
POLICY, SEARCH = "policy", "search"


@dataclass(frozen=True)
class Pair:
    """Costs of one problem with its drones and without."""

    variant: str
    n: int  # customers
    index: int
    method: str
    with_drones: float
    without: float
    unassigned: int  # of both


def grounded(problem: Problem) -> Problem:
    """Return the problem without drones; trucks serve whom drones alone would."""
    customers = tuple(replace(customer, served_by="either") if customer.served_by == "drone"
                      else customer for customer in problem.customers)
    fleet = tuple(replace(kind, drones=None) for kind in problem.vehicle_types)
    return replace(problem, customers=customers, vehicle_types=fleet)


def plan_pairs(planner: Planner, policy: str, sizes: Sequence[int], each: int,
               seconds: float) -> Iterator[Pair]:
    """Plan each problem by the policy and by the search."""
    ways = {POLICY: PlanOptions(policy, time_limit=0.0),
            SEARCH: PlanOptions(policy, time_limit=seconds)}
    for number, variant in enumerate(VARIANTS):
        for size in sizes:
            for index in range(each):
                rng = np.random.default_rng((SEED, number, size, index))
                problem = generate(rng, size, variant)
                for method, options in ways.items():
                    plans = [planner.plan(stated, options)
                             for stated in (problem, grounded(problem))]
                    left = sum(len(plan.solution.unassigned) for plan in plans)
                    yield Pair(variant, size, index, method, plans[0].final_cost,
                               plans[1].final_cost, left)


def saved(pairs: Sequence[Pair]) -> float:
    """Return by how much drones lower the cost, geometric mean in %; all customers served."""
    ratios = [pair.with_drones / pair.without for pair in pairs if pair.unassigned == 0]
    return 100 * (1 - float(np.exp(np.mean(np.log(ratios))))) if ratios else float("nan")


def table(pairs: Sequence[Pair]) -> list[str]:
    """Return the Markdown table."""
    lines = ["| class | customers | problems | saved by the policy, % | by the search, % |",
             "| --- | ---: | ---: | ---: | ---: |"]
    for variant, size in dict.fromkeys((pair.variant, pair.n) for pair in pairs):
        mine = [pair for pair in pairs if (pair.variant, pair.n) == (variant, size)]
        # Only where all four plans serve everybody, so that both are of the same problems.
        whole = {pair.index for pair in mine} - {p.index for p in mine if p.unassigned > 0}
        mine = [pair for pair in mine if pair.index in whole]
        shares = [saved([pair for pair in mine if pair.method == method])
                  for method in (POLICY, SEARCH)]
        lines.append(f"| {variant} | {size} | {len(whole)} | {shares[0]:.1f} | {shares[1]:.1f} |")
    return lines


def main(sizes: str = "20,50,100", each: int = 8, seconds: float = 1.0,
         policy: str = DEFAULT_POLICY,
         output: Annotated[Path, typer.Option(help="CSV, made anew")]
         = Path("runs/bench/without_drones.csv")) -> None:
    """Print the table in Markdown."""
    output.unlink(missing_ok=True)
    planner = load_planner(Settings().weights_dir, [policy])
    counts = [int(size) for size in sizes.split(",")]
    append_rows(output, Pair, plan_pairs(planner, policy, counts, each, seconds))
    print("\n".join(table(read_rows(output, Pair))))


if __name__ == "__main__":
    typer.run(main)
