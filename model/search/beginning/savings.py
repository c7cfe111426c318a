"""A first plan by savings: routes of one customer each, joined end to end.

References
----------
Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of delivery
points, Operations Research 12:568-581.
"""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import MAX_DIMENSIONS
from model.kernel.leg import leg, legs_of
from model.kernel.load import Amount, demand_of, holds, plus, release_of
from model.kernel.records import Record, Records, record
from model.kernel.shift import allows_stops
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, latest_arrival
from model.problem import IntArray
from model.search.route.layout import NOWHERE, World

NEIGHBOURS = 64
"""With how many neighbours each customer's route may be joined."""

CHAIN = record("before", "behind", "route", "leave", "latest", "last", "length",
               load=MAX_DIMENSIONS)
"""A customer in a chain: who comes before and behind; of its last, who comes first; the
departure and the latest arrival; of its first, who comes last, how many there are, and the load."""


def savings_routes(world: World, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes.

    Loads, stops, hard windows and the shift are kept; what else is asked for is not looked at.

    Returns
    -------
    The customers of each route, in order.
    """
    first, nodes = world.num_depots, np.arange(world.num_depots, world.num_nodes)
    distance = world.leg[world.type[k].travel, :, :, 1]
    start, end = int(world.type[k].begins_at), int(world.type[k].ends_at)
    other = world.near[first:, :NEIGHBOURS]
    known = other >= 0
    one = np.broadcast_to(nodes[:, None], other.shape)[known]
    other = other[known]
    saving = distance[one, end] + distance[start, other] - distance[one, other]
    order = np.argsort(-saving, kind="stable")
    order = order[saving[order] > 0]
    chain = np.zeros(world.num_nodes, CHAIN)
    join(world, k, one[order], other[order], chain)
    heads = [int(node) for node in nodes
             if world.can[k, 0, node] and chain[node].before == NOWHERE]
    return [_customers(chain, head) for head in heads]


def _customers(chain: Records, node: int) -> list[int]:
    customers = []
    while node != NOWHERE:
        customers.append(node)
        node = int(chain[node].behind)
    return customers


@inlined
def chain_load(link: Record) -> Amount:
    """Return what the chain that begins here carries."""
    return link.load[0], link.load[1], link.load[2]


@inlined
def set_chain_load(link: Record, amount: Amount) -> None:
    """Let the chain that begins here carry an amount. In place."""
    link.load[0], link.load[1], link.load[2] = amount


@compiled
def join(world: World, k: int, one: IntArray, other: IntArray, chain: Records) -> None:
    """Join the route that ends at `one` and that which begins at `other`, pair after pair.

    In place: `chain` (node,) is set up here.
    """
    kind = world.type[k]
    legs = legs_of(world.leg, kind.travel)
    start, end = kind.begins_at, kind.ends_at
    for node in range(world.num_depots, world.num_nodes):
        place, link = world.place[node], chain[node]
        link.before, link.behind, link.route, link.last = NOWHERE, NOWHERE, node, node
        set_chain_load(link, demand_of(place))
        link.length = 1
        ready = max(leaves_first(kind, kind.shift_earliest), release_of(place))
        link.leave = end_of_service(place, ready + leg(legs, start, node).duration)
        leave = kind.shift_latest - leg(legs, node, end).duration
        link.latest = latest_arrival(place, leave)
    for index in range(len(one)):
        a, b = one[index], other[index]
        if (chain[a].behind != NOWHERE or chain[b].before != NOWHERE
                or not (world.can[k, 0, a] and world.can[k, 0, b])
                or chain[a].leave + leg(legs, a, b).duration > chain[b].latest):
            continue
        head, tail = chain[a].route, chain[b].last
        load = plus(chain_load(chain[head]), chain_load(chain[b]))
        length = chain[head].length + chain[b].length
        if head != b and holds(kind, load) and allows_stops(kind, length):
            link_up(world, legs, chain, a, b, head, tail)
            set_chain_load(chain[head], load)
            chain[head].length = length


@compiled
def link_up(world: World, legs: IntArray, chain: Records, a: int, b: int, head: int,
            tail: int) -> None:
    """Put the route from `b` to `tail` behind that from `head` to `a`. In place."""
    chain[a].behind, chain[b].before = b, a
    chain[head].last, chain[tail].route = tail, head
    node, leave = b, chain[a].leave + leg(legs, a, b).duration
    while node != NOWHERE:
        behind = chain[node].behind
        leave = end_of_service(world.place[node], leave)
        chain[node].leave = leave
        if behind != NOWHERE:
            leave += leg(legs, node, behind).duration
        node = behind
    node, latest = a, chain[b].latest - leg(legs, a, b).duration
    while node != NOWHERE:
        before = chain[node].before
        latest = latest_arrival(world.place[node], latest)
        chain[node].latest = latest
        if before != NOWHERE:
            latest -= leg(legs, before, node).duration
        node = before
