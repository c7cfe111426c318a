"""A first plan by savings of routes that may be driven either way, where loads alone limit them.

Pairs of customers are joined in the order of what that saves, each where it is first or last on its
route, whichever: routes are turned round as needed. Where they are long that leaves far fewer
pieces than joining ends to beginnings, elsewhere it is a little worse: so both are tried.
"""

import numpy as np

from model.engine.library import call
from model.engine.records import Records
from model.search.beginning.savings import (
    cargo_of, chains_of, cost_of, joined, ranked_pairs, routes_of,
)
from model.search.route.layout import NOWHERE, ProblemData


def shortest_routes(data: ProblemData, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes, in both ways.

    Legs are as long there as back; loads alone limit a route, and what is picked up comes from
    nobody.

    Returns
    -------
    The customers of each route, in order, by the way that leaves fewer routes without a vehicle or,
    if both leave as few, is shorter.
    """
    ranks, count = data.near.shape[1], int(data.type[k].count)
    keys = ranked_pairs(data, k, ranks)
    chains = [joined(data, k, ranks, keys), chains_of(data)]
    call("tandem_join_either_way", data, k, ranks, keys, chains[1], cargo_of(data))

    def cost(chain: Records) -> tuple[int, float]:
        routes = int(np.count_nonzero(chain["before"][data.num_depots:] == NOWHERE))
        return max(0, routes - count), cost_of(data, k, chain)

    return routes_of(data, k, min(chains, key=cost))
