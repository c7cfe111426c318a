"""The quickest ways around obstacles, by the corners that see one another: compiled.

A flight that is not straight goes from its origin to a corner, from corner to corner, and from a
corner to its target. Who sees whom is a table of rows of different lengths: the entries of row `i`
are those from `begin[i]` up to `begin[i + 1]`.
"""

from heapq import heappop, heappush
from typing import NamedTuple

import numpy as np

from model.kernel.compiled import compiled
from model.problem import BoolArray, FloatArray, IntArray


class Sights(NamedTuple):
    """Straight flights from each row's place to the places that it sees, or back."""

    begin: IntArray  # (row + 1,)
    place: IntArray  # (entry,)
    distance: FloatArray  # (entry,) metres
    duration: FloatArray  # (entry,) seconds, infinite where the wind is too strong


@compiled
def fly_around(
    outward: Sights, between: Sights, inward: Sights, wanted: BoolArray, mutual: bool, first: int,
    last: int, distance: FloatArray, duration: FloatArray,
) -> None:
    """Write the quickest flights that bend at least once. In place.

    Parameters
    ----------
    outward
        From each node to corners.
    between
        From each corner to others.
    inward
        To each node from corners.
    wanted
        (node, node) the legs to work out.
    mutual
        Whether a flight back is as long as the flight there; then each is worked
        out once.
    first, last
        The rows to work out.
    distance, duration
        (node, node) infinite where there is no such flight.
    """
    corners = len(between.begin) - 1
    length, time = np.empty(corners), np.empty(corners)
    for node in range(first, last):
        begin = node if mutual else 0
        if not wanted[node, begin:].any():
            continue
        _reach(outward, between, node, length, time)
        for target in range(begin, len(wanted)):
            if not wanted[node, target]:
                continue
            least, metres = np.inf, np.inf
            for entry in range(inward.begin[target], inward.begin[target + 1]):
                corner = inward.place[entry]
                total = time[corner] + inward.duration[entry]
                if total < least:
                    least, metres = total, length[corner] + inward.distance[entry]
            duration[node, target], distance[node, target] = least, metres
            if mutual:
                duration[target, node], distance[target, node] = least, metres


@compiled
def _reach(outward: Sights, between: Sights, node: int, length: FloatArray,
           time: FloatArray) -> None:
    """Write the quickest flights from a node to all corners. In place.

    References
    ----------
    Dijkstra (1959), a note on two problems in connexion with graphs, Numer. Math. 1:269-271.
    """
    length[:] = np.inf
    time[:] = np.inf
    ahead = [(0.0, -1)]
    heappop(ahead)
    for entry in range(outward.begin[node], outward.begin[node + 1]):
        corner = outward.place[entry]
        time[corner], length[corner] = outward.duration[entry], outward.distance[entry]
        if time[corner] < np.inf:
            heappush(ahead, (time[corner], corner))
    while len(ahead) > 0:
        reached, corner = heappop(ahead)
        if reached > time[corner]:
            continue
        for entry in range(between.begin[corner], between.begin[corner + 1]):
            other = between.place[entry]
            total = reached + between.duration[entry]
            if total < time[other]:
                time[other] = total
                length[other] = length[corner] + between.distance[entry]
                heappush(ahead, (total, other))
