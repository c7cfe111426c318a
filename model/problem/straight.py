"""Legs that are computed from coordinates wherever they are looked up."""

import math
from dataclasses import dataclass, replace

import numpy as np

from model.problem.distances import (
    EARTH_RADIUS_M, EXACT, MM_PER_M, MS_PER_M_AT_1_KMH, angle_between_two, angles_between,
    ceiled_ms, one_ceiled_ms, one_rounded_as, one_rounded_mm, rounded_as, rounded_mm, unit_vectors,
    units_between, units_between_two,
)
from model.problem.quantities import (
    MAX_QUANTITY, UNREACHABLE, BoolArray, FloatArray, IntArray, require,
)


@dataclass(frozen=True, eq=False)
class Points:
    """Where nodes are, and what counts as the distance between two.

    Parameters
    ----------
    at
        (node, 2) in a plane, or (node, 3) unit vectors; not a number where a node is nowhere.
    metres
        Of a unit of distance, or of a radian.
    rounding
        How distances in a plane are rounded in their unit.
    """

    at: FloatArray
    metres: float = 1.0
    rounding: int = EXACT

    def __post_init__(self) -> None:
        require(self.at.ndim == 2 and self.at.shape[1] in (2, 3), "points", self.at.shape)
        require(not self.on_globe or self.rounding == EXACT, "rounding", self.rounding)
        require(not bool(np.isinf(self.at).any()), "points", "infinite")

    @classmethod
    def geographic(cls, lon_lat: FloatArray) -> "Points":
        """Return places of (node, 2) longitudes and latitudes in degrees."""
        return cls(unit_vectors(lon_lat), EARTH_RADIUS_M)

    @property
    def on_globe(self) -> bool:
        """Tell whether nodes lie on a sphere."""
        return self.at.shape[1] == 3

    def __len__(self) -> int:
        return len(self.at)

    def among(self, nodes: IntArray) -> "Points":
        """Return some of the places."""
        return replace(self, at=self.at[nodes])

    def distances(self, origin: IntArray, to: IntArray) -> FloatArray:
        """Return metres between nodes, for indices that broadcast; not a number if nowhere."""
        if self.on_globe:
            return angles_between(self.at, origin, to) * self.metres
        straight = units_between(self.at, origin, to)
        return rounded_as(straight, self.rounding) * self.metres

    def distance(self, origin: int, to: int) -> float:
        """Return one of them."""
        if self.on_globe:
            return angle_between_two(self.at, origin, to) * self.metres
        straight = units_between_two(self.at, origin, to)
        if math.isnan(straight):
            return straight
        return one_rounded_as(straight, self.rounding) * self.metres

    def longest(self) -> float:
        """Return metres that no distance exceeds."""
        known = self.at[~np.isnan(self.at[:, 0])]
        if not len(known):
            return 0.0
        across = float(np.sqrt((np.ptp(known, axis=0) ** 2).sum()))
        if self.on_globe:
            return 2.0 * math.asin(min(1.0, across / 2.0)) * self.metres * (1 + 1e-9)
        # No way to round makes it longer by a whole unit.
        return (across * (1 + 1e-9) + (self.rounding != EXACT)) * self.metres


@dataclass(frozen=True, eq=False)
class StraightLegs:
    """Legs along straight lines or great circles at one speed.

    Parameters
    ----------
    more
        Milliseconds that each leg takes besides, but for who stays.
    nowhere
        Duration and distance of legs to and from nodes that are nowhere.

    Raises
    ------
    ValueError
        If a leg might be longer than a problem may state.
    """

    points: Points
    speed_kmh: float
    more: int = 0
    nowhere: int = 0

    def __post_init__(self) -> None:
        require(0 < self.speed_kmh < math.inf, "speed", self.speed_kmh)
        require(self.nowhere in (0, UNREACHABLE), "nowhere", self.nowhere)
        require(fits(self.points.longest(), self.speed_kmh, self.more), "travel",
                "entry too large")

    @property
    def pace(self) -> float:
        """Milliseconds that a metre takes."""
        return MS_PER_M_AT_1_KMH / self.speed_kmh

    def durations(self, origin: IntArray, to: IntArray) -> IntArray:
        """Return the ms between nodes, for indices that broadcast."""
        metres = self.points.distances(origin, to)
        whole = ceiled_ms(np.nan_to_num(metres) * self.pace)
        return self._but_for(origin == to, np.isnan(metres), whole.astype(np.int64) + self.more)

    def distances(self, origin: IntArray, to: IntArray) -> IntArray:
        """Return the mm between nodes, for indices that broadcast."""
        metres = self.points.distances(origin, to)
        whole = rounded_mm(np.nan_to_num(metres)).astype(np.int64)
        return self._but_for(origin == to, np.isnan(metres), whole)

    def duration(self, origin: int, to: int) -> int:
        """Return one of the durations."""
        metres = 0.0 if origin == to else self.points.distance(origin, to)
        if math.isnan(metres):
            return self.nowhere
        more = 0 if origin == to else self.more
        return one_ceiled_ms(metres * self.pace) + more

    def distance(self, origin: int, to: int) -> int:
        """Return one of the distances."""
        metres = 0.0 if origin == to else self.points.distance(origin, to)
        return self.nowhere if math.isnan(metres) else one_rounded_mm(metres)

    def _but_for(self, stays: BoolArray, nowhere: BoolArray, legs: IntArray) -> IntArray:
        legs = np.where(nowhere, self.nowhere, legs)
        here: IntArray = np.where(stays, 0, legs)
        return here

    def among(self, nodes: IntArray) -> "StraightLegs":
        """Return the legs between some nodes."""
        return replace(self, points=self.points.among(nodes))

    def reaches_all(self) -> bool:
        """Tell whether there is a leg from each node to each."""
        return self.nowhere < UNREACHABLE or not bool(np.isnan(self.points.at).any())

    def longest_duration(self) -> int:
        """Return ms that no leg exceeds that leads somewhere."""
        return math.ceil(self.points.longest() * self.pace) + self.more

    def longest_distance(self) -> int:
        """Return mm that no leg exceeds that leads somewhere."""
        return math.ceil(self.points.longest() * MM_PER_M)


def fits(longest_m: float, speed_kmh: float, more: int = 0) -> bool:
    """Tell whether legs that are no longer may be stated by a problem."""
    longest_ms = longest_m * MS_PER_M_AT_1_KMH / speed_kmh + more
    return max(longest_m * MM_PER_M, longest_ms) < MAX_QUANTITY


Index = int | slice | IntArray


class StraightMatrix:
    """Durations or distances of straight legs, looked up like a matrix of (origin, to)."""

    ndim = 2
    dtype = np.dtype(np.int64)

    def __init__(self, legs: StraightLegs, of_durations: bool) -> None:
        self.legs = legs
        self._one = legs.duration if of_durations else legs.distance
        self._many = legs.durations if of_durations else legs.distances

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes, twice."""
        return len(self), len(self)

    def __len__(self) -> int:
        return len(self.legs.points)

    def item(self, origin: int, to: int) -> int:
        """Return one leg."""
        return self._one(origin, to)

    def __getitem__(self, key: Index | tuple[Index, Index]) -> IntArray:
        """Return some legs, as a matrix has them, for indices that are not negative."""
        origin, to = key if isinstance(key, tuple) else (key, slice(None))
        numbers = np.arange(len(self))
        first = numbers[origin] if isinstance(origin, slice) else np.asarray(origin)
        second = numbers[to] if isinstance(to, slice) else np.asarray(to)
        if isinstance(origin, slice):
            first = first.reshape(first.shape + (1,) * second.ndim)
        elif isinstance(to, slice):
            first = first[..., None]
        return self._many(first, second)
