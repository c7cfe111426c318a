"""Reads files of flights back by others' readers and what others document, none of it Tandem's.

Each reader takes files of one flight each and returns these in their order.
"""

import io
import json
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, NamedTuple

from lxml import etree
from pydantic import BaseModel, ConfigDict, Field
from pymavlink import mavutil
from pymavlink.mavwp import MAVWPLoader

MAV = mavutil.mavlink

SCHEMAS = Path(__file__).parent / "schemas"
SPACES = {"k": "http://www.opengis.net/kml/2.2", "w": "http://www.dji.com/wpmz/1.0.2"}

Place = tuple[float, float]
"""Longitude and latitude."""


class Step(NamedTuple):
    """A place, how fast it is flown to in m/s (None: not told), and how long is waited there."""

    place: Place
    speed: float | None
    waiting: float


@dataclass
class Read:
    """A flight as a file tells it."""

    steps: list[Step] = field(default_factory=list)
    landings: list[Place] = field(default_factory=list)
    heights: set[float] = field(default_factory=set)
    launch_time: float | None = None
    recovery_time: float | None = None
    tells_stays: bool = True  # at customers where it lands; else whoever starts it again knows

    @property
    def way(self) -> list[Place]:
        """Where it leads, without doubles."""
        places = [step.place for step in self.steps]
        return [places[0], *(after for before, after in pairwise(places) if after != before)]


Files = Mapping[str, bytes]
Fences = list[list[Place]]
Reader = Callable[[Files], tuple[list[Read], Fences | None]]
"""Returns flights, and the zones around them if the format tells any."""


class _Documented(BaseModel):
    model_config = ConfigDict(extra="allow", strict=True)


class _SimpleItem(_Documented):
    """https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html"""

    type: Literal["SimpleItem"]
    autoContinue: bool
    command: int
    doJumpId: int = Field(ge=1)
    frame: int
    params: list[float | None] = Field(min_length=7, max_length=7)


class _Mission(_Documented):
    version: Literal[2]
    firmwareType: int
    vehicleType: int
    globalPlanAltitudeMode: int
    cruiseSpeed: float
    hoverSpeed: float
    plannedHomePosition: list[float] = Field(min_length=3, max_length=3)
    items: list[_SimpleItem] = Field(min_length=1)


class _FencePolygon(_Documented):
    version: Literal[1]
    inclusion: bool
    polygon: list[tuple[float, float]] = Field(min_length=3)


class _GeoFence(_Documented):
    version: Literal[2]
    circles: list[Any] = Field(max_length=0)
    polygons: list[_FencePolygon]


class _RallyPoints(_Documented):
    version: Literal[2]
    points: list[tuple[float, float, float]]


class _Plan(_Documented):
    fileType: Literal["Plan"]
    version: Literal[1]
    groundStation: str
    mission: _Mission
    geoFence: _GeoFence
    rallyPoints: _RallyPoints


class _Item(NamedTuple):
    frame: int
    command: int
    param1: float
    param2: float
    place: Place
    height: float


def read_plans(files: Files) -> tuple[list[Read], Fences]:
    """Read QGroundControl's plans."""
    flights: list[Read] = []
    fences: Fences = []
    for content in files.values():
        plan = _Plan.model_validate(json.loads(content), strict=False)
        items = [_Item(item.frame, item.command, item.params[0] or 0.0, item.params[1] or 0.0,
                       (item.params[5] or 0.0, item.params[4] or 0.0), item.params[6] or 0.0)
                 for item in plan.mission.items]
        flights.append(_flight_of(items))
        fences += [[(x, y) for y, x in fence.polygon] for fence in plan.geoFence.polygons
                   if not fence.inclusion]
    return flights, fences


def read_way_points(files: Files) -> tuple[list[Read], Fences]:
    """Read MAVLink's way points by MAVLink's own loader."""
    flights: list[Read] = []
    fences: Fences = []
    for name, content in files.items():
        items = list(_loaded(content))
        if name.endswith("-fence.waypoints"):
            fences += _fences_of(items)
        else:
            if items[0].frame != MAV.MAV_FRAME_GLOBAL:
                raise ValueError(f"{name}: the first item is no home")
            flights.append(_flight_of(items[1:]))
    return flights, fences


def _loaded(content: bytes) -> Iterator[_Item]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "file"
        path.write_bytes(content)
        loader = MAVWPLoader()
        loader.load(str(path))
    for index in range(loader.count()):
        item = loader.wp(index)
        yield _Item(item.frame, item.command, item.param1, item.param2, (item.y, item.x), item.z)


def _fences_of(items: list[_Item]) -> Fences:
    fences: Fences = []
    while items:
        count = round(items[0].param1)
        ring, items = items[:count], items[count:]
        if any(item.command != MAV.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION
               or item.param1 != count for item in ring) or len(ring) != count:
            raise ValueError("a fence has other corners than it says")
        fences.append([item.place for item in ring])
    return fences


def _flight_of(items: Iterable[_Item]) -> Read:
    """Return the flight of a mission, from its first take-off to its last landing."""
    flight, speed = Read(), 0.0
    for item in items:
        if item.command == MAV.MAV_CMD_DO_CHANGE_SPEED:
            if item.param1 != MAV.SPEED_TYPE_GROUNDSPEED:
                raise ValueError(f"speed of type {item.param1}")
            speed = item.param2
        elif item.command == MAV.MAV_CMD_NAV_DELAY:
            flight.steps.append(Step(flight.steps[-1].place, speed, item.param1))
        else:
            _fly(flight, item, speed)
    return flight


def _fly(flight: Read, item: _Item, speed: float) -> None:
    """Add an item that leads somewhere. In place."""
    if item.frame != MAV.MAV_FRAME_GLOBAL_RELATIVE_ALT:
        raise ValueError(f"frame {item.frame}")
    waiting = item.param1 if item.command == MAV.MAV_CMD_NAV_LOITER_TIME else 0.0
    flight.steps.append(Step(item.place, speed, waiting))
    if item.command == MAV.MAV_CMD_NAV_LAND:
        flight.landings.append(item.place)
    elif item.command in (MAV.MAV_CMD_NAV_TAKEOFF, MAV.MAV_CMD_NAV_WAYPOINT,
                          MAV.MAV_CMD_NAV_LOITER_TIME):
        flight.heights.add(item.height)
    else:
        raise ValueError(f"command {item.command}")


def read_kml(files: Files) -> tuple[list[Read], Fences]:
    """Read KML that fits the schema."""
    flights: list[Read] = []
    fences: Fences = []
    for content in files.values():
        root = _valid(content, "kml.xsd")
        for mark in root.iterfind(".//k:Placemark[k:LineString]", SPACES):
            corners = _coordinates(mark.find("k:LineString/k:coordinates", SPACES))
            told = {each.get("name"): each.findtext("k:value", namespaces=SPACES)
                    for each in mark.iterfind(".//k:Data", SPACES)}
            flights.append(_drawn(corners, told["launch_time"], told["recovery_time"]))
        for ring in root.iterfind(".//k:Polygon//k:coordinates", SPACES):
            fences.append([(x, y) for x, y, _ in _coordinates(ring)])
    return flights, fences


def read_geojson(files: Files) -> tuple[list[Read], Fences]:
    """Read GeoJSON."""
    flights: list[Read] = []
    fences: Fences = []
    for content in files.values():
        for feature in json.loads(content)["features"]:
            told, shape = feature["properties"], feature["geometry"]
            if shape["type"] == "LineString":
                corners = [(x, y, z) for x, y, z in shape["coordinates"]]
                flights.append(_drawn(corners, told["launch_time"], told["recovery_time"]))
            elif shape["type"] == "Polygon":
                (ring,) = shape["coordinates"]
                fences.append([(x, y) for x, y in ring])
    return flights, fences


def _drawn(corners: list[tuple[float, float, float]], launch: Any, recovery: Any) -> Read:
    """Return a flight of a line; a corner on the ground is a launch or a landing."""
    flight = Read(launch_time=float(launch), recovery_time=float(recovery))
    flight.steps = [Step((x, y), None, 0.0) for x, y, _ in corners]
    flight.landings = [(after[0], after[1]) for before, after in pairwise(corners)
                       if after[2] == 0 and before[2] > 0]
    flight.heights = {z for _, _, z in corners if z > 0}
    return flight


def read_wpml(files: Files) -> tuple[list[Read], None]:
    """Read DJI's way lines that fit what is documented, those of a file as one flight."""
    flights: list[Read] = []
    for content in files.values():
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            _valid(archive.read("wpmz/template.kml"), "wpmz.xsd")
            root = _valid(archive.read("wpmz/waylines.wpml"), "wpmz.xsd")
        if root.findtext(".//w:finishAction", namespaces=SPACES) != "autoLand":
            raise ValueError("way lines end in the air")
        flight = Read()
        for number, folder in enumerate(root.iterfind(".//k:Folder", SPACES)):
            if folder.findtext("w:waylineId", namespaces=SPACES) != str(number):
                raise ValueError("way lines are numbered otherwise")
            speed = None
            for mark in folder.iterfind("k:Placemark", SPACES):
                longitude, latitude = map(float, mark.findtext(
                    "k:Point/k:coordinates", namespaces=SPACES).split(","))
                waiting = mark.findtext(".//w:hoverTime", "0", SPACES)
                flight.steps.append(Step((longitude, latitude), speed, float(waiting)))
                speed = float(mark.findtext("w:waypointSpeed", namespaces=SPACES))
                flight.heights.add(float(mark.findtext("w:executeHeight", namespaces=SPACES)))
            flight.landings.append(flight.steps[-1].place)
        flight.tells_stays = len(flight.landings) == 1
        flights.append(flight)
    return flights, None


def _valid(content: bytes, schema: str) -> Any:
    root = etree.fromstring(content)
    etree.XMLSchema(file=str(SCHEMAS / schema)).assertValid(root)
    return root


def _coordinates(element: Any) -> list[tuple[float, float, float]]:
    numbers = [[float(part) for part in corner.split(",")] for corner in element.text.split()]
    return [(x, y, z) for x, y, z in numbers]


READERS: Mapping[str, Reader] = {
    "qgc-plan": read_plans, "qgc-wpl": read_way_points, "kml": read_kml,
    "dji-wpml": read_wpml, "geojson": read_geojson,
}
