"""Which places of a plan look cheapest for all ends of a shipment at once.

A guess, as for one customer: it decides which places are tried, never what is said of them. All
places are on the trip as it is without the shipment, and its ends are put there the last one first.
"""

import math
import time
from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice, pairwise, permutations, product, takewhile
from math import prod

from model.counsel.screening import (
    ANYHOW, BY_TRUCK, SPANS, Guess, Screen, Wanted, first_drones, free_drone, of_any, price_of,
    routes_of, share_over,
)
from model.judge.past import Past
from model.judge.places import Means, Place
from model.problem import Problem, Shipment, VehicleType
from model.problem.travel import Matrix
from model.solution import Solution, Stop, Trip, Vehicle

_TripOf = tuple[Vehicle, int, bool]
"""Whose trip, its index, and whether it is one more that it comes before."""

MOST_WAYS = 4000
"""So many ways to put a shipment are all looked at; where there are more, those of single ends that
look best."""

KEPT, KEPT_FLIGHTS = 8, 4
"""Of each trip, the places of an end by truck and by drone that are combined then."""

SINGLE_ENDS = 0.5
"""Share of the time in which single ends are guessed at, before all at once."""

KEPT_PICKUPS = 30
"""So many ways to choose places for several pickups before one of a delivery are combined then."""

MOST_ORDERS = 24
"""Orders in which several pickups at one place follow each other."""


class ShipmentScreen:
    """Guesses for a shipment, in a plan that leaves it out; as `Screen`."""

    def __init__(self, problem: Problem, solution: Solution, shipment: Shipment,
                 past: Past, wanted: Wanted = of_any) -> None:
        self._problem = problem
        self._shipment = shipment
        self._past = past
        self._wanted = wanted
        self._solution = solution
        self._may_be_flown = problem.customer_at(shipment.delivery).served_by != "truck"
        self._routes = routes_of(solution)

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
            screen = Screen(self._problem, self._solution, node, self._past, means, self._wanted)
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
        """Yield all ends at once on a trip."""
        vehicle, number, own_trip = trip
        kind = self._problem.vehicle_types[vehicle.type]
        known = (Trip(tuple([Stop(node, 0, 0, 0) for node in (kind.begins_at, kind.ends_at)]))
                 if own_trip else self._routes[vehicle].trips[number])
        *pickups, deliveries = ends
        flown_on = [(on, end) for end, some in enumerate(pickups) for each in some
                    for on in self._flown_on(kind, known, self._shipment.nodes[end], each.place)]
        for last, source in chain(((each, None) for each in deliveries), flown_on):
            before = [[guess for guess in some if _is_before(guess.place, last.place) and (
                end != source or (guess.place.by, guess.place.stop) == ("truck", last.place.stop))]
                      for end, some in enumerate(pickups)]
            if len(before) > 1 and not are_all:
                each = max(1, int(KEPT_PICKUPS ** (1 / len(before))))
                before = [sorted(some, key=lambda guess: guess.rank)[:each] for some in before]
            for chosen in product(*before):
                yield from self._together(kind, known, (*chosen, last))
        if len(pickups) == 1 and self._may_be_flown:
            for guess in pickups[0]:
                if guess.place.by == "drone" and guess.place.sortie is None and (
                        kind.drone_type(guess.place.drone).max_customers_per_sortie > 1):
                    yield self._in_one_flight(kind, known, guess)

    def _together(self, kind: VehicleType, trip: Trip, guesses: Sequence[Guess]
                  ) -> Iterator[Guess]:
        """Yield what all ends look like at places that are guessed at one by one, in some orders.

        Who is driven to next to another is a detour from there. Of many orders those come first
        that begin with the nearest.
        """
        late, cost, duration = map(sum, zip(*[guess[:3] for guess in guesses], strict=True))
        travel = self._problem.travel[kind.travel]
        *pickups, last = [(node, guess.place) for node, guess
                          in zip(self._shipment.nodes, guesses, strict=True)]
        pickups.sort(key=lambda end: travel.duration.item(trip.stops[end[1].stop - 1].node, end[0]))
        orders = [tuple(sorted(order, key=lambda end: end[1].stop))
                  for order in islice(permutations(pickups), MOST_ORDERS)]
        for order in dict.fromkeys(orders):
            ends, less, nearer = (*order, last), 0, 0
            for (one, there), (other, place) in pairwise(ends):
                if there.by == place.by == "truck" and there.stop == place.stop:
                    before, after = (trip.stops[stop].node for stop in (place.stop - 1, place.stop))
                    less += (_detour(travel.duration, before, other, after)
                             - _detour(travel.duration, one, other, after))
                    nearer += (_detour(travel.distance, before, other, after)
                               - _detour(travel.distance, one, other, after))
            by: Means = "truck" if all(place.by == "truck" for _, place in ends) else "drone"
            yield Guess(late, cost - price_of(kind, nearer, less), duration - less,
                        ends[0][1]._replace(by=by, ends=ends))

    def _flown_on(self, kind: VehicleType, trip: Trip, pickup: int, place: Place
                  ) -> Iterator[Guess]:
        """Yield flights that deliver from where the truck picks up at a place."""
        if place.by == "drone" or not self._may_be_flown or not self._problem.may_launch_at(pickup):
            return
        delivery, launch = self._shipment.delivery, place.stop - 0.5
        behind = place.stop if kind.truck_waits else min(place.stop + SPANS - 1, len(trip.stops))
        for first, drones in first_drones(kind):
            legs, among = self._problem.travel[drones.travel], range(first, first + drones.count)
            for back in range(place.stop - 1, behind):
                to = pickup if back < launch else trip.stops[back].node
                drone = free_drone(trip, among, launch, max(launch, back))
                if drone is None or not self._problem.may_launch_at(to):
                    continue
                duration, distance = (matrix.item(pickup, delivery) + matrix.item(delivery, to)
                                      for matrix in (legs.duration, legs.distance))
                duration += drones.service_at(self._problem.customer_at(delivery))
                cost = price_of(drones, distance, duration) + (
                    price_of(kind, 0, duration) if back < launch else 0.0)
                yield Guess(max(0, duration - drones.endurance), cost, duration, place._replace(
                    by="drone", recovery=back, drone=drone, flown_on=True))

    def _in_one_flight(self, kind: VehicleType, trip: Trip, guess: Guess) -> Guess:
        """Return that a drone which fetches a shipment brings it on the same flight."""
        (pickup, delivery), place = self._shipment.nodes, guess.place
        drones, home = kind.drone_type(place.drone), trip.stops[place.recovery].node
        legs = self._problem.travel[drones.travel]
        more = (_detour(legs.duration, pickup, delivery, home)
                + drones.service_at(self._problem.customer_at(delivery)))
        far = _detour(legs.distance, pickup, delivery, home)
        return Guess(guess.late, guess.cost + price_of(drones, far, more), guess.duration + more,
                     place._replace(ends=((pickup, place._replace(sortie=len(trip.sorties))),
                                          (delivery, place))))


def _detour(legs: Matrix, before: int, node: int, after: int) -> int:
    """Return what it takes more to come by a node."""
    return legs.item(before, node) + legs.item(node, after) - legs.item(before, after)


def _promise(ends: Sequence[Sequence[Guess]]) -> tuple[float, ...]:
    """Return what is smaller for a trip on which the best places of all ends look better."""
    best = [min(guess.rank for guess in some) for some in ends]
    return tuple(map(sum, zip(*best, strict=True)))


def _in_turn(trips: Iterable[Iterator[Guess]]) -> Iterator[Guess]:
    """Yield the first guess of each trip, then the second of each, and so on."""
    left = deque(trips)
    while left:
        trip = left.popleft()
        for guess in islice(trip, 1):
            yield guess
            left.append(trip)


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
