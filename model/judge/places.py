"""Where a customer is served in a plan, and plans in which he is served elsewhere or not at all.

All others keep their vehicles and their order. A sortie that began or ended at the stop of a
customer who is taken out begins or ends at a neighbouring one.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice, product
from typing import Literal, NamedTuple

from model.judge.breaks import ON_A_LEG, BreakDecision
from model.judge.timing import Operation, RouteDecision, SortieDecision, TripDecision
from model.problem import Problem, Shipment
from model.solution import Route, Solution, Vehicle

Means = Literal["truck", "drone"]

MAX_WAYS_OUT = 8
"""So many ways are tried to launch and recover drones elsewhere than at a stop that goes."""


class Place(NamedTuple):
    """Where a customer is, or would be, served; of a shipment, where it is first.

    A shipment's is by drone if any of its ends is.
    """

    vehicle: Vehicle
    trip: int  # index among the vehicle's trips
    by: Means
    stop: int  # index of the truck's stop there; by drone: of the launch
    recovery: int = 0  # by drone: index of the stop of the recovery
    drone: int = 0
    sortie: int | None = None  # by drone: which, where it serves others too; None: one of its own
    visit: int = 0  # index within the sortie
    own_trip: bool = False  # nobody else is on the trip
    flown_on: bool = False
    """By drone: launched where its truck picks it up, before `stop`; back there if `recovery` is
    before that."""
    ends: tuple[tuple[int, "Place"], ...] = ()
    """Of a shipment that is to be put there: nodes and their places on the trip without any of
    them, in the order of visits."""


@dataclass(frozen=True)
class Found:
    """A place that a plan has: with its route, and by drone its sortie, both as indices."""

    route: int
    place: Place
    flight: int = 0


def used_place(problem: Problem, solution: Solution, node: int) -> int:
    """Return the place of a customer that a plan uses; his own if it leaves him out."""
    places = problem.places_of(node)
    return next((place for place in places if len(places) > 1
                 and find_place(solution, place) is not None), places[0])


def find_place(solution: Solution, node: int) -> Found | None:
    """Return where a plan serves the customer at `node`; None: it leaves him out."""
    for index, route in enumerate(solution.routes):
        for number, trip in enumerate(route.trips):
            vehicle = route.driven_by
            is_alone = len(trip.visits) == 1
            for at, stop in enumerate(trip.stops[1:-1], 1):
                if stop.node == node and not stop.is_launch_site:
                    return Found(index, Place(vehicle, number, "truck", at,
                                              own_trip=is_alone))
            for flight, sortie in enumerate(trip.sorties):
                nodes = [visit.node for visit in sortie.visits]
                if node in nodes:
                    return Found(index, Place(
                        vehicle, number, "drone", sortie.launch_stop, sortie.recovery_stop,
                        sortie.drone, flight if len(nodes) > 1 else None, nodes.index(node),
                        own_trip=is_alone), flight)
    return None


def find_shipment(solution: Solution, shipment: Shipment) -> Found | None:
    """Return where a plan first serves a shipment, none of whose ends it leaves out; else None."""
    found = [find_place(solution, node) for node in shipment.nodes]
    known = [each for each in found if each is not None]
    if len(known) < len(found):
        return None
    first = known[0]
    trip = solution.routes[first.route].trips[first.place.trip]
    return replace(first, place=first.place._replace(
        by="drone" if any(each.place.by == "drone" for each in known) else "truck",
        own_trip={*trip.served} == {*shipment.nodes}))


def routes_without(decision: RouteDecision, found: Found) -> Iterator[RouteDecision]:
    """Yield a route without the customer at a place, in each way in which drones may go on."""
    place = found.place
    for trip in islice(_trips_without(decision.trips[place.trip], found), MAX_WAYS_OUT):
        trips = [*decision.trips]
        if len(trip.nodes) == 2 and not trip.sorties:
            del trips[place.trip]
        else:
            trips[place.trip] = trip
        yield replace(decision, trips=tuple(trips))


def _trips_without(trip: TripDecision, found: Found) -> Iterator[TripDecision]:
    place, flight = found.place, found.flight
    if place.by == "truck":
        yield from _without_stop(trip, place.stop)
        return
    sortie = trip.sorties[flight]
    nodes = sortie.nodes[:place.visit] + sortie.nodes[place.visit + 1:]
    if nodes:
        sorties = (*trip.sorties[:flight], replace(sortie, nodes=nodes),
                   *trip.sorties[flight + 1:])
        yield replace(trip, sorties=sorties)
        return
    yield replace(trip, sorties=trip.sorties[:flight] + trip.sorties[flight + 1:],
                  operations=_without_flight(trip.operations, flight))


def _without_flight(
    operations: tuple[tuple[Operation, ...], ...] | None, flight: int
) -> tuple[tuple[Operation, ...], ...] | None:
    if operations is None:
        return None
    return tuple([tuple([Operation(index - (index > flight), is_launch)
                         for index, is_launch in group if index != flight])
                  for group in operations])


def _without_stop(trip: TripDecision, stop: int) -> Iterator[TripDecision]:
    """Yield a trip without a stop, where drones are launched and recovered before or after it."""
    nodes = trip.nodes[:stop] + trip.nodes[stop + 1:]
    ways = [[(launch, recovery)
             for launch in _places_instead(sortie.launch_stop, stop)
             for recovery in _places_instead(sortie.recovery_stop, stop) if launch <= recovery]
            for sortie in trip.sorties]
    is_met = any(stop in (sortie.launch_stop, sortie.recovery_stop) for sortie in trip.sorties)
    operations = trip.operations
    if operations is not None:
        operations = None if is_met else operations[:stop] + operations[stop + 1:]
    for stops in product(*ways):
        sorties = tuple([replace(sortie, launch_stop=launch, recovery_stop=recovery)
                         for sortie, (launch, recovery) in zip(trip.sorties, stops, strict=True)])
        yield replace(trip, nodes=nodes, sorties=sorties, operations=operations,
                      breaks=_without_leg(trip.breaks, stop))


def _without_leg(breaks: Sequence[BreakDecision], stop: int) -> tuple[BreakDecision, ...]:
    """Return the breaks of a trip without a stop, those of the two legs there on one.

    Those behind the stop lie at its end where they else would lie before others.
    """
    kept = list[BreakDecision]()
    for each in breaks:
        place = each.place
        if each.stop == stop and kept and kept[-1].stop == stop - 1 and (
                ON_A_LEG.index(place) < ON_A_LEG.index(kept[-1].place)):
            place = "arrival"
        kept.append(each._replace(stop=max(0, each.stop - (each.stop >= stop)), place=place))
    return tuple(kept)


def _places_instead(index: int, gone: int) -> tuple[int, ...]:
    """Return the indices of stops that may stand for one, once another one is gone."""
    if index == gone:
        return gone - 1, gone
    return (index - (index > gone),)


def route_with(decision: RouteDecision, place: Place, node: int,
               ends: tuple[int, int]) -> RouteDecision:
    """Return a route with a customer, or all ends of a shipment, at a place.

    Parameters
    ----------
    decision
        The route without him.
    place
        Where he is put; a trip of his own comes before the one that has its index.
    node
        His node; of a shipment the place tells those of its ends.
    ends
        Nodes where a trip of his own begins and ends.
    """
    trips = [*decision.trips]
    if place.own_trip:
        trips.insert(place.trip, TripDecision(ends))
    *pickups, last = place.ends or ((node, place),)
    fetched = [each for each, _ in pickups]
    for each, where in _in_order(pickups, last, len(trips[place.trip].sorties)):
        trips[place.trip] = _with(trips[place.trip], where, each, fetched)
    return replace(decision, trips=tuple(trips))


def _in_order(pickups: Sequence[tuple[int, Place]], last: tuple[int, Place],
              flights: int) -> list[tuple[int, Place]]:
    """Return ends as they are put on a trip of so many flights.

    Those by drone first, launched and recovered at stops as they are, the last one first, unless it
    leaves with a drone where another of them comes aboard.
    """
    _, where = last
    relayed = where.by == "drone" and where.sortie is None and any(
        place.by == "drone" and place.recovery == where.stop and place.sortie != flights
        for _, place in pickups)
    ends = [*pickups[::-1], last] if relayed else [last, *pickups[::-1]]
    return sorted(ends, key=lambda end: (end[1].flown_on, end[1].by == "truck"))


def _with(trip: TripDecision, place: Place, node: int, fetched: Collection[int]) -> TripDecision:
    if place.by == "truck":
        return _with_stop(trip, place.stop, node)
    if place.flown_on:
        driven = [index for index, other in enumerate(trip.nodes) if other in fetched]
        back = place.recovery < place.stop
        place = place._replace(
            stop=driven[-1], recovery=driven[-1] if back else place.recovery + len(driven))
    if place.sortie is not None:
        sortie = trip.sorties[place.sortie]
        nodes = (*sortie.nodes[:place.visit], node, *sortie.nodes[place.visit:])
        return replace(trip, sorties=(*trip.sorties[:place.sortie], replace(sortie, nodes=nodes),
                                      *trip.sorties[place.sortie + 1:]))
    own = SortieDecision((node,), place.stop, place.recovery, place.drone)
    operations = trip.operations
    if operations is not None:
        operations = _with_flight(operations, trip.sorties, own, fetched)
    return replace(trip, sorties=(*trip.sorties, own), operations=operations)


def _with_stop(trip: TripDecision, stop: int, node: int) -> TripDecision:
    sorties = tuple([replace(sortie, launch_stop=sortie.launch_stop + (sortie.launch_stop >= stop),
                             recovery_stop=sortie.recovery_stop + (sortie.recovery_stop >= stop))
                     for sortie in trip.sorties])
    operations = trip.operations
    if operations is not None:
        operations = (*operations[:stop], (), *operations[stop:])
    breaks = tuple([each._replace(stop=each.stop + (each.stop >= stop)) for each in trip.breaks])
    return replace(trip, nodes=(*trip.nodes[:stop], node, *trip.nodes[stop:]), sorties=sorties,
                   operations=operations, breaks=breaks)


def _with_flight(
    operations: tuple[tuple[Operation, ...], ...], sorties: Sequence[SortieDecision],
    own: SortieDecision, fetched: Collection[int]
) -> tuple[tuple[Operation, ...], ...]:
    """Return the order of launches and recoveries with those of one more flight.

    Its drone is launched as soon as it is aboard, and what others have `fetched`; it is recovered
    before it is launched again.
    """
    groups = [[*group] for group in operations]
    index = len(sorties)
    here = groups[own.launch_stop]
    back = [place for place, (flight, is_launch) in enumerate(here)
            if not is_launch and (sorties[flight].drone == own.drone
                                  or not {*fetched}.isdisjoint(sorties[flight].nodes))]
    launch = back[-1] + 1 if back else 0
    here.insert(launch, Operation(index, True))
    if own.recovery_stop == own.launch_stop:
        here.insert(launch + 1, Operation(index, False))
    else:
        there = groups[own.recovery_stop]
        again = [place for place, (flight, is_launch) in enumerate(there)
                 if is_launch and sorties[flight].drone == own.drone]
        there.insert(again[0] if again else len(there), Operation(index, False))
    return tuple(map(tuple, groups))


def changed(solution: Solution, index: int, route: Route | None,
            unassigned: tuple[int, ...]) -> Solution:
    """Return a plan with another route in place of one, at its end if it has none there.

    None: without that route.
    """
    routes = [*solution.routes]
    routes[index:index + 1] = [] if route is None else [route]
    return Solution(tuple(routes), unassigned)
