"""Travel matrices, by numbers worked out by hand."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from model.engine import pausing
from model.problem import FULL_SPEED, MAX_QUANTITY, UNREACHABLE, SpeedProfile
from model.problem.distances import EARTH_RADIUS_M
from model.travel.matrices import (
    LocalProjection,
    embed,
    flight_travel,
    great_circle_distances,
    local_coordinates,
    matrix_travel,
    planar_distances,
    speed_profile,
    truck_travel,
)

LONGITUDE = st.floats(-180, 180)
LATITUDE = st.floats(-90, 90)
LOCATIONS = st.lists(st.tuples(LONGITUDE, LATITUDE), min_size=1, max_size=6)


def legs(value: float) -> np.ndarray:
    return np.array([[0.0, value], [value, 0.0]])


def test_planar_distance_of_a_3_4_5_triangle_is_exact() -> None:
    assert planar_distances(np.array([[0.0, 0.0], [3.0, 4.0]])).tolist() == [[0, 5], [5, 0]]


def test_great_circle_from_equator_to_pole_is_a_quarter_meridian() -> None:
    distances = great_circle_distances(np.array([[20.0, 0.0], [-70.0, 90.0]]))
    assert distances[0, 1] == pytest.approx(EARTH_RADIUS_M * np.pi / 2, rel=1e-12)
    assert distances[0, 1] == pytest.approx(10_007_557.2, abs=0.1)


def test_great_circle_between_antipodes_is_half_the_globe() -> None:
    distances = great_circle_distances(np.array([[0.0, 0.0], [180.0, 0.0]]))
    assert distances[0, 1] == pytest.approx(EARTH_RADIUS_M * np.pi, rel=1e-12)


def test_great_circle_crosses_the_antimeridian_the_short_way() -> None:
    distances = great_circle_distances(np.array([[179.5, 0.0], [-179.5, 0.0]]))
    assert distances[0, 1] == pytest.approx(EARTH_RADIUS_M * np.radians(1.0), rel=1e-9)


@pytest.mark.parametrize("location", [[0.0, 90.5], [np.nan, 0.0], [0.0, np.inf]])
def test_impossible_locations_are_refused(location: list[float]) -> None:
    with pytest.raises(ValueError, match="locations"):
        great_circle_distances(np.array([location]))
    with pytest.raises(ValueError, match="locations"):
        local_coordinates(np.array([location]))


def test_local_coordinates_point_east_and_north() -> None:
    points = local_coordinates(np.array([[9.9, 50.0], [10.1, 50.0], [10.0, 49.9], [10.0, 50.1]]))
    west, east, south, north = points
    assert east[0] > 7000
    assert west[0] < -7000
    assert north[1] - south[1] == pytest.approx(EARTH_RADIUS_M * np.radians(0.2), rel=1e-6)


def test_local_coordinates_survive_the_antimeridian() -> None:
    points = local_coordinates(np.array([[179.9, 10.0], [-179.9, 10.0]]))
    assert planar_distances(points)[0, 1] == pytest.approx(21_901, abs=5)


def test_local_coordinates_of_one_point_are_the_origin() -> None:
    assert local_coordinates(np.array([[13.4, 52.5]])) == pytest.approx(np.zeros((1, 2)), abs=1e-6)


def test_the_antipode_of_the_centre_is_drawn_due_north() -> None:
    point = LocalProjection(0.0, 0.0).project(np.array([[180.0, 0.0]]))
    assert point == pytest.approx(np.array([[0.0, np.pi * EARTH_RADIUS_M]]))


@given(LOCATIONS)
@settings(max_examples=50, deadline=None)
def test_projection_is_finite_and_never_shortens(locations: list[tuple[float, float]]) -> None:
    lon_lat = np.array(locations)
    points = local_coordinates(lon_lat)
    assert np.isfinite(points).all()
    assert (planar_distances(points) >= great_circle_distances(lon_lat) - 1.0).all()


def test_truck_durations_round_up_and_distances_to_the_nearest() -> None:
    travel = truck_travel(legs(0.0124), 36.0)  # 10 m/s: 1.24 ms
    assert travel.duration[:].tolist() == [[0, 2], [2, 0]]
    assert travel.distance[:].tolist() == [[0, 12], [12, 0]]


def test_float_noise_adds_no_millisecond() -> None:
    assert 0.1 * 3 > 0.3
    assert truck_travel(legs(0.1 * 3), 36.0).duration[0, 1] == 30
    assert matrix_travel(legs(0.1 * 3), legs(0.0)).duration[0, 1] == 300


def test_a_tiny_but_real_excess_adds_a_millisecond() -> None:
    assert matrix_travel(legs(1.000001), legs(0.0)).duration[0, 1] == 1001


@given(st.integers(0, MAX_QUANTITY))
@example(17_115_898_019)  # a float's next neighbour, times 1000, is more than noise away
@settings(max_examples=50, deadline=None)
def test_whole_milliseconds_stay_as_they_are(milliseconds: int) -> None:
    assert matrix_travel(legs(milliseconds / 1000), legs(0.0)).duration[0, 1] == milliseconds


def test_asymmetric_matrices_are_kept() -> None:
    travel = matrix_travel(np.array([[0.0, 1.0], [2.0, 0.0]]), np.array([[0.0, 3.0], [4.0, 0.0]]))
    assert travel.duration[:].tolist() == [[0, 1000], [2000, 0]]
    assert travel.distance[:].tolist() == [[0, 3000], [4000, 0]]


@pytest.mark.parametrize("value", [np.inf, np.nan, -1.0])
def test_bad_matrix_entries_are_refused(value: float) -> None:
    with pytest.raises(ValueError, match="durations"):
        matrix_travel(legs(value), legs(0.0))
    with pytest.raises(ValueError, match="distances"):
        truck_travel(legs(value), 36.0)


@pytest.mark.parametrize("speed", [0.0, -1.0, np.inf, np.nan])
def test_bad_speeds_are_refused(speed: float) -> None:
    with pytest.raises(ValueError, match="speed"):
        truck_travel(legs(1.0), speed)
    with pytest.raises(ValueError, match="speed"):
        speed_profile(1.0, [(0, speed)])


def test_infinite_flights_are_unreachable_both_ways_of_saying_it() -> None:
    travel = flight_travel(np.array([[0.0, np.inf], [5.0, 0.0]]),
                           np.array([[0.0, 1.0], [np.inf, 0.0]]))
    expected = [[0, UNREACHABLE], [UNREACHABLE, 0]]
    assert travel.duration[:].tolist() == expected
    assert travel.distance[:].tolist() == expected


def test_flights_that_never_arrive_are_unreachable() -> None:
    travel = flight_travel(legs(5.0), legs(1e12))
    assert travel.duration[0, 1] == UNREACHABLE


@pytest.mark.parametrize("value", [np.nan, -1.0, -np.inf])
def test_bad_flights_are_refused(value: float) -> None:
    with pytest.raises(ValueError, match="durations"):
        flight_travel(legs(1.0), legs(value))


def test_speed_profile_is_relative_to_the_fastest_speed() -> None:
    fastest, profile = speed_profile(40.0, [(25_200_000, 25.0), (32_400_000, 50.0)])
    assert fastest == 50.0
    assert profile == SpeedProfile((25_200_000, 32_400_000), (800_000, 500_000, FULL_SPEED))


def test_a_constant_speed_is_full_speed() -> None:
    assert speed_profile(40.0, []) == (40.0, SpeedProfile((), (FULL_SPEED,)))


def test_embedding_recovers_planar_distances() -> None:
    distances = planar_distances(np.random.default_rng(3).uniform(0, 1000, (60, 2)))
    coordinates = embed(distances)
    assert planar_distances(coordinates) == pytest.approx(distances, abs=1e-6)
    assert np.array_equal(coordinates, embed(distances))


def test_embedding_averages_the_two_directions() -> None:
    coordinates = embed(np.array([[0, 8], [12, 0]]))
    assert planar_distances(coordinates)[0, 1] == pytest.approx(10.0)


@pytest.mark.parametrize("num_nodes", [0, 1, 2, 3, 20])
def test_embedding_of_equal_places_is_the_origin(num_nodes: int) -> None:
    assert np.array_equal(embed(np.zeros((num_nodes, num_nodes))), np.zeros((num_nodes, 2)))


def test_embedding_does_not_change_its_argument() -> None:
    duration = np.array([[7, 8], [12, 7]])
    embed(duration)
    assert duration.tolist() == [[7, 8], [12, 7]]


@given(st.integers(1, 12), st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_embedding_of_any_matrix_is_finite(num_nodes: int, seed: int) -> None:
    duration = np.random.default_rng(seed).integers(0, 10**9, (num_nodes, num_nodes))
    coordinates = embed(duration)
    assert coordinates.shape == (num_nodes, 2)
    assert np.isfinite(coordinates).all()


def test_matrices_of_many_rows_are_those_of_few(monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.random.default_rng(0).random((20, 2)) * 1e4
    whole = truck_travel(planar_distances(points), 37.0)
    around = great_circle_distances(points / 1e3)
    monkeypatch.setattr(pausing, "ENTRIES_AT_ONCE", 7 * len(points))
    parts = truck_travel(planar_distances(points), 37.0)
    assert np.array_equal(parts.duration, whole.duration)
    assert np.array_equal(parts.distance, whole.distance)
    assert np.array_equal(great_circle_distances(points / 1e3), around)
