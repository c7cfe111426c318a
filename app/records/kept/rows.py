"""Kept plans as the database has them, and what may be kept."""

from dataclasses import dataclass


@dataclass(frozen=True)
class KeptRow:
    """A kept plan without its content. Times in milliseconds since 1970."""

    owner: str
    id: str
    name: str
    note: str
    version: str
    created_at: int
    changed_at: int
    bytes: int
    customers: int
    cost: float | None
    links: int
    day: str | None  # whose plan it is, as that stands


@dataclass(frozen=True)
class LinkRow:
    """A link to a plan. Times in milliseconds since 1970."""

    id: str
    owner: str
    plan: str
    digest: bytes
    created_at: int


@dataclass(frozen=True)
class Content:
    """A plan to be kept."""

    name: str
    note: str
    body: bytes  # JSON, of request and plan
    customers: int
    cost: float | None
    day: str | None = None  # whose plan it is; body, customers and cost are those of now


@dataclass(frozen=True)
class KeptRoom:
    """How much is kept for each owner, and for how long."""

    plans: int
    bytes: int
    expiry: int | None  # milliseconds after the last change; None: for ever


@dataclass(frozen=True)
class Precondition:
    """Which versions a client knows, as RFC 9110 has it."""

    versions: frozenset[str] = frozenset()  # of `If-Match`
    any_version: bool = False  # `If-Match: *`
    must_be_new: bool = False  # `If-None-Match: *`

    @property
    def needs_one(self) -> bool:
        """Tell whether there has to be a plan already."""
        return self.any_version or bool(self.versions)
