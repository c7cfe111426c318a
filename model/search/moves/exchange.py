"""Moves of whole parts: tails between routes, into a new route or behind another, and types."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.copying import copy_row
from model.kernel.instance import (
    RATE_FIXED, RATE_KM, TYPE_END,
    TYPE_MAX_TRIPS, TYPE_START, TYPE_TRAVEL,
)
from model.kernel.leg import leg, legs_of
from model.kernel.load import NOTHING, demand_of, holds, plus
from model.search.route.edit import put
from model.search.route.layout import (
    CUSTOMER, END, F_LAUNCH, F_RECOVERY, NOWHERE, R_LENGTH, R_SORTIES, R_TRIPS, R_TYPE, START,
    S_FLYING, S_KIND, S_LATEST, S_LEAVE, S_LEG, S_NODE, S_TRIP, W_POSITION, W_SLOT, Fleet, World,
)
from model.search.route.refresh import any_customer, locate, refresh
from model.search.route.state import Searcher, free_slot, keep_aside, touch

NEIGHBOURS = 16
"""With how many neighbours' routes a tail is tried."""


@inlined
def rest_distance(fleet: Fleet, slot: int, p: int) -> int:
    """Return how far a route goes on from stop `p`."""
    distance = 0
    for q in range(p, fleet.route[slot, R_LENGTH]):
        distance += fleet.stop[slot, q, S_LEG]
    return distance


@spliced
def tail_saving(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> float:
    """Return what it costs to swap what follows stop `p` of route `a` and stop `q` of route `b`.

    By distance alone; infinite where a tail would be reached too late.
    """
    k, by = fleet.route[a, R_TYPE], fleet.route[b, R_TYPE]
    legs = legs_of(world.leg, world.type[k, TYPE_TRAVEL])
    one, other = fleet.stop[a], fleet.stop[b]
    here, there = one[p, S_NODE], other[q, S_NODE]
    after_here, after_there = one[p + 1, S_NODE], other[q + 1, S_NODE]
    to_other, to_one = leg(legs, here, after_there), leg(legs, there, after_here)
    if (one[p, S_LEAVE] + to_other.duration > other[q + 1, S_LATEST]
            or other[q, S_LEAVE] + to_one.duration > one[p + 1, S_LATEST]):
        return math.inf
    rate, rate_by = world.rate[k, RATE_KM], world.rate[by, RATE_KM]
    cost = ((to_other.distance - one[p, S_LEG]) * rate
            + (to_one.distance - other[q, S_LEG]) * rate_by)
    if rate != rate_by:
        longer = rest_distance(fleet, b, q + 1) - rest_distance(fleet, a, p + 1)
        cost += longer * (rate - rate_by)
    return cost


@spliced
def find_tail(world: World, searcher: Searcher, a: int, p: int, limit: float) -> tuple[int, int]:
    """Return the route and the stop whose tail is best swapped with that behind stop `p`.

    The route is NOWHERE if none is worth less than `limit`, or an empty slot for a new route.
    """
    now = searcher.now
    k = now.route[a, R_TYPE]
    node = now.stop[a, p, S_NODE]
    chosen, place, best = NOWHERE, 0, limit
    for rank in range(min(NEIGHBOURS, world.near.shape[1])):
        other = world.near[node, rank]
        if other < 0:
            break
        b, q = now.where[other, W_SLOT], now.where[other, W_POSITION] - 1
        if b < 0 or q < 0 or b == a or now.stop[b, q, S_FLYING] > 0:
            continue
        by = now.route[b, R_TYPE]
        if by != k and not world.swap[k, by]:
            continue
        cost = tail_saving(world, now, a, p, b, q)
        if cost < best:
            chosen, place, best = b, q, cost
    if now.stop[a, p + 1, S_KIND] == CUSTOMER:
        legs = legs_of(world.leg, world.type[k, TYPE_TRAVEL])
        start, end = world.type[k, TYPE_START], world.type[k, TYPE_END]
        detour = (leg(legs, node, end).distance - now.stop[a, p, S_LEG]
                  + leg(legs, start, now.stop[a, p + 1, S_NODE]).distance)
        if world.rate[k, RATE_FIXED] + detour * world.rate[k, RATE_KM] < best:
            slot = free_slot(world, searcher, k)
            if slot >= 0:
                return slot, 0
    return chosen, place


@inlined
def append(source: Fleet, slot: int, first: int, behind: int, to: int) -> None:
    """Append stops `first` to `behind - 1` of a route, and sorties from there, to another.

    In place.
    """
    route = source.route[to]
    shift = route[R_LENGTH] - first
    for p in range(first, behind):
        put(source.stop[to], p + shift, source.stop[slot, p, S_NODE], source.stop[slot, p, S_KIND])
    route[R_LENGTH] += behind - first
    for s in range(source.route[slot, R_SORTIES]):
        launch = source.sortie[slot, s, F_LAUNCH]
        if first <= launch < behind:
            copy = source.sortie[to, route[R_SORTIES]]
            copy_row(source.sortie[slot, s], copy)
            copy[F_LAUNCH] += shift
            copy[F_RECOVERY] += shift
            route[R_SORTIES] += 1


@inlined
def swap_tails(world: World, searcher: Searcher, a: int, p: int, b: int, q: int) -> bool:
    """Swap tails; `b` may be an empty slot. In place; False if that breaks a rule."""
    now = searcher.now
    touch(searcher, a)
    touch(searcher, b)
    one, two = len(now.route) - 2, len(now.route) - 1
    k = now.route[a, R_TYPE]
    if now.route[b, R_LENGTH] == 0:
        now.route[b, R_TYPE], now.route[b, R_LENGTH], now.route[b, R_SORTIES] = k, 2, 0
        put(now.stop[b], 0, world.type[k, TYPE_START], START)
        put(now.stop[b], 1, world.type[k, TYPE_END], END)
        now.used[k] += 1
    keep_aside(now, a, one)
    keep_aside(now, b, two)
    for slot, keep in ((a, p + 1), (b, q + 1)):
        mine, others, cut = (one, two, q + 1) if slot == a else (two, one, p + 1)
        now.route[slot, R_LENGTH] = now.route[slot, R_SORTIES] = 0
        append(now, mine, 0, keep, slot)
        append(now, others, cut, now.route[others, R_LENGTH], slot)
    done = True
    for slot in (a, b):
        if now.route[slot, R_LENGTH] == 2 and now.route[slot, R_SORTIES] == 0:
            now.route[slot, R_LENGTH] = now.route[slot, R_TRIPS] = 0
            now.cost[slot] = 0.0
            now.used[now.route[slot, R_TYPE]] -= 1
        elif done:
            done = refresh(world, now, slot, searcher.acc)
            locate(now, slot)
    return done


@inlined
def overloads(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether the trip that begins before stop `p` of `a` and goes on behind `q` of `b` does.

    Stops of the truck alone are counted.
    """
    load, index = NOTHING, p
    while fleet.stop[a, index, S_KIND] == CUSTOMER:
        load = plus(load, demand_of(world.place[fleet.stop[a, index, S_NODE]]))
        index -= 1
    index = q + 1
    while fleet.stop[b, index, S_KIND] == CUSTOMER:
        load = plus(load, demand_of(world.place[fleet.stop[b, index, S_NODE]]))
        index += 1
    return not holds(world.type[fleet.route[a, R_TYPE]], load)


@inlined
def too_long(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether route `a` up to stop `p`, then `b` behind stop `q`, has too many trips."""
    trips = fleet.stop[a, p, S_TRIP] + fleet.route[b, R_TRIPS] - fleet.stop[b, q, S_TRIP]
    sorties = fleet.route[a, R_SORTIES] + fleet.route[b, R_SORTIES]
    return (trips > world.type[fleet.route[a, R_TYPE], TYPE_MAX_TRIPS]
            or sorties > fleet.sortie.shape[1])


@inlined
def leaves_nothing(fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether route `b` up to stop `q`, then `a` behind stop `p`, has a trip to nobody."""
    nobody = fleet.stop[b, q, S_KIND] == START and fleet.stop[a, p + 1, S_KIND] == END
    return nobody and not (q == 0 and p + 2 == fleet.route[a, R_LENGTH])


@spliced
def exchange_tails(world: World, searcher: Searcher, limit: float) -> bool:
    """Swap the tail behind a random stop if that may cost less than `limit`.

    In place; tells whether routes were changed and keep all rules; if not, they may be broken.
    """
    now = searcher.now
    node = any_customer(world, now, searcher.rng)
    a, p = now.where[node, W_SLOT], now.where[node, W_POSITION]
    if a < 0 or p < 0 or now.stop[a, p, S_FLYING] > 0:
        return False
    b, q = find_tail(world, searcher, a, p, limit)
    if b < 0:
        return False
    if now.route[b, R_LENGTH] > 0 and (
            leaves_nothing(now, a, p, b, q)
            or overloads(world, now, a, p, b, q) or overloads(world, now, b, q, a, p)
            or too_long(world, now, a, p, b, q) or too_long(world, now, b, q, a, p)):
        return False
    return swap_tails(world, searcher, a, p, b, q)
