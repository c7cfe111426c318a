"""Distances from coordinates, and how legs are rounded, of many legs and of one.

Distances are rounded to the nearest millimetre and durations up to the next millisecond, both
once, from the exact float values. The engine computes the same in `engine/rules/leg.cpp`, to
the last bit: the same operations in the same order, of which each is rounded by itself.
`docs/develop/search.md` says more under "Legs by computation".
"""

import math
from collections.abc import Callable

import numpy as np

from model.problem.quantities import FloatArray, IntArray

EARTH_RADIUS_M = 6_371_008.8
"""Mean radius of the earth, which is taken for a sphere."""

EXACT, ROUND, TRUNC, DIMACS, THOUSANDTHS = range(5)
"""Ways to round straight distances, in the unit of coordinates."""

FLOAT_NOISE_MS = 5e-7
"""A duration less than this above a whole millisecond is that millisecond."""

COARSE_MS = 2.0**31
"""Durations below this are told apart more finely than by `FLOAT_NOISE_MS` halved."""

MM_PER_M, MS_PER_M_AT_1_KMH = 1000.0, 3600.0

SHORT_ARC, LONG_ARC = 1 / 64, 0.5
"""Squared halves of chords: up to where few terms tell the arc, and up to where it is told from the
chord to one end, not to the other's antipode."""

SHORT_TERMS, LONG_TERMS = 8, 44


def _arcsine_series(terms: int) -> tuple[float, ...]:
    """Return the coefficients of arcsin(s) / s in powers of s squared, the highest first."""
    return tuple(math.comb(2 * k, k) / (4**k * (2 * k + 1)) for k in reversed(range(terms)))


SHORT_SERIES, LONG_SERIES = _arcsine_series(SHORT_TERMS), _arcsine_series(LONG_TERMS)


def units_between(points: FloatArray, origin: IntArray, to: IntArray) -> FloatArray:
    """Return straight distances between (point, 2) places, in their unit.

    Never by `hypot`, which rounds otherwise.
    """
    east, north = (points[origin, axis] - points[to, axis] for axis in range(2))
    distances: FloatArray = np.sqrt(east * east + north * north)
    return distances


def angles_between(points: FloatArray, origin: IntArray, to: IntArray) -> FloatArray:
    """Return angles between (point, 3) unit vectors in radians, exact for any two.

    By the chord between both; from a right angle on by that to the other's antipode, of which the
    angle is what lacks to half a circle.
    """
    quarter = _quarter(*(points[origin, axis] - points[to, axis] for axis in range(3)))
    angles = _arc(quarter)
    far = quarter > LONG_ARC
    if far.any():
        beyond = _quarter(*(points[origin, axis] + points[to, axis] for axis in range(3)))
        angles = np.where(far, math.pi - _arc(beyond), angles)
    return angles


def _quarter(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    """Return the squares of halves of chords."""
    return (x * x + y * y + z * z) * 0.25


def _arc(quarter: FloatArray) -> FloatArray:
    """Return the angles over chords, by the squares of their halves, up to `LONG_ARC`."""
    half = np.sqrt(quarter)
    arc = 2.0 * half * _series(SHORT_SERIES, quarter)
    long = quarter > SHORT_ARC
    if long.any():
        arc = np.where(long, 2.0 * half * _series(LONG_SERIES, np.minimum(quarter, LONG_ARC)), arc)
    return arc


def _series(coefficients: tuple[float, ...], square: FloatArray) -> FloatArray:
    value = np.zeros_like(square)
    for coefficient in coefficients:
        value = value * square + coefficient
    return value


def unit_vectors(lon_lat: FloatArray) -> FloatArray:
    """Return the (point, 3) directions from the earth's centre of longitudes and latitudes."""
    longitude, latitude = np.radians(lon_lat).T
    cosine = np.cos(latitude)
    return np.stack([cosine * np.cos(longitude), cosine * np.sin(longitude), np.sin(latitude)],
                    axis=1)


def rounded_as(distances: FloatArray, rounding: int) -> FloatArray:
    """Return what distances become, in their unit."""
    return _ROUNDINGS[rounding](distances)


def _rounded(distances: FloatArray) -> FloatArray:
    """Round to the nearest integer, halves up."""
    return np.floor(distances + 0.5)


_ROUNDINGS: tuple[Callable[[FloatArray], FloatArray], ...] = (
    lambda distances: distances,
    _rounded,
    np.trunc,
    lambda distances: np.trunc(distances * 10) / 10,
    lambda distances: _rounded(distances * 1000) / 1000,
)


def ceiled_ms(duration_ms: FloatArray) -> FloatArray:
    """Return durations in whole milliseconds, rounded up."""
    noise: FloatArray | float = FLOAT_NOISE_MS
    if duration_ms.max(initial=0.0) >= COARSE_MS:
        noise = np.maximum(FLOAT_NOISE_MS, 2 * np.spacing(duration_ms))
    whole: FloatArray = np.ceil(duration_ms - noise)
    return whole


def rounded_mm(distance_m: FloatArray) -> FloatArray:
    """Return distances in whole millimetres."""
    rounded: FloatArray = np.rint(distance_m * MM_PER_M)
    return rounded


def units_between_two(points: FloatArray, origin: int, to: int) -> float:
    """Return one distance as `units_between` does."""
    east, north = (points.item(origin, axis) - points.item(to, axis) for axis in range(2))
    return math.sqrt(east * east + north * north)


def angle_between_two(points: FloatArray, origin: int, to: int) -> float:
    """Return one angle as `angles_between` does."""
    one, other = ([points.item(node, axis) for axis in range(3)] for node in (origin, to))
    x, y, z = one[0] - other[0], one[1] - other[1], one[2] - other[2]
    quarter = (x * x + y * y + z * z) * 0.25
    if quarter <= LONG_ARC:
        return _arc_over(quarter)
    x, y, z = one[0] + other[0], one[1] + other[1], one[2] + other[2]
    return math.pi - _arc_over(min((x * x + y * y + z * z) * 0.25, LONG_ARC))


def _arc_over(quarter: float) -> float:
    value = 0.0
    for coefficient in SHORT_SERIES if quarter <= SHORT_ARC else LONG_SERIES:
        value = value * quarter + coefficient
    return 2.0 * math.sqrt(quarter) * value


def one_rounded_as(distance: float, rounding: int) -> float:
    """Return what a distance becomes, as `rounded_as` does."""
    return _ROUND_ONE[rounding](distance)


_ROUND_ONE: tuple[Callable[[float], float], ...] = (
    lambda distance: distance,
    lambda distance: math.floor(distance + 0.5),
    math.trunc,
    lambda distance: math.trunc(distance * 10) / 10,
    lambda distance: math.floor(distance * 1000 + 0.5) / 1000,
)


def one_ceiled_ms(duration_ms: float) -> int:
    """Return a duration as `ceiled_ms` does."""
    noise = FLOAT_NOISE_MS
    if duration_ms >= COARSE_MS:
        noise = max(noise, 2 * math.ulp(duration_ms))
    return math.ceil(duration_ms - noise)


def one_rounded_mm(distance_m: float) -> int:
    """Return a distance as `rounded_mm` does."""
    return round(distance_m * MM_PER_M)
