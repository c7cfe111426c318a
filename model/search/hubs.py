"""What parts of a plan may take of their depots' batteries."""

import numpy as np

from model.engine.library import call
from model.problem import IntArray
from model.search.route.layout import ProblemData
from model.search.route.state import Searcher


def shared_out(data: ProblemData, searcher: Searcher, owner: IntArray,
               number: int) -> list[ProblemData]:
    """Return the problem for each of some parts of a plan: what it takes, and a share of the rest.

    `owner` (slot,) the number of the part that a route belongs to.
    """
    taken = np.zeros((len(owner), len(data.hub)), np.int64)
    call("tandem_write_taken", data, searcher, taken)
    by_part = np.zeros((number, len(data.hub)), np.int64)
    np.add.at(by_part, owner, taken)
    left = data.hub["batteries"] - by_part.sum(axis=0)
    found = []
    for part, needed in enumerate(by_part):
        hub = data.hub.copy()
        hub["batteries"] = needed + (left + part) // number
        found.append(data._replace(hub=hub))
    return found
