"""Legs between all nodes by one kind of vehicle."""

from dataclasses import dataclass

import numpy as np

from model.problem.quantities import MAX_QUANTITY, UNREACHABLE, IntArray, require
from model.problem.straight import StraightLegs, StraightMatrix


@dataclass(frozen=True, eq=False)
class Travel:
    """Legs between all nodes by one kind of vehicle, rows are origins.

    Both matrices are arrays, or both are computed from where nodes are.
    """

    duration: IntArray | StraightMatrix
    """(node, node) ms, UNREACHABLE where there is no leg (drones only)"""
    distance: IntArray | StraightMatrix
    """(node, node) mm"""

    def __post_init__(self) -> None:
        for name, matrix in (("duration", self.duration), ("distance", self.distance)):
            require(matrix.dtype == np.int64, f"travel {name} dtype", matrix.dtype)
            require(matrix.ndim == 2 and matrix.shape[0] == matrix.shape[1],
                     f"travel {name} shape", matrix.shape)
            if isinstance(matrix, StraightMatrix):
                continue
            # Negative entries are the largest ones here: one look at each is enough, mostly.
            if matrix.view(np.uint64).max(initial=0) > MAX_QUANTITY:
                require(bool((matrix >= 0).all()), f"travel {name}", "negative entry")
                reachable = (matrix <= MAX_QUANTITY) | (matrix == UNREACHABLE)
                require(bool(reachable.all()), f"travel {name}", "entry too large")
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
        """Return durations and distances as arrays: those that are here, or all computed once."""
        return self.duration[:], self.distance[:]

    def reaches_all(self) -> bool:
        """Tell whether there is a leg from each node to each."""
        if self.straight is not None:
            return self.straight.reaches_all()
        return bool(self.duration[:].max(initial=0) < UNREACHABLE)

    def longest(self) -> tuple[int, int]:
        """Return a duration and a distance that no leg exceeds that can be travelled."""
        if self.straight is not None:
            return self.straight.longest_duration(), self.straight.longest_distance()
        duration, distance = self.arrays()
        reachable = True if self.reaches_all() else duration < UNREACHABLE
        return (int(np.max(duration, where=reachable, initial=0)),
                int(np.max(distance, where=reachable, initial=0)))

    def among(self, nodes: IntArray) -> "Travel":
        """Return the legs between some nodes, numbered anew."""
        if self.straight is not None:
            return Travel.along(self.straight.among(nodes))
        return Travel(self.duration[nodes[:, None], nodes], self.distance[nodes[:, None], nodes])
