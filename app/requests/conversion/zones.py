"""Which published zones the flights of a request meet."""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple
from weakref import finalize

from app.maps.airspace.applying import NEVER_ENDS, PlannedSpan, applies
from app.maps.airspace.faults import Reading
from app.maps.airspace.reading import read_zones
from app.maps.airspace.zone import GroundHeights, Volume, Zone
from app.schemas.request import PlanRequest
from app.schemas.vehicle import VehicleTypeInput
from app.schemas.airspace import Zones


class ZoneVolume(NamedTuple):
    """A volume of a zone."""

    zone: Zone
    volume: Volume


class Met(NamedTuple):
    """What drones meet at an altitude."""

    around: tuple[ZoneVolume, ...]  # flown around
    over: tuple[ZoneVolume, ...]  # flown over, but nobody takes off or lands in them


NOTHING_MET = Met((), ())


def span_of(request: PlanRequest) -> PlannedSpan | None:
    """Return from when until when vehicles with drones work; None: that isn't known."""
    day = request.day
    shifts = [(kind.shift.earliest, _latest(kind)) for kind in request.fleet
              if kind.flyers]
    if day is None or not shifts:
        return None
    latest = [end for _, end in shifts]
    return PlannedSpan(day.instant(min(begin for begin, _ in shifts)),
                       NEVER_ENDS if None in latest
                       else day.instant(max(end for end in latest if end is not None)))


def _latest(kind: VehicleTypeInput) -> float | None:
    """Return the end of a shift with all the overtime allowed."""
    if kind.shift.latest is None or kind.overtime is None:
        return kind.shift.latest
    if kind.overtime.max_duration is None:
        return None
    return kind.shift.latest + kind.overtime.max_duration


class ZonesMet:
    """The zones in a request, and those that hold for all, as its drones meet them.

    Parameters
    ----------
    request
        A valid one.
    published
        Zones that hold for all requests on the globe.
    """

    def __init__(self, request: PlanRequest, published: Sequence[Zone] = ()) -> None:
        self._request = request
        self._published = published
        self.span = span_of(request)
        self._met: dict[float, Met] = {}

    def __bool__(self) -> bool:
        """Tell whether there are any."""
        return (self._request.coordinate_system == "geographic"
                and bool(self._request.airspace.zones or self._published))

    @cached_property
    def _closed(self) -> list[Zone]:
        """Those that may not be flown through while the plan lasts."""
        airspace = self._request.airspace
        cleared = set(airspace.cleared)
        stated = [zone for zones in airspace.zones for zone in reading_of(zones).zones]
        open_to_all = {"NO_RESTRICTION"}
        if airspace.conditional == "allow":
            open_to_all.add("CONDITIONAL")
        return [zone for zone in (*self._published, *stated)
                if zone.restriction not in open_to_all and zone.identifier not in cleared
                and applies(zone.periods, self.span)]

    def at(self, altitude: float) -> Met:
        """Return what drones meet that fly so many metres above the ground."""
        if not self:
            return NOTHING_MET
        if altitude not in self._met:
            stated = self._request.airspace.ground
            ground = (GroundHeights() if stated is None
                      else GroundHeights(stated.lowest, stated.highest))
            reached = [ZoneVolume(zone, volume) for zone in self._closed for volume in zone.volumes
                       if not volume.is_above(altitude, ground)]
            below = [part.volume.is_far or part.volume.is_below(altitude, ground)
                     for part in reached]
            self._met[altitude] = Met(
                tuple(part for part, low in zip(reached, below, strict=True) if not low),
                tuple(part for part, low in zip(reached, below, strict=True) if low))
        return self._met[altitude]


_READ: dict[int, Reading] = {}


def reading_of(stated: Zones) -> Reading:
    """Return what stated zones hold, which are read once and kept as long as they are."""
    key = id(stated)
    found = _READ.get(key)
    if found is None:
        found = _READ[key] = read_zones(stated)
        finalize(stated, _READ.pop, key, None)
    return found
