"""Nodes of random instances: where they lie and how long a leg between them takes.

Every other quantity of an instance is drawn relative to the side of its square, the duration of
driving along it (`crossing`) and the price of that, so that scale and rules vary independently.
"""

import math
from dataclasses import dataclass

import numpy as np

from model.problem import MM_PER_KM, MS_PER_HOUR, FloatArray, IntArray, Travel


@dataclass(frozen=True, eq=False)
class Square:
    """Nodes in a square, depots first."""

    coordinates: FloatArray  # (node, 2) km
    straight: FloatArray  # (node, node) mm
    distance: IntArray  # (node, node) mm by road
    side: float  # mm
    crossing: float  # ms to drive along the side at speed 1
    num_depots: int

    @property
    def side_km(self) -> float:
        """Side in kilometres."""
        return self.side / MM_PER_KM

    @property
    def crossing_hours(self) -> float:
        """Crossing in hours."""
        return self.crossing / MS_PER_HOUR

    def road(self, speed: float = 1.0) -> Travel:
        """Return the legs of a truck, `speed` in sides per crossing."""
        duration = np.ceil(self.distance * (self.crossing / self.side / speed))
        return Travel(duration.astype(np.int64), self.distance)

    def flight(self, speed: float) -> Travel:
        """Return the legs of a drone: straight lines."""
        duration = np.ceil(self.straight * (self.crossing / self.side / speed))
        return Travel(duration.astype(np.int64), np.rint(self.straight).astype(np.int64))


def uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a Python float; several times faster than `rng.uniform`."""
    return low + (high - low) * rng.random()


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a float whose logarithm is uniform."""
    return low * math.exp(math.log(high / low) * rng.random())


def integer(rng: np.random.Generator, low: int, high: int) -> int:
    """Draw an integer, both ends included."""
    return low + int((high - low + 1) * rng.random())


def draw_points(rng: np.random.Generator, num_depots: int, num_customers: int,
                clustered: float) -> FloatArray:
    """Draw points of the unit square; a share `clustered` of the customers lies in clusters.

    Clusters (2 to 8) have uniform centres and a standard deviation of 0.02 to 0.1. A depot is
    uniform (half of the time), in the middle fifth, or in a corner.
    """
    points = rng.random((num_depots + num_customers, 2))
    place = rng.random()
    if place < 0.25:
        points[:num_depots] = 0.4 + 0.2 * points[:num_depots]
    elif place < 0.5:
        points[:num_depots] = np.rint(points[:num_depots]) * 0.9 + 0.1 * points[:num_depots]
    members = num_depots + np.flatnonzero(rng.random(num_customers) < clustered)
    if members.size:
        centres = rng.random((integer(rng, 2, 8), 2))
        offsets = rng.standard_normal((members.size, 2)) * uniform(rng, 0.02, 0.1)
        points[members] = centres[rng.integers(len(centres), size=members.size)] + offsets
    return np.clip(points, 0.0, 1.0)


def lay_ground(rng: np.random.Generator, points: FloatArray, num_depots: int, side_km: float,
               speed_kmh: float, noise: float = 0.0) -> Square:
    """Scale points of the unit square to a `Square`.

    With `noise` above 0, each directed leg is longer than the straight line by a uniform share of
    up to `noise`: the road matrix is asymmetric and breaks the triangle inequality now and then.
    """
    x, y = points[:, 0], points[:, 1]
    side = side_km * MM_PER_KM
    straight = np.hypot(x[:, None] - x, y[:, None] - y) * side
    road = straight * (1.0 + noise * rng.random(straight.shape)) if noise else straight
    return Square(coordinates=points * side_km, straight=straight,
                  distance=np.rint(road).astype(np.int64), side=side,
                  crossing=math.ceil(side_km / speed_kmh * MS_PER_HOUR), num_depots=num_depots)
