"""Trips of vehicles that fly by themselves, packed on as few of them as their times let."""

from collections.abc import Sequence

import numpy as np

from model.problem import Problem, VehicleType
from model.search.beginning.stock import left_at
from model.search.beginning.translate import left_out, make_searcher, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.solution import Route, Solution, Stop, Trip

LONG_AGO = -1


def packed_routes(problem: Problem, k: int, trips: Sequence[Sequence[int]],
                  nodes: Sequence[int] | None = None,
                  beside: Sequence[Route] = ()) -> list[Route]:
    """Return trips of a type, each given by its customers, on vehicles one after another.

    What must begin first comes first, each time on the vehicle that has been back for least time by
    then; on another where none is in time. What no vehicle can fly any more is left out, or for
    what routes `beside` leave no batteries, fewest customers first. Routes have no times yet.
    `nodes` are the problem's, by the numbers that trips have.
    """
    kind = problem.vehicle_types[k]
    stock = left_at(problem, beside, kind.depot)
    if kind.takes_batteries and len(trips) > stock.batteries:
        trips = sorted(trips, key=len, reverse=True)[:stock.batteries]
    timing = _Timing(problem, kind, nodes or range(problem.num_nodes))
    back: list[int] = []  # by vehicle
    made: list[list[Sequence[int]]] = []
    for trip in sorted(trips, key=timing.latest_start):
        chosen, ready = LONG_AGO, timing.ready(trip)
        charged = sum(len(route) > kind.trips_uncharged for route in made)
        for vehicle, free in enumerate(back):
            if _may_go_on(kind, len(made[vehicle]), charged < stock.chargers) and (
                    timing.end(trip, max(free, ready)) is not None
                    and (chosen == LONG_AGO or _is_better(free, back[chosen], ready))):
                chosen = vehicle
        if (chosen == LONG_AGO and len(made) < kind.count
                and _may_go_on(kind, 0, charged < stock.chargers)):
            chosen = len(made)
            made.append([])
            back.append(kind.earliest)
        end = None if chosen == LONG_AGO else timing.end(trip, max(back[chosen], ready))
        if end is not None:
            made[chosen].append(trip)
            airborne = end - max(back[chosen], ready)
            back[chosen] = end + max(kind.reload_duration, timing.charging(airborne))
    return [Route(k, number, tuple([_trip(kind, each) for each in route]))
            for number, route in enumerate(made) if route]


def packed_anew(problem: Problem, data: ProblemData, searcher: Searcher,
                nodes: Sequence[int]) -> Searcher:
    """Return a search's best plan with the trips of who flies packed anew, if that costs less.

    Else the search as it is. No move of a search empties a vehicle of many trips. `nodes` are the
    problem's by the search's numbers.
    """
    packed = {k for k, kind in enumerate(problem.vehicle_types)
              if kind.flies and kind.max_trips > 1}
    if not packed:
        return searcher
    made = list(read_routes(data, searcher))
    routes = [route for route in made if route.vehicle_type not in packed]
    for k in sorted(packed):
        trips = [[stop.node for stop in trip.stops[1:-1]]
                 for route in made if route.vehicle_type == k for trip in route.trips]
        routes += packed_routes(problem, k, trips, nodes, routes)
    found = make_searcher(problem, data, Solution(tuple(routes), left_out(data, searcher)),
                          np.random.SeedSequence(0))
    return found if found.value.best < searcher.value.best else searcher


def _may_go_on(kind: VehicleType, trips: int, is_place_left: bool) -> bool:
    """Tell whether a vehicle that makes so many trips may make another, with a place to charge."""
    needs_one = trips == kind.trips_uncharged
    return trips < kind.max_trips and (is_place_left or not needs_one)


def _is_better(free: int, other: int, ready: int) -> bool:
    """Tell whether a vehicle waits for less time than another, or is late by less."""
    if (free <= ready) != (other <= ready):
        return free <= ready
    return free > other if free <= ready else free < other


def _trip(kind: VehicleType, customers: Sequence[int]) -> Trip:
    return Trip(tuple([Stop(node, 0, 0, 0) for node in (
        kind.begins_at, *customers, kind.ends_at)]))


class _Timing:
    """When trips of a type end that begin at an instant."""

    def __init__(self, problem: Problem, kind: VehicleType, nodes: Sequence[int]) -> None:
        self._problem = problem
        self._nodes = nodes
        self._kind = kind
        self._duration = problem.travel[kind.travel].duration

    def ready(self, trip: Sequence[int]) -> int:
        """Return when all its parcels are there."""
        return max([self._kind.earliest,
                    *[self._problem.customer_at(self._nodes[node]).release_time for node in trip]])

    def end(self, trip: Sequence[int], start: int) -> int | None:
        """Return when it ends, its recovery included; None if somebody is reached too late."""
        kind, time, here = self._kind, start + self._kind.launch_duration, self._kind.begins_at
        for node in map(self._nodes.__getitem__, trip):
            customer = self._problem.customer_at(node)
            time += self._duration.item(here, node) + self._problem.setup_between(here, node)
            if time > customer.latest and customer.late_cost_per_hour is None:
                return None
            time = max(time, customer.earliest) + kind.service_at(customer)
            here = node
        end = time + self._duration.item(here, kind.ends_at) + kind.recovery_duration
        return end if end <= kind.latest else None

    def charging(self, airborne: int) -> int:
        """Return how long a battery is charged at most after so long a trip; 0: it is full at once.
        """
        energy = self._kind.energy
        if energy is None or not energy.charge:
            return 0
        most = max(*energy.cruise, *energy.climb, *energy.descent, *energy.hover)
        return -(-min(airborne * most, energy.available) // energy.charge)

    def latest_start(self, trip: Sequence[int]) -> int:
        """Return when it has to begin at the latest, as if nobody waited."""
        spent, here, latest = self._kind.launch_duration, self._kind.begins_at, self._kind.latest
        for node in map(self._nodes.__getitem__, trip):
            customer = self._problem.customer_at(node)
            spent += self._duration.item(here, node)
            latest = min(latest, customer.latest - spent)
            spent += self._kind.service_at(customer)
            here = node
        return latest
