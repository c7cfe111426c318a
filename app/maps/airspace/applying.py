"""When zones apply: always, in an interval, or at times of days of the week."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta, tzinfo

WEEKDAYS = ("MON", "TUE", "WED", "THU", "FRI", "SAT", "SUN")
ALL_DAYS = frozenset(range(7))
DAY = timedelta(days=1)

EVER, NEVER_ENDS = datetime.min.replace(tzinfo=UTC), datetime.max.replace(tzinfo=UTC)

LONGEST_LOOK = 8
"""Days within which every time of every day of the week comes."""


@dataclass(frozen=True)
class PlannedSpan:
    """From when until when something is planned."""

    begin: datetime
    end: datetime

    def meets(self, begin: datetime, end: datetime) -> bool:
        """Tell whether any moment is in both."""
        return self.begin <= end and begin <= self.end


@dataclass(frozen=True)
class WeeklyHours:
    """A time of some days of the week; it ends on the next day where it ends before it begins."""

    days: frozenset[int] = ALL_DAYS  # 0 is Monday
    begin: time = time(0, tzinfo=UTC)
    end: time | None = None  # None: with the day

    def on(self, day: date) -> tuple[datetime, datetime]:
        """Return from when until when it applies that begins on a day."""
        begin = datetime.combine(day, self.begin)
        zone: tzinfo = self.begin.tzinfo or UTC
        if self.end is None:
            return begin, datetime.combine(day + DAY, time(0), zone)
        end = datetime.combine(day, self.end)
        return begin, end if end > begin else end + DAY


@dataclass(frozen=True)
class Period:
    """When a zone applies, as far as that could be read."""

    begin: datetime = EVER
    end: datetime = NEVER_ENDS
    hours: tuple[WeeklyHours, ...] = ()  # none: at all hours

    def meets(self, span: PlannedSpan) -> bool:
        """Tell whether it applies at any moment of a span."""
        begin, end = max(self.begin, span.begin), min(self.end, span.end)
        if begin > end:
            return False
        if not self.hours or end - begin >= LONGEST_LOOK * DAY:
            return True
        both = PlannedSpan(begin, end)
        first = begin.astimezone(UTC).date()
        days = [first + number * DAY for number in range(-2, (end - begin).days + 3)]
        return any(day.weekday() in hours.days and both.meets(*hours.on(day))
                   for hours in self.hours for day in days)


    def within(self, span: PlannedSpan) -> Iterator[tuple[datetime, datetime]]:
        """Yield from when until when it applies in a span no longer than can be looked through."""
        if not self.hours:
            yield self.begin, self.end
            return
        first = span.begin.astimezone(UTC).date()
        for number in range(-2, (span.end - span.begin).days + 3):
            day = first + number * DAY
            for hours in self.hours:
                if day.weekday() in hours.days:
                    begin, end = hours.on(day)
                    yield max(begin, self.begin), min(end, self.end)


ALWAYS = Period()


def closed_times(periods: Iterable[Period], span: PlannedSpan) -> list[tuple[datetime, datetime]]:
    """Return from when until when a zone with these periods applies, as far as a span meets it.

    Ascending and apart. Beyond `LONGEST_LOOK` days the last goes on for ever.
    """
    looked = min(span.end, span.begin + LONGEST_LOOK * DAY)
    found: list[tuple[datetime, datetime]] = []
    for begin, end in sorted([each for period in periods
                              for each in period.within(PlannedSpan(span.begin, looked))]):
        if begin >= end or end <= span.begin:
            continue
        if found and begin <= found[-1][1]:
            found[-1] = (found[-1][0], max(end, found[-1][1]))
        elif begin < looked:
            found.append((begin, end))
    if found and (looked < span.end or found[-1][1] > looked + DAY):
        found[-1] = (found[-1][0], NEVER_ENDS)
    return found


def applies(periods: Iterable[Period], span: PlannedSpan | None) -> bool:
    """Tell whether a zone with these periods applies at any moment of a span; None: whenever."""
    stated = tuple(periods)
    return span is None or not stated or any(period.meets(span) for period in stated)


def read_instant(text: str) -> datetime:
    """Return a date and time, of UTC where no offset is stated.

    Raises
    ------
    ValueError
        If it is none.
    """
    instant = datetime.fromisoformat(text.strip())
    return instant.replace(tzinfo=UTC) if instant.tzinfo is None else instant


def read_clock(text: str) -> time | None:
    """Return a time of day, of UTC where no offset is stated; None: the end of the day.

    Raises
    ------
    ValueError
        If it is none.
    """
    stated = text.strip()
    if stated.startswith("24:00"):
        return None
    clock = time.fromisoformat(stated)
    return clock.replace(tzinfo=UTC) if clock.tzinfo is None else clock
