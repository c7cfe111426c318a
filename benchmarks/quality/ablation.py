"""What parts of the planner bring: `python -m benchmarks.quality.ablation`.

Random problems, a few of each class of `training.instances`, are planned within a time: from
nothing and from the policy's greedy plan, whose decoding takes its share of the time, and with a
family of moves less. Costs, those of customers left out included, are compared by the geometric
mean of their ratios. Each plan is checked and is a row of a CSV.
"""

import time
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.rows import append_rows, read_rows
from model.judge.check import check
from model.engine.instance import pack
from model.planner import PlanCheckError, Start
from model.policy.decode import DecodeConfig, Policy, decode, load_policy, prepare
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.search.strategy import ALL_MOVES
from model.policy.extract import extract
from model.solution import Solution
from training.instances import COMPARED, generate

STARTS: tuple[Start, ...] = ("insertion", "policy")

MOVES = ("two_opt_star", "resplit", "types", "small_moves")
"""Families of moves that the search can do without, as `Moves` names them."""

MOVES_SECONDS = 0.3
"""Time for each plan with fewer moves."""

BEST_SECONDS = 3.0
"""Time of the plan beside which the others are seen; if one of them is cheaper, that counts."""

SAMPLE_SEED = 20_251_120


@dataclass(frozen=True)
class Way:
    """How a problem is planned."""

    start: Start
    seconds: float
    without: str = ""  # a family of moves


@dataclass(frozen=True)
class Sample:
    """A random problem."""

    variant: str
    size: int  # customers
    index: int
    problem: Problem

    @property
    def name(self) -> str:
        """What tells it from the others."""
        return f"{self.variant}-n{self.size}-{self.index}"


@dataclass(frozen=True)
class Trial:
    """A checked plan."""

    problem: str
    variant: str
    n: int  # customers
    start: Start
    budget_s: float
    without: str
    wall_s: float
    cost: float
    unassigned: int

    @property
    def way(self) -> Way:
        """How the problem was planned."""
        return Way(self.start, self.budget_s, self.without)


def sample(sizes: Sequence[int], each: int, variants: Iterable[str] = COMPARED) -> list[Sample]:
    """Return so many problems of each class and size, the same ones every time."""
    return [Sample(variant, size, index, generate(
                np.random.default_rng((SAMPLE_SEED, number, size, index)), size, variant))
            for number, variant in enumerate(variants) for size in sizes for index in range(each)]


def ways(limits: Sequence[float], moves: bool = True) -> list[Way]:
    """Return all ways to plan, each once; without `moves` only those that differ by their start."""
    chosen = [Way(start, limit) for start in STARTS for limit in limits]
    if moves:
        chosen += [Way("insertion", BEST_SECONDS), Way("insertion", MOVES_SECONDS)]
        chosen += [Way("insertion", MOVES_SECONDS, move) for move in MOVES]
    return list(dict.fromkeys(chosen))


def plans(problem: Problem, policy: Policy, way: Way, turns: int | None = None) -> list[Solution]:
    """Plan a problem; return the policy's plan too if the search began with it."""
    deadline = time.perf_counter() + way.seconds
    instance = pack([problem], legs=way.start == "policy")
    first = Solution((), tuple(range(problem.num_depots, problem.num_nodes)))
    if way.start == "policy":
        scene = prepare(problem, instance)
        decoded = decode(policy, scene, DecodeConfig(most_views=1))
        first = extract(problem, instance, decoded.actions)
    improved = improve(problem, instance, first, search_config(way, turns),
                       deadline).solution
    return [first, improved] if way.start == "policy" else [improved]


def search_config(way: Way, turns: int | None = None) -> SearchConfig:
    """Return how to search."""
    moves = replace(ALL_MOVES, **{way.without: False}) if way.without else ALL_MOVES
    return SearchConfig(turns=turns, moves=moves)


def measure(samples: Sequence[Sample], policy: Policy, chosen: Sequence[Way],
            known: Collection[tuple[str, Way]] = ()) -> Iterator[Trial]:
    """Yield the plan of each problem by each way, but those `known`."""
    for number, one in enumerate(samples, start=1):
        for way in chosen:
            if (one.name, way) in known:
                continue
            began = time.perf_counter()
            found = plans(one.problem, policy, way)
            seconds = time.perf_counter() - began
            yield trial(one, way, found, seconds)
        typer.echo(f"{number}/{len(samples)} {one.name}")


def trial(one: Sample, way: Way, found: Iterable[Solution], seconds: float) -> Trial:
    """Judge the cheapest of the plans.

    Raises
    ------
    PlanCheckError
        If it breaks a rule.
    """
    evaluation, solution = min(((check(one.problem, plan), plan) for plan in found),
                               key=lambda judged: judged[0].cost.total)
    if evaluation.violations:
        raise PlanCheckError(f"{one.name}, {way}: {evaluation.violations[0].message}")
    return Trial(one.name, one.variant, one.size, way.start, way.seconds, way.without,
                 round(seconds, 4), evaluation.cost.total, len(solution.unassigned))


def groups(trials: Sequence[Trial]) -> dict[str, list[Trial]]:
    """Return the trials of each class, of each size, and all."""
    named: dict[str, list[Trial]] = {}
    for row in trials:
        named.setdefault(row.variant, []).append(row)
    for size in sorted({row.n for row in trials}):
        named[f"{size} customers"] = [row for row in trials if row.n == size]
    return named | {"all": list(trials)}


def excess(trials: Iterable[Trial], way: Way, base: Mapping[str, float]) -> tuple[float, float]:
    """Return by how much a way is dearer than `base`, and the standard error of that, in percent.

    Parameters
    ----------
    trials
        Of any ways.
    way
        That which is compared.
    base
        Cost of each problem, by its name.
    """
    logs = np.array([np.log(row.cost / base[row.problem]) for row in trials if row.way == way])
    error = float(logs.std(ddof=1)) / len(logs) ** 0.5 if len(logs) > 1 else float("nan")
    return 100 * float(np.expm1(logs.mean())), 100 * error


def table_of_starts(trials: Sequence[Trial]) -> list[str]:
    """Return the Markdown table of what is missing to the best plan, in percent, after a time."""
    best: dict[str, float] = {}
    for row in trials:
        best[row.problem] = min(row.cost, best.get(row.problem, row.cost))
    columns = [way for way in dict.fromkeys(row.way for row in trials) if not way.without]
    columns.sort(key=lambda way: (way.start, way.seconds))
    header = ["%", "problems", *(f"{way.start}, {way.seconds:g} s" for way in columns)]
    return _markdown(header, [
        [name, _count(group), *(f"{excess(group, way, best)[0]:.2f}" for way in columns)]
        for name, group in groups(trials).items()])


def table_of_pairs(trials: Sequence[Trial]) -> list[str]:
    """Return the Markdown table of costs from the policy's plan above those from insertion.

    In percent, with standard errors.
    """
    limits = sorted({row.budget_s for row in trials if row.start == "policy"})
    return _excesses(trials, {f"{limit:g} s": (Way("policy", limit), Way("insertion", limit))
                              for limit in limits})


def table_of_moves(trials: Sequence[Trial]) -> list[str]:
    """Return the Markdown table of costs without a family of moves above those with all.

    In percent, with standard errors.
    """
    everything = Way("insertion", MOVES_SECONDS)
    return _excesses(trials, {f"without {move}": (replace(everything, without=move), everything)
                              for move in MOVES})


def _excesses(trials: Sequence[Trial], columns: Mapping[str, tuple[Way, Way]]) -> list[str]:
    """Return the table of what plans made one way cost above those made the other."""
    bases = [{row.problem: row.cost for row in trials if row.way == other}
             for _, other in columns.values()]
    rows = []
    for name, group in groups(trials).items():
        cells = [excess(group, way, base)
                 for (way, _), base in zip(columns.values(), bases, strict=True)]
        rows.append([name, _count(group), *(f"{more:+z.2f} ± {error:.2f}"
                                            for more, error in cells)])
    return _markdown(["%", "problems", *columns], rows)


def _count(trials: Iterable[Trial]) -> str:
    return str(len({row.problem for row in trials}))


def _markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    lines = [header, ["---", *["---:"] * (len(header) - 1)], *rows]
    return [f"| {' | '.join(cells)} |" for cells in lines]


def main(
    sizes: Annotated[str, typer.Option(help="customers, comma-separated")] = "50,100",
    each: Annotated[int, typer.Option(help="problems of each class and size", min=1)] = 3,
    limits: Annotated[str, typer.Option(help="seconds, comma-separated")] = "0.05,0.1,0.3,1",
    moves: Annotated[bool, typer.Option(help="also without families of moves")] = True,
    policy: str = DEFAULT_POLICY,
    output: Annotated[Path, typer.Option(help="CSV of all plans")]
    = Path("runs/bench/ablation.csv"),
) -> None:
    """Print the tables in Markdown."""
    chosen = ways([float(limit) for limit in limits.split(",")], moves)
    samples = sample([int(size) for size in sizes.split(",")], each)
    loaded = load_policy(Settings().weights_dir / policy)
    known = {(trial.problem, trial.way) for trial in read_rows(output, Trial)}
    append_rows(output, Trial, measure(samples, loaded, chosen, known))
    trials = read_rows(output, Trial)
    lines = [*table_of_starts(trials), "", *table_of_pairs(trials)]
    if moves:
        lines += ["", *table_of_moves(trials)]
    typer.echo("\n".join(lines))


if __name__ == "__main__":
    typer.run(main)
