"""Plans of more places than all legs are asked for: all legs that they drive, beside the truth.

    python -m benchmarks.quality.far_plans extract.osm.pbf [places] [seconds]

Customers lie by the streets of the extract, and have windows of three hours.
"""

import json
import sys
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.maps.roads.building import build_roads
from app.maps.roads.engine import Block
from app.maps.roads.opening import opened_roads
from app.maps.roads.roads import Roads
from app.maps.roads.setting import Extract
from app.maps.roads.tools import find_tools
from app.plans.service import plan_options
from app.plans.task import task_of
from app.requests.conversion.preparing import Preparing
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.speed.roads import PATIENCE, drawn
from model.planner import load_planner
from model.problem import FloatArray

PLACES, SECONDS = 2500, 60.0
DAY, WINDOW = 43_200, 10_800
PER_TRUCK = 60

ROUNDING = 0.005
"""Seconds by which a leg may be longer than in truth, as times are whole milliseconds."""

WALKED = 5 / 3.6
"""Metres walked in a second."""


def main() -> None:
    """Plan once, and print what was asked for, found and true."""
    count = int(sys.argv[2]) if len(sys.argv) > 2 else PLACES
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else SECONDS
    with TemporaryDirectory() as folder:
        path = Path(folder) / "town.osm.pbf"
        path.symlink_to(Path(sys.argv[1]).resolve())
        build_roads(Extract(path, "car"), find_tools())
        with opened_roads(Settings(roads=f"car={path}", data_dir=Path(folder))) as roads:
            measure(roads, path, count, seconds)


def measure(roads: Roads, extract: Path, count: int, seconds: float) -> None:
    """Plan so many places, and print what came of it."""
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    places = reached(roads, drawn(extract, 2 * count, 0))[:count]
    request = read_request(json.dumps(request_of(places, seconds)).encode(), planner.policies)
    began = time.perf_counter()
    task = task_of(request, Preparing(seconds=PATIENCE), roads=roads)
    assert task.far is not None
    ready = time.perf_counter()
    guessed = next(iter(task.far.estimates.travels.values())).legs.guessed.sum()
    options = plan_options(request.options)
    reply = task.reply(options, task.plan(planner, options, ready))
    print(f"{len(places)} places: legs after {ready - began:.1f} s, plan after "
          f"{time.perf_counter() - ready:.1f} s; {guessed / len(places)**2:.0%} of the legs "
          f"estimated; {reply['summary']['served']} served by {reply['summary']['vehicles']}")
    legs = list(driven(reply))
    true = truth(roads, places, [(start, end) for start, end, _ in legs])
    apart = np.abs(true - [seconds for _, _, seconds in legs])
    print(f"{len(legs)} legs driven, {(apart > ROUNDING).sum()} wrong, "
          f"the worst by {apart.max():.4f} s")


def reached(roads: Roads, places: FloatArray) -> FloatArray:
    """Return those places that have ways to and from the first."""
    hub, everyone = np.array([0]), np.arange(len(places))
    table = roads.some_legs("car", places, (Block(hub, everyone), Block(everyone, hub)),
                            time.perf_counter() + PATIENCE)
    return places[np.isfinite(table.durations_s[0]) & np.isfinite(table.durations_s[:, 0])]


def request_of(places: FloatArray, seconds: float) -> dict[str, Any]:
    """Return customers at all places but the first, which is the depot."""
    rng = np.random.default_rng(1)
    depot, *others = places.tolist()
    begins = rng.integers(0, DAY - WINDOW, len(others)).tolist()
    return {
        "coordinate_system": "geographic", "depots": [{"id": "0", "location": depot}],
        "customers": [{"id": str(number), "demand": [1], "location": place,
                       "service_duration": 120,
                       "time_window": {"earliest": begin, "latest": begin + WINDOW}}
                      for number, (place, begin) in enumerate(zip(others, begins, strict=True), 1)],
        "fleet": [{"id": "car", "profile": "car", "capacity": [PER_TRUCK],
                   "count": 2 * len(others) // PER_TRUCK, "shift": {"earliest": 0, "latest": DAY},
                   "costs": {"fixed": 50, "per_km": 1, "per_hour": 20}}],
        "options": {"time_limit": seconds}}


def driven(reply: dict[str, Any]) -> Iterator[tuple[int, int, float]]:
    """Yield the legs that are driven, by place, and how long they take."""
    for route in reply["routes"]:
        for trip in route["trips"]:
            for before, stop in pairwise(trip["stops"]):
                yield int(before["id"]), int(stop["id"]), stop["arrival"] - before["departure"]


def truth(roads: Roads, places: FloatArray, legs: list[tuple[int, int]]) -> FloatArray:
    """Return the true seconds of legs, asked for in one table of all places."""
    table = roads.table("car", places, time.perf_counter() + PATIENCE)
    via = table.durations_s[:, :1] + table.durations_s[:1]
    durations = np.where(np.isnan(table.durations_s), via, table.durations_s)
    walks = table.snap_m / WALKED
    whole = durations + walks[:, None] + walks
    return np.array([whole[leg] for leg in legs])


if __name__ == "__main__":
    main()
