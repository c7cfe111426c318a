"""Fleets that just suffice: how often somebody is left out where a plan that serves all is known.

`python -m benchmarks.quality.tight_fleets --seconds 1`: problems of all variants in turn. Each is
planned with room first; what that plan uses of vehicles, capacities and working hours is all that
there is then, but for a slack of 0 to 3 %.
"""

import math
import time
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from benchmarks.clock import count_processor_time
from benchmarks.results import gap_percent
from benchmarks.rows import appended
from model.engine.instance import pack
from model.judge.check import check
from model.problem import Problem, VehicleType
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from training.instances import ALL, generate

SIZES = (25, 50, 75, 100)
SLACKS = (0.0, 0.01, 0.03)
ROOM_TURNS = 10_000
"""Turns of the search for a plan with room: so the problems are the same on each machine."""

TRIES = 20
"""Problems drawn for one in which the plan with room serves everybody."""


@dataclass(frozen=True)
class Run:
    """A judged plan of a problem whose fleet just suffices."""

    problem: int
    variant: str
    n: int
    slack: float
    seconds: float
    left_out: int
    gap_percent: float  # above the plan by which it was made; nan where somebody is left out
    turns: int
    processor_s: float


def main(
    seconds: Annotated[float, typer.Option(help="Of the processor, for each plan.")] = 1.0,
    number: Annotated[int, typer.Option(help="Problems.")] = 300,
    first: Annotated[int, typer.Option(help="The first of them.")] = 0,
    out: Annotated[Path | None, typer.Option(help="CSV to add rows to.")] = None,
) -> None:
    """Plan problems whose fleets just suffice, and print by variant how many are left out."""
    count_processor_time()
    found = (_run(index, seconds) for index in range(first, first + number))
    runs = [*(found if out is None else appended(out, Run, found))]
    by_variant: defaultdict[str, list[Run]] = defaultdict(list)
    for run in runs:
        by_variant[run.variant].append(run)
    for variant, some in [*by_variant.items(), ("all", runs)]:
        print(f"{variant:12} {_in_words(some)}")


def _in_words(runs: Sequence[Run]) -> str:
    whole = [run for run in runs if not run.left_out]
    gap = sum(run.gap_percent for run in whole) / len(whole) if whole else math.nan
    return (f"{len(runs):4} problems, {len(runs) - len(whole):3} with somebody left out "
            f"({sum(run.left_out for run in runs)}), {gap:+.2f} % dearer elsewhere")


def _run(index: int, seconds: float) -> Run:
    variant, problem, cost = draw(index)
    slack = SLACKS[index % len(SLACKS)]
    began = time.perf_counter()
    left_out, found_cost, done = _planned(problem, seconds, index)
    print(f"{index} {variant} {problem.num_customers} {left_out}", flush=True)
    return Run(index, variant, problem.num_customers, slack, seconds, left_out,
               math.nan if left_out else gap_percent(found_cost, cost), done,
               time.perf_counter() - began)


def draw(index: int) -> tuple[str, Problem, float]:
    """Return a variant, a problem of it whose fleet just suffices, and what a plan of it costs.

    Raises
    ------
    RuntimeError
        If no plan with room serves everybody.
    """
    variant = [*ALL][index % len(ALL)]
    rng = np.random.default_rng([index, 65])
    slack = SLACKS[index % len(SLACKS)]
    for _ in range(TRIES):
        problem = generate(rng, int(rng.choice(SIZES)), variant)
        plan = improve(problem, pack([problem], legs=False), nobody_served(problem),
                       SearchConfig(index, turns=ROOM_TURNS), math.inf).solution
        if plan.unassigned:
            continue
        tight = just_sufficing(problem, plan, slack)
        return variant, tight, check(problem, plan).cost.total
    raise RuntimeError(f"{variant}: no plan of {TRIES} problems serves everybody")


def just_sufficing(problem: Problem, plan: Solution, slack: float) -> Problem:
    """Return a problem with no more vehicles, capacity and working hours than a plan uses."""
    metrics = check(problem, plan).routes
    used = Counter(route.vehicle_type for route in plan.routes)
    loads: dict[int, tuple[int, ...]] = {}
    hours: dict[int, int] = {}
    for route, measured in zip(plan.routes, metrics, strict=True):
        kind = route.vehicle_type
        for trip in measured.trips:
            most = loads.get(kind, (0,) * problem.num_dimensions)
            loads[kind] = tuple(map(max, most, trip.highest_load))
        hours[kind] = max(hours.get(kind, 0), measured.working_duration)
    return replace(problem, vehicle_types=tuple([
        _tight(each, used[kind], loads[kind], hours[kind], slack) if used[kind]
        else replace(each, count=1, latest=each.earliest, overtime=None)  # has no time
        for kind, each in enumerate(problem.vehicle_types)]))


def _tight(kind: VehicleType, count: int, loads: tuple[int, ...], hours: int,
           slack: float) -> VehicleType:
    longest = math.ceil(hours * (1 + slack))
    if kind.max_working_duration is not None:
        longest = min(longest, kind.max_working_duration)
    return replace(
        kind, count=count, max_working_duration=longest if kind.overtime is None else
        kind.max_working_duration, capacity=tuple([
            min(most, math.ceil(load * (1 + slack)))
            for most, load in zip(kind.capacity, loads, strict=True)]))


def _planned(problem: Problem, seconds: float, seed: int) -> tuple[int, float, int]:
    """Return how many a plan leaves out, what it costs, and the turns of the search."""
    found = improve(problem, pack([problem], legs=False), nobody_served(problem),
                    SearchConfig(seed), time.perf_counter() + seconds)
    judged = check(problem, found.solution)
    if judged.violations:
        raise RuntimeError(judged.violations[0].message)
    return len(found.solution.unassigned), judged.cost.total, found.turns


def nobody_served(problem: Problem) -> Solution:
    """Return the plan that leaves out everybody."""
    return Solution((), tuple(range(problem.num_depots, problem.num_nodes)))


if __name__ == "__main__":
    typer.run(main)
