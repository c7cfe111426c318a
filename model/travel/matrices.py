"""From locations, or a caller's matrices, to the integer travel matrices of `Problem`."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from pyproj import Proj

from model.engine.pausing import Pause, go_on, matrix_blocks
from model.problem import (
    FULL_SPEED, MAX_QUANTITY, UNREACHABLE, FloatArray, IntArray, Points, SpeedProfile, Travel,
)
from model.problem.distances import EARTH_RADIUS_M, MS_PER_M_AT_1_KMH, ceiled_ms, rounded_mm
from model.problem.narrow import NarrowMatrix, narrowed

_EMBEDDING_RANK = 10
_EMBEDDING_ITERATIONS = 12


@dataclass(frozen=True)
class LocalProjection:
    """Azimuthal equidistant projection of the sphere: x east and y north at its centre, metres.

    True in length and direction from the centre, and off by about the square of (distance from
    the centre / earth radius) elsewhere: a few hundredths of a percent within 100 km. It never
    shortens a distance. It has no seam but at the centre's antipode.
    """

    longitude: float  # of the centre, degrees
    latitude: float

    @classmethod
    def around(cls, lon_lat: FloatArray) -> "LocalProjection":
        """Centre a projection on (node, 2) points in degrees, wherever on the globe they are."""
        _require_lon_lat(lon_lat)
        longitude, latitude = np.radians(lon_lat).T
        x, y, z = (
            float((np.cos(latitude) * np.cos(longitude)).mean()),
            float((np.cos(latitude) * np.sin(longitude)).mean()),
            float(np.sin(latitude).mean()),
        )
        return cls(float(np.degrees(np.arctan2(y, x))),
                   float(np.degrees(np.arctan2(z, np.hypot(x, y)))))

    def project(self, lon_lat: FloatArray) -> FloatArray:
        """Map (point, 2) degrees to (point, 2) metres east and north of the centre."""
        _require_lon_lat(lon_lat)
        x, y = self._proj(lon_lat[:, 0], lon_lat[:, 1])
        points = np.stack([x, y], axis=1)
        # The antipode has every direction; it is drawn due north.
        points[~np.isfinite(points).all(axis=1)] = (0.0, np.pi * EARTH_RADIUS_M)
        return points

    def unproject(self, points_m: FloatArray) -> FloatArray:
        """Map (point, 2) metres east and north of the centre to degrees."""
        longitude, latitude = self._proj(points_m[:, 0], points_m[:, 1], inverse=True)
        return np.stack([longitude, latitude], axis=1)

    @property
    def _proj(self) -> Proj:
        return Proj(proj="aeqd", lon_0=self.longitude, lat_0=self.latitude, R=EARTH_RADIUS_M)


def local_coordinates(lon_lat: FloatArray) -> FloatArray:
    """Project (node, 2) longitudes and latitudes to metres around their centroid."""
    return LocalProjection.around(lon_lat).project(lon_lat)


def planar_distances(points_m: FloatArray, pause: Pause = go_on) -> FloatArray:
    """Return the (node, node) straight-line distances in metres."""
    return straight_distances(Points(points_m), pause)


def great_circle_distances(lon_lat: FloatArray, pause: Pause = go_on) -> FloatArray:
    """Return the (node, node) distances in metres on the sphere."""
    return straight_distances(points_of(lon_lat), pause)


def straight_distances(points: Points, pause: Pause = go_on) -> FloatArray:
    """Return the (node, node) distances in metres."""
    distances = np.empty((len(points), len(points)))
    everywhere = np.arange(len(points))
    for rows in matrix_blocks(len(distances), pause):
        distances[rows] = points.distances(everywhere[rows, None], everywhere)
    return distances


def points_of(lon_lat: FloatArray) -> Points:
    """Return where (node, 2) longitudes and latitudes in degrees are.

    Raises
    ------
    ValueError
        If these are none.
    """
    _require_lon_lat(lon_lat)
    return Points.geographic(lon_lat)


def truck_travel(distances_m: FloatArray, speed_kmh: float, pause: Pause = go_on) -> Travel:
    """Drive the distances at one speed (the fastest, where a speed profile applies)."""
    _require_speed(speed_kmh)
    _require_lengths("distances", distances_m, pause)
    pace = MS_PER_M_AT_1_KMH / speed_kmh
    return Travel(
        _whole(distances_m, lambda rows: ceiled_ms(rows * pace), pause),
        _whole(distances_m, rounded_mm, pause))


def matrix_travel(durations_s: FloatArray, distances_m: FloatArray,
                  pause: Pause = go_on) -> Travel:
    """Take a caller's matrices, which need not be symmetric."""
    _require_lengths("durations", durations_s, pause)
    _require_lengths("distances", distances_m, pause)
    return Travel(_whole(durations_s, lambda rows: ceiled_ms(rows * 1000.0), pause),
                  _whole(distances_m, rounded_mm, pause))


def matrix_legs(durations_s: FloatArray, distances_m: FloatArray) -> tuple[IntArray, IntArray]:
    """Return some legs as `matrix_travel` has them, in any shape."""
    return (ceiled_ms(durations_s * 1000.0).astype(np.int64),
            rounded_mm(distances_m).astype(np.int64))


def with_nowhere(travel: Travel, node: int, flown: bool) -> Travel:
    """Return legs with one more node, nowhere: none leads there if `flown`, else none takes time.
    """
    leg = UNREACHABLE if flown else 0

    def larger(matrix: IntArray) -> IntArray:
        size = len(matrix) + 1
        legs = np.full((size, size), leg, np.int64)
        before, behind = slice(None, node), slice(node + 1, None)
        legs[before, before], legs[before, behind] = matrix[:node, :node], matrix[:node, node:]
        legs[behind, before], legs[behind, behind] = matrix[node:, :node], matrix[node:, node:]
        legs[node, node] = 0
        return legs

    duration, distance = travel.arrays()
    return Travel(larger(duration), larger(distance))


def flight_travel(distances_m: FloatArray, durations_s: FloatArray,
                  pause: Pause = go_on) -> Travel:
    """Take the legs of a drone: infinite, or longer than any plan, means no flight.

    Raises
    ------
    ValueError
        If an entry is negative or not a number.
    """
    duration = np.empty(durations_s.shape, np.int64)
    distance = np.empty(distances_m.shape, np.int64)
    for rows in matrix_blocks(len(duration), pause):
        seconds, metres = durations_s[rows], distances_m[rows]
        for name, lengths in (("distances", metres), ("durations", seconds)):
            if not lengths.min(initial=0.0) >= 0:
                raise ValueError(f"{name}: every entry must be a number and not negative")
        reachable = (metres * 1000.0 <= MAX_QUANTITY) & (seconds * 1000.0 <= MAX_QUANTITY)
        if reachable.all():
            duration[rows], distance[rows] = ceiled_ms(seconds * 1000.0), rounded_mm(metres)
            continue
        duration[rows] = ceiled_ms(np.where(reachable, seconds, 0.0) * 1000.0)
        distance[rows] = rounded_mm(np.where(reachable, metres, 0.0))
        duration[rows][~reachable] = UNREACHABLE
        distance[rows][~reachable] = UNREACHABLE
    return Travel(duration, distance)


def longer_legs(travel: Travel, more: int) -> Travel:
    """Return legs that take so many ms more, but for who stays."""
    shorter, distance = travel.arrays()
    duration = np.where(shorter < UNREACHABLE, shorter + more, UNREACHABLE)
    duration[duration > MAX_QUANTITY] = UNREACHABLE
    np.fill_diagonal(duration, np.diagonal(shorter))
    distance = np.where(duration < UNREACHABLE, distance, UNREACHABLE)
    return Travel(duration, distance)


def speed_profile(
    base_speed: float, changes: Sequence[tuple[int, float]]
) -> tuple[float, SpeedProfile]:
    """Express speeds by time of day as shares of the fastest one.

    A `SpeedProfile` only slows down, so matrix durations must be those at the fastest speed:
    `truck_travel(distances, fastest)`, or, with speeds that are factors on a caller's matrix,
    `matrix_travel(durations / fastest, distances)`.

    Parameters
    ----------
    base_speed
        Speed before the first change, in any unit.
    changes
        (time in ms, speed from then on), by increasing time.

    Returns
    -------
    The fastest speed, in the unit given, and the profile, its factors rounded to the nearest
    millionth.
    """
    speeds = (base_speed, *(speed for _, speed in changes))
    for speed in speeds:
        _require_speed(speed)
    fastest = max(speeds)
    factors = tuple(round(speed / fastest * FULL_SPEED) for speed in speeds)
    return fastest, SpeedProfile(tuple(time for time, _ in changes), factors)


def embed(duration: IntArray | FloatArray) -> FloatArray:
    """Place nodes in the plane so that distances resemble a matrix of finite durations.

    Classical scaling of the symmetrised matrix, the leading eigenvectors found by subspace
    iteration from a fixed start: the same matrix always gives the same (node, 2) coordinates, in
    the unit of the durations and centred on the origin.

    References
    ----------
    Torgerson (1952), multidimensional scaling, Psychometrika 17:401-419. Halko, Martinsson and
    Tropp (2011), finding structure with randomness, SIAM Review 53:217-288.
    """
    num_nodes = len(duration)
    symmetric = (duration + duration.T) / 2.0
    np.fill_diagonal(symmetric, 0.0)
    scale = symmetric.max(initial=0.0)
    if scale == 0.0:
        return np.zeros((num_nodes, 2))
    squared = (symmetric / scale) ** 2
    mean = squared.mean(axis=0)
    gram = (mean + mean[:, None] - squared - mean.mean()) / 2.0
    start = np.random.default_rng(0).standard_normal((num_nodes, min(num_nodes, _EMBEDDING_RANK)))
    basis = np.linalg.qr(start).Q
    for _ in range(_EMBEDDING_ITERATIONS):
        basis = np.linalg.qr(gram @ basis).Q
    eigenvalues, vectors = np.linalg.eigh(basis.T @ gram @ basis)
    axes = basis @ vectors[:, :-3:-1]
    axes *= np.sign(axes[np.abs(axes).argmax(axis=0), (0, 1)])
    coordinates: FloatArray = axes * np.sqrt(np.maximum(eigenvalues[:-3:-1], 0.0)) * scale
    return coordinates


def _whole(matrix: FloatArray, rounded: Callable[[FloatArray], FloatArray],
           pause: Pause) -> IntArray | NarrowMatrix:
    """Return what `rounded` makes of a matrix, row block by row block."""
    result = np.empty(matrix.shape, np.int64)
    for rows in matrix_blocks(len(matrix), pause):
        result[rows] = rounded(matrix[rows])
    return narrowed(result)


def _require_speed(speed: float) -> None:
    if not 0 < speed < float("inf"):
        raise ValueError(f"speed: {speed!r} is not allowed")


def _require_lengths(name: str, matrix: FloatArray, pause: Pause) -> None:
    for rows in matrix_blocks(len(matrix), pause):
        lengths = matrix[rows]
        if not (lengths.min(initial=0.0) >= 0 and lengths.max(initial=0.0) < np.inf):
            raise ValueError(f"{name}: every entry must be finite and not negative")


def _require_lon_lat(lon_lat: FloatArray) -> None:
    if not np.isfinite(lon_lat).all() or np.abs(lon_lat[:, 1]).max(initial=0.0) > 90:
        raise ValueError("locations: longitude and latitude must be finite, latitude in -90..90")
