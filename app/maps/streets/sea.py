"""The sea of an extract, from its coastlines: ways with land on their left and water on the right.

An extract holds pieces of coastlines, which cut its box into faces. A face is sea if the coastlines
around it have it on their right.
"""

import numpy as np
import shapely

from model.problem import FloatArray

Box = tuple[float, float, float, float]
"""West, south, east and north in degrees."""

Shapes = np.ndarray[tuple[int], np.dtype[np.object_]]
"""Geometries of shapely."""

BESIDE = 1e-6
"""Degrees from a coastline to where it is looked at what lies there."""

NEAR = 0.05
"""Share of the box's shorter side from which on a place is near its edge."""

SURE = 0.9
"""Share of the coast, by length, that must have a face on its right. Where coastlines end within
the box, which some extracts are cut so, a face has both, and no sea is drawn at all."""


def sea_of(coasts: Shapes, bounds: Box) -> Shapes:
    """Return the faces of a box that are sea, as polygons. Coordinates are degrees."""
    box = shapely.box(*bounds)
    if not len(coasts):
        return np.empty(0, object)
    cut = shapely.unary_union([*coasts, *_to_edge(coasts, box), box.boundary])
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(cut)))
    faces = faces[shapely.contains(box, shapely.point_on_surface(faces))]
    starts, ends = _segments(coasts)
    middles, lengths = (starts + ends) / 2, np.hypot(*(ends - starts).T)
    starts, ends, middles, lengths = (
        part[lengths > 0] for part in (starts, ends, middles, lengths))
    lengths = lengths[lengths > 0]
    to_right = np.column_stack((ends[:, 1] - starts[:, 1], starts[:, 0] - ends[:, 0]))
    to_right *= BESIDE / lengths[:, None]
    tree = shapely.STRtree(faces)
    on_right, on_left = (_lengths_beside(tree, len(faces), middles + side * to_right, lengths)
                         for side in (1, -1))
    return faces[(on_right > 0) & (on_right >= SURE * (on_right + on_left))]


def _to_edge(coasts: Shapes, box: shapely.Polygon) -> Shapes:
    """Return lines from where coastlines end to the edge of the box, if it is near.

    Extracts often end coastlines at their last place within the box.
    """
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(coasts)))
    merged = merged[~shapely.is_closed(merged)]
    ends = np.concatenate((shapely.get_point(merged, 0), shapely.get_point(merged, -1)))
    west, south, east, north = box.bounds
    near = NEAR * min(east - west, north - south)
    ends = ends[shapely.dwithin(ends, box.boundary, near) & shapely.contains(box, ends)]
    return shapely.shortest_line(ends, box.boundary)


def _segments(lines: Shapes) -> tuple[FloatArray, FloatArray]:
    points, line = shapely.get_coordinates(lines, return_index=True)
    joined = line[1:] == line[:-1]
    return points[:-1][joined], points[1:][joined]


def _lengths_beside(tree: shapely.STRtree, faces: int, places: FloatArray,
                    lengths: FloatArray) -> FloatArray:
    """Return, for each face, the length of the coast of which a side lies in it."""
    place, face = tree.query(shapely.points(places), predicate="within")
    return np.bincount(face, lengths[place], faces).astype(np.float64)
