"""Several weights of `attention` side by side on fresh problems, greedily.

`python -m benchmarks.quality.weights --weights model/weights/attention/weights.pt
--weights runs/judged/checkpoint.pt` prints, for uniform VRPTW of 50 and 100 customers and for each
class of training, by how much the others' plans are dearer than the first's, in %, with the
standard error, and how far the plans of all are above a long search. Problems come from the seed,
which no training uses: take another to confirm what was chosen by one.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from itertools import product
from multiprocessing import get_context
from pathlib import Path
from typing import Annotated

import numpy as np
import torch
import typer

from benchmarks.quality.policies import cheapest_insertion
from model.judge.check import check
from model.engine.instance import pack
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.policy.extract import extract
from model.solution import Solution
from training.instances import ALL, DEFAULT_CONFIG, VALIDATION_SIZES, generate
from training.labels import Actor
from training.rollout import make_batch
from training.variants import uniform_vrptw

UNIFORM = {"uniform-50": 50, "uniform-100": 100}

CLASSES = (*UNIFORM, *ALL)


@dataclass(frozen=True)
class Case:
    """A problem, by what it is drawn from."""

    name: str  # of its class
    seed: int
    number: int

    def problem(self) -> Problem:
        """Draw it."""
        rng = np.random.default_rng((self.seed, CLASSES.index(self.name), self.number))
        if self.name in UNIFORM:
            return uniform_vrptw(rng, UNIFORM[self.name], DEFAULT_CONFIG)
        size = VALIDATION_SIZES[self.number % len(VALIDATION_SIZES)]
        return generate(rng, size, self.name)


@cache
def _actor(weights: Path) -> Actor:
    torch.set_num_threads(1)
    return Actor(weights)


def plan_costs(case: Case, weights: Sequence[Path], turns: int) -> tuple[float, ...]:
    """Return what each policy's plan costs, and that of a search of so many turns a customer.

    Raises
    ------
    ValueError
        If a plan breaks a rule.
    """
    problem = case.problem()
    batch = make_batch([problem], [case.name])
    rng = np.random.default_rng(0)
    plans = [extract(problem, batch.instance, _actor(each).plan(batch, 0.0, rng))
             for each in weights]
    if turns:
        config = SearchConfig(turns=turns * problem.num_customers, seed=case.number)
        plans.append(improve(problem, pack([problem]), cheapest_insertion(problem),
                             config).solution)
    return judged_costs(case, problem, plans)


def judged_costs(case: Case, problem: Problem, plans: Sequence[Solution]) -> tuple[float, ...]:
    """Return what plans of a case cost.

    Raises
    ------
    ValueError
        If a plan breaks a rule.
    """
    judged = [check(problem, plan) for plan in plans]
    for evaluation in judged:
        if evaluation.violations:
            raise ValueError(f"{case}: {evaluation.violations[0].message}")
    return tuple(evaluation.cost.total for evaluation in judged)


def rows(costs: dict[str, np.ndarray], number: int) -> Iterator[list[str]]:
    """Yield a row a class, and one for all: changes to the first weights, then gaps to the search.

    Parameters
    ----------
    costs
        By class, (problem, weights or weights + 1) costs, the last of the search.
    number
        Of weights.
    """
    for name, cost in (*costs.items(), ("all", np.concatenate(list(costs.values())))):
        ratio = np.log(cost)
        changes = (ratio[:, each] - ratio[:, 0] for each in range(1, number))
        gaps = (ratio[:, each] - ratio[:, -1] for each in range(number)) \
            if cost.shape[1] > number else ()
        yield [name, str(len(cost)), *map(_percent, changes), *map(_percent, gaps)]


def _percent(logs: np.ndarray) -> str:
    mean, error = np.mean(logs), np.std(logs, ddof=1) / np.sqrt(len(logs))
    return f"{100 * np.expm1(mean):+.2f} ± {100 * error:.2f}"


def main(
    weights: Annotated[list[Path], typer.Option(help="weights.pt or a checkpoint; several")],
    problems: Annotated[int, typer.Option(help="of each class")] = 100,
    classes: Annotated[str, typer.Option(help="comma-separated")] = ",".join(CLASSES),
    turns: Annotated[int, typer.Option(help="of the search, a customer; 0: no search")] = 0,
    seed: int = 1, processes: int = 2,
) -> None:
    """Print the table in Markdown."""
    found = costs_by_class(partial(plan_costs, weights=weights, turns=turns),
                           [Case(name, seed, number)
                            for name, number in product(classes.split(","), range(problems))],
                           processes)
    print_table(found, [path.parent.name for path in weights])


def costs_by_class(plan: Callable[[Case], tuple[float, ...]], cases: Sequence[Case],
                   processes: int) -> dict[str, np.ndarray]:
    """Return (problem, way) what `plan` says of the cases, by class, in the order of `cases`."""
    with ProcessPoolExecutor(processes, get_context("spawn")) as executor:
        found = list(executor.map(plan, cases, chunksize=4))
    return {name: np.array([cost for case, cost in zip(cases, found, strict=True)
                            if case.name == name])
            for name in dict.fromkeys(case.name for case in cases)}


def print_table(costs: dict[str, np.ndarray], names: Sequence[str]) -> None:
    """Print `rows` in Markdown; `names` of all ways, a search behind them has none."""
    header = ["class", "problems", *(f"{name}, %" for name in names[1:])]
    if next(iter(costs.values())).shape[1] > len(names):
        header += [f"{name} above the search, %" for name in names]
    print("| " + " | ".join(header) + " |\n|" + " --- |" * len(header))
    for row in rows(costs, len(names)):
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    typer.run(main)
