"""Which places of a plan look cheapest for all ends of a shipment at once.

A guess, as for one customer: it decides which places are tried, never what is said of them. All
places are on the trip as it is without the shipment, and its ends are put there the last one first.
"""

import math
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, groupby, islice, permutations, product, takewhile
from math import prod

from model.counsel.screening import (
    ANYHOW, BY_TRUCK, SPANS, Guess, Screen, Wanted, first_drones, free_drone, of_any, share_over,
    slacks_of,
)
from model.judge.clock import service_start
from model.judge.loads import trip_loads
from model.judge.metrics import allowed_overtime
from model.judge.past import Past, Vehicle
from model.judge.places import Means, Place
from model.problem import MM_PER_KM, MS_PER_HOUR, UNREACHABLE, Problem, Shipment
from model.solution import Solution, Stop, Trip

_TripOf = tuple[Vehicle, int, bool]
"""Whose trip, its index, and whether it is one more that it comes before."""

Ends = tuple[tuple[int, Place], ...]
"""Nodes and places, in the order of visits."""

MOST_WAYS = 4000
"""So many ways to put a shipment are all looked at; where there are more, those of single ends that
look best."""

KEPT, KEPT_FLIGHTS = 8, 4
"""Of each trip, the places of an end by truck and by drone that are combined then."""

SINGLE_ENDS = 0.5
"""Share of the time in which single ends are guessed at, before all at once."""

KEPT_PICKUPS = 30
"""So many ways to choose places for several pickups before one of a delivery are combined then."""

MOST_ORDERS, MOST_ORDERS_ALONE = 6, 24
"""Orders in which several pickups follow each other, beside others and alone."""


class ShipmentScreen:
    """Guesses for a shipment, in a plan that leaves it out; as `Screen`."""

    def __init__(self, problem: Problem, solution: Solution, shipment: Shipment,
                 past: Past, wanted: Wanted = of_any) -> None:
        self._problem = problem
        self._shipment = shipment
        self._past = past
        self._wanted = wanted
        self._trips: dict[Vehicle, tuple[Trip, ...]] = {}
        for route in solution.routes:
            self._trips.setdefault(Vehicle(route.vehicle_type, route.vehicle), route.trips)
        self._solution = solution

    def guesses(self, until: float = math.inf) -> dict[tuple[Vehicle, Means], list[Guess]]:
        """Return the places of each vehicle, by truck and with drones, the best ones first.

        Those that are found until an instant, on `time.perf_counter`.
        """
        found: defaultdict[tuple[Vehicle, Means], list[Guess]] = defaultdict(list)
        by_trip = self._ends_by_trip(share_over(SINGLE_ENDS, until))
        are_all = sum(prod(map(len, ends)) for ends in by_trip.values()) <= MOST_WAYS
        trips = [self._on_trip(trip, ends if are_all else [*map(_likeliest, ends)], are_all)
                 for trip, ends in by_trip.items()]
        for guess in takewhile(lambda _: time.perf_counter() < until, _in_turn(trips)):
            found[guess.place.vehicle, guess.place.by].append(guess)
        for guesses in found.values():
            guesses.sort(key=lambda guess: guess.rank)
        return found

    def _ends_by_trip(self, until: float) -> dict[_TripOf, list[list[Guess]]]:
        """Return the places of each end, by trip; of trips that have some for every end.

        Those that look best come first.
        """
        by_trip: dict[_TripOf, list[list[Guess]]] = {}
        nodes = self._shipment.nodes
        for end, node in enumerate(nodes):
            means = BY_TRUCK if self._problem.customer_at(node).served_by == "truck" else ANYHOW
            screen = Screen(self._problem, self._solution, node, self._past, means,
                            self._wanted)
            for guess in chain.from_iterable(screen.guesses(until).values()):
                key = guess.place.vehicle, guess.place.trip, guess.place.own_trip
                by_trip.setdefault(key, [[] for _ in nodes])[end].append(guess)
        for (_, _, own_trip), ends in by_trip.items():
            if own_trip:
                # Who is alone comes aboard behind where the trip begins, and leaves at its end.
                ends[-1] += [guess._replace(place=guess.place._replace(stop=1, recovery=1))
                             for guess in ends[-1] if guess.place.by == "drone"
                             and not guess.place.recovery]
        return dict(sorted([(key, ends) for key, ends in by_trip.items() if all(ends)],
                           key=lambda each: _promise(each[1])))

    def _on_trip(self, trip: _TripOf, ends: Sequence[Sequence[Guess]],
                 are_all: bool) -> Iterator[Guess]:
        vehicle, number, own_trip = trip
        row = _Row(self._problem, vehicle, None if own_trip else self._trips[vehicle][number],
                   vehicle not in self._trips)
        *pickups, deliveries = ends
        nodes = self._shipment.nodes
        flown_on = [] if self._problem.customer_at(nodes[-1]).served_by == "truck" else [
            (on, end) for end, some in enumerate(pickups) for guess in some
            for on in row.flown_on(nodes[end], nodes[-1], guess.place)]
        for last, source in chain(((each, None) for each in deliveries), flown_on):
            before = [[guess for guess in some if _is_before(guess.place, last.place) and (
                end != source or (guess.place.by, guess.place.stop) == ("truck", last.place.stop))]
                      for end, some in enumerate(pickups)]
            if len(before) > 1 and not are_all:
                each = max(1, int(KEPT_PICKUPS ** (1 / len(before))))
                before = [sorted(some, key=lambda guess: guess.rank)[:each] for some in before]
            for chosen in product(*before):
                guesses = (*chosen, last)
                for ordered in self._orders(row, guesses):
                    yield row.looked_at(guesses, ordered)
        if len(nodes) == 2 and self._problem.customer_at(nodes[1]).served_by != "truck":
            for guess in pickups[0]:
                yield from row.by_one_flight(nodes, guess)

    def _orders(self, row: "_Row", guesses: Sequence[Guess]) -> Iterator[Ends]:
        """Yield the ends in the order of their visits: pickups at one place in several orders."""
        *pickups, last = [(node, guess.place) for node, guess
                          in zip(self._shipment.nodes, guesses, strict=True)]
        if len(pickups) == 1:
            yield pickups[0], last
            return
        pickups.sort(key=lambda end: end[1].stop)
        beside = [list(some) for _, some in groupby(pickups, key=lambda end: end[1].stop)]
        most = MOST_ORDERS_ALONE if last[1].own_trip else MOST_ORDERS
        ways = product(*[chain([row.nearest_first(some)], islice(permutations(some), most))
                         if len(some) > 1 else [some] for some in beside])
        for way in dict.fromkeys(tuple(chain(*groups)) for groups in islice(ways, most + 1)):
            yield *way, last


def _promise(ends: Sequence[Sequence[Guess]]) -> tuple[float, ...]:
    """Return what is smaller for a trip on which the best places of all ends look better."""
    best = [min(guess.rank for guess in some) for some in ends]
    return tuple(map(sum, zip(*best, strict=True)))


def _in_turn(trips: Iterable[Iterator[Guess]]) -> Iterator[Guess]:
    """Yield the first guess of each trip, then the second of each, and so on."""
    left = [*trips]
    while left:
        going_on = []
        for trip in left:
            for guess in islice(trip, 1):
                yield guess
                going_on.append(trip)
        left = going_on


def _likeliest(guesses: Sequence[Guess]) -> list[Guess]:
    """Return the places of an end on a trip that look best, by truck and by drone."""
    ordered = sorted(guesses, key=lambda guess: guess.rank)
    return [*[guess for guess in ordered if guess.place.by == "truck"][:KEPT],
            *[guess for guess in ordered if guess.place.by == "drone"][:KEPT_FLIGHTS]]


def _is_before(pickup: Place, delivery: Place) -> bool:
    """Tell whether a parcel is aboard, as picked up at one place, when it is to leave at another.

    What a drone fetches is so behind the stop of its recovery, or there for another drone, unless
    it delivers it itself.
    """
    if pickup.by == delivery.by == "drone" and pickup.sortie is not None and (
            pickup.sortie == delivery.sortie):
        return pickup.visit <= delivery.visit
    if pickup.by == "truck":
        return delivery.stop >= pickup.stop
    leaves_there = delivery.by == "drone" and not delivery.flown_on
    return delivery.stop >= pickup.recovery + (0 if leaves_there else 1)


class _Row:
    """The stops of one trip, or of one that is to be made, and what changes with further ones."""

    def __init__(self, problem: Problem, vehicle: Vehicle, trip: Trip | None,
                 is_new: bool) -> None:
        kind = problem.vehicle_types[vehicle.type]
        self._problem, self._kind, self._vehicle, self._trip = problem, kind, vehicle, trip
        self._travel = problem.travel[kind.travel]
        latest = kind.latest + allowed_overtime(kind)
        self._flights = 0
        if trip is None:
            begin = kind.earliest
            self._stops: tuple[Stop, ...] = tuple([
                Stop(node, begin, begin, begin) for node in (kind.begins_at, kind.ends_at)])
            self._slacks = [latest - begin] * 2
            self._loads = [(0,) * problem.num_dimensions] * 2
        else:
            self._stops, self._flights = trip.stops, len(trip.sorties)
            self._slacks = slacks_of(problem, latest, trip)
            self._loads = trip_loads(problem, kind, trip)
        self._fixed = kind.fixed_cost if is_new else 0.0

    def looked_at(self, guesses: Sequence[Guess], ordered: Ends) -> Guess:
        """Return what all ends at some places look like, which are guessed at one by one."""
        first = ordered[0][1]
        if all(place.by == "truck" for _, place in ordered):
            late, cost, pushed = self._driven(ordered)
            return Guess(late, cost, pushed, first._replace(ends=ordered))
        return Guess(sum(guess.late for guess in guesses), sum(guess.cost for guess in guesses),
                     sum(guess.duration for guess in guesses),
                     first._replace(by="drone", ends=ordered))

    def by_one_flight(self, nodes: tuple[int, ...], guess: Guess) -> Iterator[Guess]:
        """Yield that a drone which fetches a shipment on a flight of its own brings it, too."""
        place = guess.place
        if place.by == "truck" or place.sortie is not None:
            return
        drones = self._kind.drone_type(place.drone)
        pickup, delivery = nodes
        legs = self._problem.travel[drones.travel]
        home = self._stops[place.recovery].node
        added = (legs.duration.item(pickup, delivery) + legs.duration.item(delivery, home)
                 - legs.duration.item(pickup, home)
                 + drones.service_at(self._problem.customer_at(delivery)))
        if drones.max_customers_per_sortie < 2 or added >= UNREACHABLE // 2:
            return
        far = (legs.distance.item(pickup, delivery) + legs.distance.item(delivery, home)
               - legs.distance.item(pickup, home))
        cost = (guess.cost + far * drones.cost_per_km / MM_PER_KM
                + added * drones.cost_per_hour / MS_PER_HOUR)
        beside = place._replace(sortie=self._flights)
        yield Guess(guess.late, cost, guess.duration + added,
                    place._replace(ends=((pickup, beside), (delivery, place))))

    def flown_on(self, pickup: int, delivery: int, place: Place) -> Iterator[Guess]:
        """Yield flights that deliver from where the truck picks up at a place."""
        if place.by == "drone" or not self._problem.may_launch_at(pickup):
            return
        launch = place.stop - 0.5
        behind = (place.stop if self._kind.truck_waits
                  else min(place.stop + SPANS - 1, len(self._stops)))
        for first, drones in first_drones(self._kind):
            legs, among = self._problem.travel[drones.travel], range(first, first + drones.count)
            for back in range(place.stop - 1, behind):
                to = pickup if back < launch else self._stops[back].node
                free = first if self._trip is None else free_drone(
                    self._trip, among, launch, max(launch, back))
                duration = (legs.duration.item(pickup, delivery) + legs.duration.item(delivery, to)
                            + drones.service_at(self._problem.customer_at(delivery)))
                if (free is None or duration >= UNREACHABLE
                        or not self._problem.may_launch_at(to)):
                    continue
                far = legs.distance.item(pickup, delivery) + legs.distance.item(delivery, to)
                waits = duration if back < launch else 0
                cost = (far * drones.cost_per_km / MM_PER_KM
                        + duration * drones.cost_per_hour / MS_PER_HOUR
                        + waits * self._kind.cost_per_hour / MS_PER_HOUR)
                yield Guess(max(0, duration - drones.endurance), cost, duration, place._replace(
                    by="drone", recovery=back, drone=free, flown_on=True))

    def nearest_first(self, ends: Sequence[tuple[int, Place]]) -> list[tuple[int, Place]]:
        """Return ends at one place, each next one nearest to the one before."""
        left, ordered = [*ends], list[tuple[int, Place]]()
        at = self._stops[ends[0][1].stop - 1].node
        while left:
            nearest = min(left, key=lambda end: self._travel.duration.item(at, end[0]))
            left.remove(nearest)
            ordered.append(nearest)
            at = nearest[0]
        return ordered

    def _driven(self, ends: Ends) -> tuple[int, float, int]:
        """Return by how much too late the truck would be, what it would cost, how long it takes.

        Too much aboard is told as an hour.
        """
        place = ends[0][1].stop
        start = self._stops[place - 1]
        at, now, late, far, cost = start.node, start.departure, 0, 0, self._fixed
        aboard = [0] * self._problem.num_dimensions
        for node, where in ends:
            for index in range(place, where.stop):
                stop = self._stops[index]
                far += self._far(at, stop.node) - self._far(self._stops[index - 1].node, stop.node)
                now, missed = self._reached(at, stop.node, now, stop.departure - stop.service_start)
                late, at = late + missed + self._overload(aboard, index), stop.node
            place = where.stop
            far += self._far(at, node)
            customer = self._problem.customer_at(node)
            now, missed = self._reached(at, node, now, self._kind.service_at(customer))
            change = self._problem.shipment_at[node].change_at(node)
            aboard = [sum(amounts) for amounts in zip(aboard, change, strict=True)]
            late += missed + self._overload(aboard, place - 1)
            cost += self._kind.cost_per_stop + self._problem.vehicle_cost(self._vehicle.type, node)
            at = node
        after = self._stops[place]
        far += self._far(at, after.node) - self._far(self._stops[place - 1].node, after.node)
        arrival = now + self._leg(at, after.node)
        pushed = arrival - after.arrival
        late += max(0, pushed - self._slacks[place])
        cost += (far * self._kind.cost_per_km / MM_PER_KM
                 + pushed * self._kind.cost_per_hour / MS_PER_HOUR)
        return late, cost, pushed

    def _far(self, origin: int, to: int) -> int:
        return self._travel.distance.item(origin, to)

    def _leg(self, origin: int, to: int) -> int:
        return self._travel.duration.item(origin, to) + self._problem.setup_between(origin, to)

    def _reached(self, origin: int, to: int, left: int, stay: int) -> tuple[int, int]:
        """Return when the truck leaves the next stop, and by how much it comes too late."""
        arrival = left + self._leg(origin, to)
        if to < self._problem.num_depots:
            return arrival + stay, 0
        customer = self._problem.customer_at(to)
        is_hard = customer.late_cost_per_hour is None
        return (service_start(customer, arrival) + stay,
                max(0, arrival - customer.latest) if is_hard else 0)

    def _overload(self, aboard: Sequence[int], index: int) -> int:
        """Return an hour if more is aboard on leaving a stop than may be."""
        return MS_PER_HOUR * any(
            more and load + more > most for load, more, most
            in zip(self._loads[index], aboard, self._kind.capacity, strict=True))
