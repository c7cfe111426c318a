"""Legs that are held in 32 bits each and looked up in 64, so that no sum of them overflows."""

from typing import Any

import numpy as np

from model.problem.quantities import LONGEST_NARROW, NO_LEG, UNREACHABLE, Int32Array, IntArray
from model.problem.straight import Index


class NarrowMatrix:
    """Durations or distances, looked up like a matrix of (origin, to) in 64 bits.

    Parameters
    ----------
    held
        (origin, to) from 0 to `LONGEST_NARROW`, or `NO_LEG`, which is looked up as `UNREACHABLE`.
    """

    ndim = 2
    dtype = np.dtype(np.int64)

    def __init__(self, held: Int32Array) -> None:
        self.held = held
        self.reaches_all = bool(held.max(initial=0) < NO_LEG)
        # What plans are judged by most of all: it costs no call of Python where it can.
        self.item = held.item if self.reaches_all else self._item

    def __reduce__(self) -> tuple[Any, ...]:
        return NarrowMatrix, (self.held,)

    @property
    def shape(self) -> tuple[int, ...]:
        """Nodes, twice."""
        return self.held.shape

    def __len__(self) -> int:
        return len(self.held)

    def _item(self, origin: int, to: int) -> int:
        leg = self.held.item(origin, to)
        return UNREACHABLE if leg == NO_LEG else leg

    def __getitem__(self, key: Index | tuple[Index, Index]) -> IntArray:
        """Return a copy of some legs, as a matrix has them."""
        legs: IntArray = self.held[key].astype(np.int64)
        if not self.reaches_all:
            legs = legs + (legs == NO_LEG) * (UNREACHABLE - NO_LEG)
        return legs

    def among(self, nodes: IntArray) -> "NarrowMatrix":
        """Return the legs between some nodes, numbered anew."""
        return NarrowMatrix(self.held[nodes[:, None], nodes])


def narrowed(matrix: IntArray) -> IntArray | NarrowMatrix:
    """Return a matrix of legs in 32 bits, if all fit."""
    # Negative entries are the largest ones here.
    most = int(matrix.view(np.uint64).max(initial=0))
    if most <= LONGEST_NARROW:
        return NarrowMatrix(matrix.astype(np.int32))
    if most != UNREACHABLE:
        return matrix
    there_is = matrix < UNREACHABLE
    if np.max(matrix, where=there_is, initial=0) > LONGEST_NARROW:
        return matrix
    return NarrowMatrix(np.where(there_is, matrix, NO_LEG).astype(np.int32))
