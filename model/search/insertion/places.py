"""The cheapest insertion of a customer, on all routes or beside neighbours."""

from model.kernel.alarm import rung
from model.kernel.compiled import inlined, pasted, spliced
from model.kernel.flight import endurance_of, held_until
from model.kernel.records import Record
from model.kernel.shift import allows_stops
from model.kernel.stop import opening
from model.search.insertion.cheapest_stop import (
    is_simple, scan_beside, scan_beside_lean, scan_lean, scan_simple,
)
from model.search.insertion.evaluate import INFEASIBLE
from model.search.insertion.offers import (
    offer_flight_trips, offer_joining, offer_sorties, offer_stops, offer_trips, offer_trips_apart,
    take_cheapest,
)
from model.search.insertion.passing import scan_passing_lean
from model.search.route.edit import NEW_FLIGHT, NEW_ROUTE, copy_move
from model.search.route.ends import is_apart
from model.search.route.goods import goods_may_follow, goods_may_join
from model.search.route.layout import CHANGING, NOWHERE, World
from model.search.route.randomness import below, uniform
from model.search.route.refresh import stop_beside
from model.search.route.state import Searcher
from model.search.route.vehicles import may_fit, may_launch, stops_on

MORE_TRIPS = 0.2
"""How often a customer who can go on a trip as it is may begin or split one."""

DRAWN_FOR_TRIPS = 16
"""On how many vehicles, where not all are looked at."""


@pasted
def try_new_route(world: World, searcher: Searcher, node: int) -> float:
    """Try a customer on a route of its own; return its cost, INFEASIBLE if there is none.

    In place: `searcher.move`.
    """
    best = INFEASIBLE
    for k in range(world.num_types):
        if searcher.now.used[k] >= world.type[k].count:
            continue
        for by_drone in range(2 if world.loops else 1):
            cost = searcher.alone[k, by_drone, node]
            if cost < best and uniform(searcher.rng) >= world.blink:
                best = cost
                searcher.move.kind, searcher.move.type = NEW_ROUTE + by_drone, k
    return best


@pasted
def try_route(world: World, searcher: Searcher, slot: int, node: int, enlarge: bool) -> None:
    """Try a customer on the trips and sorties of a route.

    In place: the move, and the cost of the best so far.
    """
    now = searcher.now
    k = now.route[slot].type
    by_truck, by_drone = world.can[k, 0, node], world.can[k, 1, node]
    simple = is_simple(world, now, slot)
    if simple and by_truck:
        scan_simple(world, now, slot, node, enlarge, searcher.bound, searcher.move, searcher.rng)
    if simple and not by_drone:
        return
    for index in range(now.route[slot].trips):
        trip = now.trip[slot, index]
        if not (may_fit(world, now, slot, index, k, node)
                and goods_may_join(world, now, slot, index, node)):
            continue
        first, last = trip.first, trip.last
        if by_truck and not simple and allows_stops(world.type[k], stops_on(trip) + 1):
            offer_stops(world, searcher, slot, first, last - 1, node)
        if by_drone and may_launch(world.type[k], now.route[slot], now.sortie[slot], trip):
            for p in range(first, last):
                offer_sorties(world, searcher, slot, p, node)
            leave = now.stop[slot, first].leave
            # Who would have to wait for a flight from the depot may fly when the trip is over.
            soonest = held_until(opening(world.place[0, node], leave), endurance_of(world.type[k]))
            if leave < soonest:
                offer_sorties(world, searcher, slot, last, node)
    if world.visits[k] > 1 and by_drone:
        offer_joining(world, searcher, slot, node)
    take_cheapest(world, searcher, node)


@pasted
def is_kept(searcher: Searcher, slot: int, node: int) -> bool:
    """Tell whether the best place kept for a customer on a route is still that, or none is."""
    row = searcher.kept[node, slot]
    return (row.stamp == searcher.now.route[slot].stamp
            and (searcher.kept_move[node, slot].kind >= 0
                 or searcher.kept_cost[node, slot] >= searcher.bound.best))


@pasted
def take_kept(searcher: Searcher, slot: int, node: int) -> None:
    """Let the move be the place kept for a customer on a route if it is the best. In place."""
    cost = searcher.kept_cost[node, slot]
    if cost < searcher.bound.best and uniform(searcher.rng) >= searcher.bound.blink:
        searcher.bound.best = cost
        copy_move(searcher.kept_move[node, slot], searcher.move)


@pasted
def keep(searcher: Searcher, slot: int, node: int, before: float) -> None:
    """Keep what was found for a customer on a route, which cost less than `before`, or nothing.

    In place.
    """
    row, best = searcher.kept[node, slot], searcher.bound.best
    row.stamp = searcher.now.route[slot].stamp
    searcher.kept_cost[node, slot] = best
    copy_move(searcher.move, searcher.kept_move[node, slot])
    if best >= before:
        searcher.kept_move[node, slot].kind = NOWHERE


@pasted
def try_routes(world: World, searcher: Searcher, node: int, enlarge: bool) -> None:
    """Try a customer on all routes, those first where that takes little. As `try_route`.

    Most turns are undone, so that most routes are as when the customer was inserted before. If the
    best place there is overlooked, so is the route.
    """
    now, bound = searcher.now, searcher.bound
    for costly in (False, True):
        for index in range(searcher.count.active):
            slot = searcher.active[index]
            k = now.route[slot].type
            if not (world.can[k, 0, node] or world.can[k, 1, node]):
                continue
            if rung(world.stop):
                return
            known = world.keeps and not enlarge and now.route[slot].stamp != CHANGING
            if known and is_kept(searcher, slot, node):
                if not costly:
                    take_kept(searcher, slot, node)
                continue
            if costly != (world.can[k, 1, node] or not is_simple(world, now, slot)):
                continue
            before = bound.best
            bound.blink = 0.0 if known else world.blink
            try_route(world, searcher, slot, node, enlarge)
            bound.blink = world.blink
            if known:
                keep(searcher, slot, node, before)


@pasted
def find_place(world: World, searcher: Searcher, node: int, enlarge: bool) -> float:
    """Find the cheapest insertion of a customer; return its cost, INFEASIBLE if there is none.

    In place: `searcher.move`, and what is kept.
    """
    now, bound, move = searcher.now, searcher.bound, searcher.move
    best = try_new_route(world, searcher, node)
    if not world.general:
        return scan_lean(world, now, searcher.active, searcher.count.active, node, best,
                         enlarge, searcher.kept, move, searcher.rng)
    bound.best, bound.blink = best, world.blink
    try_routes(world, searcher, node, enlarge)
    return bound.best


@pasted
def find_beside(world: World, searcher: Searcher, node: int, enlarge: bool) -> float:
    """Find the cheapest insertion of a customer beside its neighbours. As `find_place`."""
    now, bound, move = searcher.now, searcher.bound, searcher.move
    best = try_new_route(world, searcher, node)
    if not world.general:
        best = scan_beside_lean(world, now, node, best, enlarge, move, searcher.rng)
        return scan_passing_lean(world, now, searcher.active, searcher.count.active, node, best,
                                 enlarge, move, searcher.rng)
    best = scan_beside(world, now, node, best, enlarge, move, searcher.rng)
    bound.best, bound.blink = best, world.blink
    for rank in range(world.fit.shape[1]):
        other = int(world.fit[node, rank])
        slot = now.where[other].slot
        if slot < 0:
            continue
        k = now.route[slot].type
        p = stop_beside(now, other)
        index = now.stop[slot, p].trip
        trip = now.trip[slot, index]
        by_truck = (world.can[k, 0, node] and not is_simple(world, now, slot)
                    and allows_stops(world.type[k], stops_on(trip) + 1))
        by_drone = world.can[k, 1, node] and may_launch(
            world.type[k], now.route[slot], now.sortie[slot], trip)
        if (not (by_truck or by_drone) or not may_fit(world, now, slot, index, k, node)
                or not goods_may_join(world, now, slot, index, node)):
            continue
        first = max(p - 1, trip.first)
        if by_truck:
            # Nobody is served behind the depot.
            offer_stops(world, searcher, slot, first, min(p, trip.last - 1), node)
        if by_drone:
            for q in range(first, p + 1):
                offer_sorties(world, searcher, slot, q, node)
    take_cheapest(world, searcher, node)
    return bound.best


@inlined
def opens_route(move: Record) -> bool:
    """Tell whether an insertion is on a route of its own."""
    return move.kind == NEW_ROUTE or move.kind == NEW_FLIGHT


@spliced
def try_trips(world: World, searcher: Searcher, node: int, number: int) -> float:
    """Try a customer on a trip more of so many routes, or where one of theirs is split.

    Follows `find_place` or `find_beside`; returns the cost of the cheapest insertion so far. Where
    these are not all routes, they are drawn. In place: `searcher.move`.
    """
    now, active = searcher.now, searcher.count.active
    first = below(searcher.rng, active) if number < active else 0
    for index in range(first, first + min(number, active)):
        slot = searcher.active[index if index < active else index - active]
        k = now.route[slot].type
        if (now.route[slot].trips >= world.type[k].max_trips or rung(world.stop)
                or not goods_may_follow(world, now, slot, node)):
            continue
        if world.can[k, 0, node] and is_apart(world, k):
            offer_trips_apart(world, searcher, slot, node)
        elif world.can[k, 0, node]:
            offer_trips(world, searcher, slot, node)
        if world.can[k, 1, node]:
            offer_flight_trips(world, searcher, slot, node)
    take_cheapest(world, searcher, node)
    return searcher.bound.best
