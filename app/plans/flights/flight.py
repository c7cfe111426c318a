"""What a drone does in the air from take-off to recovery, whatever file tells it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Literal

Role = Literal["launch", "bend", "customer", "recovery"]
Place = tuple[float, float]
"""Longitude and latitude in degrees."""
Ring = tuple[Place, ...]

NOTE = ("Made from a plan by Tandem. These are facts for a flight controller and no permission to "
        "fly: whoever flies answers for permits, airspace, obstacles and weather.")
"""What every file says of itself, at least."""


class BeyondFormatError(ValueError):
    """A format can't tell a flight."""


@dataclass(frozen=True)
class WayPoint:
    """A place over which a drone comes at its height. Times in seconds since plan start."""

    role: Role
    place: Place
    id: str | None  # of the stop or the customer; bends have none
    speed: float  # over ground on the way there, in m/s
    arrival: float
    waiting: float = 0.0  # seconds until it flies on, or begins to be recovered


@dataclass(frozen=True)
class Flight:
    """A flight, from a launch over customers and around zones to a recovery."""

    vehicle: str
    drone: str
    number: int  # of the drone's flights, from 1
    altitude: float  # metres above where it was launched
    lands: bool  # at customers; else it hovers there
    way_points: tuple[WayPoint, ...]
    recovery_time: float  # end of the recovery, in seconds since plan start
    zones: tuple[Ring, ...] = ()  # nearby ones that it stays out of
    plan_start: datetime | None = None
    buffer: float = 0.0  # metres that it keeps from zones

    @property
    def name(self) -> str:
        """What the flight is called, such as `truck-1/drone-1 flight 2`."""
        return f"{self.drone} flight {self.number}"

    @property
    def launch(self) -> WayPoint:
        """Where and when it takes off."""
        return self.way_points[0]

    @property
    def recovery(self) -> WayPoint:
        """Where it is recovered, and when it comes there."""
        return self.way_points[-1]

    @property
    def customers(self) -> tuple[str, ...]:
        """Whom it flies to, in order."""
        return tuple(point.id or "" for point in self.way_points if point.role == "customer")

    @property
    def top_speed(self) -> float:
        """Its highest speed over ground, in m/s."""
        return max(point.speed for point in self.way_points)

    def hops(self) -> Iterator[tuple[WayPoint, ...]]:
        """Yield the way points from each take-off to the next landing."""
        begin = 0
        for index, point in enumerate(self.way_points):
            if point.role == "recovery" or (point.role == "customer" and self.lands):
                yield self.way_points[begin:index + 1]
                begin = index

    def line(self) -> list[tuple[float, float, float]]:
        """Return longitude, latitude and height of all corners of its way, climbs included."""
        up = self.altitude
        return [(*point.place, height) for hop in self.hops()
                for point, heights in _with_climbs(hop, up) for height in heights]

    def told(self, seconds: float) -> str | float:
        """Return an instant as date and time if the plan has a day, else in seconds."""
        if self.plan_start is None:
            return round(seconds, 3)
        return (self.plan_start + timedelta(seconds=round(seconds, 3))).isoformat()


def note_of(flights: Sequence[Flight]) -> str:
    """Return what a file says of itself, and how far its flights keep from zones."""
    buffer = flights[0].buffer
    return f"{NOTE} Flights keep {buffer:g} m from zones that bar them." if buffer else NOTE


def _with_climbs(hop: tuple[WayPoint, ...],
                 up: float) -> Iterator[tuple[WayPoint, tuple[float, ...]]]:
    last = len(hop) - 1
    for index, point in enumerate(hop):
        yield point, (0.0, up) if index == 0 else (up, 0.0) if index == last else (up,)
