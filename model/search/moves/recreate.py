"""Insertion of the customers left out, one after another, each where that costs least."""

from model.kernel.alarm import rung
from model.kernel.compiled import inlined, pasted, spliced
from model.kernel.leg import leg, legs_of
from model.kernel.load import demand_of, total, total_delivered, total_picked
from model.kernel.stop import closing, width
from model.problem import UIntArray
from model.search.insertion.evaluate import INFEASIBLE, serve_alone
from model.search.insertion.places import (
    DRAWN_FOR_TRIPS, MORE_TRIPS, find_beside, find_place, opens_route, try_new_route, try_trips,
)
from model.search.route.edit import NEW_FLIGHT, apply
from model.search.route.layout import MODE_LEAN, World
from model.search.route.lean import insert_lean
from model.search.route.randomness import below, uniform
from model.search.route.rarer import is_dearer_to_some, tiers_of
from model.search.route.refresh import locate, refresh
from model.search.route.state import Searcher, free_slot, keep_aside, list_anew, touch
from model.search.route.vehicles import change_type

ENLARGED = 0.2
"""How often a full route may take a larger vehicle to serve a customer more."""

OPENING = 0.03
"""How often the first customer inserted is given a route of its own."""

BY_CHANCE, BY_DEMAND, BY_FAR, BY_CLOSE, BY_WIDTH, BY_LATEST, BY_COST = range(7)
ORDERS = (BY_CHANCE, BY_CHANCE, BY_CHANCE, BY_CHANCE, BY_DEMAND, BY_DEMAND, BY_DEMAND, BY_DEMAND,
          BY_FAR, BY_FAR, BY_CLOSE, BY_WIDTH, BY_WIDTH, BY_LATEST)

FEW_TO_SORT = 64
"""Up to how many customers are sorted by insertion alone; where all are, that takes too long."""

DEAREST_FIRST = 0.5
"""How often those come first whom it costs most to leave out, where that differs."""


@spliced
def draw_order(world: World, rng: UIntArray) -> int:
    """Draw in what order customers are inserted."""
    if is_dearer_to_some(world) and uniform(rng) < DEAREST_FIRST:
        return BY_COST
    return ORDERS[below(rng, len(ORDERS))]


@inlined
def order_key(world: World, order: int, node: int, rng: UIntArray) -> float:
    """Return where a customer comes in an order; least first."""
    place = world.place[0, node]
    if order == BY_COST:
        return -world.unassigned_more[node]
    if order == BY_DEMAND:
        if tiers_of(world) > 0:
            return -float(total_delivered(world.amount, node) + total_picked(world.amount, node))
        return -float(total(demand_of(place)))
    if order in (BY_FAR, BY_CLOSE):
        legs = legs_of(world.leg, world.type[0].travel)
        distance = float(leg(legs, world.type[0].begins_at, node).distance)
        return -distance if order == BY_FAR else distance
    if order == BY_WIDTH:
        return float(width(place))
    if order == BY_LATEST:
        return float(closing(place))
    return uniform(rng)


@spliced
def sort_absent(world: World, searcher: Searcher, first: int, order: int) -> None:
    """Put the customers to insert in order, from number `first` on. In place."""
    absent, key, last = searcher.absent, searcher.key, searcher.count.absent
    for index in range(first, last):
        key[absent[index]] = order_key(world, order, absent[index], searcher.rng)
    gap = 1
    while FEW_TO_SORT * gap < last - first:
        gap = 3 * gap + 1
    while gap > 0:
        for index in range(first + gap, last):
            node, place = absent[index], index
            while place >= first + gap and key[absent[place - gap]] > key[node]:
                absent[place] = absent[place - gap]
                place -= gap
            absent[place] = node
        gap //= 3


@spliced
def open_route(world: World, searcher: Searcher, node: int, k: int, by_drone: bool) -> bool:
    """Serve a customer by a route of its own. In place; False if no slot is free."""
    now, slot = searcher.now, free_slot(world, searcher, k)
    if slot < 0:
        return False
    touch(searcher, slot)
    if not serve_alone(world, now, slot, k, node, by_drone, searcher.acc):
        now.route[slot].length = 0
        now.cost[slot] = 0.0
        return False
    now.used[k] += 1
    locate(now, slot)
    list_anew(searcher, slot, True)
    return True


@pasted
def insert(world: World, searcher: Searcher, node: int) -> bool:
    """Insert a customer where `searcher.move` says. In place; False if that breaks a rule."""
    move, now = searcher.move, searcher.now
    if opens_route(move):
        return open_route(world, searcher, node, move.type, move.kind == NEW_FLIGHT)
    slot = move.slot
    touch(searcher, slot)
    route = now.route[slot]
    if world.mode[route.type] & MODE_LEAN:
        if move.type != route.type:
            change_type(world, now, slot, move.type)
        insert_lean(world, now, slot, move.first, node)
        return True
    spare = len(now.route) - 2
    keep_aside(now, slot, spare)
    depot = world.type[route.type].depot
    apply(depot, route, now.stop[slot], now.sortie[slot], move, node, 0, 0)
    done = refresh(world, now, slot, searcher.acc)
    if not done:
        keep_aside(now, spare, slot)
        refresh(world, now, slot, searcher.acc)
    locate(now, slot)
    return done


@inlined
def several_trips(searcher: Searcher) -> bool:
    """Tell whether there is room for several trips of a vehicle, as `_sizes` makes it."""
    return searcher.now.trip.shape[1] > 2


@pasted
def recreate(world: World, searcher: Searcher, first: int, scan_all: bool, spare: float) -> bool:
    """Insert the absent customers from number `first` on, each where it costs least.

    In place; False, with some inserted, once that costs more than is to `spare`. Once the search
    must end, the others are left out.
    """
    absent, count = searcher.absent, searcher.count
    enlarge = world.traded and uniform(searcher.rng) < ENLARGED
    opening = uniform(searcher.rng) < OPENING
    left = first
    for index in range(first, count.absent):
        node = absent[index]
        cost, tried = INFEASIBLE, 0
        if rung(world.stop):
            absent[left] = node
            left += 1
            continue
        if opening and index == first:
            cost = try_new_route(world, searcher, node)
        elif not scan_all:
            cost = find_beside(world, searcher, node, enlarge)
            if several_trips(searcher) and (
                    opens_route(searcher.move) or uniform(searcher.rng) < MORE_TRIPS):
                tried = DRAWN_FOR_TRIPS
        if cost == INFEASIBLE:
            cost = find_place(world, searcher, node, enlarge)
            if world.general and (cost == INFEASIBLE or uniform(searcher.rng) < MORE_TRIPS):
                tried = count.active
        if tried > 0:
            cost = try_trips(world, searcher, node, tried)
        left_out = world.unassigned_cost + world.unassigned_more[node]
        wanted = cost < left_out or (opening and index == first)
        if cost == INFEASIBLE or not wanted or not insert(world, searcher, node):
            absent[left] = node
            left += 1
        spare -= min(cost, left_out)
        if spare < 0.0:
            return False
    count.absent = left
    return True
