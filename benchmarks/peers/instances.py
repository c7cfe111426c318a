"""The uniform VRPTW instances of the papers on learned solvers."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from benchmarks.peers.published import Published, PublishedVehicle
from model.problem import Customer, Depot, IntArray, Problem, Travel, VehicleType

UNIFORM_UNIT = 100_000_000
"""Millimetres and milliseconds per unit of the uniform VRPTW files, which have six decimals."""


PUBLISHED_UNIT = 1_000_000
"""Units per unit of the files where instances are stated as `Published`."""


def load_vrptw_uniform(path: Path) -> list[tuple[str, Problem, float]]:
    """Return name, problem and reference cost of each instance of a uniform VRPTW file.

    One JSON object per line, in a unit square driven at speed 1. A unit of length is 100 km, a
    unit of time 100,000 s, and 100 km cost 1, so costs are distances in the file's unit.
    """
    lines = path.read_text(encoding="utf-8").splitlines()
    return [_uniform_instance(json.loads(line)) for line in lines if line]


def _uniform_instance(record: dict[str, Any]) -> tuple[str, Problem, float]:
    locations = np.array(record["locations"], dtype=np.float64)
    x, y = locations[:, 0], locations[:, 1]
    straight = np.hypot(x[:, None] - x, y[:, None] - y) * UNIFORM_UNIT
    duration = np.ceil(straight / record["speed"]).astype(np.int64)
    windows = np.rint(np.array(record["time_windows"]) * UNIFORM_UNIT).astype(np.int64).tolist()
    services = np.rint(np.array(record["service"]) * UNIFORM_UNIT).astype(np.int64).tolist()
    customers = tuple(
        Customer(str(node), (record["demand"][node] * 1000,), services[node], *windows[node])
        for node in range(1, len(locations)))
    truck = VehicleType(
        "truck", count=len(customers), capacity=(record["capacity"] * 1000,), travel=0,
        cost_per_km=1_000_000 / UNIFORM_UNIT, latest=round(record["horizon"] * UNIFORM_UNIT))
    longest = float(straight.max()) / UNIFORM_UNIT
    problem = Problem((Depot("depot"),), customers, (truck,),
                      (Travel(duration, np.rint(straight).astype(np.int64)),), locations,
                      unassigned_cost=20 * longest)
    return record["name"], problem, float(record["reference_cost"])


def uniform_set(path: Path, num_customers: int) -> list[Published]:
    """Return the instances of one size as other solvers take them, in millionths."""
    records = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line]
    return [_published(record, f"uniform_{num_customers}") for record in records
            if len(record["locations"]) == num_customers + 1]


def _published(record: dict[str, Any], set_name: str) -> Published:
    locations = np.array(record["locations"], dtype=np.float64)
    windows = _in_units(record["time_windows"])
    x, y = locations.T
    count = len(locations)
    return Published(
        record["name"], set_name, locations, np.array(record["demand"], np.int64),
        earliest=windows[:, 0], latest=windows[:, 1], service=_in_units(record["service"]),
        release=np.zeros(count, np.int64),
        travel=_in_units(np.hypot(x[:, None] - x, y[:, None] - y) / record["speed"]),
        vehicles=(PublishedVehicle(count - 1, record["capacity"], 0, 1),), max_trips=1,
        has_windows=True, divisor=PUBLISHED_UNIT, best_known=record["reference_cost"])


def _in_units(values: ArrayLike) -> IntArray:
    return np.rint(np.asarray(values, np.float64) * PUBLISHED_UNIT).astype(np.int64)
