"""Where drones may fly and how fast: no-fly areas and wind become flight distances and durations.

Everything is planar, in metres, x east and y north. Geographic problems project locations and
no-fly areas with one `LocalProjection`; edges of areas and flights are straight in that projection,
and north is the centre's.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import shapely
from shapely import Polygon

from model.engine.pausing import Pause, go_on, matrix_blocks
from model.problem import FloatArray, IntArray
from model.travel.matrices import planar_distances
from model.travel.obstacles import Obstacles, obstacles_of
from model.travel.ways import FlightLegs, Ways, find_ways
from model.travel.wind import Breeze, Wind
from model.travel.zones import KEPT, read_back, written

Ring = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Airspace:
    """What bends or slows flights."""

    no_fly: tuple[Ring, ...] = ()  # corners in metres, closing point optional
    wind_speed_kmh: float = 0.0
    wind_direction_deg: float = 0.0  # blows FROM there, clockwise from north: 270 is a west wind
    zones: tuple[Polygon, ...] = ()  # more areas, in metres, which may have holes
    low_zones: tuple[Polygon, ...] = ()  # flown over, but nobody takes off or lands in them

    def __post_init__(self) -> None:
        for index, ring in enumerate(self.no_fly):
            reason = invalid_polygon_reason(ring)
            if reason is not None:
                raise ValueError(f"no_fly[{index}]: {reason}")
        if not 0 <= self.wind_speed_kmh < float("inf"):
            raise ValueError(f"wind_speed_kmh: {self.wind_speed_kmh!r} is not allowed")
        if not np.isfinite(self.wind_direction_deg):
            raise ValueError(f"wind_direction_deg: {self.wind_direction_deg!r} is not allowed")

    @property
    def is_free(self) -> bool:
        """Tell whether all flights are straight."""
        return not (self.no_fly or self.zones or self.low_zones)

    @cached_property
    def obstacles(self) -> Obstacles:
        """The areas, merged."""
        return _obstacles_of(self.no_fly, written(self.zones), written(self.low_zones))

    def wind(self, airspeed_kmh: float) -> Wind:
        """Return what the wind does to drones of a speed through the air."""
        return Wind.blowing(self.wind_speed_kmh, self.wind_direction_deg, airspeed_kmh)


@lru_cache(maxsize=KEPT)
def _obstacles_of(no_fly: tuple[Ring, ...], zones: tuple[bytes, ...],
                  low_zones: tuple[bytes, ...]) -> Obstacles:
    return obstacles_of(no_fly, read_back(zones), read_back(low_zones))


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
) -> FlightLegs:
    """Fly between all points at one speed; parameters are those of `Flights`."""
    if straight_m is None:
        straight_m = planar_distances(points_m)
    return Flights(points_m, airspace, straight_m).legs(airspeed_kmh)


class Flights:
    """Flights between all points: straight, or by the quickest way around no-fly areas.

    Without wind the quickest way is the shortest. Boundaries may be touched and followed; a point
    inside an area can't be flown to or from, not even from itself. Areas thinner than a
    millimetre don't block, and gaps between areas thinner than that don't let through.

    Parameters
    ----------
    points_m
        (node, 2) planar metres.
    airspace
        No-fly areas and wind, in the same plane.
    straight_m
        (node, node) distances of unobstructed flights: those in the plane, or great circles for
        geographic points. Detours are always measured in the plane.
    pause
        May end the work, within `legs`.
    """

    def __init__(self, points_m: FloatArray, airspace: Airspace, straight_m: FloatArray,
                 pause: Pause = go_on) -> None:
        self._points = points_m
        self.airspace = airspace
        self._straight_m = straight_m
        self._pause = pause

    def legs(self, airspeed_kmh: float, winds: Sequence[Breeze] = ()) -> FlightLegs:
        """Return the flights of drones of one speed through the air, for reading only.

        Of several `winds`, each flight is that in which it takes longest; by default the
        airspace's own.

        Raises
        ------
        ValueError
            If it is no speed.
        """
        if not 0 < airspeed_kmh < float("inf"):
            raise ValueError(f"airspeed_kmh: {airspeed_kmh!r} is not allowed")
        felt = [Wind.blowing(*breeze, airspeed_kmh) for breeze in winds]
        first, *others = felt or [self.airspace.wind(airspeed_kmh)]
        legs = self._in(first)
        if others:
            legs = FlightLegs(*(each.copy() for each in legs))
        for wind in others:
            other = self._in(wind)
            longer = other.duration > legs.duration
            for worst, each in zip(legs, other, strict=True):
                np.copyto(worst, each, where=longer)
        return legs

    def _in(self, wind: Wind) -> FlightLegs:
        if wind.is_calm:
            return FlightLegs(self._shortest_m, self._shortest_m / wind.airspeed)
        return self._quickest(wind)

    @cached_property
    def ways(self) -> Ways:
        """The ways around areas, whatever the speed."""
        return find_ways(self._points, self.airspace.obstacles, self._pause)

    @cached_property
    def _shortest_m(self) -> FloatArray:
        """The distances without wind, whatever the speed."""
        if self.airspace.is_free:
            return self._straight_m
        # At a metre a second, durations are distances.
        shortest = self._straight_m.copy()
        self.ways.replace_blocked(FlightLegs(shortest, shortest), Wind(1.0, 0.0, 0.0), self._pause)
        return shortest

    def _quickest(self, wind: Wind) -> FlightLegs:
        legs = FlightLegs(self._straight_m.copy(), np.empty_like(self._straight_m))
        for rows in matrix_blocks(len(self._points), self._pause):
            x = self._points[:, 0] - self._points[rows, 0, None]
            y = self._points[:, 1] - self._points[rows, 1, None]
            legs.duration[rows] = wind.durations(x, y, legs.distance[rows])
            legs.distance[rows][np.isinf(legs.duration[rows])] = np.inf
        if not self.airspace.is_free:
            self.ways.replace_blocked(legs, wind, self._pause)
        return legs


class OpenFlights:
    """Flights between all points, some of which lie in areas that are closed at some hours alone.

    A flight leads through those in which its ends lie, and around all others.

    Parameters
    ----------
    by_areas
        The flights if some of these areas are open, as bits.
    areas
        (node,) in which each point lies, as bits.
    """

    def __init__(self, by_areas: Mapping[int, Flights], areas: IntArray) -> None:
        self._by_areas = by_areas
        self._areas = areas

    def legs(self, airspeed_kmh: float, winds: Sequence[Breeze] = ()) -> FlightLegs:
        """Return the flights of drones of one speed as `Flights.legs` does."""
        legs = FlightLegs(*(each.copy() for each in self._by_areas[0].legs(airspeed_kmh, winds)))
        entered = self._areas[:, None] | self._areas
        for areas, flights in self._by_areas.items():
            if areas:
                for each, through in zip(legs, flights.legs(airspeed_kmh, winds), strict=True):
                    np.copyto(each, through, where=entered == areas)
        return legs
