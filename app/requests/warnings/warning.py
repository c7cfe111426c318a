"""One thing of a request that is allowed and is hardly meant."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from app.schemas.errors import json_path

Path = tuple[str | int, ...]


class RequestWarning(NamedTuple):
    """What was seen, what it would mean and what to write instead; the fields are those replied."""

    code: str
    message: str
    path: str

    def within(self, part: str) -> "RequestWarning":
        """Return the warning as seen from a whole of which the request is a part."""
        return self._replace(path=f"$.{part}{self.path[1:]}")


Warnings = Iterator[RequestWarning]


def warning_at(code: str, path: Sequence[str | int], message: str) -> RequestWarning:
    """Return a warning about a part of a request."""
    return RequestWarning(code, message, json_path(path))


def customers_text(some: int, of_all: int, verb: str = "are", of_one: str = "is") -> str:
    """Return words such as `All 60 customers are`, `1 of 60 customers is`."""
    if some == of_all:
        return f"The only customer {of_one}" if some == 1 else f"All {some:,} customers {verb}"
    return f"{some:,} of {of_all:,} customers {of_one if some == 1 else verb}"


def amount_text(amount: float) -> str:
    """Return a number without more digits than it needs."""
    return f"{amount:,.0f}" if abs(amount) >= 100 or amount == round(amount) else f"{amount:.3g}"
