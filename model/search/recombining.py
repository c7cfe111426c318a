"""The better parts of two plans, put together.

While it cools, a search changes its plan here and there, to and fro: hardly ever are all parts at
their best at once. Routes of one plan that serve the same customers as some of another may take
their place whatever the others are. So the smallest such parts of the plan as it is take their
places in the best one wherever they cost less; the search goes on as it would have.

References
----------
Whitley, Hains and Howe (2009), tunneling between optima: partition crossover for the traveling
salesman problem, GECCO.
"""

from collections.abc import Sequence

import numpy as np

from model.problem import MOST_RELATIONS, BoolArray, FloatArray, IntArray
from model.search.hubs import stocks_of, taken_by
from model.search.route.layout import (
    ELSEWHERE, NOWHERE, OTHERS, Fleet, ProblemData, are_kept,
)
from model.search.route.state import ALL, Searcher
from model.search.sharing import ROUNDING


def take_better_parts(data: ProblemData, searcher: Searcher) -> None:
    """Let the best plan take over the parts of the plan as it is that cost less. In place.

    Where that would take too many vehicles or batteries, those parts alone that need no more of
    any. None where the plan costs something as a whole, or orders or places to charge bind routes.

    Who is to go with others stays in one part with them, so that no other part serves them too.
    """
    fairness = data.fairness
    if (fairness.makespan > 0 or fairness.balance > 0 or fairness.min_vehicles > 0
            or len(data.across) or len(data.plugging)):
        return
    now, best, slots = searcher.now, searcher.best, len(searcher.active)
    nodes, unit = np.arange(data.num_depots, data.num_nodes), np.arange(data.num_nodes)
    if len(data.pair):
        unit = data.pair["unit"]
        nodes = nodes[unit[nodes] == nodes]
    there, then = (_by_unit(slot, unit) for slot in (
        now.where["slot"], _slots_in(best, slots, data.num_nodes)))
    nodes = nodes[there[nodes] != ELSEWHERE]
    # Who is left out is like a route, numbered behind them all.
    one, other = (np.where(slot == NOWHERE, slots + nodes, slot)
                  for slot in (then[nodes], there[nodes]))
    old, new = _common_parts(one, other, slots + data.num_nodes, _companies(data, nodes))
    saved = _costs(data, best, old) - _costs(data, now, new)
    better = saved > ROUNDING
    if not better.any():
        return
    needed = _needed(data, now, new, slots) - _needed(data, best, old, slots)
    used = best.used + needed[better, :data.num_types].sum(axis=0)
    stocks = taken_by(data, best, slots).sum(axis=0) + needed[better, data.num_types:].sum(axis=0)
    if ((used > data.type["count"][:data.num_types]).any() or used.sum() > slots
            or (stocks > stocks_of(data)).any()):
        better &= (needed <= 0).all(axis=1)
        used = best.used + needed[better, :data.num_types].sum(axis=0)
    best.used[:] = used
    searcher.value.best -= float(saved[better].sum())
    _exchange(searcher, better[old], better[new])


def _slots_in(fleet: Fleet, slots: int, nodes: int) -> IntArray:
    """Return (node,) the slot of each customer's route; NOWHERE if there is none."""
    slot_of, routes, node = np.full(nodes, NOWHERE), fleet.route, fleet.stop["node"]
    for slot, length in enumerate(routes["length"][:slots].tolist()):
        slot_of[node[slot, :length]] = slot
    for slot in np.flatnonzero(routes["sorties"][:slots]).tolist():
        for sortie in fleet.sortie[slot, :routes["sorties"][slot]]:
            slot_of[sortie["nodes"][:sortie["count"]]] = slot
    return slot_of


def _by_unit(slot: IntArray, unit: IntArray) -> IntArray:
    """Return (node,) the slot of any of those for whom each node stands."""
    slot_of = slot.copy()
    np.maximum.at(slot_of, unit, slot)
    return slot_of


def _companies(data: ProblemData, nodes: IntArray) -> list[IntArray]:
    """Return who of some customers go together, as indices of each relation."""
    if not are_kept(data).any():
        return []
    company = data.goods[nodes]
    kept = company["kept_on_trip"] | company["kept_on_vehicle"]
    return [np.flatnonzero(kept & (1 << bit)) for bit in range(MOST_RELATIONS)]


def _common_parts(one: IntArray, other: IntArray, size: int,
                  companies: Sequence[IntArray] = ()) -> tuple[IntArray, IntArray]:
    """Return the smallest parts of two plans that serve the same customers.

    Parameters
    ----------
    one, other
        (customer,) the number of the customer's route in both, below `size`.
    companies
        Customers, by index, who are of one part.

    Returns
    -------
    (number,) twice: the least number that a route of the part has in the first; `size` if there is
    no such route.
    """
    part = np.full(size, size)
    part[one] = one
    while True:
        across = np.full(size, size)
        np.minimum.at(across, other, part[one])
        joined = part.copy()
        np.minimum.at(joined, one, across[other])
        for those in companies:
            joined[one[those]] = joined[one[those]].min(initial=size)
        if (joined == part).all():
            return part, across
        part = joined


def _costs(data: ProblemData, fleet: Fleet, part: IntArray) -> FloatArray:
    """Return (part,) what the routes of each part cost, and those whom it leaves out.

    `part` (number,) is that of each slot's route, and behind them of each customer left out.
    """
    slots = len(part) - data.num_nodes
    each = np.concatenate([fleet.cost[:slots], data.unassigned_cost + data.unassigned_more])
    each[part == len(part)] = 0.0
    return np.bincount(part, each, len(part) + 1).astype(np.float64)


def _needed(data: ProblemData, fleet: Fleet, part: IntArray, slots: int) -> IntArray:
    """Return (part, kind) how many routes there are of each type, and what they take of stocks.

    `part` as in `_costs`.
    """
    there = np.flatnonzero(fleet.route["length"][:slots])
    each = np.zeros((slots, data.num_types), np.int64)
    each[there, fleet.route["type"][there]] = 1
    needed = np.zeros((len(part) + 1, data.num_types + len(data.hub)), np.int64)
    np.add.at(needed, part[there], np.hstack([each, taken_by(data, fleet, slots)])[there])
    return needed


def _exchange(searcher: Searcher, old: BoolArray, new: BoolArray) -> None:
    """Let routes and customers left out take the places of others in the best plan. In place.

    Both are marked (number,) as in `_costs`.
    """
    now, best, count, slots = searcher.now, searcher.best, searcher.count, len(searcher.active)
    gone = np.flatnonzero(old[:slots])
    for name in ("length", "sorties", "trips"):
        best.route[name][gone] = 0
    best.cost[gone] = 0.0
    free = np.flatnonzero(best.route["length"][:slots] == 0)
    for slot, to in zip(np.flatnonzero(new[:slots]).tolist(), free.tolist(), strict=False):
        _copy(now, slot, best, to)
    best.route["stamp"] = OTHERS
    missing = searcher.best_missing[:count.best_missing]
    missing = np.concatenate([missing[~old[slots + missing]], np.flatnonzero(new[slots:])])
    searcher.best_missing[:len(missing)] = missing
    count.best_missing, count.changed = len(missing), ALL


def _copy(source: Fleet, slot: int, target: Fleet, to: int) -> None:
    """Copy a route between fleets. In place."""
    route = source.route[slot]
    target.route[to], target.cost[to] = route, source.cost[slot]
    target.early[to] = source.early[slot]
    target.stop[to, :route["length"]] = source.stop[slot, :route["length"]]
    target.stop_load[to, :, :route["length"]] = source.stop_load[slot, :, :route["length"]]
    target.trip[to, :route["trips"]] = source.trip[slot, :route["trips"]]
    target.sortie[to, :route["sorties"]] = source.sortie[slot, :route["sorties"]]
