"""The same requests on roads to Tandem and to VROOM.

`python -m benchmarks.speed.road_requests extract…`.

Matrices are those of the service's own roads between places by an extract's streets. Otherwise as
in `benchmarks.peers.vroom_requests`: VROOM explores as it does by default on one thread, once until
it is done, or as long as is stated, and once stopped after a second, and Tandem gets the wall time
of each; what either refuses for want of time isn't counted.
"""

import math
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.formats.vroom.errors import VroomError
from app.maps.roads.building import build_roads
from app.maps.roads.opening import opened_roads
from app.maps.roads.roads import Roads
from app.maps.roads.setting import Extract
from app.maps.roads.tools import find_tools
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.peers.vroom_requests import STOPPED, Compared, cells, compare
from benchmarks.speed.roads import PATIENCE, drawn
from model.planner import Planner, load_planner
from model.problem import FloatArray

Data = dict[str, Any]

DAY, SERVICE = 28_800, 180
PER_VEHICLE = 30
"""Jobs of a vehicle, about."""


def deliveries(rng: np.random.Generator, matrix: Data, size: int) -> Data:
    """Return deliveries that fill nine tenths of the capacity."""
    demand = rng.integers(1, 20, size).tolist()
    jobs = [{"id": number, "location_index": number, "delivery": [amount], "service": SERVICE}
            for number, amount in enumerate(demand, 1)]
    count = max(2, size // PER_VEHICLE)
    capacity = math.ceil(sum(demand) / 0.9 / count)
    vehicles = [{"id": number, "start_index": 0, "end_index": 0, "capacity": [capacity]}
                for number in range(count)]
    return {"jobs": jobs, "vehicles": vehicles, "matrices": {"car": matrix}}


def windows(rng: np.random.Generator, matrix: Data, size: int) -> Data:
    """Return the same with time windows of one to three hours, and half as many vehicles more."""
    request = deliveries(rng, matrix, size)
    for job in request["jobs"]:
        begin = int(rng.integers(0, DAY - 10_800))
        job["time_windows"] = [[begin, begin + int(rng.integers(3_600, 10_800))]]
    (first, *_), count = request["vehicles"], len(request["vehicles"])
    request["vehicles"] = [first | {"id": number, "time_window": [0, DAY]}
                           for number in range(math.ceil(1.5 * count))]
    return request


CLASSES: tuple[Callable[[np.random.Generator, Data, int], Data], ...] = (deliveries, windows)


def matrix_of(roads: Roads, extract: Path, size: int, seed: int) -> Data:
    """Return the legs between a start and so many places that roads reach."""
    places = drawn(extract, 2 * size + 2, seed)
    table = roads.table("car", places, time.perf_counter() + PATIENCE)
    hub = int(np.isfinite(table.durations_s).sum(axis=1).argmax())
    reached = np.isfinite(table.durations_s[hub]) & np.isfinite(table.durations_s[:, hub])
    reached[hub] = False
    rows = np.concatenate(([hub], np.flatnonzero(reached)[:size]))
    if len(rows) <= size:
        raise ValueError(f"{extract}: too few of the places have roads")

    def between(legs: FloatArray) -> list[list[int]]:
        known = np.where(np.isfinite(legs), legs, legs[:, [hub]] + legs[[hub], :])
        whole: list[list[int]] = np.rint(known[np.ix_(rows, rows)]).astype(int).tolist()
        return whole

    return {"durations": between(table.durations_s), "distances": between(table.distances_m)}


def compared(planner: Planner, requests: list[Data], seconds: float | None) -> Iterator[Compared]:
    """Yield what both make of requests, but those for which there wasn't time enough."""
    for request in requests:
        with suppress(VroomError):
            yield compare(planner, request, seconds)


def rows(planner: Planner, roads: Roads, extract: Path, sizes: list[int], repeats: int,
         most: float | None) -> Iterator[list[str]]:
    """Yield the rows of the table."""
    for make in CLASSES:
        for size in sizes:
            requests = [make(np.random.default_rng(seed), matrix_of(roads, extract, size, seed),
                             size) for seed in range(repeats)]
            done = list(compared(planner, requests, most))
            stopped = list(compared(planner, requests, STOPPED))
            seconds = statistics.mean(run.vroom_seconds for run in done)
            yield [extract.name.partition(".")[0], make.__name__, str(size), f"{seconds:.2f}",
                   *cells(done), *cells(stopped)]


def main(
    extracts: list[Path],
    sizes: Annotated[list[int] | None, typer.Option(help="Jobs of a request.")] = None,
    repeats: Annotated[int, typer.Option(help="Requests of each class and size.")] = 3,
    most: Annotated[float | None, typer.Option(
        help="Seconds after which VROOM is stopped. Left out: once it is done.")] = None,
) -> None:
    """Print the costs of Tandem's solutions divided by those of VROOM's."""
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    table = Table(title="Cost of Tandem / cost of VROOM where both serve the same, and how often "
                        "Tandem serves more / less by VROOM's objective")
    for name in ("extract", "class", "jobs", "VROOM s", "same time", "more / less", "1 s",
                 "more / less"):
        table.add_column(name, justify="right")
    with TemporaryDirectory() as folder:
        for extract in extracts:
            path = Path(folder) / extract.name
            path.symlink_to(extract.resolve())
            build_roads(Extract(path, "car"), find_tools())
            with opened_roads(Settings(roads=f"car={path}", data_dir=Path(folder))) as roads:
                for row in rows(planner, roads, path, sizes or [100, 300, 1000], repeats, most):
                    table.add_row(*row)
                    Console(stderr=True).print(" ".join(row))
    Console().print(table)


if __name__ == "__main__":
    typer.run(main)
