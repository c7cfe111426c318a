"""Where a request's places are, and how far it is between them."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from app.maps.airspace.zone import Zone
from app.requests.conversion.closings import (
    Closed, Hours, Times, most_holding, times_closed,
)
from app.requests.conversion.places import PlacedRequest
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.rounding import ROUNDINGS
from app.requests.conversion.work import merging_seconds, sights_seconds
from app.requests.conversion.zones import Met, ZoneVolume, ZonesMet, span_of
from app.schemas.fields import point_of
from app.schemas.wind import WindInput
from model.problem import MAX_TIMED_ZONES, FloatArray, IntArray, Points
from model.problem.distances import EXACT
from model.travel.airspace import Airspace, Flights, OpenFlights
from model.travel.buffers import grown, planar_buffers, reaches_of
from model.travel.matrices import (
    LocalProjection,
    planar_distances,
    points_of,
    straight_distances,
)
from model.travel.obstacles import count_nearby, edges_of
from model.travel.ways import Ways, find_ways
from model.travel.wind import Breeze, Wind
from model.travel.zones import (
    WIDER_M, are_within_reach, dissolved, holding, within_reach, without_holes,
)


QUARTER_M = 1e7
"""A quarter of the way around the globe."""


class Detour(NamedTuple):
    """Where flights bend around no-fly areas."""

    ways: Ways
    corners: FloatArray  # (corner, 2) as the request states places
    airspace: Airspace


class Detours(NamedTuple):
    """Where flights bend, by the zones with hours that their ends lie in."""

    by_zones: Mapping[int, Detour]
    zones: IntArray  # (place,) as bits

    def _between(self, start: int, end: int) -> Detour:
        return self.by_zones[int(self.zones[start] | self.zones[end])]

    def are_blocked(self, start: int, end: int) -> bool:
        """Tell whether no straight flight leads from place to place."""
        return bool(self._between(start, end).ways.blocked[start, end])

    def bends(self, start: int, end: int, airspeed_kmh: float,
              winds: Sequence[Breeze] = ()) -> FloatArray:
        """Return the (place, 2) places where a flight from place to place bends, in their order.

        Of several winds, in that in which it takes longest.
        """
        ways, corners, airspace = self._between(start, end)
        if not ways.blocked[start, end]:
            return corners[:0]
        felt = [Wind.blowing(*breeze, airspeed_kmh) for breeze in winds]
        felt = felt or [airspace.wind(airspeed_kmh)]
        worst = max(felt, key=lambda wind: ways.quickest(start, end, wind)[0])
        return corners[ways.bends(start, end, worst)]


class Ground:
    """Where a request's places and no-fly areas are, however its fleet travels."""

    def __init__(self, placed: PlacedRequest, preparing: Preparing = UNHURRIED,
                 published: Sequence[Zone] = ()) -> None:
        self._request = placed.request
        self._preparing = preparing
        self.places = placed.places
        self.zones = ZonesMet(placed.request, published)
        self._airspaces: dict[Met, Airspace] = {}
        self._flights: dict[Met, Flights] = {}
        self._has_areas: dict[Met, bool] = {}
        self._closed: dict[Met, Closed] = {}

    def is_that_of(self, placed: PlacedRequest) -> bool:
        """Tell whether a request has its places and areas at the same points."""
        mine, request = self._request, placed.request
        return (
            (mine.coordinate_system, mine.planar_unit, mine.planar_rounding, mine.airspace,
             mine.plan_start)
            == (request.coordinate_system, request.planar_unit, request.planar_rounding,
                request.airspace, request.plan_start)
            and self.zones.span == span_of(request)
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

    def has_areas(self, altitude: float) -> bool:
        """Tell whether there is anything that drones at an altitude may not fly through."""
        if self._request.airspace.no_fly:
            return True
        met = self.zones.at(altitude)
        if met not in self._has_areas:
            around, over = map(self._projected, met)
            self._has_areas[met] = (
                are_within_reach(around, self.points_m, self._apart(around))
                or len(holding(over, self.points_m, self._apart(over))) > 0)
        return self._has_areas[met]

    def closed(self, altitude: float) -> Closed:
        """Return what drones at an altitude meet, and which of it they don't meet at some hours."""
        met = self.zones.at(altitude)
        if met not in self._closed:
            first_bit = sum([len(closed.hours) for closed in self._closed.values()])
            self._closed[met] = self._closed_by(met, first_bit)
        return self._closed[met]

    def _closed_by(self, met: Met, first_bit: int) -> Closed:
        by_times: dict[Times, set[ZoneVolume]] = {}
        for part in (*met.around, *met.over):
            times = times_closed(part, self._request.day, self.zones.span)
            if times:
                by_times.setdefault(times, set()).add(part)
        held = [(self._holding(parts), Hours(times, frozenset(parts)))
                for times, parts in by_times.items()]
        found = most_holding([(len(nodes), hours) for nodes, hours in held if len(nodes)])
        if first_bit + len(found) > MAX_TIMED_ZONES:
            found = ()
        zones = np.zeros(len(self.places), np.int64)
        for nodes, hours in held:
            if hours in found:
                zones[nodes] |= 1 << found.index(hours)
        return Closed(met, found, first_bit, zones)

    def _holding(self, parts: Collection[ZoneVolume]) -> IntArray:
        """Return the places that lie in any of some zones, or too near to one."""
        areas = self._projected([*parts])
        found, _ = shapely.STRtree(areas).query(
            shapely.points(self.points_m), predicate="dwithin",
            distance=WIDER_M + self._apart(areas))
        return np.unique(found)

    def zones_with_hours(self, altitudes: Iterable[float]) -> IntArray:
        """Return the (place,) zones with hours that hold each, as bits, at any of some altitudes.
        """
        closed = [self.closed(altitude) for altitude in altitudes]
        return np.bitwise_or.reduce(
            [np.zeros(len(self.places), np.int64),
             *(each.zones << each.first_bit for each in closed)])

    def flights(self, altitude: float) -> Flights | OpenFlights:
        """Return the flights of drones of any speed at an altitude."""
        closed = self.closed(altitude)
        found = {zones: self._flights_by(closed.open_to(zones)) for zones in closed.together()}
        return OpenFlights(found, closed.zones) if closed.hours else found[0]

    def _flights_by(self, met: Met) -> Flights:
        if met not in self._flights:
            airspace = self._airspace_by(met)
            obstacles = airspace.obstacles
            self._preparing.expect(sights_seconds(
                len(self.places), len(obstacles.corners.place), len(obstacles.edges)))
            self._flights[met] = Flights(self.points_m, airspace, self.distances_m,
                                         self._preparing.pause)
        return self._flights[met]

    def detours(self, altitude: float) -> Detours | None:
        """Return where flights bend; None: they are straight."""
        if not self.has_areas(altitude):
            return None
        closed, found = self.closed(altitude), {}
        for zones in closed.together():
            flights = self._flights_by(closed.open_to(zones))
            found[zones] = self._detour(flights.ways, flights.airspace)
        return Detours(found, closed.zones)

    def detours_among(self, nodes: Sequence[int], altitude: float) -> Detours:
        """Return where flights between a few of the places bend, numbered as they are listed."""
        closed, found = self.closed(altitude), {}
        for zones in closed.together():
            airspace = self._airspace_by(closed.open_to(zones))
            ways = find_ways(self.points_m[nodes], airspace.obstacles, self._preparing.pause)
            found[zones] = self._detour(ways, airspace)
        return Detours(found, closed.zones[nodes])

    def _detour(self, ways: Ways, airspace: Airspace) -> Detour:
        return Detour(ways, self.stated(airspace.obstacles.corners.place), airspace)

    def closed_areas(self, altitude: float, zones: int = 0) -> list[tuple[Polygon, FloatArray]]:
        """Return all that may not be flown through, in planar metres as it was published.

        But for `zones` with hours, as bits, to which it is flown while they are open.

        With each, the (corner, 2) ring around it as the request states places. What has holes
        comes in pieces without.
        """
        rings = [np.array(ring, dtype=np.float64) for ring in self._request.airspace.no_fly]
        rings += [shapely.get_coordinates(piece.exterior)
                  for part in self.closed(altitude).open_to(zones).around
                  for piece in without_holes(part.volume.area)]
        return [(Polygon(self.planar(ring)), ring) for ring in rings]

    def stated(self, points_m: FloatArray) -> FloatArray:
        """Return (place, 2) planar metres as the request states places."""
        return (self._projection.unproject(points_m) if self.is_geographic
                else points_m / self._request.planar_unit)

    def planar(self, points: FloatArray) -> FloatArray:
        """Return (place, 2) places as the request states them in planar metres."""
        return (self._projection.project(points) if self.is_geographic
                else points * self._request.planar_unit)

    def zones_at(self, node: int, altitude: float) -> list[ZoneVolume]:
        """Return the zones that keep drones at an altitude from a place."""
        return self._met_by(shapely.Point(self.points_m[node]), altitude, (True, True))

    def metres_between(self, node: int, part: ZoneVolume) -> float:
        """Return how far a place lies from a zone; 0 in it, or so near that it counts as that."""
        area, = self._projected([part])
        metres = area.distance(shapely.Point(self.points_m[node]))
        return metres if metres > WIDER_M else 0.0

    def times_of(self, part: ZoneVolume) -> Times:
        """Return when a zone with hours is closed that holds places; none of others."""
        return next((hours.times for closed in self._closed.values() for hours in closed.hours
                     if part in hours.parts), ())

    def areas_near(self, node: int) -> dict[int, float]:
        """Return how far a place lies from the request's own areas that it is too near to."""
        areas = [Polygon(self.planar(np.array(ring))) for ring in self._request.airspace.no_fly]
        at = shapely.Point(self.points_m[node])
        within = WIDER_M + self._apart(areas)
        return {number: metres for number, area in enumerate(areas)
                if (metres := area.distance(at)) <= within}

    def zones_between(self, start: int, end: int, altitude: float) -> list[ZoneVolume]:
        """Return the zones that a straight flight between two places would meet, from its start."""
        line = shapely.LineString(self.points_m[[start, end]])
        return self._met_by(line, altitude, (True, False))

    def _met_by(self, what: BaseGeometry, altitude: float,
                looked_at: tuple[bool, bool]) -> list[ZoneVolume]:
        parts = [part for met, asked in zip(self.zones.at(altitude), looked_at, strict=True)
                 if asked for part in met]
        areas = self._projected(parts)
        near = shapely.STRtree(areas).query(what, predicate="dwithin",
                                            distance=WIDER_M + self._apart(areas))
        start = shapely.Point(what.coords[0])
        return [parts[number] for number in sorted(
            near.tolist(), key=lambda number: (areas[number].distance(start), number))]

    def airspace(self, altitude: float) -> Airspace:
        """Return what bends or slows flights at an altitude, in planar metres."""
        return self._airspace_by(self.zones.at(altitude))

    def _airspace_by(self, met: Met) -> Airspace:
        if met not in self._airspaces:
            self._airspaces[met] = self._airspace_with(met)
        return self._airspaces[met]

    def _airspace_with(self, met: Met) -> Airspace:
        stated = self._request.airspace
        steady = stated.wind if isinstance(stated.wind, WindInput) else WindInput()
        rings = [self.planar(np.array(ring, dtype=np.float64)) for ring in stated.no_fly]
        around, over = self._projected(met.around), self._projected(met.over)
        # Ways around the request's own areas may lead to zones that others don't.
        reached = np.concatenate([self.points_m, *rings])
        near = [around[number] for number in within_reach(around, reached, self._apart(around))]
        low = [over[number] for number in holding(over, self.points_m, self._apart(over))]
        if stated.buffer:
            near = self._grown([*map(Polygon, rings), *near])
            rings, low = [], self._grown(low)
        edges = edges_of([*map(Polygon, rings), *near])
        self._preparing.expect(merging_seconds(len(edges), count_nearby(edges)))
        return Airspace(
            no_fly=tuple(tuple((float(x), float(y)) for x, y in ring) for ring in rings),
            wind_speed_kmh=steady.speed_kmh,
            wind_direction_deg=steady.direction_deg,
            zones=dissolved(near),
            low_zones=tuple(low),
        )

    def _grown(self, areas: Sequence[Polygon]) -> list[Polygon]:
        """Return areas on the plane with the distance that flights keep from them."""
        edges = edges_of(areas)
        crossings = count_nearby(reaches_of(edges, self._apart(areas)))
        self._preparing.expect(merging_seconds(len(edges), crossings))
        return grown(areas, self._buffers(areas))

    def _apart(self, areas: Sequence[Polygon]) -> float:
        """Return how far flights keep at most from any of some areas, in planar metres."""
        return float(self._buffers(areas).max(initial=0.0))

    def _buffers(self, areas: Sequence[Polygon]) -> FloatArray:
        """Return how far flights keep from each of some areas, in planar metres."""
        farthest = float(np.hypot(*self.points_m.T).max()) if self.is_geographic else None
        return planar_buffers(areas, self._request.airspace.buffer, farthest)

    def _projected(self, parts: Sequence[ZoneVolume]) -> list[Polygon]:
        """Return the areas of zones on the plane; nothing of those on the other side of the globe.

        What lies around the antipode would lie around all else.
        """
        if not parts:
            return []
        areas = shapely.transform(np.array([part.volume.area for part in parts], dtype=object),
                                  self._projection.project)
        corners, number = shapely.get_coordinates(areas, return_index=True)
        nearest = np.full(len(areas), np.inf)
        np.minimum.at(nearest, number, np.hypot(*corners.T))
        areas[nearest > QUARTER_M] = Polygon()
        return list(areas)
