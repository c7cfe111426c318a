"""A first plan by savings: routes of one customer each, joined end to end.

References
----------
Clarke and Wright (1964), scheduling of vehicles from a central depot to a number of delivery
points, Operations Research 12:568-581.
"""

import math

import numpy as np

from typing import NamedTuple

from model.engine.library import call
from model.problem import BoolArray, IntArray
from model.search.route.layout import NOWHERE, ProblemData

class Joined(NamedTuple):
    """Customers joined to routes."""

    beside: IntArray  # (2, node) who comes before and behind each
    length: int  # of all routes, in mm


NEIGHBOURS = 64
"""With how many neighbours each customer's route may be joined."""


def savings_routes(data: ProblemData, k: int) -> list[list[int]]:
    """Join the customers that a truck of type `k` may serve to routes.

    Loads, stops, hard windows, the shift and the working duration are kept; what else is asked for
    is not looked at.

    Returns
    -------
    The customers of each route, in order.
    """
    return routes_of(data, k, _chain(data, k))


def ranked_pairs(data: ProblemData, k: int, ranks: int) -> IntArray:
    """Return keys of customers and their nearest `ranks` neighbours, what saves most first.

    Equal savings come in the order of the pairs. `pair` tells what a key stands for.
    """
    keys = np.empty((data.num_nodes - data.num_depots) * ranks, np.int64)
    call("tandem_write_pairs", data, k, ranks, keys)
    return np.sort(keys[keys < 0])


def joined(data: ProblemData, k: int, ranks: int, keys: IntArray,
           either_way: bool = False) -> Joined:
    """Return routes that are joined by such keys in order."""
    beside = np.full((2, data.num_nodes), NOWHERE)
    return Joined(beside, call("tandem_join", data, k, ranks, keys, either_way, beside))


def routes_of(data: ProblemData, k: int, found: Joined) -> list[list[int]]:
    """Return the customers of each route, in order."""
    behind, heads = found.beside[1].tolist(), _heads(data, k, found)
    return [_customers(behind, head) for head in np.flatnonzero(heads).tolist()]


def cost_of(data: ProblemData, k: int, found: Joined) -> float:
    """Return what routes of a type cost but for their stops."""
    routes, rate = np.count_nonzero(_heads(data, k, found)), data.rate[k]
    return float(routes * rate.fixed + found.length * rate.distance)


def cost_by_savings(data: ProblemData, k: int) -> float:
    """Return what each customer costs by routes of a type, however many there may be."""
    customers = int(np.count_nonzero(data.can[k, 0, data.num_depots:]))
    if customers == 0:
        return math.inf
    return cost_of(data, k, _chain(data, k)) / customers + float(data.rate[k].stop)


def by_nearest(data: ProblemData) -> BoolArray:
    """Return whom each type may serve, (row, 2, node), if each customer is one type's alone.

    It is that from whose depots the way there and back is shortest, the first of equals.
    """
    nearest = np.zeros(data.num_nodes, np.int64)
    call("tandem_write_nearest_types", data, nearest)
    can = data.can.copy()
    can[:data.num_types, 0] &= nearest == np.arange(data.num_types)[:, None]
    return can


def _heads(data: ProblemData, k: int, found: Joined) -> BoolArray:
    """Mark the customers (node,) with whom routes of a type begin."""
    heads: BoolArray = data.can[k, 0] & (found.beside[0] == NOWHERE)
    heads[: data.num_depots] = False
    return heads


def _chain(data: ProblemData, k: int) -> Joined:
    """Return routes that are joined by what following nearest neighbours saves."""
    ranks = min(NEIGHBOURS, data.near.shape[1])
    return joined(data, k, ranks, ranked_pairs(data, k, ranks))


def _customers(behind: list[int], node: int) -> list[int]:
    customers = []
    while node != NOWHERE:
        customers.append(node)
        node = behind[node]
    return customers
