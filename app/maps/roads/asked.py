"""The roads and geocoders of another process, which has the connections, caches and turns."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

from app.maps.addresses.addresses import Addresses, LookedUp
from app.maps.airspace.zone import Zone
from app.maps.remote.asking import ShouldStop
from app.maps.roads.engine import USUAL, Block, Driving, RoadRoute, RoadTable
from app.maps.roads.nearness import Nearness
from app.maps.roads.roads import Roads
from app.serving.children.errors import ToldError, told
from model.problem import FloatArray

Ask = Callable[..., Any]
"""Returns the answer to a question: its name, and arguments."""


@dataclass(frozen=True)
class KnownRoads:
    """What is known of roads without asking."""

    engine_names: Mapping[str, str]  # by profile
    full_up_to: float
    geocoders: tuple[str, ...]
    zones: tuple[Zone, ...]

    @classmethod
    def of(cls, roads: Roads) -> "KnownRoads":
        """Return what is known of roads."""
        names = {profile: roads.engine_name(profile) for profile in roads.profiles}
        return cls(names, roads.full_up_to, roads.addresses.names, roads.zones)


def answers_of(roads: Roads) -> dict[str, Callable[..., Any]]:
    """Return who answers what `AskedRoads` ask; the last argument tells whether to stop."""
    def look_up(addresses: Sequence[str], until: float,
                should_stop: ShouldStop) -> tuple[LookedUp, ToldError | None]:
        found = roads.addresses.look_up(addresses, until, should_stop)
        return LookedUp(found.candidates), None if found.error is None else told(found.error)

    def table(profile: str, lon_lat: FloatArray, until: float, driving: Driving,
              should_stop: ShouldStop) -> RoadTable:
        return roads.table(profile, lon_lat, until, should_stop, driving)

    def near_legs(profile: str, lon_lat: FloatArray, parts: Nearness, until: float,
                  driving: Driving, should_stop: ShouldStop) -> RoadTable:
        return roads.near_legs(profile, lon_lat, parts, until, should_stop, driving)

    def some_legs(profile: str, lon_lat: FloatArray, wanted: Sequence[Block], until: float,
                  driving: Driving, should_stop: ShouldStop) -> RoadTable:
        return roads.some_legs(profile, lon_lat, wanted, until, should_stop, driving)

    def route(profile: str, lon_lat: FloatArray, until: float, driving: Driving,
              should_stop: ShouldStop) -> RoadRoute:
        return roads.route(profile, lon_lat, until, driving)

    return {"table": table, "near_legs": near_legs, "some_legs": some_legs, "route": route,
            "look_up": look_up}


class AskedRoads(Roads):
    """Roads that another process tells. Whether to stop is told there."""

    def __init__(self, known: KnownRoads, ask: Ask) -> None:
        super().__init__({}, full_up_to=known.full_up_to, zones=known.zones,
                         addresses=AskedAddresses(known.geocoders, ask))
        self._known = known
        self._ask = ask

    @property
    def profiles(self) -> frozenset[str]:
        """Those that have roads."""
        return frozenset(self._known.engine_names)

    def engine_name(self, profile: str) -> str:
        """Return what answers for a profile."""
        return self._known.engine_names[profile]

    def with_all_legs(self) -> Roads:
        """Return the same roads for who asks what legs nobody drives yet would come to."""
        return AskedRoads(KnownRoads(self._known.engine_names, inf, (), self.zones), self._ask)

    def table(self, profile: str, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between places."""
        table: RoadTable = self._ask("table", profile, lon_lat, until, driving)
        return table

    def near_legs(self, profile: str, lon_lat: FloatArray, parts: Nearness, until: float,
                  should_stop: ShouldStop = lambda: False,
              driving: Driving = USUAL) -> RoadTable:
        """Return the legs that are wanted of so many places, others nan."""
        table: RoadTable = self._ask("near_legs", profile, lon_lat, parts, until, driving)
        return table

    def some_legs(self, profile: str, lon_lat: FloatArray, wanted: Sequence[Block], until: float,
                  should_stop: ShouldStop = lambda: False,
              driving: Driving = USUAL) -> RoadTable:
        """Return some legs, others nan."""
        table: RoadTable = self._ask("some_legs", profile, lon_lat, wanted, until, driving)
        return table

    def route(self, profile: str, lon_lat: FloatArray, until: float,
              driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along points."""
        route: RoadRoute = self._ask("route", profile, lon_lat, until, driving)
        return route


class AskedAddresses(Addresses):
    """Geocoders that another process asks."""

    def __init__(self, names: tuple[str, ...], ask: Ask) -> None:
        super().__init__(())
        self._known = names
        self._ask = ask

    @property
    def names(self) -> tuple[str, ...]:
        """What the geocoders are called."""
        return self._known

    def look_up(self, addresses: Iterable[str], until: float,
                should_stop: ShouldStop = lambda: False,
                told: Callable[[], None] = lambda: None) -> LookedUp:
        """Return what addresses may mean."""
        found, error = self._ask("look_up", list(addresses), until)
        return LookedUp(found.candidates, None if error is None else error.again())
