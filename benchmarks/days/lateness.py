"""How true chances of being late are, and what fewer broken promises cost.

`python -m benchmarks.days.lateness` draws days of a city, with windows of one or two hours, and
plans them with no price of expected lateness and with several. Each plan is driven by the judge on
days that are drawn otherwise than its chances are: each leg and each service of its own, from a
gamma distribution.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from app.plans.risking import RiskSearch, further
from benchmarks.rows import appended
from model.counsel.lateness.drawn import Spread
from model.counsel.lateness.outlook import expectations
from model.judge.check import check
from model.judge.clock import closing
from model.judge.timing import RouteDecision, read_decision, schedule
from model.planner import ALONE, Listener, Planner, PlanOptions, PlanResult
from model.problem import Customer, Depot, Problem, Travel, VehicleType
from model.solution import Route, Solution
from model.together.pulling import nobody_served

SIDE, METRES_PER_SECOND = 20_000.0, 8.0
"""Of the city, and of its traffic."""

HOUR = 3_600_000
PATIENCE = 600.0
"""Seconds that no search takes: turns are counted, so what else a machine does counts for nothing.
"""

OPENINGS = range(8, 17)
"""Hours at which windows open."""

SPREAD = Spread(travel=0.2, service=0.3)

EDGES = (0.0, 0.05, 0.15, 0.25, 0.5, 1.0)
"""Between chances that are compared with what came."""


@dataclass(frozen=True)
class Risked:
    """A plan of a day, driven."""

    day: str
    price: float  # of an hour of lateness to be expected
    vehicles: int
    cost: float  # by its planned times
    left_out: int
    said: float  # broken promises to be expected
    broken: float  # and how many were, on the mean of all days
    late_h: float
    chances: tuple[float, ...]
    came: tuple[float, ...]  # on which share of days each was late


def city(seed: int, orders: int) -> Problem:
    """Return a day of a city: vans of a depot in its midst cost by km and hour."""
    rng = np.random.default_rng(seed)
    places = np.concatenate([[[SIDE / 2, SIDE / 2]], rng.random((orders, 2)) * SIDE])
    metres = np.linalg.norm(places[:, None] - places, axis=2)
    customers = []
    for number in range(orders):
        opens, hours = int(rng.choice(OPENINGS)) * HOUR, int(rng.integers(1, 3))
        customers.append(Customer(
            str(number), (1,), service_duration=int(rng.integers(120, 420)) * 1000,
            earliest=opens, latest=opens + hours * HOUR))
    van = VehicleType("van", count=orders // 5, capacity=(14,), travel=0, earliest=7 * HOUR,
                      latest=20 * HOUR, fixed_cost=40.0, cost_per_km=0.3, cost_per_hour=18.0)
    travel = Travel(np.rint(1000 * metres / METRES_PER_SECOND).astype(np.int64),
                    np.rint(1000 * metres).astype(np.int64))
    return Problem((Depot("depot"),), tuple(customers), (van,), (travel,), places,
                   unassigned_cost=10_000.0)


def driven(problem: Problem, route: Route, rng: np.random.Generator, spread: Spread) -> Route:
    """Return a route as the judge times it on a day that is drawn."""
    def drawn(shape: tuple[int, ...], share: float) -> np.ndarray:
        return rng.gamma(share ** -2, share ** 2, shape)

    legs = tuple([Travel(np.rint(np.asarray(each.duration) * drawn(
        np.asarray(each.duration).shape, spread.travel)).astype(np.int64), each.distance)
        for each in problem.travel])
    lasting = drawn((problem.num_customers,), spread.service)
    customers = tuple([replace(each, service_duration=round(each.service_duration * factor))
                       for each, factor in zip(problem.customers, lasting, strict=True)])
    day = replace(problem, travel=legs, customers=customers)
    kind = day.vehicle_types[route.vehicle_type]
    trips = [replace(read_decision(trip, kind), start=None if index else trip.stops[0].arrival)
             for index, trip in enumerate(route.trips)]
    return schedule(day, RouteDecision(route.vehicle_type, route.vehicle, tuple(trips)))


def lateness(problem: Problem, plan: Solution, days: int, seed: int) -> dict[int, list[float]]:
    """Return by how many ms each customer of a plan is late on days that are drawn."""
    rng = np.random.default_rng(seed)
    late: dict[int, list[float]] = {}
    for _ in range(days):
        for route in plan.routes:
            day = driven(problem, route, rng, SPREAD)
            for trip, timed in zip(route.trips, day.trips, strict=True):
                for stop, there in zip(trip.customer_stops, timed.customer_stops, strict=True):
                    closes = closing(problem.customer_at(stop.node), stop.service_start)
                    late.setdefault(stop.node, []).append(there.service_start - closes)
    return late


def planned(planner: Planner, problem: Problem, turns: int, price: float) -> PlanResult:
    """Return a plan by a price of an hour of lateness to be expected."""
    began = time.perf_counter()
    options = PlanOptions("any", time_limit=PATIENCE, search_iterations=turns, seed=1)

    def plan(options: PlanOptions, listener: Listener) -> PlanResult:
        return planner.plan(problem, options, began, listener, nobody_served(problem))

    if not price:
        return plan(options, ALONE)
    search = RiskSearch(problem, problem, SPREAD, price, 0, lambda plan: check(problem, plan))
    return search.find(options, ALONE, plan, further(planner, began, None))


def risked(planner: Planner, problem: Problem, name: str, turns: int, price: float,
           days: int) -> Risked:
    """Plan a day, and drive the plan."""
    plan = planned(planner, problem, turns, price).solution
    judged = check(problem, plan)
    if judged.violations:
        raise RuntimeError(f"{name}: {judged.violations}")
    said = {node: each.chance or 0.0 for node, each in expectations(problem, plan, SPREAD)}
    late = lateness(problem, plan, days, 7)
    came = {node: sum(each > 0 for each in late[node]) / days for node in said}
    return Risked(
        name, price, len(plan.routes), judged.cost.total, len(plan.unassigned),
        sum(said.values()), sum(came.values()),
        sum(max(each, 0.0) for times in late.values() for each in times) / days / 3.6e6,
        tuple(said.values()), tuple(came.values()))


def table(rows: Sequence[Risked]) -> Iterator[str]:
    """Yield tables in Markdown: of prices, and of chances."""
    yield ("| price of an hour | cost, % more | vehicles | broken promises | share of those "
           "without a price, % | hours late |\n| ---: | ---: | ---: | ---: | ---: | ---: |")
    free = {row.day: row for row in rows if not row.price}
    for price in dict.fromkeys(row.price for row in rows):
        of = [row for row in rows if row.price == price]
        more = [100 * (row.cost / free[row.day].cost - 1) for row in of]
        broken = sum(row.broken for row in of)
        yield (f"| {price:g} | {np.mean(more):.2f} | {sum(row.vehicles for row in of)} | "
               f"{broken:.1f} | {100 * broken / sum(row.broken for row in free.values()):.0f} | "
               f"{sum(row.late_h for row in of):.2f} |")
    yield "\n| said | customers | said on the mean, % | came, % |\n| --- | ---: | ---: | ---: |"
    said = np.concatenate([row.chances for row in rows])
    came = np.concatenate([row.came for row in rows])
    for low, high in pairwise(EDGES):
        among = (said >= low) & (said < high) if high < 1 else said >= low
        if among.any():
            yield (f"| {100 * low:g} to {100 * high:g} % | {among.sum()} | "
                   f"{100 * said[among].mean():.1f} | {100 * came[among].mean():.1f} |")


def main(
    cities: int = 8, orders: int = 80, turns: int = 150_000, days: int = 60,
    prices: str = "0,50,200,600",
    output: Annotated[Path, typer.Option(help="CSV, made anew.")]
    = Path("runs/bench/lateness.csv"),
) -> None:
    """Print both tables in Markdown."""
    output.unlink(missing_ok=True)
    planner = Planner({"any": None})  # type: ignore[dict-item]
    runs = (risked(planner, city(seed, orders), str(seed), turns, float(price), days)
            for seed in range(cities) for price in prices.split(","))
    print("\n".join(table(list(appended(output, Risked, runs)))))


if __name__ == "__main__":
    typer.run(main)
