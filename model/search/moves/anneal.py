"""Simulated annealing by ruin and recreate.

References
----------
Christiaens and Vanden Berghe (2020), slack induction by string removals for vehicle routing
problems, Transportation Science 54:417-433.
"""

import math

from model.kernel.alarm import rung
from model.kernel.compiled import compiled_on_arrays, inlined, spliced
from model.kernel.copying import copy_some
from model.search.moves.exchange import exchange_tails
from model.search.moves.recreate import draw_order, recreate, sort_absent
from model.search.moves.resplit import resplit
from model.search.moves.retype import cheapen_types, draw_type, improve_types
from model.search.moves.ruin import choose, longest_string, remove_marked
from model.search.route.layout import NOWHERE, World
from model.search.route.randomness import below, uniform
from model.search.route.refresh import any_customer, locate
from model.search.route.state import (
    Searcher, accept, copy_route, keep_best, left_out_cost, list_touched,
    served_cost, touch, turn_cost,
)

ANY = -1
"""No order of insertion in particular: one is drawn each turn."""

MOST_MISSING = 12
"""How many of the customers left out are tried again each turn."""

TRIED_NEAR = 0.5
"""How likely each of those near the ruin is among them, where there are more."""

BUILT_BESIDE_FROM = 2000
"""From how many places on all who are inserted at the beginning come beside neighbours or on a new
route, too: looking at all routes for each takes time that grows with the square."""

RESPLITS = 30
"""Trips with one drone planned anew from their order each turn."""

RETYPED = 0.1
"""How often the routes touched are given the vehicles that cost least."""


@spliced
def begin_turn(world: World, searcher: Searcher, most: int) -> int:
    """List `most` of the customers left out as absent. In place; return how many are not tried."""
    count, absent, missing = searcher.count, searcher.absent, searcher.missing
    count.turn += 1
    count.touched = 0
    if count.stay > 0 and count.turn % count.stay == 0:
        count.focus = any_customer(world, searcher.now, searcher.rng)
    total = count.missing
    copy_some(missing, absent, total)
    alone = max(0, total - most)
    for index in range(total - 1, alone - 1, -1):
        other = below(searcher.rng, index + 1)
        absent[index], absent[other] = absent[other], absent[index]
    count.absent = total
    return alone


@spliced
def try_near(world: World, searcher: Searcher, seed: int, first: int, total: int) -> None:
    """Let those left out near a customer, who may be one of them, be tried before others.

    They come last of the first `total` absent, of whom those from number `first` on are tried. Who
    has to be served is tried by chance alone, everywhere as often. In place.
    """
    absent, marked, chosen = searcher.absent, searcher.marked, 0
    for rank in range(-1, world.near.shape[1]):
        node = seed if rank < 0 else int(world.near[seed, rank])
        if node < 0 or chosen == total - first:
            break
        if (searcher.now.where[node].slot == NOWHERE and not world.must_serve[node]
                and (rank < 0 or uniform(searcher.rng) < TRIED_NEAR)):
            marked[node] = True
            chosen += 1
    last = total
    for index in range(total - 1, -1, -1):
        if marked[absent[index]]:
            last -= 1
            marked[absent[index]] = False
            absent[index], absent[last] = absent[last], absent[index]


@spliced
def ruin(world: World, searcher: Searcher, first: int) -> None:
    """Remove strings of customers near each other. In place."""
    count, now = searcher.count, searcher.now
    before = count.absent
    total, num_touched, seed = choose(
        world, searcher, longest_string(searcher), searcher.absent, before, searcher.moved)
    if first > 0:
        try_near(world, searcher, seed, first, before)
    for index in range(num_touched):
        touch(searcher, searcher.moved[index])
    for index in range(num_touched):
        slot = searcher.touched[index]
        total = remove_marked(world, now, slot, searcher.marked, searcher.absent, total,
                              searcher.moved, searcher.acc)
        if now.route[slot].length > 0:
            locate(now, slot)
    for index in range(before, total):
        searcher.marked[searcher.absent[index]] = False
        now.where[searcher.absent[index]].slot = NOWHERE
    count.absent = total
    list_touched(searcher)


@inlined
def rarer_absences(world: World, searcher: Searcher) -> bool:
    """Tell whether after this turn others are left out who must not be, and seldom were.

    They are as many as before, and all who are left out cost no more. Counts the absences. In
    place.
    """
    count, absences = searcher.count, searcher.absences
    before = after = more = 0
    for index in range(count.missing):
        if world.must_serve[searcher.missing[index]]:
            before += absences[searcher.missing[index]]
            more -= 1
    for index in range(count.absent):
        if world.must_serve[searcher.absent[index]]:
            after += absences[searcher.absent[index]]
            absences[searcher.absent[index]] += 1
            more += 1
    dearer = (left_out_cost(world, searcher.absent, count.absent)
              > left_out_cost(world, searcher.missing, count.missing))
    return more == 0 and after < before and not dearer


@inlined
def looks_everywhere(world: World, building: bool) -> bool:
    """Tell whether customers are tried on all routes, not beside neighbours alone."""
    return world.scan_all or (building and world.num_nodes < BUILT_BESIDE_FROM)


@inlined
def counts_up(world: World, searcher: Searcher) -> bool:
    """Tell whether what a turn has inserted so far costs no more than all that it will insert."""
    return world.adds_up and (searcher.count.missing == 0 or world.optional)


@inlined
def cost_to_insert(world: World, searcher: Searcher, first: int) -> float:
    """Return what the routes cost before who is absent is inserted, from number `first` on."""
    cost = served_cost(searcher)
    if searcher.count.missing > 0:
        cost += (left_out_cost(world, searcher.absent, first)
                 - left_out_cost(world, searcher.missing, searcher.count.missing))
    return cost


@spliced
def undo(searcher: Searcher) -> None:
    """Take back this turn. In place."""
    now, before = searcher.now, searcher.before
    for index in range(searcher.count.touched):
        slot = searcher.touched[index]
        if now.route[slot].length > 0:
            now.used[now.route[slot].type] -= 1
        copy_route(before, index, now, slot, searcher.count.lean)
        if now.route[slot].length > 0:
            now.used[now.route[slot].type] += 1
            locate(now, slot)
    for index in range(searcher.count.missing):
        now.where[searcher.missing[index]].slot = NOWHERE
    list_touched(searcher)


@spliced
def move_parts(world: World, searcher: Searcher, tails: bool) -> None:
    """Swap tails of routes, or plan a trip anew, if that is accepted. In place."""
    value, count = searcher.value, searcher.count
    limit = -value.temperature * math.log(1.0 - uniform(searcher.rng))
    count.touched = 0
    count.absent = count.missing
    changed = (exchange_tails(world, searcher, limit) if tails
               else resplit(world, searcher, limit))
    if changed:
        if world.traded and uniform(searcher.rng) < RETYPED:
            improve_types(world, searcher)
        # Who is left out stays the same, and isn't listed as absent yet.
        cost = served_cost(searcher)
        if cost < value.cost + limit:
            copy_some(searcher.missing, searcher.absent, count.missing)
            list_touched(searcher)
            accept(searcher, cost)
            if cost < value.best:
                keep_best(searcher)
            return
    if count.touched > 0:
        undo(searcher)


@compiled_on_arrays
def anneal(world: World, searcher: Searcher, turns: int, order: int) -> None:
    """Ruin and recreate `turns` times. In place.

    Where no insertion saves anything, a turn is given up once those made cost more than would be
    accepted.
    Given an `order`, nobody is removed, all who are left out are inserted in it, and that is kept
    whatever it costs. This is one function, not two, since insertion takes a minute to compile.
    Once the search must end, a turn is given up as if it had not begun, and an insertion of all
    leaves out whoever is not inserted yet.
    """
    value, count = searcher.value, searcher.count
    building = order != ANY
    for _ in range(turns):
        first = begin_turn(world, searcher, count.missing if building else MOST_MISSING)
        if not building:
            ruin(world, searcher, first)
            if world.mixed and count.touched > 0 and uniform(searcher.rng) < RETYPED:
                draw_type(world, searcher)
        inserted = order if building else draw_order(world, searcher.rng)
        sort_absent(world, searcher, first, inserted)
        limit = value.cost - value.temperature * math.log(1.0 - uniform(searcher.rng))
        trades = not building and (world.traded or world.mixed)
        retyped = trades and uniform(searcher.rng) < RETYPED
        spare = math.inf
        if not (building or retyped) and counts_up(world, searcher):
            spare = limit - cost_to_insert(world, searcher, first)
        done = recreate(world, searcher, first, looks_everywhere(world, building), spare)
        if rung(world.stop) and not building:
            undo(searcher)
            count.turn -= 1
            return
        if done and retyped:
            if world.traded:
                improve_types(world, searcher)
            if world.mixed:
                cheapen_types(world, searcher)
        cost = turn_cost(world, searcher)
        scarce = not (building or world.optional) and count.absent > 0
        forced = done and scarce and rarer_absences(world, searcher)
        if building or cost < limit or forced:
            accept(searcher, cost)
            if cost < value.best:
                keep_best(searcher)
        else:
            undo(searcher)
        if not building:
            for part in range(1 + RESPLITS if world.single_drones else 1):
                if (part > 0 or world.tails) and not rung(world.stop):
                    move_parts(world, searcher, part == 0)
        value.temperature *= value.cooling
