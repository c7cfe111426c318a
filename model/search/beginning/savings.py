"""A first plan by savings: routes of one customer each, joined end to end.

References
----------
Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of delivery
points, Operations Research 12:568-581.
"""

import math

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import TIER
from model.kernel.leg import TravelLegs, leg, legs_of
from model.kernel.load import (
    NOTHING, Cargo, amount_of, cargo_for, demand_of, followed, holds_in, may_follow, release_of,
    total, write_amount,
)
from model.kernel.records import Record, Records, record
from model.kernel.shift import allows_stops
from model.kernel.start import leaves_first
from model.kernel.stop import (
    closing, end_of_service, latest_arrival, opening, places_of, service_duration,
)
from model.problem import BoolArray, IntArray
from model.search.ground.tables import detour
from model.search.route.layout import NOWHERE, World
from model.search.route.rarer import tiers_of

NEIGHBOURS = 64
"""With how many neighbours each customer's route may be joined."""

KEY_BITS = 62
"""Of a key at most."""

CHAIN = record("before", "behind", "route", "leave", "latest", "last", "length", "busy")
"""A customer in a chain: who comes before and behind; of its last, who comes first; the
departure and the latest arrival; of its first, who comes last, how many there are, and how long to
serve them and to drive from one to the next takes."""

CARGO = record("delivers", "picks", delivered=TIER, picked=TIER, most=TIER)
"""What a chain carries, by its first customer."""


def savings_routes(world: World, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes.

    Loads, stops, hard windows, the shift and the working duration are kept; what else is asked for
    is not looked at.

    Returns
    -------
    The customers of each route, in order.
    """
    ranks = min(NEIGHBOURS, world.near.shape[1])
    return routes_of(world, k, joined(world, k, ranks, ranked_pairs(world, k, ranks)))


def ranked_pairs(world: World, k: int, ranks: int) -> IntArray:
    """Return keys of customers and their nearest `ranks` neighbours, what saves most first.

    Equal savings come in the order of the pairs. `pair` tells what a key stands for.
    """
    keys = np.empty((world.num_nodes - world.num_depots) * ranks, np.int64)
    write_excess(world, k, ranks, keys)
    largest = max(abs(int(keys.min(initial=0))), int(keys.max(initial=0)))
    number_pairs(keys, max(0, largest.bit_length() + len(keys).bit_length() - KEY_BITS))
    return np.sort(keys[keys < 0])


def joined(world: World, k: int, ranks: int, keys: IntArray) -> Records:
    """Return chains (node,) of customers, one behind the other, joined by such keys in order."""
    chain = np.zeros(world.num_nodes, CHAIN)
    join(world, k, ranks, keys, chain, cargo_of(world))
    return chain


def cargo_of(world: World) -> Records:
    """Return room for what chains carry, (node, tier)."""
    return np.zeros((world.num_nodes, max(1, world.amount.shape[1])), CARGO)


def routes_of(world: World, k: int, chain: Records) -> list[list[int]]:
    """Return the customers of each route, in order."""
    first, behind = world.num_depots, chain["behind"].tolist()
    heads = first + np.flatnonzero(world.can[k, 0, first:] & (chain["before"][first:] == NOWHERE))
    return [_customers(behind, head) for head in heads.tolist()]


def cost_of(world: World, k: int, chain: Records) -> float:
    """Return what routes of a type cost but for their stops."""
    first = world.num_depots
    routes = np.count_nonzero(world.can[k, 0, first:] & (chain["before"][first:] == NOWHERE))
    rate = world.rate[k]
    return float(routes * rate.fixed + length_of(world, k, chain) * rate.distance)


def cost_by_savings(world: World, k: int) -> float:
    """Return what each customer costs by routes of a type, however many there may be."""
    customers = int(np.count_nonzero(world.can[k, 0, world.num_depots:]))
    if customers == 0:
        return math.inf
    ranks = min(NEIGHBOURS, world.near.shape[1])
    chain = joined(world, k, ranks, ranked_pairs(world, k, ranks))
    return cost_of(world, k, chain) / customers + float(world.rate[k].stop)


@compiled
def length_of(world: World, k: int, chain: Records) -> int:
    """Return how far the routes of all whom a type may serve are."""
    legs, kind = legs_of(world.leg, world.type[k].travel), world.type[k]
    length = 0
    for node in range(world.num_depots, world.num_nodes):
        if not world.can[k, 0, node]:
            continue
        before, behind = chain[node].before, chain[node].behind
        if before == NOWHERE:
            length += leg(legs, kind.begins_at, node).distance
        length += leg(legs, node, kind.ends_at if behind == NOWHERE else behind).distance
    return length


def by_nearest(world: World) -> BoolArray:
    """Return whom each type may serve, (row, 2, node), if each customer is one type's alone.

    It is that from whose depots the way there and back is shortest, the first of equals.
    """
    nearest = np.zeros(world.num_nodes, np.int64)
    write_nearest_types(world, nearest)
    can = world.can.copy()
    can[:world.num_types, 0] &= nearest == np.arange(world.num_types)[:, None]
    return can


@compiled
def write_nearest_types(world: World, nearest: IntArray) -> None:
    """Write which type's trucks drive least for a customer alone. In place: `nearest` (node,)."""
    for node in range(world.num_depots, world.num_nodes):
        least = -1
        for k in range(world.num_types):
            if world.can[k, 0, node]:
                legs, kind = legs_of(world.leg, world.type[k].travel), world.type[k]
                way = (leg(legs, kind.begins_at, node).distance
                       + leg(legs, node, kind.ends_at).distance)
                if least < 0 or way < least:
                    least, nearest[node] = way, k


@compiled
def write_excess(world: World, k: int, ranks: int, excess: IntArray) -> None:
    """Write how much more is driven if neighbours follow one another: less than 0, as a rule.

    In place: customer by customer, to the nearest `ranks`; 0 where there are not as many, and where
    the type may not serve both. The waiting or lateness that comes of it counts as a detour does
    that takes as long (`ground.tables.detour`), at the speed of drives from where routes begin.
    """
    legs, kind = legs_of(world.leg, world.type[k].travel), world.type[k]
    places = places_of(world.place, kind)
    distance, duration = 0.0, 0.0
    for node in range(world.num_depots, world.num_nodes):
        way = leg(legs, kind.begins_at, node)
        distance += way.distance
        duration += way.duration
    speed = distance / duration if duration > 0.0 else 0.0
    excess[:] = 0
    for a in range(world.num_depots, world.num_nodes):
        if not world.can[k, 0, a]:
            continue
        to_end, first = leg(legs, a, kind.ends_at).distance, (a - world.num_depots) * ranks
        leaves = end_of_service(places[a], 0)
        leaves_last = end_of_service(places[a], closing(places[a]))
        for rank in range(ranks):
            b = world.near[a, rank]
            if b >= 0 and world.can[k, 0, b]:
                way = leg(legs, a, b)
                more = detour(way.duration, leaves, leaves_last, opening(places[b], 0),
                              closing(places[b])) - way.duration
                excess[first + rank] = (way.distance + int(more * speed) - to_end
                                        - leg(legs, kind.begins_at, b).distance)


@compiled
def number_pairs(excess: IntArray, coarse: int) -> None:
    """Make keys of what pairs cost, but for its last `coarse` bits, and of their numbers. In place.

    Sorted as they are, which processors do many at a time.
    """
    for index in range(len(excess)):
        excess[index] = (excess[index] >> coarse) * len(excess) + index


@inlined
def pair(world: World, ranks: int, key: int) -> tuple[int, int]:
    """Return the customer and the neighbour, -1 for none, that a number or key stands for."""
    index = key % ((world.num_nodes - world.num_depots) * ranks)
    a = world.num_depots + index // ranks
    return a, int(world.near[a, index % ranks])


def _customers(behind: list[int], node: int) -> list[int]:
    customers = []
    while node != NOWHERE:
        customers.append(node)
        node = behind[node]
    return customers


@inlined
def chain_cargo(link: Record) -> Cargo:
    """Return what the chain that begins here carries."""
    return (amount_of(link.delivered), amount_of(link.picked), amount_of(link.most), link.delivers,
            link.picks)


@inlined
def set_chain_cargo(link: Record, cargo: Cargo) -> None:
    """Let the chain that begins here carry a cargo. In place."""
    write_amount(cargo[0], link.delivered)
    write_amount(cargo[1], link.picked)
    write_amount(cargo[2], link.most)
    link.delivers, link.picks = cargo[3], cargo[4]


@inlined
def set_up_cargo(world: World, node: int, cargo: Records) -> None:
    """Let a chain be one customer. In place: `cargo` (tier,)."""
    if tiers_of(world) == 0:
        demand = demand_of(world.place[0, node])
        set_chain_cargo(cargo[0], (demand, NOTHING, demand, total(demand), 0))
    for tier in range(tiers_of(world)):
        set_chain_cargo(cargo[tier], cargo_for(world.amount, node, tier))


@inlined
def may_join(kind: Record, front: Records, rear: Records) -> bool:
    """Tell whether a vehicle of a type may drive two chains as one, by their cargo (tier,)."""
    for tier in range(len(front)):
        one, other = chain_cargo(front[tier]), chain_cargo(rear[tier])
        if not (may_follow(kind, one, other)
                and holds_in(kind, followed(one, other)[2], tier)):
            return False
    return True


@compiled
def join(world: World, k: int, ranks: int, keys: IntArray, chain: Records,
         cargo: Records) -> None:
    """Join the route that ends at one and that which begins at the other, pair after pair.

    In place: `chain` (node,) and `cargo` (node, tier) are set up here.
    """
    kind = world.type[k]
    legs, places = legs_of(world.leg, kind.travel), places_of(world.place, kind)
    start, end = kind.begins_at, kind.ends_at
    for node in range(world.num_depots, world.num_nodes):
        place, link = places[node], chain[node]
        link.before, link.behind, link.route, link.last = NOWHERE, NOWHERE, node, node
        link.length, link.busy = 1, service_duration(place)
        set_up_cargo(world, node, cargo[node])
        ready = max(leaves_first(kind, kind.shift_earliest), release_of(place))
        link.leave = end_of_service(place, ready + leg(legs, start, node).duration)
        leave = kind.shift_latest - leg(legs, node, end).duration
        link.latest = latest_arrival(place, leave)
    for key in keys:
        a, b = pair(world, ranks, key)
        way = leg(legs, a, b).duration
        if (chain[a].behind != NOWHERE or chain[b].before != NOWHERE
                or chain[a].leave + way > chain[b].latest):
            continue
        head, tail = chain[a].route, chain[b].last
        length = chain[head].length + chain[b].length
        if (head != b and allows_stops(kind, length) and may_join(kind, cargo[head], cargo[b])
                and working(kind, legs, chain, a, b, head, tail, way)
                <= kind.max_working_duration):
            chain[head].busy += way + chain[b].busy
            link_up(places, legs, chain, a, b, head, tail)
            chain[head].length = length
            for tier in range(cargo.shape[1]):
                joined = followed(chain_cargo(cargo[head, tier]), chain_cargo(cargo[b, tier]))
                set_chain_cargo(cargo[head, tier], joined)


@inlined
def working(kind: Record, legs: TravelLegs, chain: Records, a: int, b: int, head: int, tail: int,
            way: int) -> int:
    """Return how long a vehicle works at least that drives the route to `a` and that from `b`.

    They begin with `head` and end with `tail`; from one to the other it drives for `way`.
    """
    latest = min(chain[head].latest, chain[b].latest - way - chain[head].busy)
    leaves = max(chain[tail].leave, chain[a].leave + way + chain[b].busy)
    busy = max(chain[head].busy + way + chain[b].busy, leaves - latest)
    return (leg(legs, kind.begins_at, head).duration + busy
            + leg(legs, tail, kind.ends_at).duration)


@compiled
def link_up(places: Records, legs: TravelLegs, chain: Records, a: int, b: int, head: int,
            tail: int) -> None:
    """Put the route from `b` to `tail` behind that from `head` to `a`. In place."""
    chain[a].behind, chain[b].before = b, a
    chain[head].last, chain[tail].route = tail, head
    node, leave = b, chain[a].leave + leg(legs, a, b).duration
    while node != NOWHERE:
        behind = chain[node].behind
        leave = end_of_service(places[node], leave)
        chain[node].leave = leave
        if behind != NOWHERE:
            leave += leg(legs, node, behind).duration
        node = behind
    node, latest = a, chain[b].latest - leg(legs, a, b).duration
    while node != NOWHERE:
        before = chain[node].before
        latest = latest_arrival(places[node], latest)
        chain[node].latest = latest
        if before != NOWHERE:
            latest -= leg(legs, before, node).duration
        node = before
