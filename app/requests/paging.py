"""Cursors: where the next page of a list begins."""

import binascii
import re
from base64 import urlsafe_b64decode, urlsafe_b64encode
from collections.abc import Callable

from app.schemas.errors import InputError, InvalidRequestError

MAX_INSTANT = 2**63 - 1
"""Latest instant in milliseconds that the database can be asked for."""

_CURSOR = re.compile("([0-9]{1,19}) (.*)")


def cursor_of(instant: int, row_id: str) -> str:
    """Return the cursor after the row of an id, by the instant that the list goes by."""
    return urlsafe_b64encode(f"{instant} {row_id}".encode()).decode()


def read_cursor(cursor: str, is_id: Callable[[str], bool]) -> tuple[int, str]:
    """Return the instant and the id of a cursor.

    Raises
    ------
    InvalidRequestError
        If it is none.
    """
    try:
        match = _CURSOR.fullmatch(urlsafe_b64decode(cursor).decode())
    except (binascii.Error, ValueError):
        match = None
    if match is None or int(match[1]) > MAX_INSTANT or not is_id(match[2]):
        message = "This is no cursor: send `next` of a page as it is."
        raise InvalidRequestError([InputError(code="WRONG_PARAMETER", path="query.cursor",
                                              message=message)])
    return int(match[1]), match[2]
