"""Shapes -> tiles: clipped, simplified by zoom, in whole steps from a tile's corner.

A tile is a JSON object: for each kind that it shows, a list of lines or rings. Each is one flat
list of numbers: x and y of its first point, then the step to each further one, in 4096ths of the
tile, eastwards and southwards. Rings are closed and orientated, holes against their outlines, so
that all those of a kind can be filled at once. They reach a little beyond the tile, so that no edge
is seen.

Under `names` there is a list for each line that has a name: its kind, the name, and such lists of
numbers of the way that the name may be written along.
"""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
import shapely

from app.maps.streets.kinds import KINDS, LEAST_ZOOM, MOST_ZOOM, StreetKind
from app.maps.streets.reading import NamedLines
from app.maps.streets.sea import Shapes
from model.problem import FloatArray, IntArray

EXTENT = 4096
PIXELS = 512
"""Tiles are drawn this large, until their zoom is the last."""

MARGIN = 128
"""Beyond the tile's edges, in the same steps: half of the widest line fits."""

FINEST, COARSE = 1.0, EXTENT / PIXELS / 2
"""Steps that simplifying may move a line: at the last zoom, which is enlarged, and before."""

SMALLEST_AREA = 4 * (EXTENT / PIXELS) ** 2
"""Square steps: what is smaller is left out before the last zoom."""

LEAST_NAMED = 16 * EXTENT // PIXELS
"""Steps: ways that are shorter have no room for a name, even where the last zoom is enlarged."""


class TilePiece(NamedTuple):
    """What a tile shows of a kind."""

    zoom: int
    x: int
    y: int
    lines: list[list[int]]


def pieces(shapes: Mapping[str, Shapes]) -> Iterator[tuple[StreetKind, TilePiece]]:
    """Yield what each tile shows of each kind, in the order of painting."""
    for kind in KINDS:
        if kind.name in shapes:
            for zoom in range(max(kind.from_zoom, LEAST_ZOOM), MOST_ZOOM + 1):
                for piece in _cut(shapes[kind.name], kind, zoom):
                    yield kind, piece


def named_pieces(named: Mapping[str, NamedLines]) -> Iterator[tuple[StreetKind, str, TilePiece]]:
    """Yield what each tile shows of each line that has a name: its kind, its name, and itself."""
    for kind in KINDS:
        if kind.name in named and kind.names_from is not None:
            names, lines = named[kind.name]
            for zoom in range(kind.names_from, MOST_ZOOM + 1):
                step = 1 / (EXTENT << zoom)
                simple = shapely.simplify(lines, COARSE * step)
                long = np.flatnonzero(shapely.length(simple) >= LEAST_NAMED * step)
                for x, y, shapes, which in quartered(simple[long], long, zoom, (0, 0), 0):
                    for shape, name in zip(shapes, which.tolist(), strict=True):
                        if ways := steps_of(np.array([shape]), False, (x, y), zoom):
                            yield kind, names[name], TilePiece(zoom, x, y, ways)


def _cut(shapes: Shapes, kind: StreetKind, zoom: int) -> Iterator[TilePiece]:
    """Yield what the tiles of a zoom show of shapes of one kind."""
    step = 1 / (EXTENT << zoom)
    is_last = zoom == MOST_ZOOM
    simple = shapely.simplify(shapes, (FINEST if is_last else COARSE) * step,
                              preserve_topology=kind.is_area)
    if kind.is_area and not is_last:
        simple = simple[shapely.area(simple) >= SMALLEST_AREA * step**2]
    for x, y, within, _ in quartered(simple, np.arange(len(simple)), zoom, (0, 0), 0):
        if lines := steps_of(within, kind.is_area, (x, y), zoom):
            yield TilePiece(zoom, x, y, lines)


def quartered(shapes: Shapes, which: IntArray, zoom: int, tile: tuple[int, int],
              depth: int) -> Iterator[tuple[int, int, Shapes, IntArray]]:
    """Yield what the tiles of a zoom within a larger one hold, and which shapes that is of.

    The larger one's zoom is the depth. From quarter to quarter large shapes become small, so that
    none is cut by each of its tiles.
    """
    x, y = tile
    shapes, which = _clipped(shapes, which, np.array([x, y, x + 1, y + 1]) / (1 << depth)
                             + np.array([-1, -1, 1, 1]) * (MARGIN / EXTENT / (1 << zoom)))
    if depth < zoom and len(shapes):
        for quarter in ((2 * x, 2 * y), (2 * x + 1, 2 * y), (2 * x, 2 * y + 1),
                        (2 * x + 1, 2 * y + 1)):
            yield from quartered(shapes, which, zoom, quarter, depth + 1)
    elif len(shapes):
        yield x, y, shapes, which


def _clipped(shapes: Shapes, which: IntArray, frame: FloatArray) -> tuple[Shapes, IntArray]:
    """Return what of shapes lies within a frame, and which they are of."""
    boxes = shapely.bounds(shapes)
    touches = (boxes[:, :2] <= frame[2:]).all(axis=1) & (boxes[:, 2:] >= frame[:2]).all(axis=1)
    shapes, boxes, which = shapes[touches], boxes[touches], which[touches]
    beyond = (boxes[:, :2] < frame[:2]).any(axis=1) | (boxes[:, 2:] > frame[2:]).any(axis=1)
    shapes[beyond] = shapely.clip_by_rect(shapes[beyond], *frame)
    there = ~shapely.is_empty(shapes)
    return shapes[there], which[there]


def steps_of(shapes: Shapes, are_areas: bool, tile: tuple[int, int], zoom: int) -> list[list[int]]:
    """Return the lines of shapes within a tile, as steps from point to point, (2 a point)."""
    parts = shapely.get_parts(shapes)
    wanted = shapely.GeometryType.POLYGON if are_areas else shapely.GeometryType.LINESTRING
    parts = parts[shapely.get_type_id(parts) == wanted]
    if not len(parts):
        return []
    if are_areas:
        parts = shapely.get_rings(shapely.orient_polygons(parts))
    points, line = shapely.get_coordinates(parts, return_index=True)
    places = np.rint((points * (1 << zoom) - tile) * EXTENT).astype(np.int64)
    moved = np.ones(len(places), np.bool_)
    moved[1:] = (places[1:] != places[:-1]).any(axis=1) | (line[1:] != line[:-1])
    places, line = places[moved], line[moved]
    begins = np.flatnonzero(np.diff(line, prepend=-1))
    steps = np.diff(places, axis=0, prepend=np.zeros((1, 2), np.int64))
    steps[begins] = places[begins]
    numbers = steps.ravel().tolist()
    ends = (2 * np.append(begins[1:], len(places))).tolist()
    least = 2 * (4 if are_areas else 2)
    return [numbers[begin:end] for begin, end in zip((2 * begins).tolist(), ends, strict=True)
            if end - begin >= least]
