"""The hours of a request's wind: in which drones may fly, and what they then fly through."""

from collections.abc import Iterator, Sequence
from datetime import UTC, datetime, timedelta
from itertools import pairwise
from typing import NamedTuple

from app.requests.conversion.units import thousandths
from app.schemas.day import Day
from app.schemas.drones import Flyer
from app.schemas.request import PlanRequest
from app.schemas.vehicle import VehicleTypeInput
from app.schemas.wind import ForecastInput, OpenMeteoInput, Wind, WindInput
from model.problem import MAX_STORMS, UNLIMITED
from model.travel.wind import Breeze

KMH = {"km/h": 1.0, "m/s": 3.6, "mp/h": 1.609344, "kn": 1.852}
"""Units of speeds, in km/h."""


class Hour(NamedTuple):
    """Some time of the same wind."""

    begin: int  # ms since plan start
    end: int
    breeze: Breeze
    strongest_kmh: float


class Storm(NamedTuple):
    """Some time in which drones may not fly."""

    begin: int  # ms since plan start
    end: int
    strongest_kmh: float


class Winds:
    """The wind of a valid request."""

    def __init__(self, request: PlanRequest) -> None:
        self.is_steady = isinstance(request.airspace.wind, WindInput)
        self.hours = list(_until_the_next(_stated(request.airspace.wind, request.day)))

    @property
    def steady(self) -> tuple[Breeze, ...]:
        """The only wind, if it is steady."""
        return tuple(hour.breeze for hour in self.hours) if self.is_steady else ()

    def flown(self, kind: VehicleTypeInput, drones: Flyer) -> tuple[Breeze, ...]:
        """Return the winds of all hours of a shift in which drones may fly, if there are any.

        None of a steady one, which a request tells by itself.
        """
        if self.is_steady:
            return ()
        hours = list(self._of_shift(kind))
        flown = [hour for hour in hours if not _is_storm(hour, drones)]
        return tuple(sorted({hour.breeze for hour in flown or hours}))

    def storms(self, kind: VehicleTypeInput, drones: Flyer) -> tuple[Storm, ...]:
        """Return when it blows too much for drones, on the shift of their truck."""
        storms: list[Storm] = []
        for hour in self._of_shift(kind):
            if not _is_storm(hour, drones):
                continue
            storm = Storm(hour.begin, hour.end, hour.strongest_kmh)
            if storms and storms[-1].end == hour.begin:
                storm = _together(storms.pop(), storm)
            storms.append(storm)
        while len(storms) > MAX_STORMS:
            calms = [later.begin - earlier.end for earlier, later in pairwise(storms)]
            shortest = calms.index(min(calms))
            storms[shortest:shortest + 2] = [_together(*storms[shortest:shortest + 2])]
        return tuple(storms)

    def _of_shift(self, kind: VehicleTypeInput) -> Iterator[Hour]:
        begin, end = thousandths(kind.shift.earliest), UNLIMITED
        if kind.shift.latest is not None:
            end = thousandths(kind.shift.latest)
            if kind.overtime is not None:
                over = kind.overtime.max_duration
                end = UNLIMITED if over is None else end + thousandths(over)
        for hour in self.hours:
            if hour.begin <= end and begin < hour.end:
                yield hour


def _together(earlier: Storm, later: Storm) -> Storm:
    return Storm(earlier.begin, later.end, max(earlier.strongest_kmh, later.strongest_kmh))


def _is_storm(hour: Hour, drones: Flyer) -> bool:
    return drones.max_wind_kmh is not None and hour.strongest_kmh > drones.max_wind_kmh


_Begun = tuple[int, Breeze, float]
"""From when, the wind, and the stronger of wind and gusts."""


def _stated(wind: Wind, day: Day | None) -> Sequence[_Begun]:
    if isinstance(wind, WindInput):
        return [(0, (wind.speed_kmh, wind.direction_deg), wind.speed_kmh)]
    if isinstance(wind, ForecastInput):
        return [] if day is None else list(_forecast(wind.open_meteo, day))
    return [(thousandths(each.from_time), (each.speed_kmh, each.direction_deg),
             max(each.speed_kmh, each.gust_kmh or 0.0)) for each in wind]


def _forecast(stated: OpenMeteoInput, day: Day) -> Iterator[_Begun]:
    hourly, units = stated.hourly, stated.hourly_units
    gusts = hourly.gusts or [None] * len(hourly.time)
    for time, speed, direction, gust in zip(hourly.time, hourly.wind_speed_10m,
                                            hourly.wind_direction_10m, gusts, strict=True):
        if speed is None or direction is None:
            continue
        kmh = speed * KMH[units.wind_speed_10m]
        gust_kmh = 0.0 if gust is None else gust * KMH[units.wind_gusts_10m]
        yield (hour_of(time, stated.utc_offset_seconds, day), (kmh, direction),
               max(kmh, gust_kmh))


def hour_of(time: str | int, offset_s: int, day: Day) -> int:
    """Return when an hour of a forecast begins, in ms since plan start.

    Raises
    ------
    ValueError
        If it is no date and time.
    OverflowError
        If it is none within this calendar.
    """
    if isinstance(time, int):
        instant = datetime.fromtimestamp(time, UTC)
    else:
        instant = datetime.fromisoformat(time)
        if instant.tzinfo is None:
            instant = (instant - timedelta(seconds=offset_s)).replace(tzinfo=UTC)
    return (instant - day.start) // timedelta(milliseconds=1)


def _until_the_next(stated: Sequence[_Begun]) -> Iterator[Hour]:
    """Yield hours that end as the next begins; the first holds before, the last ever after."""
    begins = [begin for begin, *_ in stated]
    for (begin, breeze, strongest), end in zip(stated, [*begins[1:], UNLIMITED], strict=True):
        earliest = 0 if begin == begins[0] else max(0, begin)
        if end > earliest:
            yield Hour(earliest, end, breeze, strongest)
