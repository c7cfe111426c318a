"""Days, and dispatches, as the database has them. Times in milliseconds since 1970."""

import uuid
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

from app.records.clock import now_ms
from app.records.dispatches.instants import PlanStart, milliseconds
from app.records.dispatches.schemas import EventKind


PLAN_SEEN = "plan.seen"
"""Kind of the event that a driver has seen what is new, for which no plan is made."""


HOUR_MS = 3_600_000


@dataclass(frozen=True)
class DayRow:
    """A day without what it began with, its plan and its events.

    A dispatch is a day that nobody plans: of it, no event is asked for.
    """

    id: str
    owner: str
    client: str
    created_at: int
    plan_start: int
    ends_at: int
    expires_at: int
    zone_offset: int  # minutes
    time_zone: str | None
    name: str | None = None  # that its client gave it
    asked: int = 0  # number of the last event that it is planned for
    revision: int = 0
    planned: int = 0
    plan_number: int = 0
    failure: str | None = None

    @classmethod
    def begun(cls, whose: tuple[str, str], day: PlanStart, ends_at: datetime, kept_hours: float,
              name: str | None = None) -> "DayRow":
        """Return the row of a day that begins now, of an owner and a client."""
        offset = day.plan_start.utcoffset() or timedelta()
        row = cls(str(uuid.uuid4()), *whose, now_ms(), milliseconds(day.plan_start), 0, 0,
                  round(offset.total_seconds() / 60), day.time_zone, name)
        return row.until(milliseconds(ends_at), kept_hours)

    def until(self, ends_at: int, kept_hours: float) -> "DayRow":
        """Return a day that ends then, and is kept for some hours more."""
        return replace(self, ends_at=ends_at, expires_at=ends_at + round(kept_hours * HOUR_MS))

    @property
    def told_name(self) -> str:
        """What its client calls it."""
        return self.name or self.id

    @property
    def day(self) -> str | None:
        """What a day that is planned is called; None: it is a dispatch alone."""
        return self.told_name if self.asked else None

    def seconds(self, time: int) -> float:
        """Return an instant in seconds since plan start."""
        return (time - self.plan_start) / 1000


@dataclass(frozen=True)
class VehicleLinkRow:
    """A vehicle's link, without its steps."""

    id: str
    dispatch: str
    position: int
    vehicle: str
    digest: bytes
    name: str | None = None  # that people call the vehicle; None: its id
    opened_at: int | None = None
    revoked_at: int | None = None


@dataclass(frozen=True)
class EventRow:
    """What was told of a step."""

    id: str
    step: str
    kind: EventKind
    time: int
    reason: str | None
    number: int = 0  # in order of arrival


@dataclass(frozen=True)
class ToldRow:
    """An event that is new: of a vehicle and a step, or of something else."""

    id: str
    kind: str  # as clients read it
    time: int
    vehicle: str | None = None
    step: str | None = None
    outcome: EventKind | None = None  # of the step
    reason: str | None = None
    body: str | None = None  # JSON: what else was told
