"""OSRM's HTTP interface: of a server somewhere, or of the process that the service starts."""

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Literal, TypeVar
from urllib.parse import quote

import numpy as np
import polyline

from app.remote.asking import Asking, Question, ShouldStop
from app.roads.answers import (
    Part, Schema, TableAnswer, blocks, joined, moved, read, stated_refusal,
)
from app.roads.engine import (
    ROADS, Block, NoWayError, RoadRoute, RoadsAnswerError, RoadsError, RoadTable, whole,
)
from app.roads.lines import DECIMALS, decoded, joined_route, route_of, stretches
from app.roads.server import RoadServer
from model.problem import BoolArray, FloatArray

BYTES_PER_LEG, BYTES_PER_PLACE, BYTES_BESIDES = 64, 1_024, 65_536
"""More than an answer holds for a leg of a table (both numbers), for a place, and besides."""

COMPANY = 5
"""Places named beside those of a block, if need be, so that not all are of one island."""

BYTES_PER_ROUTE = 64 << 20
"""More than any route takes."""

Answer = TypeVar("Answer")


class _Table(TableAnswer):
    code: Literal["Ok"]


class _Nearest(Schema):
    data_version: str = ""


class _Annotation(Schema):
    distance: list[float]


class _Leg(Schema):
    duration: float
    distance: float
    annotation: _Annotation


class _Drive(Schema):
    geometry: str
    legs: list[_Leg]


class _Route(Schema):
    code: Literal["Ok"]
    routes: list[_Drive]


class _Refusal(Schema):
    code: str
    message: str = ""


class _NoSegmentError(RoadsAnswerError):
    """No road is so near to one of the places as the server's settings want."""


class Osrm:
    """Roads of one profile from OSRM."""

    name = "osrm"

    def __init__(self, server: RoadServer, profile: str = "driving") -> None:
        self._server = server
        self._profile = quote(profile, safe="")
        self._unlimited = False
        self._asking = Asking(server, ROADS, _refusal)

    def build(self) -> str:
        """Return what the server calls the state of its map; most don't say."""
        return self._asking.state(Question(
            f"/nearest/v1/{self._profile}/0,0?generate_hints=false",
            lambda body: read(_Nearest, body).data_version, BYTES_BESIDES))

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None) -> RoadTable:
        """Return the drives between places."""
        return self._anyhow(lambda: self._table(
            lon_lat, until, should_stop, whole(len(lon_lat)) if wanted is None else wanted))

    def _anyhow(self, ask: Callable[[], Answer]) -> Answer:
        """Return an answer, of a server that looks for roads near places only, too."""
        try:
            return ask()
        except _NoSegmentError:
            if self._unlimited:
                raise
            self._unlimited = True
            return ask()

    def _table(self, lon_lat: FloatArray, until: float, should_stop: ShouldStop,
               wanted: Sequence[Block]) -> RoadTable:
        parts, questions = self._cut(lon_lat, wanted)
        answers = dict(zip(parts, self._asking.ask(questions, until, should_stop), strict=True))
        unsure = moved(len(lon_lat), answers.items())
        if unsure.any():
            again = [block for block in parts
                     if unsure[block.origins].any() or unsure[block.destinations].any()]
            questions = [self._question(lon_lat, block, _company(block, unsure)) for block in again]
            answers.update(zip(again, self._asking.ask(questions, until, should_stop),
                               strict=True))
        return joined(lon_lat, answers.items())

    def _cut(self, lon_lat: FloatArray,
             wanted: Sequence[Block]) -> tuple[list[Block], list[Question[Part]]]:
        """Return blocks that the server takes, and how to ask for them."""
        most = self._server.max_places
        while True:
            parts = blocks(wanted, most)
            questions = [self._question(lon_lat, block) for block in parts]
            longest = max((len(question.path) for question in questions), default=0)
            if longest <= self._server.max_url or most == 1:
                return parts, questions
            largest = max(max(len(part.origins), len(part.destinations)) for part in parts)
            most = -(-largest // 2)

    def _question(self, lon_lat: FloatArray, block: Block,
                  company: Sequence[int] = ()) -> Question[Part]:
        rows, columns = len(block.origins), len(block.destinations)
        places = lon_lat[[*block.origins, *block.destinations]]
        stated = lon_lat[[*block.origins, *block.destinations, *company]]
        path = (f"{self._path('table', stated)}?annotations=duration,distance&generate_hints=false"
                f"&sources={_listed(range(rows))}"
                f"&destinations={_listed(range(rows, rows + columns))}{self._radii(len(stated))}")
        most = rows * columns * BYTES_PER_LEG + len(places) * BYTES_PER_PLACE + BYTES_BESIDES
        return Question(path, partial(_part, block, places), most)

    def _radii(self, count: int) -> str:
        """Return that each place is to be put on the nearest road however far that is."""
        return f"&radiuses={';'.join(['unlimited'] * count)}" if self._unlimited else ""

    def _path(self, service: str, places: FloatArray) -> str:
        line = polyline.encode(places.tolist(), DECIMALS, geojson=True)
        return f"/{service}/v1/{self._profile}/polyline6({quote(line, safe='')})"

    def route(self, lon_lat: FloatArray, until: float) -> RoadRoute:
        """Return the drive along points, turning at each where the table's drives begin anew."""
        return self._anyhow(lambda: self._route(lon_lat, until))

    def _route(self, lon_lat: FloatArray, until: float) -> RoadRoute:
        questions = []
        for stretch in stretches(len(lon_lat), self._server.max_points):
            points = lon_lat[stretch]
            path = (f"{self._path('route', points)}?overview=full&geometries=polyline6"
                    "&annotations=distance&continue_straight=false&generate_hints=false"
                    f"{self._radii(len(points))}")
            questions.append(Question(path, partial(_route, len(points)), BYTES_PER_ROUTE))
        return joined_route(self._asking.ask(questions, until))

    def close(self) -> None:
        """Let go of connections."""
        self._asking.close()


def _company(block: Block, unsure: BoolArray) -> list[int]:
    """Return places to be named beside a block's, those of which we are sure first.

    Where all places named lie on one island of the road graph, OSRM puts them on its roads, and
    else on those of the mainland. A whole table is asked for as if it were one question.
    """
    others = np.setdiff1d(np.arange(len(unsure)), [*block.origins, *block.destinations])
    sure = others[~unsure[others]]
    chosen = sure if len(sure) else others
    spread = np.linspace(0, len(chosen) - 1, min(COMPANY, len(chosen))).astype(int)
    return chosen[spread].tolist()


def _listed(places: range) -> str:
    return ";".join(map(str, places))


def _part(block: Block, places: FloatArray, body: bytes) -> Part:
    return read(_Table, body).part(block, places)


def _route(points: int, body: bytes) -> RoadRoute:
    answer = read(_Route, body)
    if not answer.routes or len(answer.routes[0].legs) != points - 1:
        raise RoadsAnswerError("The server of roads answered a route of other legs.")
    drive = answer.routes[0]
    line = decoded(drive.geometry)
    cuts = np.cumsum([0, *(len(leg.annotation.distance) for leg in drive.legs)]).tolist()
    if cuts[-1] != len(line) - 1:
        raise RoadsAnswerError("The server of roads answered a route with another line.")
    return route_of([line[begin:end + 1] for begin, end in pairwise(cuts)],
                    [leg.distance for leg in drive.legs], [leg.duration for leg in drive.legs])


def _refusal(status: int, body: bytes) -> RoadsError:
    refusal = stated_refusal(_Refusal, body)
    if refusal is None:
        return RoadsAnswerError(f"The server of roads refused with status {status}.")
    if refusal.code == "NoRoute":
        return NoWayError("No road leads from one of these points to its next.")
    if refusal.code == "NoSegment":
        return _NoSegmentError("The server of roads knows no road near one of these points.")
    return RoadsAnswerError(f"The server of roads refused with {refusal.code!r:.80}.")
