"""What resting while drones fly saves: `python -m benchmarks.quality.resting_drivers`.

Draws days of parcels in the country for vans whose drivers keep Regulation (EC) 561/2006, and plans
each with drones and without, by the rules and without them, and with drivers who attend to their
drones. All plans are judged, by a second judge of driving hours as well.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from pydantic_core import to_json

from app.plans.service import preparing, reply_of
from app.plans.task import task_of
from app.requests.bounds import UNBOUNDED
from app.requests.conversion.problem import to_problem
from app.requests.reading import read_request
from app.schemas.limits import DEFAULT_POLICY
from app.serving.settings import Settings
from benchmarks.quality.driving_law import Law, offences
from benchmarks.rows import appended
from model.judge.check import check
from model.planner import Planner, PlanOptions, load_planner
from model.solution import Solution

Request = dict[str, Any]

SIDE_KM, CUSTOMERS, LIGHT = 160.0, 30, 0.7

HOUR = 3600 * 1000

EU = Law(round(4.5 * HOUR), round(0.75 * HOUR), (HOUR // 4, HOUR // 2), 9 * HOUR)

VAN: Request = {
    "id": "van", "count": 6, "capacity": [CUSTOMERS], "speed_kmh": 60,
    "shift": {"earliest": 0, "latest": 14 * 3600},
    "costs": {"fixed": 60, "per_km": 0.4, "per_hour": 35}}

DRONE: Request = {
    "count": 1, "capacity": [1], "speed_kmh": 90, "endurance": 4500, "launch_duration": 60,
    "recovery_duration": 60, "costs": {"per_km": 0.05}}

RULES: Request = {"preset": "eu-561"}

WAYS: dict[str, Request] = {
    "vans": {},
    "vans, rules": {"driving_rules": RULES},
    "drones": {"drones": DRONE},
    "drones, attended": {"drones": DRONE, "driving_rules": RULES | {"while_drones_fly": False}},
    "drones, rules": {"drones": DRONE, "driving_rules": RULES}}
"""How each day is planned: what the vans have besides."""


@dataclass(frozen=True)
class Day:
    """One day planned one way."""

    seed: int
    way: str
    cost: float
    working_h: float
    driving_h: float
    vans: int
    sorties: int
    rests: int
    resting_h: float
    resting_in_flights_h: float
    left_out: int


def draw_day(seed: int) -> Request:
    """Return a request of parcels all around a depot, of which most are light."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-SIDE_KM / 2, SIDE_KM / 2, (CUSTOMERS, 2)).round(2).tolist()
    return {
        "planar_unit": 1000, "depots": [{"id": "depot", "location": [0, 0]}],
        "customers": [
            {"id": f"c{index + 1}", "location": place, "demand": [1], "service_duration": 300,
             "served_by": "either" if rng.random() < LIGHT else "truck"}
            for index, place in enumerate(places)]}


def planned(planner: Planner, seed: int, way: str, options: PlanOptions) -> Day:
    """Plan a day one way, and judge the plan twice."""
    request = draw_day(seed) | {"fleet": [VAN | WAYS[way]]}
    problem = to_problem(read_request(to_json(request), policies=None))
    plan = planner.plan(problem, options).solution
    judged = check(problem, plan)
    against = [offence for route in plan.routes for offence in offences(route, EU)]
    if judged.violations or ("driving_rules" in WAYS[way] and against):
        raise RuntimeError(f"{seed}, {way}: {judged.violations} {against}")
    return Day(seed, way, round(judged.cost.total, 2), *_hours(plan), len(plan.unassigned))


def _hours(plan: Solution) -> tuple[float, float, int, int, int, float, float]:
    """Return what `Day` says of a plan."""
    trips = [trip for route in plan.routes for trip in route.trips]
    rests = [(trip, rest) for trip in trips for rest in trip.breaks]
    driving = sum(there.arrival - here.departure for trip in trips
                  for here, there in zip(trip.stops, trip.stops[1:], strict=False))
    resting = sum(rest.end - rest.start for _, rest in rests)
    inside = sum(rest.end - rest.start for trip, rest in rests if any(
        sortie.launch_time <= rest.start and rest.end <= sortie.recovery_start
        for sortie in trip.sorties))
    working = sum(trip.stops[-1].departure - trip.stops[0].departure for trip in trips)
    return (working / HOUR, (driving - resting) / HOUR, len(plan.routes),
            sum(len(trip.sorties) for trip in trips), len(rests), resting / HOUR, inside / HOUR)


def table(days: Sequence[Day]) -> Iterator[str]:
    """Yield a table in Markdown: means over all days."""
    yield ("| | cost | work, h | at the wheel, h | vans | flights | rests, h | in flights, h |\n"
           "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for way in WAYS:
        mine = [day for day in days if day.way == way]
        means = [float(np.mean([getattr(day, name) for day in mine])) for name in (
            "cost", "working_h", "driving_h", "vans", "sorties", "resting_h",
            "resting_in_flights_h")]
        numbers = (f"{means[0]:.1f}", *(f"{each:.2f}" for each in means[1:]))
        yield f"| {way} | {' | '.join(numbers)} |"


def draw(seed: int, way: str, turns: int, folder: Path) -> None:
    """Write the request and the plan of a day, as `tandem plot` takes them."""
    stated = draw_day(seed) | {"fleet": [VAN | WAYS[way]],
                               "options": {"search_iterations": turns, "time_limit": 600}}
    settings = Settings()
    request = read_request(to_json(stated), settings.policies)
    hurried = preparing(request.options, UNBOUNDED, lambda: False)
    planner = load_planner(settings.weights_dir, settings.policies)
    options = PlanOptions(DEFAULT_POLICY, search_iterations=turns, time_limit=600.0)
    reply = reply_of(planner, task_of(request, hurried), options, time.perf_counter())
    name = f"{seed}-{way.replace(', ', '-')}"
    (folder / f"{name}-request.json").write_bytes(to_json(stated))
    (folder / f"{name}-plan.json").write_bytes(to_json(reply))


def main(
    seeds: int = 10, turns: int = 4000,
    output: Annotated[Path, typer.Option(help="CSV, made anew.")]
    = Path("runs/bench/resting_drivers.csv"),
    pictures: Annotated[int | None, typer.Option(help="Day whose plan by the rules is written "
                                                 "beside it, for `tandem plot`.")] = None,
) -> None:
    """Print the table in Markdown."""
    output.unlink(missing_ok=True)
    planner = load_planner(Settings().weights_dir, [DEFAULT_POLICY])
    options = PlanOptions(DEFAULT_POLICY, search_iterations=turns, time_limit=600.0)
    days = (planned(planner, seed, way, options) for seed in range(1, seeds + 1) for way in WAYS)
    rows = list(appended(output, Day, days))
    print("\n".join(table(rows)))
    if pictures is not None:
        for way in ("drones, attended", "drones, rules"):
            draw(pictures, way, turns, output.parent)


if __name__ == "__main__":
    typer.run(main)
