"""The cheapest place for a customer among linked stops."""

import math
from typing import NamedTuple

import numpy as np

from model.kernel.alarm import rung
from model.kernel.compiled import spliced
from model.kernel.instance import FAR
from model.kernel.leg import (
    LegRow, distance_from, distance_to, leg_from, leg_to, legs_from, legs_to,
)
from model.kernel.load import amount_of, fits
from model.kernel.records import Record
from model.kernel.stop import end_of_service, places_of, too_late
from model.search.insertion.evaluate import INFEASIBLE
from model.search.insertion.passing import EACH_DRAWN, MOST_DRAWN
from model.search.insertion.places import opens_route, try_new_route
from model.search.linked.chain import (
    drive_on, due_at, leaves_at, look_back, open_run, tie_in,
)
from model.search.linked.layout import Linked
from model.search.linked.retype import cost_of_run, give_run, larger_for
from model.search.moves.recreate import ENLARGED, OPENING
from model.search.route.edit import AT_STOP
from model.search.route.layout import NOWHERE, World
from model.search.route.randomness import below, uniform
from model.search.route.state import Searcher, free_slot


class Newcomer(NamedTuple):
    """A customer to be inserted, and the legs there and from there."""

    node: int
    inward: LegRow
    onward: LegRow


class Joining(NamedTuple):
    """Which route a customer joins, NOWHERE if it can't; by which type, and at what cost.

    But for that of the detour.
    """

    slot: int
    type: int
    cost: float


@spliced
def has_room(world: World, run: Record, node: int) -> bool:
    """Tell whether the vehicle of a route may serve a customer more, and holds what that takes.

    Its type is unsigned here and below: where an index may be negative, which would count from the
    end, all of this takes a tenth more time.
    """
    k = np.uint64(run.type)
    return (world.can[k, 0, node]
            and fits(world.type[k], amount_of(run.load), world.place[0, node]))


@spliced
def joining(world: World, searcher: Searcher, slot: int, run: Record, node: int, enlarge: bool
            ) -> Joining:
    """Return who would serve a customer more on a route: a larger type if `enlarge`."""
    if has_room(world, run, node):
        return Joining(slot, run.type, world.rate[np.uint64(run.type)].stop)
    if enlarge:
        by = larger_for(world, searcher, run, node)
        if by >= 0:
            more = cost_of_run(world, by, run) - cost_of_run(world, run.type, run)
            return Joining(slot, by, more + world.rate[by].stop)
    return Joining(NOWHERE, NOWHERE, 0.0)


@spliced
def keeps_windows(world: World, linked: Linked, kind: Record, before: int, behind: int, node: int,
                  there: int, onward: int) -> bool:
    """Tell whether a customer may come between two, so long after one and before the other."""
    place = places_of(world.place, kind)[node]
    arrival = leaves_at(world, linked, kind, before) + there
    if too_late(place, arrival):
        return False
    return end_of_service(place, arrival) + onward <= due_at(world, linked, kind, behind)


@spliced
def try_between(world: World, searcher: Searcher, linked: Linked, joins: Joining, before: int,
                behind: int, leg: int, newcomer: Newcomer, best: float) -> float:
    """Try a customer between two who are so far apart; return the best cost so far.

    In place: `searcher.move`, if that is the best.
    """
    k, inward, onward = np.uint64(joins.type), newcomer.inward, newcomer.onward
    detour = distance_from(inward, before) + distance_to(onward, behind) - leg
    cost = detour * world.rate[k].distance + joins.cost
    if cost >= best:
        return best
    if linked.timed and not keeps_windows(
            world, linked, world.type[k], before, behind, newcomer.node,
            leg_from(inward, before).duration, leg_to(onward, behind).duration):
        return best
    if uniform(searcher.rng) < world.blink:
        return best
    move = searcher.move
    move.kind, move.slot, move.first, move.type = AT_STOP, joins.slot, before, k
    return cost


@spliced
def longest_detour(cheapest: Record, best: float) -> int:
    """Return a detour, and all longer ones, that costs no less than `best`, whoever drives it."""
    most = best - cheapest.stop
    if cheapest.distance == 0.0 or most >= FAR * cheapest.distance:
        return FAR
    return math.ceil(most / cheapest.distance)


@spliced
def try_beside(world: World, searcher: Searcher, linked: Linked, newcomer: Newcomer,
               enlarge: bool, best: float) -> float:
    """Try a customer beside neighbours. As `try_between`.

    Most are passed over by the triangle inequality: unless who comes before or behind a neighbour
    is nearer, beside whom the same place is looked at, it costs as much as the way there and back,
    less the longer of the neighbour's legs.
    """
    link, run, cheapest = linked.link, linked.run, linked.cheapest
    others, near = world.fit[newcomer.node], linked.near[newcomer.node]
    most = longest_detour(cheapest, best)
    for rank in range(len(others)):
        other = int(others[rank])
        if other < 0:
            break
        at = link[other]
        slot = at.slot
        if slot < 0 or 2 * int(near[rank]) - max(at.inward, at.onward) >= most:
            continue
        joins = joining(world, searcher, slot, run[slot], newcomer.node, enlarge)
        if joins.slot < 0:
            continue
        before = best
        best = try_between(world, searcher, linked, joins, other, at.behind, at.onward, newcomer,
                           best)
        best = try_between(world, searcher, linked, joins, at.before, other, at.inward, newcomer,
                           best)
        if best < before:
            most = longest_detour(cheapest, best)
    return best


@spliced
def try_ends(world: World, searcher: Searcher, linked: Linked, joins: Joining, newcomer: Newcomer,
             best: float) -> float:
    """Try a customer first and last on a route. As `try_between`."""
    run = linked.run[joins.slot]
    kind, first, last = world.type[run.type], run.first, run.last
    best = try_between(world, searcher, linked, joins, kind.begins_at, first,
                       linked.link[first].inward, newcomer, best)
    return try_between(world, searcher, linked, joins, last, kind.ends_at,
                       linked.link[last].onward, newcomer, best)


@spliced
def try_passing(world: World, searcher: Searcher, linked: Linked, newcomer: Newcomer,
                enlarge: bool, best: float) -> float:
    """Try a customer first and last on routes drawn, as `insertion.passing` says."""
    active, number = searcher.active, searcher.count.active
    if number == 0:
        return best
    begin = below(searcher.rng, number)
    for index in range(begin, begin + min(MOST_DRAWN, number // EACH_DRAWN)):
        slot = active[index if index < number else index - number]
        joins = joining(world, searcher, slot, linked.run[slot], newcomer.node, enlarge)
        if joins.slot >= 0:
            best = try_ends(world, searcher, linked, joins, newcomer, best)
    return best


@spliced
def try_everywhere(world: World, searcher: Searcher, linked: Linked, newcomer: Newcomer,
                   enlarge: bool, best: float) -> float:
    """Try a customer on all routes with room. As `try_between`."""
    link = linked.link
    for index in range(searcher.count.active):
        slot = searcher.active[index]
        run = linked.run[slot]
        if rung(world.stop):
            break
        joins = joining(world, searcher, slot, run, newcomer.node, enlarge)
        if joins.slot < 0:
            continue
        best = try_ends(world, searcher, linked, joins, newcomer, best)
        before = run.first
        while before != run.last:
            behind = link[before].behind
            best = try_between(world, searcher, linked, joins, before, behind,
                               link[before].onward, newcomer, best)
            before = behind
    return best


@spliced
def insert_linked(world: World, searcher: Searcher, linked: Linked, node: int) -> bool:
    """Insert a customer where `searcher.move` says. In place; False if no slot is free."""
    move = searcher.move
    slot, before = move.slot, move.first
    if opens_route(move):
        slot, before = free_slot(world, searcher, move.type), world.type[move.type].begins_at
        if slot < 0:
            return False
        open_run(world, searcher, linked, slot, move.type)
    elif move.type != linked.run[slot].type:
        give_run(world, searcher, linked, slot, move.type)
    tie_in(world, linked, slot, before, node)
    if linked.timed:
        drive_on(world, linked, slot, node, 2)
        look_back(world, linked, slot, node, 2)
    return True


@spliced
def recreate_linked(world: World, searcher: Searcher, linked: Linked, first: int, spare: float
                    ) -> tuple[bool, float]:
    """Insert the absent customers from number `first` on. As `moves.recreate`.

    In place; returns whether all were tried, and what routes cost more then.
    """
    absent, count, total = searcher.absent, searcher.count, 0.0
    m = world.type[0].travel  # that of all types, looked up once for each customer
    opening, left = uniform(searcher.rng) < OPENING, first
    enlarge = world.traded and uniform(searcher.rng) < ENLARGED
    for index in range(first, count.absent):
        node = absent[index]
        cost = INFEASIBLE
        if rung(world.stop):
            return False, total
        newcomer = Newcomer(node, legs_to(world.back, m, node), legs_from(world.leg, m, node))
        alone = try_new_route(world, searcher, node)
        if opening and index == first:
            cost = alone
        else:
            cost = try_beside(world, searcher, linked, newcomer, enlarge, alone)
            cost = try_passing(world, searcher, linked, newcomer, enlarge, cost)
        if cost == INFEASIBLE:
            cost = try_everywhere(world, searcher, linked, newcomer, enlarge, cost)
        left_out = world.unassigned_cost + world.unassigned_more[node]
        wanted = cost < left_out or (opening and index == first)
        if cost == INFEASIBLE or not wanted or not insert_linked(world, searcher, linked, node):
            absent[left] = node
            left += 1
        else:
            total += cost
        spare -= min(cost, left_out)
        if spare < 0.0:
            return False, total
    count.absent = left
    return True, total
