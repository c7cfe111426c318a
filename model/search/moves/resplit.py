"""Trips with one drone planned anew from an order of their customers.

A part of a trip, or two routes together, the depot between them among what is moved: so a route is
split in two, or two become one, with the drones' share of each chosen anew at once.
"""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.load import NOTHING, demand_of, holds, plus
from model.kernel.records import Record, Records
from model.kernel.shift import overtime
from model.search.moves.exchange import append
from model.search.moves.split import (
    NEIGHBOURS, NO_FLIGHT, measure, present_cost, shift, shuffle, split,
)
from model.search.route.edit import add_sortie, put
from model.search.route.layout import CUSTOMER, MODE_PRICED, NOWHERE, Fleet, World
from model.search.route.randomness import below, uniform
from model.search.route.refresh import draw_customer, idle_time, locate, refresh, stop_beside
from model.search.route.state import Searcher, free_slot, keep_aside, touch

WINDOW = 12
"""Stops before, and behind, a random one that are planned anew."""

TOGETHER = 0.2
"""How often two routes are planned anew together, where both have no more than two `WINDOW`."""

CUT_ELSEWHERE = 0.5
"""How often of these nothing is moved but the depot between them."""

SAME = 1e-12
"""Costs that differ by a smaller share are the same."""


@inlined
def flown_over(fleet: Fleet, slot: int, p: int) -> bool:
    """Tell whether a drone is launched before stop `p` and recovered behind it."""
    over = False
    for s in range(fleet.route[slot].sorties):
        over = over or fleet.sortie[slot, s].launch < p < fleet.sortie[slot, s].recovery
    return over


@inlined
def window(fleet: Fleet, slot: int, p: int) -> tuple[int, int]:
    """Return the stops around `p` between which all that is launched is recovered."""
    trip = fleet.trip[slot, fleet.stop[slot, p].trip]
    first, last = max(trip.first, p - WINDOW), min(trip.last, p + WINDOW)
    while flown_over(fleet, slot, first):
        first -= 1
    while flown_over(fleet, slot, last):
        last += 1
    return first, last


@spliced
def line_up(fleet: Fleet, slot: int, first: int, last: int, line: Records) -> tuple[int, bool]:
    """Write the places of stops `first` to `last` in the order they are left for.

    And the operations as they are. Returns how many places there are, 0 if a sortie serves several
    customers, and whether all that the drone does is such operations.
    """
    stops, sorties = fleet.stop[slot], fleet.sortie[slot]
    length = begin = s = 0
    landing, flown, exact = first, NO_FLIGHT, True
    while s < fleet.route[slot].sorties and sorties[s].launch < first:
        s += 1
    for p in range(first, last + 1):
        line[length].node = stops[p].node
        if p == landing:
            line[length].before, line[length].flight = begin, flown
            begin, flown, landing = length, NO_FLIGHT, p + 1
        length += 1
        while p < last and s < fleet.route[slot].sorties and sorties[s].launch == p:
            if sorties[s].count > 1:
                return 0, False
            if sorties[s].recovery > p:
                exact = exact and length == begin + 1
                flown, landing = length, sorties[s].recovery
            line[length].node = sorties[s].nodes[0]
            length += 1
            s += 1
    return length, exact


@inlined
def beside(rate: Record) -> float:
    """Return what a route costs beside its operations, of which the last ends at no customer."""
    return rate.fixed - rate.stop


@spliced
def line_up_all(world: World, fleet: Fleet, k: int, slot: int, other: int, first: int, last: int,
                line: Records) -> tuple[int, float, bool, int]:
    """Write the places of stops `first` to `last` of a route, then those of the other, if any.

    Returns how many places there are, 0 if that can't be, what the operations cost if that is all
    that the drones do, whether it is, and how long (ms) trucks wait, or work overtime.
    """
    length, before, exact, idle = 1, 0.0, True, 0
    member = slot
    while member >= 0:
        begin = length - 1
        if fleet.route[member].length > 0:
            count, whole = line_up(fleet, member, first, last, line[begin:])
            if count == 0:
                return 0, 0.0, False, 0
            exact, idle = exact and whole, idle + idle_time(fleet.route[member])
            if world.rate[k].overtime > 0.0:
                idle += overtime(world.type[k], fleet.route[member].end,
                                 fleet.route[member].working)
            if exact:
                measure(world, k, line[begin:], count)
                before += present_cost(world, k, line[begin:], count) + beside(world.rate[k])
            length = begin + count
        else:
            line[length].node = line[begin].node
            length += 1
        member, first = other if member == slot else NOWHERE, 0
        if member >= 0:
            last = fleet.route[member].length - 1
    return length, before, exact, idle


@inlined
def ends_in_flight(fleet: Fleet, slot: int) -> bool:
    """Tell whether a drone is launched at the last stop of a route, which no line knows of."""
    last = fleet.route[slot].sorties - 1
    return last >= 0 and fleet.sortie[slot, last].launch == fleet.route[slot].length - 1


@spliced
def partner(world: World, searcher: Searcher, slot: int, node: int) -> int:
    """Return a route to plan anew together with a customer's: that of a near neighbour.

    An empty slot if that is the same route; NOWHERE if there is none.
    """
    now = searcher.now
    route, k = now.route[slot], now.route[slot].type
    near = int(world.near[node, below(searcher.rng, min(NEIGHBOURS, world.near.shape[1]))])
    # The end of the one route is the start of the other in a line.
    if (near < 0 or route.trips > 1 or ends_in_flight(now, slot)
            or world.type[k].begins_at != world.type[k].ends_at):
        return NOWHERE
    other = now.where[near].slot
    if other == slot:
        other = free_slot(world, searcher, k)
    if other < 0:
        return NOWHERE
    mate = now.route[other]
    if mate.length > 0 and (mate.type != k or mate.trips > 1
                               or ends_in_flight(now, other)):
        return NOWHERE
    return other if route.length + mate.length <= 2 * WINDOW else NOWHERE


@inlined
def depot_between(world: World, line: Records, length: int) -> int:
    """Return where in a line of two routes the first ends, or the end of a line of one."""
    place = 1
    while place < length - 1 and line[place].node >= world.num_depots:
        place += 1
    return place


@inlined
def is_worth(world: World, k: int, idle: int, before: float, after: float, limit: float) -> bool:
    """Tell whether operations that cost so much before and after may cost less than `limit` more.

    Where windows make trucks wait (`idle`, ms), or count themselves, that says nothing; nor where
    time saved is overtime.
    """
    if world.mode[k] & MODE_PRICED or idle > 0:
        return True
    return after < before + limit and abs(after - before) > SAME * before


@spliced
def overloads(world: World, k: int, line: Records, begin: int, end: int) -> bool:
    """Tell whether the customers between two places of the line are too much for a truck.

    There may be no room for so many stops and sorties then, so that it has to be known before.
    """
    load = NOTHING
    for place in range(begin + 1, end):
        load = plus(load, demand_of(world.place[0, line[place].node]))
    return not holds(world.type[k], load)


@spliced
def split_all(world: World, searcher: Searcher, k: int, cut: int, length: int) -> float:
    """Cut the line, or both routes in it, at least cost; return that. In place; maybe infinite.

    `cut` is as `depot_between` says.
    """
    line, cost = searcher.line, searcher.line_cost
    total, begin, end = 0.0, 0, cut
    while begin < length - 1:
        if end > begin + 1:
            if overloads(world, k, line, begin, end):
                return math.inf
            count = end - begin + 1
            measure(world, k, line[begin:], count)
            if not split(world, k, line[begin:], cost[begin:], count):
                return math.inf
            total += cost[end] + beside(world.rate[k])
        begin, end = end, length - 1
    return total


@inlined
def write_operations(route: Record, stops: Records, sorties: Records, line: Records,
                     length: int, kind: int) -> None:
    """Append the stops that the operations make, but for the last. In place; turns `before` round.

    `kind` is that of the first stop.
    """
    j, behind = length - 1, NOWHERE
    while j > 0:
        before = line[j].before
        line[j].before = behind
        behind, j = j, before
    line[0].before = behind
    put(stops, route.length, line[0].node, kind)
    i = 0
    while i < length - 1:
        j, p = line[i].before, route.length
        flown = line[j].flight
        if flown != NO_FLIGHT:
            add_sortie(route, sorties, p, p + j - i - 1, 0, line[flown].node)
        for place in range(i + 1, j):
            if flown == NO_FLIGHT:
                add_sortie(route, sorties, p, p, 0, line[place].node)
            elif place != flown:
                route.length += 1
                put(stops, route.length, line[place].node, CUSTOMER)
        route.length += 1
        if j < length - 1:
            put(stops, route.length, line[j].node, CUSTOMER)
        i = j


@spliced
def write_all(world: World, searcher: Searcher, slot: int, other: int, first: int, last: int,
              cut: int, length: int) -> bool:
    """Write what the line says into stops `first` to `last` of a route, and into the other, if any.

    In place; False if that breaks a rule.
    """
    now, line = searcher.now, searcher.line
    k, spare, behind = now.route[slot].type, len(now.route) - 2, now.route[slot].length
    touch(searcher, slot)
    if other >= 0:
        touch(searcher, other)
    keep_aside(now, slot, spare)
    begin, end, member, done = 0, cut, slot, True
    while member >= 0:
        route = now.route[member]
        if route.length > 0:
            now.used[k] -= 1
        route.length = route.sorties = route.trips = 0
        now.cost[member] = 0.0
        if end > begin + 1:
            route.type = k
            now.used[k] += 1
            append(now, spare, 0, first, member)
            write_operations(route, now.stop[member], now.sortie[member], line[begin:],
                             end - begin + 1, now.stop[spare, first].kind)
            append(now, spare, last, behind, member)
            done = refresh(world, now, member, searcher.acc) and done
            locate(now, member)
        begin, end, member = end, length - 1, other if member == slot else NOWHERE
    return done


@spliced
def resplit(world: World, searcher: Searcher, limit: float) -> bool:
    """Plan part of a trip with one drone, or two routes, anew from a changed order of customers.

    In place; tells whether routes were changed and keep all rules; if not, they may be broken.
    Nothing is changed that would cost more than `limit`.
    """
    now, line, rng = searcher.now, searcher.line, searcher.rng
    node = draw_customer(world, now, searcher.count.focus, rng)
    slot = now.where[node].slot
    if slot < 0 or world.type[now.route[slot].type].drones != 1:
        return False
    k, other = now.route[slot].type, NOWHERE
    if uniform(rng) < TOGETHER:
        other = partner(world, searcher, slot, node)
    first, last = 0, now.route[slot].length - 1
    if other < 0:
        first, last = window(now, slot, stop_beside(now, node))
    length, before, exact, idle = line_up_all(world, now, k, slot, other, first, last, line)
    if length < 4:
        return False
    if other >= 0 and uniform(rng) < CUT_ELSEWHERE:
        shift(line, depot_between(world, line, length), 1 + below(rng, length - 2))
    else:
        shuffle(world, line, length, rng)
    cut = depot_between(world, line, length)
    after = split_all(world, searcher, k, cut, length)
    if after == math.inf or (exact and not is_worth(world, k, idle, before, after, limit)):
        return False
    return write_all(world, searcher, slot, other, first, last, cut, length)
