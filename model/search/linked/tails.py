"""Tails of routes, swapped among linked stops, or driven as a route of their own."""

import math
from typing import NamedTuple

from model.kernel.compiled import inlined, spliced
from model.kernel.leg import (
    LegRow, distance_from, distance_to, leg, legs_from, legs_of, legs_to,
)
from model.kernel.load import (
    NOTHING, Amount, amount_of, demand_of, holds, minus, plus, write_amount,
)
from model.kernel.records import Record
from model.kernel.stop import end_of_service, places_of, too_late
from model.search.linked.chain import (
    close_run, connect, drive_on, due_at, leaves_at, look_back, open_run,
)
from model.search.linked.layout import Linked
from model.search.moves.exchange import NEIGHBOURS
from model.search.route.layout import NOWHERE, World
from model.search.route.refresh import draw_customer
from model.search.route.state import Searcher, free_slot
from model.search.route.randomness import uniform


@spliced
def may_serve(world: World, linked: Linked, k: int, node: int) -> bool:
    """Tell whether type `k` may serve a customer and all who come behind."""
    while node >= world.num_depots:
        if not world.can[k, 0, node]:
            return False
        node = linked.link[node].behind
    return True


@spliced
def come_in_time(world: World, linked: Linked, k: int, node: int, before: int, other: int) -> bool:
    """Tell whether `other` may come behind a customer, who now does behind `before`.

    On routes of one type `k`, so that all are to be reached as late as now.
    """
    kind, after = world.type[k], linked.link[node].behind
    legs = legs_of(world.leg, kind.travel)
    if (linked.link[node].leave + leg(legs, node, other).duration
            > due_at(world, linked, kind, other)):
        return False
    if before < world.num_depots and after < world.num_depots:
        return True
    return (leaves_at(world, linked, kind, before) + leg(legs, before, after).duration
            <= due_at(world, linked, kind, after))


@spliced
def drives_in_time(world: World, linked: Linked, k: int, before: int, node: int) -> bool:
    """Tell whether a vehicle of type `k` may drive from a stop to a customer and all behind.

    `node` is a depot if there are none.
    """
    kind = world.type[k]
    legs, places = legs_of(world.leg, kind.travel), places_of(world.place, kind)
    time = leaves_at(world, linked, kind, before)
    while node >= world.num_depots:
        time += leg(legs, before, node).duration
        if too_late(places[node], time):
            return False
        time = end_of_service(places[node], time)
        before, node = node, linked.link[node].behind
    return time + leg(legs, before, kind.ends_at).duration <= kind.shift_latest


@spliced
def longer_home(world: World, linked: Linked, slot: int, k: int) -> int:
    """Return how much longer a route's last leg is to where routes of type `k` end."""
    last = linked.run[slot].last
    onward = legs_from(world.leg, world.type[k].travel, last)
    return distance_to(onward, world.type[k].ends_at) - linked.link[last].onward


@spliced
def tail_from(world: World, linked: Linked, node: int) -> tuple[int, int]:
    """Return how far a route is driven from a customer on, and how many there are from there on."""
    distance = count = 0
    while node >= world.num_depots:
        distance += linked.link[node].onward
        count += 1
        node = linked.link[node].behind
    return distance, count


@spliced
def cost_of_swap(world: World, linked: Linked, here: LegRow, to_after: LegRow, node: int,
                 other: int) -> float:
    """Return what it costs to swap the tails behind a customer and before another.

    `here` are the legs from the customer, `to_after` those to who comes behind.
    """
    link, after = linked.link, linked.link[node].behind
    a, b, before = link[node].slot, link[other].slot, link[other].before
    k, by = linked.run[a].type, linked.run[b].type
    rate, rate_by = world.rate[k], world.rate[by]
    more, more_by = distance_to(here, other) - link[node].onward, -link[other].inward
    if world.type[by].ends_at != world.type[k].ends_at:
        more += longer_home(world, linked, b, k)
        if after >= world.num_depots:
            more_by += longer_home(world, linked, a, by)
    if after >= world.num_depots:
        more_by += distance_from(to_after, before)
    elif before >= world.num_depots:
        onward = legs_from(world.leg, world.type[by].travel, before)
        more_by += distance_to(onward, world.type[by].ends_at)
    cost = more * rate.distance + more_by * rate_by.distance
    if rate.distance != rate_by.distance or rate.stop != rate_by.stop:
        tail, count = tail_from(world, linked, after)
        other_tail, others = tail_from(world, linked, other)
        cost += ((other_tail - tail) * (rate.distance - rate_by.distance)
                 + (others - count) * (rate.stop - rate_by.stop))
    if after < world.num_depots and before < world.num_depots:
        cost -= rate_by.fixed
    return cost


@spliced
def find_tail_linked(world: World, searcher: Searcher, linked: Linked, node: int, limit: float
                     ) -> tuple[int, int, float]:
    """Return the slot whose tail is best swapped with that behind a customer, who leads it.

    And what that costs. NOWHERE if that is not less than `limit`; an empty slot, led by the end of
    its route, for a new one.
    """
    link, a, after = linked.link, linked.link[node].slot, linked.link[node].behind
    k = linked.run[a].type
    kind, rate = world.type[k], world.rate[k]
    here = legs_from(world.leg, kind.travel, node)
    to_after = legs_to(world.back, kind.travel, after)
    chosen, leader, best = NOWHERE, NOWHERE, limit
    for rank in range(min(NEIGHBOURS, world.near.shape[1])):
        other = int(world.near[node, rank])
        if other < 0:
            break
        b = link[other].slot
        if b < 0 or b == a:
            continue
        by = linked.run[b].type
        if by != k and not world.splice[k, by]:
            continue
        cost = cost_of_swap(world, linked, here, to_after, node, other)
        if cost >= best or (by != k and not (may_serve(world, linked, k, other)
                                             and may_serve(world, linked, by, after))):
            continue
        if by != k or not linked.timed or come_in_time(
                world, linked, k, node, link[other].before, other):
            chosen, leader, best = b, other, cost
    if after >= world.num_depots:
        detour = (distance_to(here, kind.ends_at) - link[node].onward
                  + distance_from(to_after, kind.begins_at))
        cost, slot = rate.fixed + detour * rate.distance, free_slot(world, searcher, k)
        if slot >= 0 and cost < best and (not linked.timed or come_in_time(
                world, linked, k, node, kind.begins_at, kind.ends_at)):
            return slot, kind.ends_at, cost
    return chosen, leader, best


class Part(NamedTuple):
    """Customers in a row on a route."""

    load: Amount
    customers: int
    distance: int  # up to the last of them: of a head from the depot, of a tail from its first


@spliced
def head_until(world: World, linked: Linked, node: int) -> Part:
    """Return the part of a route up to a customer, none if that is a depot."""
    load, count, distance = NOTHING, 0, 0
    while node >= world.num_depots:
        load = plus(load, demand_of(world.place[0, node]))
        count += 1
        distance += linked.link[node].inward
        node = linked.link[node].before
    return Part(load, count, distance)


@inlined
def tail_behind(world: World, linked: Linked, run: Record, head: Part, first: int) -> Part:
    """Return the part of a route behind its head, which a customer leads, none if a depot does."""
    if first < world.num_depots:
        return Part(NOTHING, 0, 0)
    around = linked.link[first].inward + linked.link[run.last].onward
    return Part(minus(amount_of(run.load), head.load), run.count - head.customers,
                run.distance - head.distance - around)


@spliced
def assign(world: World, linked: Linked, node: int, slot: int) -> None:
    """Let a customer and all who come behind be served by the route in a slot. In place."""
    while node >= world.num_depots:
        linked.link[node].slot = slot
        node = linked.link[node].behind


@spliced
def end_with(world: World, linked: Linked, slot: int, head: Part, before: int, tail: Part,
             first: int, last: int) -> None:
    """Let a route go on behind its head, which `before` ends, with another's tail. In place."""
    run = linked.run[slot]
    end = world.type[run.type].ends_at
    assign(world, linked, first, slot)
    run.distance = head.distance + tail.distance
    run.distance += connect(world, linked, slot, before, first if tail.customers > 0 else end)
    if tail.customers > 0:
        run.distance += connect(world, linked, slot, last, end)
    run.count = head.customers + tail.customers
    write_amount(plus(head.load, tail.load), run.load)
    if linked.timed:
        drive_on(world, linked, slot, first, 1)
        look_back(world, linked, slot, run.last, tail.customers + 1)


@spliced
def swap_tails_linked(world: World, searcher: Searcher, linked: Linked, node: int, b: int,
                      other: int) -> bool:
    """Let `other`, of the route in slot `b`, come behind a customer, whose tail ends that route.

    In place; False if a vehicle can't hold that, and nothing has changed.
    """
    link, a = linked.link, linked.link[node].slot
    one, two = linked.run[a], linked.run[b]
    k, after, is_new = one.type, link[node].behind, other < world.num_depots
    by = k if is_new else two.type
    before = world.type[k].begins_at if is_new else link[other].before
    head, head_by = head_until(world, linked, node), head_until(world, linked, before)
    tail = tail_behind(world, linked, one, head, after)
    tail_by = tail_behind(world, linked, two, head_by, other)
    if not (holds(world.type[k], plus(head.load, tail_by.load))
            and holds(world.type[by], plus(head_by.load, tail.load))):
        return False
    # Vehicles of other types may have to be home at other times, and elsewhere.
    if by != k and linked.timed and not (
            drives_in_time(world, linked, k, node, other)
            and ((before < world.num_depots and after < world.num_depots)
                 or drives_in_time(world, linked, by, before, after))):
        return False
    if is_new:
        open_run(world, searcher, linked, b, k)
    last, last_by = one.last, two.last
    end_with(world, linked, a, head, node, tail_by, other, last_by)
    end_with(world, linked, b, head_by, before, tail, after, last)
    if two.count == 0:
        close_run(searcher, linked, b)
    return True


@spliced
def exchange_tails_linked(world: World, searcher: Searcher, linked: Linked
                          ) -> tuple[int, int, float]:
    """Swap the tail behind a random customer if that is accepted. In place.

    Returns the slots of both routes, NOWHERE if none was, and what it costs.
    """
    limit = -searcher.value.temperature * math.log(1.0 - uniform(searcher.rng))
    node = draw_customer(world, searcher.now, searcher.count.focus, searcher.rng)
    a = linked.link[node].slot
    if a < 0:
        return NOWHERE, NOWHERE, 0.0
    b, other, cost = find_tail_linked(world, searcher, linked, node, limit)
    if b < 0 or not swap_tails_linked(world, searcher, linked, node, b, other):
        return NOWHERE, NOWHERE, 0.0
    return a, b, cost
