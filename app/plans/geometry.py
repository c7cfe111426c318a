"""The ways of a plan's legs as encoded polylines: what a map draws."""

import time
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from app.maps.roads.engine import Driving
from app.maps.roads.roads import NO_ROADS, Roads
from app.plans.carried import named
from app.plans.road_lines import Line, RoadLines, encoded
from app.requests.conversion.ground import Ground
from app.requests.conversion.launches import drones_named
from app.requests.conversion.leg_origins import LegOrigin
from app.requests.conversion.places import PlacedRequest, avoided
from app.requests.conversion.winds import Winds
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, DronesInput, Flyer
from app.schemas.vehicle import VehicleTypeInput
from model.problem import FloatArray

Data = dict[str, Any]


class Geometry:
    """The ways between the places of a request.

    Parameters
    ----------
    request
        A valid one.
    ground
        Its places and areas.
    roads
        Those that the service has.
    legs
        What the request's legs are made of.
    """

    def __init__(self, placed: PlacedRequest, ground: Ground, roads: Roads = NO_ROADS,
                 legs: Sequence[LegOrigin] = ()) -> None:
        request = placed.request
        self._types = {kind.id: kind for kind in request.fleet}
        self._matrices = frozenset(request.matrices or {})
        self._nodes = {name: node for node, name in enumerate(placed.names)}
        self._locations: list[tuple[float, float]] | None = (
            [(float(x), float(y)) for x, y in ground.locations]
            if all(place.location is not None for place in ground.places) else None)
        self._curb = placed.curb
        self._winds = Winds(request)
        self._detours = {flyer.altitude: ground.detours(flyer.altitude)
                         for kind in request.fleet for flyer in kind.flyers
                         if flyer.profile not in self._matrices}
        self._roads = RoadLines(roads, {origin.profile for origin in legs if origin.by == "roads"})

    def add(self, reply: Data, until: float) -> None:
        """Add the lines of all legs to a reply. In place.

        Parameters
        ----------
        reply
            What `app.plans.replies` writes.
        until
            When roads, and flights around areas, are looked for no more, on `time.perf_counter`;
            they are null.
        """
        for route in reply["routes"]:
            kind = self._types[route["type"]]
            for trip in route["trips"]:
                stops = [stop for stop in trip["stops"] if stop["kind"] != "break"]
                places = _places(trip["stops"])
                nodes = [self._nodes[named(stop)] for stop in stops]
                driven = (self._flown(nodes, kind, kind, until) if kind.flies
                          else self._driven(nodes, kind, until))
                for stop, line in zip(stops[1:], driven, strict=True):
                    stop["geometry"] = line
                for sortie in trip["sorties"]:
                    drones = drones_named(kind, sortie["drone"])
                    if drones is not None:
                        self._add_flights(sortie, [nodes[place] for place in places], kind, drones,
                                          until)

    def _add_flights(self, sortie: Data, stops: Sequence[int], kind: VehicleTypeInput,
                     drones: DronesInput, until: float) -> None:
        visits = sortie["customers"]
        nodes = [stops[sortie["launch_stop"]],
                 *(self._nodes[named(visit)] for visit in visits),
                 stops[sortie["recovery_stop"]]]
        *lines, last = self._flown(nodes, kind, drones, until)
        for visit, line in zip(visits, lines, strict=True):
            visit["geometry"] = line
        sortie["recovery_geometry"] = last

    def _driven(self, nodes: Sequence[int], kind: VehicleTypeInput,
                until: float) -> Iterable[Line]:
        if kind.profile not in self._roads.profiles or self._locations is None or len(nodes) < 2:
            return self._straight(nodes)
        curb = None if self._curb is None else self._curb[list(nodes)]
        return self._roads.along(kind.profile, [self._locations[node] for node in nodes], until,
                                 Driving(avoided(kind), curb))

    def _straight(self, nodes: Sequence[int]) -> Iterator[Line]:
        for start, end in pairwise(nodes):
            yield self._line(start, end)

    def _flown(self, nodes: Sequence[int], kind: VehicleTypeInput, drones: Flyer,
               until: float) -> Iterator[Line]:
        detours = self._detours.get(drones.altitude)
        if detours is None or drones.profile in self._matrices:
            yield from self._straight(nodes)
            return
        winds = self._winds.flown(kind, drones)
        speed = drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH
        for start, end in pairwise(nodes):
            if not detours.are_blocked(start, end):
                yield self._line(start, end)
            elif time.perf_counter() < until:
                yield self._line(start, end, detours.bends(start, end, speed, winds))
            else:
                yield None

    def _line(self, start: int, end: int, bends: FloatArray | Sequence[Any] = ()) -> Line:
        if self._locations is None:
            return None
        places = [self._locations[start], *((float(x), float(y)) for x, y in bends),
                  self._locations[end]]
        return encoded(places)


def _places(stops: Sequence[Data]) -> list[int]:
    """Return how many stops that are no breaks come before each; of a break, one less."""
    places, count = [], -1
    for stop in stops:
        count += stop["kind"] != "break"
        places.append(count)
    return places
