"""Legs: how long and how far from one place to another. Compiled.

All are read here, so that what is looked up may be computed instead.
"""

from typing import NamedTuple

from model.kernel.compiled import inlined, pasted
from model.problem import IntArray

LEG_DURATION, LEG_DISTANCE = range(2)
"""Last axis of a table of legs."""


class Leg(NamedTuple):
    """A way, driven at full speed or flown."""

    duration: int
    distance: int


@pasted
def legs_of(tables: IntArray, m: int) -> IntArray:
    """Return the legs of travel `m`, (origin, to, 2)."""
    return tables[m]


@pasted
def legs_from(tables: IntArray, m: int, node: int) -> IntArray:
    """Return the legs of travel `m` from a node, (to, 2), for a loop over where they lead."""
    return tables[m, node]


@pasted
def legs_to(tables: IntArray, m: int, node: int) -> IntArray:
    """Return the legs of travel `m` to a node, (origin, 2); `tables` (travel, to, origin, 2)."""
    return tables[m, node]


@inlined
def leg(legs: IntArray, origin: int, to: int) -> Leg:
    """Return a leg of one travel."""
    return Leg(legs[origin, to, LEG_DURATION], legs[origin, to, LEG_DISTANCE])


@inlined
def leg_at(row: IntArray, node: int) -> Leg:
    """Return the leg between a node and that for which `legs_from` or `legs_to` took the row."""
    return Leg(row[node, LEG_DURATION], row[node, LEG_DISTANCE])


@pasted
def matrix_of(matrices: IntArray, b: int, m: int) -> IntArray:
    """Return the durations, or distances, of travel `m` in problem `b`, (origin, to)."""
    return matrices[b, m]


@pasted
def matrices_of(matrices: IntArray, b: int) -> IntArray:
    """Return the durations of all travels in problem `b`, (travel, origin, to)."""
    return matrices[b]


@pasted
def matrix_among(matrices: IntArray, m: int) -> IntArray:
    """Return the durations of travel `m`, (origin, to), from those of one problem."""
    return matrices[m]


@inlined
def lookup(matrix: IntArray, origin: int, to: int) -> int:
    """Return the duration of a leg, or the distance, from a matrix of either."""
    return matrix[origin, to]
