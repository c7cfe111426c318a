"""What routes take of their depots' batteries, in the search's arrays."""

import numpy as np

from model.problem import IntArray
from model.search.route.layout import Fleet, ProblemData


def taken_by(data: ProblemData, fleet: Fleet, slots: int) -> IntArray:
    """Return (slot, depot) how many batteries each route takes of each depot."""
    taken = np.zeros((slots, len(data.hub)), np.int64)
    if len(data.hub) == 0:
        return taken
    for slot in np.flatnonzero(fleet.route["length"][:slots]).tolist():
        route = fleet.route[slot]
        if data.type[route["type"]]["takes_batteries"]:
            first = fleet.trip[slot, :route["trips"]]["first"]
            np.add.at(taken[slot], fleet.stop[slot, first]["node"], 1)
    return taken


def stocks_of(data: ProblemData) -> IntArray:
    """Return (depot,) what there is, as `taken_by` tells it."""
    batteries: IntArray = data.hub["batteries"]
    return batteries


def shared_out(data: ProblemData, taken: IntArray, owner: IntArray,
               number: int) -> list[ProblemData]:
    """Return the problem for each of some parts of a plan: what it takes, and a share of the rest.

    `taken` (slot, depot); `owner` (slot,) the number of the part that a route belongs to.
    """
    by_part = np.zeros((number, taken.shape[1]), np.int64)
    np.add.at(by_part, owner, taken)
    left = stocks_of(data) - by_part.sum(axis=0)
    found = []
    for part, needed in enumerate(by_part):
        hub = data.hub.copy()
        hub["batteries"] = needed + (left + part) // number
        found.append(data._replace(hub=hub))
    return found
