"""Legs between all nodes by one kind of vehicle."""

from dataclasses import dataclass

import numpy as np

from model.problem.narrow import NarrowMatrix, narrowed
from model.problem.quantities import (
    LONGEST_NARROW, MAX_QUANTITY, NO_LEG, UNREACHABLE, Int32Array, IntArray, require,
)
from model.problem.straight import StraightLegs, StraightMatrix

Matrix = IntArray | NarrowMatrix | StraightMatrix
"""Looked up, each gives integers of Python (`item`) or of 64 bits."""


@dataclass(frozen=True, eq=False)
class Travel:
    """Legs between all nodes by one kind of vehicle, rows are origins.

    Both matrices are held, in 32 bits each where all its legs fit, or both are computed from where
    nodes are.
    """

    duration: Matrix
    """(node, node) ms, UNREACHABLE where there is no leg (drones only)"""
    distance: Matrix
    """(node, node) mm"""

    def __post_init__(self) -> None:
        one = self.duration is self.distance
        for name, matrix in (("duration", self.duration), ("distance", self.distance)):
            require(matrix.dtype == np.int64, f"travel {name} dtype", matrix.dtype)
            require(matrix.ndim == 2 and matrix.shape[0] == matrix.shape[1],
                     f"travel {name} shape", matrix.shape)
            if isinstance(matrix, np.ndarray):
                held = self.duration if one and name == "distance" else narrowed(matrix)
                if isinstance(held, np.ndarray):
                    _require_legs(name, held)
                object.__setattr__(self, name, held)
        require(self.duration.shape == self.distance.shape, "travel distance shape",
                 self.distance.shape)
        require(isinstance(self.duration, StraightMatrix)
                == isinstance(self.distance, StraightMatrix), "travel", "half computed")

    @classmethod
    def along(cls, legs: StraightLegs) -> "Travel":
        """Return legs that are computed wherever they are looked up."""
        return cls(StraightMatrix(legs, True), StraightMatrix(legs, False))

    @property
    def straight(self) -> StraightLegs | None:
        """How legs are computed, if they are."""
        return self.duration.legs if isinstance(self.duration, StraightMatrix) else None

    def arrays(self) -> tuple[IntArray, IntArray]:
        """Return durations and distances as arrays, which may be copies, or computed once."""
        return self.duration[:], self.distance[:]

    def narrow(self) -> tuple[Int32Array, Int32Array] | None:
        """Return durations and distances if all are held in 32 bits, `NO_LEG` where there is none.

        They are to be copied and compared: sums of them may overflow.
        """
        if isinstance(self.duration, NarrowMatrix) and isinstance(self.distance, NarrowMatrix):
            return self.duration.held, self.distance.held
        return None

    def write(self, origin: IntArray, to: IntArray, duration: IntArray | int,
              distance: IntArray | int) -> None:
        """Put other legs in place of some that are held. In place: problems have the same travel.
        """
        for name, legs in (("duration", duration), ("distance", distance)):
            matrix = getattr(self, name)
            if isinstance(matrix, NarrowMatrix):
                if np.max(legs, initial=0) <= LONGEST_NARROW:
                    matrix.held[origin, to] = legs
                    continue
                matrix = matrix[:]
                object.__setattr__(self, name, matrix)
            matrix[origin, to] = legs

    def reaches_all(self) -> bool:
        """Tell whether there is a leg from each node to each."""
        if isinstance(self.duration, StraightMatrix):
            return self.duration.legs.reaches_all()
        if isinstance(self.duration, NarrowMatrix):
            return self.duration.reaches_all
        return bool(self.duration.max(initial=0) < UNREACHABLE)

    def lacks_ways(self) -> bool:
        """Tell whether there are legs that aren't there, which last `MAX_QUANTITY`."""
        return (isinstance(self.duration, np.ndarray)
                and bool((self.duration == MAX_QUANTITY).any()))

    def longest(self) -> tuple[int, int]:
        """Return a duration and a distance that no leg exceeds that can be travelled."""
        if self.straight is not None:
            return self.straight.longest_duration(), self.straight.longest_distance()
        narrow = self.narrow()
        duration, distance = narrow or self.arrays()
        there_is = duration < (NO_LEG if narrow else MAX_QUANTITY)
        return (int(np.max(duration, where=there_is, initial=0)),
                int(np.max(distance, where=there_is, initial=0)))

    def among(self, nodes: IntArray) -> "Travel":
        """Return the legs between some nodes, numbered anew."""
        if self.straight is not None:
            return Travel.along(self.straight.among(nodes))
        return Travel(_among(self.duration, nodes), _among(self.distance, nodes))


def _require_legs(name: str, matrix: IntArray) -> None:
    # Negative entries are the largest ones here: one look at each is enough, mostly.
    if matrix.view(np.uint64).max(initial=0) > MAX_QUANTITY:
        require(bool((matrix >= 0).all()), f"travel {name}", "negative entry")
        reachable = (matrix <= MAX_QUANTITY) | (matrix == UNREACHABLE)
        require(bool(reachable.all()), f"travel {name}", "entry too large")


def _among(matrix: Matrix, nodes: IntArray) -> Matrix:
    return (matrix.among(nodes) if isinstance(matrix, NarrowMatrix)
            else matrix[nodes[:, None], nodes])
