"""Flights as items of a MAVLink mission: what QGroundControl and ArduPilot's tools read.

References
----------
MAVLink, common message set, `MAV_CMD` and `MAV_FRAME`: https://mavlink.io/en/messages/common.html
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise

from app.plans.flights.flight import Flight, Place, Ring, WayPoint

GROUND_SPEED, NO_THROTTLE = 1.0, -1.0
"""Parameters of `DO_CHANGE_SPEED`: which speed, and that the throttle stays."""

NO_CLOCK = -1.0
"""Of `NAV_DELAY`: it waits for some seconds, not until a time of day."""

SAME_SPEED = 0.05
"""Metres a second below which a change of speed isn't told."""


class Command(IntEnum):
    """What a mission item asks for (`MAV_CMD`)."""

    NAV_WAYPOINT = 16
    NAV_LOITER_TIME = 19
    NAV_LAND = 21
    NAV_TAKEOFF = 22
    NAV_DELAY = 93
    DO_CHANGE_SPEED = 178
    NAV_FENCE_POLYGON_VERTEX_EXCLUSION = 5002


class Frame(IntEnum):
    """What a mission item's coordinates are (`MAV_FRAME`)."""

    GLOBAL = 0
    MISSION = 2  # none
    GLOBAL_RELATIVE_ALT = 3  # degrees, and metres above home


@dataclass(frozen=True)
class Item:
    """One item of a mission."""

    command: Command
    params: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    place: Place | None = None
    altitude: float = 0.0

    @property
    def frame(self) -> Frame:
        """What its coordinates are."""
        return Frame.MISSION if self.place is None else Frame.GLOBAL_RELATIVE_ALT


def mission_of(flights: Sequence[Flight]) -> list[Item]:
    """Return the items of flights that one drone flies in turn."""
    items = list(_items(flights[0]))
    for flight, after in pairwise(flights):
        # It is on its truck, or at its depot, meanwhile.
        items += _delay(after.launch.arrival - flight.recovery_time)
        items += _items(after)
    return items


def fence_of(zones: Sequence[Ring]) -> list[Item]:
    """Return the items of a fence around zones: each corner with the number of its zone's."""
    return [Item(Command.NAV_FENCE_POLYGON_VERTEX_EXCLUSION, (len(ring) - 1, 0.0, 0.0, 0.0), place)
            for ring in zones for place in ring[:-1]]


def _items(flight: Flight) -> Iterator[Item]:
    launch, *others = flight.way_points
    yield Item(Command.NAV_TAKEOFF, place=launch.place, altitude=flight.altitude)
    speed = 0.0
    for point in others:
        if abs(point.speed - speed) > SAME_SPEED:
            speed = point.speed
            yield Item(Command.DO_CHANGE_SPEED,
                       (GROUND_SPEED, round(speed, 3), NO_THROTTLE, 0.0))
        yield from _at(point, flight)


def _at(point: WayPoint, flight: Flight) -> Iterator[Item]:
    """Yield what is done where a way point is, the way there included."""
    there = Item(Command.NAV_WAYPOINT, place=point.place, altitude=flight.altitude)
    waiting = Item(Command.NAV_LOITER_TIME, (round(point.waiting, 3), 0.0, 0.0, 0.0), point.place,
                   flight.altitude)
    land = Item(Command.NAV_LAND, place=point.place)
    if point.role == "bend":
        yield there
    elif point.role == "recovery":
        yield waiting if point.waiting else there
        yield land
    elif not flight.lands:
        yield waiting
    else:
        yield there
        yield land
        yield from _delay(point.waiting)
        yield Item(Command.NAV_TAKEOFF, place=point.place, altitude=flight.altitude)


def _delay(seconds: float) -> Iterator[Item]:
    if seconds > 0:
        yield Item(Command.NAV_DELAY, (round(seconds, 3), NO_CLOCK, NO_CLOCK, NO_CLOCK))
