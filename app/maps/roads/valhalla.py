"""Valhalla's HTTP interface.

It refuses a table with a place that no road is near, and a place may lie on several roads, of which
each drive takes the one that suits it. So where places lie is asked first.
"""

import json
from collections.abc import Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any, Literal
from urllib.parse import urlencode

import numpy as np
from pydantic import RootModel

from app.maps.remote.asking import RemoteCall, RemoteServer, ShouldStop
from app.maps.remote.errors import SourceError
from app.maps.roads.answers import (
    BlockAnswer, Numbers, Schema, among, blocks, expanded, joined, metres_between, numbers, read,
    stated_refusal,
)
from app.maps.roads.engine import (
    ROADS, USUAL, Block, Driving, NoWayError, RoadRoute, RoadsAnswerError, RoadsError, RoadTable,
    whole,
)
from app.maps.roads.lines import decoded, joined_route, route_of, stretches
from app.maps.roads.server import RoadServer
from model.problem import FloatArray

MAX_PLACES, MAX_POINTS = 50, 20
"""Origins and destinations of a table and points of a route that Valhalla takes by default."""

LOCATED_AT_ONCE = 500

BYTES_PER_LEG, BYTES_PER_SPOT, BYTES_BESIDES = 64, 65_536, 65_536
"""More than an answer holds for a leg of a table (both numbers), for a place's roads, and besides.
"""

BYTES_PER_ROUTE = 64 << 20
"""More than any route takes."""

UNCONNECTED, NO_EDGES, NO_PATH = 170, 171, 442
"""What Valhalla's errors for want of roads are called."""

METRES = 1_000.0
"""In the kilometres that it answers."""


class _Edge(Schema):
    correlated_lat: float
    correlated_lon: float


class _Spot(Schema):
    input_lat: float
    input_lon: float
    edges: list[_Edge] | None


class _Spots(RootModel[list[_Spot]]):
    """Where places lie, in their order."""


class _Numbers(Schema):
    durations: Numbers
    distances: Numbers


class _Table(Schema):
    sources_to_targets: _Numbers
    units: Literal["kilometers"]


class _Summary(Schema):
    time: float
    length: float


class _Leg(Schema):
    summary: _Summary
    shape: str


class _Trip(Schema):
    legs: list[_Leg]
    units: Literal["kilometers"]


class _Route(Schema):
    trip: _Trip


class _Status(Schema):
    tileset_last_modified: int


class _Refusal(Schema):
    error_code: int
    error: str = ""


class Valhalla:
    """Roads of one way to travel from Valhalla."""

    name = "valhalla"

    def __init__(self, server: RoadServer, costing: str = "auto",
                 parameters: Mapping[str, str] = MappingProxyType({})) -> None:
        """Ask a server; `parameters` are part of all addresses, such as a key."""
        self._server = server
        self._stated = f"?{urlencode(parameters)}" if parameters else ""
        self._costing = costing
        self._asking = RemoteServer(server, ROADS, _refusal)

    def build(self) -> str:
        """Return when the server's map was made."""
        return self._asking.state(RemoteCall(
            f"/status{self._stated}", lambda body: str(read(_Status, body).tileset_last_modified),
            BYTES_BESIDES))

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between places."""
        driving.require_usual("Valhalla")
        snapped, spread_m = self._located(lon_lat, until, should_stop)
        near = np.flatnonzero(np.isfinite(spread_m))
        places, spots = lon_lat[near], snapped[near]
        asked = whole(len(near)) if wanted is None else among(near, len(lon_lat), wanted)
        parts = blocks(asked, self._server.max_places)
        questions = [self._question(places, spots, block) for block in parts]
        answers = self._asking.ask(questions, until, should_stop)
        table = joined(places, zip(parts, answers, strict=True), spread_m[near])
        return expanded(table, near, len(lon_lat))

    def _located(self, lon_lat: FloatArray, until: float,
                 should_stop: ShouldStop) -> tuple[FloatArray, FloatArray]:
        """Return where places lie on the road, and how far from there drives may begin or end."""
        cuts = [lon_lat[begin:begin + LOCATED_AT_ONCE]
                for begin in range(0, len(lon_lat), LOCATED_AT_ONCE)]
        questions = [RemoteCall(
            f"/locate{self._stated}", partial(_spots, places),
            len(places) * BYTES_PER_SPOT + BYTES_BESIDES,
            self._body(locations=_locations(places), verbose=False)) for places in cuts]
        found = self._asking.ask(questions, until, should_stop)
        return (np.concatenate([np.empty((0, 2)), *(spots for spots, _ in found)]),
                np.concatenate([np.empty(0), *(spread for _, spread in found)]))

    def _question(self, places: FloatArray, spots: FloatArray,
                  block: Block) -> RemoteCall[BlockAnswer]:
        body = self._body(sources=_locations(places[block.origins]),
                          targets=_locations(places[block.destinations]),
                          units="kilometers", verbose=False)
        most = len(block.origins) * len(block.destinations) * BYTES_PER_LEG + BYTES_BESIDES
        return RemoteCall(f"/sources_to_targets{self._stated}", partial(_part, block, spots), most,
                          body, partial(_unconnected, block, spots))

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along points."""
        driving.require_usual("Valhalla")
        questions = []
        for stretch in stretches(len(lon_lat), self._server.max_points):
            points = lon_lat[stretch]
            body = self._body(locations=_locations(points), units="kilometers",
                              directions_type="none", shape_format="polyline6")
            questions.append(RemoteCall(f"/route{self._stated}", partial(_route, len(points)),
                                        BYTES_PER_ROUTE, body))
        return joined_route(self._asking.ask(questions, until))

    def _body(self, **stated: Any) -> bytes:
        return json.dumps({"costing": self._costing, **stated}).encode()

    def close(self) -> None:
        """Let go of connections."""
        self._asking.close()


def _locations(lon_lat: FloatArray) -> list[dict[str, float]]:
    return [{"lon": longitude, "lat": latitude} for longitude, latitude in lon_lat.tolist()]


def _spots(places: FloatArray, body: bytes) -> tuple[FloatArray, FloatArray]:
    spots = read(_Spots, body).root
    asked = np.array([(spot.input_lon, spot.input_lat) for spot in spots]).reshape(-1, 2)
    if asked.shape != places.shape or not np.allclose(asked, places, rtol=0, atol=1e-5):
        raise RoadsAnswerError("The server of roads answered other places than were asked for.")
    snapped, spread_m = np.full((len(places), 2), np.nan), np.full(len(places), np.nan)
    for place, spot in enumerate(spots):
        if spot.edges:
            edges = np.array([(edge.correlated_lon, edge.correlated_lat) for edge in spot.edges])
            snapped[place] = edges[0]
            spread_m[place] = metres_between(np.tile(edges[0], (len(edges), 1)), edges).max()
    return snapped, spread_m


def _part(block: Block, spots: FloatArray, body: bytes) -> BlockAnswer:
    table = read(_Table, body).sources_to_targets
    durations, distances = numbers(table.durations, block), numbers(table.distances, block)
    return _with_spots(block, spots, durations, METRES * distances)


def _unconnected(block: Block, spots: FloatArray, refusal: SourceError) -> BlockAnswer:
    """Return a block without any way, if that is why it is refused."""
    if not isinstance(refusal, NoWayError):
        raise refusal
    durations, distances = np.full((2, len(block.origins), len(block.destinations)), np.nan)
    return _with_spots(block, spots, durations, distances)


def _with_spots(block: Block, spots: FloatArray, durations: FloatArray,
                distances: FloatArray) -> BlockAnswer:
    # In some one-way streets Valhalla drives around the block to get from a place to itself.
    own = block.origins[:, None] == block.destinations
    durations[own] = distances[own] = 0.0
    return BlockAnswer(durations, distances, spots[block.origins], spots[block.destinations])


def _route(points: int, body: bytes) -> RoadRoute:
    legs = read(_Route, body).trip.legs
    if len(legs) != points - 1:
        raise RoadsAnswerError("The server of roads answered a route of other legs.")
    return route_of([decoded(leg.shape) for leg in legs],
                    [METRES * leg.summary.length for leg in legs],
                    [leg.summary.time for leg in legs])


def _refusal(status: int, body: bytes) -> RoadsError:
    refusal = stated_refusal(_Refusal, body)
    if refusal is None:
        return RoadsAnswerError(f"The server of roads refused with status {status}.")
    if refusal.error_code in (UNCONNECTED, NO_EDGES, NO_PATH):
        return NoWayError("No road leads between these points.")
    return RoadsAnswerError(
        f"The server of roads refused with error {refusal.error_code} ({refusal.error!r:.200}).")
