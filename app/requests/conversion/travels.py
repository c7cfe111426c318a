"""Travel matrices of a request, from locations or the client's matrices, equal ones built once."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from app.maps.roads.roads import NO_ROADS, Roads
from app.requests.conversion.energy import climb_duration
from app.requests.conversion.far_legs import Estimates, FarTravel
from app.requests.conversion.ground import Ground
from app.requests.conversion.leg_origins import AS_ASKED, AS_THE_CROW_FLIES, LegOrigin
from app.requests.conversion.places import PlacedRequest, avoided
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.road_legs import RoadLegs, road_legs
from app.requests.conversion.units import thousandths
from app.requests.conversion.winds import Winds
from app.requests.conversion.work import COMPUTED, legs_seconds
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, DronesInput, Flyer
from app.schemas.fields import MAX_AMOUNT, Avoided
from app.schemas.request import MatrixInput, RoadsInput
from app.schemas.rows import Row
from app.schemas.vehicle import DEFAULT_TRUCK_SPEED_KMH, VehicleTypeInput
from model.problem import (
    MAX_QUANTITY, UNREACHABLE, Closings, FloatArray, IntArray, Points, SpeedProfile, StraightLegs,
    Travel,
)
from model.problem.straight import fits
from model.travel.matrices import (
    embed,
    flight_travel,
    longer_legs,
    matrix_travel,
    speed_profile,
    truck_travel,
    with_nowhere,
)
from model.travel.wind import Breeze


class _Key(NamedTuple):
    """What tells one pair of matrices from another."""

    means: Literal["drive", "matrix", "road", "flight"]
    profile: str  # of the client's matrix or of roads, else empty
    speed: float  # km/h, or a multiple of the speed of the matrix or on roads
    climb: int = 0  # ms more for each leg
    flown: bool = False  # which matters where some end nowhere
    estimated_kmh: float = 0.0  # where roads may not be known
    altitude: float = 0.0  # which matters where there are zones
    winds: tuple[Breeze, ...] = ()  # the worst of which counts; (): the steady one
    tabled: bool = False  # never computed where legs are looked up
    avoid: tuple[Avoided, ...] = ()  # on roads


STRAIGHT = _Key("drive", "", DEFAULT_DRONE_SPEED_KMH)
"""Legs whose distances tell how far places lie from one another; nobody needs to travel them."""

COMPUTED_FROM = 3000
"""Above how many places legs from coordinates are computed wherever they are looked up. Tables are
read in less time, but to make them takes so long that a search of ten seconds gains nothing by
them; and they take 50 bytes for each of places squared, and way to travel."""

SECONDS_PER_METRE = 3.6
"""Seconds that a metre takes at one km/h."""


def _all_flyers(kind: VehicleTypeInput) -> list[Flyer]:
    """Return what flies, drones of which there are none among it."""
    return [*kind.drone_types, *(kind.flyers if kind.flies else ())]


def _is_handled(flyer: Flyer) -> bool:
    """Tell whether legs to depots and from there are longer than others, in the engine's tables."""
    return isinstance(flyer, VehicleTypeInput) and (
        flyer.launch_duration + flyer.recovery_duration > 0)


def _without_ways(durations: FloatArray, distances: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return legs of which those that aren't there last as long as may be said.

    They are no longer than the longest other, so that nothing hangs on how dear they would be.
    """
    missing = np.isnan(durations)
    if not missing.any():
        return durations, distances
    longest = float(distances[~missing].max(initial=0.0))
    return (np.where(missing, MAX_AMOUNT, durations),
            np.where(missing, longest, distances))


class Travels:
    """Collects the matrices of one valid request, unless the work on them is to end."""

    def __init__(self, placed: PlacedRequest, preparing: Preparing = UNHURRIED,
                 ground: Ground | None = None, roads: Roads = NO_ROADS) -> None:
        self._placed = placed
        self._request = placed.request
        self._preparing = preparing
        self._ground = ground or Ground(placed, preparing, roads.zones)
        self._roads = roads
        self.winds = Winds(placed.request)
        self._road_legs: dict[tuple[str, tuple[Avoided, ...]], RoadLegs] = {}
        self._places = placed.places
        self._nowhere = placed.nowhere
        self._index: dict[_Key, int] = {}
        self._travels: list[Travel] = []

    def count(self, on_roads: bool = False) -> int:
        """Return how many pairs of matrices planning needs at most, without building any.

        What is computed needs none.
        Where customers ask for a setup, ways back to trucks are apart from those to customers;
        where profiles may have roads, equal speeds make no equal legs.
        """
        request = self._request
        sets_up = any(customer.setup_duration for customer in request.customers)
        flown = {self._flying(kind, each) for kind in request.fleet for each in _all_flyers(kind)}
        driven = len(self._stated(self._keys() - flown))
        flown = self._stated(flown)
        if on_roads and self._ground.is_geographic and request.roads != "none":
            driven = max(driven, len({(kind.profile, avoided(kind)) for kind in request.fleet
                                      if not kind.flies}))
        return driven + len(flown) + (len(flown) if sets_up else 0)

    def expect_legs(self) -> None:
        """Make sure that there is time to build all matrices, if none is flown around areas.

        Where legs are computed, time for what is done for each place before a search begins.

        Raises
        ------
        RequestError
            If the work is to end.
        """
        keys = self._keys()
        stated = self._stated(keys)
        if len(stated) < len(keys):
            replace(self._preparing, work="Plans of so many places",
                    advice="send fewer customers").expect(COMPUTED * len(self._places))
        if not stated:
            self._preparing.pause()
            return
        flights = [max(1, len(key.winds)) for key in stated if key.means == "flight"]
        self._preparing.expect(legs_seconds(len(self._places), len(stated) - len(flights),
                                            sum(flights),
                                            self._ground.is_geographic))

    def built(self) -> tuple[Travel, ...]:
        """Return the matrices built so far."""
        return tuple(self._travels)

    def lack_ways(self, used: Collection[int]) -> bool:
        """Tell whether any of some matrices has legs that aren't there."""
        return any(self._travels[index].lacks_ways() for index in used)

    def drive(self, vehicle_type: VehicleTypeInput) -> tuple[int, SpeedProfile | None]:
        """Return the index of the trucks' matrices, and their speeds by time of day."""
        key, profile = self._driving(vehicle_type)
        return self._at(key), profile

    def fly(self, kind: VehicleTypeInput, drones: DronesInput) -> int:
        """Return the index of the matrices of a type's drones."""
        return self._at(self._flying(kind, drones))

    def closings(self, flyer: Flyer) -> Closings:
        """Return when nothing may fly to or from zones with hours."""
        if not self._meets_zones(flyer):
            return ()
        return self._ground.closed(flyer.altitude).closings()

    def zones(self) -> IntArray | None:
        """Return the (node,) zones with hours that hold each node, as bits; None: there are none.
        """
        altitudes = sorted({flyer.altitude for kind in self._request.fleet
                            for flyer in _all_flyers(kind) if self._meets_zones(flyer)})
        found = self._ground.zones_with_hours(altitudes) if altitudes else None
        if found is None or self._nowhere is None:
            return found
        return np.insert(found, self._nowhere, 0)

    def _meets_zones(self, flyer: Flyer) -> bool:
        return bool(self._ground.zones) and self._matrix(flyer.profile) is None

    def straight(self) -> int:
        """Return the index of matrices whose distances are straight."""
        return self._at(STRAIGHT)

    def origins(self) -> tuple[LegOrigin, ...]:
        """Return what the legs of each profile are made of, trucks' first."""
        fleet = self._request.fleet
        driven = [(kind.profile, avoided(kind) if self._is_on_roads(kind) else ())
                  for kind in fleet if not kind.flies]
        origins = [self._origin(*how) for how in dict.fromkeys(driven)]
        flown = {flyer.profile: LegOrigin(
                     flyer.profile, "flight" if self._matrix(flyer.profile) is None else "matrix")
                 for kind in fleet for flyer in kind.flyers}
        return (*origins, *(origin for origin in flown.values() if origin not in origins))

    def _origin(self, profile: str, avoid: tuple[Avoided, ...]) -> LegOrigin:
        stated = self._request.roads
        if self._matrix(profile) is not None:
            return LegOrigin(profile, "matrix")
        if not self._ground.is_geographic:
            return LegOrigin(profile, "straight")
        if not self._has_roads(profile):
            return LegOrigin(profile, "great_circle",
                             note=AS_ASKED if stated == "none" else AS_THE_CROW_FLIES)
        legs = self._legs_on_roads(profile, avoid)
        detour = stated.detour if isinstance(stated, RoadsInput) and legs.estimated else None
        return LegOrigin(profile, "roads", legs.engine, legs.estimated, detour, legs.farthest_m,
                         legs.note, avoid)

    def estimates(self) -> Estimates | None:
        """Return what is estimated of the legs on roads until a plan drives them."""
        travels = {}
        for key, index in self._index.items():
            far = self._road_legs[key.profile, key.avoid].far if key.means == "road" else None
            if far is not None:
                travels[index] = FarTravel(far, key.speed, self._travels[index])
        return Estimates(travels, self._nowhere) if travels else None

    def coordinates(self) -> FloatArray:
        """Return the (node, 2) coordinates that the policy sees, in any planar unit."""
        nowhere = self._nowhere
        if all(place.location is not None for place in self._places):
            points = self._ground.points_m
        else:
            duration = self._travels[0].duration[:]
            if nowhere is not None:
                duration = np.delete(np.delete(duration, nowhere, 0), nowhere, 1)
            there_is = duration < MAX_QUANTITY
            points = embed(np.where(there_is, duration, duration.max(where=there_is, initial=0)))
        # Whoever ends anywhere is seen to do so amid all places.
        return points if nowhere is None else np.insert(points, nowhere, points.mean(axis=0), 0)

    def _keys(self) -> set[_Key]:
        fleet = self._request.fleet
        measured = {STRAIGHT for kind in fleet for flyer in _all_flyers(kind)
                    if flyer.max_range is not None}
        return ({self._driving(kind)[0] for kind in fleet} | measured
                | {self._flying(kind, each) for kind in fleet for each in _all_flyers(kind)})

    def _stated(self, keys: set[_Key]) -> set[_Key]:
        """Return those of which there are matrices."""
        return {key for key in keys if not self._is_computed(key)}

    def _is_computed(self, key: _Key) -> bool:
        """Tell whether legs are computed where they are looked up."""
        return (key.means == "drive" and not key.tabled and len(self._places) > COMPUTED_FROM
                and fits(self._points.longest(), key.speed, key.climb))

    @cached_property
    def _points(self) -> Points:
        """Where nodes are."""
        points = self._ground.points
        if self._nowhere is None:
            return points
        return replace(points, at=np.insert(points.at, self._nowhere, np.nan, axis=0))

    def _driving(self, vehicle_type: VehicleTypeInput) -> tuple[_Key, SpeedProfile | None]:
        if vehicle_type.flies:
            return self._flying(vehicle_type, vehicle_type), None
        matrix = self._matrix(vehicle_type.profile)
        usual = vehicle_type.speed_kmh or DEFAULT_TRUCK_SPEED_KMH
        on_roads = self._is_on_roads(vehicle_type)
        scale = usual if matrix is None and not on_roads else 1.0

        def key_at(speed: float) -> _Key:
            return (self._on_roads(vehicle_type, speed, usual) if on_roads
                    else self._driving_at(vehicle_type.profile, speed))

        if not vehicle_type.speed_profile:
            return key_at(scale), None
        changes = [
            (thousandths(change.from_time),
             scale * (change.factor or (change.speed_kmh or usual) / usual))
            for change in vehicle_type.speed_profile
        ]
        fastest, profile = speed_profile(scale, changes)
        return key_at(fastest), profile

    def _flying(self, kind: VehicleTypeInput, drones: Flyer) -> _Key:
        winds = self.winds.flown(kind, drones)
        blows = any(speed for speed, _ in winds or self.winds.steady)
        speed, climb = drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH, climb_duration(drones)
        if self._matrix(drones.profile) is not None:
            key = self._driving_at(drones.profile, 1.0)
        elif not blows and not self._ground.has_areas(drones.altitude):
            key = self._driving_at(drones.profile, speed)._replace(climb=climb)
        else:
            altitude = drones.altitude if self._ground.zones else 0.0
            key = _Key("flight", "", speed, climb, altitude=altitude, winds=winds)
        return key._replace(flown=self._nowhere is not None, tabled=_is_handled(drones))

    def _driving_at(self, profile: str, speed: float) -> _Key:
        return (_Key("drive", "", speed) if self._matrix(profile) is None
                else _Key("matrix", profile, speed))

    def _has_roads(self, profile: str) -> bool:
        return (self._ground.is_geographic and self._request.roads != "none"
                and profile in self._roads.profiles)

    def _is_on_roads(self, kind: VehicleTypeInput) -> bool:
        """Tell whether trucks of a type drive on roads."""
        return self._matrix(kind.profile) is None and self._has_roads(kind.profile)

    def _on_roads(self, kind: VehicleTypeInput, speed: float, usual_kmh: float) -> _Key:
        stated = self._request.roads
        falls_back = isinstance(stated, RoadsInput) and stated.fallback is not None
        return _Key("road", kind.profile, speed, avoid=avoided(kind),
                    estimated_kmh=usual_kmh if falls_back else 0.0)

    def _matrix(self, profile: str) -> MatrixInput | None:
        return (self._request.matrices or {}).get(profile)

    def _at(self, key: _Key) -> int:
        """Return the index of a pair of matrices, which is built the first time."""
        if key not in self._index:
            self._index[key] = len(self._travels)
            self._travels.append(self._computed(key) if self._is_computed(key)
                                 else self._with_nowhere(key))
        return self._index[key]

    def _computed(self, key: _Key) -> Travel:
        nowhere = UNREACHABLE if key.flown else 0
        return Travel.along(StraightLegs(self._points, key.speed, key.climb, nowhere))

    def _with_nowhere(self, key: _Key) -> Travel:
        travel = self._build(key)
        if self._nowhere is None:
            return travel
        return with_nowhere(travel, self._nowhere, key.flown)

    def _build(self, key: _Key) -> Travel:
        self._preparing.pause()
        if key.climb:
            return longer_legs(self._build(key._replace(climb=0)), key.climb)
        matrix = self._matrix(key.profile) if key.means == "matrix" else None
        if matrix is not None:
            durations = self._at_places(matrix.durations)
            durations /= key.speed
            distances = (self._ground.legs_m if matrix.distances is None
                         else self._at_places(matrix.distances))
            return matrix_travel(*_without_ways(durations, distances), self._preparing.pause)
        if key.means == "road":
            return self._build_on_roads(key)
        if key.means == "drive":
            return truck_travel(self._ground.legs_m, key.speed, self._preparing.pause)
        legs = self._ground.flights(key.altitude).legs(key.speed, key.winds)
        return flight_travel(*legs, self._preparing.pause)

    def _build_on_roads(self, key: _Key) -> Travel:
        legs = self._legs_on_roads(key.profile, key.avoid)
        durations, distances = legs.durations_s, legs.distances_m
        unknown = np.isnan(durations)
        if unknown.any():
            # Estimated, unless only drones go there: then no vehicle type drives these legs.
            stated = self._request.roads
            detour = stated.detour if isinstance(stated, RoadsInput) else 1.0
            metres = self._ground.legs_m * detour
            speed = key.estimated_kmh or DEFAULT_TRUCK_SPEED_KMH
            durations = np.where(unknown, metres * SECONDS_PER_METRE / speed, durations)
            distances = np.where(unknown, metres, distances)
        return matrix_travel(durations / key.speed, distances, self._preparing.pause)

    def _legs_on_roads(self, profile: str, avoid: tuple[Avoided, ...]) -> RoadLegs:
        how = profile, avoid
        if how not in self._road_legs:
            self._road_legs[how] = road_legs(self._roads, profile, avoid, self._placed,
                                             self._ground, self._preparing)
        return self._road_legs[how]

    def _at_places(self, table: Sequence[Row]) -> FloatArray:
        """Return a client's matrix with one row and column per node.

        Whoever stays at a node travels nothing, whatever the diagonal says; between two nodes in
        the same row it counts.
        """
        indices = [place.location_index or 0 for place in self._places]
        legs = np.empty((len(indices), len(indices)))
        for row, index in zip(legs, indices, strict=True):
            row[:] = table[index][indices]
        np.fill_diagonal(legs, 0.0)
        return legs
