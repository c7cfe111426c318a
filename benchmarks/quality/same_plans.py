"""Are plans still the same?

`python -m benchmarks.quality.same_plans record before.jsonl`, then `compare`.

For a change that should change no plan: random problems of all classes are planned greedily and by
a number of turns, by each policy, from nothing, and once more when two fifths of the day are over;
requests that mix rules are planned from nothing. Clocks have no say in any of it. With an engine
that was built with `-DTANDEM_TRACED=ON` all that insertions were found to cost in the first turns
is noted in a digest, so that a difference is found where it arises. `compare` of two such files
fails if a plan or a digest differs.
"""

import hashlib
import json
import math
import random
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import chain, count, islice
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from tqdm import tqdm

from app.plans.task import task_of
from app.requests.reading import read_request
from app.schemas.errors import RequestError
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.fuzz.mixed_problems import mixed_request
from benchmarks.quality.replanning import day_of, nothing
from model.engine.library import call
from model.planner import Planner, PlanOptions, load_planner
from model.problem import Problem
from model.replanning.refusing import SettledPartError
from model.replanning.replan import Replanning, Terms
from model.solution import Solution
from training.instances import ALL, generate

Data = dict[str, Any]

SEED = 20_261_121
SIZES = (20, 50, 100)
TURNS = 2000
FIRST_TURNS = (1, 5, 25)
"""After how many turns it is noted what insertions were found to cost."""

SHARE_OF_DAY = 0.4

UNTIMED = 3600.0
"""A time limit that nothing reaches."""

app = typer.Typer(help=__doc__, pretty_exceptions_enable=False)


def problems(number: int, variants: Sequence[str] = tuple(ALL)) -> Iterator[tuple[str, Problem]]:
    """Yield random problems, classes and sizes in turn, each from a stream of its own."""
    for index in range(number):
        variant = variants[index % len(variants)]
        size = SIZES[index // len(variants) % len(SIZES)]
        rng = np.random.default_rng((SEED, index))
        yield f"{variant}-{size}-{index:03}", generate(rng, size, variant)


def mixed_problems(number: int) -> Iterator[tuple[str, Problem]]:
    """Yield problems of so many requests that mix rules, of which none is refused."""
    def drawn() -> Iterator[tuple[str, Problem]]:
        for seed in count(SEED):
            body = json.dumps(mixed_request(random.Random(seed))).encode()
            with suppress(RequestError):
                yield f"rules-{seed}", task_of(read_request(body, None)).problem

    return islice(drawn(), number)


def traces(planner: Planner, problem: Problem) -> Iterator[Data]:
    """Yield lines with digests of what insertions were found to cost in some first turns."""
    options = PlanOptions(DEFAULT_POLICY, time_limit=UNTIMED)
    for turns in FIRST_TURNS:
        call("tandem_take_trace")
        found = planner.plan(problem, replace(options, search_iterations=turns),
                             start=nothing(problem))
        yield {**_line(f"{turns} turns", found.solution, found.final_cost),
               "trace": call("tandem_take_trace")}


def plans(planner: Planner, problem: Problem, turns: int) -> Iterator[Data]:
    """Yield lines with named plans of a problem and what they cost."""
    for policy in planner.policies:
        greedy = planner.plan(problem, PlanOptions(policy, time_limit=0.0))
        yield _line(f"{policy} greedy", greedy.solution, greedy.final_cost)
        options = PlanOptions(policy, time_limit=UNTIMED, search_iterations=turns)
        found = planner.plan(problem, options)
        yield _line(f"{policy} searched", found.solution, found.final_cost)
    found = planner.plan(problem, options, start=nothing(problem))
    yield _line("from nothing", found.solution, found.final_cost)
    if found.solution.routes:
        begin, end = day_of(found.solution)
        now = int(begin + SHARE_OF_DAY * (end - begin))
        try:
            replanning = Replanning(problem, Terms(found.solution, now))
        except SettledPartError:
            return
        later = replanning.plan(planner, options)
        yield _line("replanned", later.solution, later.final_cost)


@app.command()
def record(
    output: Annotated[Path, typer.Argument(help="JSON lines to write.")],
    number: Annotated[int, typer.Option(help="Problems of random classes.")] = 320,
    rules: Annotated[int, typer.Option(help="Requests that mix rules.")] = 300,
    turns: Annotated[int, typer.Option(help="Of each search.")] = TURNS,
    variants: Annotated[str, typer.Option(help="Classes, comma-separated.")] = ",".join(ALL),
) -> None:
    """Plan all problems and write down what came of each."""
    settings = Settings()
    planner = load_planner(settings.weights_dir, settings.policies)
    drawn = chain(problems(number, variants.split(",")), mixed_problems(rules))
    with output.open("w") as file:
        for name, problem in tqdm(drawn, total=number + rules, disable=None):
            for line in chain(traces(planner, problem), plans(planner, problem, turns)):
                file.write(json.dumps({**line, "name": f"{name}, {line['name']}"}) + "\n")
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
    """Return the names of plans or traces that differ, or that one recording lacks, in order."""
    def found(lines: dict[str, Data], name: str) -> tuple[Any, Any]:
        line = lines.get(name, {})
        return line.get("plan"), line.get("trace")

    return [name for name in sorted(first.keys() | second.keys())
            if found(first, name) != found(second, name)]


def _line(name: str, plan: Solution, cost: float) -> Data:
    # As plans were written before there were breaks.
    digest = hashlib.sha256(repr(plan).replace(", breaks=()", "").encode()).hexdigest()
    return {"name": name, "cost": cost, "plan": digest, "left_out": len(plan.unassigned)}


def _words(line: Data | None) -> str:
    return "no plan" if line is None else f"{line['cost']:.6f}, {line['left_out']} left out"


if __name__ == "__main__":
    app()
