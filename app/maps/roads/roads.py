"""The roads that a service has, by profile: what plans ask for legs, lines and addresses."""

import time
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from math import inf
from types import MappingProxyType

import numpy as np

from app.maps.addresses.addresses import NO_ADDRESSES, Addresses
from app.maps.airspace.zone import Zone
from app.maps.remote.asking import ShouldStop
from app.maps.roads.caching import DECIMALS, TableCache, part_of
from app.maps.roads.engine import USUAL, Block, Driving, RoadEngine, RoadRoute, RoadTable
from app.maps.roads.nearness import FULL_UP_TO, Nearness
from model.problem import FloatArray

UNKNOWN_BUILD_SECONDS = 3600
"""For how long tables are kept of a map whose state its server doesn't tell."""


class Roads:
    """Engines by profile, and a cache of what they answered.

    Parameters
    ----------
    engines
        By the name that requests use.
    cache
        Where tables are kept.
    origins
        What tells an engine's map from those of others, beside its build.
    starts
        Have engines begin to get ready.
    full_up_to
        Most places of a request of which plans have all legs from the start.
    addresses
        The geocoders that the service has beside them.
    zones
        Those of the airspace that hold for all requests.
    """

    def __init__(self, engines: Mapping[str, RoadEngine], cache: TableCache | None = None,
                 origins: Mapping[str, str] = MappingProxyType({}),
                 starts: tuple[Callable[[], None], ...] = (),
                 full_up_to: float = FULL_UP_TO,
                 addresses: Addresses = NO_ADDRESSES,
                 zones: tuple[Zone, ...] = ()) -> None:
        self.addresses = addresses
        self.zones = zones
        self._engines = engines
        self._origins = origins
        self._cache = TableCache() if cache is None else cache
        self._starts = starts
        self.full_up_to = full_up_to

    @property
    def profiles(self) -> frozenset[str]:
        """Those that have roads."""
        return frozenset(self._engines)

    def engine_name(self, profile: str) -> str:
        """Return what answers for a profile."""
        return self._engines[profile].name

    def with_all_legs(self) -> "Roads":
        """Return the same roads for who asks what legs nobody drives yet would come to."""
        return Roads(self._engines, self._cache, self._origins, self._starts, inf,
                     zones=self.zones)

    def start(self) -> None:
        """Get ready in the background. In place."""
        for start in self._starts:
            start()

    def close(self) -> None:
        """End what was started. In place."""
        self.addresses.close()
        for engine in {id(engine): engine for engine in self._engines.values()}.values():
            engine.close()

    def table(self, profile: str, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False, driving: Driving = USUAL) -> RoadTable:
        """Return the drives between (place, 2) longitudes and latitudes, not to be changed.

        Parameters
        ----------
        profile
            One that has roads.
        until
            When to have ended at the latest, on `time.perf_counter`.
        driving
            How one drives, and to which side of each place.

        Raises
        ------
        RoadsError
            If there is no answer that can be relied on by then.
        """
        engine = self._engines[profile]
        places = np.round(lon_lat, DECIMALS)
        scope = self._scope(profile, engine, driving)
        known = self._cache.get(scope, places, driving.curb)
        if known is None:
            known = (self._extended(engine, scope, places, until, should_stop, driving)
                     or engine.table(places, until, should_stop, driving=driving))
            self._cache.put(scope, places, known, driving.curb)
        return known

    def near_legs(self, profile: str, lon_lat: FloatArray, parts: Nearness, until: float,
                  should_stop: ShouldStop = lambda: False,
                  driving: Driving = USUAL) -> RoadTable:
        """Return the legs that are wanted of so many places, others nan; raises as `table` does."""
        engine = self._engines[profile]
        places = np.round(lon_lat, DECIMALS)
        # Of other places, others are near: such a table is of use for these alone.
        near = sha256(places.tobytes()).hexdigest()
        scope = f"{self._scope(profile, engine, driving)} near {near}"
        known = self._cache.get(scope, places, driving.curb)
        if known is None:
            known = engine.table(places, until, should_stop, parts.wanted(), driving)
            self._cache.put(scope, places, known, driving.curb)
        return known

    def some_legs(self, profile: str, lon_lat: FloatArray, wanted: Sequence[Block], until: float,
                  should_stop: ShouldStop = lambda: False,
                  driving: Driving = USUAL) -> RoadTable:
        """Return some legs, others nan; raises as `table` does."""
        return self._engines[profile].table(np.round(lon_lat, DECIMALS), until, should_stop, wanted,
                                            driving)

    def _scope(self, profile: str, engine: RoadEngine, driving: Driving) -> str:
        """Return what decides an engine's answers beside the places."""
        build = engine.build() or f"at {time.time() // UNKNOWN_BUILD_SECONDS:.0f}"
        avoiding = ("without", *driving.avoid) if driving.avoid else ()
        return " ".join((engine.name, profile, self._origins.get(profile, ""), build, *avoiding))

    def _extended(self, engine: RoadEngine, scope: str, places: FloatArray, until: float,
                  should_stop: ShouldStop, driving: Driving) -> RoadTable | None:
        """Return a table of which a part is known: only the rest is asked for.

        None if too little is known, or where a place lies on the road hangs on the others.
        """
        found = self._cache.overlap(scope, places, driving.curb)
        if found is None:
            return None
        table, rows = found
        new, old = np.flatnonzero(rows < 0), np.flatnonzero(rows >= 0)
        known = part_of(table, rows[old])
        more = engine.table(places, until, should_stop,
                            (Block(new, np.arange(len(places))), Block(old, new)), driving)
        if not np.array_equal(more.snapped[old], known.snapped, equal_nan=True):
            return None
        both = np.ix_(old, old)
        more.durations_s[both], more.distances_m[both] = known.durations_s, known.distances_m
        return more

    def route(self, profile: str, lon_lat: FloatArray, until: float,
              driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along (point, 2) longitudes and latitudes; raises as `table` does."""
        return self._engines[profile].route(np.round(lon_lat, DECIMALS), until, driving)


NO_ROADS = Roads({})
