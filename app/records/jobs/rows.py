"""Jobs as the database has them."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

from app.records.jobs.schemas import Kind, State

RowKind = Kind | Literal["region"]
"""What is done for a job; a region is one of a plan job's, which no client sees."""

SINGLE, SCENARIO = 1, 2
"""Priorities: a single plan, or a region of one, need not wait for all scenarios of a sweep."""

OPEN: tuple[State, ...] = ("queued", "running")


class JobRow(NamedTuple):
    """A job as the database has it. Times in milliseconds since 1970."""

    id: str
    kind: RowKind
    owner: str
    state: State
    parent: str | None
    position: int | None
    fingerprint: str
    webhook: str | None
    created_at: int
    started_at: int | None
    finished_at: int | None
    expires_at: int | None
    progress: float
    cost: float | None
    search_iterations: int
    searched: float  # seconds
    error: str | None
    cancel_requested: bool
    revision: int
    improved_revision: int
    attempt: int
    crashes: int
    client: str | None = None
    plans: int = 1
    key: str | None = None
    waiting_for: str | None = None
    waiting_since: int | None = None
    retry_at: int | None = None
    divided: bool = False  # a plan that goes on by regions
    deaths: int = 0  # of processes that planned it, whatever progress they made

    @property
    def is_over(self) -> bool:
        """Tell whether nothing will change any more."""
        return self.state not in OPEN


@dataclass(frozen=True)
class NewJob:
    """A job to be kept."""

    id: str
    kind: RowKind
    owner: str
    fingerprint: str
    body: bytes | None  # None: that of the parent
    webhook: str | None = None
    parent: str | None = None
    position: int | None = None
    client: str | None = None  # whose share it takes; None: a scenario, for which its parent does
    plans: int = 1
    key: str | None = None
    priority: int = SINGLE


@dataclass(frozen=True)
class OpenPlans:
    """How many plans wait or run, those included that scenarios will be."""

    total: int
    of_client: int


@dataclass(frozen=True)
class Standing:
    """How far a job has come."""

    progress: float
    search_iterations: int
    searched: float  # seconds
    cost: float | None = None  # None: unknown, or without meaning for the result
    result: bytes | None = None  # JSON, of that cost
