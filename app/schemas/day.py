"""The day of a plan: what its seconds since plan start are on the wall clock, and back."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import MAXYEAR, MINYEAR, UTC, datetime, time, timedelta
from functools import cached_property
from typing import Literal, NamedTuple
from zoneinfo import ZoneInfo

from pydantic import BaseModel

FIRST_YEAR, LAST_YEAR = 1900, 2200
"""Years of a plan's start."""

LONGEST_TEXT = 64

EPOCH_FROM = 1e9
"""Numbers above are seconds since 1970 where the plan's day is stated."""

Times = Literal["seconds", "iso", "clock"]
"""How replies tell instants."""

_DATE_TIME = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d.*")

_WALL = re.compile(
    r"(?:(?P<days>[+-]\d{1,3}) )?(?P<hour>\d{1,2}):(?P<minute>[0-5]\d)"
    r"(?::(?P<second>[0-5]\d)(?:\.(?P<fraction>\d{1,6}))?)?(?P<offset>Z|[+-]\d\d:?\d\d)?")

MICROSECOND = timedelta(microseconds=1)


def read_date_time(text: str) -> datetime:
    """Return an ISO 8601 date and time, with an offset or without.

    Raises
    ------
    ValueError
        If it is none.
    """
    if not _DATE_TIME.fullmatch(text):
        raise ValueError("no date and time after ISO 8601")
    return datetime.fromisoformat(text)


def _require_year(start: datetime) -> None:
    """Raise `ValueError` if no plan starts in the year of an instant."""
    if not FIRST_YEAR <= start.year <= LAST_YEAR:
        raise ValueError(f"start: the year is not in {FIRST_YEAR}..{LAST_YEAR}")


def is_instant(text: str) -> bool:
    """Tell whether a text has the form of a wall time, or of a date and time."""
    return bool(_WALL.fullmatch(text) or _DATE_TIME.fullmatch(text))


def is_dated(text: str) -> bool:
    """Tell whether a text has the form of a date and time."""
    return bool(_DATE_TIME.fullmatch(text))


def is_clock(text: str) -> bool:
    """Tell whether a text is a time of day, of no stated day."""
    wall = _WALL.fullmatch(text)
    return wall is not None and wall["days"] is None and wall["offset"] is None


def zone_of(name: str) -> ZoneInfo:
    """Return a time zone by its name in the IANA database.

    Raises
    ------
    ValueError
        If there is none of this name.
    """
    try:
        return ZoneInfo(name)
    except (KeyError, ValueError, OSError) as error:
        raise ValueError(f"no time zone {name!r}") from error


@dataclass(frozen=True)
class Day:
    """The day of a plan in its zone, on which the wall clock may jump.

    A wall time that comes twice is the first of the two, and one that is left out is told by the
    offset before the jump, as in calendars (RFC 5545, section 3.3.5).
    """

    start: datetime  # plan start, in the zone
    _start: datetime = field(init=False, repr=False)  # the same in UTC

    def __post_init__(self) -> None:
        if self.start.tzinfo is None:
            raise ValueError("start: there is neither an offset nor a time zone")
        _require_year(self.start)
        object.__setattr__(self, "_start", self.start.astimezone(UTC))

    @classmethod
    def of(cls, plan_start: str, time_zone: str | None) -> "Day":
        """Return the day that a request states.

        Raises
        ------
        ValueError
            If it states none.
        """
        start = read_date_time(plan_start)
        _require_year(start)
        if time_zone is None:
            return cls(start)
        zone = zone_of(time_zone)
        return cls(start.replace(tzinfo=zone) if start.tzinfo is None else start.astimezone(zone))

    def seconds_at(self, text: str) -> float:
        """Return the seconds since plan start of a date and time, or of a wall time of the day.

        Raises
        ------
        ValueError
            If it is neither.
        """
        wall = _WALL.fullmatch(text)
        instant = read_date_time(text) if wall is None else self._on_the_wall(wall)
        if instant.tzinfo is None:
            instant = instant.replace(tzinfo=self.start.tzinfo)
        if not MINYEAR < instant.year < MAXYEAR:
            raise ValueError(f"the year {instant.year} can't be told in another zone")
        return (instant.astimezone(UTC) - self._start) / MICROSECOND / 1e6

    def seconds_since_epoch(self, instant: float) -> float:
        """Return the seconds since plan start of an instant in seconds since 1970 (Unix time)."""
        return round(instant - self._start.timestamp(), 6)

    def instant(self, seconds: float) -> datetime:
        """Return an instant in the plan's zone, to the millisecond."""
        passed = timedelta(milliseconds=round(seconds * 1000))
        return (self._start + passed).astimezone(self.start.tzinfo)

    def iso(self, seconds: float) -> str:
        """Return an instant as ISO 8601 date and time with its offset."""
        instant = self.instant(seconds)
        return instant.isoformat(timespec="milliseconds" if instant.microsecond else "seconds")

    def clock(self, seconds: float) -> str:
        """Return an instant as wall time of the day, `+1 06:00:00` on the next.

        The second of two that are called the same tells its offset, too.
        """
        instant = self.instant(seconds)
        days = (instant.date() - self.start.date()).days
        wall = instant.time().isoformat("milliseconds" if instant.microsecond else "seconds")
        offset = instant.isoformat()[-6:] if instant.fold else ""
        return (f"{days:+d} " if days else "") + wall + offset

    def to_the_minute(self, seconds: float) -> str:
        """Return an instant as wall time of the day, such as `7:30`, rounded to the minute."""
        instant = self.instant(seconds + 30)
        days = (instant.date() - self.start.date()).days
        return (f"{days:+d} " if days else "") + f"{instant.hour}:{instant.minute:02d}"

    def on_the_clock(self, seconds: float) -> str:
        """Return an instant as wall time of the day, such as `22:00`, to the second if need be."""
        instant = self.instant(seconds)
        is_whole = instant.second == instant.microsecond == instant.fold == 0
        return self.to_the_minute(seconds) if is_whole else self.clock(seconds)

    def a_day_after(self, seconds: float) -> str:
        """Return how the same wall time on the day after is written, such as `+1 2:00`."""
        instant = self.instant(seconds)
        days = (instant.date() - self.start.date()).days + 1
        wall = instant.replace(tzinfo=None).time().isoformat()
        return f"{days:+d} {wall.removesuffix(':00')}"

    @property
    def since_midnight(self) -> float:
        """Seconds that the wall clock showed at plan start."""
        return timedelta(hours=self.start.hour, minutes=self.start.minute,
                         seconds=self.start.second).total_seconds()

    def teller(self, times: Times) -> Callable[[float], str | float]:
        """Return what tells an instant, given in seconds, as is asked for."""
        tellers: dict[Times, Callable[[float], str | float]] = {
            "seconds": float, "iso": self.iso, "clock": self.clock}
        return tellers[times]

    def _on_the_wall(self, wall: re.Match[str]) -> datetime:
        hour, days = int(wall["hour"]), int(wall["days"] or 0)
        clock = (wall["minute"], wall["second"] or "00", wall["fraction"] or "0")
        if hour == 24 and not any(map(int, clock)):
            hour, days = 0, days + 1
        if hour > 23:
            raise ValueError("no hour of the day")
        minute, second, fraction = clock
        at = time(hour, int(minute), int(second), int(fraction.ljust(6, "0")))
        date = self.start.date() + timedelta(days=days)
        text = datetime.combine(date, at).isoformat() + (wall["offset"] or "")
        return datetime.fromisoformat(text)


class _StatedDay(BaseModel):
    plan_start: str | None = None
    time_zone: str | None = None


class _StatedShift(BaseModel):
    earliest: str | float | None = None
    latest: str | float | None = None


class _StatedKind(BaseModel):
    shift: _StatedShift = _StatedShift()


class _StatedFleet(BaseModel):
    fleet: list[_StatedKind] = []


class _StatedFleets(_StatedFleet):
    problem: _StatedFleet = _StatedFleet()
    base: _StatedFleet = _StatedFleet()


class Night(NamedTuple):
    """When anybody works, which may be until the day after."""

    day: Day
    opens: float  # seconds since plan start
    closes: float


class _Stating(_StatedDay):
    problem: _StatedDay = _StatedDay()
    base: _StatedDay = _StatedDay()


class DayOfBody:
    """The day that a body states: looked for when an instant of it is no number, for speed."""

    def __init__(self, body: bytes) -> None:
        self._body = body
        self.unreadable = 0  # times found so far that can't be read

    @cached_property
    def day(self) -> Day | None:
        """The day; None if the body states none.

        Raises
        ------
        ValueError
            If what it states is no day.
        """
        whole = _Stating.model_validate_json(self._body)
        for part in (whole.problem, whole.base, whole):
            if part.plan_start is not None:
                return Day.of(part.plan_start, part.time_zone)
        return None

    @cached_property
    def night(self) -> Night | None:
        """When anybody works; None if that can't be told, or it is from the day's begin on."""
        try:
            day, whole = self.day, _StatedFleets.model_validate_json(self._body)
            fleet = whole.problem.fleet or whole.base.fleet or whole.fleet
            if day is None or not fleet:
                return None
            opens = min([_seconds(day, kind.shift.earliest) for kind in fleet])
            closes = max([_seconds(day, kind.shift.latest) for kind in fleet])
        except (ValueError, OverflowError):
            return None
        return Night(day, opens, closes) if opens > 0 else None


def _seconds(day: Day, stated: str | float | None) -> float:
    """Return an instant as it was stated in seconds since plan start."""
    if isinstance(stated, str):
        return day.seconds_at(stated)
    seconds = stated or 0.0
    return day.seconds_since_epoch(seconds) if seconds > EPOCH_FROM else seconds
