"""When vehicles that fly are charged at depots that have only so many places for that.

A plan may state it: between any two trips a vehicle is charged in one or several pieces. Where it
doesn't, or what it states doesn't hold, places are given out anew: one who lacks something for the
trips to come is charged once before its next trip, in one piece, and a place that is free goes to
who is there and takes off next. That finds no plan for some for which there would be one.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from heapq import heapify, heappop, heappush
from itertools import chain
from typing import NamedTuple

from model.judge.energy import Rest, charge_after
from model.judge.flown_trips import trip_energy
from model.problem import (
    UNLIMITED, Energy, Problem, VehicleType, limits_chargers, shares_chargers,
)
from model.solution import Charge, Route, Solution, Trip


class Lack(NamedTuple):
    """What is wrong with how a vehicle is charged before a trip."""

    route: int
    trip: int
    message: str


@dataclass
class _Gap:
    """The time before a trip of a vehicle, in which it may be charged."""

    route: int
    trip: int
    node: int
    begin: int  # when the vehicle is there
    end: int  # when the trip begins
    needed: int  # by the trip, of the battery
    wanted: int  # then, for all trips behind to be flown as they are timed

    @property
    def place(self) -> tuple[int, int]:
        """Which trip of which route it is before."""
        return self.route, self.trip


def levels(problem: Problem, kind: VehicleType, trips: Sequence[Trip]) -> list[int]:
    """Return what there is of a battery as each trip begins, by when it is charged."""
    energy, found = _energy(kind), list[int]()
    left = _full(kind, energy)
    for trip in trips:
        found.append(_charged(energy, left, trip.charges))
        left = found[-1] - (trip_energy(problem, kind, trip) or 0)
    return found


def level_after(problem: Problem, kind: VehicleType, trips: Sequence[Trip],
                 more: Sequence[Charge] = ()) -> int:
    """Return what there is of a battery behind some trips, and charges behind them."""
    energy = _energy(kind)
    left = _full(kind, energy)
    if trips:
        left = levels(problem, kind, trips)[-1] - (trip_energy(problem, kind, trips[-1]) or 0)
    return _charged(energy, left, more)


def with_charging(problem: Problem, solution: Solution) -> Solution:
    """Return a plan that states when vehicles are charged, if it doesn't in a way that holds."""
    if not limits_chargers(problem) or lack_of(problem, solution) is None:
        return solution
    given = _given_out(problem, solution)
    return solution if lack_of(problem, given) is not None else given


def charging_lack(problem: Problem, solution: Solution) -> Lack | None:
    """Return what vehicles lack for want of places to charge; None if nothing, somehow."""
    if not limits_chargers(problem):
        return None
    stated = lack_of(problem, solution)
    if stated is None:
        return None
    given = lack_of(problem, _given_out(problem, solution))
    is_stated = any(trip.charges for route in solution.routes for trip in route.trips)
    return given and (stated if is_stated else given)


def lack_of(problem: Problem, solution: Solution) -> Lack | None:
    """Return what is wrong first with how a plan states that vehicles are charged."""
    used = defaultdict[int, list[tuple[int, int, int, int]]](list)
    for index, route, kind in _sharing(problem, solution):
        gaps = _gaps(problem, index, route)
        for gap, trip, level in zip(gaps, route.trips, levels(problem, kind, route.trips),
                                    strict=True):
            bounds = [gap.begin, *chain.from_iterable(trip.charges), gap.end]
            if bounds != sorted(bounds) and trip.charges:
                return Lack(*gap.place, "is charged while it isn't there")
            if gap.needed > level:
                return Lack(*gap.place, "isn't charged enough for it")
            used[gap.node] += [(charge.start, charge.end, *gap.place) for charge in trip.charges]
    for node, charges in used.items():
        lack = _crowded(problem, node, sorted(charges))
        if lack is not None:
            return lack
    return None


def most_charged(problem: Problem, solution: Solution, node: int) -> int:
    """Return how many vehicles are charged at a depot at once, at most, by what a plan states."""
    charges = sorted((charge.start, charge.end) for _, route, _ in _sharing(problem, solution)
                     for trip in route.trips if trip.stops[0].node == node
                     for charge in trip.charges)
    return max(_at_once(charges), default=0)


def _at_once(charges: Iterable[tuple[int, int]]) -> Iterator[int]:
    """Yield how many vehicles are charged as each begins to be, from when to when in order."""
    ends = list[int]()
    for start, end in charges:
        while ends and ends[0] <= start:
            heappop(ends)
        heappush(ends, end)
        yield len(ends)


def _sharing(problem: Problem, solution: Solution) -> Iterator[tuple[int, Route, VehicleType]]:
    """Yield the routes, with their index and type, whose vehicles share places to charge.

    Those that can't be read are left out.
    """
    depots, nodes = range(problem.num_depots), range(problem.num_depots, problem.num_nodes)
    for index, route in enumerate(solution.routes):
        if not 0 <= route.vehicle_type < len(problem.vehicle_types) or not route.trips:
            continue
        kind = problem.vehicle_types[route.vehicle_type]
        if shares_chargers(problem, kind) and all(
                len(trip.stops) > 1 and trip.stops[0].node in depots
                and trip.stops[-1].node in depots
                and all(stop.node in nodes for stop in trip.stops[1:-1]) for trip in route.trips):
            yield index, route, kind


def _crowded(problem: Problem, node: int,
             charges: Sequence[tuple[int, int, int, int]]) -> Lack | None:
    depot = problem.depots[node]
    counts = _at_once([(start, end) for start, end, _, _ in charges])
    for count, (_, _, route, trip) in zip(counts, charges, strict=True):
        if depot.chargers is not None and count > depot.chargers:
            return Lack(route, trip, f"{count} vehicles are charged at once at {depot.id}, "
                        f"which has places for {depot.chargers}")
    return None


def _energy(kind: VehicleType) -> Energy:
    if kind.energy is None:
        raise ValueError(f"vehicle type {kind.id} energy: None is not allowed")
    return kind.energy


def _full(kind: VehicleType, energy: Energy) -> int:
    return kind.charge_left[0] if kind.charge_left else energy.available


def _charged(energy: Energy, left: int, charges: Sequence[Charge]) -> int:
    for charge in charges:
        left = charge_after(energy, Rest(left, charge.start), charge.end)
    return left


def _gaps(problem: Problem, index: int, route: Route) -> list[_Gap]:
    """Return the time before each trip of a route whose vehicle is charged."""
    kind = problem.vehicle_types[route.vehicle_type]
    energy, gaps, begin = _energy(kind), list[_Gap](), kind.earliest
    for number, trip in enumerate(route.trips):
        taken = trip_energy(problem, kind, trip) or 0
        gaps.append(_Gap(index, number, trip.stops[0].node, begin, trip.stops[0].arrival,
                         taken, taken))
        begin = trip.stops[-1].departure
    for gap, behind in zip(reversed(gaps[:-1]), reversed(gaps[1:]), strict=True):
        gained = energy.charge * (behind.end - behind.begin)
        gap.wanted = min(energy.available, gap.needed + max(0, behind.wanted - gained))
    return gaps


def _given_out(problem: Problem, solution: Solution) -> Solution:
    """Return a plan with places to charge given out anew, as far as there are."""
    sharing = {index: route for index, route, _ in _sharing(problem, solution)}
    gaps = [gap for index, route in sharing.items() for gap in _gaps(problem, index, route)]
    charges = _Places(problem, solution, gaps).give_out()
    return replace(solution, routes=tuple([
        replace(route, trips=tuple([replace(trip, charges=charges.get((index, number), ()))
                                    for number, trip in enumerate(route.trips)]))
        if index in sharing else route for index, route in enumerate(solution.routes)]))


class _Places:
    """Places to charge, given out as time goes on."""

    def __init__(self, problem: Problem, solution: Solution, gaps: Sequence[_Gap]) -> None:
        self._problem = problem
        self._gaps = sorted(gaps, key=lambda gap: (gap.begin, gap.end, gap.place))
        self._kinds = {gap.route: problem.vehicle_types[solution.routes[gap.route].vehicle_type]
                       for gap in gaps}
        self._left = {gap.route: _full(self._kinds[gap.route], _energy(self._kinds[gap.route]))
                      for gap in gaps}  # behind the last trip before
        self._busy = defaultdict[int, list[int]](list)  # until when, by depot
        self._waiting = defaultdict[int, list[tuple[int, tuple[int, int], _Gap]]](list)
        self._charges = dict[tuple[int, int], tuple[Charge, ...]]()

    def give_out(self) -> dict[tuple[int, int], tuple[Charge, ...]]:
        """Return when vehicles are charged before trips, by route and trip."""
        times, coming = [time for gap in self._gaps for time in (gap.begin, gap.end)], 0
        heapify(times)
        while times:
            time = heappop(times)
            for waiting in self._waiting.values():
                while waiting and waiting[0][0] <= time:
                    self._fly(heappop(waiting)[2])
            while coming < len(self._gaps) and self._gaps[coming].begin <= time:
                gap = self._gaps[coming]
                coming += 1
                if gap.end <= time or self._missing(gap) <= 0:
                    self._fly(gap)
                else:
                    heappush(self._waiting[gap.node], (gap.end, gap.place, gap))
            for node, waiting in self._waiting.items():
                self._serve(node, waiting, time, times)
        return self._charges

    def _missing(self, gap: _Gap) -> int:
        return gap.wanted - self._left[gap.route]

    def _fly(self, gap: _Gap) -> None:
        """Let a vehicle fly a trip with what it has. In place."""
        self._left[gap.route] -= gap.needed

    def _serve(self, node: int, waiting: list[tuple[int, tuple[int, int], _Gap]], time: int,
               times: list[int]) -> None:
        """Give places that are free to those who take off next. In place."""
        stock, busy = self._problem.depots[node].chargers, self._busy[node]
        while busy and busy[0] <= time:
            heappop(busy)
        while waiting and len(busy) < (UNLIMITED if stock is None else stock):
            gap = heappop(waiting)[2]
            energy = _energy(self._kinds[gap.route])
            end = min(gap.end, time - -self._missing(gap) // energy.charge)
            charge = Charge(time, end)
            self._charges[gap.place] = (charge,)
            self._left[gap.route] = _charged(energy, self._left[gap.route], (charge,))
            self._fly(gap)
            heappush(busy, end)
            heappush(times, end)
