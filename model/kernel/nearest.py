"""Who is nearest to whom, in a time that hardly depends on how many are equally near."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from model.kernel.pausing import Pause, matrix_blocks
from model.problem import BoolArray, FloatArray, IntArray, Problem

FEW = 512
"""Up to how many columns equal entries cost nothing that matters."""

LOOKS = 64
"""Entries of a row by which its ties are estimated."""

TIED = 0.1
"""Share of a row from which on equal entries keep the library's selection of the least busy: it
halves a row by comparing, and took ten times as long where most customers were at one place."""


CELL = 64
"""Most points in a cell."""

CELLS_PER_RANK = 2
"""By how many points more than are ranked a cell's are compared with at first."""


def least_columns(weight: NDArray[np.floating], ranks: int) -> IntArray:
    """Return the columns of the least entries of each row, least first; none may be negative."""
    tied = _tied(weight, ranks)
    if not tied.any():
        return _selected(weight, ranks)
    columns = np.empty((len(weight), ranks), np.int64)
    columns[~tied] = _selected(weight[~tied], ranks)
    columns[tied] = _selected_by_keys(weight[tied], ranks)
    return columns


def _tied(weight: NDArray[np.floating], ranks: int) -> BoolArray:
    """Mark the rows in which many entries are about as small as the last one selected."""
    rows, number = weight.shape
    if number <= FEW:
        return np.zeros(rows, np.bool_)
    looks = np.sort(weight[:, ::number // LOOKS], axis=1)
    last = looks[:, ranks * looks.shape[1] // number, None]
    tied: BoolArray = np.count_nonzero(weight == last, axis=1) > TIED * number
    return tied


def _selected(weight: NDArray[np.floating], ranks: int) -> IntArray:
    chosen = np.argpartition(weight, ranks - 1, axis=1)[:, :ranks]
    order = np.argsort(np.take_along_axis(weight, chosen, axis=1), axis=1, kind="stable")
    return np.take_along_axis(chosen, order, axis=1)


def _selected_by_keys(weight: NDArray[np.floating], ranks: int) -> IntArray:
    """Select by keys of which no two are equal: an entry's bits, which rise with it, its column."""
    keys = weight.astype(np.float32).view(np.int32).astype(np.int64) << 32
    keys |= np.arange(weight.shape[1])
    least = np.sort(np.partition(keys, ranks - 1, axis=1)[:, :ranks], axis=1)
    return least & np.int64(2**32 - 1)


def nearest_points(points: FloatArray, ranks: int, pause: Pause) -> IntArray:
    """Return the `ranks` points nearest to each of (point, axis), nearest first.

    Points lie in cells of a k-d tree. Those of one are compared with all in cells near by, then
    with all in cells no farther than the last of those found.
    """
    cells = list(_cells(points, np.arange(len(points))))
    low, high = (np.array([edge(points[cell], axis=0) for cell in cells])
                 for edge in (np.min, np.max))
    nearest = np.empty((len(points), ranks), np.int64)
    for cell, least, most in zip(cells, low, high, strict=True):
        pause()
        apart = _square(np.maximum(0.0, np.maximum(low - most, least - high)))
        order = np.argsort(apart, kind="stable")
        count = min(len(order), 2 + CELLS_PER_RANK * ranks // CELL)
        reach = 0.0
        while True:
            others = np.concatenate([cells[index] for index in order[:count]])
            away = _square(points[cell][:, None] - points[others])
            away[cell[:, None] == others] = np.inf
            if len(others) > ranks:
                reach = float(np.partition(away, ranks - 1, axis=1)[:, ranks - 1].max())
                enough = int(np.searchsorted(apart[order], reach))
                if enough <= count:
                    break
                count = enough
            else:
                count = min(len(order), 2 * count)
        nearest[cell] = others[least_columns(away, ranks)]
    return nearest


def _cells(points: FloatArray, members: IntArray) -> Iterator[IntArray]:
    """Yield points in cells, halved across their longer side until they are small."""
    if len(members) <= CELL:
        yield members
        return
    inside = points[members]
    axis = int(np.ptp(inside, axis=0).argmax())
    half = len(members) // 2
    order = np.argpartition(inside[:, axis], half)
    yield from _cells(points, members[order[:half]])
    yield from _cells(points, members[order[half:]])


def _square(difference: FloatArray) -> FloatArray:
    square: FloatArray = np.einsum("...i,...i->...", difference, difference)
    return square


def write_nearest(problem: Problem, neighbours: IntArray, pause: Pause) -> None:
    """Write each node's nearest other customers, by the first vehicle type's drive. In place."""
    depots, nodes = problem.num_depots, problem.num_nodes
    duration = problem.travel[problem.vehicle_types[0].travel].duration[:, depots:]
    most = min(neighbours.shape[1], problem.num_customers - 1)
    if most < 1:
        return
    for part in matrix_blocks(nodes, pause):
        drive = duration[part].astype(np.float64)
        customers = np.arange(max(part.start, depots), part.stop)
        drive[customers - part.start, customers - depots] = np.inf
        neighbours[part, :most] = least_columns(drive, most) + depots
