"""When a plan's day begins and ends."""

from dataclasses import dataclass
from datetime import UTC, datetime, time, timedelta, timezone, tzinfo
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from app.schemas.errors import InputError, InvalidRequestError
from app.schemas.plan import PlanInput

MINUTE_MS, SECOND_MS = 60_000, 1_000

LATEST_HOME = timedelta(hours=4)
"""How much later than planned drivers may still need their links, midnight or not."""


@dataclass(frozen=True)
class PlanStart:
    """The instant from which a plan counts, and the zone of its drivers."""

    plan_start: datetime
    time_zone: str | None

    @classmethod
    def stated(cls, plan_start: datetime | None, time_zone: str | None,
               now: datetime) -> "PlanStart":
        """Return the day that a request states, today in UTC if it states none.

        Raises
        ------
        InvalidRequestError
            If there is no such zone.
        """
        zone = _zone(time_zone) if time_zone is not None else UTC
        begin = datetime.combine(now.astimezone(zone).date(), time(), zone)
        return cls(plan_start or begin, time_zone)

    @property
    def zone(self) -> tzinfo:
        """Where its days end at midnight."""
        if self.time_zone is not None:
            return _zone(self.time_zone)
        return timezone(self.plan_start.utcoffset() or timedelta())

    def end(self, plan: PlanInput) -> datetime:
        """Return the midnight after the last thing that is planned, or hours after it."""
        last = max((stop.departure for route in plan.routes for trip in route.trips
                    for stop in trip.stops), default=0.0)
        home = (self.plan_start + timedelta(seconds=last)).astimezone(UTC)
        next_day = home.astimezone(self.zone).date() + timedelta(days=1)
        return max(datetime.combine(next_day, time(), self.zone), home + LATEST_HOME)


def milliseconds(instant: datetime) -> int:
    """Return an instant as the database has it."""
    return round(instant.timestamp() * SECOND_MS)


def instant(of_ms: int, offset_minutes: int = 0) -> datetime:
    """Return an instant that the database has, as told in a zone."""
    zone = timezone(timedelta(minutes=offset_minutes)) if offset_minutes else UTC
    return datetime.fromtimestamp(of_ms / SECOND_MS, zone)


def _zone(name: str) -> ZoneInfo:
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError):
        message = "There is no such zone: use a name of the IANA's list, such as 'Europe/Berlin'."
        raise InvalidRequestError([
            InputError(code="UNKNOWN_VALUE", path="$.time_zone", message=message)]) from None
