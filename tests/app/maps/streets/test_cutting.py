"""Tiles hold what shapes have within them, whole ones together all of it."""

import numpy as np
import pytest
import shapely

from app.maps.streets.cutting import EXTENT, MARGIN, TilePiece, named_pieces, pieces
from app.maps.streets.kinds import KINDS, MOST_ZOOM
from app.maps.streets.reading import NamedLines

TILE = 1 / (1 << MOST_ZOOM)


def tiles(kind: str, *shapes: shapely.Geometry) -> dict[tuple[int, int, int], TilePiece]:
    """Return the pieces of shapes by tile."""
    return {(piece.zoom, piece.x, piece.y): piece
            for _, piece in pieces({kind: np.array(shapes)})}


def shapes_of(piece: TilePiece) -> list[np.ndarray]:
    """Return a piece's lines in the map's own coordinates."""
    steps = [np.array(line).reshape(-1, 2).cumsum(axis=0) for line in piece.lines]
    return [(places / EXTENT + (piece.x, piece.y)) / (1 << piece.zoom) for places in steps]


def test_line_within_a_tile_is_there_to_the_step() -> None:
    line = shapely.LineString([(1000.25 * TILE, 2000.5 * TILE), (1000.75 * TILE, 2000.5 * TILE)])
    piece = tiles("street", line)[MOST_ZOOM, 1000, 2000]
    assert piece.lines == [[EXTENT // 4, EXTENT // 2, EXTENT // 2, 0]]


def test_line_is_cut_at_the_margins_of_tiles() -> None:
    line = shapely.LineString([(1000.5 * TILE, 2000.5 * TILE), (1002.5 * TILE, 2000.5 * TILE)])
    found = tiles("street", line)
    assert [key for key in found if key[0] == MOST_ZOOM] == [
        (MOST_ZOOM, 1000, 2000), (MOST_ZOOM, 1001, 2000), (MOST_ZOOM, 1002, 2000)]
    ((left, _, across, down),) = found[MOST_ZOOM, 1001, 2000].lines
    assert (left, across, down) == (-MARGIN, EXTENT + 2 * MARGIN, 0)


def test_ring_and_hole_are_orientated_against_each_other() -> None:
    area = shapely.box(1000.1 * TILE, 2000.1 * TILE, 1000.9 * TILE, 2000.9 * TILE).difference(
        shapely.box(1000.4 * TILE, 2000.4 * TILE, 1000.6 * TILE, 2000.6 * TILE))
    rings = [shapely.LinearRing(ring)
             for ring in shapes_of(tiles("water", area)[MOST_ZOOM, 1000, 2000])]
    assert [ring.is_ccw for ring in rings] in ([True, False], [False, True])
    outline, hole = map(shapely.Polygon, rings)
    assert (outline.area - hole.area) / area.area == pytest.approx(1, rel=1e-3)


def test_kinds_begin_at_their_zoom() -> None:
    line = shapely.LineString([(0.4999, 0.4999), (0.5002, 0.5001)])
    for kind in KINDS:
        if not kind.is_area and kind.from_zoom <= 9:
            zooms = {zoom for zoom, _, _ in tiles(kind.name, line)}
            assert zooms == set(range(kind.from_zoom, MOST_ZOOM + 1))


def test_what_is_too_small_to_see_is_left_out_but_at_the_last_zoom() -> None:
    pond = shapely.box(0.5, 0.5, 0.5 + TILE / 64, 0.5 + TILE / 64)
    assert {zoom for zoom, _, _ in tiles("water", pond)} >= {MOST_ZOOM}
    assert min(zoom for zoom, _, _ in tiles("water", pond)) > 9


def test_tiles_together_hold_all_of_random_lines() -> None:
    rng = np.random.default_rng(5)
    lines = [shapely.LineString(1000 * TILE + 3 * TILE * rng.random((6, 2))) for _ in range(10)]
    length = sum(
        shapely.intersection(
            shapely.LineString(line),
            shapely.box(*(np.array([key[1], key[2], key[1] + 1, key[2] + 1]) * TILE))).length
        for key, piece in tiles("street", *lines).items()
        if key[0] == MOST_ZOOM for line in shapes_of(piece))
    assert length == pytest.approx(sum(line.length for line in lines), rel=1e-3)


def test_names_are_in_every_tile_that_their_line_crosses() -> None:
    line = shapely.LineString([(1000.5 * TILE, 2000.5 * TILE), (1002.5 * TILE, 2000.5 * TILE)])
    short = shapely.LineString([(1000.5 * TILE, 2000.6 * TILE), (1000.52 * TILE, 2000.6 * TILE)])
    named = NamedLines(["Long Street", "Nook"], np.array([line, short]))
    found = [(kind.name, name, piece.zoom, piece.x)
             for kind, name, piece in named_pieces({"main": named})]
    assert [each for each in found if each[2] == MOST_ZOOM] == [
        ("main", "Long Street", MOST_ZOOM, x) for x in (1000, 1001, 1002)]
    assert {zoom for _, _, zoom, _ in found} == {13, 14}
    assert list(named_pieces({"rail": named})) == []
