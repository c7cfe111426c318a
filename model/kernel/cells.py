"""The nearest of points that lie in cells of a k-d tree. Compiled.

References
----------
Friedman, Bentley and Finkel (1977), an algorithm for finding best matches in logarithmic expected
time, ACM Transactions on Mathematical Software 3:209-226.
"""

import math
from typing import NamedTuple

import numpy as np

from model.kernel.compiled import compiled, inlined
from model.problem import FloatArray, Int32Array, IntArray

DEEPEST = 128
"""Cells that wait to be looked into at most: one for each level of a tree, twice."""

SPARE = 64
"""Points found before those too far are sorted out again."""


class Cells(NamedTuple):
    """Cells, of which each is halved into two further on or holds points; the first holds all."""

    low: FloatArray  # (cell, axis)
    high: FloatArray  # (cell, axis)
    first: IntArray  # (cell,) its points, by their place in `point`
    last: IntArray  # (cell,)
    half: IntArray  # (cell, 2) the cells that it is halved into; -1 if it is not
    point: FloatArray  # (place, axis)
    number: Int32Array  # (place,) of the point


@compiled
def write_nearest_in(cells: Cells, begin: int, end: int, nearest: Int32Array) -> None:
    """Write the numbers of the points nearest to those of some places, nearest first.

    In place: `nearest` (point, rank), of which there are fewer than points. Of points equally far
    the lower numbers come first; which are among the ranked at all is up to the cells.
    """
    ranks = nearest.shape[1]
    away, found = np.empty(ranks + SPARE), np.empty(ranks + SPARE, np.int32)
    waiting, apart = np.empty(DEEPEST, np.int64), np.empty(DEEPEST)
    for place in range(begin, end):
        search(cells, place, ranks, away, found, waiting, apart)
        sort(away, found, ranks)
        for rank in range(ranks):
            nearest[cells.number[place], rank] = found[rank]


@inlined
def search(cells: Cells, place: int, ranks: int, away: FloatArray, found: Int32Array,
           waiting: IntArray, apart: FloatArray) -> None:
    """Write the nearest points, in any order, and how far they are squared. In place."""
    count, reach, depth = 0, math.inf, 1
    waiting[0], apart[0] = 0, 0.0
    while depth > 0:
        depth -= 1
        cell = waiting[depth]
        if apart[depth] >= reach:
            continue
        while cells.half[cell, 0] >= 0:
            one, other = cells.half[cell, 0], cells.half[cell, 1]
            to_one = to_cell(cells, place, one)
            to_other = to_cell(cells, place, other)
            if to_other < to_one:
                one, other, to_one, to_other = other, one, to_other, to_one
            if to_other < reach:
                waiting[depth], apart[depth] = other, to_other
                depth += 1
            cell = one
        for beside in range(cells.first[cell], cells.last[cell]):
            square = to_point(cells, place, beside)
            if square < reach and beside != place:
                away[count], found[count] = square, cells.number[beside]
                count += 1
                if count == len(away):
                    part(away, found, count, ranks)
                    count = ranks
                    reach = farthest(away, ranks)
    part(away, found, count, ranks)


@inlined
def to_cell(cells: Cells, place: int, cell: int) -> float:
    """Return the squared distance from a point to a cell."""
    square = 0.0
    for axis in range(cells.point.shape[1]):
        at = cells.point[place, axis]
        beyond = max(cells.low[cell, axis] - at, at - cells.high[cell, axis], 0.0)
        square += beyond * beyond
    return square


@inlined
def to_point(cells: Cells, place: int, other: int) -> float:
    """Return the squared distance between two points."""
    square = 0.0
    for axis in range(cells.point.shape[1]):
        difference = cells.point[place, axis] - cells.point[other, axis]
        square += difference * difference
    return square


@inlined
def farthest(away: FloatArray, count: int) -> float:
    """Return the largest of the first `count` distances."""
    most = 0.0
    for index in range(count):
        most = max(most, away[index])
    return most


@inlined
def swap(away: FloatArray, found: Int32Array, one: int, other: int) -> None:
    """Exchange two of the points found. In place."""
    away[one], away[other] = away[other], away[one]
    found[one], found[other] = found[other], found[one]


@inlined
def part(away: FloatArray, found: Int32Array, count: int, ranks: int) -> None:
    """Put the nearest `ranks` of so many points first. In place.

    References
    ----------
    Hoare (1961), algorithm 65: find, Communications of the ACM 4:321-322.
    """
    left, right = 0, count - 1
    while left < right:
        pivot = away[(left + right) // 2]
        low, high = left, right
        while low <= high:
            while away[low] < pivot:
                low += 1
            while pivot < away[high]:
                high -= 1
            if low <= high:
                swap(away, found, low, high)
                low += 1
                high -= 1
        if ranks - 1 <= high:
            right = high
        elif ranks - 1 >= low:
            left = low
        else:
            return


@inlined
def sort(away: FloatArray, found: Int32Array, count: int) -> None:
    """Sort so many points by distance, then by number. In place."""
    gap = 1
    while 9 * gap < count:
        gap = 3 * gap + 1
    while gap > 0:
        for index in range(gap, count):
            square, number, place = away[index], found[index], index
            while place >= gap and (away[place - gap] > square or (
                    away[place - gap] == square and found[place - gap] > number)):
                away[place], found[place] = away[place - gap], found[place - gap]
                place -= gap
            away[place], found[place] = square, number
        gap = gap // 3
