"""What one thread of the search holds."""

from typing import NamedTuple

from model.kernel.compiled import compiled, inlined, spliced
from model.kernel.copying import copy_row, copy_rows, copy_some
from model.kernel.instance import TYPE_COUNT
from model.problem import BoolArray, FloatArray, IntArray, UIntArray
from model.search.route.layout import (
    CHANGING, LEAN_COLUMNS, NOWHERE, R_LENGTH, R_SORTIES, R_STAMP, R_TRIPS, R_TYPE, S_KIND, S_NODE,
    W_SLOT, Fleet, World,
)
from model.search.route.refresh import locate

(I_ACTIVE, I_MISSING, I_ABSENT, I_TOUCHED, I_TURN, I_STAMP, I_BEST_MISSING, I_CUSTOMERS,
 I_LEAN, I_OFFERS) = range(10)
"""How many there are of each; the turn, the last stamp given, and whether all routes are lean."""
COUNTS = 10
V_COST, V_BEST, V_TEMPERATURE, V_COOLING = range(4)


class Searcher(NamedTuple):
    """Routes as they are, as they were before this turn, and as they were at their best."""

    now: Fleet
    before: Fleet
    best: Fleet
    count: IntArray  # type: ignore[assignment]  # (COUNTS,) I_ numbers
    value: FloatArray  # (4,) V_ numbers
    rng: UIntArray  # (1,)
    active: IntArray  # slots in use
    missing: IntArray  # customers left out
    best_missing: IntArray
    absent: IntArray  # to be inserted this turn, behind those left alone
    touched: IntArray  # slots changed this turn
    marked: BoolArray  # (node,) removed this turn
    absences: IntArray  # (node,) turns after which a customer was left out
    hit: IntArray  # (slot, trip) turn of the last string
    line: IntArray  # (node + 3, LINE_COLUMNS) scratch, places of a trip or two in order
    line_cost: FloatArray  # (node + 3,) scratch
    key: FloatArray  # (node,) order of insertion
    moved: IntArray  # scratch
    move: IntArray  # scratch, best insertion
    offer: IntArray  # (offer, MOVE_COLUMNS) scratch, insertions that may be best
    least: FloatArray  # (offer,) scratch, what each costs at least
    acc: IntArray  # scratch, sums of a block
    bound: FloatArray  # (2,) scratch, B_ numbers
    alone: FloatArray  # (type, 2, node) cost of a route that serves one customer
    kept: IntArray  # (node, slot, column) K_ columns, the best places on routes as they are
    kept_cost: FloatArray  # (node, slot) where not all routes are lean, what these cost


@inlined
def copy_route(source: Fleet, slot: int, target: Fleet, to: int, lean: int) -> None:
    """Copy a route between fleets, from a slot to a slot; `lean`, only what lean ones need.

    In place.
    """
    route = source.route[slot]
    copy_row(route, target.route[to])
    target.cost[to] = source.cost[slot]
    if lean:
        stops, copies = source.stop[slot], target.stop[to]
        for p in range(route[R_LENGTH]):
            for column in range(LEAN_COLUMNS):
                copies[p, column] = stops[p, column]
        copy_row(source.trip[slot, 0], target.trip[to, 0])
        return
    target.early[to] = source.early[slot]
    copy_rows(source.stop[slot], target.stop[to], route[R_LENGTH])
    copy_rows(source.trip[slot], target.trip[to], route[R_TRIPS])
    copy_rows(source.sortie[slot], target.sortie[to], route[R_SORTIES])


@inlined
def is_same(fleet: Fleet, other: Fleet, slot: int) -> bool:
    """Tell whether a route without sorties is the same in two fleets."""
    route, before = fleet.route[slot], other.route[slot]
    length = route[R_LENGTH]
    if (length != before[R_LENGTH] or route[R_TYPE] != before[R_TYPE]
            or route[R_SORTIES] + before[R_SORTIES] > 0):
        return False
    for p in range(length):
        for column in (S_NODE, S_KIND):
            if fleet.stop[slot, p, column] != other.stop[slot, p, column]:
                return False
    return True


@inlined
def list_active(searcher: Searcher) -> None:
    """List the slots in use. In place."""
    found = 0
    for slot in range(len(searcher.active)):
        if searcher.now.route[slot, R_LENGTH] > 0:
            searcher.active[found] = slot
            found += 1
    searcher.count[I_ACTIVE] = found


@inlined
def free_slot(world: World, searcher: Searcher, k: int) -> int:
    """Return an empty slot for a route more by type `k`; NOWHERE if there is none."""
    now = searcher.now
    if now.used[k] < world.type[k, TYPE_COUNT]:
        for slot in range(len(searcher.active)):
            if now.route[slot, R_LENGTH] == 0:
                return slot
    return NOWHERE


@inlined
def touch(searcher: Searcher, slot: int) -> None:
    """Keep a route as it is before it changes this turn. In place."""
    for index in range(searcher.count[I_TOUCHED]):
        if searcher.touched[index] == slot:
            return
    copy_route(searcher.now, slot, searcher.before, slot, searcher.count[I_LEAN])
    searcher.now.route[slot, R_STAMP] = CHANGING
    searcher.touched[searcher.count[I_TOUCHED]] = slot
    searcher.count[I_TOUCHED] += 1


@inlined
def keep_aside(fleet: Fleet, slot: int, to: int) -> None:
    """Copy the sequence and times of a route to another slot. In place."""
    route = fleet.route[slot]
    copy_row(route, fleet.route[to])
    copy_rows(fleet.stop[slot], fleet.stop[to], route[R_LENGTH])
    copy_rows(fleet.sortie[slot], fleet.sortie[to], route[R_SORTIES])


@inlined
def keep_best(searcher: Searcher) -> None:
    """Take the routes as they are for the best. In place."""
    now, best = searcher.now, searcher.best
    for slot in range(len(searcher.active)):
        if now.route[slot, R_STAMP] != best.route[slot, R_STAMP]:
            copy_route(now, slot, best, slot, searcher.count[I_LEAN])
    copy_row(now.used, best.used)
    missing = searcher.count[I_MISSING]
    searcher.count[I_BEST_MISSING] = missing
    copy_some(searcher.missing, searcher.best_missing, missing)
    searcher.value[V_BEST] = searcher.value[V_COST]


@spliced
def served_cost(searcher: Searcher) -> float:
    """Return the cost of the routes as they are, and of the customers left out before this turn."""
    cost = searcher.value[V_COST]
    for index in range(searcher.count[I_TOUCHED]):
        slot = searcher.touched[index]
        cost += searcher.now.cost[slot] - searcher.before.cost[slot]
    return cost


@spliced
def unassigned_more(world: World, nodes: IntArray, count: int) -> float:
    """Return what leaving out the first customers of a list costs above the least for each."""
    more = 0.0
    for index in range(count):
        more += world.unassigned_more[nodes[index]]
    return more


@spliced
def left_out_cost(world: World, nodes: IntArray, count: int) -> float:
    """Return what leaving out the first customers of a list costs."""
    return count * world.unassigned_cost + unassigned_more(world, nodes, count)


@compiled
def missing_cost(world: World, searcher: Searcher) -> float:
    """Return what the customers left out cost."""
    return left_out_cost(world, searcher.missing, searcher.count[I_MISSING])


@spliced
def turn_cost(world: World, searcher: Searcher) -> float:
    """Return the cost of the routes as they are after this turn."""
    count = searcher.count
    fewer_or_more = (count[I_ABSENT] - count[I_MISSING]) * world.unassigned_cost
    others = (unassigned_more(world, searcher.absent, count[I_ABSENT])
              - unassigned_more(world, searcher.missing, count[I_MISSING]))
    return served_cost(searcher) + (fewer_or_more + others)


@spliced
def accept(searcher: Searcher, cost: float) -> None:
    """Go on from this turn's routes. In place."""
    count = searcher.count
    count[I_STAMP] += 1
    for index in range(count[I_TOUCHED]):
        slot = searcher.touched[index]
        stamp = count[I_STAMP]
        if len(searcher.kept) > 0 and is_same(searcher.now, searcher.before, slot):
            stamp = searcher.before.route[slot, R_STAMP]
        searcher.now.route[slot, R_STAMP] = stamp
    count[I_MISSING] = count[I_ABSENT]
    copy_some(searcher.absent, searcher.missing, count[I_ABSENT])
    searcher.value[V_COST] = cost


@compiled
def go_back(searcher: Searcher) -> None:
    """Go on from the best routes. In place."""
    now, best, count = searcher.now, searcher.best, searcher.count
    count[I_STAMP] += 1
    for slot in range(len(searcher.active)):
        copy_route(best, slot, now, slot, count[I_LEAN])
        now.route[slot, R_STAMP] = count[I_STAMP]
    copy_row(best.used, now.used)
    for node in range(len(now.where)):
        now.where[node, W_SLOT] = NOWHERE
    list_active(searcher)
    for index in range(count[I_ACTIVE]):
        locate(now, searcher.active[index])
    count[I_MISSING] = count[I_BEST_MISSING]
    copy_some(searcher.best_missing, searcher.missing, count[I_BEST_MISSING])
    searcher.value[V_COST] = searcher.value[V_BEST]
