"""Zones of the airspace on the plane: cut to what matters, merged, with fewer corners."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import GeometryCollection, Polygon

from model.problem import FloatArray, IntArray
from model.travel.obstacles import polygons_of

EDGE_M = 0.5
"""How far the edge of an area may lie beside what was published, as that is straight in degrees."""

SIMPLER_M = 2.0
"""How far a corner may lie beside the edge that replaces it."""

LONGEST_MITRE = 2.0
"""By how much a corner may be moved farther than edges are."""

KEPT = 16
"""Merged areas that are kept, as requests with the same follow one another."""

WIDER_M = LONGEST_MITRE * (SIMPLER_M + EDGE_M) + SIMPLER_M
"""How far what is flown around may reach beyond what was published."""


def within_reach(areas: Sequence[Polygon], points: FloatArray, apart: float = 0.0) -> IntArray:
    """Return the indices of the areas that shortest flights between (point, 2) points may meet.

    Those flights keep up to so many metres `apart` from them.

    A shortest way around some areas, made wider, lies within the convex hull of its ends and of
    those areas, or hardly beside it. So once that meets no others, these don't matter.
    """
    tree = shapely.STRtree(areas)
    hull = shapely.MultiPoint(points).convex_hull
    wider = WIDER_M + apart
    found = new = tree.query(hull, predicate="dwithin", distance=wider)
    while True:
        hull = GeometryCollection([hull, *(areas[index] for index in new)]).convex_hull
        more = tree.query(hull, predicate="dwithin", distance=2 * wider)
        new = np.setdiff1d(more, found)
        if len(new) == 0:
            return np.sort(found)
        found = more


def are_within_reach(areas: Sequence[Polygon], points: FloatArray, apart: float = 0.0) -> bool:
    """Tell whether there are any areas that `within_reach` returns."""
    hull = shapely.MultiPoint(points).convex_hull
    return bool(shapely.dwithin(np.array(areas, dtype=object), hull, 2 * (WIDER_M + apart)).any())


def holding(areas: Sequence[Polygon], points: FloatArray, apart: float = 0.0) -> IntArray:
    """Return the indices of the areas in which any of (point, 2) points lies, or so near to."""
    tree = shapely.STRtree(areas)
    _, found = tree.query(shapely.points(points), predicate="dwithin", distance=apart)
    return np.unique(found)


def dissolved(areas: Sequence[Polygon]) -> tuple[Polygon, ...]:
    """Return areas that hold all those given: merged, and with fewer corners. The last are kept."""
    return _dissolved(written(areas))


def written(areas: Sequence[Polygon]) -> tuple[bytes, ...]:
    """Return areas in binary, by which equal ones are told."""
    return tuple([shapely.to_wkb(area) for area in areas])


def read_back(areas: Sequence[bytes]) -> list[Polygon]:
    """Return the areas that were `written`."""
    return list(shapely.from_wkb(np.array(areas, dtype=object))) if areas else []


@lru_cache(maxsize=KEPT)
def _dissolved(areas: tuple[bytes, ...]) -> tuple[Polygon, ...]:
    if not areas:
        return ()
    # Which corners go hangs on where an edge begins, which others far away must not change.
    merged = shapely.get_parts(
        shapely.disjoint_subset_union_all(read_back(areas)).normalize())
    simpler = _wider(shapely.simplify(merged, SIMPLER_M), SIMPLER_M + EDGE_M)
    # What is simplified may lose what is thin.
    thin = ~shapely.covers(simpler, merged)
    simpler[thin] = _wider(merged[thin], EDGE_M)
    return tuple(polygons_of(shapely.disjoint_subset_union_all(simpler)))


def without_holes(area: Polygon) -> list[Polygon]:
    """Return an area in pieces that have no holes: it is cut through each of them."""
    if not area.interiors:
        return [area]
    x = area.interiors[0].centroid.x
    west, south, east, north = area.bounds
    halves = shapely.intersection(shapely.make_valid(area), [
        shapely.box(west, south, x, north), shapely.box(x, south, east, north)])
    return [piece for part in shapely.get_parts(halves) if isinstance(part, Polygon)
            for piece in without_holes(part)]


def _wider(areas: NDArray[np.object_], by: float) -> NDArray[np.object_]:
    return shapely.buffer(areas, by, join_style="mitre", mitre_limit=LONGEST_MITRE)
