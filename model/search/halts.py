"""Where trucks may stop for their drones alone, as the search reads it."""

from typing import Any, NamedTuple

import numpy as np

from model.problem import BoolArray, FloatArray, Int32Array, IntArray, Problem
from model.search.neighbourhood.numbering import Numbering

NEAR_HALTS = 6
"""Launch sites from or to which each customer may be flown, the nearest ones. Most of the search
looks at half of them."""

NOBODY = -1


class Halts(NamedTuple):
    """Launch sites, by the depots among which they are; all empty where there are none."""

    halts: BoolArray  # (type, depot) where it may stop
    halt_after: IntArray  # (depot,) who is served before a stop there
    halt_cost: FloatArray  # (depot,) of each stop
    near_halts: Int32Array  # (node, rank) those near a customer, NOBODY behind the last


def halts_of(problem: Problem, numbering: Numbering) -> Halts:
    """Return the launch sites of a problem, in the search's numbers."""
    sites, types = problem.launch_sites, range(len(problem.vehicle_types))
    if not sites or not any(problem.allows_stop(kind, site) for kind in types for site in sites):
        return Halts(np.zeros((0, 0), np.bool_), np.zeros(0, np.int64), np.zeros(0),
                     np.zeros((problem.num_nodes, 0), np.int32))
    halts = np.zeros((len(types), problem.num_depots), np.bool_)
    halts[:, sites] = [[problem.allows_stop(kind, site) for site in sites] for kind in types]
    number = {customer.id: int(numbering.number[node]) for node, customer
              in enumerate(problem.customers, problem.num_depots)}
    after = [NOBODY] * problem.num_depots
    for site in sites:
        name = problem.depots[site].after
        if name in number:
            after[site] = number[name]
        elif name is not None:
            halts[:, site] = False
    return Halts(halts, np.array(after, np.int64),
                 np.array([depot.stop_cost for depot in problem.depots]),
                 _near(problem, numbering, np.array(sites)))


def _near(problem: Problem, numbering: Numbering, sites: IntArray) -> Int32Array:
    """Return the sites from which it is least far to fly to each customer, or else to come back."""
    first, ranks = problem.num_depots, min(NEAR_HALTS, len(sites))
    near = np.full((problem.num_nodes, ranks), NOBODY, np.int32)
    customers = numbering.node[first:]
    travels = {drones.travel for kind in problem.vehicle_types for drones in kind.drone_types}
    flights: Any = np.full((len(customers), len(sites)), np.iinfo(np.int64).max)
    for travel in travels:
        duration = problem.travel[travel].duration
        there = duration[sites[:, None], customers].T
        flights = np.minimum(flights, np.minimum(there, duration[customers[:, None], sites]))
    place = {problem.depots[site].after: column for column, site in enumerate(sites.tolist())}
    for row, customer in enumerate(customers.tolist()):
        column = place.get(problem.customers[customer - first].id)
        if column is not None:
            flights[row, column] = np.iinfo(np.int64).max
    order = np.argsort(flights, axis=1, kind="stable")[:, :ranks]
    near[first:] = sites[order]
    return near
