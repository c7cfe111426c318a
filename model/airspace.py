"""Where drones may fly and how fast: no-fly areas and wind become flight distances and durations.

Everything is planar, in metres, x east and y north. Geographic problems project locations and
no-fly areas with one `model.travel.LocalProjection`; edges of areas and flights are straight in
that projection, and north is the centre's.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from model.problem import BoolArray, FloatArray, IntArray
from model.travel import planar_distances

Ring = tuple[tuple[float, float], ...]

TOUCH_M = 0.0005
"""How deep a flight may cut into a no-fly area and still count as touching its boundary."""


@dataclass(frozen=True)
class Airspace:
    """What bends or slows flights."""

    no_fly: tuple[Ring, ...] = ()  # corners in metres, closing point optional
    wind_speed_kmh: float = 0.0
    wind_direction_deg: float = 0.0  # blows FROM there, clockwise from north: 270 is a west wind

    def __post_init__(self) -> None:
        for index, ring in enumerate(self.no_fly):
            reason = invalid_polygon_reason(ring)
            if reason is not None:
                raise ValueError(f"no_fly[{index}]: {reason}")
        if not 0 <= self.wind_speed_kmh < float("inf"):
            raise ValueError(f"wind_speed_kmh: {self.wind_speed_kmh!r} is not allowed")
        if not np.isfinite(self.wind_direction_deg):
            raise ValueError(f"wind_direction_deg: {self.wind_direction_deg!r} is not allowed")


class Legs(NamedTuple):
    """Flights from each origin (row) to each target (column), infinite where there is none."""

    distance: FloatArray  # (origin, target) metres
    duration: FloatArray  # (origin, target) seconds


class _Pairs(NamedTuple):
    """Straight segments."""

    start: FloatArray  # (pair, 2)
    end: FloatArray  # (pair, 2)


def invalid_polygon_reason(ring: Sequence[tuple[float, float]]) -> str | None:
    """Say why a ring of corners can't bound a no-fly area, or None if it can.

    Geographic rings are to be judged after projection: one that spans the antimeridian crosses
    itself in degrees but not on the ground.
    """
    corners = np.asarray(ring, dtype=np.float64).reshape(-1, 2)
    if not np.isfinite(corners).all():
        return "a coordinate is not a finite number"
    if len(np.unique(corners, axis=0)) < 3:
        return "a polygon needs at least 3 distinct points"
    polygon = Polygon(corners)
    if polygon.area == 0 and shapely.convex_hull(polygon).area == 0:
        return "the polygon has no area"
    if not polygon.is_valid:
        return "the polygon's boundary crosses or touches itself"
    return None


def flight_legs(
    points_m: FloatArray,
    airspace: Airspace,
    airspeed_kmh: float,
    straight_m: FloatArray | None = None,
) -> Legs:
    """Fly between all points: straight, or by the quickest way around no-fly areas.

    Without wind the quickest way is the shortest. Boundaries may be touched and followed; a point
    inside an area can't be flown to or from, not even from itself. Areas thinner than a
    millimetre don't block, and gaps between areas thinner than that don't let through.

    Parameters
    ----------
    points_m
        (node, 2) planar metres.
    airspace
        No-fly areas and wind, in the same plane.
    airspeed_kmh
        Speed of the drone through the air.
    straight_m
        (node, node) distances of unobstructed flights, if not those in the plane: great circles
        for geographic points. Detours are always measured in the plane.
    """
    if not 0 < airspeed_kmh < float("inf"):
        raise ValueError(f"airspeed_kmh: {airspeed_kmh!r} is not allowed")
    wind = _Wind.of(airspace, airspeed_kmh)
    if straight_m is None:
        straight_m = planar_distances(points_m)
    straight = Legs(straight_m, wind.durations(points_m, points_m, straight_m))
    areas = shapely.union_all([Polygon(ring) for ring in airspace.no_fly])
    parts = _blocking_parts(areas)
    blocked = _blocked_between(points_m, parts)
    if blocked.any():
        around = _detours(points_m, _corners(areas), parts, wind)
        straight = Legs(*(np.where(blocked, detour, direct)
                          for detour, direct in zip(around, straight, strict=True)))
    unflyable = np.isinf(straight.duration)
    return Legs(np.where(unflyable, np.inf, straight.distance), straight.duration)


@dataclass(frozen=True)
class _Wind:
    """The wind triangle for one drone. Speeds in metres per second."""

    airspeed: float
    x: float  # the way the air moves
    y: float

    @classmethod
    def of(cls, airspace: Airspace, airspeed_kmh: float) -> "_Wind":
        speed = airspace.wind_speed_kmh / 3.6
        direction = np.radians(airspace.wind_direction_deg)
        return cls(airspeed_kmh / 3.6, -speed * float(np.sin(direction)),
                   -speed * float(np.cos(direction)))

    def durations(self, starts: FloatArray, ends: FloatArray, lengths: FloatArray) -> FloatArray:
        """Return the (start, end) seconds of straight flights, infinite against too strong a wind.

        The drone heads into the wind so far that the drift across its course cancels.
        """
        if self.x == 0 and self.y == 0:
            return lengths / self.airspeed
        x = ends[:, 0] - starts[:, 0, None]
        y = ends[:, 1] - starts[:, 1, None]
        planar = np.hypot(x, y)
        planar[planar == 0] = 1.0
        across = (self.x * y - self.y * x) / planar
        forward = np.sqrt(np.maximum(self.airspeed**2 - across**2, 0.0))
        ground_speed = (self.x * x + self.y * y) / planar + forward
        flyable = (np.abs(across) < self.airspeed) & (ground_speed > 0)
        ground_speed[~flyable] = 1.0
        durations: FloatArray = np.where(flyable, lengths / ground_speed, np.inf)
        durations[lengths == 0] = 0.0
        return durations


def _blocking_parts(areas: BaseGeometry) -> list[Polygon]:
    """Return what no flight may meet: the areas, a little shrunk, hairline gaps closed.

    Against shrunk areas, flights along an edge or past a corner are clear by a margin, so that no
    rounding of coordinates decides whether they touch or cut.
    """
    closed = areas.buffer(TOUCH_M, join_style="mitre")
    shrunk = closed.buffer(-2 * TOUCH_M, join_style="mitre")
    return _polygons(shrunk)


def _polygons(geometry: BaseGeometry) -> list[Polygon]:
    parts = geometry.geoms if isinstance(geometry, MultiPolygon) else (geometry,)
    return [part for part in parts if isinstance(part, Polygon) and not part.is_empty]


def _corners(areas: BaseGeometry) -> FloatArray:
    """Return the (corner, 2) points where shortest paths may bend: the areas' convex corners."""
    corners = [np.empty((0, 2))]
    for polygon in _polygons(shapely.orient_polygons(areas)):
        for ring in (polygon.exterior, *polygon.interiors):
            points = shapely.get_coordinates(ring)[:-1]
            before = points - np.roll(points, 1, axis=0)
            after = np.roll(points, -1, axis=0) - points
            # The area lies on the left of every ring, so its convex corners turn left.
            turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
            corners.append(points[turn > 0])
    return np.concatenate(corners)


def _blocked_between(points: FloatArray, parts: list[Polygon]) -> BoolArray:
    """Mark the (point, point) pairs whose straight line meets a part; the diagonal if inside."""
    blocked = np.zeros((len(points), len(points)), dtype=np.bool_)
    if not parts:
        return blocked
    first, second = np.triu_indices(len(points))
    hit = _blocked_pairs(_Pairs(points[first], points[second]), parts)
    blocked[first[hit], second[hit]] = True
    return blocked | blocked.T


def _blocked_across(starts: FloatArray, ends: FloatArray, parts: list[Polygon]) -> BoolArray:
    """Mark the (start, end) pairs whose straight line meets a part."""
    pairs = _Pairs(np.repeat(starts, len(ends), axis=0), np.tile(ends, (len(starts), 1)))
    return _blocked_pairs(pairs, parts).reshape(len(starts), len(ends))


def _blocked_pairs(pairs: _Pairs, parts: list[Polygon]) -> BoolArray:
    """Mark the (pair,) segments that meet a part."""
    blocked = np.zeros(len(pairs.start), dtype=np.bool_)
    for part in parts:
        near = _near_box(pairs, part.bounds)
        near = near[~blocked[near]]
        segments = shapely.linestrings(np.stack([pairs.start[near], pairs.end[near]], axis=1))
        shapely.prepare(part)
        blocked[near] = shapely.intersects(part, segments)
    return blocked


def _near_box(pairs: _Pairs, box: tuple[float, float, float, float]) -> IntArray:
    """Return the indices of the segments that meet a box, by the separating axes of the two."""
    half_x, half_y = (box[2] - box[0]) / 2, (box[3] - box[1]) / 2
    along_x, along_y = ((pairs.end - pairs.start) / 2).T
    middle_x, middle_y = ((pairs.start + pairs.end) / 2).T
    from_x, from_y = middle_x - (box[0] + half_x), middle_y - (box[1] + half_y)
    reach_x, reach_y = np.abs(along_x), np.abs(along_y)
    meets = (
        (np.abs(from_x) <= half_x + reach_x)
        & (np.abs(from_y) <= half_y + reach_y)
        & (np.abs(along_x * from_y - along_y * from_x) <= half_x * reach_y + half_y * reach_x)
    )
    return np.flatnonzero(meets)


def _detours(
    points: FloatArray, corners: FloatArray, parts: list[Polygon], wind: _Wind
) -> Legs:
    """Return the quickest (node, node) flights that bend at least once, at corners of areas.

    A straight flight is the quickest in steady wind too, so quickest paths bend only at corners.
    """
    hidden = _blocked_across(points, corners, parts)
    between = _clear(corners, corners, _blocked_between(corners, parts), wind)
    for middle in range(len(corners)):
        through = Legs(*(legs[:, middle, None] + legs[middle] for legs in between))
        _keep_quicker(between, through)
    outward = _join(_clear(points, corners, hidden, wind), between)
    return _join(outward, _clear(corners, points, hidden.T, wind))


def _clear(starts: FloatArray, ends: FloatArray, hidden: BoolArray, wind: _Wind) -> Legs:
    """Return the straight (start, end) flights, infinite where `hidden`."""
    lengths = np.hypot(ends[:, 0] - starts[:, 0, None], ends[:, 1] - starts[:, 1, None])
    durations = wind.durations(starts, ends, lengths)
    return Legs(np.where(hidden, np.inf, lengths), np.where(hidden, np.inf, durations))


def _join(first: Legs, second: Legs) -> Legs:
    """Return the quickest two-part flights from `first`'s origins to `second`'s targets."""
    shape = (len(first.duration), second.duration.shape[1])
    quickest = Legs(np.full(shape, np.inf), np.full(shape, np.inf))
    for middle in range(len(second.duration)):
        through = Legs(*(start[:, middle, None] + end[middle]
                         for start, end in zip(first, second, strict=True)))
        _keep_quicker(quickest, through)
    return quickest


def _keep_quicker(quickest: Legs, candidate: Legs) -> None:
    """Replace the legs that `candidate` flies quicker. In place."""
    better = candidate.duration < quickest.duration
    np.copyto(quickest.duration, candidate.duration, where=better)
    np.copyto(quickest.distance, candidate.distance, where=better)
