"""Instants and lengths of time: in seconds, or as people write them."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import timedelta
from typing import Annotated, Any, TypeVar

from pydantic import (
    AfterValidator, BaseModel, Field, GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter,
    ValidationInfo, ValidatorFunctionWrapHandler,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from app.schemas.day import (
    EPOCH_FROM, LONGEST_TEXT, Day, DayOfBody, is_dated, is_instant, read_date_time, zone_of,
)
from app.schemas.errors import AS_EPOCH, AS_NUMBER, AS_TEXT, InputError, InvalidRequestError

Model = TypeVar("Model", bound=BaseModel)

_HOURS = re.compile(r"(\d{1,4}):([0-5]\d)(?::([0-5]\d(?:\.\d{1,6})?))?")
_ISO_DURATION = re.compile(r"P(?:[\d.]+[WD])*(?:T(?:[\d.]+[HMS])+)?")
_PARSED = TypeAdapter(timedelta)

EPOCH_UNTIL = 7.5e9
"""Until when numbers are seconds since 1970: the year 2207."""

MAX_UNREADABLE = 20_000
"""Unreadable times of a body after which reading ends."""


def read_body(model: type[Model], body: bytes, day: DayOfBody | None = None) -> Model:
    """Return what a body holds; `day` is that of the whole if it is but a part.

    Raises
    ------
    ValidationError
        If it doesn't fit the model.
    InvalidRequestError
        If it has more unreadable times than are looked at.
    """
    try:
        return model.model_validate_json(body, context=day or DayOfBody(body))
    except _TooManyError as error:
        raise InvalidRequestError([InputError(
            code="TOO_MANY_ERRORS", path="$", message="There are more than "
            f"{MAX_UNREADABLE} texts that are no times: compare them with the schema.")]) from error


class _TooManyError(Exception):
    """So many times can't be read that reading ends."""


def _error(code: str, message: str) -> PydanticCustomError:
    return PydanticCustomError(code, message)


def _wrong_time(info: ValidationInfo, code: str, message: str) -> PydanticCustomError:
    """Return what is wrong with a time of a body.

    Raises
    ------
    _TooManyError
        If that was too often so.
    """
    if isinstance(info.context, DayOfBody):
        info.context.unreadable += 1
        if info.context.unreadable > MAX_UNREADABLE:
            raise _TooManyError
    return _error(code, message)


def _day(info: ValidationInfo, what: str = "A time of day tells") -> Day | None:
    """Return the day of the body that is read; None if it states what is none.

    That is an error of its own, and one is enough. `what` begins the sentence on a body without.
    """
    stated = info.context
    try:
        day = stated.day if isinstance(stated, DayOfBody) else None
    except ValueError:
        return None
    if day is None:
        raise _wrong_time(info, "MISSING_PLAN_START", f"{what} an instant only if the request "
                          "states plan_start: add it, or state seconds since plan start.")
    return day


def _read_instant(text: str, info: ValidationInfo) -> float:
    if len(text) > LONGEST_TEXT or not is_instant(text):
        raise _no_instant(info)
    day = _day(info)
    try:
        return 0.0 if day is None else day.seconds_at(text)
    except (ValueError, OverflowError):
        raise _no_instant(info) from None


def _read_epoch(instant: float, info: ValidationInfo) -> float:
    """Return an instant told in seconds since 1970."""
    day = _day(info, "So large a number counts seconds since 1970, and tells")
    return 0.0 if day is None else day.seconds_since_epoch(instant)


def _no_instant(info: ValidationInfo) -> PydanticCustomError:
    return _wrong_time(info, "WRONG_TYPE", "This is no instant: state seconds since plan start as "
                       "a JSON number, a time of the plan's day such as 07:30 (or +1 07:30 on the "
                       "next day), or a date and time such as 2026-03-29T07:30.")


def _read_later(text: str, info: ValidationInfo) -> float:
    """Return an instant from plan start on."""
    return _not_before(_read_instant(text, info), info)


def _not_before(seconds: float, info: ValidationInfo) -> float:
    if seconds < 0:
        raise _wrong_time(info, "BEFORE_PLAN_START", "The instant lies before plan_start: state a "
                          "later one, such as +1 07:30 for the next day, or an earlier "
                          "plan_start.")
    return seconds


def _read_opening(text: str, info: ValidationInfo) -> float:
    """Return an instant from which on something is so; it may have been before plan start."""
    return max(0.0, _read_instant(text, info))


def _read_later_epoch(instant: float, info: ValidationInfo) -> float:
    return _not_before(_read_epoch(instant, info), info)


def _read_opening_epoch(instant: float, info: ValidationInfo) -> float:
    return max(0.0, _read_epoch(instant, info))


def _read_duration(text: str, info: ValidationInfo) -> float:
    hours = _HOURS.fullmatch(text)
    if len(text) > LONGEST_TEXT:
        raise _no_duration(info)
    if hours is not None:
        return int(hours[1]) * 3600 + int(hours[2]) * 60 + float(hours[3] or 0)
    try:
        if not _ISO_DURATION.fullmatch(text):
            raise ValueError(text)
        return _PARSED.validate_python(text).total_seconds()
    except (ValueError, OverflowError):
        raise _no_duration(info) from None


def _no_duration(info: ValidationInfo) -> PydanticCustomError:
    return _wrong_time(info, "WRONG_TYPE", "This is no length of time: state seconds as a JSON "
                       "number, H:MM such as 0:10 for ten minutes, or an ISO 8601 duration such as "
                       "PT10M.")


class Written(float):
    """Seconds that were written as a text."""

    __slots__ = ("is_dated", "is_length", "is_moved", "later", "text")

    text: str
    is_dated: bool  # with a date
    is_length: bool  # after ISO 8601
    later: float | None  # the same clock on the day after, where nobody works as early
    is_moved: bool  # to then

    @classmethod
    def of(cls, seconds: float, text: str, later: float | None = None,
           is_moved: bool = False) -> "Written":
        """Return seconds and how they were written."""
        made = cls(seconds)
        made.text, made.is_length, made.is_dated = text, text.startswith("P"), is_dated(text)
        made.later, made.is_moved = later, is_moved
        return made


@dataclass(frozen=True)
class Readable:
    """Lets a number of seconds be stated as a text, too."""

    title: str
    read: Callable[[str, ValidationInfo], float]
    description: str
    examples: tuple[str, ...]
    read_epoch: Callable[[float, ValidationInfo], float] | None = None

    def __get_pydantic_core_schema__(self, source: Any,
                                     handler: GetCoreSchemaHandler) -> CoreSchema:
        number = handler(source)
        text = core_schema.chain_schema([core_schema.str_schema(min_length=1),
                                         *self.from_text(number)])
        # Numbers come first: they are read without a call of Python.
        choices: list[CoreSchema | tuple[CoreSchema, str]] = [(number, AS_NUMBER)]
        if self.read_epoch is not None:
            choices.append((core_schema.chain_schema([
                core_schema.float_schema(gt=EPOCH_FROM, le=EPOCH_UNTIL),
                core_schema.with_info_plain_validator_function(self.read_epoch),
                number,
            ]), AS_EPOCH))
        return core_schema.union_schema([*choices, (text, AS_TEXT)], mode="left_to_right",
                                        serialization=core_schema.simple_ser_schema("float"))

    def from_text(self, number: CoreSchema) -> list[CoreSchema]:
        """Return what reads a text, and then looks at it as at a number."""
        return [core_schema.with_info_wrap_validator_function(self.read_written, number)]

    def read_written(self, text: str, number: ValidatorFunctionWrapHandler,
                     info: ValidationInfo) -> Written:
        """Return the seconds that a text tells, and the text."""
        return Written.of(number(self.read(text, info)), text)

    def __get_pydantic_json_schema__(self, schema: CoreSchema,
                                     handler: GetJsonSchemaHandler) -> dict[str, Any]:
        number, *epochs, text = handler(schema)["anyOf"]
        for epoch in epochs:
            number["maximum"] = epoch["maximum"]
        return {"anyOf": [number, text | {
            "title": self.title, "maxLength": LONGEST_TEXT, "description": self.description,
            "examples": list(self.examples)}]}


_INSTANT_TEXT = ("A time of the plan's day in its zone, `+1 06:00` being on the next, or a date "
                 "and time after ISO 8601; needs `plan_start`.")
_INSTANTS = ("07:30", "+1 06:00", "2026-03-29T07:30:00+02:00")

READ_INSTANT = Readable("Instant", _read_later, _INSTANT_TEXT, _INSTANTS, _read_later_epoch)
READ_OPENING = Readable(
    "Opening", _read_opening, f"{_INSTANT_TEXT} Before plan start: from then on.", _INSTANTS,
    _read_opening_epoch)
READ_ANY_INSTANT = Readable("Instant", _read_instant, _INSTANT_TEXT, _INSTANTS)
READ_DURATION = Readable(
    "Duration", _read_duration, "A length of time: `H:MM`, or a duration after ISO 8601.",
    ("0:10", "PT10M"))


@dataclass(frozen=True)
class Told:
    """Marks instants of replies, which are told as `options.times` says."""


@dataclass(frozen=True)
class Worded:
    """Marks texts of replies that speak of times, put in words as `options.times` says."""


WordsReply = Annotated[str, Worded()]

InstantReply = Annotated[
    Annotated[float, Field(description="Seconds since plan start.")]
    | Annotated[str, Field(description="A date and time, or a time of the plan's day.")],
    Told(),
]
"""An instant in a reply: in seconds, or as `options.times` says."""


def _is_plan_start(text: str) -> str:
    try:
        start = read_date_time(text)
    except ValueError:
        raise _error("WRONG_TYPE", "This is no date and time after ISO 8601: state one such "
                     "as 2026-03-29T06:00:00+02:00.") from None
    try:
        Day.of(text, "UTC")
    except ValueError:
        raise _error("OUT_OF_RANGE", f"No plan starts in the year {start.year}: correct it."
                     ) from None
    return text


def require_zone(time_zone: str | None, info: ValidationInfo) -> str | None:
    """Return the zone stated beside a `plan_start`, which must be if that has no offset."""
    plan_start = info.data.get("plan_start")
    if time_zone is None and plan_start and read_date_time(plan_start).tzinfo is None:
        raise _error("MISSING_FIELD", "plan_start states no offset from UTC: add one there, or "
                     "add time_zone, such as Europe/Berlin.")
    return time_zone


def _is_zone(name: str) -> str:
    try:
        zone_of(name)
    except ValueError:
        raise _error("UNKNOWN_TIME_ZONE", "There is no time zone of this name: use one of the IANA "
                     "database, such as Europe/Berlin.") from None
    return name


PlanStart = Annotated[
    str, Field(max_length=LONGEST_TEXT, json_schema_extra={"format": "date-time"}),
    AfterValidator(_is_plan_start)]
TimeZone = Annotated[
    Annotated[str, Field(min_length=1, max_length=LONGEST_TEXT), AfterValidator(_is_zone)] | None,
    AfterValidator(require_zone),
]
"""Stated after a field `plan_start`, and validated even if it is left out."""
Currency = Annotated[str, Field(min_length=3, max_length=3, pattern="^[A-Z]{3}$")]
