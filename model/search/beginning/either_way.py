"""A first plan by savings of routes that may be driven either way, where loads alone limit them.

Pairs of customers are joined in the order of what that saves, each where it is first or last on its
route, whichever: routes are turned round as needed. Once none near its end is left, one with room
goes on to whomever that saves most. Where routes are long, or towns are far away, that leaves far
fewer pieces than joining ends to beginnings, elsewhere it is a little worse: so both are tried.
"""

import numpy as np

from model.search.beginning.savings import (
    NEIGHBOURS, Joined, cost_of, joined, ranked_pairs, routes_of)
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
    ranks, count = min(NEIGHBOURS, data.near.shape[1]), int(data.type[k].count)
    keys = ranked_pairs(data, k, ranks)
    ways = [joined(data, k, ranks, keys, either_way) for either_way in (False, True)]

    def cost(found: Joined) -> tuple[int, float]:
        routes = int(np.count_nonzero(found.beside[0, data.num_depots:] == NOWHERE))
        return max(0, routes - count), cost_of(data, k, found)

    return routes_of(data, k, min(ways, key=cost))
