"""The plan that the paper prints (its Table 2), read, measured and judged.

`printed/` holds the paper's Tables 2 to 5 as printed, with what was recomputed from them: columns
not called `printed` are no words of the paper.
"""

import csv
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from benchmarks.study.cases import example
from model.judge.check import check
from model.judge.rules import Violation
from model.judge.timing import RouteDecision, SortieDecision, TripDecision, schedule
from model.problem import Problem
from model.solution import Solution

FOLDER = Path(__file__).parent / "printed"

DEPOT = "100"
CAPACITY = 400.0

Flight = tuple[str, str, str]
"""Launch, customer, recovery."""


@dataclass(frozen=True)
class Group:
    """A truck of the paper and its drone, as printed."""

    number: int
    path: tuple[str, ...]  # of the truck, depot to depot
    flights: tuple[Flight, ...]
    truck_demand: float
    drone_demand: float
    load_rate: float

    @property
    def stated(self) -> tuple[SortieDecision, ...]:
        """The flights that begin and end at stops of this truck, in that order."""
        return tuple(flight for flight in map(self._stated, self.flights) if flight is not None)

    def _stated(self, flight: Flight) -> SortieDecision | None:
        launch, customer, recovery = flight
        ends = [(first, last) for first, stop in enumerate(self.path) if stop == launch
                for last, other in enumerate(self.path) if other == recovery and first <= last]
        if not ends:
            return None
        first, last = min(ends, key=lambda pair: pair[1] - pair[0])
        return SortieDecision((_node(customer),), first, last)


@dataclass(frozen=True)
class GroupRow:
    """What a printed group says, and what is so."""

    group: int
    customers: int  # different ones, by truck or drone
    truck_length: float
    flights: int
    flights_of_own_stops: int
    drone_length: float
    printed_demand: float  # of truck and drone
    demand: float  # of the different customers
    printed_load_rate: float
    load_rate: float


def printed_rows(table: int) -> list[Mapping[str, str]]:
    """Return the rows of a printed table."""
    with (FOLDER / f"table{table}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def groups() -> list[Group]:
    """Return Table 2."""
    rows = printed_rows(2)
    return [_group(truck, drone) for truck, drone in zip(rows[::2], rows[1::2], strict=True)]


def _group(truck: Mapping[str, str], drone: Mapping[str, str]) -> Group:
    flights = [tuple(part.split(">")) for part in drone["printed_path"].split("; ")]
    return Group(
        int(truck["group"]), tuple(truck["printed_path"].split(">")),
        tuple((launch, customer, recovery) for launch, customer, recovery in flights),
        float(truck["printed_total_demand"]), float(drone["printed_total_demand"]),
        float(truck["printed_loading_rate"].rstrip("%")) / 100)


def measured(group: Group) -> GroupRow:
    """Return what a group says, and what is so by Table 1."""
    places, demands = _table1()
    customers = {*group.path, *(customer for _, customer, _ in group.flights)} - {DEPOT}
    demand = sum(demands[name] for name in customers)
    return GroupRow(
        group.number, len(customers), _length(places, group.path), len(group.flights),
        len(group.stated), sum(_length(places, flight) for flight in group.flights),
        group.truck_demand + group.drone_demand, demand, group.load_rate, demand / CAPACITY)


def _table1() -> tuple[dict[str, tuple[float, float]], dict[str, float]]:
    """Return places and demands by id."""
    data = example("table1")
    places = {entry["id"]: tuple(entry["location"])
              for entry in [*data["depots"], *data["customers"]]}
    return places, {customer["id"]: customer["demand"][0] for customer in data["customers"]}


def _length(places: Mapping[str, tuple[float, float]], path: Sequence[str]) -> float:
    return sum(math.dist(places[here], places[there])
               for here, there in pairwise(path))


def visits(plan: Sequence[Group]) -> Counter[str]:
    """Return how often each customer is visited, by truck or drone."""
    counted = Counter({customer["id"]: 0 for customer in example("table1")["customers"]})
    for group in plan:
        counted.update(group.path[1:-1])
        counted.update(customer for _, customer, _ in group.flights)
    return counted


def as_plan(problem: Problem, plan: Sequence[Group]) -> Solution:
    """Return as much of the printed plan as can be stated: flights between stops of one truck."""
    return Solution(tuple(
        schedule(problem, RouteDecision(0, vehicle, (
            TripDecision(tuple(map(_node, group.path)), group.stated),)))
        for vehicle, group in enumerate(plan)))


def _node(name: str) -> int:
    """Return the node of one of Table 1's ids: depot 100 is node 0."""
    return 0 if name == DEPOT else int(name) + 1


def broken_rules(problem: Problem, plan: Sequence[Group]) -> tuple[Violation, ...]:
    """Return what the checker says of the printed plan."""
    return check(problem, as_plan(problem, plan)).violations
