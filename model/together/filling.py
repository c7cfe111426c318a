"""Strings of customers left out, put into the routes of a plan, or in place of parts of them."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.judge.ends import with_ends
from model.judge.hubs import hub_violations
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import TimedRoute, read_route, time_route
from model.judge.timing import RouteDecision, TripDecision
from model.problem import Problem
from model.solution import Solution, Vehicle
from model.together.joint import Joint
from model.together.strings import Breadth, Gap, TruckNetwork, best_strings

WIDE, NARROW = Breadth(200, 4), Breadth(24, 4)
"""How widely is looked at first, and later, when many strings are tried."""

LONGEST_PART = 12
"""So many customers of a route are replaced at once, or all of them."""

SHAKEN = 0.25
"""How much longer or shorter legs may seem."""


@dataclass(frozen=True)
class StopsBetween:
    """Stops of a trip that may be others: those between two of them."""

    vehicle: Vehicle
    trip: int  # index; behind the last one: a trip of its own
    before: int  # index of the stop in front
    behind: int

    def nodes(self, route: RouteDecision) -> tuple[int, ...]:
        """Return the customers that are served there."""
        if self.trip == len(route.trips):
            return ()
        return route.trips[self.trip].nodes[self.before + 1:self.behind]


class Filling:
    """A plan that is filled with customers left out.

    Parameters
    ----------
    problem
        The problem planned.
    plan
        A plan without violations.
    joint
        Where trucks may go.
    should_stop
        Asked before each string.
    """

    def __init__(self, problem: Problem, plan: Solution, joint: Joint,
                 should_stop: Callable[[], bool], rng: np.random.Generator) -> None:
        self._problem = problem
        self._joint = joint
        self._should_stop = should_stop
        self._rng = rng
        self._left_out = set(plan.unassigned)
        self._rests: dict[tuple[int, int], Sequence[int]] = {}
        self._routes: dict[Vehicle, TimedRoute] = {}
        for route in plan.routes:
            timed = time_route(problem, read_route(problem, route), "", EVERYTHING_OPEN)
            self._routes[route.driven_by] = timed

    @property
    def plan(self) -> Solution:
        """The plan as it is."""
        return Solution(tuple([self._routes[vehicle].route for vehicle in sorted(self._routes)]),
                        tuple(sorted(self._left_out)))

    def fill(self, rounds: float) -> None:
        """Put in strings, at first wherever they fit, then so many times at random. In place."""
        for part in self._everywhere():
            if self._should_stop() or not self._left_out:
                return
            if self._is_there(part):
                self._replace([part], WIDE, None)
        done = 0
        while done < rounds and self._left_out and not self._should_stop():
            done += 1
            parts = self._drawn()
            if not parts:
                return
            self._replace(parts, NARROW, self._rng)

    def _is_there(self, part: StopsBetween) -> bool:
        """Tell whether a vehicle still has such stops: trips go once nobody is served on them."""
        trips = self._decision(part.vehicle).trips
        if part.trip >= len(trips):
            return part.trip == len(trips) and part.behind == 1
        return part.behind < len(trips[part.trip].nodes)

    def put(self, vehicle: Vehicle, nodes: Iterable[int]) -> None:
        """Let a vehicle without a route serve as many of some customers as it can. In place."""
        others = self._left_out.difference(nodes)
        self._left_out -= others
        if self._joint.streets(vehicle[0]) is not None and self._left_out:
            self._replace([StopsBetween(vehicle, 0, 0, 1)], WIDE, None)
        self._left_out |= others

    def _everywhere(self) -> list[StopsBetween]:
        """Return trips that free vehicles may make, then all there are and one more of each."""
        return [*self._free(), *[
            part for vehicle in sorted(self._routes) for part in self._trips_of(vehicle)]]

    def _free(self) -> list[StopsBetween]:
        """Return the first trip of a vehicle without a route, for each type as many as can help."""
        found = []
        for kind, vehicles in enumerate(self._problem.vehicle_types):
            if self._joint.streets(kind) is not None:
                free = [number for number in range(vehicles.count)
                        if (kind, number) not in self._routes]
                found += [StopsBetween(Vehicle(kind, number), 0, 0, 1)
                          for number in free[:len(self._left_out)]]
        return found

    def _trips_of(self, vehicle: Vehicle) -> list[StopsBetween]:
        streets, trips = self._joint.streets(vehicle[0]), self._decision(vehicle).trips
        if streets is None or not all(node in streets.place
                                      for trip in trips for node in trip.nodes):
            return []
        parts = [StopsBetween(vehicle, index, 0, len(trip.nodes) - 1)
                 for index, trip in enumerate(trips) if not trip.sorties]
        if len(trips) < self._problem.vehicle_types[vehicle[0]].max_trips:
            parts.append(StopsBetween(vehicle, len(trips), 0, 1))
        return parts

    def _drawn(self) -> list[StopsBetween]:
        """Draw one or two parts of routes, each of another vehicle."""
        vehicles = [vehicle for vehicle in sorted(self._routes) if self._trips_of(vehicle)]
        free = self._free()[:1]
        if not vehicles:
            return free
        count = min(len(vehicles), 1 + int(self._rng.random() < 0.5))
        parts = []
        for index in self._rng.permutation(len(vehicles))[:count].tolist():
            trips = self._trips_of(vehicles[index])
            parts.append(self._some_of(trips[int(self._rng.integers(len(trips)))]))
        return [*parts, *free] if self._rng.random() < 0.3 else parts

    def _some_of(self, part: StopsBetween) -> StopsBetween:
        """Draw some consecutive stops of a part."""
        size = part.behind - part.before - 1
        length = int(self._rng.integers(0, LONGEST_PART + 1))
        if length >= size:
            return part
        before = part.before + int(self._rng.integers(0, size - length + 1))
        return replace(part, before=before, behind=before + length + 1)

    def _decision(self, vehicle: Vehicle) -> RouteDecision:
        timed = self._routes.get(vehicle)
        if timed is None:
            return RouteDecision(*vehicle, ())
        return read_route(self._problem, timed.route)

    def _replace(self, parts: Sequence[StopsBetween], width: Breadth,
                 rng: np.random.Generator | None) -> None:
        """Put strings in place of parts, if the plan costs no more then. In place."""
        free = set(self._left_out)
        for part in parts:
            free.update(part.nodes(self._decision(part.vehicle)))
        gone, gain, found = set(free), 0.0, {}
        for part in parts:
            timed, nodes = self._best(part, free, width, rng)
            if timed is None and part.vehicle in self._routes and not self._goes(part):
                return
            free.difference_update(nodes)
            found[part.vehicle] = timed
            gain += self._cost(part.vehicle) - (0.0 if timed is None else timed.judged.cost.total)
        gain += self._value(self._left_out) - self._value(free)
        if gain < -1e-9 or (gain < 1e-9 and rng is None) or not gone:
            return
        made = [timed.route for timed in {**self._routes, **found}.values() if timed is not None]
        if next(hub_violations(self._problem, Solution(tuple(made))), None) is not None:
            return
        for vehicle, timed in found.items():
            if timed is None:
                self._routes.pop(vehicle, None)
            else:
                self._routes[vehicle] = timed
        self._left_out = free

    def _goes(self, part: StopsBetween) -> bool:
        """Tell whether a vehicle has no route without a part."""
        route = self._decision(part.vehicle)
        return (part.trip < len(route.trips) == 1
                and len(part.nodes(route)) == len(route.trips[0].nodes) - 2)

    def _cost(self, vehicle: Vehicle) -> float:
        return self._routes[vehicle].judged.cost.total if vehicle in self._routes else 0.0

    def _value(self, nodes: set[int]) -> float:
        """Return what leaving out some customers costs."""
        problem = self._problem
        return math.fsum([problem.cost_of_leaving_out(problem.customer_at(node))
                          for node in sorted(nodes)])

    def _best(self, part: StopsBetween, free: set[int], width: Breadth,
              rng: np.random.Generator | None) -> tuple[TimedRoute | None, tuple[int, ...]]:
        """Return a route with the best string found in place of a part, and whom that serves."""
        streets, route = self._joint.streets(part.vehicle[0]), self._decision(part.vehicle)
        if streets is None:
            return None, ()
        noise = None
        if rng is not None:
            noise = rng.uniform(1.0 - SHAKEN, 1.0 + SHAKEN, len(streets.nodes))
        gap = self._gap(streets, part, route)
        allowed = {streets.place[node] for node in free if node in streets.place}
        best: tuple[TimedRoute | None, tuple[int, ...]] = (None, ())
        least = math.inf
        for string in best_strings(streets, gap, allowed, width,
                                   self._should_stop, noise):
            nodes = tuple([streets.nodes[place] for place in string.places])
            changed = self._changed(route, part, nodes)
            if changed is None:
                continue
            timed = time_route(self._problem, changed, "", EVERYTHING_OPEN)
            cost = timed.judged.cost.total - string.value
            if not timed.judged.violations and cost < least:
                best, least = (timed, nodes), cost
        return best

    def _changed(self, route: RouteDecision, part: StopsBetween,
                 nodes: tuple[int, ...]) -> RouteDecision | None:
        """Return a route with other customers in a part; None if it has no trips then."""
        kind, trips = self._problem.vehicle_types[route.vehicle_type], [*route.trips]
        if part.trip == len(trips):
            trips.append(TripDecision((kind.depot, *nodes, kind.ends_at)))
        else:
            old = trips[part.trip].nodes
            trips[part.trip] = TripDecision((*old[:part.before + 1], *nodes, *old[part.behind:]))
        trips = [trip for trip in trips if len(trip.nodes) > 2 or trip.sorties]
        return replace(route, trips=with_ends(kind, trips)) if trips else None

    def _gap(self, streets: TruckNetwork, part: StopsBetween, route: RouteDecision) -> Gap:
        """Return where a string is to be put in place of a part, as soon and late as can be."""
        net, kind = streets.net, self._problem.vehicle_types[route.vehicle_type]
        trips = [trip.nodes for trip in route.trips]
        if part.trip == len(trips):
            trips.append((kind.depot, kind.ends_at))
        ended = [trip.nodes for trip in with_ends(kind, [TripDecision(nodes) for nodes in trips])]
        along = [*ended[part.trip]]
        ready = kind.earliest
        for nodes in ended[:part.trip]:
            ready = self._leave(streets, nodes, ready, len(nodes) - 1) + kind.reload_duration
        ready = self._leave(streets, along, ready, part.before)
        latest = net.latest_end
        for nodes in reversed(ended[part.trip + 1:]):
            latest = self._latest(streets, nodes, latest, 0) - kind.reload_duration
        latest = self._latest(streets, along, latest, part.behind)
        end = streets.place[along[part.behind]]
        key = route.vehicle_type, end
        if key not in self._rests:
            self._rests[key] = streets.rest_to(end)
        others = [streets.place[node] for node in (*along[1:part.before + 1],
                                                   *along[part.behind:-1])]
        room, space = ([most - sum([amounts[place][index] for place in others])
                        for index, most in enumerate(kind.capacity)]
                       for amounts in (streets.demand, streets.taken))
        return Gap(streets.place[along[part.before]], ready, end, latest, self._rests[key],
                   tuple(room), tuple(space))

    @staticmethod
    def _leave(streets: TruckNetwork, nodes: Sequence[int], time: int, last: int) -> int:
        """Return when a truck leaves a stop of a trip that it begins at some time."""
        for index in range(1, last + 1):
            here, place = streets.place[nodes[index - 1]], streets.place[nodes[index]]
            time = max(time + streets.ride[here][place], streets.opens[place])
            if index < len(nodes) - 1:
                time += streets.stay[place]
        return time

    @staticmethod
    def _latest(streets: TruckNetwork, nodes: Sequence[int], latest: int, first: int) -> int:
        """Return when a truck has to be at a stop of a trip that must end in time."""
        for index in range(len(nodes) - 2, first - 1, -1):
            here, place = streets.place[nodes[index]], streets.place[nodes[index + 1]]
            latest -= streets.ride[here][place]
            if index > 0:
                latest = min(latest - streets.stay[here], streets.closes[here])
        return latest
