"""The HTTP interface of openrouteservice."""

import json
from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from typing import Any

from app.maps.remote.asking import RemoteCall, RemoteServer, ShouldStop
from app.maps.roads.answers import (
    BlockAnswer, Schema, TableAnswer, blocks, joined, read, stated_refusal,
)
from app.maps.roads.engine import (
    ROADS, USUAL, Block, Driving, NoWayError, RoadRoute, RoadsAnswerError, RoadsError, RoadTable,
    whole,
)
from app.maps.roads.lines import decoded, joined_route, route_of, stretches
from app.maps.roads.server import RoadServer
from model.problem import FloatArray

MAX_PLACES, MAX_POINTS = 50, 50
"""Origins and destinations of a table, and points of a route, that it takes by default."""

DECIMALS = 5
"""Of coordinates in its lines: a metre."""

BYTES_PER_LEG, BYTES_PER_PLACE, BYTES_BESIDES = 64, 1_024, 65_536
"""More than an answer holds for a leg of a table (both numbers), for a place, and besides."""

BYTES_PER_ROUTE = 64 << 20
"""More than any route takes."""

NO_ROUTE, NO_POINT = 2009, 2010
"""What its errors for want of roads are called: between two points, and near one."""


class _Segment(Schema):
    # What is 0 is left out.
    distance: float = 0.0
    duration: float = 0.0


class _Drive(Schema):
    geometry: str
    segments: list[_Segment]
    way_points: list[int]


class _Route(Schema):
    routes: list[_Drive]


class _Error(Schema):
    code: int
    message: str | None = None


class _Refusal(Schema):
    error: _Error


class OpenRouteService:
    """Roads of one profile from openrouteservice."""

    name = "openrouteservice"

    def __init__(self, server: RoadServer, profile: str = "driving-car") -> None:
        self._server = server
        self._profile = profile
        self._asking = RemoteServer(server, ROADS, _refusal)

    def build(self) -> str:
        """Return nothing: only answers to other questions tell of the map."""
        return ""

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between places."""
        driving.require_usual("openrouteservice")
        parts = blocks(whole(len(lon_lat)) if wanted is None else wanted,
                       self._server.max_places)
        questions = [self._question(lon_lat, block) for block in parts]
        answers = self._asking.ask(questions, until, should_stop)
        return joined(lon_lat, zip(parts, answers, strict=True))

    def _question(self, lon_lat: FloatArray, block: Block) -> RemoteCall[BlockAnswer]:
        rows, columns = len(block.origins), len(block.destinations)
        places = lon_lat[[*block.origins, *block.destinations]]
        body = _json(locations=places.tolist(), sources=_listed(range(rows)),
                     destinations=_listed(range(rows, rows + columns)),
                     metrics=["duration", "distance"], units="m")
        most = rows * columns * BYTES_PER_LEG + len(places) * BYTES_PER_PLACE + BYTES_BESIDES
        return RemoteCall(f"/v2/matrix/{self._profile}", partial(_part, block, places), most, body)

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along points."""
        driving.require_usual("openrouteservice")
        questions = []
        for stretch in stretches(len(lon_lat), self._server.max_points):
            points = lon_lat[stretch].tolist()
            # Tables take places however far from a road they are, and routes only if told so.
            body = _json(coordinates=points, radiuses=[-1] * len(points), units="m",
                         geometry_simplify=False)
            questions.append(RemoteCall(f"/v2/directions/{self._profile}/json",
                                        partial(_route, len(points)), BYTES_PER_ROUTE, body))
        return joined_route(self._asking.ask(questions, until))

    def close(self) -> None:
        """Let go of connections."""
        self._asking.close()


def _json(**stated: Any) -> bytes:
    return json.dumps(stated).encode()


def _listed(places: range) -> list[str]:
    return [str(place) for place in places]


def _part(block: Block, places: FloatArray, body: bytes) -> BlockAnswer:
    return read(TableAnswer, body).part(block, places)


def _route(points: int, body: bytes) -> RoadRoute:
    answer = read(_Route, body)
    if (not answer.routes or len(answer.routes[0].segments) != points - 1
            or len(answer.routes[0].way_points) != points):
        raise RoadsAnswerError("The server of roads answered a route of other legs.")
    drive = answer.routes[0]
    line, cuts = decoded(drive.geometry, DECIMALS), drive.way_points
    if cuts[0] != 0 or cuts[-1] != len(line) - 1 or any(a > b for a, b in pairwise(cuts)):
        raise RoadsAnswerError("The server of roads answered a route with another line.")
    return route_of([line[begin:end + 1] for begin, end in pairwise(cuts)],
                    [segment.distance for segment in drive.segments],
                    [segment.duration for segment in drive.segments])


def _refusal(status: int, body: bytes) -> RoadsError:
    refusal = stated_refusal(_Refusal, body)
    if refusal is None:
        return RoadsAnswerError(f"The server of roads refused with status {status}.")
    if refusal.error.code in (NO_ROUTE, NO_POINT):
        return NoWayError("No road leads from one of these points to its next.")
    return RoadsAnswerError(f"The server of roads refused with error {refusal.error.code} "
                            f"({refusal.error.message!r:.200}).")
