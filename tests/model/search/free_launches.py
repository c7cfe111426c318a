"""Whether one truck with one drone can serve everybody, its launches at any minutes at all.

Tries all orders, launches and recoveries of sorties to one customer each, and every minute at which
a launch may be held back until; shares no code with the planner.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations

from model.problem import DroneType, Problem

MINUTE = 60_000

Flight = tuple[int, int, int]  # customer, stop of launch, stop of recovery


@dataclass(frozen=True)
class Trip:
    """What is fixed before times are."""

    problem: Problem
    drones: DroneType
    stops: tuple[int, ...]
    flights: tuple[Flight, ...]
    last_launch: int

    def serves(self) -> bool:
        """Tell whether some launches keep all windows, the endurance and the shift."""
        return any(True for _ in self._from(0, self.problem.vehicle_types[0].earliest, 0, None))

    def _from(self, stop: int, arrival: int, flown: int,
              aloft: tuple[int, int] | None) -> Iterator[int]:
        """Yield ends of the trip from an arrival on; `aloft`: take-off, end of service."""
        node, crew, done = self.stops[stop], arrival, arrival
        if node:
            customer = self.problem.customer_at(node)
            if arrival > customer.latest:
                return
            done = max(arrival, customer.earliest) + customer.service_duration
        if aloft is not None and self.flights[flown - 1][2] == stop:
            back = aloft[1] + self._air(self.flights[flown - 1][0], node)
            if not self._within(aloft[0], back, max(crew, back)):
                return
            crew, aloft = max(crew, back) + self.drones.recovery_duration, None
        yield from self._at(stop, crew, done, flown, aloft)

    def _at(self, stop: int, crew: int, done: int, flown: int,
            aloft: tuple[int, int] | None) -> Iterator[int]:
        """Yield ends of the trip from when the crew is free at a stop."""
        launches = (aloft is None and flown < len(self.flights)
                    and self.flights[flown][1] == stop)
        if not launches:
            leave = max(crew, done)
            if stop < len(self.stops) - 1:
                leg = self.problem.travel[0].duration.item(*self.stops[stop:stop + 2])
                yield from self._from(stop + 1, leave + leg, flown, aloft)
            elif leave <= self.problem.vehicle_types[0].latest:
                yield leave
            return
        target, _, recovery = self.flights[flown]
        customer = self.problem.customer_at(target)
        soonest = crew + self.drones.launch_duration
        for take_off in range(soonest, max(soonest, self.last_launch) + 1, MINUTE):
            arrival = take_off + self._air(self.stops[stop], target)
            if arrival > customer.latest:
                return
            ready = max(arrival, customer.earliest) + customer.service_duration
            if recovery > stop:
                yield from self._at(stop, take_off, done, flown + 1, (take_off, ready))
                continue
            back = ready + self._air(target, self.stops[stop])
            if self._within(take_off, back, back):
                yield from self._at(stop, back + self.drones.recovery_duration, done, flown + 1,
                                    None)

    def _air(self, origin: int, to: int) -> int:
        return self.problem.travel[1].duration.item(origin, to)

    def _within(self, take_off: int, back: int, begun: int) -> bool:
        end = begun if self.drones.endurance_includes_waiting else back
        return end - take_off <= self.drones.endurance


def can_serve_all(problem: Problem) -> bool:
    """Tell whether a trip of one truck with one drone can serve everybody."""
    drones = problem.vehicle_types[0].drones
    assert drones is not None
    nodes = range(1, problem.num_nodes)
    latest = max(customer.earliest for customer in problem.customers)
    for mask in range(2 ** len(nodes)):
        flown = tuple(node for node in nodes if mask >> (node - 1) & 1)
        driven = tuple(node for node in nodes if node not in flown)
        by_drone = {problem.customer_at(node).served_by for node in flown}
        by_truck = {problem.customer_at(node).served_by for node in driven}
        if "truck" in by_drone or "drone" in by_truck:
            continue
        for order in permutations(driven):
            for queue in permutations(flown):
                for flights in _flights(queue, len(order) + 2, 0):
                    if Trip(problem, drones, (0, *order, 0), flights, latest).serves():
                        return True
    return False


def _flights(queue: tuple[int, ...], num_stops: int, first: int) -> Iterator[tuple[Flight, ...]]:
    """Yield all ways to fly to customers one after another from stop `first` on."""
    if not queue:
        yield ()
        return
    for launch in range(first, num_stops):
        for recovery in range(launch, num_stops):
            for others in _flights(queue[1:], num_stops, recovery):
                yield ((queue[0], launch, recovery), *others)
