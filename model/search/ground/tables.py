"""What is laid out for a search before it begins, place by place. Compiled."""

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.problem import FloatArray, Int32Array, IntArray

WAITING_WEIGHT = 0.2
LATENESS_WEIGHT = 1.0
"""What waiting and lateness weigh against driving between neighbours."""


@compiled
def walk(near: Int32Array, num_depots: int, node: IntArray) -> None:
    """Write all customers in their order; from where all neighbours were met, it begins anew.

    In place: `node` (number,), behind the depots.
    """
    was_met = np.zeros(len(near), np.bool_)
    number = num_depots
    for start in range(num_depots, len(near)):
        at = start
        while at >= 0 and not was_met[at]:
            was_met[at] = True
            node[number] = at
            number += 1
            others, at = near[at], -1
            for other in others:
                if other >= 0 and not was_met[other]:
                    at = int(other)
                    break


@compiled
def write_legs(duration: IntArray | Int32Array, distance: IntArray | Int32Array, node: IntArray,
               first: int, legs: IntArray | Int32Array) -> None:
    """Write the legs from nodes, the search's number `first` and behind. In place."""
    for row in range(len(legs)):
        origin = node[first + row]
        for column in range(len(node)):
            legs[row, column, 0] = duration[origin, node[column]]
            legs[row, column, 1] = distance[origin, node[column]]


@compiled
def write_misfit(there: IntArray, back: IntArray, other: IntArray, first: int,
                 earliest: FloatArray, service: FloatArray, latest: FloatArray,
                 weight: FloatArray) -> None:
    """Write how badly neighbours `other` (row, rank) follow or precede customers. In place.

    The customers are `first` and those behind, `there` and `back` the drives to and from others.
    """
    for row in range(len(other)):
        a = first + row
        for rank in range(other.shape[1]):
            b = other[row, rank]
            weight[row, rank] = min(
                detour(there[row, rank], earliest[a] + service[a], latest[a] + service[a],
                       earliest[b], latest[b]),
                detour(back[row, rank], earliest[b] + service[b], latest[b] + service[b],
                       earliest[a], latest[a]))


@inlined
def detour(drive: int, leaves: float, leaves_last: float, opens: float, closes: float) -> float:
    """Return what a drive costs with the waiting or lateness that it can't do without."""
    return (drive + WAITING_WEIGHT * max(opens - leaves_last - drive, 0.0)
            + LATENESS_WEIGHT * max(leaves + drive - closes, 0.0))
