"""What a search holds, and what its routes would take."""

from copy import deepcopy

import numpy as np

from model.search.beginning.translate import left_out, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import make_rooms
from model.solution import Solution


def read_plan(data: ProblemData, searcher: Searcher) -> Solution:
    """Return the best plan found, each trip begun as late as costs nothing."""
    return Solution(tuple(read_routes(data, searcher)), left_out(data, searcher))


def copied(data: ProblemData, searcher: Searcher) -> Searcher:
    """Return another search that is where one is, and keeps no places."""
    fresh, = make_rooms(data, searcher, [np.random.SeedSequence(0)])
    return Searcher._make((*map(deepcopy, searcher[:-1]), fresh.own))


def beside_neighbours(data: ProblemData, searcher: Searcher, node: int) -> float:
    """Return the cheapest insertion of a customer beside a neighbour; infinite if there is none.

    All neighbours are looked at.
    """
    now, kind, rate = searcher.now, data.type[0], data.rate[0]
    assert isinstance(data.leg, np.ndarray)
    legs, demand = data.leg[0, :, :, 1], data.place[0, :, 0]["demand"][:, 0]
    least = np.inf
    for other in data.granular[node].tolist():
        slot, p, _ = now.where[other].tolist()
        if slot < 0:
            continue
        nodes = now.stop[slot, : now.route[slot].length]["node"]
        if demand[nodes].sum() + demand[node] <= kind.capacity[0]:
            for a, b in ((nodes[p - 1], other), (other, nodes[p + 1])):
                least = min(least, float(legs[a, node] + legs[node, b] - legs[a, b]))
    return least * rate.distance + rate.stop
