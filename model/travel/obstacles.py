"""No-fly areas as flights meet them: edges that none may cross, corners where it may bend."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from model.engine.library import call
from model.problem import BoolArray, FloatArray

TOUCH_M = 0.0005
"""How deep a flight may cut into a no-fly area and still count as touching its boundary."""

FEW_EDGES = 12
"""With no more edges than this, the engine compares every line of sight with all."""


class Corners(NamedTuple):
    """Where alone shortest ways bend."""

    place: FloatArray  # (corner, 2)
    before: FloatArray  # (corner, 2) the neighbours on the boundary, or itself where areas touch
    after: FloatArray  # (corner, 2)


class Obstacles(NamedTuple):
    """What flights meet."""

    parts: BaseGeometry  # what no flight may meet
    edges: FloatArray  # (edge, 4) x and y of both ends of the parts' edges
    corners: Corners  # outside the parts
    low: BaseGeometry  # where nobody takes off or lands

    def hold(self, points: FloatArray) -> BoolArray:
        """Mark the (point, 2) points that can't be flown to: they lie in a part, or in what is low.
        """
        return _inside(self.parts, points) | _inside(self.low, points)


def obstacles_of(rings: Sequence[Sequence[tuple[float, float]]],
                 zones: Sequence[Polygon] = (), low: Sequence[Polygon] = ()) -> Obstacles:
    """Merge areas, given by their corners, and zones, which lie apart; `low` ones are flown over.
    """
    if rings:
        areas = shapely.union_all([*[Polygon(ring) for ring in rings], *zones])
        parts = _shrunk(areas.buffer(TOUCH_M, join_style="mitre"), 2 * TOUCH_M)
    else:
        areas = MultiPolygon(list(zones))
        parts = _shrunk(areas, TOUCH_M)
    corners = _corners(areas)
    free = ~_inside(parts, corners.place)
    return Obstacles(parts, edges_of(polygons_of(parts)),
                     Corners(*(places[free] for places in corners)), shapely.union_all(list(low)))


def edges_of(areas: Sequence[BaseGeometry]) -> FloatArray:
    """Return the (edge, 4) x and y of both ends of the edges of areas."""
    if not areas:
        return np.empty((0, 4))
    rings = shapely.get_rings(np.array(areas, dtype=object))
    corners, ring = shapely.get_coordinates(rings, return_index=True)
    same = ring[:-1] == ring[1:]
    return np.concatenate([corners[:-1][same], corners[1:][same]], axis=1)


def count_nearby(edges: FloatArray) -> int:
    """Return how many pairs of edges may cross, about, by which merging them takes longer."""
    return int(call("tandem_count_nearby", edges))


def _shrunk(areas: BaseGeometry, by: float) -> BaseGeometry:
    """Return what no flight may meet: areas, hairline gaps between which are closed, a bit smaller.

    Against shrunk areas, flights along an edge or past a corner are clear by a margin, so that no
    rounding of coordinates decides whether they touch or cut.
    """
    apart = shapely.buffer(shapely.get_parts(areas), -by, join_style="mitre")
    shrunk = MultiPolygon([polygon for part in apart for polygon in polygons_of(part)])
    shapely.prepare(shrunk)
    return shrunk


def polygons_of(geometry: BaseGeometry) -> list[Polygon]:
    """Return the polygons of a geometry that aren't empty."""
    parts = geometry.geoms if isinstance(geometry, MultiPolygon) else (geometry,)
    return [part for part in parts if isinstance(part, Polygon) and not part.is_empty]


def _inside(parts: BaseGeometry, points: FloatArray) -> BoolArray:
    inside: BoolArray = shapely.intersects_xy(parts, points[:, 0], points[:, 1])
    return inside


def _corners(areas: BaseGeometry) -> Corners:
    """Return the areas' convex corners, and where boundaries touch."""
    rings = shapely.get_rings(shapely.orient_polygons(shapely.get_parts(areas)))
    closed, ring = shapely.get_coordinates(rings, return_index=True)
    # Each ring ends with its first corner again.
    ends = np.flatnonzero(np.diff(ring, append=-1))
    before = np.arange(len(closed)) - 1
    before[ends[:-1] + 1], before[:1] = ends[1:] - 1, ends[:1] - 1
    corner = np.delete(np.arange(len(closed)), ends)
    together = np.stack([closed[corner], closed[before[corner]], closed[corner + 1]], axis=1)
    places = together[:, 0]
    to, away = places - together[:, 1], together[:, 2] - places
    # The area lies on the left of every ring, so its convex corners turn left.
    convex = to[:, 0] * away[:, 1] - to[:, 1] * away[:, 0] > 0
    _, which, times = np.unique(places[:, 0] + 1j * places[:, 1], return_inverse=True,
                                return_counts=True)
    touching = times[which] > 1
    # Between two areas that touch, a way may bend to either side.
    together[touching, 1:] = places[touching, None]
    chosen = together[convex | touching]
    return Corners(*(np.ascontiguousarray(chosen[:, column]) for column in range(3)))

