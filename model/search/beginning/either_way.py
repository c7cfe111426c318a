"""A first plan by savings of routes that may be driven either way, where loads alone limit them.

Pairs of customers are joined in the order of what that saves, each where it is first or last on its
route, whichever: routes are turned round as needed. Where they are long that leaves far fewer
pieces than joining ends to beginnings, elsewhere it is a little worse: so both are tried.
"""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.kernel.load import followed
from model.kernel.records import Record, Records
from model.kernel.shift import allows_stops
from model.problem import IntArray
from model.search.beginning.savings import (
    CHAIN, cargo_of, chain_cargo, cost_of, joined, may_join, pair, ranked_pairs, routes_of,
    set_chain_cargo, set_up_cargo,
)
from model.search.route.layout import NOWHERE, World


def shortest_routes(world: World, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes, in both ways.

    Legs are as long there as back; loads alone limit a route, and what is picked up comes from
    nobody.

    Returns
    -------
    The customers of each route, in order, by the way that leaves fewer routes without a vehicle or,
    if both leave as few, is shorter.
    """
    ranks, count = world.near.shape[1], int(world.type[k].count)
    keys = ranked_pairs(world, k, ranks)
    chains = [joined(world, k, ranks, keys), np.zeros(world.num_nodes, CHAIN)]
    join_either_way(world, k, ranks, keys, chains[1], cargo_of(world))

    def cost(chain: Records) -> tuple[int, float]:
        routes = int(np.count_nonzero(chain["before"][world.num_depots:] == NOWHERE))
        return max(0, routes - count), cost_of(world, k, chain)

    return routes_of(world, k, min(chains, key=cost))


@compiled
def join_either_way(world: World, k: int, ranks: int, keys: IntArray, chain: Records,
                    cargo: Records) -> None:
    """Join routes at either end, pair after pair. In place, as `join`."""
    kind = world.type[k]
    for node in range(world.num_depots, world.num_nodes):
        link = chain[node]
        link.before, link.behind, link.route, link.length = NOWHERE, NOWHERE, node, 1
        set_up_cargo(world, node, cargo[node])
    for key in keys:
        a, b = pair(world, ranks, key)
        if is_amid(chain[a]) or is_amid(chain[b]):
            continue
        one, other = route_of(chain, a), route_of(chain, b)
        length = chain[one].length + chain[other].length
        if (one != other and allows_stops(kind, length)
                and may_join(kind, cargo[one], cargo[other])):
            chain[other].route, chain[one].length = one, length
            for tier in range(cargo.shape[1]):
                both = followed(chain_cargo(cargo[one, tier]), chain_cargo(cargo[other, tier]))
                set_chain_cargo(cargo[one, tier], both)
            link_to(chain[a], b)
            link_to(chain[b], a)
    for node in range(world.num_depots, world.num_nodes):
        chain[node].last = NOWHERE
    for node in range(world.num_depots, world.num_nodes):
        if chain[node].last == NOWHERE and not is_amid(chain[node]):
            set_out(chain, node)


@inlined
def is_amid(link: Record) -> bool:
    """Tell whether a customer has one beside him on both sides."""
    return link.before != NOWHERE and link.behind != NOWHERE


@inlined
def link_to(link: Record, node: int) -> None:
    """Put a customer beside one who has room there. In place."""
    if link.before == NOWHERE:
        link.before = node
    else:
        link.behind = node


@inlined
def route_of(chain: Records, node: int) -> int:
    """Return the customer who stands for a route, and shorten the way there. In place.

    References
    ----------
    Tarjan and van Leeuwen (1984), worst-case analysis of set union algorithms, Journal of the ACM
    31:245-281.
    """
    while chain[node].route != node:
        chain[node].route = chain[chain[node].route].route
        node = chain[node].route
    return node


@inlined
def set_out(chain: Records, node: int) -> None:
    """Turn all on a route so that it begins with one at its end. In place."""
    before = NOWHERE
    while node != NOWHERE:
        link = chain[node]
        behind = link.before if link.behind == before else link.behind
        link.before, link.behind, link.last = before, behind, node
        before, node = node, behind
