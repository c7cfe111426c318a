"""Zones on the plane."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely import Polygon

from model.problem import FloatArray
from model.travel.airspace import Airspace, flight_legs
from model.travel.zones import WIDER_M, dissolved, holding, within_reach, without_holes

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


COORDINATE = st.floats(-5000, 5000)
STARS = st.lists(st.tuples(
    COORDINATE, COORDINATE, st.floats(0.5, 2000), st.lists(st.floats(0.02, 1), min_size=3,
                                                           max_size=40)), min_size=1, max_size=12)


def star(x: float, y: float, radius: float, sizes: list[float]) -> Polygon:
    """Return an area around a place, spiky or round."""
    turns = [2 * math.pi * number / len(sizes) for number in range(len(sizes))]
    return Polygon([(x + radius * size * math.cos(turn), y + radius * size * math.sin(turn))
                    for size, turn in zip(sizes, turns, strict=True)])


@pytest.mark.thorough
@given(STARS)
@settings(max_examples=150, deadline=None)
def test_what_is_dissolved_holds_what_was_published_and_hardly_more(
        stated: list[tuple[float, float, float, list[float]]]) -> None:
    areas = [star(*each) for each in stated]
    merged = shapely.union_all(dissolved(areas))
    wider = shapely.union_all(areas).buffer(WIDER_M)
    assert merged.is_valid
    assert all(merged.covers(area) for area in areas)
    assert wider.covers(merged)


@given(STARS, st.lists(st.tuples(COORDINATE, COORDINATE), min_size=2, max_size=5))
@example([(0.0, 17.0, 1.0, [1.0] * 3), (0.0, 1.0, 1.0, [1.0] * 4)], [(0.0, 0.0), (0.0, -5.0)])
@settings(max_examples=60, deadline=None)
def test_flights_meet_no_areas_but_those_within_reach(
        stated: list[tuple[float, float, float, list[float]]],
        places: list[tuple[float, float]]) -> None:
    areas = [star(*each) for each in stated]
    points: FloatArray = np.array(places) * 0.3
    near = [areas[number] for number in within_reach(areas, points)]
    legs = flight_legs(points, Airspace(zones=dissolved(near)), 36.0)
    of_all = flight_legs(points, Airspace(zones=dissolved(areas)), 36.0)
    assert legs.distance == pytest.approx(of_all.distance, abs=0.1)


def test_areas_far_away_are_not_within_reach() -> None:
    areas = [shapely.box(at, 0, at + 10, 10) for at in (0, 500, 9000)]
    assert within_reach(areas, np.array([(-50.0, 5.0), (600.0, 5.0)])).tolist() == [0, 1]
    assert within_reach([], np.array([(0.0, 0.0)])).tolist() == []


def test_areas_in_which_somebody_is_are_found() -> None:
    areas = [shapely.box(at, 0, at + 10, 10) for at in (0, 20, 40)]
    assert holding(areas, np.array([(45.0, 5.0), (5.0, 5.0), (15.0, 5.0)])).tolist() == [0, 2]


def test_low_areas_are_flown_over_and_not_landed_in() -> None:
    points = np.array([(-50.0, 5.0), (5.0, 5.0), (50.0, 5.0)])
    legs = flight_legs(points, Airspace(low_zones=(shapely.box(0, 0, 10, 10),)), 36.0)
    assert legs.distance[0, 2] == 100.0
    assert np.isinf(legs.distance[[0, 1, 1, 1, 2], [1, 0, 1, 2, 1]]).all()
