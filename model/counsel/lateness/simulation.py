"""A route driven on many drawn days.

Trucks wait for windows and for their drones, drones for their trucks, and breaks are taken where
they are planned. What a plan holds back otherwise, for a battery, an endurance or another vehicle,
isn't earlier on any day than planned. Times in ms.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from model.judge.launches import launch_duration
from model.judge.pairs import hands_over
from model.judge.timing import Operation, latest_release, read_decision
from model.counsel.lateness.drawn import DrawnDays, Spread, Times, opened, settled
from model.problem import Problem, VehicleType
from model.solution import Route, Sortie, Stop, Trip, Visit


@dataclass(frozen=True)
class Encounter:
    """A customer on all days: when whoever serves him comes, and begins."""

    visit: Stop | Visit
    arrivals: Times
    starts: Times


@dataclass
class TripEncounters:
    """Customers of a trip, by truck in order, and by sortie."""

    stops: list[Encounter] = field(default_factory=list)
    sorties: list[list[Encounter]] = field(default_factory=list)

    def __iter__(self) -> Iterator[Encounter]:
        yield from self.stops
        for visits in self.sorties:
            yield from visits


def drive_route(problem: Problem, route: Route, spread: Spread,
                drawn: DrawnDays) -> list[TripEncounters]:
    """Return whom a timed route meets when, trip by trip."""
    kind = problem.vehicle_types[route.vehicle_type]
    trips: list[TripEncounters] = []
    ready = None
    for trip in route.trips:
        driving = _Driving(problem, kind, trip, spread, drawn)
        ready = driving.end(ready) + kind.reload_duration
        trips.append(driving.met)
    return trips


class _Driving:
    """Drives one trip."""

    def __init__(self, problem: Problem, kind: VehicleType, trip: Trip, spread: Spread,
                 drawn: DrawnDays) -> None:
        self._problem = problem
        self._kind = kind
        self._trip = trip
        self._spread = spread
        self._drawn = drawn
        decision = read_decision(trip, kind)
        self._operations = decision.operations or ((),) * len(trip.stops)
        self._opens = max(latest_release(problem, decision),
                          problem.depots[decision.nodes[0]].earliest)
        self._back: dict[int, Times] = {}  # by sortie that was launched
        self.met = TripEncounters([], [[] for _ in trip.sorties])

    def end(self, ready: Times | None) -> Times:
        """Return when the trip ends whose vehicle is ready then; None: as planned."""
        first, last = self._trip.stops[0], len(self._trip.stops) - 1
        times = self._drawn.at(first.arrival)
        if ready is not None:
            times = settled(np.maximum(ready, self._opens), first.arrival)
        for index, stop in enumerate(self._trip.stops):
            if index:
                times = self._leg(index, times)
            begins, times = self._served(stop, times, index, last)
            if self._operations[index]:
                times = np.maximum(times, self._operated(index, begins, times))
            times = settled(times, stop.departure)
        return times

    def _leg(self, index: int, times: Times) -> Times:
        """Return when a stop is reached from the one before, left then."""
        planned = self._trip.stops[index - 1].departure
        for taken in self._trip.breaks:
            if taken.stop == index - 1:
                times = self._drawn.driven(times, planned, taken.arrival, self._spread.travel)
                if taken.start > taken.arrival:
                    times = np.maximum(times, taken.start)
                times, planned = times + (taken.end - taken.start), taken.end
        arrival = self._trip.stops[index].arrival
        return settled(self._drawn.driven(times, planned, arrival, self._spread.travel), arrival)

    def _served(self, stop: Stop, arrivals: Times, index: int, last: int) -> tuple[Times, Times]:
        """Return when drones may begin at a stop, and when all else is done there."""
        kind = self._kind
        if index == 0:
            return arrivals, np.maximum(arrivals, kind.busy_until) + kind.launch_duration
        if stop.node < self._problem.num_depots:
            starts = np.maximum(arrivals, self._problem.depots[stop.node].earliest)
            return starts, starts + (kind.recovery_duration if index == last else 0)
        customer = self._problem.customer_at(stop.node)
        ready = arrivals + stop.setup
        starts = settled(opened(customer, ready), stop.service_start)
        self.met.stops.append(Encounter(stop, arrivals, starts))
        return ready, self._drawn.lasted(
            starts, stop.service_start, stop.service_start + kind.service_at(customer),
            self._spread.service)

    def _operated(self, index: int, times: Times, served: Times) -> Times:
        """Return when all launches and recoveries at a stop are done that begin then."""
        for operation in self._operations[index]:
            sortie = self._trip.sorties[operation.sortie]
            times = (self._launched(operation, sortie, times, served) if operation.is_launch
                     else self._recovered(operation, sortie, times))
        return times

    def _launched(self, operation: Operation, sortie: Sortie, times: Times,
                  served: Times) -> Times:
        """Return when a drone has taken off; note whom it meets, and when it is back. In place."""
        drones = self._kind.drone_type(sortie.drone)
        origin = self._trip.stops[sortie.launch_stop].node
        if hands_over(self._problem, origin, sortie.nodes):
            times = np.maximum(times, served)
        times = settled(times + launch_duration(drones, not self._back), sortie.launch_time)
        at, planned, node = times, sortie.launch_time, origin
        for visit in sortie.visits:
            at = self._drawn.lasted(at, planned, visit.arrival, self._spread.travel)
            customer = self._problem.customer_at(visit.node)
            starts = settled(opened(customer, at + visit.setup), visit.service_start)
            self.met.sorties[operation.sortie].append(Encounter(visit, at, starts))
            at = self._drawn.lasted(starts, visit.service_start, visit.departure,
                                    self._spread.service)
            planned, node = visit.departure, visit.node
        home = self._problem.travel[drones.travel].duration.item(
            node, self._trip.stops[sortie.recovery_stop].node)
        self._back[operation.sortie] = self._drawn.lasted(
            at, planned, planned + home, self._spread.travel)
        return times

    def _recovered(self, operation: Operation, sortie: Sortie, times: Times) -> Times:
        starts = settled(np.maximum(times, self._back[operation.sortie]), sortie.recovery_start)
        return starts + self._kind.drone_type(sortie.drone).recovery_duration
