"""Coastlines have land on their left and water on their right."""

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from app.maps.streets.sea import sea_of

BOX = (0.0, 0.0, 10.0, 10.0)


def sea(*coasts: list[tuple[float, float]]) -> BaseGeometry:
    return shapely.union_all(sea_of(shapely.linestrings(coasts), BOX))


def test_sea_is_on_the_right_of_a_coast() -> None:
    assert sea([(4, 0), (4, 10)]).equals(shapely.box(4, 0, 10, 10))
    assert sea([(4, 10), (4, 0)]).equals(shapely.box(0, 0, 4, 10))


def test_coast_may_go_on_beyond_the_box() -> None:
    assert sea([(4, -5), (4, 20)]).equals(shapely.box(4, 0, 10, 10))


def test_coast_that_ends_just_before_the_edge_is_taken_there() -> None:
    assert sea([(4, 0.2), (4, 9.8)]).equals(shapely.box(4, 0, 10, 10))


def test_island_lies_in_the_sea() -> None:
    island = shapely.box(3, 3, 5, 5)
    found = sea([(3, 3), (5, 3), (5, 5), (3, 5), (3, 3)])
    assert found.equals(shapely.box(*BOX).difference(island))


def test_lagoon_is_sea_within_land() -> None:
    assert sea([(3, 3), (3, 5), (5, 5), (5, 3), (3, 3)]).equals(shapely.box(3, 3, 5, 5))


def test_coast_in_pieces_is_one_coast() -> None:
    assert sea([(4, 5), (4, 10)], [(4, 0), (4, 5)]).equals(shapely.box(4, 0, 10, 10))


def test_no_sea_is_drawn_where_a_coast_ends_amid_the_box() -> None:
    assert sea([(4, 0), (4, 5)]).is_empty


def test_without_coast_there_is_no_sea() -> None:
    assert len(sea_of(np.empty(0, object), BOX)) == 0
