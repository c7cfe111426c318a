"""Pinned customers keep their places in the order of their vehicles.

A customer keeps its place if whom its truck served before is served before still, and whom it
served after, after. In the plan given there is an instant between each two stops of a truck: the
middle of the way. So windows say the order: who was before arrives by then, who was after begins
no earlier.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from typing import NamedTuple

from model.problem import MAX_QUANTITY, Customer, Problem
from model.solution import Route, Solution, Stop, Vehicle


def orders_of(plan: Solution) -> dict[Vehicle, tuple[int, ...]]:
    """Return whom each truck serves, in its order."""
    return {route.driven_by: tuple(stop.node for stop in _stops(route))
            for route in plan.routes}


def in_order(problem: Problem, plan: Solution, pinned: Collection[int],
             orders: Iterable[Sequence[int]] = ()) -> Problem:
    """Return a problem whose windows keep some customers at their places in a plan's order.

    Whoever may be late there, at a cost, may not be later than his place allows, and if he is late
    in the plan given that costs nothing here. Of those whom the plan leaves out `orders` tell
    where they were.
    """
    customers = list(problem.customers)
    served = {stop.node: stop for route in plan.routes for stop in _stops(route)}
    bounds = [bound for route in plan.routes for bound in _bounded(_stops(route), pinned)]
    left_out = set(plan.unassigned)
    bounds += [bound for order in orders for bound in _missing(order, served, pinned)
               if bound.node in left_out]
    for node, arrival, since, until in bounds:
        index = node - problem.num_depots
        customers[index] = _between(customers[index], arrival, since, until)
    return replace(problem, customers=tuple(customers))


def by_order(plan: Solution, orders: Mapping[Vehicle, Sequence[int]]) -> Solution:
    """Return a plan whose trucks keep an order at an instant, too, which no window tells."""
    routes = []
    for route in plan.routes if orders else ():
        order = orders.get(route.driven_by, ())
        places = {node: place for place, node in enumerate(order)}
        routes.append(replace(route, trips=tuple(
            replace(trip, stops=_ordered(trip.stops, places)) for trip in route.trips)))
    return replace(plan, routes=tuple(routes)) if orders else plan


def _ordered(stops: Sequence[Stop], places: Mapping[int, int]) -> tuple[Stop, ...]:
    """Return stops of which those at one instant are in an order."""
    found = list(stops)
    for end in range(len(found) - 1, 0, -1):
        for index in range(1, end):
            one, other = found[index:index + 2]
            is_at_once = (one.arrival == one.departure == other.arrival == other.service_start
                          == other.departure)
            if is_at_once and places.get(one.node, -1) > places.get(other.node, len(places)):
                found[index] = replace(one, node=other.node)
                found[index + 1] = replace(other, node=one.node)
    return tuple(found)


def _stops(route: Route) -> list[Stop]:
    return [stop for trip in route.trips for stop in trip.customer_stops]


class _Bound(NamedTuple):
    """Between which instants a customer's place is, and when it is reached in the plan given."""

    node: int
    arrival: int
    since: int | None
    until: int | None


def _bounded(stops: Sequence[Stop], pinned: Collection[int]) -> Iterator[_Bound]:
    """Yield the places of stops that are bounded."""
    edges = [(before.departure + stop.arrival) // 2
             if before.node in pinned or stop.node in pinned else None
             for before, stop in pairwise(stops)]
    if not edges:
        return
    # At one place, who needs no time would fit in at the instant itself, behind and before.
    closings = [edge if edge is None or before.departure < stop.arrival else edge - 1
                for edge, (before, stop) in zip(edges, pairwise(stops), strict=True)]
    sinces = list(accumulate([None, *edges], _last))
    untils = list(accumulate([None, *reversed(closings)], _last))
    for stop, since, until in zip(stops, sinces, reversed(untils), strict=True):
        if until is not None:
            until = max(stop.ready, until)
        if since is not None or until is not None:
            yield _Bound(stop.node, stop.arrival, since, until)


def _missing(order: Sequence[int], served: Mapping[int, Stop],
             pinned: Collection[int]) -> Iterator[_Bound]:
    """Yield the places of those whom a plan leaves out, among those whom their truck serves."""
    for place, node in enumerate(order):
        if node in served:
            continue
        beside = [other for other in order if other in served
                  and (other in pinned or node in pinned)]
        since = max((served[other].departure for other in beside if other in order[:place]),
                    default=None)
        until = min((served[other].arrival for other in beside if other in order[place:]),
                    default=None)
        if since is not None or until is not None:
            yield _Bound(node, since or until or 0, since, until)


def _last(known: int | None, edge: int | None) -> int | None:
    return known if edge is None else edge


def _between(customer: Customer, arrival: int, since: int | None,
             until: int | None) -> Customer:
    """Return a customer who is served between two instants, as the plan given does it."""
    begins, latest = min(since or 0, MAX_QUANTITY), customer.latest
    if until is not None:
        latest = until if latest < arrival else min(latest, until)
        customer = replace(customer, late_cost_per_hour=None)
    begins = min(begins, latest)
    closings = [*(closes for closes, _ in customer.gaps), latest]
    windows = [(max(opens, begins), min(closes, latest))
               for opens, closes in zip(customer.openings, closings, strict=True)
               if closes >= begins and opens <= latest]
    if not windows:
        return customer
    return replace(customer, earliest=windows[0][0], latest=windows[-1][1],
                   gaps=tuple((before[1], window[0]) for before, window in pairwise(windows)))
