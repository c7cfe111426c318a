"""Instants as replies tell them."""

from datetime import UTC, datetime
from functools import lru_cache


@lru_cache(maxsize=4096)
def instant_of(milliseconds: int) -> str:
    """Return milliseconds since 1970 as ISO 8601 in UTC."""
    instant = datetime.fromtimestamp(milliseconds / 1000, UTC)
    return instant.isoformat(timespec="milliseconds").replace("+00:00", "Z")
