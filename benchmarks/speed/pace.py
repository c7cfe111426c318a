"""How many turns a second does the search make? `python -m benchmarks.speed.pace compare`.

Some kinds of problems are searched for a number of turns, divided by the processor time they take,
which other work on the machine hardly changes; beginning isn't counted. With `--beside` another
checkout, whose interpreter is `.venv/bin/python` in it, does the same in turn with this one, and
the ratios are told.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.plans.task import task_of
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.quality.hubs import draw_day
from benchmarks.quality.replanning import nothing
from model.planner import PlanOptions, load_planner
from model.problem import UNLIMITED, Break, Problem
from training.instances import COMPARED, generate

ROOT = Path(__file__).resolve().parents[2]

UNTIMED = 3600.0
"""A time limit that nothing reaches."""

OTHERS = (("cvrp", 1000), ("drone", 200), ("mixed", 200), ("shipments", 100), ("resting", 100),
          ("vrptw", 10_000))
SIZE = 100

SEED = 20_261_122

PROBE = 100
"""Turns by which the number is set that takes about a second."""

Paces = dict[str, float]
"""Turns a second by kind."""

app = typer.Typer(help=__doc__, pretty_exceptions_enable=False)


def kinds() -> Iterator[tuple[str, Problem]]:
    """Yield the problems."""
    day = json.dumps(draw_day(200, 20, SEED)).encode()
    yield "hubs 200", task_of(read_request(day, None)).problem
    for variant, size in (*((variant, SIZE) for variant in COMPARED), *OTHERS):
        rng = np.random.default_rng((SEED, size, len(variant)))
        yield f"{variant} {size}", generate(rng, size, variant)
    for variant in ("vrptw", "soft", "shipments"):
        yield f"{variant} {SIZE}, lunch", with_lunch(
            generate(np.random.default_rng((SEED, SIZE)), SIZE, variant))


def with_lunch(problem: Problem) -> Problem:
    """Return a problem whose drivers have a break in the middle of the day."""
    day = max(customer.latest for customer in problem.customers if customer.latest < UNLIMITED)
    lunch = Break("lunch", day // 16, 2 * day // 5, 3 * day // 5)
    return replace(problem, vehicle_types=tuple(replace(kind, breaks=(lunch,))
                                                for kind in problem.vehicle_types))


def paces(turns: dict[str, int] | None, seconds: float) -> tuple[Paces, dict[str, int]]:
    """Return the paces, and with how many turns: of kinds as given, or of all as take `seconds`."""
    settings = Settings()
    planner = load_planner(settings.weights_dir, (DEFAULT_POLICY,))
    found: Paces = {}
    made: dict[str, int] = {}
    for name, problem in kinds():
        if turns is not None and name not in turns:
            continue

        def searched(number: int, problem: Problem = problem) -> float:
            began = time.process_time()
            planner.plan(problem, PlanOptions(DEFAULT_POLICY, time_limit=UNTIMED,
                                              search_iterations=number), start=nothing(problem))
            return time.process_time() - began

        began = min(searched(PROBE) for _ in range(2))
        if turns is None:
            each = max(1e-6, (searched(11 * PROBE) - began) / (10 * PROBE))
            made[name] = max(PROBE, int(seconds / each))
        else:
            made[name] = turns[name]
        found[name] = made[name] / max(1e-6, searched(PROBE + made[name]) - began)
    return found, made


@app.command(hidden=True)
def measure(seconds: float, turns: Annotated[str, typer.Argument()] = "") -> None:
    """Print the paces of this checkout as JSON."""
    print(json.dumps(paces(json.loads(turns) if turns else None, seconds)))


def paces_of(tree: Path, seconds: float, turns: dict[str, int] | None
             ) -> tuple[Paces, dict[str, int]]:
    """Return the paces of a checkout, measured in a process of its own."""
    program = Path(__file__).read_text("utf-8")
    known = [] if turns is None else [json.dumps(turns)]
    with tempfile.TemporaryDirectory() as folder:
        # This program measures both, whatever the other checkout has under its name.
        script = Path(folder, "pace_here.py")
        script.write_text(program)
        done = subprocess.run([_python(tree), str(script), "measure", str(seconds), *known],
                              cwd=tree, env={**os.environ, "PYTHONPATH": str(tree)}, check=True,
                              text=True, stdout=subprocess.PIPE)
    found, made = json.loads(done.stdout.splitlines()[-1])
    return found, made


def _python(tree: Path) -> str:
    own = tree / ".venv" / "bin" / "python"
    return str(own) if own.exists() else sys.executable


def table(rows: dict[str, list[tuple[float, ...]]]) -> Table:
    """Return medians by kind, and those of the ratios of each round."""
    beside = any(len(pair) > 1 for pairs in rows.values() for pair in pairs)
    shown = Table("turns a second", "here", *(("beside", "here / beside") if beside else ()))
    for name, pairs in rows.items():
        medians = [f"{statistics.median(values):,.0f}" for values in zip(*pairs, strict=True)]
        ratio = ([f"{statistics.median(pair[0] / pair[1] for pair in pairs):.3f}"]
                 if beside else [])
        shown.add_row(name, *medians, *ratio)
    return shown


@app.command()
def compare(
    beside: Annotated[Path | None, typer.Option(help="Another checkout.")] = None,
    rounds: Annotated[int, typer.Option(help="How often each is measured.")] = 3,
    seconds: Annotated[float, typer.Option(help="Of each search, about.")] = 1.0,
) -> None:
    """Measure this checkout, or two in turn."""
    trees = [ROOT, *([] if beside is None else [beside.resolve()])]
    rows: dict[str, list[tuple[float, ...]]] = {}
    turns: dict[str, int] | None = None
    for _ in range(rounds):
        measured = []
        for tree in trees:
            found, turns = paces_of(tree, seconds, turns)
            measured.append(found)
        for name in measured[0]:
            rows.setdefault(name, []).append(tuple(found[name] for found in measured))
    Console().print(table(rows))


if __name__ == "__main__":
    app()
