"""Trips of vehicles that fly by themselves, packed on as few of them as their times let."""

import math
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from model.problem import MS_PER_HOUR, UNLIMITED, Problem, VehicleType, shares_chargers
from model.search.beginning.charging import TurnRow, packed_in_turn
from model.search.beginning.leg import Timing, TripLeg
from model.search.beginning.stock import batteries_left
from model.search.beginning.translate import (
    best_plan, left_out, make_searcher, read_routes,
)
from model.search.neighbourhood.numbering import Numbering
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Route, Solution, Stop, Trip, renumbered

BUSY = 0.6
"""Share of its day that a vehicle spends on trips, where they are well packed."""

BY_TRIP_FROM = 30
"""Number of customers from which on trips of who flies are found before they are packed."""

ORDERS = 16
"""In how many orders trips are packed that the search goes on from."""

SHAKEN = 0.6
"""By which share of it a trip's leeway may seem more or less."""

SOONER = 0.3
"""What putting off the trips behind counts, by what waiting does."""


def packed_routes(problem: Problem, k: int, trips: Sequence[Sequence[int]],
                  nodes: Sequence[int] | None = None, beside: Sequence[Route] = (),
                  orders: int = 1) -> list[Route]:
    """Return trips of a type, each given by its customers, on vehicles one after another.

    Those with the least leeway come first, each where its vehicle waits least before and behind; on
    another vehicle where it fits between no trips. What no vehicle can fly is left out, or for what
    routes `beside` leave no batteries, fewest customers first. Of several `orders` the best counts.
    Routes have no times yet, but when trips begin where places to charge are shared. `nodes` are
    the problem's, by the numbers that trips have.
    """
    kind = problem.vehicle_types[k]
    batteries = min([batteries_left(problem, beside, node)
                     for node in (kind.begins_at, kind.depot)])
    if kind.takes_batteries and len(trips) > batteries:
        trips = sorted(trips, key=len, reverse=True)[:batteries]
    timing = Timing(problem, kind, nodes or range(problem.num_nodes))
    legs = [leg for leg in map(timing.leg, trips) if leg is not None]
    if shares_chargers(problem, kind):
        return _charged_in_turn(problem, k, legs, beside, orders)
    rows = _best_packed(kind, legs, orders)
    return [Route(k, number, tuple([_trip(kind, leg.trip) for leg in row.legs]))
            for number, row in enumerate(rows)]


def _charged_in_turn(problem: Problem, k: int, legs: Sequence[TripLeg], beside: Sequence[Route],
                     orders: int) -> list[Route]:
    """Return trips of a type whose vehicles share places to charge; they begin when that says."""
    kind = problem.vehicle_types[k]
    chargers = problem.depots[kind.depot].chargers
    taken = [charge for route in beside for trip in route.trips
             if trip.stops[0].node == kind.depot for charge in trip.charges]
    packed = [packed_in_turn(kind, order, UNLIMITED if chargers is None else chargers, taken)
              for order in _orders(legs, orders, lambda leg: leg.latest)]
    rows = min(packed, key=lambda rows: (-_num_trips(rows), len(rows)))
    return [Route(k, number, tuple([
        replace(_trip(kind, leg.trip, start), charges=charges)
        for leg, start, charges in zip(row.legs, row.starts, row.charges, strict=True)]))
        for number, row in enumerate(rows)]


def comes_by_trips(problem: Problem) -> bool:
    """Tell whether a search begins with the trips of vehicles that fly, as if each had its own.

    It does where they may make several, and where no truck has drones. Where it costs how much
    work a vehicle has, that has to be known; and how long who flies may work, where others drive
    to whomever there is no time for.
    """
    kinds = problem.vehicle_types
    flown = [kind for kind in kinds if kind.flies]
    is_limited = any(kind.max_working_duration is not None for kind in flown)
    return (problem.num_customers >= BY_TRIP_FROM and not problem.keeps_together
            and not problem.lags_across and not problem.fairness.is_stated
            and any(kind.max_trips > 1 for kind in flown)
            and all(kind.drones is None for kind in kinds)
            and not (is_limited and len(flown) < len(kinds)))


def with_single_trips(problem: Problem) -> Problem:
    """Return a problem in which each trip of who flies is a vehicle's own.

    What a vehicle costs is shared by the time that it flies, so that fewer fly at once.
    """
    return replace(problem, vehicle_types=tuple([
        replace(kind, max_trips=1, fixed_cost=0.0, numbers=(),
                cost_per_hour=kind.cost_per_hour + _hourly(problem, kind),
                count=min(problem.num_customers, kind.count * kind.max_trips))
        if kind.flies and kind.max_trips > 1 else kind for kind in problem.vehicle_types]))


def packed_in_fewer(problem: Problem, k: int, routes: Sequence[Route],
                    nodes: Sequence[int]) -> list[Route]:
    """Return routes with the trips of a type on one vehicle fewer, and what that leaves out.

    They have no times yet. `nodes` are the problem's, by the numbers that routes have.
    """
    others = [route for route in routes if route.vehicle_type != k]
    kinds = list(problem.vehicle_types)
    kinds[k] = replace(kinds[k], count=len(routes) - len(others) - 1, numbers=())
    fewer = replace(problem, vehicle_types=tuple(kinds))
    return others + packed_routes(fewer, k, _customers(routes, k), nodes, others)


def _customers(routes: Sequence[Route], k: int) -> list[list[int]]:
    """Return the customers of each trip of a type."""
    return [[stop.node for stop in trip.stops[1:-1]]
            for route in routes if route.vehicle_type == k for trip in route.trips]


def _hourly(problem: Problem, kind: VehicleType) -> float:
    """Return what an hour in the air costs of a vehicle; nothing where days have no end."""
    over = min(kind.latest, max([customer.latest for customer in problem.customers]))
    if over >= UNLIMITED or over <= kind.earliest:
        return 0.0
    return kind.fixed_cost / BUSY / (over - kind.earliest) * MS_PER_HOUR


def packed_plan(problem: Problem, single: Solution) -> Solution:
    """Return a plan of trips that were vehicles' own, packed; whom that leaves out is in no list.

    Routes of others stay. They have no times yet.
    """
    kinds = problem.vehicle_types
    packed = {k for k, kind in enumerate(kinds) if kind.flies and kind.max_trips > 1}
    routes = [route for route in single.routes if route.vehicle_type not in packed]
    for k in sorted(packed):
        trips = _customers(single.routes, k)
        routes += packed_routes(problem, k, trips, None, routes, ORDERS)
    return Solution(tuple(routes), single.unassigned)


def timed(problem: Problem, data: ProblemData, numbering: Numbering, plan: Solution) -> Solution:
    """Return a plan without times, as `packed_plan` does, with them; what can't be is left out."""
    made = make_searcher(problem, data, renumbered(plan, numbering.number.tolist().__getitem__),
                         np.random.SeedSequence(0))
    return best_plan(data, made, numbering.node.tolist())


def packed_anew(problem: Problem, data: ProblemData, searcher: Searcher,
                nodes: Sequence[int]) -> Searcher:
    """Return a search's best plan with the trips of who flies packed anew, if that costs less.

    Else the search as it is. `nodes` are the problem's by the search's numbers.
    """
    packed = {k for k, kind in enumerate(problem.vehicle_types)
              if kind.flies and kind.max_trips > 1}
    if not packed or problem.keeps_together or problem.lags_across:
        return searcher
    made = list(read_routes(data, searcher))
    routes = [route for route in made if route.vehicle_type not in packed]
    for k in sorted(packed):
        routes += packed_routes(problem, k, _customers(made, k), nodes, routes)
    found = make_searcher(problem, data, Solution(tuple(routes), left_out(data, searcher)),
                          np.random.SeedSequence(0))
    return found if found.value.best < searcher.value.best else searcher


@dataclass
class _Row:
    """Trips of one vehicle in their order."""

    earliest: int
    legs: list[TripLeg] = field(default_factory=list)
    free: list[int] = field(default_factory=list)  # when it may begin another after each
    latest: list[int] = field(default_factory=list)  # start of each by which all behind are in time

    def best_place(self, leg: TripLeg) -> tuple[float, int]:
        """Return what the best place for a trip costs in time, and that place; infinite if none."""
        best = math.inf, 0
        for place in range(bisect_left(self.latest, leg.ready + leg.busy), len(self.legs) + 1):
            free = self.free[place - 1] if place else self.earliest
            start = leg.soonest(free)
            if start > leg.latest:
                break
            end, cost = start + leg.busy, float(start - free if place else 0)
            if place < len(self.legs):
                if end > self.latest[place]:
                    continue
                behind = self.legs[place]
                cost += behind.soonest(end) - end
                cost += SOONER * max(0, end - (self.free[place] - behind.busy))
            best = min(best, (cost, place))
        return best

    def put(self, place: int, leg: TripLeg) -> None:
        """Put a trip at a place. In place."""
        self.legs.insert(place, leg)
        self.free.insert(place, 0)
        self.latest.insert(place, 0)
        for index in range(place, len(self.legs)):
            free = self.free[index - 1] if index else self.earliest
            self.free[index] = self.legs[index].soonest(free) + self.legs[index].busy
        bound = UNLIMITED
        for index in range(len(self.legs) - 1, -1, -1):
            self.latest[index] = self.legs[index].last(bound)
            bound = self.latest[index] - (self.legs[index - 1].busy if index else 0)


def _packed(kind: VehicleType, legs: Sequence[TripLeg]) -> list[_Row]:
    """Return trips on vehicles, put there in an order."""
    rows: list[_Row] = []
    for leg in legs:
        able = [row for row in rows if len(row.legs) < kind.max_trips]
        (cost, place), row = min([(row.best_place(leg), row) for row in able],
                                 key=lambda found: found[0][0], default=((math.inf, 0), None))
        if row is None or cost == math.inf:
            if len(rows) == kind.count:
                continue
            row = _Row(kind.earliest)
            rows.append(row)
        row.put(place, leg)
    return rows


def _best_packed(kind: VehicleType, legs: Sequence[TripLeg], orders: int) -> list[_Row]:
    """Return as many trips as there is room for, on as few vehicles, of several orders."""
    packed = [_packed(kind, order) for order in _orders(legs, orders, lambda leg: leg.leeway)]
    return min(packed, key=lambda rows: (-_num_trips(rows), len(rows)))


def _orders(legs: Sequence[TripLeg], number: int,
            first: Callable[[TripLeg], int]) -> Iterator[list[TripLeg]]:
    """Yield trips in several orders: in the first by what is said, then by chance and leeway."""
    rng = np.random.default_rng(0)
    yield sorted(legs, key=first)
    for _ in range(number - 1):
        share = rng.uniform(1.0 - SHAKEN, 1.0 + SHAKEN, len(legs)).tolist()
        order = sorted(range(len(legs)), key=lambda index: legs[index].slack * share[index])
        yield [legs[index] for index in order]


def _num_trips(rows: Sequence[_Row] | Sequence[TurnRow]) -> int:
    return sum(len(row.legs) for row in rows)


def _trip(kind: VehicleType, customers: Sequence[int], start: int = 0) -> Trip:
    return Trip(tuple([Stop(node, start, start, start) for node in (
        kind.begins_at, *customers, kind.ends_at)]))
