"""Moves of whole parts: tails between routes, into a new route or behind another, and types."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.leg import TravelLegs, leg, legs_of
from model.kernel.load import (
    EMPTY, NOTHING, barred_on_trip, cargo_at, demand_of, followed, go_together, holds, may_be_all,
    may_follow, plus,
)
from model.kernel.shift import allows_stops
from model.search.route.edit import put
from model.search.route.layout import CUSTOMER, END, NOWHERE, START, Fleet, World
from model.search.route.rarer import goods_count, tiers_aboard
from model.search.route.refresh import draw_customer, locate, refresh
from model.search.route.state import Searcher, free_slot, keep_aside, touch

NEIGHBOURS = 16
"""With how many neighbours' routes a tail is tried."""


@inlined
def rest_distance(fleet: Fleet, slot: int, p: int) -> int:
    """Return how far a route goes on from stop `p`."""
    distance = 0
    for q in range(p, fleet.route[slot].length):
        distance += fleet.stop[slot, q].leg
    return distance


@inlined
def longer_home(legs: TravelLegs, fleet: Fleet, slot: int, end: int) -> int:
    """Return how much longer a route's last leg is to another end."""
    last = fleet.stop[slot, fleet.route[slot].length - 2]
    return leg(legs, last.node, end).distance - last.leg


@spliced
def may_serve_tail(world: World, fleet: Fleet, k: int, slot: int, p: int) -> bool:
    """Tell whether type `k` may serve all customers of a route of one trip behind stop `p`."""
    for index in range(p + 1, fleet.route[slot].length - 1):
        if not world.can[k, 0, fleet.stop[slot, index].node]:
            return False
    return True


@spliced
def tail_saving(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> float:
    """Return what it costs to swap what follows stop `p` of route `a` and stop `q` of route `b`.

    By distance alone; infinite where a tail would be reached too late.
    """
    k, by = fleet.route[a].type, fleet.route[b].type
    legs = legs_of(world.leg, world.type[k].travel)
    one, other = fleet.stop[a], fleet.stop[b]
    here, there = one[p].node, other[q].node
    after_here, after_there = one[p + 1].node, other[q + 1].node
    end, end_by = world.type[k].ends_at, world.type[by].ends_at
    if end != end_by:
        after_here = end_by if one[p + 1].kind == END else after_here
        after_there = end if other[q + 1].kind == END else after_there
    to_other, to_one = leg(legs, here, after_there), leg(legs, there, after_here)
    if (one[p].leave + to_other.duration > other[q + 1].latest
            or other[q].leave + to_one.duration > one[p + 1].latest):
        return math.inf
    rate, rate_by = world.rate[k].distance, world.rate[by].distance
    cost = ((to_other.distance - one[p].leg) * rate
            + (to_one.distance - other[q].leg) * rate_by)
    if end != end_by:
        if other[q + 1].kind != END:
            cost += longer_home(legs, fleet, b, end) * rate
        if one[p + 1].kind != END:
            cost += longer_home(legs, fleet, a, end_by) * rate_by
    if rate != rate_by:
        longer = rest_distance(fleet, b, q + 1) - rest_distance(fleet, a, p + 1)
        cost += longer * (rate - rate_by)
    more = (fleet.route[b].length - q) - (fleet.route[a].length - p)
    return cost + more * (world.rate[k].stop - world.rate[by].stop)


@spliced
def find_tail(world: World, searcher: Searcher, a: int, p: int, limit: float) -> tuple[int, int]:
    """Return the route and the stop whose tail is best swapped with that behind stop `p`.

    The route is NOWHERE if none is worth less than `limit`, or an empty slot for a new route.
    """
    now = searcher.now
    k = now.route[a].type
    node = now.stop[a, p].node
    chosen, place, best = NOWHERE, 0, limit
    for rank in range(min(NEIGHBOURS, world.near.shape[1])):
        other = int(world.near[node, rank])
        if other < 0:
            break
        b, q = now.where[other].slot, now.where[other].position - 1
        if b < 0 or q < 0 or b == a or now.stop[b, q].flying > 0:
            continue
        by = now.route[b].type
        if by != k and not world.splice[k, by]:
            continue
        cost = tail_saving(world, now, a, p, b, q)
        if cost >= best or not (by == k or world.swap[k, by]
                                or (may_serve_tail(world, now, k, b, q)
                                    and may_serve_tail(world, now, by, a, p))):
            continue
        # Where it matters who comes when, few tails fit: look for one that does.
        if tiers_aboard(now) == 0 or may_swap(world, now, a, p, b, q):
            chosen, place, best = b, q, cost
    if now.stop[a, p + 1].kind == CUSTOMER:
        legs = legs_of(world.leg, world.type[k].travel)
        start, end = world.type[k].begins_at, world.type[k].ends_at
        detour = (leg(legs, node, end).distance - now.stop[a, p].leg
                  + leg(legs, start, now.stop[a, p + 1].node).distance)
        if world.rate[k].fixed + detour * world.rate[k].distance < best:
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
    shift = route.length - first
    for p in range(first, behind):
        put(source.stop[to], p + shift, source.stop[slot, p].node, source.stop[slot, p].kind)
    route.length += behind - first
    for s in range(source.route[slot].sorties):
        launch = source.sortie[slot, s].launch
        if first <= launch < behind:
            source.sortie[to, route.sorties] = source.sortie[slot, s]
            copy = source.sortie[to, route.sorties]
            copy.launch += shift
            copy.recovery += shift
            route.sorties += 1


@inlined
def swap_tails(world: World, searcher: Searcher, a: int, p: int, b: int, q: int) -> bool:
    """Swap tails; `b` may be an empty slot. In place; False if that breaks a rule."""
    now = searcher.now
    touch(searcher, a)
    touch(searcher, b)
    one, two = len(now.route) - 2, len(now.route) - 1
    k = now.route[a].type
    if now.route[b].length == 0:
        now.route[b].type, now.route[b].length, now.route[b].sorties = k, 2, 0
        put(now.stop[b], 0, world.type[k].begins_at, START)
        put(now.stop[b], 1, world.type[k].ends_at, END)
        now.used[k] += 1
    keep_aside(now, a, one)
    keep_aside(now, b, two)
    for slot, keep in ((a, p + 1), (b, q + 1)):
        mine, others, cut = (one, two, q + 1) if slot == a else (two, one, p + 1)
        now.route[slot].length = now.route[slot].sorties = 0
        append(now, mine, 0, keep, slot)
        append(now, others, cut, now.route[others].length, slot)
        if world.splice[k, k]:
            now.stop[slot, now.route[slot].length - 1].node = (
                world.type[now.route[slot].type].ends_at)
    done = True
    for slot in (a, b):
        if now.route[slot].length == 2 and now.route[slot].sorties == 0:
            now.route[slot].length = now.route[slot].trips = 0
            now.cost[slot] = 0.0
            now.used[now.route[slot].type] -= 1
        elif done:
            done = refresh(world, now, slot, searcher.acc)
            locate(now, slot)
    return done


@inlined
def is_cargo(world: World, fleet: Fleet, a: int, p: int, b: int, q: int, tier: int) -> bool:
    """Tell whether a trip up to stop `p` of `a`, which goes on behind `q` of `b`, may carry all."""
    kind, one, other = world.type[fleet.route[a].type], EMPTY, EMPTY
    first = fleet.trip[a, fleet.stop[a, p].trip].first
    for index in range(first, p + 1):
        one = followed(one, cargo_at(fleet.halt[a, tier, index]))
    index = q + 1
    while index < fleet.route[b].length and fleet.stop[b, index].kind != START:
        other = followed(other, cargo_at(fleet.halt[b, tier, index]))
        index += 1
    return may_follow(kind, one, other) and may_be_all(kind, followed(one, other), tier)


@inlined
def overloads(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether the trip that begins before stop `p` of `a` and goes on behind `q` of `b` does.

    Stops of the truck alone are counted, but where more than loads tells.
    """
    load, index = NOTHING, p
    while fleet.stop[a, index].kind == CUSTOMER:
        load = plus(load, demand_of(world.place[0, fleet.stop[a, index].node]))
        index -= 1
    count, index = p - index, q + 1
    while fleet.stop[b, index].kind == CUSTOMER:
        load = plus(load, demand_of(world.place[0, fleet.stop[b, index].node]))
        index += 1
    kind = world.type[fleet.route[a].type]
    allowed = holds(kind, load) and allows_stops(kind, count + index - q - 1)
    for tier in range(tiers_aboard(fleet)):
        allowed = allowed and is_cargo(world, fleet, a, p, b, q, tier)
    return not allowed


@inlined
def clashes(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether goods clash on the trip that `overloads` is asked of."""
    if not goods_count(world):
        return False
    barred, index = 0, p
    while fleet.stop[a, index].kind == CUSTOMER:
        barred |= barred_on_trip(world.goods[fleet.stop[a, index].node])
        index -= 1
    index = q + 1
    while fleet.stop[b, index].kind == CUSTOMER:
        if not go_together(world.goods[fleet.stop[b, index].node], barred, 0):
            return True
        index += 1
    return False


@inlined
def too_long(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether route `a` up to stop `p`, then `b` behind stop `q`, has too many trips."""
    trips = fleet.stop[a, p].trip + fleet.route[b].trips - fleet.stop[b, q].trip
    sorties = fleet.route[a].sorties + fleet.route[b].sorties
    return (trips > world.type[fleet.route[a].type].max_trips
            or sorties > fleet.sortie.shape[1])


@inlined
def leaves_nothing(fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether route `b` up to stop `q`, then `a` behind stop `p`, has a trip to nobody."""
    nobody = fleet.stop[b, q].kind == START and fleet.stop[a, p + 1].kind == END
    return nobody and not (q == 0 and p + 2 == fleet.route[a].length)


@inlined
def may_swap(world: World, fleet: Fleet, a: int, p: int, b: int, q: int) -> bool:
    """Tell whether tails may be swapped, by what trips carry, how many there are, and to whom."""
    return not (leaves_nothing(fleet, a, p, b, q)
                or overloads(world, fleet, a, p, b, q) or overloads(world, fleet, b, q, a, p)
                or clashes(world, fleet, a, p, b, q) or clashes(world, fleet, b, q, a, p)
                or too_long(world, fleet, a, p, b, q) or too_long(world, fleet, b, q, a, p))


@spliced
def exchange_tails(world: World, searcher: Searcher, limit: float) -> bool:
    """Swap the tail behind a random stop if that may cost less than `limit`.

    In place; tells whether routes were changed and keep all rules; if not, they may be broken.
    """
    now = searcher.now
    node = draw_customer(world, now, searcher.count.focus, searcher.rng)
    a, p = now.where[node].slot, now.where[node].position
    if a < 0 or p < 0 or now.stop[a, p].flying > 0:
        return False
    b, q = find_tail(world, searcher, a, p, limit)
    if b < 0:
        return False
    if now.route[b].length > 0 and not may_swap(world, now, a, p, b, q):
        return False
    return swap_tails(world, searcher, a, p, b, q)
