"""What one thread of the search holds."""

from typing import NamedTuple

from model.kernel.compiled import compiled, inlined, pasted, spliced
from model.kernel.copying import copy_row, copy_some, copy_records
from model.kernel.records import Record, Records, record
from model.problem import BoolArray, FloatArray, IntArray, UIntArray
from model.search.route.layout import CHANGING, NOWHERE, Fleet, World, copy_lean
from model.search.route.rarer import tiers_aboard
from model.search.route.refresh import locate

COUNTS = record("active", "missing", "absent", "touched", "turn", "stamp", "best_missing",
                "customers", "lean", "offers", "changed", "stay", "focus")
"""How many there are of each; the turn, the last stamp given, and whether all routes are lean.

`changed` is `ALL` where any slot may have changed since the best; customers are drawn near `focus`,
another every `stay` turns, or everywhere if that is 0."""
VALUES = record(cost=float, best=float, temperature=float, cooling=float, longest=float)
"""Of the routes as they are, and at their best; of the annealing; and how long strings are at most
where routes are long."""
ALL = -1


class Searcher(NamedTuple):
    """Routes as they are, as they were before this turn, and as they were at their best."""

    now: Fleet
    before: Fleet  # those touched this turn, as they are listed there; who is where is not noted
    best: Fleet  # likewise not
    count: Record  # COUNTS
    value: Record  # VALUES
    rng: UIntArray  # (1,)
    active: IntArray  # slots in use, and behind them those that are free
    rank: IntArray  # (slot,) where it stands in `active`
    changed: IntArray  # slots changed since the best
    is_changed: BoolArray  # (slot,) it is among those
    missing: IntArray  # customers left out
    best_missing: IntArray
    absent: IntArray  # to be inserted this turn, behind those left alone
    touched: IntArray  # slots changed this turn
    marked: BoolArray  # (node,) removed this turn
    absences: IntArray  # (node,) turns after which a customer was left out
    hit: IntArray  # (slot, trip) turn of the last string
    line: Records  # (node + 3,) scratch, places of a trip or two in order
    line_cost: FloatArray  # (node + 3,) scratch
    key: FloatArray  # (node,) order of insertion
    moved: IntArray  # scratch
    move: Record  # MOVE, scratch, best insertion
    offer: Records  # (offer,) MOVE, scratch, insertions that may be best
    least: FloatArray  # (offer,) scratch, what each costs at least
    acc: Record  # SUMS of a block, scratch
    bound: Record  # BOUND, scratch
    alone: FloatArray  # (type, 2, node) cost of a route that serves one customer
    kept: Records  # (node, slot) KEPT, the best places on lean routes as they are
    kept_move: Records  # (node, slot) MOVE, the best insertions where not all routes are lean
    kept_cost: FloatArray  # (node, slot) where not all routes are lean, what these cost


@pasted
def copy_route(source: Fleet, slot: int, target: Fleet, to: int, lean: int) -> None:
    """Copy a route between fleets, from a slot to a slot; `lean`, only what lean ones need.

    In place. What is called is given rows, since a call copies what describes each array.
    """
    length = source.route[slot].length
    target.route[to] = source.route[slot]
    target.cost[to] = source.cost[slot]
    for tier in range(tiers_aboard(source)):
        copy_records(source.halt[slot, tier], target.halt[to, tier], length)
    if lean:
        copy_lean_stops(source.stop[slot], target.stop[to], length)
        target.trip[to, 0] = source.trip[slot, 0]
    else:
        target.early[to] = source.early[slot]
        copy_records(source.stop[slot], target.stop[to], length)
        copy_records(source.trip[slot], target.trip[to], source.route[slot].trips)
        copy_records(source.sortie[slot], target.sortie[to], source.route[slot].sorties)


@inlined
def copy_lean_stops(stops: Records, copies: Records, count: int) -> None:
    """Copy what a lean route needs of its stops. In place."""
    for p in range(count):
        copy_lean(stops[p], copies[p])


@inlined
def is_same(fleet: Fleet, slot: int, other: Fleet, at: int) -> bool:
    """Tell whether a route without sorties is the same in two fleets, each in its slot."""
    route, before = fleet.route[slot], other.route[at]
    length = route.length
    if (length != before.length or route.type != before.type
            or route.sorties + before.sorties > 0):
        return False
    for p in range(length):
        stop, former = fleet.stop[slot, p], other.stop[at, p]
        if stop.node != former.node or stop.kind != former.kind:
            return False
    return True


@inlined
def list_active(searcher: Searcher) -> None:
    """List the slots in use, and those that are free. In place."""
    found = 0
    for used in (True, False):
        for slot in range(len(searcher.active)):
            if (searcher.now.route[slot].length > 0) == used:
                searcher.active[found], searcher.rank[slot] = slot, found
                found += 1
        if used:
            searcher.count.active = found


@inlined
def list_anew(searcher: Searcher, slot: int, used: bool) -> None:
    """List a slot among those in use, or those that are free, if it isn't yet. In place."""
    active, rank, count = searcher.active, searcher.rank, searcher.count
    place = rank[slot]
    if used == (place < count.active):
        return
    if not used:
        count.active -= 1
    other = active[count.active]
    active[place], rank[other] = other, place
    active[count.active], rank[slot] = slot, count.active
    if used:
        count.active += 1


@inlined
def list_touched(searcher: Searcher) -> None:
    """List the slots touched this turn where they belong. In place."""
    for index in range(searcher.count.touched):
        slot = searcher.touched[index]
        list_anew(searcher, slot, searcher.now.route[slot].length > 0)


@inlined
def free_slot(world: World, searcher: Searcher, k: int) -> int:
    """Return an empty slot for a route more by type `k`; NOWHERE if there is none."""
    now = searcher.now
    if now.used[k] < world.type[k].count and searcher.count.active < len(searcher.active):
        return searcher.active[searcher.count.active]
    return NOWHERE


@inlined
def touch(searcher: Searcher, slot: int) -> None:
    """Keep a route as it is before it changes this turn. In place."""
    if searcher.now.route[slot].stamp == CHANGING:
        return
    count = searcher.count
    copy_route(searcher.now, slot, searcher.before, count.touched, count.lean)
    searcher.now.route[slot].stamp = CHANGING
    searcher.touched[count.touched] = slot
    count.touched += 1


@inlined
def keep_aside(fleet: Fleet, slot: int, to: int) -> None:
    """Copy the sequence and times of a route to another slot. In place."""
    route = fleet.route[slot]
    fleet.route[to] = fleet.route[slot]
    copy_records(fleet.stop[slot], fleet.stop[to], route.length)
    copy_records(fleet.sortie[slot], fleet.sortie[to], route.sorties)


@inlined
def note_changed(searcher: Searcher, slot: int) -> None:
    """List a slot as changed since the best. In place."""
    count = searcher.count
    if count.changed != ALL and not searcher.is_changed[slot]:
        searcher.is_changed[slot] = True
        searcher.changed[count.changed] = slot
        count.changed += 1


@inlined
def list_all_changed(searcher: Searcher) -> None:
    """List all slots as changed since the best. In place."""
    for slot in range(len(searcher.is_changed)):
        searcher.is_changed[slot] = False
    searcher.count.changed = len(searcher.active)
    for slot in range(len(searcher.active)):
        searcher.changed[slot] = slot


@inlined
def keep_best(searcher: Searcher) -> None:
    """Take the routes as they are for the best. In place."""
    now, best, count = searcher.now, searcher.best, searcher.count
    if count.changed == ALL:
        list_all_changed(searcher)
    for index in range(count.changed):
        slot = searcher.changed[index]
        searcher.is_changed[slot] = False
        if now.route[slot].stamp != best.route[slot].stamp:
            copy_route(now, slot, best, slot, searcher.count.lean)
    keep_totals(searcher)


@inlined
def keep_totals(searcher: Searcher) -> None:
    """Take what is known of all routes as they are for that of the best. In place."""
    count = searcher.count
    count.changed = 0
    copy_row(searcher.now.used, searcher.best.used)
    count.best_missing = count.missing
    copy_some(searcher.missing, searcher.best_missing, count.missing)
    searcher.value.best = searcher.value.cost


@spliced
def served_cost(searcher: Searcher) -> float:
    """Return the cost of the routes as they are, and of the customers left out before this turn."""
    cost = searcher.value.cost
    for index in range(searcher.count.touched):
        slot = searcher.touched[index]
        cost += searcher.now.cost[slot] - searcher.before.cost[index]
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
    return left_out_cost(world, searcher.missing, searcher.count.missing)


@spliced
def turn_cost(world: World, searcher: Searcher) -> float:
    """Return the cost of the routes as they are after this turn."""
    count = searcher.count
    fewer_or_more = (count.absent - count.missing) * world.unassigned_cost
    others = (unassigned_more(world, searcher.absent, count.absent)
              - unassigned_more(world, searcher.missing, count.missing))
    return served_cost(searcher) + (fewer_or_more + others)


@spliced
def accept(searcher: Searcher, cost: float) -> None:
    """Go on from this turn's routes. In place."""
    count = searcher.count
    count.stamp += 1
    for index in range(count.touched):
        slot = searcher.touched[index]
        stamp = count.stamp
        if len(searcher.kept) > 0 and is_same(searcher.now, slot, searcher.before, index):
            stamp = searcher.before.route[index].stamp
        searcher.now.route[slot].stamp = stamp
        note_changed(searcher, slot)
    count.missing = count.absent
    copy_some(searcher.absent, searcher.missing, count.absent)
    searcher.value.cost = cost


@compiled
def go_back(searcher: Searcher) -> None:
    """Go on from the best routes. In place."""
    now, best, count = searcher.now, searcher.best, searcher.count
    count.stamp += 1
    count.changed = ALL
    for slot in range(len(searcher.active)):
        copy_route(best, slot, now, slot, count.lean)
        now.route[slot].stamp = count.stamp
    copy_row(best.used, now.used)
    for node in range(len(now.where)):
        now.where[node].slot = NOWHERE
    list_active(searcher)
    for index in range(count.active):
        locate(now, searcher.active[index])
    count.missing = count.best_missing
    copy_some(searcher.best_missing, searcher.missing, count.best_missing)
    searcher.value.cost = searcher.value.best
