"""Areas of zones as polygons in degrees, each as large as what was published or a little larger."""

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
import shapely
from pyproj import Geod
from shapely import Polygon

from app.maps.airspace.masks import Piece, around, is_mask
from model.problem import FloatArray

EARTH = Geod(ellps="WGS84")

LONGEST_EDGE_DEG = 0.05
"""Edges are straight in degrees, flights are not: corners are put in between, so that no edge lies
farther than 0.3 m beside the published one, wherever it is projected to."""

ROUND_M = 2.0
"""How far the polygon for a circle may reach beyond it, where it has fewer than its most corners.
"""

FEWEST_CORNERS, MOST_CORNERS = 16, 128

ON_GLOBE = np.array((180.0, 90.0))

ROOM = 1.0001
"""By how much larger circles are drawn, as edges that are straight in degrees bend inwards."""

LARGEST_RADIUS_M = 1e6
"""Largest circle."""

Corners = Sequence[Sequence[float]] | FloatArray


class ShapeError(ValueError):
    """Corners or a radius make no area."""


def areas_of(rings: Sequence[Corners]) -> list[Piece]:
    """Return the area within a ring and outside those after it; rings needn't be closed.

    A mask of the world with holes comes in pieces.

    Raises
    ------
    ShapeError
        If it is none, or lies around the world.
    """
    if len(rings) > 1 and is_mask(_on_globe(rings[0])):
        return around([_valid(Polygon(_unwrapped(hole))) for hole in rings[1:]], LONGEST_EDGE_DEG)
    return [Piece(_polygon_of(rings))]


def _polygon_of(rings: Sequence[Corners]) -> Polygon:
    shell, *holes = map(_unwrapped, rings)
    area = _valid(Polygon(shell, [_beside(hole, shell) for hole in holes]))
    if holes or np.abs(shell[1:] - shell[:-1]).max() > LONGEST_EDGE_DEG:
        return shapely.segmentize(area, LONGEST_EDGE_DEG)
    return area


def _valid(area: Polygon) -> Polygon:
    """Return an area that is one."""
    if not area.is_valid:
        if shapely.convex_hull(area).area > 0:
            raise ShapeError(f"The boundary crosses itself, or its holes do "
                             f"({shapely.is_valid_reason(area)}): list its corners once each, in "
                             "order around the area.")
        raise ShapeError("The area has no size: list its corners once each, in order around it.")
    return area


def _beside(hole: FloatArray, shell: FloatArray) -> FloatArray:
    """Return a hole that may be stated on the other side of 180 degrees."""
    return hole + np.array((360 * round((shell[:, 0].mean() - hole[:, 0].mean()) / 360), 0))


def _on_globe(stated: Corners) -> FloatArray:
    """Return a ring, closed, of longitudes and latitudes as they are stated."""
    lengths = set(map(len, stated))
    corners = stated if len(lengths) == 1 else [corner[:2] for corner in stated]
    ring = np.array(corners, np.float64)[:, :2]
    (west, south), (east, north) = ring.min(axis=0).tolist(), ring.max(axis=0).tolist()
    if min(west + 180, south + 90, 180 - east, 90 - north) < 0:
        longitude, latitude = ring[(np.abs(ring) > ON_GLOBE).any(axis=1).argmax()].tolist()
        raise ShapeError(f"[{longitude:g}, {latitude:g}] is no longitude and latitude: correct it, "
                         "or swap the two.")
    if (ring[0] != ring[-1]).any():
        ring = np.concatenate([ring, ring[:1]])
    if len(ring) < 4:
        raise ShapeError("A ring needs at least 3 corners that differ: add some.")
    return ring


def _unwrapped(stated: Corners) -> FloatArray:
    """Return a ring, closed, whose longitudes don't jump where it crosses 180 degrees."""
    ring = _on_globe(stated)
    if np.ptp(ring[:, 0]) <= 180:
        return ring
    steps = np.diff(ring[:, 0])
    turns = np.where(steps > 180, -360.0, np.where(steps < -180, 360.0, 0.0)).cumsum()
    ring[1:, 0] += turns
    if turns[-1] != 0 or np.ptp(ring[:, 0]) > 180:
        raise ShapeError("The zone reaches around the world: split it, or leave it out.")
    return ring


def circle_of(center: Sequence[float], radius: float) -> list[Piece]:
    """Return a polygon around a circle of metres on the ellipsoid.

    Raises
    ------
    ShapeError
        If it is too large, or around no place.
    """
    if radius > LARGEST_RADIUS_M:
        raise ShapeError(f"A radius of {radius:g} m reaches around the world: a radius is in "
                         "metres, and at most 1000 km.")
    _unwrapped([center[:2]] * 4)
    corners = math.pi / math.acos(radius / (radius + ROUND_M))
    count = min(max(math.ceil(corners), FEWEST_CORNERS), MOST_CORNERS)
    azimuths, outside = _directions(count)
    longitudes, latitudes, _ = EARTH.fwd(np.full(count, center[0]), np.full(count, center[1]),
                                         azimuths, radius * outside)
    return [Piece(_polygon_of([np.stack([longitudes, latitudes], axis=1)]))]


@cache
def _directions(count: int) -> tuple[FloatArray, FloatArray]:
    """Return the directions of a polygon's corners, and how far they lie for a circle within."""
    return (np.linspace(0.0, 360.0, count, endpoint=False),
            np.full(count, ROOM / math.cos(math.pi / count)))
