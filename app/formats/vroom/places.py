"""Where everything is, and the legs between: VROOM's matrices, or great circles."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from app.formats.vroom.errors import INPUT, TOO_LARGE, VroomError
from app.formats.vroom.roads import ask_roads
from app.formats.vroom.schemas import (
    Coordinates, Table, VroomMatricesInput, VroomPlaceInput, VroomRequest,
)
from app.formats.vroom.tasks import tasks_of
from app.maps.roads.roads import NO_ROADS, Roads
from app.requests.conversion.preparing import UNHURRIED, Preparing
from app.requests.conversion.work import legs_seconds
from app.schemas.limits import MAX_LEGS
from model.dialects.vroom.places import NOWHERE, ProfileLegs, Sites
from model.problem import FloatArray, IntArray
from model.travel.matrices import great_circle_distances, local_coordinates

_METRES_PER_SECOND = 3.6
"""km/h of a metre a second."""


@dataclass(frozen=True, eq=False)
class StatedPlaces(Sites):
    """The places of a request, and how it and the reply tell of them."""

    coordinates: tuple[Coordinates | None, ...]  # (site,)
    indices: tuple[int | None, ...]  # (site,) row in the request's matrices
    tells_distances: bool  # whether the reply does
    on_roads: frozenset[str] = frozenset()  # profiles whose legs are drives on the service's roads


Place = tuple[Coordinates | None, int | None]


def find_places(request: VroomRequest, speeds: Mapping[str, float],
                max_legs: int = MAX_LEGS, preparing: Preparing = UNHURRIED,
                roads: Roads = NO_ROADS) -> StatedPlaces:
    """Number the places of a request and find the legs between them.

    Parameters
    ----------
    request
        Valid but for its places and matrices.
    speeds
        km/h by profile, for legs that no matrix states.
    max_legs
        Most legs of all profiles together.
    preparing
        May end the work.
    roads
        Where legs come from that no matrix states, for profiles that have any.

    Raises
    ------
    VroomError
        If a place or a matrix is missing or wrong, there are too many legs, or no way.
    RequestError
        If the work is to end.
    """
    matrices = _stated_matrices(request)
    numbers: dict[Coordinates | int, int] = {}
    known: list[Place] = []
    tasks = [task.stated for task in tasks_of(request)]
    by_index = _states_indices(request, tasks, matrices)

    def number(place: Place) -> int:
        key = place[1] if by_index else place[0]
        if key is None:
            return NOWHERE
        if key not in numbers:
            numbers[key] = len(known)
            known.append(place)
        return numbers[key]

    vehicles = request.vehicles
    starts = np.array([number((v.start, v.start_index)) for v in vehicles], np.int64)
    ends = np.array([number((v.end, v.end_index)) for v in vehicles], np.int64)
    jobs = np.array([number((j.location, j.location_index)) for j in tasks], np.int64)
    profiles = list(dict.fromkeys(vehicle.profile for vehicle in vehicles))
    if len(profiles) * len(known)**2 > max_legs:
        raise VroomError(TOO_LARGE, f"Too many legs: {len(profiles)} profiles and {len(known)} "
                                    f"places, maximum is {max_legs} legs (TANDEM_MAX_LEGS)")
    preparing.expect(legs_seconds(len(known), len(profiles), 0, len(matrices) < len(profiles)))
    finder = _LegFinder(request, matrices, known, speeds, preparing, roads)
    legs = {profile: finder.find(profile) for profile in profiles}
    points = [coordinates for coordinates, _ in known]
    return StatedPlaces(jobs, starts, ends, _on_map(points), legs, tuple(points),
                        tuple(index for _, index in known), finder.tells_distances,
                        frozenset(filter(finder.is_on_roads, profiles)))


def _on_map(points: Sequence[Coordinates | None]) -> FloatArray | None:
    """Return where points are in metres, None if some aren't known."""
    known = [point for point in points if point is not None]
    if len(known) < len(points) or not _on_globe(known):
        return None
    return local_coordinates(np.array(known, np.float64))


def _stated_matrices(request: VroomRequest) -> Mapping[str, VroomMatricesInput]:
    if request.matrices is not None:
        return request.matrices
    if request.matrix is None:
        return {}
    # It was read already; what is read are lists.
    return {"car": VroomMatricesInput.model_construct(durations=request.matrix)}


def _states_indices(request: VroomRequest, tasks: Sequence[VroomPlaceInput],
                    matrices: Mapping[str, VroomMatricesInput]) -> bool:
    """Tell whether places are rows of matrices: all of them are, or none."""
    stated = [job.location_index is not None for job in tasks]
    for vehicle in request.vehicles:
        sides = [index is not None
                 for point, index in ((vehicle.start, vehicle.start_index),
                                      (vehicle.end, vehicle.end_index))
                 if point is not None or index is not None]
        if len(set(sides)) > 1:
            raise VroomError(INPUT, "Missing start_index or end_index.")
        stated += sides
    if any(stated) != all(stated) or (matrices and not any(stated)):
        raise VroomError(INPUT, "Missing location index.")
    if any(stated) and not matrices:
        raise VroomError(INPUT, "Unexpected location index while no custom matrices provided.")
    return any(stated)


class _LegFinder:
    """Finds the legs of profiles."""

    def __init__(self, request: VroomRequest, matrices: Mapping[str, VroomMatricesInput],
                 known: list[Place], speeds: Mapping[str, float], preparing: Preparing,
                 roads: Roads) -> None:
        self._matrices = matrices
        self._speeds = speeds
        self._preparing = preparing
        self._roads = roads
        self._known = known
        self._per_km = {v.profile for v in request.vehicles if v.costs.per_km > 0}
        self._limited = {v.profile for v in request.vehicles if v.max_distance is not None}
        self._geometry = request.options.g
        states_distances = any(m.distances is not None for m in matrices.values())
        self.tells_distances = self._geometry or states_distances or bool(self._per_km)
        for profile in dict.fromkeys(v.profile for v in request.vehicles):
            if states_distances and self._stated(profile).distances is None:
                raise VroomError(INPUT, f"Missing distances matrix for {profile} profile.")
        if self._geometry and any(point is None for point, _ in known):
            raise VroomError(INPUT, "Route geometry request with missing coordinates.")

    def find(self, profile: str) -> ProfileLegs:
        """Return the legs of a profile."""
        stated = self._stated(profile)
        costs = None if stated.costs is None else self._table(profile, "costs", stated.costs)
        if stated.durations is None:
            if stated.distances is not None:
                raise VroomError(INPUT, "Custom matrix provided for distances but not for "
                                        f"durations for {profile} profile.")
            if self.is_on_roads(profile):
                table = ask_roads(self._roads, profile, self._lon_lat, self._preparing)
                return ProfileLegs(_whole(table.durations_s), _whole(table.distances_m), costs,
                                   True)
            metres = self._great_circles
            speed = self._speed(profile) / _METRES_PER_SECOND
            return ProfileLegs(_whole(metres / speed), _whole(metres), costs, True)
        durations = self._table(profile, "durations", stated.durations)
        if stated.distances is not None:
            distances = self._table(profile, "distances", stated.distances)
            return ProfileLegs(durations, distances, costs, True)
        if self._geometry or profile in self._per_km or (
                profile in self._limited and all(point is not None for point, _ in self._known)):
            return ProfileLegs(durations, _whole(self._great_circles), costs, True)
        return ProfileLegs(durations, np.zeros_like(durations), costs, False)

    def is_on_roads(self, profile: str) -> bool:
        """Tell whether the service's roads tell the legs of a profile."""
        return profile in self._roads.profiles and self._stated(profile).durations is None

    def _stated(self, profile: str) -> VroomMatricesInput:
        return self._matrices.get(profile, VroomMatricesInput())

    def _speed(self, profile: str) -> float:
        if profile not in self._speeds:
            stated = ", ".join(sorted(self._speeds))
            raise VroomError(INPUT, f"Invalid profile: {profile}. State matrices.{profile}, or use "
                                    f"a profile whose speed is known: {stated}.")
        return self._speeds[profile]

    @cached_property
    def _great_circles(self) -> FloatArray:
        return great_circle_distances(self._lon_lat, self._preparing.pause)

    @cached_property
    def _lon_lat(self) -> FloatArray:
        points = [point for point, _ in self._known if point is not None]
        if len(points) < len(self._known):
            raise VroomError(INPUT, "Missing coordinates for routing engine.")
        if not _on_globe(points):
            raise VroomError(INPUT, "Coordinates are [longitude, latitude] within 180 and 90 "
                                    "degrees: correct them, or swap the two.")
        return np.array(points, np.float64)

    def _table(self, profile: str, name: str, table: Table) -> IntArray:
        """Return a matrix with a row and a column for each site."""
        if not table:
            raise VroomError(INPUT, f"Empty {name} matrix for {profile} profile.")
        if any(len(row) != len(table) for row in table):
            raise VroomError(INPUT, "Unexpected matrix line length.")
        rows = [index or 0 for _, index in self._known]
        if max(rows) >= len(table):
            raise VroomError(INPUT, f"location_index exceeding {name} matrix size for {profile} "
                                    "profile.")
        return np.array([table[row][rows] for row in rows], np.int64)


def _on_globe(points: Iterable[Coordinates]) -> bool:
    """Tell whether points can be longitudes and latitudes."""
    return all(abs(longitude) <= 180 and abs(latitude) <= 90 for longitude, latitude in points)


def _whole(values: FloatArray) -> IntArray:
    whole: IntArray = np.rint(values).astype(np.int64)
    return whole
