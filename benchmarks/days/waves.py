"""Days of the EURO meets NeurIPS competition of 2022, as drawn, and the rules of their waves.

Each epoch orders appear; some leave at its end by routes that are final, the others wait. Routes
are judged here by the competition's rules alone, so that whatever decides can't be wrong about
them.
"""

import csv
import gzip
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from vrplib.parse import parse_vrplib  # type: ignore[import-untyped]

from model.problem import IntArray

EPOCH = 3600  # seconds; routes leave so long after their epoch begins
DRAWN = 100  # orders an epoch, of which those are dropped that can't be served


@dataclass(frozen=True)
class Request:
    """An order, which appears in an epoch."""

    number: int
    epoch: int
    node: int
    earliest: int
    latest: int
    service: int
    demand: int


@dataclass(frozen=True, eq=False)
class Day:
    """An instance; node 0 is the depot."""

    name: str
    legs: IntArray  # (node, node) seconds
    demand: IntArray  # (node,)
    service: IntArray  # (node,)
    window: IntArray  # (node, 2)
    capacity: int
    requests: tuple[Request, ...]

    @property
    def num_customers(self) -> int:
        """Places that orders are drawn from."""
        return len(self.legs) - 1

    @cached_property
    def epochs(self) -> range:
        """All epochs."""
        opens = self.window[1:, 0]
        first, last = (max((int(each) - EPOCH) // EPOCH, 0) for each in (opens.min(), opens.max()))
        return range(first, last + 1)

    def departure(self, epoch: int) -> int:
        """Return when routes leave that are dispatched in an epoch."""
        return EPOCH * (epoch + 1)

    def may_leave(self, epoch: int, node: int, window: Sequence[int], service: int) -> bool:
        """Tell whether an order can be served alone that leaves in an epoch."""
        arrival = max(self.departure(epoch) + int(self.legs[0, node]), window[0])
        back = arrival + service + int(self.legs[node, 0])
        return arrival <= window[1] and back <= int(self.window[0, 1])

    def must_leave(self, epoch: int, request: Request) -> bool:
        """Tell whether an order can't wait."""
        window = request.earliest, request.latest
        return epoch == self.epochs[-1] or not self.may_leave(
            epoch + 1, request.node, window, request.service)

    def drawn(self, epoch: int, rng: np.random.Generator) -> list[Request]:
        """Return orders of an epoch as they may come, which is how those of the day came."""
        count = self.num_customers
        node, window, demand, service = (
            (rng.integers(count, size=DRAWN) + 1).tolist() for _ in range(4))
        found = [Request(0, epoch, node[k], int(self.window[window[k], 0]),
                         int(self.window[window[k], 1]), int(self.service[service[k]]),
                         int(self.demand[demand[k]])) for k in range(DRAWN)]
        return [each for each in found if self.may_leave(
            epoch, each.node, (each.earliest, each.latest), each.service)]


Routes = Sequence[Sequence[Request]]
"""In the order in which they are served."""

Deciding = Callable[[Day, int, Sequence[Request]], Routes]
"""Chooses the routes that leave in an epoch, of the orders that are open."""


def replay(day: Day, decide: Deciding) -> int:
    """Return what a day costs: how long its routes drive.

    Raises
    ------
    ValueError
        If routes break a rule, or an order that must go is left.
    """
    cost, waiting = 0, list[Request]()
    for epoch in day.epochs:
        waiting += [each for each in day.requests if each.epoch == epoch]
        routes = decide(day, epoch, waiting)
        cost += sum(cost_of(day, epoch, route) for route in routes)
        gone = [each.number for route in routes for each in route]
        if len(set(gone)) < len(gone) or not {each.number for each in waiting}.issuperset(gone):
            raise ValueError(f"{day.name}, epoch {epoch}: orders {gone} aren't open, or go twice")
        waiting = [each for each in waiting if each.number not in gone]
        left = [each.number for each in waiting if day.must_leave(epoch, each)]
        if left:
            raise ValueError(f"{day.name}, epoch {epoch}: orders {left} must go")
    return cost


def cost_of(day: Day, epoch: int, route: Sequence[Request]) -> int:
    """Return how long a route drives; raises `ValueError` if it breaks a rule."""
    name = f"{day.name}, epoch {epoch}, route {[each.number for each in route]}"
    if sum(each.demand for each in route) > day.capacity:
        raise ValueError(f"{name}: too much aboard")
    at, now, driven = 0, day.departure(epoch), 0
    for each in route:
        leg = int(day.legs[at, each.node])
        at, now, driven = each.node, max(now + leg, each.earliest), driven + leg
        if now > each.latest:
            raise ValueError(f"{name}: order {each.number} at {now}, after {each.latest}")
        now += each.service
    home = int(day.legs[at, 0])
    if now + home > day.window[0, 1]:
        raise ValueError(f"{name}: back at {now + home}, after {day.window[0, 1]}")
    return driven + home


def read_day(folder: Path, name: str) -> Day:
    """Return an instance of a folder with the orders that were drawn for it."""
    with gzip.open(folder / f"{name}.txt.gz", "rt", encoding="utf-8") as file:
        stated = parse_vrplib(file.read())
    with (folder / "requests" / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        rows = [{column: int(value) for column, value in row.items()}
                for row in csv.DictReader(file)]
    requests = tuple([Request(row["request"], row["epoch"], row["customer"], row["tw_early"],
                              row["tw_late"], row["service"], row["demand"]) for row in rows])
    legs, demand, service, window = (np.asarray(stated[key], np.int64) for key in (
        "edge_weight", "demand", "service_time", "time_window"))
    return Day(name, legs, demand, service, window, int(stated["capacity"]), requests)


def published(folder: Path) -> dict[str, dict[str, str]]:
    """Return the table of published costs, by instance."""
    with (folder / "best_known.csv").open(encoding="utf-8", newline="") as file:
        return {row["instance"]: row for row in csv.DictReader(file)}
