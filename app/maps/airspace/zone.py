"""Zones of the airspace, whatever they were read from."""

from dataclasses import dataclass
from typing import Literal

from shapely import Polygon

from app.maps.airspace.applying import ALWAYS, Period

Reference = Literal["AGL", "AMSL", "WGS84"]
Unit = Literal["M", "FT"]
Restriction = Literal["PROHIBITED", "REQ_AUTHORISATION", "CONDITIONAL", "NO_RESTRICTION"]

METRES: dict[Unit, float] = {"M": 1.0, "FT": 0.3048}
ABOVE: dict[Reference, str] = {"AGL": "above the ground", "AMSL": "above the sea",
                               "WGS84": "above the ellipsoid"}

GEOID_M = 110.0
"""Farthest that the sea lies from the ellipsoid."""

LOWEST_GROUND_M, HIGHEST_GROUND_M = -440.0, 8850.0
"""Between which heights above the sea all ground lies, from the Dead Sea to Mount Everest."""


@dataclass(frozen=True)
class GroundHeights:
    """Between which heights above the sea the ground lies, in metres."""

    lowest: float = LOWEST_GROUND_M
    highest: float = HIGHEST_GROUND_M


@dataclass(frozen=True)
class ZoneHeight:
    """A height, as it was published."""

    value: float
    unit: Unit
    reference: Reference

    @property
    def metres(self) -> float:
        """How high it is above its reference."""
        return self.value * METRES[self.unit]

    @property
    def words(self) -> str:
        """The height as people say it."""
        if self.value == 0 and self.reference == "AGL":
            return "the ground"
        return f"{self.value:g} {self.unit.lower()} {ABOVE[self.reference]}"

    def least_above_ground(self, ground: GroundHeights) -> float:
        """Return how far it lies above the ground at least, in metres."""
        if self.reference == "AGL":
            return self.metres
        return self.metres - ground.highest - (GEOID_M if self.reference == "WGS84" else 0.0)

    def most_above_ground(self, ground: GroundHeights) -> float:
        """Return how far it lies above the ground at most, in metres."""
        if self.reference == "AGL":
            return self.metres
        return self.metres - ground.lowest + (GEOID_M if self.reference == "WGS84" else 0.0)


@dataclass(frozen=True, eq=False)
class Volume:
    """An area from one height to another; no limit may be unknown, and then reaches all heights."""

    area: Polygon  # in degrees; longitudes go on beyond 180 where it lies across
    lower: ZoneHeight | None = None
    upper: ZoneHeight | None = None
    is_far: bool = False  # flights meet others of its zone before; only who is in it matters

    def is_above(self, altitude: float, ground: GroundHeights) -> bool:
        """Tell whether it plainly lies above metres over the ground."""
        return self.lower is not None and self.lower.least_above_ground(ground) > altitude

    def is_below(self, altitude: float, ground: GroundHeights) -> bool:
        """Tell whether it plainly lies below metres over the ground."""
        return self.upper is not None and self.upper.most_above_ground(ground) < altitude

    @property
    def words(self) -> str:
        """From where to where it reaches, as people say it."""
        lower = "an unstated height" if self.lower is None else self.lower.words
        return f"from {lower} " + ("up" if self.upper is None else f"to {self.upper.words}")


@dataclass(frozen=True, eq=False)
class Zone:
    """What an authority has published of a part of the airspace."""

    identifier: str | None
    name: str | None
    restriction: Restriction
    volumes: tuple[Volume, ...]
    country: str | None = None
    message: str | None = None
    authority: str | None = None
    periods: tuple[Period, ...] = ()  # in which it applies; none: always

    @property
    def is_timed(self) -> bool:
        """Tell whether it applies at certain times alone."""
        return bool(self.periods) and ALWAYS not in self.periods

    @property
    def title(self) -> str:
        """What it is called."""
        if self.name and self.identifier and self.name != self.identifier:
            return f"{self.name} ({self.identifier})"
        return self.name or self.identifier or "without a name"
