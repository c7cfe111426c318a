"""Dispatches as the database has them. Times in milliseconds since 1970."""

from dataclasses import dataclass

from app.records.dispatches.schemas import EventKind


PLAN_SEEN = "plan.seen"
"""Kind of the event that a driver has seen what is new, for which no plan is made."""


@dataclass(frozen=True)
class DispatchRow:
    """A plan on the road, without the plan."""

    id: str
    owner: str
    client: str
    created_at: int
    plan_start: int
    ends_at: int
    expires_at: int
    zone_offset: int  # minutes
    time_zone: str | None
    name: str | None = None  # of a day that is planned as it goes on
    asked: int = 0  # number of the last event that such a day is planned for

    @property
    def day(self) -> str | None:
        """What such a day is called; None: others plan on from this plan."""
        return (self.name or self.id) if self.asked else None


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
