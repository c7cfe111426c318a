"""Areas made wider by the distance that flights keep from them."""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import Polygon

from model.problem import FloatArray
from model.problem.distances import EARTH_RADIUS_M

ARC_SEGMENTS = 8
"""Edges in place of each quarter of a circle around a corner."""

ELLIPSOID = 1.006
"""By how much a metre on the ellipsoid is at most longer than it is on the sphere."""

FARTHEST = 2.5
"""Radians from the centre beyond which no plane is true enough to plan on."""

LEAST_REACH_M, REACH = 1e5, 4.0
"""How far from the centre flights may lead at least, and by how much farther than places lie."""


def planar_buffers(areas: Sequence[Polygon], buffer: float, farthest: float | None) -> FloatArray:
    """Return how many metres each area grows by on the plane, for a buffer on the ground.

    Never less than the buffer: at an angle c from its centre, `LocalProjection` stretches lengths
    by up to c / sin c. `farthest` is how far from the centre places lie; None on a plane.
    """
    if farthest is None or not len(areas):
        return np.full(len(areas), buffer)
    west, south, east, north = shapely.bounds(np.array(areas, dtype=object)).T
    away = np.hypot(np.maximum(-west, east), np.maximum(-south, north))
    # Empty areas, which are nowhere near, have no bounds.
    met = np.minimum(np.nan_to_num(away), max(LEAST_REACH_M, REACH * farthest))
    angle = np.clip(met / EARTH_RADIUS_M, 1e-9, FARTHEST)
    return buffer * ELLIPSOID * angle / np.sin(angle)


def grown(areas: Sequence[Polygon], by: FloatArray) -> list[Polygon]:
    """Return areas grown by metres each, and at corners hardly more: no chord cuts its arc."""
    outside = by / np.cos(np.pi / (4 * ARC_SEGMENTS))
    return list(shapely.buffer(np.array(areas, dtype=object), outside, quad_segs=ARC_SEGMENTS))


def reaches_of(edges: FloatArray, by: float) -> FloatArray:
    """Return the (edge, 4) boxes, as their diagonals, in which the outlines of grown edges lie."""
    first, last = edges[:, :2], edges[:, 2:]
    return np.concatenate([np.minimum(first, last) - by, np.maximum(first, last) + by], axis=1)
