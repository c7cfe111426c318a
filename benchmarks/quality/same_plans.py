"""Are plans still the same?

`python -m benchmarks.quality.same_plans record before.jsonl`, then `compare`.

For a change that should change no plan: random problems of some classes are planned greedily and by
a number of turns, by each policy, from nothing, and once more when two fifths of the day are over.
Clocks have no say in any of it. `compare` of two such files fails if a plan differs.
"""

import hashlib
import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from tqdm import tqdm

from app.serving.settings import Settings
from benchmarks.quality.replanning import day_of, nothing
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.solution import Solution
from training.instances import COMPARED, generate

Data = dict[str, Any]

SEED = 20_261_121
SIZES = (20, 50, 100)
TURNS = 2000
SHARE_OF_DAY = 0.4

UNTIMED = 3600.0
"""A time limit that nothing reaches."""

app = typer.Typer(help=__doc__, pretty_exceptions_enable=False)


def problems(number: int, variants: Sequence[str] = COMPARED) -> Iterator[tuple[str, Problem]]:
    """Yield random problems, classes and sizes in turn, each from a stream of its own."""
    for index in range(number):
        variant = variants[index % len(variants)]
        size = SIZES[index // len(variants) % len(SIZES)]
        rng = np.random.default_rng((SEED, index))
        yield f"{variant}-{size}-{index:03}", generate(rng, size, variant)


def plans(planner: Planner, problem: Problem, turns: int) -> Iterator[tuple[str, Solution, float]]:
    """Yield named plans of a problem and what they cost."""
    for policy in planner.policies:
        greedy = planner.plan(problem, PlanOptions(policy, time_limit=0.0))
        yield f"{policy} greedy", greedy.solution, greedy.final_cost
        options = PlanOptions(policy, time_limit=UNTIMED, search_iterations=turns)
        found = planner.plan(problem, options)
        yield f"{policy} searched", found.solution, found.final_cost
    found = planner.plan(problem, options, start=nothing(problem))
    yield "from nothing", found.solution, found.final_cost
    if found.solution.routes:
        begin, end = day_of(found.solution)
        now = int(begin + SHARE_OF_DAY * (end - begin))
        try:
            replanning = Replanning(problem, Terms(found.solution, now))
        except SettledPartError:
            return
        later = replanning.plan(planner, options)
        yield "replanned", later.solution, later.final_cost


@app.command()
def record(
    output: Annotated[Path, typer.Argument(help="JSON lines to write.")],
    number: Annotated[int, typer.Option(help="Problems.")] = 300,
    turns: Annotated[int, typer.Option(help="Of each search.")] = TURNS,
    variants: Annotated[str, typer.Option(help="Classes, comma-separated.")] = ",".join(COMPARED),
) -> None:
    """Plan all problems and write down what came of each."""
    settings = Settings()
    planner = load_planner(settings.weights_dir, settings.policies)
    with output.open("w") as file:
        drawn = problems(number, variants.split(","))
        for name, problem in tqdm(drawn, total=number, disable=None):
            for kind, plan, cost in plans(planner, problem, turns):
                # As plans were written before there were breaks.
                digest = hashlib.sha256(
                    repr(plan).replace(", breaks=()", "").encode()).hexdigest()
                file.write(json.dumps({"name": f"{name}, {kind}", "cost": cost, "plan": digest,
                                       "left_out": len(plan.unassigned)}) + "\n")
            file.flush()


@app.command()
def compare(before: Annotated[Path, typer.Argument(help="What was recorded first.")],
            after: Annotated[Path, typer.Argument(help="And later.")]) -> None:
    """Tell which plans differ, and by how much in cost."""
    first, second = read(before), read(after)
    changed = differences(first, second)
    for name in changed:
        old, new = first.get(name), second.get(name)
        typer.echo(f"{name}: {_words(old)} before, {_words(new)} after")
    both = [name for name in changed if name in first and name in second
            and first[name]["cost"] > 0 < second[name]["cost"]]
    if both:
        logs = [math.log(second[name]["cost"] / first[name]["cost"]) for name in both]
        percent = 100 * math.expm1(sum(logs) / len(logs))
        typer.echo(f"Those that differ cost {percent:+.2f} % in the geometric mean.")
    typer.echo(f"{len(first.keys() | second.keys())} plans, {len(changed)} differ")
    raise typer.Exit(1 if changed else 0)


def read(path: Path) -> dict[str, Data]:
    """Return what was recorded, by name."""
    return {line["name"]: line for line in map(json.loads, path.read_text("utf-8").splitlines())}


def differences(first: dict[str, Data], second: dict[str, Data]) -> list[str]:
    """Return the names of plans that differ, or that one recording lacks, in order."""
    return [name for name in sorted(first.keys() | second.keys())
            if first.get(name, {}).get("plan") != second.get(name, {}).get("plan")]


def _words(line: Data | None) -> str:
    return "no plan" if line is None else f"{line['cost']:.6f}, {line['left_out']} left out"


if __name__ == "__main__":
    app()
