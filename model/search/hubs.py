"""What routes take of their depots' batteries and places to charge, in the search's arrays."""

import numpy as np

from model.problem import IntArray
from model.search.route.layout import Fleet, ProblemData


def taken_by(data: ProblemData, fleet: Fleet, slots: int) -> IntArray:
    """Return (slot, stock) what each route takes: of all depots' batteries, then of their chargers.
    """
    depots = len(data.hub)
    taken = np.zeros((slots, 2 * depots), np.int64)
    if depots == 0:
        return taken
    for slot in np.flatnonzero(fleet.route["length"][:slots]).tolist():
        route = fleet.route[slot]
        kind = data.type[route["type"]]
        if kind["takes_batteries"]:
            first = fleet.trip[slot, :route["trips"]]["first"]
            np.add.at(taken[slot], fleet.stop[slot, first]["node"], 1)
        if route["trips"] > kind["trips_uncharged"]:
            taken[slot, depots + kind["depot"]] = 1
    return taken


def stocks_of(data: ProblemData) -> IntArray:
    """Return (stock,) what there is, as `taken_by` tells it."""
    return np.concatenate([data.hub["batteries"], data.hub["chargers"]])


def shared_out(data: ProblemData, taken: IntArray, owner: IntArray,
               number: int) -> list[ProblemData]:
    """Return the problem for each of some parts of a plan: what it takes, and a share of the rest.

    `taken` (slot, stock); `owner` (slot,) the number of the part that a route belongs to.
    """
    by_part = np.zeros((number, taken.shape[1]), np.int64)
    np.add.at(by_part, owner, taken)
    left = stocks_of(data) - by_part.sum(axis=0)
    found = []
    for part, needed in enumerate(by_part):
        hub = data.hub.copy()
        hub["batteries"], hub["chargers"] = np.split(needed + (left + part) // number, 2)
        found.append(data._replace(hub=hub))
    return found
