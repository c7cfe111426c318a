"""The door that every body in JSON comes through before anything is made of it.

What is no JSON, wrong all over or holds far too much is refused here, for little time and memory.
"""

import codecs
import json
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from itertools import count, islice
from types import EllipsisType

import msgspec
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from app.requests.airspace_size import early_errors
from app.requests.shapes import Loose, read_shape
from app.schemas.errors import (
    ErrorCode, InputError, InvalidRequestError, NotJsonError, schema_errors,
)
from app.schemas.hints import with_hints
from app.schemas.times import read_body

MAX_COUNTED_ERRORS = 20_000
"""With more errors than this the single ones are not looked at."""

MAX_SEARCHED_BYTES = 4 * 2**20
"""To save memory, longer bodies that don't fit the schema aren't searched for further errors."""

LEAST_BYTES = 2**14
"""Shorter bodies can't do harm."""

MAX_SEARCHED_VALUES = 500_000
"""Of bodies with more values, what is wrong first is told as it was found."""

LISTED_BYTES = 2**17
"""In longer bodies, without rows of numbers, what is wrong first is told alone: an error takes
hundreds of times the length of what it is about."""

MAX_PARTS, BYTES_PER_PART = 200_000, 25
"""Most objects and arrays of a body: so many, and one more for so many bytes."""

MAX_COLONS = 2_000_000
"""Most colons of a body: one for each key, and those of times of day; 20 for each of as many
customers as a request may have."""

DECODED_AT_ONCE = 2**20
"""Bytes: a whole body as text would take up to four times its length."""

_ROW = re.compile(rb"\[[-+0-9.eE,\s]{100,}+\]")

LONGEST_TOLD = 1000
"""Characters of what is wrong that are told, from its beginning and its end."""

MOST_KEYS = 20
"""Keys of an object among which the one is looked for that msgspec doesn't name."""

Step = str | int | EllipsisType

_WORDS: tuple[tuple[re.Pattern[str], ErrorCode, str], ...] = (
    (re.compile(r"`str` of length <= (\d+)"), "WRONG_LENGTH",
     "The text has more than {} characters: shorten it."),
    (re.compile(r" of length <= (\d+)"), "WRONG_LENGTH",
     "There are more than {} entries: remove some."),
    (re.compile(r"unknown field `(.*)`"), "UNKNOWN_FIELD",
     "There is no field of this name: remove it or correct its spelling."),
    (re.compile(r"missing required field `(.*)`"), "MISSING_FIELD",
     "This field is required: add it."),
)
"""By what msgspec says."""

_STEP = re.compile(r"\[(\d+|\.\.\.)\]|\.([^.\[]+)")


def require_readable(body: bytes, model: type[BaseModel]) -> None:
    """Refuse a body that would take much time or memory to be refused later.

    Raises
    ------
    InvalidRequestError
        If it is long and doesn't fit the schema, or has more parts than any request.
    NotJsonError
        If it is no JSON.
    """
    if len(body) < LEAST_BYTES:
        return
    too_much = _excess(body)
    if too_much or len(body) <= LISTED_BYTES:
        require_json(body)
    if too_much:
        raise InvalidRequestError([InputError(
            code="TOO_MANY_PARTS", path="$",
            message=f"There are more than {too_much}, more than any request needs: send less.")])
    if len(body) > LISTED_BYTES:
        if too_large := list(early_errors(body)):
            raise InvalidRequestError(too_large)
        _require_shape(body, model)


def _excess(body: bytes) -> str:
    """Return what there is more of than in any request, nothing if there is no such thing."""
    # What stands in texts counts as well, of which there are few.
    most = MAX_PARTS + len(body) // BYTES_PER_PART
    if body.count(b"[") + body.count(b"{") > most:
        return f"{most} objects and arrays"
    return f"{MAX_COLONS} keys" if body.count(b":") > MAX_COLONS else ""


def _require_shape(body: bytes, model: type[BaseModel]) -> None:
    """Refuse what is no JSON or doesn't fit the schema; what fits is read but once."""
    with _as_not_json():
        _require_text(body)
        try:
            read_shape(body, model)
            return
        except msgspec.ValidationError as error:
            told = _shortened(str(error))
        except (msgspec.DecodeError, RecursionError):
            # In the same words as of short bodies.
            require_json(body)
            raise
    # What doesn't fit may be followed by what is no JSON.
    require_json(body)
    raise InvalidRequestError(_errors_beside_rows(body, model) or _errors_first(body, model, told))


def _shortened(told: str) -> str:
    """Return a message of msgspec without the middle of a name that no field has."""
    if len(told) <= 2 * LONGEST_TOLD:
        return told
    return f"{told[:LONGEST_TOLD]}…{told[-LONGEST_TOLD:]}"


def require_json(body: bytes) -> None:
    """Refuse what is no JSON, to its end, without making anything of it.

    Raises
    ------
    NotJsonError
        If it is none.
    """
    with _as_not_json():
        _require_text(body)
        msgspec.json.decode(body, type=msgspec.Raw)


def _require_text(body: bytes) -> None:
    """Raise `UnicodeDecodeError` for what is no text in UTF-8."""
    if not body.isascii():
        decoder = codecs.getincrementaldecoder("utf-8")()
        for begin in range(0, len(body), DECODED_AT_ONCE):
            decoder.decode(body[begin:begin + DECODED_AT_ONCE])
        decoder.decode(b"", final=True)


@contextmanager
def _as_not_json() -> Iterator[None]:
    """Raise `NotJsonError` where a body is found to be no JSON."""
    try:
        yield
    except RecursionError:
        raise NotJsonError("The body has values in values in values, more than any request: send "
                           "one JSON object.") from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise NotJsonError(f"The body is not JSON, {error}: send one JSON object.") from None


def _errors_beside_rows(body: bytes, model: type[BaseModel]) -> list[InputError]:
    """Return what is wrong with a body beside its rows of numbers; nothing if that is too long."""
    rest = _ROW.sub(b"[]", body)
    return [] if len(rest) > LISTED_BYTES else _in_words(_details(rest, model), model)


def _errors_first(body: bytes, model: type[BaseModel], told: str) -> list[InputError]:
    """Return what is wrong with the value that `told`, a message of msgspec, is about."""
    message, _, path = told.partition(" - at `$")
    path = path.rstrip("`")
    stated = [int(place) if place.isdigit() else key or ... for place, key in _STEP.findall(path)]
    # Of an array of numbers, of which this is one, but one error is told.
    is_number = "`float`" in message
    most = MAX_SEARCHED_BYTES if is_number else LISTED_BYTES
    # Where there are very many values, each entry found takes memory, but rows of numbers are few.
    is_searched = is_number or body.count(b",") <= MAX_SEARCHED_VALUES
    for steps, reduced in _reduced(body, stated) if is_searched else ():
        if len(reduced) <= most:
            first = tuple(0 if isinstance(step, int) else step for step in steps)
            found = [details | {"loc": (*steps, *details["loc"][len(steps):])}
                     for details in _details(reduced, model)
                     if details["loc"][:len(steps)] == first]
            if found:
                return _in_words(found, model)
    return [_told(message, path)]


def _reduced(body: bytes, steps: Sequence[Step]) -> Iterator[tuple[tuple[str | int, ...], bytes]]:
    """Yield bodies of what leads to one value alone, as the only entry of each array.

    Each with the steps that lead there. What may be any key of an object is each in turn.
    """
    if not steps:
        yield (), body
        return
    step, *further = steps
    if isinstance(step, int):
        entry = _entry(body, step)
        for inner, reduced in _reduced(entry, further):
            yield (step, *inner), b"[" + reduced + b"]"
        return
    fields = msgspec.json.decode(body, type=dict[str, msgspec.Raw])
    for key in islice(fields, MOST_KEYS) if step is ... else (step,):
        with suppress(LookupError, msgspec.ValidationError):
            for inner, reduced in _reduced(fields[key], further):
                yield (key, *inner), b"{" + json.dumps(key).encode() + b":" + reduced + b"}"


def _entry(array: bytes, index: int) -> bytes:
    """Return the entry of an array at an index, from 0; those before it are let go one by one."""
    ahead = count()

    def pass_over(_: type, value: object) -> object:
        if next(ahead) == index:
            raise _FoundError(value)
        return Loose()

    try:
        msgspec.json.decode(array, type=list[Loose], dec_hook=pass_over)
    except _FoundError as found:
        return msgspec.json.encode(found.value)
    raise LookupError(index)


class _FoundError(Exception):
    """A value was found, and reading ends."""

    def __init__(self, value: object) -> None:
        super().__init__()
        self.value = value


def _told(message: str, path: str) -> InputError:
    """Return an error in the words of msgspec, or ours if they are known."""
    for pattern, code, words in _WORDS:
        match = pattern.search(message)
        if match:
            field = f".{match[1]}" if code in ("MISSING_FIELD", "UNKNOWN_FIELD") else ""
            return InputError(code=code, path=f"${path}{field}", message=words.format(match[1]))
    return InputError(code="WRONG_TYPE", path=f"${path}", message=f"{message}: correct the value.")


def _details(body: bytes, model: type[BaseModel]) -> list[ErrorDetails]:
    """Return what pydantic finds in a short body."""
    try:
        read_body(model, body)
    except ValidationError as error:
        return error.errors(include_url=False)
    return []


def _in_words(details: Sequence[ErrorDetails], model: type[BaseModel]) -> list[InputError]:
    return with_hints(schema_errors(details), model)
