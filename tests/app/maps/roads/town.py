"""A small town, made up for what Helsinki's centre lacks: streets whose sides tell, tolls, a ferry.

Streets lie in metres east and north of `ORIGIN`. In the west there is a block of 1,000 by 300 m:

    depot -- (0, 0) ------------- (1000, 0)       traffic keeps right
               |                      |
            (0, -300) ---------- (1000, -300)

From (1000, 0) four ways lead to (3000, 0), each slower than the one before: a motorway, a road with
tolls, a ferry, and a street. A ferry alone leads from there to an island at (3000, 4000).
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import osmium
from osmium.osm.mutable import Node, Way

ORIGIN = (25.0, 60.0)
METRES_PER_DEGREE = 111_195.0

Point = tuple[float, float]


class Street(NamedTuple):
    """A way and its tags."""

    tags: Mapping[str, str]
    points: tuple[Point, ...]


_STREET = {"highway": "residential", "maxspeed": "30"}
_FERRY = {"route": "ferry", "motor_vehicle": "yes", "duration": "00:04"}

BEGIN, END = (1000.0, 0.0), (3000.0, 0.0)

STREETS = (
    Street(_STREET, ((-100, 0), (0, 0), (500, 0), BEGIN)),
    Street(_STREET, ((0, 0), (0, -300), (1000, -300), BEGIN)),
    Street({"highway": "motorway", "oneway": "no", "maxspeed": "120"}, (BEGIN, (2000, 0), END)),
    Street({"highway": "primary", "toll": "yes", "maxspeed": "80"}, (BEGIN, (2000, 400), END)),
    Street(_FERRY, (BEGIN, (2000, 1000), END)),
    Street(_STREET, (BEGIN, (2000, -1600), END)),
    Street(_STREET, (END, (3200, 0))),
    Street(_FERRY, (END, (3000, 4000))),
    Street(_STREET, ((3000, 4000), (2700, 4000), (2700, 4300), (3000, 4300), (3000, 4000))),
)


def place(east: float, north: float, origin: Point = ORIGIN) -> list[float]:
    """Return longitude and latitude of a place."""
    longitude, latitude = origin
    shrunk = METRES_PER_DEGREE * math.cos(math.radians(latitude))
    return [round(longitude + east / shrunk, 6),
            round(latitude + north / METRES_PER_DEGREE, 6)]


def write_town(path: Path, origin: Point = ORIGIN) -> None:
    """Write the town as an extract of OpenStreetMap, somewhere on the globe."""
    points = list(dict.fromkeys(point for street in STREETS for point in street.points))
    numbers = {point: number for number, point in enumerate(points, start=1)}
    with osmium.SimpleWriter(str(path)) as writer:
        for point, number in numbers.items():
            writer.add_node(Node(id=number, version=1, location=tuple(place(*point, origin))))
        for number, street in enumerate(STREETS, start=1):
            writer.add_way(Way(id=number, version=1, tags=dict(street.tags),
                               nodes=[numbers[point] for point in street.points]))
