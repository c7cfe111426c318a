"""Simulated annealing by ruin and recreate among linked stops. As `moves.anneal`."""

import math

from model.kernel.alarm import rung
from model.kernel.compiled import compiled_on_arrays, spliced
from model.kernel.copying import copy_some
from model.search.linked.chain import forget, take_back
from model.search.linked.insertion import recreate_linked
from model.search.linked.layout import Linked
from model.search.linked.retype import cheapen_run, cheapen_runs
from model.search.linked.strings import ruin_linked
from model.search.linked.tails import exchange_tails_linked
from model.search.moves.anneal import (
    MOST_MISSING, RETYPED, begin_turn, counts_up, rarer_absences, try_near,
)
from model.search.moves.recreate import draw_order, sort_absent
from model.search.route.layout import NOWHERE, World
from model.search.route.randomness import uniform
from model.search.route.state import (
    ALL, Searcher, keep_totals, left_out_cost, list_all_changed, note_changed,
)


@spliced
def list_changes(searcher: Searcher, linked: Linked) -> None:
    """List the routes of this turn as changed since the best, and note nothing more. In place."""
    noted = linked.noted
    for index in range(noted.pieces):
        note_changed(searcher, linked.piece[index].slot)
    for index in range(noted.entries):
        note_changed(searcher, linked.link[linked.entry[index].node].slot)
    for index in range(noted.retyped):
        note_changed(searcher, linked.retyped[index])
    forget(linked)


@spliced
def accept_linked(searcher: Searcher, linked: Linked, cost: float) -> None:
    """Go on from this turn's routes. In place."""
    count, now = searcher.count, searcher.now
    list_changes(searcher, linked)
    for index in range(count.missing):
        now.where[searcher.missing[index]].slot = 0
    for index in range(count.absent):
        now.where[searcher.absent[index]].slot = NOWHERE
    count.missing = count.absent
    copy_some(searcher.absent, searcher.missing, count.absent)
    searcher.value.cost = cost


@spliced
def keep_best_linked(searcher: Searcher, linked: Linked) -> None:
    """Take the routes as they are for the best. In place."""
    count = searcher.count
    if count.changed == ALL:
        list_all_changed(searcher)
    for index in range(count.changed):
        slot = searcher.changed[index]
        searcher.is_changed[slot] = False
        linked.best_first[slot] = NOWHERE
        if searcher.rank[slot] >= count.active:
            continue
        run = linked.run[slot]
        linked.best_first[slot], linked.best_type[slot] = run.first, run.type
        node = run.first
        for _ in range(run.count):
            linked.best_behind[node] = linked.link[node].behind
            node = linked.link[node].behind
    keep_totals(searcher)


@spliced
def move_tails(world: World, searcher: Searcher, linked: Linked) -> None:
    """Swap tails of routes if that is accepted. In place."""
    a, b, cost = exchange_tails_linked(world, searcher, linked)
    if a < 0:
        return
    if world.traded and uniform(searcher.rng) < RETYPED:
        cost -= cheapen_run(world, searcher, linked, a) + cheapen_run(world, searcher, linked, b)
    note_changed(searcher, a)
    note_changed(searcher, b)
    list_changes(searcher, linked)
    searcher.value.cost += cost
    if searcher.value.cost < searcher.value.best:
        keep_best_linked(searcher, linked)


@compiled_on_arrays
def anneal_linked(world: World, searcher: Searcher, linked: Linked, turns: int) -> None:
    """Ruin and recreate `turns` times. In place.

    A turn is given up once what it has inserted costs more than would be accepted; once the search
    must end, as if it had not begun.
    """
    value, count = searcher.value, searcher.count
    for _ in range(turns):
        first = begin_turn(world, searcher, MOST_MISSING)
        tried = count.absent
        saved, seed = ruin_linked(world, searcher, linked)
        if first > 0:
            try_near(world, searcher, seed, first, tried)
        sort_absent(world, searcher, first, draw_order(world, searcher.rng))
        limit = value.cost - value.temperature * math.log(1.0 - uniform(searcher.rng))
        left_out = 0.0
        if count.missing > 0:
            left_out = left_out_cost(world, searcher.missing, count.missing)
        retyped = world.traded and uniform(searcher.rng) < RETYPED
        spare = math.inf
        if not retyped and counts_up(world, searcher):
            spare = limit - (value.cost - saved - left_out
                             + left_out_cost(world, searcher.absent, first))
        done, added = recreate_linked(world, searcher, linked, first, spare)
        if rung(world.stop):
            take_back(world, searcher, linked)
            count.turn -= 1
            return
        if done and retyped:
            added -= cheapen_runs(world, searcher, linked)
        cost = (value.cost - saved + added - left_out
                + left_out_cost(world, searcher.absent, count.absent))
        scarce = not world.optional and count.absent > 0
        forced = done and scarce and rarer_absences(world, searcher)
        if done and (cost < limit or forced):
            accept_linked(searcher, linked, cost)
            if cost < value.best:
                keep_best_linked(searcher, linked)
        else:
            take_back(world, searcher, linked)
        if world.tails:
            move_tails(world, searcher, linked)
        value.temperature *= value.cooling
