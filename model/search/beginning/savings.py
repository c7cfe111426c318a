"""A first plan by savings: routes of one customer each, joined end to end.

References
----------
Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of delivery
points, Operations Research 12:568-581.
"""

import math

import numpy as np

from model.engine.library import call, dtype_of
from model.kernel.records import Records
from model.problem import BoolArray, IntArray
from model.search.route.layout import NOWHERE, World

NEIGHBOURS = 64
"""With how many neighbours each customer's route may be joined."""

KEY_BITS = 62
"""Of a key at most."""


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
    call("tandem_write_excess", world, k, ranks, keys)
    largest = max(abs(int(keys.min(initial=0))), int(keys.max(initial=0)))
    coarse = max(0, largest.bit_length() + len(keys).bit_length() - KEY_BITS)
    call("tandem_number_pairs", keys, coarse)
    return np.sort(keys[keys < 0])


def joined(world: World, k: int, ranks: int, keys: IntArray) -> Records:
    """Return chains (node,) of customers, one behind the other, joined by such keys in order."""
    chain = chains_of(world)
    call("tandem_join", world, k, ranks, keys, chain, cargo_of(world))
    return chain


def chains_of(world: World) -> Records:
    """Return room for chains, (node,)."""
    return np.zeros(world.num_nodes, dtype_of("tandem_chain"))


def cargo_of(world: World) -> Records:
    """Return room for what chains carry, (node, tier)."""
    return np.zeros((world.num_nodes, max(1, world.amount.shape[1])),
                    dtype_of("tandem_chain_cargo"))


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
    return float(routes * rate.fixed + call("tandem_length_of", world, k, chain) * rate.distance)


def cost_by_savings(world: World, k: int) -> float:
    """Return what each customer costs by routes of a type, however many there may be."""
    customers = int(np.count_nonzero(world.can[k, 0, world.num_depots:]))
    if customers == 0:
        return math.inf
    ranks = min(NEIGHBOURS, world.near.shape[1])
    chain = joined(world, k, ranks, ranked_pairs(world, k, ranks))
    return cost_of(world, k, chain) / customers + float(world.rate[k].stop)


def by_nearest(world: World) -> BoolArray:
    """Return whom each type may serve, (row, 2, node), if each customer is one type's alone.

    It is that from whose depots the way there and back is shortest, the first of equals.
    """
    nearest = np.zeros(world.num_nodes, np.int64)
    call("tandem_write_nearest_types", world, nearest)
    can = world.can.copy()
    can[:world.num_types, 0] &= nearest == np.arange(world.num_types)[:, None]
    return can


def _customers(behind: list[int], node: int) -> list[int]:
    customers = []
    while node != NOWHERE:
        customers.append(node)
        node = behind[node]
    return customers
