"""Masks: zones that close the whole world but for the holes in them.

Nobody flies out of the piece around a hole, so that of all else it matters alone who is there.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Polygon
from shapely.affinity import translate

from model.problem import FloatArray
from model.travel.obstacles import polygons_of

WORLD = shapely.box(-180.0, -90.0, 180.0, 90.0)

LEAST = (-179.0, -80.0, 179.0, 80.0)
"""What a mask holds at least: maps for the web end at 85 degrees of latitude."""

FRAME_DEG = 5.0
"""How far the piece around a hole reaches; beyond half of that nothing has to be precise."""

TILE_DEG = 30
"""How large the pieces are of what lies farther away."""

TILE_EDGE_DEG = 1.0
"""How long the edges of those are at most."""


class Piece(NamedTuple):
    """An area in degrees, or a part of it."""

    area: Polygon
    is_far: bool = False  # what flights meet before lies around it


def is_mask(shell: FloatArray) -> bool:
    """Tell whether a ring, in degrees as stated, is the edge of a map of the world."""
    (west, south), (east, north) = shell.min(axis=0).tolist(), shell.max(axis=0).tolist()
    if west > LEAST[0] or south > LEAST[1] or east < LEAST[2] or north < LEAST[3]:
        return False
    # A ring that follows the map's edge, in however many corners.
    on_edge = np.isin(shell[:, 0], (west, east)) | np.isin(shell[:, 1], (south, north))
    return bool(on_edge.all()) and math.isclose(
        Polygon(shell).area, (east - west) * (north - south))


def around(holes: Sequence[Polygon], edge_deg: float) -> list[Piece]:
    """Return the world without holes: precise around them, with edges of at most so many degrees.

    What lies farther away comes in tiles, none of which reaches around the world.
    """
    within = shapely.union_all([_on_map(hole) for hole in holes])
    bounds = shapely.bounds(shapely.get_parts(within))
    frames = shapely.difference(_boxes(bounds, FRAME_DEG), within)
    far = shapely.difference(_tiles(), _boxes(bounds, FRAME_DEG / 2))
    return [*map(Piece, polygons_of(shapely.segmentize(frames, edge_deg))),
            *(Piece(tile, is_far=True) for part in shapely.segmentize(far, TILE_EDGE_DEG).tolist()
              for tile in polygons_of(part))]


def _on_map(hole: Polygon) -> shapely.Geometry:
    """Return a hole, which may go on beyond 180 degrees, on the map."""
    return shapely.union_all([shapely.intersection(WORLD, translate(hole, turn))
                              for turn in (-360.0, 0.0, 360.0)])


def _boxes(bounds: FloatArray, by: float) -> shapely.Geometry:
    """Return the boxes around (part, 4) bounds, wider by degrees, as one."""
    west, south, east, north = bounds.T
    return shapely.intersection(WORLD, shapely.union_all(
        shapely.box(west - by, south - by, east + by, north + by)))


def _tiles() -> NDArray[np.object_]:
    west, south = np.meshgrid(np.arange(-180, 180, TILE_DEG), np.arange(-90, 90, TILE_DEG))
    return shapely.box(west.ravel(), south.ravel(), west.ravel() + TILE_DEG,
                       south.ravel() + TILE_DEG)
