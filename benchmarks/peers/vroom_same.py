"""What do VROOM requests cost, before a change and after?

`python -m benchmarks.peers.vroom_same record`, then `compare`.

For a change of how they are said to the planner: each stage of planning searches for a number of
turns, whatever the clock says. `compare` of two such files fails if some reply is worse by VROOM's
objective, or dearer by more than half a per cent in the mean of a class.
"""

import json
import math
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from tqdm import tqdm

from app.formats.vroom.places import find_places
from app.formats.vroom.reading import read_request
from app.formats.vroom.translate import translate
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.peers.vroom_requests import (
    CLASSES, both_ways, limits, mixed_fleet, priorities, setups, several_windows,
)
from model.dialects.vroom.planning import Planning
from model.dialects.vroom.work import LegLimit
from model.planner import Planner, PlanOptions, PlanResult, load_planner
from model.problem import Problem
from model.solution import Solution

Data = dict[str, Any]

SIZES = (20, 50, 100)
TURNS = 2000
SEEDS = 2

UNTIMED = 1e6
"""Seconds that nothing reaches."""

DEARER = 0.005
"""By how much of their cost the replies of a class may become dearer."""

app = typer.Typer(help=__doc__, pretty_exceptions_enable=False)


def elsewhere(rng: np.random.Generator, size: int) -> Data:
    """Return `mixed_fleet` with vehicles that start and end at different places, or nowhere."""
    request = mixed_fleet(rng, size)
    for number, vehicle in enumerate(request["vehicles"]):
        del vehicle["end_index"]
        if number % 3:
            vehicle["end_index"] = int(rng.integers(0, size))
        if number % 3 == 2:
            del vehicle["start_index"]
    return request


def several_priorities(rng: np.random.Generator, size: int) -> Data:
    """Return `priorities` with two windows for a third of the jobs."""
    request = priorities(rng, size)
    for job in request["jobs"]:
        if rng.random() < 1 / 3:
            begin = int(rng.integers(0, 20_000))
            job["time_windows"] = [[begin, begin + 1_800], [begin + 5_000, begin + 8_000]]
    return request


def limited_priorities(rng: np.random.Generator, size: int) -> Data:
    """Return `priorities` that vehicles can't all reach."""
    request = limits(rng, size)
    for job in request["jobs"]:
        job["priority"] = int(rng.integers(0, 4))
    for vehicle in request["vehicles"]:
        vehicle["max_distance"] = 45_000
    return request


def two_way_priorities(rng: np.random.Generator, size: int) -> Data:
    """Return `both_ways` for seven tenths of the jobs, by priority."""
    request = both_ways(rng, size)
    for job in request["jobs"]:
        job["priority"] = int(rng.integers(0, 4))
    for vehicle in request["vehicles"]:
        vehicle["capacity"] = [round(vehicle["capacity"][0] * 0.6)]
    return request


def served_by_type(rng: np.random.Generator, size: int) -> Data:
    """Return `setups` by two types of vehicles, with windows for a fifth of the jobs."""
    request = setups(rng, size)
    for number, vehicle in enumerate(request["vehicles"]):
        vehicle["type"] = "ab"[number % 2]
    for job in request["jobs"]:
        job |= {"setup_per_type": {"b": int(rng.integers(300, 900))},
                "service_per_type": {"a": int(rng.integers(60, 300))}}
        if rng.random() < 0.2:
            begin = int(rng.integers(0, 20_000))
            job["time_windows"] = [[begin, begin + 7_200]]
    return request


MORE = (several_windows, several_priorities, limited_priorities, two_way_priorities, elsewhere,
        served_by_type)


def requests(seeds: int) -> Iterator[tuple[str, str, Data]]:
    """Yield classes, names and requests."""
    for make in dict.fromkeys((*CLASSES, *MORE)):
        for size in SIZES:
            for seed in range(seeds):
                yield (make.__name__, f"{make.__name__}-{size}-{seed}",
                       make(np.random.default_rng(seed), size))


def plan_by_turns(planner: Planner, turns: int) -> Callable[..., PlanResult]:
    """Return what plans a stage by a number of turns."""
    def plan(problem: Problem, options: PlanOptions, start: Solution) -> PlanResult:
        options = replace(options, time_limit=UNTIMED, search_iterations=turns)
        return planner.plan(problem, options, start=start)

    return plan


def value(planner: Planner, request: Data, turns: int) -> tuple[int, int, int]:
    """Return what the reply to a request is worth: priorities and jobs served, minus its cost."""
    settings = Settings()
    read = read_request(json.dumps(request).encode(), settings.max_customers,
                        settings.max_customers)
    places = find_places(read, settings.vroom_speeds, settings.max_legs)
    planning = Planning(translate(read), places, plan_by_turns(planner, turns),
                        PlanOptions(planner.policies[0]),
                        LegLimit(settings.max_legs, "TANDEM_MAX_LEGS"))
    return planning.find(time.perf_counter() + UNTIMED, {}).value


@app.command()
def record(
    output: Annotated[Path, typer.Argument(help="JSON lines to write.")],
    seeds: Annotated[int, typer.Option(help="Requests of each class and size.")] = SEEDS,
    turns: Annotated[int, typer.Option(help="Of each stage.")] = TURNS,
) -> None:
    """Plan all requests and write down what came of each."""
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    with output.open("w") as file:
        for group, name, request in tqdm(list(requests(seeds)), disable=None):
            priority, served, minus_cost = value(planner, request, turns)
            file.write(json.dumps({"class": group, "name": name, "priority": priority,
                                   "served": served, "cost": -minus_cost}) + "\n")
            file.flush()


@app.command()
def compare(before: Annotated[Path, typer.Argument(help="What was recorded first.")],
            after: Annotated[Path, typer.Argument(help="And later.")]) -> None:
    """Tell which replies serve others, and by how much the costs of the rest differ."""
    first, second = read(before), read(after)
    worse, ratios = 0, dict[str, list[float]]()
    for name in first.keys() & second.keys():
        old, new = first[name], second[name]
        values = [(line["priority"], line["served"]) for line in (old, new)]
        if values[0] != values[1]:
            typer.echo(f"{name}: serves {values[0]} before, {values[1]} after")
            worse += values[1] < values[0]
        elif old["cost"] > 0:
            ratios.setdefault(old["class"], []).append(new["cost"] / old["cost"])
    for group, each in ratios.items():
        mean = statistics.geometric_mean(each)
        typer.echo(f"{group}: {100 * (mean - 1):+.3f} % in the mean of {len(each)}, "
                   f"{100 * (max(each) - 1):+.3f} % at worst")
        worse += mean > 1 + DEARER
    logs = [math.log(ratio) for each in ratios.values() for ratio in each]
    typer.echo(f"All: {100 * math.expm1(statistics.mean(logs)):+.3f} % in the mean of {len(logs)}")
    raise typer.Exit(1 if worse else 0)


def read(path: Path) -> dict[str, Data]:
    """Return what was recorded, by name."""
    return {line["name"]: line for line in map(json.loads, path.read_text("utf-8").splitlines())}


if __name__ == "__main__":
    app()
