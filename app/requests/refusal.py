"""The door that every body in JSON comes through before anything is made of it.

What is no JSON, wrong all over or holds far too much is refused here, for little time and memory.
"""

import codecs
import re
from collections.abc import Iterator, Sequence
from functools import cache

import msgspec
import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ValidationError

from app.errors import (
    InputError, InvalidRequestError, NotJsonError, json_path, schema_errors,
)
from app.requests.scan import (
    COUNT, DEPTH, ERRORS, KEY_END, KEY_START, LEVELS, PARTS, SHAPE, Shapes, scan,
)
from app.requests.shapes import shapes_of
from app.schemas.hints import with_hints
from app.schemas.times import read_body

MAX_COUNTED_ERRORS = 20_000
"""With more errors than this the single ones are not looked at."""

MAX_SEARCHED_BYTES = 4 * 2**20
"""To save memory, longer bodies that don't fit the schema aren't searched for further errors."""

_ROW = re.compile(rb"\[[-+0-9.eE,\s]{100,}+\]")

LEAST_BYTES = 2**14
"""Shorter bodies can't do harm."""

MAX_PARTS, BYTES_PER_PART = 200_000, 25
"""Most objects and arrays of a body: so many, and one more for so many bytes."""

MAX_LOOSE = 400_000
"""Most values in what isn't read, or may be anything."""

DECODED_AT_ONCE = 2**20
"""Bytes: a whole body as text would take up to four times its length."""


def require_readable(body: bytes, model: type[BaseModel], most_loose: int = MAX_LOOSE) -> None:
    """Refuse a body that would take much time or memory to be refused later.

    Parameters
    ----------
    most_loose
        Most values in what isn't read, or may be anything.

    Raises
    ------
    InvalidRequestError
        If it has more errors than are looked at, or more parts than any request.
    NotJsonError
        If it is no JSON.
    """
    if len(body) < LEAST_BYTES:
        return
    errors = _require_sparse(body, model, most_loose)
    require_json(body)
    if errors and len(body) > MAX_SEARCHED_BYTES:
        _refuse_without_rows(body, model)


def require_json(body: bytes) -> None:
    """Refuse what is no JSON, to its end, without making anything of it.

    Raises
    ------
    NotJsonError
        If it is none.
    """
    try:
        if not body.isascii():
            decoder = codecs.getincrementaldecoder("utf-8")()
            for begin in range(0, len(body), DECODED_AT_ONCE):
                decoder.decode(body[begin:begin + DECODED_AT_ONCE])
            decoder.decode(b"", final=True)
        msgspec.json.decode(body, type=msgspec.Raw)
    except RecursionError:
        raise NotJsonError("The body has values in values in values, more than any request: send "
                           "one JSON object.") from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise NotJsonError(f"The body is not JSON, {error}: send one JSON object.") from None


def _require_sparse(body: bytes, model: type[BaseModel], most_loose: int) -> int:
    """Return how many errors were counted; raises as `require_readable` does if too many."""
    shapes = shapes_of(model)
    most = np.array([MAX_COUNTED_ERRORS, MAX_PARTS + len(body) // BYTES_PER_PART, most_loose])
    levels, found = np.zeros((DEPTH, 6), np.int64), np.zeros(4, np.int64)
    if scan(np.frombuffer(body, np.uint8), shapes, most, levels, found):
        return int(found[ERRORS])
    steps = list(_steps(body, levels[:found[LEVELS]]))
    if found[ERRORS] > most[ERRORS]:
        raise InvalidRequestError([_wrong_all_over(steps, shapes, levels[:found[LEVELS]])])
    kind, bound = (("objects and arrays", most[PARTS]) if found[PARTS] > most[PARTS]
                   else ("values in what is not read", most_loose))
    raise InvalidRequestError([InputError(
        code="TOO_MANY_PARTS", path=json_path(steps),
        message=f"By here there are more than {bound} {kind}, more than any request needs, and "
        "reading stopped: send less.")])


def _refuse_without_rows(body: bytes, model: type[BaseModel]) -> None:
    """Refuse a long body by what is wrong with it beside its rows of numbers, if that is anything.

    An error holds what was sent: where a field is missing, all that is beside it.
    """
    try:
        read_body(model, _ROW.sub(b"[]", body))
    except ValidationError as error:
        details = error.errors(include_url=False, include_input=False)
        if details[0]["type"] != "json_invalid":
            raise InvalidRequestError(with_hints(schema_errors(details), model)) from None


@cache
def compile_scan() -> None:
    """Compile what looks at bodies, or load it if that was done before."""
    require_readable(b"{}" + b" " * LEAST_BYTES, InputError)


def _wrong_all_over(steps: Sequence[str | int], shapes: Shapes,
                    levels: NDArray[np.int64]) -> InputError:
    if len(levels) and levels[-1, COUNT] > shapes.most[levels[-1, SHAPE]]:
        return InputError(code="WRONG_LENGTH", path=json_path(steps[:-1]), message=f"There are "
                          f"more than {shapes.most[levels[-1, SHAPE]]} entries: remove some.")
    return InputError(
        code="TOO_MANY_ERRORS", path=json_path(steps),
        message=f"By here the request has more than {MAX_COUNTED_ERRORS} errors, and reading "
        "stopped: compare it with the schema.")


def _steps(body: bytes, levels: NDArray[np.int64]) -> Iterator[str | int]:
    """Yield the steps to where a scan ended."""
    for level in levels[1:].tolist():
        if level[KEY_START] > 0:
            yield body[level[KEY_START]:level[KEY_END]].decode(errors="replace")
        elif level[KEY_START] < 0 and level[COUNT] > 0:
            yield level[COUNT] - 1
