"""Which places of a plan look cheapest for one more customer, by detours and the room in time.

A guess that costs little: it decides which places are tried, never what is said of them.
"""

import math
import time
from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping
from itertools import chain, pairwise, takewhile
from typing import NamedTuple

from model.judge.clock import service_start
from model.judge.launches import launch_duration
from model.judge.metrics import allowed_overtime
from model.judge.past import Past
from model.judge.places import Means, Place
from model.problem import MM_PER_KM, MS_PER_HOUR, UNREACHABLE, DroneType, Problem, VehicleType
from model.solution import Route, Solution, Trip, Vehicle

BY_TRUCK: tuple[Means, ...] = ("truck",)
ANYHOW: tuple[Means, ...] = ("truck", "drone")

Wanted = Callable[[Vehicle], bool]
"""Tells whose places are asked for."""


def of_any(_: Vehicle) -> bool:
    """Want the places of any vehicle."""
    return True


SPANS = 4
"""A drone is recovered where it was launched, or at one of so many stops from there on."""


class Guess(NamedTuple):
    """A place, and how good it looks, by what comes first here."""

    late: int  # ms, too late there or afterwards
    cost: float
    duration: int  # ms of detour or flight
    place: Place

    @property
    def rank(self) -> tuple[int, float, int]:
        """What is smaller for a better guess."""
        return self.late, self.cost, self.duration


class _Legs:
    """Ways to and from one node, as lists by the other node; there, set up."""

    def __init__(self, problem: Problem, travel: int, node: int) -> None:
        matrices = problem.travel[travel]
        there = matrices.duration[:, node].tolist()
        self.there = [way + problem.setup_between(origin, node) for origin, way in enumerate(there)]
        self.back: list[int] = matrices.duration[node].tolist()
        self.far_there: list[int] = matrices.distance[:, node].tolist()
        self.far_back: list[int] = matrices.distance[node].tolist()
        self._matrices = matrices

    def between(self, origin: int, target: int) -> tuple[int, int]:
        """Return the duration and distance of the leg without the node."""
        return (self._matrices.duration.item(origin, target),
                self._matrices.distance.item(origin, target))


class Screen:
    """Guesses for one customer, in a plan that leaves him out.

    `means` are those by which he may be served.
    """

    def __init__(self, problem: Problem, solution: Solution, node: int, past: Past,
                 means: Collection[Means] = ANYHOW, wanted: Wanted = of_any) -> None:
        self._problem = problem
        self._solution = solution
        self._node = node
        self._customer = problem.customer_at(node)
        self._past = past
        self._legs: dict[int, _Legs] = {}
        self._means = means
        self._wanted = wanted

    def guesses(self, until: float = math.inf) -> dict[tuple[Vehicle, Means], list[Guess]]:
        """Return the places of each vehicle, by truck and by drone, the best ones first.

        Beside those in use, one more vehicle of each type that has more. Of trips in use
        none that come up after `until`, on `time.perf_counter`.
        """
        found: defaultdict[tuple[Vehicle, Means], list[Guess]] = defaultdict(list)
        routes = routes_of(self._solution)
        trips = {vehicle: len(route.trips) for vehicle, route in routes.items()}
        behind = {vehicle: self._past.room_after(self._problem, route, self._node)
                  for vehicle, route in routes.items()}
        on_trips = takewhile(lambda _: time.perf_counter() < until, self._on_trips(routes, behind))
        alone = (self._alone(vehicle, number, is_new=vehicle not in trips)
                 for vehicle, number in self._own_trips(trips) if self._wanted(vehicle)
                 and (number, 1) >= behind.get(vehicle, (0, 1)))
        for guess in chain.from_iterable(chain(on_trips, alone)):
            found[guess.place.vehicle, guess.place.by].append(guess)
        for (vehicle, _), guesses in found.items():
            price = self._problem.vehicle_cost(vehicle.type, self._node)
            if price:
                guesses[:] = [guess._replace(cost=guess.cost + price) for guess in guesses]
            guesses.sort(key=lambda guess: guess.rank)
        return found

    def _on_trips(self, routes: Mapping[Vehicle, Route], behind: Mapping[Vehicle, tuple[int, int]]
                  ) -> Iterator[Iterator[Guess]]:
        """Yield the places on each trip that isn't over, and not before where there is room."""
        for vehicle, route in routes.items():
            if not self._wanted(vehicle):
                continue
            known = self._past.trips.get(vehicle, ())
            first_trip, first = behind[vehicle]
            for number, trip in enumerate(route.trips):
                if number < max(len(known) - 1, first_trip) or (
                        number < len(known) and known[number].rest != "anything"):
                    continue
                first_stop, first_flight = first if number == first_trip else 1, 0
                if number < len(known):
                    first_stop = max(first_stop, len(known[number].stops))
                    first_flight = len(known[number].sorties)
                yield self._on_trip(vehicle, number, trip, first_stop, first_flight)

    def _own_trips(self, trips: dict[Vehicle, int]) -> Iterator[tuple[Vehicle, int]]:
        """Yield vehicles that may make a trip for the customer alone, and its index."""
        for vehicle, number in trips.items():
            if number < self._problem.vehicle_types[vehicle.type].max_trips:
                begun = len(self._past.trips.get(vehicle, ()))
                yield from ((vehicle, index) for index in range(begun, number + 1))
        for index, kind in enumerate(self._problem.vehicle_types):
            free = (vehicle for number in range(kind.count)
                    if (vehicle := Vehicle(index, number)) not in trips
                    and vehicle not in self._past.unavailable)
            unused = next(free, None)
            if unused is not None:
                yield unused, 0

    def _legs_of(self, travel: int) -> _Legs:
        if travel not in self._legs:
            self._legs[travel] = _Legs(self._problem, travel, self._node)
        return self._legs[travel]

    def _alone(self, vehicle: Vehicle, number: int, is_new: bool) -> Iterator[Guess]:
        """Yield a trip for the customer alone, by truck and by each way of one drone."""
        kind = self._problem.vehicle_types[vehicle.type]
        begin, end, fixed = kind.begins_at, kind.ends_at, kind.fixed_cost if is_new else 0.0
        legs = self._legs_of(kind.travel)
        hours = legs.there[begin] + kind.service_at(self._customer) + legs.back[end]
        cost = (fixed + price_of(kind, legs.far_there[begin] + legs.far_back[end], hours)
                + kind.cost_per_stop)
        yield Guess(0, cost, hours, Place(vehicle, number, "truck", 1, own_trip=True))
        if "drone" not in self._means:
            return
        for first, drones in first_drones(kind):
            for recovery, place in enumerate((begin, end)):
                if recovery and kind.truck_waits:
                    break
                duration, price = self._flight(drones, begin, place)
                if duration < UNREACHABLE:
                    price += fixed + duration * kind.cost_per_hour / MS_PER_HOUR
                    yield Guess(self._excess(drones, begin, place, duration), price, duration,
                                Place(vehicle, number, "drone", 0, recovery, first, own_trip=True))

    def _on_trip(self, vehicle: Vehicle, number: int, trip: Trip, first_stop: int,
                 first_flight: int) -> Iterator[Guess]:
        kind = self._problem.vehicle_types[vehicle.type]
        slacks = slacks_of(self._problem, kind.latest + allowed_overtime(kind), trip)
        yield from self._by_truck(vehicle, number, trip, slacks, first_stop)
        if "drone" in self._means and kind.drones is not None:
            for first, drones in first_drones(kind):
                yield from self._by_drone(vehicle, number, trip, drones, first, first_stop)
            yield from self._by_shared_flight(vehicle, number, trip, kind, first_flight)

    def _by_truck(self, vehicle: Vehicle, number: int, trip: Trip, slacks: list[int],
                  first_stop: int) -> Iterator[Guess]:
        kind, customer = self._problem.vehicle_types[vehicle.type], self._customer
        legs = self._legs_of(kind.travel)
        hard = customer.late_cost_per_hour is None
        for index in range(max(1, first_stop), len(trip.stops)):
            before, after = trip.stops[index - 1], trip.stops[index]
            arrival = before.departure + legs.there[before.node]
            start = service_start(customer, arrival)
            _, straight = legs.between(before.node, after.node)
            detour = legs.far_there[before.node] + legs.far_back[after.node] - straight
            push = start + kind.service_at(customer) + legs.back[after.node] - after.arrival
            too_late = max(0, arrival - customer.latest)
            late = (too_late if hard else 0) + max(0, push - slacks[index])
            cost = (price_of(kind, detour, push) + kind.cost_per_stop
                    + too_late * (customer.late_cost_per_hour or 0.0) / MS_PER_HOUR
                    + (customer.late_cost if too_late else 0.0)
                    + (start - arrival) * customer.early_cost_per_hour / MS_PER_HOUR)
            yield Guess(late, cost, push, Place(vehicle, number, "truck", index))

    def _excess(self, drones: DroneType, launch: int, recovery: int, duration: int) -> int:
        """Return by how much a flight between two nodes is too long, a metre told as a second."""
        excess = max(0, duration - drones.endurance)
        if drones.max_range is not None:
            straight = self._legs_of(drones.straight)
            far = max(straight.far_back[launch], straight.far_back[recovery])
            excess += max(0, far - drones.max_range)
        return excess

    def _flight(self, drones: DroneType, launch: int, recovery: int) -> tuple[int, float]:
        """Return how long a flight between two nodes takes, and its cost."""
        legs = self._legs_of(drones.travel)
        duration = legs.there[launch] + drones.service_at(self._customer) + legs.back[recovery]
        distance = legs.far_there[launch] + legs.far_back[recovery]
        return duration, price_of(drones, distance, duration)

    def _by_drone(self, vehicle: Vehicle, number: int, trip: Trip, drones: DroneType, first: int,
                  first_stop: int) -> Iterator[Guess]:
        """Yield flights of their own, of drones of a type, numbered from `first`, aboard then."""
        per_hour = self._problem.vehicle_types[vehicle.type].cost_per_hour
        customer, last = self._customer, len(trip.stops) - 1
        waits = self._problem.vehicle_types[vehicle.type].truck_waits
        legs = self._legs_of(drones.travel)
        for launch in range(first_stop - 1, last + 1):
            begin = trip.stops[launch]
            if not self._problem.may_launch_at(begin.node):
                continue
            arrival = (begin.ready + launch_duration(drones, not trip.sorties)
                       + legs.there[begin.node])
            too_late = 0
            if customer.late_cost_per_hour is None:
                too_late = max(0, arrival - customer.latest)
            furthest = launch if waits else min(launch + SPANS - 1, last)
            for recovery in range(launch, furthest + 1):
                end = trip.stops[recovery]
                if not self._problem.may_launch_at(end.node):
                    continue
                duration, cost = self._flight(drones, begin.node, end.node)
                if duration >= UNREACHABLE:
                    continue
                drone = free_drone(trip, range(first, first + drones.count), launch, recovery)
                if drone is None:
                    continue
                held = begin.ready + duration - end.departure
                yield Guess(too_late + self._excess(drones, begin.node, end.node, duration),
                            cost + max(0, held) * per_hour / MS_PER_HOUR, duration,
                            Place(vehicle, number, "drone", launch, recovery, drone))

    def _by_shared_flight(self, vehicle: Vehicle, number: int, trip: Trip, kind: VehicleType,
                          first_flight: int) -> Iterator[Guess]:
        """Yield places on flights that have room for one more."""
        for index, sortie in enumerate(trip.sorties):
            drones = kind.drone_type(sortie.drone)
            legs = self._legs_of(drones.travel)
            if index < first_flight or len(sortie.visits) >= drones.max_customers_per_sortie:
                continue
            nodes = [trip.stops[sortie.launch_stop].node, *[each.node for each in sortie.visits],
                     trip.stops[sortie.recovery_stop].node]
            for visit, (here, there) in enumerate(pairwise(nodes)):
                duration, straight = legs.between(here, there)
                added = legs.there[here] + legs.back[there] - duration
                detour = legs.far_there[here] + legs.far_back[there] - straight
                if added < UNREACHABLE // 2:
                    airborne = sortie.recovery_start - sortie.launch_time
                    yield Guess(max(0, airborne + added - drones.endurance),
                                price_of(drones, detour, added), added,
                                Place(vehicle, number, "drone", sortie.launch_stop,
                                      sortie.recovery_stop, sortie.drone, index, visit))


def routes_of(solution: Solution) -> dict[Vehicle, Route]:
    """Return the route of each vehicle; the first, where a plan wrongly states several."""
    routes: dict[Vehicle, Route] = {}
    for route in solution.routes:
        routes.setdefault(route.driven_by, route)
    return routes


def best_first(guesses: Mapping[tuple[Vehicle, Means], list[Guess]]) -> list[Guess]:
    """Return the places of all vehicles in one list."""
    return sorted(chain.from_iterable(guesses.values()), key=lambda guess: guess.rank)


def price_of(by: DroneType | VehicleType, distance: int, duration: int) -> float:
    """Return what a way costs."""
    return distance * by.cost_per_km / MM_PER_KM + duration * by.cost_per_hour / MS_PER_HOUR


def share_over(share: float, until: float) -> float:
    """Return the instant, on `time.perf_counter`, at which a share of the time until one is over.
    """
    now = time.perf_counter()
    return now + share * (until - now)


def slacks_of(problem: Problem, shift_ends: int, trip: Trip) -> list[int]:
    """Return by how much each stop may be reached later, by hard windows and the shift's end."""
    end = trip.stops[-1]
    slack = max(0, min(shift_ends, problem.depots[end.node].latest) - end.departure)
    slack += end.service_start - end.arrival
    slacks = [slack]
    for stop in reversed(trip.stops[1:-1]):
        if stop.is_launch_site:
            slack = min(slack, max(0, problem.depots[stop.node].latest - stop.arrival))
            slacks.append(slack)
            continue
        customer = problem.customer_at(stop.node)
        slack += stop.service_start - stop.ready
        if customer.late_cost_per_hour is None:
            slack = min(slack, max(0, customer.latest - stop.ready))
        slacks.append(slack)
    return [slack, *reversed(slacks)]


def first_drones(kind: VehicleType) -> Iterator[tuple[int, DroneType]]:
    """Yield the types of drones of a vehicle, each with the number of its first drone."""
    first = 0
    for drones in kind.drone_types:
        yield first, drones
        first += drones.count


def free_drone(trip: Trip, among: range, launch: float, recovery: float) -> int | None:
    """Return a drone that is aboard from one stop to another, by the order of stops.

    Halves are between stops.
    """
    busy = {sortie.drone for sortie in trip.sorties
            if sortie.launch_stop < recovery and launch < sortie.recovery_stop}
    return next((drone for drone in among if drone not in busy), None)
