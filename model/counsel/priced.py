"""Where the search finds that a customer, or a shipment, may come on routes of a plan.

It prices all places on a route as it does in each of its turns, in some microseconds each. Its word
isn't the last one: the judge says of each place that is told whether it is legal and what it costs.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import NamedTuple

from model.judge.places import Means, Place
from model.problem import Problem
from model.search.priced_places import (
    BEGIN, END, FLY, FLY_FIRST, HALT, JOIN, RIDE, SERVE, Placement, PlacePrices,
)
from model.solution import Route, Solution, Vehicle


class Offer(NamedTuple):
    """A place, and what the search finds that it costs more."""

    cost: float
    place: Place


def legal_offers(problem: Problem, solution: Solution, nodes: Sequence[int], until: float = math.inf
                 ) -> dict[tuple[Vehicle, Means], list[Offer]] | None:
    """Return the legal places of vehicles in use, by truck and with drones, the cheapest first.

    Parameters
    ----------
    problem
        The problem.
    solution
        A plan that leaves them out.
    nodes
        The customer's, or those of all ends of a shipment.
    until
        On `time.perf_counter`.

    Returns
    -------
    The cheapest of each vehicle, as many as the search lists; None if there was no time.
    """
    places = PlacePrices(problem, solution, until).all_places(nodes[0])
    if places is None:
        return None
    found: dict[tuple[Vehicle, Means], list[Offer]] = {}
    routes = [*map(_OnRoute, solution.routes)]
    for index, priced in places:
        place = routes[index].place(priced.placements, nodes)
        if place is not None:
            found.setdefault((place.vehicle, place.by), []).append(Offer(priced.cost, place))
    return found


def offers_of(prices: PlacePrices, solution: Solution, node: int) -> list[Offer]:
    """Return the legal places of a customer whom a plan leaves out, the cheapest first."""
    routes = [*map(_OnRoute, solution.routes)]
    return sorted([Offer(priced.cost, place) for index in prices.routes
                   for priced in prices.places(node, index)
                   if (place := routes[index].place(priced.placements, (node,))) is not None],
                  key=lambda offer: offer.cost)


def is_seen_by_search(problem: Problem) -> bool:
    """Tell whether the search sees each place that the judge finds legal, and what it costs.

    Of flights, breaks, rests and orders between customers it looks at the likeliest ways, and it
    knows soft windows by their prices as routes are.
    """
    kinds, customers = problem.vehicle_types, problem.customers
    return not (
        problem.relations or problem.limits_time_aboard or problem.limits_time_between
        or any(kind.num_drones or kind.flies or kind.breaks or kind.driving for kind in kinds)
        or any(each.late_cost_per_hour is not None or each.early_cost_per_hour
               for each in customers))


@dataclass(frozen=True)
class _Stretch:
    """The trip that placements are on, or one that begins and ends by them."""

    trip: int  # its index
    first: int  # its first stop, by those of the route
    flights: int  # of it
    is_new: bool


class _OnRoute:
    """Places on a route, by where the search puts nodes among its stops."""

    def __init__(self, route: Route) -> None:
        self._vehicle = route.driven_by
        self._route = route
        self._begins = [0, *accumulate(len(trip.stops) for trip in route.trips)]
        self._flights = [(number, flight) for number, trip in enumerate(route.trips)
                         for flight in sorted(range(len(trip.sorties)), key=lambda index: (
                             trip.sorties[index].launch_stop, trip.sorties[index].recovery_stop))]

    def place(self, placed: Sequence[Placement], nodes: Sequence[int]) -> Place | None:
        """Return a place; None: it is none by which customers are put, as where trips are split."""
        on = self._stretch(placed)
        if on is None:
            return None
        driven = [each.first for each in placed if each.how == SERVE]
        found = {each.node: place for each in placed if each.how in (SERVE, FLY, FLY_FIRST, JOIN)
                 and (place := self._one(on, each, driven)) is not None}
        for each in placed:
            if each.how == RIDE and each.first in found:
                found[each.node] = found[each.first]
                found[each.first] = found[each.first]._replace(sortie=on.flights)
        if found.keys() != {*nodes}:
            return None
        if len(nodes) == 1:
            return found[nodes[0]]
        *pickups, last = [(node, found[node]) for node in nodes]
        at = {each.node: each.first for each in placed}
        ends = (*sorted(pickups, key=lambda end: at[end[0]]), last)
        by: Means = "drone" if any(place.by == "drone" for _, place in ends) else "truck"
        return ends[0][1]._replace(by=by, ends=ends)

    def _stretch(self, placed: Sequence[Placement]) -> _Stretch | None:
        """Return where all is placed; None: at a launch site, or by splitting a trip."""
        hows = [each.how for each in placed]
        if HALT in hows:
            return None
        if BEGIN in hows or END in hows:
            first = placed[0].first
            if hows[0] != BEGIN or first not in self._begins or hows.count(BEGIN) > 1:
                return None
            return _Stretch(self._begins.index(first), first, 0, is_new=True)
        if hows[0] == JOIN:
            number, _ = self._flights[placed[0].first]
        else:
            number = next(number for number, (begin, end) in enumerate(pairwise(self._begins))
                          if begin <= placed[0].first - (hows[0] == SERVE) < end)
        return _Stretch(number, self._begins[number], len(self._route.trips[number].sorties),
                        is_new=False)

    def _one(self, on: _Stretch, each: Placement, driven: Sequence[int]) -> Place | None:
        """Return the place of one node, the truck's new stops being those `driven` to."""
        def former(stop: int) -> int:
            return stop - on.first - sum(other < stop for other in driven)

        if each.how == SERVE:
            return Place(self._vehicle, on.trip, "truck", former(each.first), own_trip=on.is_new)
        if each.how == JOIN:
            number, flight = self._flights[each.first]
            sortie = self._route.trips[number].sorties[flight]
            return Place(self._vehicle, number, "drone", sortie.launch_stop, sortie.recovery_stop,
                         sortie.drone, flight, each.last)
        place = Place(self._vehicle, on.trip, "drone", former(each.first), former(each.last),
                      each.drone, own_trip=on.is_new)
        if each.first in driven:
            back = place.stop - 1 if each.last == each.first else place.recovery
            return place._replace(recovery=back, flown_on=True) if (
                each.first == driven[-1] and each.last not in driven[:-1]) else None
        return None if each.last in driven else place
