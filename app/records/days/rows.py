"""With what days begin, and their events, in the database. Times in ms since 1970."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from pydantic_core import from_json

from app.records.dispatches.schemas import EventKind


@dataclass(frozen=True)
class DayTerms:
    """How a day is planned, beside its problem."""

    plan_within: float  # seconds
    eta_threshold: float  # seconds
    clock: float | None  # when it begins, if it goes by what it is told: seconds since plan start
    secret: str  # signs its quotes, and its customers' links
    webhook: str | None = None  # is told what follows from plans
    risk_threshold: float = 0.3  # the chance of being late from which on an order is at risk


@dataclass(frozen=True)
class Begun:
    """With what a day began; the problem as its client wrote it."""

    problem: dict[str, Any]
    terms: DayTerms

    def is_same(self, other: "Begun") -> bool:
        """Tell whether another was asked for by the same request."""
        return (self.problem == other.problem
                and replace(self.terms, secret=other.terms.secret) == other.terms)


@dataclass(frozen=True)
class LoggedEvent:
    """An event of a day."""

    number: int
    origin: str
    id: str
    kind: str
    time: int
    vehicle: str | None
    step: str | None
    outcome: EventKind | None
    reason: str | None
    body: str | None
    received_at: int = 0

    @cached_property
    def about(self) -> dict[str, Any]:
        """What else was told."""
        return {} if self.body is None else dict(from_json(self.body))
