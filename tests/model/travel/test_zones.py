"""Zones on the plane."""

import pytest
import shapely
from shapely import Polygon

from model.travel.zones import without_holes

HOLES = ([(1, 1), (2, 1), (2, 2)], [(1.2, 3), (4, 3), (4, 4)], [(5, 5), (5.5, 5), (5, 5.5)])


@pytest.mark.parametrize("holes", [HOLES[:number] for number in range(4)])
def test_pieces_without_holes_are_the_same_area(
        holes: tuple[list[tuple[float, float]], ...]) -> None:
    area = Polygon([(0, 0), (6, 0), (6, 6), (0, 6)], holes)
    pieces = without_holes(area)
    assert all(len(piece.interiors) == 0 for piece in pieces)
    assert sum(piece.area for piece in pieces) == pytest.approx(area.area)
    assert shapely.union_all(pieces).buffer(1e-9).covers(area)


def test_area_without_holes_stays_as_it_is() -> None:
    area = Polygon([(0, 0), (3, 0), (1, 1), (0, 3)])
    assert without_holes(area) == [area]
