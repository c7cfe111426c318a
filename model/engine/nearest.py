"""Who is nearest to whom, in a time that hardly depends on how many are equally near."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from model.engine.library import call
from model.engine.pausing import Pause, matrix_blocks, row_blocks
from model.problem import FloatArray, Int32Array, IntArray, Problem

CELL = 64
"""Most points in a cell that is not halved."""

NONE = -1
"""Half of a cell that is not halved."""

POINTS_AT_ONCE = 1024
"""For how many points the nearest are found between two pauses."""


class Cells(NamedTuple):
    """Cells, of which each is halved into two further on or holds points; the first holds all."""

    low: FloatArray  # (cell, axis)
    high: FloatArray  # (cell, axis)
    first: IntArray  # (cell,) its points, by their place in `point`
    last: IntArray  # (cell,)
    half: IntArray  # (cell, 2) the cells that it is halved into; -1 if it is not
    point: FloatArray  # (place, axis)
    number: Int32Array  # (place,) of the point


def least_columns(weight: NDArray[np.floating], ranks: int) -> IntArray:
    """Return the columns of the least entries of each row, least first; none may be negative.

    Entries are rounded to single precision. Of equal ones the first come first, by keys of an
    entry's bits, which rise with it, and its column: the library selects among keys of which no two
    are equal several at a time, and sorts them so, but takes ten times as long where many are.
    """
    keys = weight.astype(np.float32).view(np.int32).astype(np.int64) << 32
    keys |= np.arange(weight.shape[1])
    least = np.sort(np.partition(keys, ranks - 1, axis=1)[:, :ranks], axis=1)
    return least & np.int64(2**32 - 1)


def write_nearest_points(points: FloatArray, nearest: Int32Array, pause: Pause) -> None:
    """Write which points are nearest to each of (point, axis), nearest first.

    In place: `nearest` (point, rank), of which there are fewer than points.
    """
    cells = cells_of(points)
    for places in row_blocks(len(points), POINTS_AT_ONCE, pause):
        call("tandem_write_nearest_in", cells, places.start, places.stop, nearest)


def cells_of(points: FloatArray) -> Cells:
    """Return points in cells, halved across their longest side until they are small."""
    order, low, high, spans = np.arange(len(points)), [], [], []
    halves: list[list[int]] = []
    left = [(0, len(points), -1)]
    while left:
        first, last, parent = left.pop()
        inside = points[order[first:last]]
        low.append(inside.min(axis=0))
        high.append(inside.max(axis=0))
        spans.append((first, last))
        halves.append([])
        if parent >= 0:
            halves[parent].append(len(halves) - 1)
        if last - first > CELL:
            half = (last - first) // 2
            axis = int((high[-1] - low[-1]).argmax())
            order[first:last] = order[first:last][np.argpartition(inside[:, axis], half)]
            left += [(first, first + half, len(halves) - 1), (first + half, last, len(halves) - 1)]
    firsts, lasts = np.array(spans).T.copy()
    return Cells(np.array(low), np.array(high), firsts, lasts,
                 np.array([half or (NONE, NONE) for half in halves]), points[order],
                 order.astype(np.int32))


def write_nearest(problem: Problem, neighbours: IntArray, pause: Pause) -> None:
    """Write each node's nearest other customers, by the first vehicle type's drive. In place."""
    depots, nodes = problem.num_depots, problem.num_nodes
    duration = problem.travel[problem.vehicle_types[0].travel].duration
    most = min(neighbours.shape[1], problem.num_customers - 1)
    if most < 1:
        return
    for part in matrix_blocks(nodes, pause):
        drive = duration[part, depots:].astype(np.float64)
        customers = np.arange(max(part.start, depots), part.stop)
        drive[customers - part.start, customers - depots] = np.inf
        neighbours[part, :most] = least_columns(drive, most) + depots
