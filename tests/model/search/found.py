"""What a search holds, and what its routes would take."""

import numpy as np

from model.engine.library import call
from model.problem import IntArray
from model.search.beginning.translate import left_out, read_routes
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher
from model.search.sharing import go_on_from_best, make_rooms, take_all
from model.solution import Route, Solution

INFEASIBLE = 1e300
"""What an insertion costs that can't be."""


def read_plan(data: ProblemData, searcher: Searcher) -> Solution:
    """Return the best plan found, each trip begun as late as costs nothing."""
    return Solution(read_routes(data, searcher), left_out(data, searcher))


def copied(data: ProblemData, searcher: Searcher) -> Searcher:
    """Return another search whose routes, and best ones, are those of one, and keeps no places."""
    fresh, = make_rooms(data, searcher, [np.random.SeedSequence(0)])
    take_all(data, searcher, fresh)
    return fresh


def at_best(data: ProblemData, searcher: Searcher) -> Searcher:
    """Return another search that goes on from the best routes of one; costs are added up anew."""
    fresh, = make_rooms(data, searcher, [np.random.SeedSequence(0)])
    call("tandem_add_routes", data, fresh, searcher, True, True)
    go_on_from_best(data, fresh)
    return fresh


def nodes_of(searcher: Searcher) -> IntArray:
    """Return whom each route serves as it is, in order, each route ended by NOWHERE."""
    nodes = np.empty(2 * len(searcher.absences), np.int64)
    return nodes[:call("tandem_write_served", searcher, nodes)]


def served_by(searcher: Searcher) -> list[list[int]]:
    """Return whom trucks serve by each route as it is."""
    nodes = nodes_of(searcher)
    return [part[:-1].tolist() for part in np.split(nodes, np.flatnonzero(nodes < 0) + 1)[:-1]]


def beside_neighbours(data: ProblemData, routes: tuple[Route, ...], node: int) -> float:
    """Return the cheapest insertion of a customer beside a neighbour; infinite if there is none.

    All neighbours are looked at.
    """
    kind, rate = data.type[0], data.rate[0]
    assert isinstance(data.leg, np.ndarray)
    legs, demand = data.leg[0, :, :, 1], data.node[0, :, 0]["demand"][:, 0]
    served = {stop.node: (nodes, p) for route in routes
              for nodes in [[stop.node for stop in route.trips[0].stops]]
              for p, stop in enumerate(route.trips[0].stops)}
    least = np.inf
    for other in data.granular[node].tolist():
        if other not in served:
            continue
        nodes, p = served[other]
        if demand[nodes].sum() + demand[node] <= kind.capacity[0]:
            for a, b in ((nodes[p - 1], other), (other, nodes[p + 1])):
                least = min(least, float(legs[a, node] + legs[node, b] - legs[a, b]))
    return least * rate.distance + rate.stop
