"""Simulated annealing by ruin and recreate.

References
----------
Christiaens and Vanden Berghe (2020), slack induction by string removals for vehicle routing
problems, Transportation Science 54:417-433.
"""

import math

from model.compiled import compiled, inlined
from model.instance import TYPE_DEPOT, TYPE_TRAVEL
from model.problem import UIntArray
from model.search.draw import below, uniform
from model.search.edit import (
    M_FIRST, M_KIND, M_SLOT, M_TYPE, NEW_FLIGHT, NEW_ROUTE, apply, begin_route,
)
from model.search.evaluate import INFEASIBLE
from model.search.exchange import exchange_tails
from model.search.insertion import find_beside, find_place, try_new_route
from model.search.layout import (
    MODE_LEAN, NOWHERE, P_DEMAND, P_EARLIEST, P_LATEST, R_LENGTH, R_SORTIES, R_STAMP, R_TRIPS,
    R_TYPE, W_SLOT, World,
)
from model.search.lean import insert_lean
from model.search.refresh import locate, refresh
from model.search.resplit import resplit
from model.search.retype import change_type, cheapen_types, draw_type, improve_types
from model.search.rows import clear, copy_some
from model.search.ruin import choose, remove_marked
from model.search.state import (
    I_ABSENT, I_ACTIVE, I_BEST_MISSING, I_CUSTOMERS, I_MISSING, I_STAMP, I_TOUCHED, I_TURN, V_BEST,
    V_COOLING, V_COST, V_TEMPERATURE, Searcher, adopt, copy_route, keep_aside, keep_best,
    list_active, touch,
)

MOST_MISSING = 12
"""How many of the customers left out are tried again each turn."""

ENLARGED = 0.2
"""How often a full route may take a larger vehicle to serve a customer more."""

OPENING = 0.03
"""How often the first customer inserted is given a route of its own."""

RESPLITS = 30
"""Trips with one drone planned anew from their order each turn."""

RETYPED = 0.1
"""How often the routes touched are given the vehicles that cost least."""

BY_CHANCE, BY_DEMAND, BY_FAR, BY_CLOSE, BY_WIDTH, BY_LATEST = range(6)
ORDERS = (BY_CHANCE, BY_CHANCE, BY_CHANCE, BY_CHANCE, BY_DEMAND, BY_DEMAND, BY_DEMAND, BY_DEMAND,
          BY_FAR, BY_FAR, BY_CLOSE, BY_WIDTH, BY_WIDTH, BY_LATEST)
CONSTRUCTED = (BY_FAR, BY_WIDTH)


@inlined
def order_key(world: World, order: int, node: int, rng: UIntArray) -> float:
    """Return where a customer comes in an order; least first."""
    place = world.place[node]
    if order == BY_DEMAND:
        return -float(place[P_DEMAND] + place[P_DEMAND + 1] + place[P_DEMAND + 2])
    if order in (BY_FAR, BY_CLOSE):
        distance = float(world.leg[world.type[0, TYPE_TRAVEL], world.type[0, TYPE_DEPOT], node, 1])
        return -distance if order == BY_FAR else distance
    if order == BY_WIDTH:
        return float(place[P_LATEST] - place[P_EARLIEST])
    if order == BY_LATEST:
        return float(place[P_LATEST])
    return uniform(rng)


@inlined
def sort_absent(world: World, searcher: Searcher, first: int, order: int) -> None:
    """Put the customers to insert in order, from number `first` on. In place."""
    absent, key, rng = searcher.absent, searcher.key, searcher.rng
    for index in range(first, searcher.count[I_ABSENT]):
        node = absent[index]
        weight = order_key(world, order, node, rng)
        place = index
        while place > first and key[absent[place - 1]] > weight:
            absent[place] = absent[place - 1]
            place -= 1
        absent[place] = node
        key[node] = weight


@inlined
def open_route(world: World, searcher: Searcher, node: int, k: int, by_drone: bool) -> bool:
    """Serve a customer by a route of its own. In place; False if no slot is free."""
    now = searcher.now
    for slot in range(len(searcher.active)):
        if now.route[slot, R_LENGTH] == 0:
            touch(searcher, slot)
            begin_route(now.route[slot], now.stop[slot], now.sortie[slot], k,
                        world.type[k, TYPE_DEPOT], node, by_drone)
            if not refresh(world, now, slot, searcher.acc):
                now.route[slot, R_LENGTH] = 0
                now.cost[slot] = 0.0
                return False
            now.used[k] += 1
            locate(now, slot)
            list_active(searcher)
            return True
    return False


@inlined
def insert(world: World, searcher: Searcher, node: int) -> bool:
    """Insert a customer where `searcher.move` says. In place; False if that breaks a rule."""
    move, now = searcher.move, searcher.now
    if move[M_KIND] == NEW_ROUTE or move[M_KIND] == NEW_FLIGHT:
        return open_route(world, searcher, node, move[M_TYPE], move[M_KIND] == NEW_FLIGHT)
    slot = move[M_SLOT]
    touch(searcher, slot)
    route = now.route[slot]
    if world.mode[route[R_TYPE]] & MODE_LEAN:
        if move[M_TYPE] != route[R_TYPE]:
            change_type(world, now, slot, move[M_TYPE])
        insert_lean(world, now, slot, move[M_FIRST], node)
        return True
    spare = len(now.route) - 2
    keep_aside(now, slot, spare)
    depot = world.type[route[R_TYPE], TYPE_DEPOT]
    apply(depot, route, now.stop[slot], now.sortie[slot], move, node, 0, 0)
    done = refresh(world, now, slot, searcher.acc)
    if not done:
        keep_aside(now, spare, slot)
        refresh(world, now, slot, searcher.acc)
    locate(now, slot)
    return done


@inlined
def recreate(world: World, searcher: Searcher, first: int, scan_all: bool) -> None:
    """Insert the absent customers from number `first` on, each where it costs least. In place."""
    absent, count = searcher.absent, searcher.count
    enlarge = world.traded and uniform(searcher.rng) < ENLARGED
    opening = uniform(searcher.rng) < OPENING
    left = first
    for index in range(first, count[I_ABSENT]):
        node = absent[index]
        cost = INFEASIBLE
        if opening and index == first:
            cost = try_new_route(world, searcher.now, searcher.alone, node, cost, searcher.move,
                                 searcher.rng)
        elif not scan_all:
            cost = find_beside(world, searcher.now, searcher.alone, node, enlarge,
                               searcher.move, searcher.trial, searcher.rng, searcher.acc)
        if cost == INFEASIBLE:
            cost = find_place(world, searcher.now, searcher.alone, searcher.active,
                              count[I_ACTIVE], node, enlarge, searcher.move, searcher.trial,
                              searcher.rng, searcher.acc)
        wanted = cost < world.unassigned_cost or (opening and index == first)
        if cost == INFEASIBLE or not wanted or not insert(world, searcher, node):
            absent[left] = node
            left += 1
    count[I_ABSENT] = left


@inlined
def begin_turn(searcher: Searcher) -> int:
    """List some of the customers left out as absent. In place; return how many are not tried."""
    count, absent, missing = searcher.count, searcher.absent, searcher.missing
    count[I_TURN] += 1
    count[I_TOUCHED] = 0
    total = count[I_MISSING]
    copy_some(missing, absent, total)
    alone = max(0, total - MOST_MISSING)
    for index in range(total - 1, alone - 1, -1):
        other = below(searcher.rng, index + 1)
        absent[index], absent[other] = absent[other], absent[index]
    count[I_ABSENT] = total
    return alone


@inlined
def ruin(world: World, searcher: Searcher, first: int) -> None:
    """Remove strings of customers near each other. In place."""
    count, now = searcher.count, searcher.now
    before = count[I_ABSENT]
    total, num_touched = choose(
        world, now, searcher.active, count[I_ACTIVE], count[I_CUSTOMERS], searcher.marked,
        searcher.absent, before, searcher.moved, searcher.hit, count[I_TURN], searcher.rng)
    emptied = False
    for index in range(num_touched):
        touch(searcher, searcher.moved[index])
    for index in range(num_touched):
        slot = searcher.touched[index]
        total = remove_marked(world, now, slot, searcher.marked, searcher.absent, total,
                              searcher.moved, searcher.acc)
        if now.route[slot, R_LENGTH] == 0:
            emptied = True
        else:
            locate(now, slot)
    for index in range(before, total):
        searcher.marked[searcher.absent[index]] = False
        now.where[searcher.absent[index], W_SLOT] = NOWHERE
    count[I_ABSENT] = total
    if emptied:
        list_active(searcher)


@inlined
def turn_cost(world: World, searcher: Searcher) -> float:
    """Return the cost of the routes as they are after this turn."""
    cost = searcher.value[V_COST]
    for index in range(searcher.count[I_TOUCHED]):
        slot = searcher.touched[index]
        cost += searcher.now.cost[slot] - searcher.before.cost[slot]
    more = searcher.count[I_ABSENT] - searcher.count[I_MISSING]
    return cost + more * world.unassigned_cost


@inlined
def rarer_absences(searcher: Searcher) -> bool:
    """Tell whether as many are left out after this turn as before, but who seldom were.

    Counts the absences. In place.
    """
    count, absences = searcher.count, searcher.absences
    before = after = 0
    for index in range(count[I_MISSING]):
        before += absences[searcher.missing[index]]
    for index in range(count[I_ABSENT]):
        after += absences[searcher.absent[index]]
        absences[searcher.absent[index]] += 1
    return count[I_ABSENT] == count[I_MISSING] and after < before


@inlined
def undo(searcher: Searcher) -> None:
    """Take back this turn. In place."""
    now, before = searcher.now, searcher.before
    for index in range(searcher.count[I_TOUCHED]):
        slot = searcher.touched[index]
        if now.route[slot, R_LENGTH] > 0:
            now.used[now.route[slot, R_TYPE]] -= 1
        copy_route(before, slot, now, slot)
        if now.route[slot, R_LENGTH] > 0:
            now.used[now.route[slot, R_TYPE]] += 1
            locate(now, slot)
    for index in range(searcher.count[I_MISSING]):
        now.where[searcher.missing[index], W_SLOT] = NOWHERE
    list_active(searcher)


@inlined
def accept(searcher: Searcher, cost: float) -> None:
    """Go on from this turn's routes. In place."""
    count = searcher.count
    count[I_STAMP] += 1
    for index in range(count[I_TOUCHED]):
        searcher.now.route[searcher.touched[index], R_STAMP] = count[I_STAMP]
    count[I_MISSING] = count[I_ABSENT]
    copy_some(searcher.absent, searcher.missing, count[I_ABSENT])
    searcher.value[V_COST] = cost


@inlined
def move_parts(world: World, searcher: Searcher, tails: bool) -> None:
    """Swap tails of routes, or plan a trip anew, if that is accepted. In place."""
    value, count = searcher.value, searcher.count
    limit = -value[V_TEMPERATURE] * math.log(1.0 - uniform(searcher.rng))
    count[I_TOUCHED] = 0
    count[I_ABSENT] = count[I_MISSING]
    changed = (exchange_tails(world, searcher, limit) if tails
               else resplit(world, searcher, limit))
    if changed:
        if world.traded and uniform(searcher.rng) < RETYPED:
            improve_types(world, searcher)
        cost = turn_cost(world, searcher)
        if cost < value[V_COST] + limit:
            copy_some(searcher.missing, searcher.absent, count[I_MISSING])
            list_active(searcher)
            accept(searcher, cost)
            if cost < value[V_BEST]:
                keep_best(searcher)
            return
    if count[I_TOUCHED] > 0:
        undo(searcher)


@inlined
def disband(searcher: Searcher) -> None:
    """Take all routes apart. In place."""
    now, count = searcher.now, searcher.count
    count[I_STAMP] += 1
    for slot in range(len(searcher.active)):
        now.route[slot, R_STAMP] = count[I_STAMP]
        now.route[slot, R_LENGTH] = now.route[slot, R_SORTIES] = now.route[slot, R_TRIPS] = 0
        now.cost[slot] = 0.0
    clear(now.used)
    count[I_ABSENT] = 0
    for node in range(len(now.where)):
        if now.where[node, W_SLOT] >= 0:
            now.where[node, W_SLOT] = NOWHERE
            searcher.missing[count[I_MISSING]] = node
            count[I_MISSING] += 1
    list_active(searcher)


@inlined
def insert_missing(world: World, searcher: Searcher, order: int) -> None:
    """Insert all customers left out, one after another. In place."""
    count = searcher.count
    count[I_TURN] += 1
    count[I_TOUCHED] = 0
    count[I_ABSENT] = count[I_MISSING]
    copy_some(searcher.missing, searcher.absent, count[I_MISSING])
    sort_absent(world, searcher, 0, order)
    recreate(world, searcher, 0, True)
    accept(searcher, turn_cost(world, searcher))
    if searcher.value[V_COST] < searcher.value[V_BEST]:
        keep_best(searcher)


@inlined
def construct(world: World, searcher: Searcher) -> None:
    """Plan anew by insertion in the best of several orders. In place."""
    count, value = searcher.count, searcher.value
    for order in CONSTRUCTED:
        disband(searcher)
        value[V_COST] = count[I_MISSING] * world.unassigned_cost
        insert_missing(world, searcher, order)
    adopt(searcher, searcher.best, searcher.best_missing, count[I_BEST_MISSING], value[V_BEST])


@compiled
def begin_anew(world: World, searcher: Searcher, freely: bool) -> None:
    """Insert the customers left out; `freely`, plan all anew if that is better. In place."""
    if searcher.count[I_MISSING] > 0:
        insert_missing(world, searcher, BY_FAR)
    if freely:
        construct(world, searcher)


@compiled
def begin_again(world: World, searcher: Searcher) -> None:
    """Plan all anew by insertion, whatever there is. In place."""
    searcher.value[V_BEST] = math.inf
    construct(world, searcher)


@compiled
def anneal(world: World, searcher: Searcher, turns: int) -> None:
    """Ruin and recreate `turns` times. In place."""
    value = searcher.value
    for _ in range(turns):
        first = begin_turn(searcher)
        ruin(world, searcher, first)
        if world.mixed and searcher.count[I_TOUCHED] > 0 and uniform(searcher.rng) < RETYPED:
            draw_type(world, searcher)
        sort_absent(world, searcher, first, ORDERS[below(searcher.rng, len(ORDERS))])
        recreate(world, searcher, first, world.scan_all)
        if world.traded and uniform(searcher.rng) < RETYPED:
            improve_types(world, searcher)
        if world.mixed and uniform(searcher.rng) < RETYPED:
            cheapen_types(world, searcher)
        cost = turn_cost(world, searcher)
        limit = value[V_COST] - value[V_TEMPERATURE] * math.log(1.0 - uniform(searcher.rng))
        forced = world.must_serve and searcher.count[I_ABSENT] > 0 and rarer_absences(searcher)
        if cost < limit or forced:
            accept(searcher, cost)
            if cost < value[V_BEST]:
                keep_best(searcher)
        else:
            undo(searcher)
        if world.tails:
            move_parts(world, searcher, True)
        if world.single_drones:
            for _ in range(RESPLITS):
                move_parts(world, searcher, False)
        value[V_TEMPERATURE] *= value[V_COOLING]
