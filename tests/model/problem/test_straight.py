"""Legs that are computed are those of a matrix, one by one and all at once."""

import math
from dataclasses import replace

import numpy as np
import pytest

from model.problem import UNREACHABLE, FloatArray, Points, StraightLegs, Travel
from model.problem.distances import (
    DIMACS, EARTH_RADIUS_M, EXACT, ROUND, THOUSANDTHS, TRUNC, ceiled_ms, rounded_as,
)
from model.travel.matrices import (
    longer_legs, planar_distances, straight_distances, truck_travel, with_nowhere,
)

COUNT = 40


def nasty(rng: np.random.Generator) -> FloatArray:
    """Return places of any scale, whole or not, some of them the same."""
    places = rng.normal(size=(COUNT, 2)) * 10.0 ** rng.uniform(-3, 6)
    places[:5] = places[5:10]
    return np.rint(places) if rng.random() < 0.5 else places


def on_globe(rng: np.random.Generator) -> FloatArray:
    """Return places all over the globe: poles, antipodes and nearly so, both sides of the seam."""
    places = np.stack([rng.uniform(-180, 180, COUNT), rng.uniform(-90, 90, COUNT)], axis=1)
    if rng.random() < 0.5:
        places = places[0] * 0.9 + places / 10.0 ** rng.uniform(1, 6)
    places[:5] = (0, 90), (77, 90), (20, -90), (180, 0), (-180, 0)
    places[5] = places[6] + (180, 0)
    places[5, 1] *= -1
    places[7] = places[5] + (1e-7, 1e-8)
    return places


@pytest.mark.parametrize("rounding", [EXACT, ROUND, TRUNC, DIMACS, THOUSANDTHS])
def test_computed_legs_in_a_plane_are_those_of_matrices(rounding: int) -> None:
    rng = np.random.default_rng(rounding)
    for _ in range(20):
        points = Points(nasty(rng), 10.0 ** rng.uniform(-1, 1), rounding)
        speed = 10.0 ** rng.uniform(0, 2)
        assert_same(points, speed)
        straight = planar_distances(points.at)
        assert np.array_equal(straight_distances(points),
                              rounded_as(straight, rounding) * points.metres)


def test_computed_legs_on_the_globe_are_those_of_matrices() -> None:
    rng = np.random.default_rng(0)
    for _ in range(20):
        assert_same(Points.geographic(on_globe(rng)), 10.0 ** rng.uniform(0, 2))


def assert_same(points: Points, speed: float) -> None:
    """Compare all ways to look legs up with a matrix of them."""
    stated = truck_travel(straight_distances(points), speed)
    computed = Travel.along(StraightLegs(points, speed))
    nodes = np.array([3, 0, 7])
    for matrix, legs in ((stated.duration, computed.duration),
                         (stated.distance, computed.distance)):
        assert legs.shape == matrix.shape
        for key in (slice(None), 3, slice(2, 9), (3, slice(4, None)), (slice(None), 5),
                    (slice(4, 9), slice(3, 6)), (nodes, nodes[::-1]), (nodes[:, None], nodes),
                    (slice(2, 5), nodes), (nodes, slice(2, 5))):
            assert np.array_equal(legs[key], matrix[key]), key
        assert [[legs.item(origin, to) for to in range(COUNT)] for origin in range(9)] == (
            matrix[:9].tolist())
    assert np.array_equal(computed.among(nodes).duration[:], stated.among(nodes).duration)
    longest = computed.longest()
    assert stated.duration[:].max() <= longest[0]
    assert stated.distance[:].max() <= longest[1]


def test_great_circles_are_those_of_the_haversine_formula() -> None:
    rng = np.random.default_rng(1)
    for _ in range(20):
        places = on_globe(rng)
        longitude, latitude = np.radians(places).T
        haversine = (np.sin((latitude[:, None] - latitude) / 2) ** 2
                     + np.cos(latitude[:, None]) * np.cos(latitude)
                     * np.sin((longitude[:, None] - longitude) / 2) ** 2)
        usual = 2 * EARTH_RADIUS_M * np.arcsin(np.sqrt(np.minimum(haversine, 1.0)))
        # Near antipodes that formula is off by centimetres.
        known = usual < 19e6
        apart = np.abs(straight_distances(Points.geographic(places)) - usual)
        assert apart[known].max() < 1e-4


def test_antipodes_are_half_a_circle_apart() -> None:
    points = Points.geographic(np.array([[12.0, 34.0], [-168.0, -34.0], [-168.0, -34.00001]]))
    distances = straight_distances(points)
    assert distances[0, 1] == pytest.approx(math.pi * EARTH_RADIUS_M, abs=1e-6)
    assert distances[0, 1] - distances[0, 2] == pytest.approx(distances[1, 2], abs=1e-6)


def test_what_takes_longer_and_leads_nowhere_does_so_in_both() -> None:
    places = np.array([[0.0, 0.0], [3000.0, 4000.0], [0.0, 0.0], [1.0, 1.0]])
    stated = longer_legs(truck_travel(planar_distances(places), 36.0), 5000)
    for flown, nowhere in ((True, UNREACHABLE), (False, 0)):
        matrix = with_nowhere(stated, 1, flown)
        at = np.insert(places, 1, np.nan, axis=0)
        legs = Travel.along(StraightLegs(Points(at), 36.0, 5000, nowhere))
        assert np.array_equal(legs.duration[:], matrix.duration)
        assert np.array_equal(legs.distance[:], matrix.distance)
        assert legs.duration.item(1, 2) == nowhere
        assert legs.duration.item(1, 1) == 0
        assert legs.reaches_all() is not flown


def test_long_durations_are_rounded_alike_beside_short_ones() -> None:
    durations = np.array([1.0 + 4e-7, 2.0**31 + 2.0**-21, 2.0**35 + 2.0**-17])
    assert ceiled_ms(durations).tolist() == [float(ceiled_ms(durations[[index]])[0])
                                             for index in range(3)]


@pytest.mark.parametrize(("changed", "message"), [
    ({"speed_kmh": 0.0}, "speed"), ({"speed_kmh": 1e-9}, "too large"), ({"nowhere": 5}, "nowhere"),
])
def test_legs_that_no_problem_may_state_are_refused(
        changed: dict[str, float], message: str) -> None:
    legs = StraightLegs(Points(np.array([[0.0, 0.0], [1e5, 0.0]])), 50.0)
    with pytest.raises(ValueError, match=message):
        replace(legs, **changed)
