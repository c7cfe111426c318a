"""Published instances as problems."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from model.problem import Customer, Depot, Problem, Travel, VehicleType

UNIFORM_UNIT = 100_000_000
"""Millimetres and milliseconds per unit of the uniform VRPTW files, which have six decimals."""


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
