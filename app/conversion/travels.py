"""Travel matrices of a request, from locations or the client's matrices, equal ones built once."""

from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from app.conversion.energy import climb_duration
from app.conversion.places import nowhere_of, places_of
from app.conversion.preparing import UNHURRIED, Preparing
from app.conversion.rounding import rounded
from app.conversion.units import thousandths
from app.conversion.work import legs_seconds, sights_seconds
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, DronesInput
from app.schemas.request import MatrixInput, PlanRequest
from app.schemas.vehicle import DEFAULT_TRUCK_SPEED_KMH, VehicleTypeInput
from model.problem import FloatArray, SpeedProfile, Travel
from model.travel.airspace import Airspace, Flights
from model.travel.matrices import (
    LocalProjection,
    embed,
    flight_travel,
    great_circle_distances,
    longer_legs,
    matrix_travel,
    planar_distances,
    speed_profile,
    truck_travel,
    with_nowhere,
)


class _Key(NamedTuple):
    """What tells one pair of matrices from another."""

    means: Literal["drive", "matrix", "flight"]
    profile: str  # of the client's matrix, else empty
    speed: float  # km/h, or a multiple of the matrix speed
    climb: int = 0  # ms more for each leg
    flown: bool = False  # which matters where some end nowhere


class Ground:
    """Where a request's places and no-fly areas are, however its fleet travels."""

    def __init__(self, request: PlanRequest, preparing: Preparing = UNHURRIED) -> None:
        self._request = request
        self._preparing = preparing
        self.places = places_of(request)

    def is_that_of(self, request: PlanRequest) -> bool:
        """Tell whether a request has its places and areas at the same points."""
        mine = self._request
        return (
            (mine.coordinate_system, mine.planar_unit, mine.planar_rounding, mine.airspace)
            == (request.coordinate_system, request.planar_unit, request.planar_rounding,
                request.airspace)
            and [place.location for place in self.places]
            == [place.location for place in places_of(request)])

    @cached_property
    def locations(self) -> FloatArray:
        """As stated."""
        points = [place.location for place in self.places if place.location is not None]
        return np.array(points, dtype=np.float64)

    @cached_property
    def _projection(self) -> LocalProjection:
        return LocalProjection.around(self.locations)

    @cached_property
    def is_geographic(self) -> bool:
        """Tell whether places are on the globe."""
        return self._request.coordinate_system == "geographic"

    def _planar(self, points: FloatArray) -> FloatArray:
        return (self._projection.project(points) if self.is_geographic
                else points * self._request.planar_unit)

    @cached_property
    def points_m(self) -> FloatArray:
        """Planar metres."""
        return self._planar(self.locations)

    @cached_property
    def legs_m(self) -> FloatArray:
        """What trucks drive from each place to each, as the request rounds it."""
        request = self._request
        if self.is_geographic or request.planar_rounding == "exact":
            return self.distances_m
        straight = planar_distances(self.locations, self._preparing.pause)
        return rounded(straight, request.planar_rounding) * request.planar_unit

    @cached_property
    def distances_m(self) -> FloatArray:
        """From each place to each, straight or on a great circle."""
        pause = self._preparing.pause
        return (great_circle_distances(self.locations, pause) if self.is_geographic
                else planar_distances(self.points_m, pause))

    @cached_property
    def flights(self) -> Flights:
        """Flights of drones of any speed."""
        flights = Flights(self.points_m, self._airspace, self.distances_m, self._preparing.pause)
        obstacles = flights.obstacles
        self._preparing.expect(sights_seconds(
            len(self.places), len(obstacles.corners.place), len(obstacles.edges)))
        return flights

    @cached_property
    def _airspace(self) -> Airspace:
        stated = self._request.airspace
        rings = [self._planar(np.array(ring, dtype=np.float64)) for ring in stated.no_fly]
        return Airspace(
            no_fly=tuple(tuple((float(x), float(y)) for x, y in ring) for ring in rings),
            wind_speed_kmh=stated.wind.speed_kmh,
            wind_direction_deg=stated.wind.direction_deg,
        )


class Travels:
    """Collects the matrices of one valid request, unless the work on them is to end."""

    def __init__(self, request: PlanRequest, preparing: Preparing = UNHURRIED,
                 ground: Ground | None = None) -> None:
        self._request = request
        self._preparing = preparing
        self._ground = ground or Ground(request, preparing)
        self._places = places_of(request)
        self._nowhere = nowhere_of(request)
        self._index: dict[_Key, int] = {}
        self._travels: list[Travel] = []

    def count(self) -> int:
        """Return how many pairs of matrices planning needs, without building any.

        Where customers ask for a setup, ways back to trucks are apart from those to customers.
        """
        request = self._request
        sets_up = any(customer.setup_duration for customer in request.customers)
        flown = {self._flying(drones) for kind in request.fleet for drones in kind.drone_types}
        return len(self._keys()) + (len(flown) if sets_up else 0)

    def expect_legs(self) -> None:
        """Make sure that there is time to build all matrices, if none is flown around areas.

        Raises
        ------
        RequestError
            If the work is to end.
        """
        keys = self._keys()
        flights = sum(key.means == "flight" for key in keys)
        self._preparing.expect(legs_seconds(len(self._places), len(keys) - flights, flights,
                                            self._ground.is_geographic))

    def built(self) -> tuple[Travel, ...]:
        """Return the matrices built so far."""
        return tuple(self._travels)

    def drive(self, vehicle_type: VehicleTypeInput) -> tuple[int, SpeedProfile | None]:
        """Return the index of the trucks' matrices, and their speeds by time of day."""
        key, profile = self._driving(vehicle_type)
        return self._at(key), profile

    def fly(self, drones: DronesInput) -> int:
        """Return the index of the drones' matrices."""
        return self._at(self._flying(drones))

    def coordinates(self) -> FloatArray:
        """Return the (node, 2) coordinates that the policy sees, in any planar unit."""
        nowhere = self._nowhere
        if all(place.location is not None for place in self._places):
            points = self._ground.points_m
        else:
            duration = self._travels[0].duration
            if nowhere is not None:
                duration = np.delete(np.delete(duration, nowhere, 0), nowhere, 1)
            points = embed(duration)
        # Whoever ends anywhere is seen to do so amid all places.
        return points if nowhere is None else np.insert(points, nowhere, points.mean(axis=0), 0)

    def _keys(self) -> set[_Key]:
        fleet = self._request.fleet
        return ({self._driving(kind)[0] for kind in fleet}
                | {self._flying(drones) for kind in fleet for drones in kind.drone_types})

    def _driving(self, vehicle_type: VehicleTypeInput) -> tuple[_Key, SpeedProfile | None]:
        matrix = self._matrix(vehicle_type.profile)
        usual = vehicle_type.speed_kmh or DEFAULT_TRUCK_SPEED_KMH
        scale = usual if matrix is None else 1.0
        if not vehicle_type.speed_profile:
            return self._driving_at(vehicle_type.profile, scale), None
        changes = [
            (thousandths(change.from_time),
             scale * (change.factor or (change.speed_kmh or usual) / usual))
            for change in vehicle_type.speed_profile
        ]
        fastest, profile = speed_profile(scale, changes)
        return self._driving_at(vehicle_type.profile, fastest), profile

    def _flying(self, drones: DronesInput) -> _Key:
        airspace = self._request.airspace
        speed, climb = drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH, climb_duration(drones)
        if self._matrix(drones.profile) is not None:
            key = self._driving_at(drones.profile, 1.0)
        elif not airspace.no_fly and not airspace.wind.speed_kmh:
            key = self._driving_at(drones.profile, speed)._replace(climb=climb)
        else:
            key = _Key("flight", "", speed, climb)
        return key._replace(flown=self._nowhere is not None)

    def _driving_at(self, profile: str, speed: float) -> _Key:
        return (_Key("drive", "", speed) if self._matrix(profile) is None
                else _Key("matrix", profile, speed))

    def _matrix(self, profile: str) -> MatrixInput | None:
        return (self._request.matrices or {}).get(profile)

    def _at(self, key: _Key) -> int:
        """Return the index of a pair of matrices, which is built the first time."""
        if key not in self._index:
            self._index[key] = len(self._travels)
            travel = self._build(key)
            if self._nowhere is not None:
                travel = with_nowhere(travel, self._nowhere, key.flown)
            self._travels.append(travel)
        return self._index[key]

    def _build(self, key: _Key) -> Travel:
        self._preparing.pause()
        if key.climb:
            return longer_legs(self._build(key._replace(climb=0)), key.climb)
        matrix = self._matrix(key.profile) if key.means == "matrix" else None
        if matrix is not None:
            durations = self._at_places(matrix.durations) / key.speed
            distances = (self._ground.legs_m if matrix.distances is None
                         else self._at_places(matrix.distances))
            return matrix_travel(durations, distances, self._preparing.pause)
        if key.means == "drive":
            return truck_travel(self._ground.legs_m, key.speed, self._preparing.pause)
        return flight_travel(*self._ground.flights.legs(key.speed), self._preparing.pause)

    def _at_places(self, table: list[list[float]]) -> FloatArray:
        """Return a client's matrix with one row and column per node.

        Whoever stays at a node travels nothing, whatever the diagonal says; between two nodes in
        the same row it counts.
        """
        indices = [place.location_index or 0 for place in self._places]
        legs = np.array(table, dtype=np.float64)[np.ix_(indices, indices)]
        np.fill_diagonal(legs, 0.0)
        return legs
