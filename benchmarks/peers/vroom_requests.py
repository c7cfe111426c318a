"""The same VROOM requests to Tandem and to VROOM: `python -m benchmarks.peers.vroom_requests`.

VROOM, by its package pyvroom, explores as it does by default on one thread, once until it is done
and once stopped after a second. Tandem gets the wall time of each. A row of the table is the mean
of several random requests.
"""

import json
import math
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import timedelta
from importlib import import_module
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.formats.vroom.answering import answer
from app.schemas.limits import DEFAULT_POLICY
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.planner import Planner, load_planner

Data = dict[str, Any]

EXPLORATION = 5
STOPPED = 1.0
"""Seconds after which the second run is stopped."""

SIDE_M, SPEED = 20_000, 10.0
"""Side of the area in metres, and speed in metres a second."""

DAY = 28_800
MANY, SHORT = 50, 300
"""Windows of a job that has many, and how long each is."""

LEAST_SECONDS = 0.05
"""Tandem gets at least this time, where VROOM is done sooner."""


@dataclass(frozen=True)
class Compared:
    """One request, answered by both; values are priorities and jobs served."""

    vroom_seconds: float
    vroom_value: tuple[int, int]
    tandem_value: tuple[int, int]
    ratio: float  # of costs; nan unless the values are equal


def cvrp(rng: np.random.Generator, size: int) -> Data:
    """Return deliveries that fill nine tenths of the capacity."""
    request = _places(rng, size, num_places=size)
    demand = rng.integers(1, 20, size)
    for job, amount in zip(request["jobs"], demand.tolist(), strict=True):
        job["delivery"] = [amount]
    count = max(2, size // 12)
    capacity = math.ceil(demand.sum() / 0.9 / count)
    _add_vehicles(request, count, capacity=[capacity])
    return request


def windows(rng: np.random.Generator, size: int) -> Data:
    """Return deliveries with time windows of one to three hours."""
    request = cvrp(rng, size)
    for job in request["jobs"]:
        begin = int(rng.integers(0, DAY - 10_800))
        job["time_windows"] = [[begin, begin + int(rng.integers(3_600, 10_800))]]
        job["service"] = 300
    for vehicle in request["vehicles"]:
        vehicle["time_window"] = [0, DAY]
    return _with_more_vehicles(request)


def several_windows(rng: np.random.Generator, size: int) -> Data:
    """Return the same with windows in the morning and in the afternoon."""
    request = windows(rng, size)
    for job in request["jobs"]:
        morning, afternoon = int(rng.integers(0, 9_000)), int(rng.integers(16_200, 23_400))
        job["time_windows"] = [[morning, morning + 3_600], [afternoon, afternoon + 3_600]]
    return request


def many_windows(rng: np.random.Generator, size: int) -> Data:
    """Return the same as `windows`, with fifty windows of five minutes all over the day."""
    request = windows(rng, size)
    step = DAY // MANY
    for job in request["jobs"]:
        begins = np.arange(0, DAY, step) + rng.integers(0, step - SHORT, MANY)
        job["time_windows"] = [[begin, begin + SHORT] for begin in begins.tolist()]
    return request


def skills(rng: np.random.Generator, size: int) -> Data:
    """Return the same as `windows`, with skills that half of the jobs need."""
    request = windows(rng, size)
    for job in request["jobs"]:
        if rng.random() < 0.5:
            job["skills"] = [int(rng.integers(1, 4))]
    for vehicle in request["vehicles"]:
        vehicle["skills"] = rng.permutation([1, 2, 3])[:2].tolist()
    return _with_more_vehicles(request)


def mixed_fleet(rng: np.random.Generator, size: int) -> Data:
    """Return `windows` for vans and trucks of several costs, from two starts."""
    request = windows(rng, size)
    for number, vehicle in enumerate(request["vehicles"]):
        is_truck = number % 2 == 0
        (most,) = vehicle["capacity"]
        vehicle["capacity"] = [round(most * (1.6 if is_truck else 0.8))]
        vehicle["costs"] = {"fixed": 2_000 if is_truck else 800,
                            "per_hour": 4_500 if is_truck else 3_600,
                            "per_km": 60 if is_truck else 30}
        vehicle["start_index"] = vehicle["end_index"] = number % 2
        vehicle["speed_factor"] = 0.9 if is_truck else 1.0
    return request


def setups(rng: np.random.Generator, size: int) -> Data:
    """Return `cvrp` at a third as many places, with setups that are due once at each."""
    request = _places(rng, size, num_places=max(3, size // 3))
    for job in request["jobs"]:
        job |= {"setup": 600, "service": 120, "delivery": [int(rng.integers(1, 10))]}
    total = sum(job["delivery"][0] for job in request["jobs"])
    count = max(2, size // 12)
    _add_vehicles(request, count, capacity=[math.ceil(total / 0.9 / count)],
                  time_window=[0, DAY])
    return request


def priorities(rng: np.random.Generator, size: int) -> Data:
    """Return `windows` with capacity for seven jobs of ten, of unequal priority."""
    request = windows(rng, size)
    for job in request["jobs"]:
        job["priority"] = int(rng.choice([0, 1, 2, 5, 10]))
    total = sum(job["delivery"][0] for job in request["jobs"])
    for vehicle in request["vehicles"]:
        vehicle["capacity"] = [math.ceil(0.7 * total / len(request["vehicles"]))]
    return request


def both_ways(rng: np.random.Generator, size: int) -> Data:
    """Return `cvrp` with half of the jobs to pick up instead."""
    request = cvrp(rng, size)
    for job in request["jobs"]:
        if rng.random() < 0.5:
            job["pickup"] = job.pop("delivery")
    for vehicle in request["vehicles"]:
        vehicle["capacity"] = [round(vehicle["capacity"][0] * 0.7)]
    return request


def limits(rng: np.random.Generator, size: int) -> Data:
    """Return `windows` with limits of distance."""
    request = windows(rng, size)
    for vehicle in request["vehicles"]:
        vehicle["max_distance"] = 90_000
    return request


def shipments(rng: np.random.Generator, size: int) -> Data:
    """Return `windows` in which half of the jobs are ends of shipments."""
    request = windows(rng, size)
    number = len(request["jobs"]) // 4
    taken = request["jobs"][-2 * number:]
    del request["jobs"][-2 * number:]
    request["shipments"] = []
    for pickup, delivery in zip(taken[:number], taken[number:], strict=True):
        amount = pickup.pop("delivery")
        del delivery["delivery"], pickup["time_windows"]
        request["shipments"].append({"pickup": pickup, "delivery": delivery, "amount": amount})
    return request


def rests(rng: np.random.Generator, size: int) -> Data:
    """Return `windows` with a break at noon and another later."""
    return _with_breaks(windows(rng, size))


def shipments_and_rests(rng: np.random.Generator, size: int) -> Data:
    """Return `shipments` with the breaks of `rests`."""
    return _with_breaks(shipments(rng, size))


def _with_breaks(request: Data) -> Data:
    for vehicle in request["vehicles"]:
        vehicle["breaks"] = [{"id": 1, "service": 1_800, "time_windows": [[10_800, 14_400]]},
                             {"id": 2, "service": 900, "time_windows": [[18_000, 23_400]]}]
    return request


CLASSES: tuple[Callable[[np.random.Generator, int], Data], ...] = (
    cvrp, windows, several_windows, many_windows, skills, mixed_fleet, setups, priorities,
    both_ways, limits, shipments, rests, shipments_and_rests)


def _places(rng: np.random.Generator, size: int, num_places: int) -> Data:
    """Return jobs at random places on roads that are up to a tenth longer one way."""
    points = rng.uniform(0, SIDE_M, (num_places + 1, 2))
    points[0] = SIDE_M / 2
    straight = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    distances = np.rint(straight * rng.uniform(1.2, 1.32, straight.shape)).astype(int)
    durations = np.rint(distances / SPEED).astype(int)
    jobs = [{"id": number, "location_index": 1 + number % num_places} for number in range(size)]
    return {"jobs": jobs, "vehicles": [],
            "matrices": {"car": {"durations": durations.tolist(),
                                 "distances": distances.tolist()}}}


def _add_vehicles(request: Data, count: int, **fields: Any) -> None:
    """Add vehicles that start and end at the first place. In place."""
    request["vehicles"] += [
        {"id": number, "start_index": 0, "end_index": 0, **fields} for number in range(count)]


def _with_more_vehicles(request: Data) -> Data:
    """Return a request with half as many vehicles more, so that all jobs can be served."""
    vehicles = request["vehicles"]
    more = [{**vehicle, "id": len(vehicles) + vehicle["id"]}
            for vehicle in vehicles[: math.ceil(len(vehicles) / 2)]]
    return {**request, "vehicles": [*vehicles, *more]}


def by_vroom(request: Data, seconds: float | None) -> tuple[Data, float]:
    """Return VROOM's reply, and how long it took."""
    vroom: Any = import_module("vroom")
    problem = vroom.Input()
    problem._from_json(json.dumps(request), False)
    began = time.perf_counter()
    solution = problem.solve(
        exploration_level=EXPLORATION, nb_threads=1,
        timeout=None if seconds is None else timedelta(seconds=seconds))
    elapsed = time.perf_counter() - began
    return solution.to_dict(), elapsed


def by_tandem(planner: Planner, request: Data, seconds: float) -> Data:
    """Return Tandem's reply within a time limit."""
    settings = Settings().model_copy(update={"vroom_seconds": max(seconds, LEAST_SECONDS)})
    body = ReceivedBody(json.dumps(request).encode(), time.perf_counter())
    reply: Data = json.loads(answer(planner, body, settings, lambda: False))
    return reply


def compare(planner: Planner, request: Data, seconds: float | None) -> Compared:
    """Answer a request by both; Tandem gets the time that VROOM took."""
    theirs, elapsed = by_vroom(request, seconds)
    ours = by_tandem(planner, request, elapsed if seconds is None else seconds)
    number = len(request["jobs"]) + 2 * len(request.get("shipments", ()))
    values = [(reply["summary"]["priority"], number - reply["summary"]["unassigned"])
              for reply in (theirs, ours)]
    ratio = ours["summary"]["cost"] / theirs["summary"]["cost"]
    return Compared(elapsed, values[0], values[1], ratio if values[0] == values[1] else math.nan)


def rows(planner: Planner, sizes: list[int], repeats: int) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    for make in CLASSES:
        for size in sizes:
            requests = [make(np.random.default_rng(seed), size) for seed in range(repeats)]
            done = [compare(planner, request, None) for request in requests]
            stopped = [compare(planner, request, STOPPED) for request in requests]
            seconds = statistics.mean(run.vroom_seconds for run in done)
            yield [make.__name__, str(size), f"{seconds:.2f}", *cells(done), *cells(stopped)]


def cells(runs: list[Compared]) -> list[str]:
    """Return the mean ratio of costs, and how often Tandem serves more and less."""
    ratios = [run.ratio for run in runs if not math.isnan(run.ratio)]
    mean = f"{statistics.geometric_mean(ratios):.3f}" if ratios else "-"
    more = sum(run.tandem_value > run.vroom_value for run in runs)
    fewer = sum(run.tandem_value < run.vroom_value for run in runs)
    return [mean, f"{more} / {fewer}"]


def main(
    sizes: Annotated[list[int] | None, typer.Option(help="Jobs of a request.")] = None,
    repeats: Annotated[int, typer.Option(help="Requests of each class and size.")] = 3,
) -> None:
    """Print the costs of Tandem's solutions divided by those of VROOM's."""
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    table = Table(title="Cost of Tandem / cost of VROOM where both serve the same, and how often "
                        "Tandem serves more / less by VROOM's objective")
    for name in ("class", "jobs", "VROOM s", "same time", "more / less", "1 s", "more / less"):
        table.add_column(name, justify="right")
    for row in rows(planner, sizes or [20, 100, 200], repeats):
        table.add_row(*row)
        Console(stderr=True).print(" ".join(row))
    Console().print(table)


if __name__ == "__main__":
    typer.run(main)
