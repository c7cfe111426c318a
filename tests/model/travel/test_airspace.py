"""Flights around no-fly areas and in wind, by numbers worked out by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from model.travel.airspace import Airspace, Ring, flight_legs, invalid_polygon_reason
from model.travel.matrices import LocalProjection, great_circle_distances, local_coordinates

SPEED = 36.0  # km/h, 10 m/s
SQUARE: Ring = ((-100.0, -100.0), (100.0, -100.0), (100.0, 100.0), (-100.0, 100.0))
# Opens north: walls of 100 m left, right and below of the bay [-100, 100] x [0, 200].
U_SHAPE: Ring = ((-200.0, -100.0), (200.0, -100.0), (200.0, 200.0), (100.0, 200.0),
                 (100.0, 0.0), (-100.0, 0.0), (-100.0, 200.0), (-200.0, 200.0))
COORDINATE = st.integers(-300, 300).map(float)
POINTS = st.lists(st.tuples(COORDINATE, COORDINATE), min_size=2, max_size=6)
WIND = st.tuples(st.floats(0, 30), st.floats(0, 360))


def moved(ring: Ring, x: float, y: float) -> Ring:
    return tuple((corner_x + x, corner_y + y) for corner_x, corner_y in ring)


def distance(airspace: Airspace, start: tuple[float, float], end: tuple[float, float]) -> float:
    legs = flight_legs(np.array([start, end]), airspace, SPEED)
    assert legs.duration == pytest.approx(legs.distance / 10.0)
    assert legs.distance[0, 1] == pytest.approx(legs.distance[1, 0])
    return float(legs.distance[0, 1])


def duration(airspace: Airspace, start: tuple[float, float], end: tuple[float, float]) -> float:
    return float(flight_legs(np.array([start, end]), airspace, SPEED).duration[0, 1])


def test_free_airspace_is_flown_straight() -> None:
    assert distance(Airspace(), (0.0, 0.0), (300.0, 400.0)) == 500.0


def test_a_square_is_flown_around_by_two_corners() -> None:
    expected = 2 * math.hypot(100, 100) + 200
    assert distance(Airspace((SQUARE,)), (-200.0, 0.0), (200.0, 0.0)) == pytest.approx(expected)


def test_a_square_is_flown_around_on_its_short_side() -> None:
    expected = 2 * math.hypot(100, 40) + 200
    assert distance(Airspace((SQUARE,)), (-200.0, 60.0), (200.0, 60.0)) == pytest.approx(expected)


def test_either_orientation_and_a_closing_point_mean_the_same_area() -> None:
    expected = distance(Airspace((SQUARE,)), (-200.0, 0.0), (200.0, 30.0))
    for ring in (SQUARE[::-1], (*SQUARE, SQUARE[0])):
        assert distance(Airspace((ring,)), (-200.0, 0.0), (200.0, 30.0)) == expected


def test_following_an_edge_and_touching_a_corner_are_allowed() -> None:
    airspace = Airspace((SQUARE,))
    assert distance(airspace, (-200.0, 100.0), (200.0, 100.0)) == 400.0
    assert distance(airspace, (-200.0, 0.0), (0.0, 200.0)) == pytest.approx(math.hypot(200, 200))


def test_points_on_the_boundary_can_be_flown_to() -> None:
    airspace = Airspace((SQUARE,))
    assert distance(airspace, (0.0, 100.0), (0.0, 300.0)) == 200.0
    assert distance(airspace, (0.0, 100.0), (100.0, 0.0)) == pytest.approx(200.0)


def test_a_point_inside_has_no_flights_at_all() -> None:
    points = np.array([(0.0, 0.0), (200.0, 0.0), (300.0, 0.0), (0.0, 0.0)])
    legs = flight_legs(points, Airspace((SQUARE,)), SPEED)
    inside = np.array([True, False, False, True])
    expected = inside[:, None] | inside
    assert np.array_equal(np.isinf(legs.distance), expected)
    assert np.array_equal(np.isinf(legs.duration), expected)


def test_overlapping_squares_are_one_area() -> None:
    # Past the outer corners (-100, 100) and (0, 250); the notch (0, 100) between them is cut off.
    airspace = Airspace((SQUARE, moved(SQUARE, 100.0, 150.0)))
    expected = math.hypot(50, 150) + math.hypot(100, 150) + math.hypot(100, 50)
    assert distance(airspace, (-150.0, -50.0), (100.0, 300.0)) == pytest.approx(expected)


def test_squares_that_share_an_edge_leave_no_gap() -> None:
    airspace = Airspace((SQUARE, moved(SQUARE, 200.0, 0.0)))
    expected = 2 * math.hypot(200, 100) + 200
    assert distance(airspace, (100.0, -200.0), (100.0, 200.0)) == pytest.approx(expected)


def test_hairline_gaps_do_not_let_through() -> None:
    airspace = Airspace((SQUARE, moved(SQUARE, 200.0000001, 0.0)))
    assert distance(airspace, (100.0, -200.0), (100.0, 200.0)) > 600.0


def test_squares_that_share_a_corner_let_through_there() -> None:
    airspace = Airspace((SQUARE, moved(SQUARE, 200.0, 200.0)))
    assert distance(airspace, (0.0, 200.0), (200.0, 0.0)) == pytest.approx(math.hypot(200, 200))


def test_a_bay_is_left_by_its_mouth() -> None:
    airspace = Airspace((U_SHAPE,))
    assert distance(airspace, (0.0, 50.0), (0.0, 400.0)) == 350.0
    expected = math.hypot(100, 150) + 100 + math.hypot(200, 200)  # by both corners of the wall
    assert distance(airspace, (0.0, 50.0), (400.0, 0.0)) == pytest.approx(expected)


def test_a_bay_is_passed_without_entering_it() -> None:
    # Below the base, 100 m down and up; over the mouth it would be 200 m up and down.
    expected = 2 * math.hypot(100, 100) + 400
    assert distance(Airspace((U_SHAPE,)), (-300.0, 0.0), (300.0, 0.0)) == pytest.approx(expected)


def test_an_enclosed_yard_is_unreachable_but_free_inside() -> None:
    walls = tuple(
        ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
        for x0, y0, x1, y1 in ((-200.0, -200.0, 200.0, -100.0), (-200.0, 100.0, 200.0, 200.0),
                               (-200.0, -200.0, -100.0, 200.0), (100.0, -200.0, 200.0, 200.0)))
    assert distance(Airspace(walls), (0.0, 0.0), (50.0, 0.0)) == 50.0
    assert distance(Airspace(walls), (0.0, 0.0), (500.0, 0.0)) == math.inf


def test_two_areas_in_a_row_are_passed_on_one_side() -> None:
    airspace = Airspace((SQUARE, moved(SQUARE, 500.0, 0.0)))
    expected = 2 * math.hypot(100, 100) + 700
    assert distance(airspace, (-200.0, 0.0), (700.0, 0.0)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ((0.0, 120.0), 15.0),  # crosswind 6 m/s against 10 m/s leaves 8 m/s
        ((0.0, -120.0), 15.0),
        ((160.0, 0.0), 10.0),  # tailwind: 16 m/s
        ((-160.0, 0.0), 40.0),  # headwind: 4 m/s
    ],
)
def test_a_west_wind_of_6_against_10_follows_the_wind_triangle(
    target: tuple[float, float], expected: float
) -> None:
    airspace = Airspace((), wind_speed_kmh=21.6, wind_direction_deg=270.0)
    assert duration(airspace, (0.0, 0.0), target) == pytest.approx(expected)


def test_a_north_wind_blows_south() -> None:
    airspace = Airspace((), wind_speed_kmh=18.0, wind_direction_deg=0.0)
    assert duration(airspace, (0.0, 0.0), (0.0, -150.0)) == pytest.approx(10.0)
    assert duration(airspace, (0.0, 0.0), (0.0, 150.0)) == pytest.approx(30.0)


def test_no_flight_against_wind_stronger_than_the_drone() -> None:
    airspace = Airspace((), wind_speed_kmh=54.0, wind_direction_deg=270.0)
    assert duration(airspace, (0.0, 0.0), (-100.0, 0.0)) == math.inf
    assert duration(airspace, (0.0, 0.0), (0.0, 100.0)) == math.inf
    assert duration(airspace, (0.0, 0.0), (100.0, 0.0)) == pytest.approx(4.0)
    assert duration(airspace, (0.0, 0.0), (0.0, 0.0)) == 0.0


def test_wind_applies_to_each_part_of_a_detour() -> None:
    airspace = Airspace((SQUARE,), wind_speed_kmh=21.6, wind_direction_deg=270.0)
    legs = flight_legs(np.array([(-200.0, 0.0), (200.0, 0.0)]), airspace, SPEED)
    slant = math.hypot(100, 100)
    along = 6 / math.sqrt(2)  # m/s of wind along and across a slanted part
    with_wind = math.sqrt(100 - along**2) + along
    against_wind = math.sqrt(100 - along**2) - along
    assert legs.duration[0, 1] == pytest.approx(2 * slant / with_wind + 200 / 16)
    assert legs.duration[1, 0] == pytest.approx(2 * slant / against_wind + 200 / 4)
    assert legs.distance[0, 1] == pytest.approx(2 * slant + 200)


def test_great_circles_replace_straight_lines_but_not_detours() -> None:
    lon_lat = np.array([(10.0, 50.0), (10.02, 50.0), (10.0, 50.01)])
    corners = np.array([(10.009, 49.999), (10.011, 49.999), (10.011, 50.002), (10.009, 50.002)])
    projection = LocalProjection.around(lon_lat)
    ring: Ring = tuple((float(x), float(y)) for x, y in projection.project(corners))
    straight = great_circle_distances(lon_lat)
    legs = flight_legs(projection.project(lon_lat), Airspace((ring,)), SPEED, straight)
    assert legs.distance[0, 2] == straight[0, 2]
    assert straight[0, 1] * 1.005 < legs.distance[0, 1] < straight[0, 1] * 1.03
    assert np.array_equal(projection.project(lon_lat), local_coordinates(lon_lat))


@pytest.mark.parametrize(
    ("ring", "reason"),
    [
        (SQUARE, None),
        (U_SHAPE, None),
        ((*SQUARE, SQUARE[0]), None),
        ((), "3 distinct"),
        (((0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (1.0, 0.0)), "3 distinct"),
        (((0.0, 0.0), (1.0, 1.0), (2.0, 2.0)), "no area"),
        (((0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)), "itself"),
        (((0.0, 0.0), (1.0, 0.0), (math.nan, 1.0)), "finite"),
        (((0.0, 0.0), (1.0, 0.0), (math.inf, 1.0)), "finite"),
    ],
)
def test_bad_polygons_are_named(ring: Ring, reason: str | None) -> None:
    found = invalid_polygon_reason(ring)
    assert (found is None) if reason is None else (found is not None and reason in found)


@pytest.mark.parametrize(
    ("field", "airspace"),
    [
        (r"no_fly\[1\]", {"no_fly": (SQUARE, SQUARE[:2])}),
        ("wind_speed_kmh", {"wind_speed_kmh": -1.0}),
        ("wind_direction_deg", {"wind_direction_deg": math.nan}),
    ],
)
def test_bad_airspaces_are_refused(field: str, airspace: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=field):
        Airspace(**airspace)


@pytest.mark.parametrize("airspeed", [0.0, -1.0, math.nan, math.inf])
def test_bad_airspeeds_are_refused(airspeed: float) -> None:
    with pytest.raises(ValueError, match="airspeed_kmh"):
        flight_legs(np.zeros((1, 2)), Airspace(), airspeed)


@given(POINTS)
@settings(max_examples=40, deadline=None)
def test_detours_are_symmetric_and_obey_the_triangle_inequality(
    points: list[tuple[float, float]],
) -> None:
    airspace = Airspace((SQUARE, moved(U_SHAPE, 150.0, 120.0)))
    free = flight_legs(np.array(points), Airspace(), SPEED).distance
    flown = flight_legs(np.array(points), airspace, SPEED).distance
    assert (flown >= free - 1e-9).all()
    assert flown == pytest.approx(flown.T)
    shortest = (flown[:, :, None] + flown[None]).min(axis=1)
    assert (flown <= shortest + 0.1).all()


@given(POINTS, WIND)
@settings(max_examples=40, deadline=None)
def test_flights_in_wind_obey_the_triangle_inequality(
    points: list[tuple[float, float]], wind: tuple[float, float]
) -> None:
    legs = flight_legs(np.array(points), Airspace((SQUARE,), *wind), SPEED)
    quickest = (legs.duration[:, :, None] + legs.duration[None]).min(axis=1)
    assert (legs.duration <= quickest * (1 + 1e-3) + 1e-3).all()
