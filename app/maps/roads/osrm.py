"""OSRM's HTTP interface: of a server somewhere, or of the process that the service starts."""

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Literal, TypeVar
from urllib.parse import quote

import numpy as np
import polyline

from app.maps.remote.asking import RemoteCall, RemoteServer, ShouldStop
from app.maps.roads.answers import BlockAnswer, Schema, blocks, joined, moved, read, stated_refusal
from app.maps.roads.engine import (
    ROADS, USUAL, Block, Driving, NoWayError, RoadRoute, RoadsAnswerError, RoadsError,
    RoadTable, UnknownDrivingError, whole,
)
from app.maps.roads.lines import DECIMALS, decoded, joined_route, route_of, stretches
from app.maps.roads.osrm_tables import BYTES_BESIDES, AskedBlock, TableForm, in_json
from app.maps.roads.server import RoadServer
from app.schemas.fields import Avoided
from model.problem import BoolArray, FloatArray

BESIDE = 5
"""Places named beside those of a block, if need be, so that not all are of one island."""

BYTES_PER_ROUTE = 64 << 20
"""More than any route takes."""

CLASSES: dict[Avoided, str] = {"tolls": "toll", "motorways": "motorway", "ferries": "ferry"}
"""What OSRM calls what is avoided."""

UNBUILT = "Exclude flag combination"
"""How OSRM begins to say that its roads weren't prepared for it to avoid all that together."""

Answer = TypeVar("Answer")


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
    """Roads of one profile from OSRM.

    Parameters
    ----------
    form
        How it is asked for tables.
    """

    name = "osrm"

    def __init__(self, server: RoadServer, profile: str = "driving",
                 form: TableForm = in_json) -> None:
        self._server = server
        self._form = form
        self._profile = quote(profile, safe="")
        self._unlimited = False
        self._asking = RemoteServer(server, ROADS, _refusal)

    def build(self) -> str:
        """Return what the server calls the state of its map; most don't say."""
        return self._asking.state(RemoteCall(
            f"/nearest/v1/{self._profile}/0,0?generate_hints=false",
            lambda body: read(_Nearest, body).data_version, BYTES_BESIDES))

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between places."""
        return self._anyhow(lambda: self._table(
            lon_lat, until, should_stop, whole(len(lon_lat)) if wanted is None else wanted,
            driving))

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
               wanted: Sequence[Block], driving: Driving) -> RoadTable:
        asked = self._cut(lon_lat, wanted, driving)
        answers = dict(zip(asked, self._form(self._asking, asked, until, should_stop),
                           strict=True))
        unsure = moved(len(lon_lat), _by_block(answers))
        if unsure.any():
            doubted = [one for one in asked if unsure[one.block.origins].any()
                       or unsure[one.block.destinations].any()]
            again = [self._asked(lon_lat, one.block, driving, _beside(one.block, unsure))
                     for one in doubted]
            answers.update(zip(doubted, self._form(self._asking, again, until, should_stop),
                               strict=True))
        return joined(lon_lat, _by_block(answers))

    def _cut(self, lon_lat: FloatArray, wanted: Sequence[Block],
             driving: Driving) -> list[AskedBlock]:
        """Return how to ask for blocks that the server takes."""
        most = self._server.max_places
        while True:
            parts = blocks(wanted, most)
            asked = [self._asked(lon_lat, block, driving) for block in parts]
            longest = max((len(one.whole) for one in asked), default=0)
            if longest <= self._server.max_url or most == 1:
                return asked
            largest = max(max(len(part.origins), len(part.destinations)) for part in parts)
            most = -(-largest // 2)

    def _asked(self, lon_lat: FloatArray, block: Block, driving: Driving,
               beside: Sequence[int] = ()) -> AskedBlock:
        named = np.unique([*block.origins, *block.destinations, *beside])
        origins, destinations = (np.searchsorted(named, places)
                                 for places in (block.origins, block.destinations))
        # OSRM makes no table of one place.
        named = named if len(named) > 1 else named.repeat(2)
        places = lon_lat[named]
        return AskedBlock(block, self._path("table", places),
                          f"&generate_hints=false{self._radii(len(places))}"
                          f"{_stated(driving.among(named))}", places, origins, destinations)

    def _radii(self, count: int) -> str:
        """Return that each place is to be put on the nearest road however far that is."""
        return f"&radiuses={';'.join(['unlimited'] * count)}" if self._unlimited else ""

    def _path(self, service: str, places: FloatArray) -> str:
        line = polyline.encode(places.tolist(), DECIMALS, geojson=True)
        return f"/{service}/v1/{self._profile}/polyline6({quote(line, safe='')})"

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along points, turning at each where the table's drives begin anew."""
        return self._anyhow(lambda: self._route(lon_lat, until, driving))

    def _route(self, lon_lat: FloatArray, until: float, driving: Driving) -> RoadRoute:
        questions = []
        for stretch in stretches(len(lon_lat), self._server.max_points):
            points = lon_lat[stretch]
            path = (f"{self._path('route', points)}?overview=full&geometries=polyline6"
                    "&annotations=distance&continue_straight=false&generate_hints=false"
                    f"{self._radii(len(points))}{_stated(driving.among(stretch))}")
            questions.append(RemoteCall(path, partial(_route, len(points)), BYTES_PER_ROUTE))
        return joined_route(self._asking.ask(questions, until))

    def close(self) -> None:
        """Let go of connections."""
        self._asking.close()


def _stated(driving: Driving) -> str:
    """Return how one drives, as OSRM is told."""
    excluded = ",".join(CLASSES[avoided] for avoided in driving.avoid)
    sides = (";".join("curb" if curb else "" for curb in driving.curb)
             if driving.curb is not None and driving.curb.any() else "")
    return (f"&exclude={excluded}" if excluded else "") + (f"&approaches={sides}" if sides else "")


def _beside(block: Block, unsure: BoolArray) -> list[int]:
    """Return places to be named beside a block's, those of which we are sure first.

    Where all places named lie on one island of the road graph, OSRM puts them on its roads, and
    else on those of the mainland. A whole table is asked for as if it were one question.
    """
    others = np.setdiff1d(np.arange(len(unsure)), [*block.origins, *block.destinations])
    sure = others[~unsure[others]]
    chosen = sure if len(sure) else others
    spread = np.linspace(0, len(chosen) - 1, min(BESIDE, len(chosen))).astype(int)
    return chosen[spread].tolist()


def _by_block(answers: dict[AskedBlock, BlockAnswer]) -> list[tuple[Block, BlockAnswer]]:
    return [(asked.block, part) for asked, part in answers.items()]


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
    if refusal.message.startswith(UNBUILT):
        return UnknownDrivingError(
            "they weren't prepared for that (of what there is, OSRM has room for all but motorways "
            "with ferries and without tolls).")
    return RoadsAnswerError(f"The server of roads refused with {refusal.code!r:.80}.")
