"""Areas of zones as polygons in degrees, each as large as what was published or a little larger."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from pyproj import Geod
from shapely import Polygon

from model.problem import FloatArray

EARTH = Geod(ellps="WGS84")

LONGEST_EDGE_DEG = 0.05
"""Edges are straight in degrees, flights are not: corners are put in between, so that no edge lies
farther than 0.3 m beside the published one, wherever it is projected to."""

ROUND_M = 2.0
"""How far the polygon for a circle may reach beyond it, where it has fewer than its most corners.
"""

FEWEST_CORNERS, MOST_CORNERS = 16, 128

ROOM = 1.0001
"""By how much larger circles are drawn, as edges that are straight in degrees bend inwards."""

LARGEST_RADIUS_M = 1e6
"""Largest circle."""

Corners = Sequence[tuple[float, float]]


class ShapeError(ValueError):
    """Corners or a radius make no area."""


def polygon_of(rings: Sequence[Corners]) -> Polygon:
    """Return the area within a ring and outside those after it; rings needn't be closed.

    Raises
    ------
    ShapeError
        If it is none, or lies around the world.
    """
    shell, *holes = (_unwrapped(np.asarray(ring, np.float64)) for ring in rings)
    middle = shell[:, 0].mean()
    # A hole may be on the other side of 180 degrees.
    area = Polygon(shell, [hole + np.array((360 * round((middle - hole[:, 0].mean()) / 360), 0))
                           for hole in holes])
    if shapely.convex_hull(area).area == 0:
        raise ShapeError("The area has no size: list its corners once each, in order around it.")
    if not area.is_valid:
        raise ShapeError(f"The boundary crosses itself, or its holes do "
                         f"({shapely.is_valid_reason(area)}): list its corners once each, in order "
                         "around the area.")
    return shapely.segmentize(area, LONGEST_EDGE_DEG)


def _unwrapped(ring: FloatArray) -> FloatArray:
    """Return a ring, closed, whose longitudes don't jump where it crosses 180 degrees."""
    if (ring[0] != ring[-1]).any():
        ring = np.concatenate([ring, ring[:1]])
    if len(np.unique(ring, axis=0)) < 3:
        raise ShapeError("A ring needs at least 3 corners that differ: add some.")
    steps = np.diff(ring[:, 0])
    turns = np.where(steps > 180, -360.0, np.where(steps < -180, 360.0, 0.0)).cumsum()
    longitudes = ring[:, 0] + np.concatenate([[0.0], turns])
    if turns[-1] != 0 or np.ptp(longitudes) > 180:
        raise ShapeError("The zone reaches around the world: split it, or leave it out.")
    return np.stack([longitudes, ring[:, 1]], axis=1)


def circle_of(center: tuple[float, float], radius: float) -> Polygon:
    """Return a polygon around a circle of metres on the ellipsoid.

    Raises
    ------
    ShapeError
        If it is too large.
    """
    if radius > LARGEST_RADIUS_M:
        raise ShapeError(f"A radius of {radius:g} m reaches around the world: a radius is in "
                         "metres, and at most 1000 km.")
    corners = math.pi / math.acos(radius / (radius + ROUND_M))
    count = min(max(math.ceil(corners), FEWEST_CORNERS), MOST_CORNERS)
    azimuths = np.arange(count) * (360.0 / count)
    outside = np.full(count, radius * ROOM / math.cos(math.pi / count))
    longitudes, latitudes, _ = EARTH.fwd(np.full(count, center[0]), np.full(count, center[1]),
                                         azimuths, outside)
    return polygon_of([list(zip(longitudes.tolist(), latitudes.tolist(), strict=True))])
