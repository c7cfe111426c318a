"""What warnings look at in a request: where everything is, and when, as arrays."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from app.requests.conversion.places import stands_of
from app.schemas.customer import CustomerInput, TimeWindowInput
from app.schemas.fields import point_of
from app.schemas.request import PlanRequest
from app.schemas.vehicle import DEFAULT_TRUCK_SPEED_KMH, VehicleTypeInput
from model.problem import BoolArray, FloatArray

SLOWEST_KMH = 10.0
"""Published instances are planned at one unit a second, 3.6 km/h; nothing that drives is as slow.
"""

ROAD_KMH = 100.0
"""For how fast vehicles are taken where roads say it."""

EARTH_M = 6_371_000.0

METRES_A_SECOND = 3.6


@dataclass(frozen=True)
class Survey:
    """A valid request, and what of it is computed once for all warnings.

    Parameters
    ----------
    road_profiles
        Profiles for which the service has roads.
    """

    request: PlanRequest
    road_profiles: frozenset[str] = frozenset()

    @cached_property
    def is_geographic(self) -> bool:
        """Whether places are on the globe."""
        return self.request.coordinate_system == "geographic"

    @cached_property
    def customers(self) -> list[CustomerInput]:
        """All of them."""
        return self.request.customers

    @cached_property
    def located_types(self) -> list[VehicleTypeInput]:
        """Vehicle types whose legs are made from locations."""
        return list(filter(self.is_located, self.request.fleet))

    def is_located(self, kind: VehicleTypeInput) -> bool:
        """Tell whether a vehicle type's legs are made from locations."""
        return kind.profile not in (self.request.matrices or {})

    @cached_property
    def points(self) -> FloatArray:
        """(customer, 2) as stated, nan where nothing is."""
        return _points([point_of(customer.location) for customer in self.customers])

    @cached_property
    def bases(self) -> FloatArray:
        """(place, 2) depots, and where else vehicles begin."""
        stands = [point_of(stand.place.location) for kind in self.request.fleet
                  for stand in stands_of(kind) if stand.depot.kind == "start"]
        stated = [*(point_of(depot.location) for depot in self.request.depots), *stands]
        return _points([location for location in stated if location is not None])

    def metres_to(self, points: FloatArray) -> FloatArray:
        """Return the metres from the nearest base to each of some points, as the crow flies."""
        if not len(self.bases):
            return np.full(len(points), np.nan)
        nearest = np.full(len(points), np.inf)
        for base in self.bases:
            np.minimum(nearest, self._metres(base, points), out=nearest)
        return nearest

    def _metres(self, base: FloatArray, points: FloatArray) -> FloatArray:
        if not self.is_geographic:
            return np.hypot(*(points - base).T) * self.request.planar_unit
        (lon, lat), (lons, lats) = np.radians(base), np.radians(points).T
        half = (np.sin((lats - lat) / 2) ** 2
                + np.cos(lats) * np.cos(lat) * np.sin((lons - lon) / 2) ** 2)
        return 2 * EARTH_M * np.arcsin(np.sqrt(np.clip(half, 0.0, 1.0)))

    @cached_property
    def metres(self) -> FloatArray:
        """(customer,) from the nearest base, nan where unknown."""
        return self.metres_to(self.points)

    @cached_property
    def fastest_kmh(self) -> float:
        """How fast the fastest vehicles are whose legs are made from locations."""
        return max(map(self.speed_kmh, self.located_types), default=DEFAULT_TRUCK_SPEED_KMH)

    def speed_kmh(self, kind: VehicleTypeInput) -> float:
        """Return how fast vehicles of a type are at most, of one that drives as locations say."""
        if self.is_geographic and self.request.roads != "none" and (
                kind.profile in self.road_profiles):
            return ROAD_KMH
        usual = kind.speed_kmh or DEFAULT_TRUCK_SPEED_KMH
        changes = [change.speed_kmh or usual * (change.factor or 1.0)
                   for change in kind.speed_profile]
        return max([usual, *changes])

    @cached_property
    def is_lifelike(self) -> bool:
        """Whether seconds and metres can be meant: no published instance in units of its own."""
        if not self.located_types:
            return self.is_geographic
        return self.is_geographic or self.fastest_kmh >= SLOWEST_KMH

    @cached_property
    def seconds(self) -> FloatArray:
        """(customer,) that the shortest drive from a base takes, nan where unknown."""
        found = np.full(len(self.customers), np.inf)
        if self.located_types:
            found = self.metres * METRES_A_SECOND / self.fastest_kmh
        for row in self._matrix_rows:
            np.fmin(found, row, out=found)
        return np.where(np.isfinite(found), found, np.nan)

    @cached_property
    def _matrix_rows(self) -> list[FloatArray]:
        """Durations from each depot to each customer, by matrix."""
        matrices = self.request.matrices or {}
        used = {kind.profile for kind in self.request.fleet} & set(matrices)
        columns = [customer.location_index or 0 for customer in self.customers]
        return [np.array(matrices[name].durations[depot.location_index or 0], float)[columns]
                for name in sorted(used) for depot in self.request.depots]

    @cached_property
    def demand(self) -> FloatArray:
        """(customer, dimension) as stated."""
        return np.array([customer.demand for customer in self.customers], float)

    @cached_property
    def pickup(self) -> FloatArray:
        """(customer, dimension) as stated."""
        if all(customer.pickup is None for customer in self.customers):
            return np.zeros_like(self.demand)
        return np.array([customer.pickup or [0.0] * len(customer.demand)
                         for customer in self.customers], float)

    @cached_property
    def shortest_service(self) -> FloatArray:
        """(customer,) by whatever vehicle serves it fastest, at whichever of its places."""
        return np.array([min([customer.service_duration,
                              *customer.service_duration_by_type.values(),
                              *(place.service_duration for place in customer.alternatives
                                if place.service_duration is not None)])
                         for customer in self.customers], float)

    @cached_property
    def windows(self) -> list[list[TimeWindowInput]]:
        """Each customer's."""
        return [customer.time_windows or [customer.time_window] for customer in self.customers]

    @cached_property
    def earliest(self) -> FloatArray:
        """(customer,) when its first window opens."""
        return np.array([windows[0].earliest for windows in self.windows], float)

    @cached_property
    def latest(self) -> FloatArray:
        """(customer,) when its last window closes, inf if never."""
        return np.array([np.inf if windows[-1].latest is None else windows[-1].latest
                         for windows in self.windows], float)

    @cached_property
    def has_end(self) -> BoolArray:
        """(customer,) whether its windows close."""
        return np.isfinite(self.latest)


def _points(locations: list[tuple[float, float] | None]) -> FloatArray:
    nowhere = (np.nan, np.nan)
    return np.array([location or nowhere for location in locations], float).reshape(-1, 2)
