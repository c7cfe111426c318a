"""A first plan by savings: routes of one customer each, joined end to end.

References
----------
Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of delivery
points, Operations Research 12:568-581.
"""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.instance import (
    MAX_DIMENSIONS, TYPE_EARLIEST, TYPE_END, TYPE_LATEST, TYPE_START, TYPE_TRAVEL,
    NODE_RELEASE,
)
from model.kernel.leg import leg, legs_of
from model.kernel.load import Amount, demand_of, holds, plus
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, latest_arrival
from model.problem import IntArray
from model.search.route.layout import NOWHERE, World

NEIGHBOURS = 64
"""With how many neighbours each customer's route may be joined."""

C_BEFORE, C_BEHIND, C_ROUTE, C_LEAVE, C_LATEST, C_LAST, C_LOAD = range(7)
CHAIN_COLUMNS = C_LOAD + MAX_DIMENSIONS
"""Columns of a customer in a chain: who comes before and behind; of its last, who comes first; the
departure and the latest arrival; of its first, who comes last, and the load."""


def savings_routes(world: World, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes.

    Loads, hard windows and the shift are kept; what else is asked for is not looked at.

    Returns
    -------
    The customers of each route, in order.
    """
    first, nodes = world.num_depots, np.arange(world.num_depots, world.num_nodes)
    distance = world.leg[world.type[k, TYPE_TRAVEL], :, :, 1]
    start, end = int(world.type[k, TYPE_START]), int(world.type[k, TYPE_END])
    other = world.near[first:, :NEIGHBOURS]
    known = other >= 0
    one = np.broadcast_to(nodes[:, None], other.shape)[known]
    other = other[known]
    saving = distance[one, end] + distance[start, other] - distance[one, other]
    order = np.argsort(-saving, kind="stable")
    order = order[saving[order] > 0]
    chain = np.zeros((world.num_nodes, CHAIN_COLUMNS), np.int64)
    join(world, k, one[order], other[order], chain)
    heads = [int(node) for node in nodes
             if world.can[k, 0, node] and chain[node, C_BEFORE] == NOWHERE]
    return [_customers(chain, head) for head in heads]


def _customers(chain: IntArray, node: int) -> list[int]:
    customers = []
    while node != NOWHERE:
        customers.append(node)
        node = int(chain[node, C_BEHIND])
    return customers


@inlined
def chain_load(link: IntArray) -> Amount:
    """Return what the chain that begins here carries."""
    return link[C_LOAD], link[C_LOAD + 1], link[C_LOAD + 2]


@inlined
def set_chain_load(link: IntArray, amount: Amount) -> None:
    """Let the chain that begins here carry an amount. In place."""
    link[C_LOAD], link[C_LOAD + 1], link[C_LOAD + 2] = amount


@compiled
def join(world: World, k: int, one: IntArray, other: IntArray, chain: IntArray) -> None:
    """Join the route that ends at `one` and that which begins at `other`, pair after pair.

    In place: `chain` (node, CHAIN_COLUMNS) is set up here.
    """
    columns = world.type[k]
    legs = legs_of(world.leg, columns[TYPE_TRAVEL])
    start, end = columns[TYPE_START], columns[TYPE_END]
    for node in range(world.num_depots, world.num_nodes):
        place, link = world.place[node], chain[node]
        link[C_BEFORE], link[C_BEHIND], link[C_ROUTE], link[C_LAST] = NOWHERE, NOWHERE, node, node
        set_chain_load(link, demand_of(place))
        ready = max(leaves_first(columns, columns[TYPE_EARLIEST]), place[NODE_RELEASE])
        link[C_LEAVE] = end_of_service(place, ready + leg(legs, start, node).duration)
        leave = columns[TYPE_LATEST] - leg(legs, node, end).duration
        link[C_LATEST] = latest_arrival(place, leave)
    for index in range(len(one)):
        a, b = one[index], other[index]
        if (chain[a, C_BEHIND] != NOWHERE or chain[b, C_BEFORE] != NOWHERE
                or not (world.can[k, 0, a] and world.can[k, 0, b])
                or chain[a, C_LEAVE] + leg(legs, a, b).duration > chain[b, C_LATEST]):
            continue
        head, tail = chain[a, C_ROUTE], chain[b, C_LAST]
        load = plus(chain_load(chain[head]), chain_load(chain[b]))
        if head != b and holds(columns, load):
            link_up(world, legs, chain, a, b, head, tail)
            set_chain_load(chain[head], load)


@compiled
def link_up(world: World, legs: IntArray, chain: IntArray, a: int, b: int, head: int,
            tail: int) -> None:
    """Put the route from `b` to `tail` behind that from `head` to `a`. In place."""
    chain[a, C_BEHIND], chain[b, C_BEFORE] = b, a
    chain[head, C_LAST], chain[tail, C_ROUTE] = tail, head
    node, leave = b, chain[a, C_LEAVE] + leg(legs, a, b).duration
    while node != NOWHERE:
        behind = chain[node, C_BEHIND]
        leave = end_of_service(world.place[node], leave)
        chain[node, C_LEAVE] = leave
        if behind != NOWHERE:
            leave += leg(legs, node, behind).duration
        node = behind
    node, latest = a, chain[b, C_LATEST] - leg(legs, a, b).duration
    while node != NOWHERE:
        before = chain[node, C_BEFORE]
        latest = latest_arrival(world.place[node], latest)
        chain[node, C_LATEST] = latest
        if before != NOWHERE:
            latest -= leg(legs, before, node).duration
        node = before
