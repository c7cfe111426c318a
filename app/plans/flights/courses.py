"""A plan -> its flights: where drones fly, around zones, how fast and when."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np
from shapely import LineString, Polygon, STRtree

from app.plans.flights.flight import Flight, Place, Ring, WayPoint
from app.plans.flights.flown import PlannedFlight, flown_in
from app.requests.conversion.energy import climb_duration
from app.requests.conversion.ground import Detours, Ground
from app.requests.conversion.places import PlacedRequest
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, Flyer
from app.schemas.errors import ErrorCode, InputError, InvalidRequestError
from app.schemas.fields import point_of
from app.schemas.plan import PlanInput
from app.schemas.request import PlanRequest
from model.problem import FloatArray
from model.travel.wind import Breeze, Wind

DECIMALS = 7
"""Of degrees: MAVLink counts ten-millionths, which are a centimetre."""

CLEAR_M = 0.1
"""How far from a zone's corner a flight bends, so that no rounding leads it through."""

NEARBY_M = 5000.0
"""Zones this far from a flight are told with it; its controller has room for few."""

SHORTEST_WAIT = 1.0
"""Seconds that are waited for; less is what rounding leaves."""


@dataclass(frozen=True)
class _Leg:
    """A flight from place to place: the corners on the way, its end among them."""

    places: list[Place]
    speeds: list[float]  # m/s over ground on the way to each
    shares: list[float]  # of the leg's duration that have passed at each
    seconds: float  # climb and descent included


def flights_of(placed: PlacedRequest, plan: PlanInput, ground: Ground) -> list[Flight]:
    """Return the flights of a plan, in its order, those of each drone in the order it flies them.

    Parameters
    ----------
    placed
        The request, its addresses being located.
    plan
        All that it names is there, and sorties have their stops.
    ground
        That of the request.

    Raises
    ------
    InvalidRequestError
        If the places are not on the globe, nothing flies, or there is no way around zones.
    """
    request = placed.request
    if request.coordinate_system != "geographic":
        raise _refused("FLIGHTS_ON_PLANE", "$.problem.coordinate_system", "Flights are written in "
                       "degrees alone: set coordinate_system to 'geographic' and state places as "
                       "[longitude, latitude].")
    if any(point_of(place.location) is None for place in placed.places):
        raise _refused("MISSING_LOCATION", "$.problem", "Flights lead from place to place: state "
                       "the location of every depot and customer.")
    flown = list(flown_in(placed, plan))
    if not flown:
        raise _refused("NO_FLIGHTS", "$.plan.routes", "No drone flies in this plan: there is "
                       "nothing to write.")
    courses = _Courses(placed, ground, flown)
    return [courses.flight(each) for each in flown]


class _Zones:
    """Zones by where they are."""

    def __init__(self, areas: Sequence[tuple[Polygon, FloatArray]]) -> None:
        self._tree = STRtree([area for area, _ in areas])
        self._rings = [_closed(ring) for _, ring in areas]

    def near(self, line: LineString) -> tuple[Ring, ...]:
        """Return the rings around those near a flight, in their order."""
        found = self._tree.query(line, predicate="dwithin", distance=NEARBY_M)
        return tuple(self._rings[index] for index in sorted(found.tolist()))


class _Courses:
    """Works out the ways of some flights."""

    def __init__(self, placed: PlacedRequest, ground: Ground,
                 flights: Sequence[PlannedFlight]) -> None:
        flown = sorted({node for each in flights for node in each.nodes})
        self._request: PlanRequest = placed.request
        self._places = placed.places
        self._ground = ground
        self._at = {node: index for index, node in enumerate(flown)}
        self._points = ground.points_m[flown]
        altitudes = {each.flyer.altitude for each in flights}
        self._detours: dict[float, Detours] = {
            altitude: ground.detours_among(flown, altitude) for altitude in altitudes
            if ground.has_areas(altitude)}
        self._zones: dict[tuple[float, int], _Zones] = {}
        day = self._request.day
        self._plan_start: datetime | None = None if day is None else day.start.astimezone(UTC)

    def flight(self, flown: PlannedFlight) -> Flight:
        """Return a flight with its way."""
        altitude, energy = flown.flyer.altitude, flown.flyer.energy
        way_points = tuple(self._way_points(flown))
        line = LineString(self._ground.planar(np.array([point.place for point in way_points])))
        return Flight(
            vehicle=flown.vehicle, drone=flown.drone, number=flown.number, altitude=altitude,
            lands=energy is None or energy.lands, way_points=way_points,
            recovery_time=flown.recovery_time, zones=self._closed_to(flown).near(line),
            plan_start=self._plan_start, buffer=self._request.airspace.buffer)

    def _closed_to(self, flown: PlannedFlight) -> _Zones:
        """Return the zones but those with hours that a flight leads to while they are open."""
        altitude = flown.flyer.altitude
        held = self._ground.closed(altitude).zones[[*flown.nodes]]
        key = altitude, int(np.bitwise_or.reduce(held))
        if key not in self._zones:
            self._zones[key] = _Zones(self._ground.closed_areas(*key))
        return self._zones[key]

    def _way_points(self, flown: PlannedFlight) -> Iterator[WayPoint]:
        nodes, leaving = flown.nodes, flown.launch_time
        yield WayPoint("launch", self._place(nodes[0]), flown.launch, 0.0, leaving)
        for index, visit in enumerate(flown.visits):
            leg = self._leg(flown, nodes[index], nodes[index + 1])
            yield from _bends(leg, leaving, visit.arrival)
            leaving = visit.departure
            yield WayPoint("customer", leg.places[-1], visit.id, leg.speeds[-1], visit.arrival,
                           max(0.0, leaving - visit.arrival))
        leg = self._leg(flown, nodes[-2], nodes[-1])
        arrival = leaving + leg.seconds
        waiting = flown.met_time - arrival
        yield from _bends(leg, leaving, arrival)
        yield WayPoint("recovery", leg.places[-1], flown.recovery, leg.speeds[-1], arrival,
                       waiting if waiting >= SHORTEST_WAIT else 0.0)

    def _place(self, node: int) -> Place:
        longitude, latitude = self._ground.locations[node]
        return float(longitude), float(latitude)

    def _leg(self, flown: PlannedFlight, start: int, end: int) -> _Leg:
        """Return the flight from node to node, in the worst of several winds.

        There is always a way around zones, or it raises.
        """
        winds: list[tuple[Breeze, ...]] = [(breeze,) for breeze in flown.winds]
        legs = [self._leg_in(each, flown.flyer, start, end) for each in winds or [()]]
        return max(legs, key=lambda leg: leg.seconds)

    def _leg_in(self, breeze: tuple[Breeze, ...], flyer: Flyer, start: int,
                end: int) -> _Leg:
        """Return the flight in one wind, the steady one if none is stated."""
        speed = _airspeed(flyer)
        corners = np.stack([self._points[self._at[start]], *self._bends(flyer, start, end, breeze),
                            self._points[self._at[end]]])
        x, y = np.diff(corners, axis=0).T
        lengths = np.hypot(x, y)
        wind = Wind.blowing(*breeze[0], speed) if breeze else (
            self._ground.airspace(flyer.altitude).wind(speed))
        seconds = wind.durations(x, y, lengths)
        if flyer.profile in (self._request.matrices or {}):
            total = self._matrix_seconds(flyer.profile, start, end)
            seconds = lengths / max(lengths.sum(), 1.0) * total
        else:
            total = float(seconds.sum()) + climb_duration(flyer) / 1000 * (start != end)
        speeds = [float(length / each) if each > 0 else speed / 3.6
                  for length, each in zip(lengths, seconds, strict=True)]
        passed = np.cumsum(seconds) / max(float(seconds.sum()), 1e-9)
        places = [(round(float(lon), DECIMALS), round(float(lat), DECIMALS))
                  for lon, lat in self._ground.stated(corners[1:-1])]
        return _Leg([*places, self._place(end)], speeds, passed.tolist(), total)

    def _bends(self, flyer: Flyer, start: int, end: int,
               breeze: tuple[Breeze, ...]) -> FloatArray:
        """Return the (corner, 2) planar metres where a flight bends."""
        a, b = self._at[start], self._at[end]
        detours, speed = self._detours.get(flyer.altitude), _airspeed(flyer)
        if detours is None or not detours.are_blocked(a, b):
            return np.empty((0, 2))
        bends = self._ground.planar(detours.bends(a, b, speed, breeze))
        if len(bends) == 0:
            names = [getattr(self._places[node], "id", "a stop") for node in (start, end)]
            raise _refused("NO_WAY_AROUND", "$.problem.airspace", f"There is no way around the "
                           f"zones from {names[0]!r} to {names[1]!r}: the plan can't be flown.")
        return _loosened(np.stack([self._points[a], *bends, self._points[b]]))

    def _matrix_seconds(self, profile: str, start: int, end: int) -> float:
        matrices = self._request.matrices or {}
        row, column = self._places[start].location_index, self._places[end].location_index
        if row is None or column is None:
            raise ValueError(f"matrices[{profile!r}]: a place has no location_index")
        return 0.0 if start == end else float(matrices[profile].durations[row][column])


def _loosened(corners: FloatArray) -> FloatArray:
    """Return the inner ones of (corner, 2) planar metres, a little away from what they go around.

    At a bend of a tight string, that is opposite to where both of its sides pull.
    """
    before, inner, after = corners[:-2], corners[1:-1], corners[2:]
    pull = _unit(before - inner) + _unit(after - inner)
    return inner - CLEAR_M * _unit(pull)


def _unit(vectors: FloatArray) -> FloatArray:
    lengths = np.hypot(vectors[:, 0], vectors[:, 1])[:, None]
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)


def _bends(leg: _Leg, leaving: float, arrival: float) -> Iterator[WayPoint]:
    for place, speed, share in zip(leg.places[:-1], leg.speeds, leg.shares, strict=False):
        yield WayPoint("bend", place, None, speed, leaving + share * (arrival - leaving))


def _closed(ring: FloatArray) -> Ring:
    """Return a ring whose last corner is its first."""
    corners = tuple((float(x), float(y)) for x, y in ring)
    return corners if corners[0] == corners[-1] else (*corners, corners[0])


def _airspeed(flyer: Flyer) -> float:
    return flyer.speed_kmh or DEFAULT_DRONE_SPEED_KMH


def _refused(code: ErrorCode, path: str, message: str) -> InvalidRequestError:
    return InvalidRequestError([InputError(code=code, path=path, message=message)])
