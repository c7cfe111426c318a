"""The study's problems, as requests of `POST /plan`.

What the paper doesn't give is chosen here; `benchmarks.study.report` states it in one table.
"""

import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from app.schemas.request import PlanRequest
from benchmarks.study.tasks import Task, Windows

Data = dict[str, Any]

EXAMPLES = Path(__file__).parents[2] / "examples"

SEED = 20_250_926

REACH = ((3, 73), (1, 74))
"""Least and largest x and y in Table 1."""

RESERVED = 0.1
"""Share of the customers for drones only, and of those for trucks only."""

HOUR = 3600

TRUCKS = {100: (10.0, 0.9), 110: (11.0, 0.92), 150: (15.0, 1.0), 200: (20.0, 1.1)}
"""Cost per use and per km of a truck, by its capacity."""

SPEED_KMH = 30.0
"""So that 8 hours are 240 km, near what the paper's courses and stroke rates say."""

MAX_TRIPS = 3

DAY_SPEED_KMH, RUSH_SPEED_KMH = 40.0, 25.0
RUSH_HOURS = ((7, 9), (16, 18))
SHIFT = (6, 18)
LATE_COST = 30.0
"""Per hour."""

UNWINDOWED = 0.2
"""Share of the customers without a window."""

WIDTHS = (1, 2, 4)
"""Of a window, in hours."""

FULLEST = 0.975
"""Largest share of all capacity that is needed, where trucks have 400: that of Table 1."""


def request_of(task: Task) -> PlanRequest:
    """Return the problem that a task plans."""
    if task.section in ("fleets", "hours"):
        return _request(fleet_customers(task), fleet_of(task))
    if task.section == "drones":
        return _request(day_customers(task), [day_truck(task)])
    return _request(customers_of(task.customers, task.case), [table1_truck(task)])


@cache
def example(name: str) -> Data:
    """Return an example request."""
    data: Data = json.loads((EXAMPLES / f"{name}.json").read_text("utf-8"))
    return data


def _request(customers: list[Data], fleet: list[Data]) -> PlanRequest:
    table1 = example("table1")
    return PlanRequest.model_validate_json(json.dumps({
        "coordinate_system": "planar", "planar_unit": table1["planar_unit"],
        "depots": table1["depots"], "customers": customers, "fleet": fleet}))


def customers_of(size: int, case: int) -> list[Data]:
    """Return customers: the first case's are some of Table 1's, of other cases they are like them.

    As many of each kind as there, at other whole places, with demands of that kind.
    """
    rng = np.random.default_rng((SEED, size, case))
    kinds = _by_kind()
    reserved = round(RESERVED * size)
    wanted = {"drone": reserved, "either": size - 2 * reserved, "truck": reserved}
    chosen = [kinds[kind][index] for kind, count in wanted.items()
              for index in np.sort(rng.choice(len(kinds[kind]), count, replace=False)).tolist()]
    if case == 1:
        return [dict(customer) for customer in chosen]
    places = _free_places()
    spots = rng.choice(len(places), size, replace=False).tolist()
    demands = [kinds[customer["served_by"]][rng.integers(len(kinds[customer["served_by"]]))]
               for customer in chosen]
    return [{"id": str(number), "location": places[spot], "demand": drawn["demand"],
             "served_by": customer["served_by"]}
            for number, (customer, drawn, spot)
            in enumerate(zip(chosen, demands, spots, strict=True))]


@cache
def _by_kind() -> dict[str, list[Data]]:
    kinds: dict[str, list[Data]] = {"drone": [], "either": [], "truck": []}
    for customer in example("table1")["customers"]:
        kinds[customer["served_by"]].append(customer)
    return kinds


@cache
def _free_places() -> list[list[int]]:
    """Return all whole places but the depot's."""
    (left, right), (bottom, top) = REACH
    depot = example("table1")["depots"][0]["location"]
    return [[x, y] for x in range(left, right + 1) for y in range(bottom, top + 1)
            if [x, y] != depot]


def fleet_customers(task: Task) -> list[Data]:
    """Return customers whom trucks serve, since no drones are told of in Tables 3 to 5."""
    return [customer | {"served_by": "either"} for customer in customers_of(task.customers,
                                                                            task.case)]


def capacities_of(fleet: str) -> list[int]:
    """Return the capacities of a fleet."""
    return [int(capacity) for capacity in fleet.split("+")]


def fleet_of(task: Task) -> list[Data]:
    """Return as many trucks as could be wanted of each capacity, which drive several trips."""
    return [{"id": f"C={capacity}", "count": math.ceil(task.customers / 3), "capacity": [capacity],
             "costs": {"fixed": TRUCKS[capacity][0], "per_km": TRUCKS[capacity][1]},
             "speed_kmh": SPEED_KMH, "max_working_duration": task.hours * HOUR,
             "max_trips": MAX_TRIPS} for capacity in capacities_of(task.fleet)]


def table1_truck(task: Task) -> Data:
    """Return the truck of `examples/table1.json`, as few as Table 1's tightness allows."""
    demand = sum(customer["demand"][0] for customer in customers_of(task.customers, task.case))
    truck: Data = dict(example("table1")["fleet"][0])
    return truck | {"count": math.ceil(demand / FULLEST / truck["capacity"][0])}


def day_customers(task: Task) -> list[Data]:
    """Return customers of a working day; what drones alone serve otherwise, trucks may too."""
    customers = customers_of(task.customers, task.case)
    windows = windows_of(task.customers, task.case)
    for customer in customers:
        customer["service_duration"] = 300
        if customer["served_by"] == "drone":
            customer["served_by"] = "either"
        if customer["id"] in windows and task.windows != "off":
            customer["time_window"] = _window(windows[customer["id"]], task.windows)
    return customers


def _window(window: tuple[int, int], kind: Windows) -> Data:
    earliest, latest = window
    return {"earliest": earliest, "latest": latest,
            "late_cost_per_hour": LATE_COST if kind == "soft" else None}


def windows_of(size: int, case: int) -> dict[str, tuple[int, int]]:
    """Return windows in seconds since midnight, by customer.

    Those of the first case are those of `examples/table1_windows.json`; the others are drawn as
    wide, around instants between 7:00 and 15:00 that a truck can be there at.
    """
    if case == 1:
        stated = {customer["id"]: customer["time_window"]
                  for customer in example("table1_windows")["customers"]
                  if "time_window" in customer}
        return {name: (window["earliest"], window["latest"]) for name, window in stated.items()}
    rng = np.random.default_rng((SEED, size, case, 1))
    depot = example("table1")["depots"][0]["location"]
    windows: dict[str, tuple[int, int]] = {}
    for customer in customers_of(size, case):
        soonest = 7 + math.dist(depot, customer["location"]) / DAY_SPEED_KMH
        arrival, width = rng.uniform(soonest, 15), int(rng.choice(WIDTHS))
        earliest = max(float(SHIFT[0]), arrival - rng.uniform(0.2, 0.8) * width)
        if rng.random() >= UNWINDOWED:
            windows[customer["id"]] = (_quarter(earliest), _quarter(earliest + width) + HOUR // 4)
    return windows


def _quarter(hours: float) -> int:
    """Return hours in seconds, down to a quarter."""
    return int(hours * 4) * HOUR // 4


def day_truck(task: Task) -> Data:
    """Return trucks of a working day, twice as many as the load needs."""
    demand = sum(customer["demand"][0] for customer in customers_of(task.customers, task.case))
    truck: Data = {
        "id": "truck", "count": 2 * math.ceil(demand / 400) + 2, "capacity": [400],
        "costs": {"fixed": 50, "per_km": 1, "per_hour": 20}, "speed_kmh": DAY_SPEED_KMH,
        "shift": {"earliest": SHIFT[0] * HOUR, "latest": SHIFT[1] * HOUR}}
    if task.speeds != "fixed":
        truck["speed_profile"] = [
            {"from": hour * HOUR, "speed_kmh": speed} for begin, end in RUSH_HOURS
            for hour, speed in ((begin, RUSH_SPEED_KMH), (end, DAY_SPEED_KMH))]
    if task.drones:
        truck["drones"] = {
            "count": task.drones, "capacity": [10], "speed_kmh": 60, "endurance": HOUR // 2,
            "launch_duration": 60, "recovery_duration": 60, "costs": {"per_km": 0.25}}
    return truck
