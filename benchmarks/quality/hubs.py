"""A day of drones from three hubs: `python -m benchmarks.quality.hubs`.

Draws orders around three hubs from which drones fly by themselves, with areas that they may not fly
through and batteries that are swapped between trips, and plans them within several times, by one
thread and the service's policy, or beside OR-Tools. Each plan is judged.
"""

import json
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.requests.conversion.problem import to_problem
from app.schemas.limits import DEFAULT_POLICY
from app.schemas.request import PlanRequest
from app.serving.settings import Settings
from benchmarks.clock import count_processor_time
from benchmarks.quality.hubs_by_ortools import plan_by_ortools
from model.judge.check import check
from model.planner import PlanOptions, load_planner
from model.problem import FloatArray

Request = dict[str, Any]

HUBS = np.array([[-6.0, -4.0], [6.5, -3.0], [0.5, 6.0]])
"""Where drones start, in km."""

SPREAD_KM = 2.6
"""How far orders lie from a hub, as a standard deviation on each axis."""

DAY = 12 * 3600
"""Seconds in which orders come in; each is due `DUE` seconds after it has."""

DUE = 3600

QUAD: Request = {
    "flies": True, "capacity": [2.5], "max_trips": 40, "speed_kmh": 65, "launch_duration": 45,
    "recovery_duration": 45, "endurance": 2100, "costs": {"fixed": 6, "per_km": 0.2},
    "energy": {"battery_wh": 400, "power": {"cruise_w": 650, "cruise_w_per_kg": 150},
               "climb": {"up_seconds": 12, "up_w": 900, "down_seconds": 12, "down_w": 500}},
    "turnaround": {"swap_duration": 120}}


def draw_day(orders: int, drones: int, seed: int) -> Request:
    """Return a request of orders from one to two kilograms, some of whom stand near the hubs."""
    rng = np.random.default_rng(seed)
    areas = [_area(rng, HUBS[index % len(HUBS)]) for index in range(6)]
    customers: list[dict[str, Any]] = []
    while len(customers) < orders:
        place = HUBS[int(rng.integers(len(HUBS)))] + rng.normal(0.0, SPREAD_KM, 2)
        if any(_is_inside(place, area) for area in areas):
            continue
        came_in = float(rng.integers(0, DAY))
        customers.append({
            "id": f"order-{len(customers) + 1}", "location": place.round(3).tolist(),
            "demand": [float(rng.choice((0.3, 0.5, 1.0, 1.5, 2.0), p=(0.3, 0.3, 0.2, 0.1, 0.1)))],
            "service_duration": 60, "release_time": came_in,
            "time_window": {"latest": came_in + DUE}})
    share = [drones // 3 + (index < drones % 3) for index in range(3)]
    return {
        "planar_unit": 1000,
        "depots": [{"id": f"hub-{index}", "location": hub.tolist()}
                   for index, hub in enumerate(HUBS)],
        "customers": customers, "airspace": {"no_fly": [area.round(3).tolist() for area in areas]},
        "fleet": [{"id": f"quad-{index}", "depot": f"hub-{index}", "count": count, **QUAD}
                  for index, count in enumerate(share)]}


def _area(rng: np.random.Generator, hub: FloatArray) -> FloatArray:
    """Return a square that is some way from a hub."""
    angle, turn = rng.uniform(0.0, 2.0 * np.pi, 2)
    middle = hub + rng.uniform(1.8, 3.5) * np.array([np.cos(angle), np.sin(angle)])
    corners = turn + np.arange(4) * np.pi / 2.0
    return middle + rng.uniform(0.4, 1.0) * np.stack([np.cos(corners), np.sin(corners)], axis=1)


def _is_inside(place: FloatArray, square: FloatArray) -> bool:
    """Tell whether a place is in a square, or hardly out of it."""
    middle = square.mean(axis=0)
    return bool(np.linalg.norm(place - middle) < np.linalg.norm(square[0] - middle) + 0.05)


def main(
    seconds: Annotated[list[float] | None, typer.Option(help="Times to plan in.")] = None,
    orders: Annotated[int, typer.Option(help="Orders.")] = 1000,
    drones: Annotated[int, typer.Option(help="Drones, of three hubs.")] = 100,
    seed: Annotated[int, typer.Option(help="Of what is drawn.")] = 1,
    by_ortools: Annotated[bool, typer.Option(
        help="Without energies, beside OR-Tools in the first time.")] = False,
) -> None:
    """Plan a day within several times, of the processor."""
    count_processor_time()
    day = draw_day(orders, drones, seed)
    if by_ortools:
        for kind in day["fleet"]:
            del kind["energy"], kind["endurance"]
    problem = to_problem(PlanRequest.model_validate_json(json.dumps(day)))
    planner = load_planner(Settings().weights_dir, (DEFAULT_POLICY,))
    table = Table("seconds", "left out", "drones", "trips", "turns", "cost", "gap %")
    costs: list[float] = []
    rows = []
    for limit in seconds or [10.0, 600.0]:
        found = planner.plan(problem, PlanOptions(DEFAULT_POLICY, time_limit=limit))
        evaluation = check(problem, found.solution)
        if evaluation.violations:
            raise ValueError(f"plan: {evaluation.violations[0]} is not allowed")
        costs.append(evaluation.cost.total)
        rows.append((f"{limit:g}", f"{len(found.solution.unassigned)}",
                     f"{len(found.solution.routes)}",
                     f"{sum(len(route.trips) for route in found.solution.routes)}",
                     f"{found.search_iterations}", f"{costs[-1]:.2f}"))
    if by_ortools:
        plan = plan_by_ortools(problem, (seconds or [10.0])[0])
        evaluation = check(problem, plan)
        costs.append(evaluation.cost.total)
        rows.append(("OR-Tools", f"{len(plan.unassigned)}", f"{len(plan.routes)}",
                     f"{sum(len(route.trips) for route in plan.routes)}",
                     "" if evaluation.is_feasible else evaluation.violations[0].message,
                     f"{costs[-1]:.2f}"))
    for row, cost in zip(rows, costs, strict=True):
        table.add_row(*row, f"{(cost / min(costs) - 1) * 100:.2f}")
    Console().print(table)


if __name__ == "__main__":
    typer.run(main)
