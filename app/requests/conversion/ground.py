"""Where a request's places are, and how far it is between them."""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.rounding import ROUNDINGS
from app.requests.conversion.work import sights_seconds
from app.schemas.fields import point_of
from model.problem import FloatArray, Points
from model.problem.distances import EXACT
from model.travel.airspace import Airspace, Flights
from model.travel.matrices import (
    LocalProjection,
    planar_distances,
    points_of,
    straight_distances,
)
from model.travel.obstacles import obstacles_of
from model.travel.ways import Ways, find_ways


class Detours(NamedTuple):
    """Where flights bend around no-fly areas."""

    ways: Ways
    corners: FloatArray  # (corner, 2) as the request states places
    airspace: Airspace

    def bends(self, start: int, end: int, airspeed_kmh: float) -> FloatArray:
        """Return the (place, 2) places where a flight from place to place bends, in their order."""
        if not self.ways.blocked[start, end]:
            return self.corners[:0]
        return self.corners[self.ways.bends(start, end, self.airspace.wind(airspeed_kmh))]


class Ground:
    """Where a request's places and no-fly areas are, however its fleet travels."""

    def __init__(self, placed: PlacedRequest, preparing: Preparing = UNHURRIED) -> None:
        self._request = placed.request
        self._preparing = preparing
        self.places = placed.places

    def is_that_of(self, placed: PlacedRequest) -> bool:
        """Tell whether a request has its places and areas at the same points."""
        mine, request = self._request, placed.request
        return (
            (mine.coordinate_system, mine.planar_unit, mine.planar_rounding, mine.airspace)
            == (request.coordinate_system, request.planar_unit, request.planar_rounding,
                request.airspace)
            and [place.location for place in self.places]
            == [place.location for place in placed.places])

    @cached_property
    def locations(self) -> FloatArray:
        """As stated."""
        points = [point for place in self.places
                  if (point := point_of(place.location)) is not None]
        return np.array(points, dtype=np.float64)

    @cached_property
    def _projection(self) -> LocalProjection:
        return LocalProjection.around(self.locations)

    @cached_property
    def is_geographic(self) -> bool:
        """Tell whether places are on the globe."""
        return self._request.coordinate_system == "geographic"

    @cached_property
    def points_m(self) -> FloatArray:
        """Planar metres."""
        return self.planar(self.locations)

    @cached_property
    def points(self) -> Points:
        """Where places are, and how distances between them are rounded."""
        request = self._request
        if self.is_geographic:
            return points_of(self.locations)
        if request.planar_rounding == "exact":
            return Points(self.points_m)
        return Points(self.locations, request.planar_unit, ROUNDINGS[request.planar_rounding])

    @cached_property
    def legs_m(self) -> FloatArray:
        """What trucks drive from each place to each, as the request rounds it."""
        return straight_distances(self.points, self._preparing.pause)

    @cached_property
    def distances_m(self) -> FloatArray:
        """From each place to each, straight or on a great circle."""
        if self.points.rounding == EXACT:
            return self.legs_m
        return planar_distances(self.points_m, self._preparing.pause)

    @cached_property
    def flights(self) -> Flights:
        """Flights of drones of any speed."""
        flights = Flights(self.points_m, self.airspace, self.distances_m, self._preparing.pause)
        obstacles = flights.obstacles
        self._preparing.expect(sights_seconds(
            len(self.places), len(obstacles.corners.place), len(obstacles.edges)))
        return flights

    def detours(self) -> Detours:
        """Return where flights bend, of a request with no-fly areas."""
        return Detours(self.flights.ways, self.stated(self.flights.obstacles.corners.place),
                       self.airspace)

    def detours_among(self, nodes: Sequence[int]) -> Detours:
        """Return where flights between a few of the places bend, numbered as they are listed."""
        obstacles = obstacles_of(self.airspace.no_fly)
        ways = find_ways(self.points_m[nodes], obstacles, self._preparing.pause)
        return Detours(ways, self.stated(obstacles.corners.place), self.airspace)

    def stated(self, points_m: FloatArray) -> FloatArray:
        """Return (place, 2) planar metres as the request states places."""
        return (self._projection.unproject(points_m) if self.is_geographic
                else points_m / self._request.planar_unit)

    def planar(self, points: FloatArray) -> FloatArray:
        """Return (place, 2) places as the request states them in planar metres."""
        return (self._projection.project(points) if self.is_geographic
                else points * self._request.planar_unit)

    @cached_property
    def airspace(self) -> Airspace:
        """Its areas and its wind, in planar metres."""
        stated = self._request.airspace
        rings = [self.planar(np.array(ring, dtype=np.float64)) for ring in stated.no_fly]
        return Airspace(
            no_fly=tuple(tuple((float(x), float(y)) for x, y in ring) for ring in rings),
            wind_speed_kmh=stated.wind.speed_kmh,
            wind_direction_deg=stated.wind.direction_deg,
        )
